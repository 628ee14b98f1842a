// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/ScaledJacobian.h"

#include "Quality/Faces/CellShapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace atria {

namespace {

using Corners = std::array<Vec3, 8>;

/// Returns the determinant of three vectors over the product of their lengths; 0 if one has no length.
double normalizedDeterminant(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > std::numeric_limits<double>::min() ? a.cross(b).dot(c) / lengths : 0.0;
}

JacobianTerms ofHexahedron(const Corners& p)
{
  // Neighbors of each corner in right-handed order.
  static constexpr std::array<std::array<int, 4>, 8> stars{
      {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};
  const Vec3 x = (p[1] + p[2] + p[5] + p[6]) - (p[0] + p[3] + p[4] + p[7]);
  const Vec3 y = (p[2] + p[3] + p[6] + p[7]) - (p[0] + p[1] + p[4] + p[5]);
  const Vec3 z = (p[4] + p[5] + p[6] + p[7]) - (p[0] + p[1] + p[2] + p[3]);
  JacobianTerms out;
  out.values[out.count++] = normalizedDeterminant(x, y, z);
  for (const auto& [corner, a, b, c] : stars)
  {
    out.values[out.count++] = normalizedDeterminant(p[a] - p[corner], p[b] - p[corner], p[c] - p[corner]);
  }
  return out;
}

double ofTetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const double ab = (b - a).norm();
  const double ac = (c - a).norm();
  const double ad = (d - a).norm();
  const double bc = (c - b).norm();
  const double bd = (d - b).norm();
  const double cd = (d - c).norm();
  const double greatest = std::max({ab * ac * ad, ab * bc * bd, bc * ac * cd, ad * bd * cd});
  if (greatest <= std::numeric_limits<double>::min())
  {
    return 0.0;
  }
  return std::sqrt(2.0) * (b - a).cross(c - a).dot(d - a) / greatest;
}

JacobianTerms ofWedge(const Corners& p)
{
  // VTK's wedge has its base's normal outward, so the third edge of each corner comes first in right-handed
  // order.
  static constexpr std::array<std::array<int, 4>, 6> stars{
      {{0, 3, 2, 1}, {1, 4, 0, 2}, {2, 5, 1, 0}, {3, 0, 4, 5}, {4, 1, 5, 3}, {5, 2, 3, 4}}};
  JacobianTerms out;
  for (const auto& [corner, a, b, c] : stars)
  {
    out.values[out.count++] =
        2.0 / std::sqrt(3.0) * normalizedDeterminant(p[a] - p[corner], p[b] - p[corner], p[c] - p[corner]);
  }
  return out;
}

double ofPyramid(const Corners& p)
{
  const double least = std::min({ofTetrahedron(p[0], p[1], p[2], p[4]), ofTetrahedron(p[0], p[2], p[3], p[4]),
                                 ofTetrahedron(p[0], p[1], p[3], p[4]), ofTetrahedron(p[1], p[2], p[3], p[4])});
  if (least <= 0.0)
  {
    return 0.0;
  }
  const double scaled = std::sqrt(2.0) * least;
  return scaled < 1.0 ? scaled : 2.0 - scaled;
}

} // namespace

JacobianTerms jacobianTerms(unsigned char cellType, const std::array<Vec3, 8>& corners)
{
  const Corners& p = corners;
  switch (cellType)
  {
    case tetrahedronCell:
      return {{ofTetrahedron(p[0], p[1], p[2], p[3])}, 1};
    case voxelCell:
      return ofHexahedron({p[0], p[1], p[3], p[2], p[4], p[5], p[7], p[6]});
    case hexahedronCell:
      return ofHexahedron(p);
    case wedgeCell:
      return ofWedge(p);
    case pyramidCell:
      return {{ofPyramid(p)}, 1};
    default:
      return {};
  }
}

double scaledJacobian(unsigned char cellType, const std::array<Vec3, 8>& corners)
{
  const JacobianTerms terms = jacobianTerms(cellType, corners);
  return terms.count > 0 ? *std::min_element(terms.values.begin(), terms.values.begin() + terms.count)
                         : std::numeric_limits<double>::quiet_NaN();
}

Buffer<double> scaledJacobians(std::span<const Vec3> points, const CellArrays& cells, const RunContext& context)
{
  Buffer<double> out(cells.types.size());
  context.executor.forEach(out.size(), 4096, [&](std::size_t c) {
    const auto first = static_cast<std::size_t>(cells.offsets[c]);
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < shapeOf(cells.types[c]).corners; ++i)
    {
      corners[i] = points[static_cast<std::size_t>(cells.connectivity[first + i])];
    }
    out[c] = scaledJacobian(cells.types[c], corners);
  });
  return out;
}

} // namespace atria
