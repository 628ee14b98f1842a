// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/NativeCells.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace atria;
using atria::testing::SampleMesh;

/// A prism of height 1 over a polygon, turned away from the axes.
SampleMesh prismOver(const std::vector<Vec3>& plan)
{
  SampleMesh sample;
  const Eigen::AngleAxisd turned(0.7, Vec3(1, 2, 3).normalized());
  const auto n = static_cast<std::int64_t>(plan.size());
  for (const double z : {0.0, 1.0})
  {
    for (const Vec3& p : plan)
    {
      sample.points.push_back(turned * Vec3(p[0], p[1], z));
    }
  }
  std::vector<std::int64_t> bottom;
  std::vector<std::int64_t> top;
  std::vector<std::vector<std::int64_t>> faces;
  for (std::int64_t i = 0; i < n; ++i)
  {
    const std::int64_t next = (i + 1) % n;
    bottom.insert(bottom.begin(), i);
    top.push_back(i + n);
    faces.push_back({i, next, next + n, i + n});
  }
  faces.push_back(bottom);
  faces.push_back(top);
  sample.addPolyhedron(faces);
  return sample;
}

NativeCells cut(const SampleMesh& sample)
{
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  return makeNativeCells(mesh, makeCellFaces(mesh), sample.view(), {}, atria::testing::quietContext().progress);
}

/// Of tetrahedra and of pyramids over flat bases; negative ones count as such.
double volumeOf(const SampleMesh& sample, const NativeCells& cells)
{
  const auto at = [&](Index p) {
    return p < sample.points.size() ? sample.points[p] : cells.apices[p - sample.points.size()];
  };
  double sum = 0.0;
  for (std::size_t cell = 0; cell < cells.types.size(); ++cell)
  {
    const auto corners = cells.cornersOf(cell);
    const Vec3 apex = at(corners.back());
    for (std::size_t i = 1; i + 2 < corners.size(); ++i)
    {
      const Vec3 a = at(corners[0]);
      const double part = (at(corners[i]) - a).cross(at(corners[i + 1]) - a).dot(apex - a) / 6.0;
      EXPECT_GT(part, 0.0);
      sum += part;
    }
  }
  return sum;
}

TEST(NativeCells, OfAnAngleMeetWhereAllFacesAreSeen)
{
  // Neither its centroid at (1.36, 1.36) nor the mean of its points sees all: only places within (0, 0) to (1, 1) do.
  const SampleMesh angle = prismOver({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});
  const NativeCells cells = cut(angle);
  EXPECT_EQ(cells.dividedPolyhedra, 1u);
  EXPECT_EQ(cells.invertedCells, 0u);
  EXPECT_EQ(cells.types.size(), 6u + 2u * 4u);
  EXPECT_NEAR(volumeOf(angle, cells), 7.0, 1e-12);
}

TEST(NativeCells, OfAShapeThatNoPlaceSeesAllOfAreCounted)
{
  const SampleMesh channel =
      prismOver({{0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {4, 4, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});
  const NativeCells cells = cut(channel);
  EXPECT_GT(cells.invertedCells, 0u);
  EXPECT_EQ(cells.apices.size(), 1u);
}

} // namespace
