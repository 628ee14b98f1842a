// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/ScaledJacobian.h"

#include "Quality/CellShapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace atria {

namespace {

using Corners = std::array<Vec3, 8>;

/// Determinant of three vectors over the product of their lengths; 0 where one has no length.
double normalisedDeterminant(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > std::numeric_limits<double>::min() ? a.cross(b).dot(c) / lengths : 0.0;
}

double ofHexahedron(const Corners& p)
{
  // Per corner its neighbours in right-handed order.
  static constexpr std::array<std::array<int, 4>, 8> stars{
      {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};
  const Vec3 x = (p[1] + p[2] + p[5] + p[6]) - (p[0] + p[3] + p[4] + p[7]);
  const Vec3 y = (p[2] + p[3] + p[6] + p[7]) - (p[0] + p[1] + p[4] + p[5]);
  const Vec3 z = (p[4] + p[5] + p[6] + p[7]) - (p[0] + p[1] + p[2] + p[3]);
  double least = normalisedDeterminant(x, y, z);
  for (const auto& [corner, a, b, c] : stars)
  {
    least = std::min(least, normalisedDeterminant(p[a] - p[corner], p[b] - p[corner], p[c] - p[corner]));
  }
  return least;
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

double ofWedge(const Corners& p)
{
  // VTK's wedge has its base's normal outward, so the third edge of each corner comes first in right-handed
  // order.
  static constexpr std::array<std::array<int, 4>, 6> stars{
      {{0, 3, 2, 1}, {1, 4, 0, 2}, {2, 5, 1, 0}, {3, 0, 4, 5}, {4, 1, 5, 3}, {5, 2, 3, 4}}};
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [corner, a, b, c] : stars)
  {
    least = std::min(least, normalisedDeterminant(p[a] - p[corner], p[b] - p[corner], p[c] - p[corner]));
  }
  return least * 2.0 / std::sqrt(3.0);
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

double ofCell(unsigned char type, std::span<const Vec3> points, std::span<const std::int64_t> ids)
{
  const std::size_t corners = shapeOf(type).corners;
  if (corners == 0)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  Corners p;
  for (std::size_t i = 0; i < corners; ++i)
  {
    p[i] = points[static_cast<std::size_t>(ids[i])];
  }
  switch (type)
  {
    case tetrahedronCell:
      return ofTetrahedron(p[0], p[1], p[2], p[3]);
    case voxelCell:
      std::swap(p[2], p[3]);
      std::swap(p[6], p[7]);
      return ofHexahedron(p);
    case hexahedronCell:
      return ofHexahedron(p);
    case wedgeCell:
      return ofWedge(p);
    default:
      return ofPyramid(p);
  }
}

} // namespace

std::vector<double> scaledJacobians(std::span<const Vec3> points, const CellArrays& cells, const RunContext& context)
{
  std::vector<double> out(cells.types.size());
  context.executor.forRanges(out.size(), 4096, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    for (std::size_t c = begin; c < end; ++c)
    {
      const auto first = static_cast<std::size_t>(cells.offsets[c]);
      const auto size = static_cast<std::size_t>(cells.offsets[c + 1]) - first;
      out[c] = ofCell(cells.types[c], points, cells.connectivity.subspan(first, size));
    }
  });
  return out;
}

} // namespace atria
