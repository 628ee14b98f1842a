// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Inspection/Inspection.h"

#include "Support/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using atria::Index;
using atria::inspect;
using atria::Inspection;
using atria::TriangleSurface;

/// A tetrahedron of two names, each triangle with points of its own.
TriangleSurface tetrahedron()
{
  const std::array<atria::Vec3, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  TriangleSurface surface;
  surface.names = {"base", "sides"};
  for (const std::array<int, 3>& t : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
  {
    const auto first = static_cast<Index>(surface.points.size());
    for (const int corner : t)
    {
      surface.points.push_back(corners[corner]);
    }
    surface.triangles.push_back({first, first + 1, first + 2});
    surface.surfaceIds.push_back(first == 0 ? 0 : 1);
  }
  return surface;
}

TEST(Inspection, MeasuresEachSurfaceAndTheWhole)
{
  const Inspection result = inspect(tetrahedron());
  ASSERT_EQ(result.surfaces.size(), 2u);
  EXPECT_EQ(result.surfaces[0].name, "base");
  EXPECT_EQ(result.surfaces[0].triangles, 1u);
  EXPECT_EQ(result.surfaces[0].area, 0.5);
  EXPECT_EQ(result.surfaces[0].bounds.max.z(), 0.0);
  EXPECT_EQ(result.surfaces[0].openEdges, 3u);
  EXPECT_EQ(result.surfaces[1].triangles, 3u);
  EXPECT_EQ(result.surfaces[1].openEdges, 3u);
  EXPECT_EQ(result.total.triangles, 4u);
  EXPECT_NEAR(result.total.area, 1.5 + std::sqrt(0.75), 1e-15);
  EXPECT_EQ(result.total.openEdges, 0u);
  EXPECT_EQ(result.total.nonManifoldEdges, 0u);
  EXPECT_EQ(result.points, 4u);
}

TEST(Inspection, CountsEdgesOfThreeTrianglesOnce)
{
  TriangleSurface surface = tetrahedron();
  surface.points.insert(surface.points.end(), {{0, 0, 0}, {1, 0, 0}, {0, -1, 0}});
  surface.triangles.push_back({12, 13, 14});
  surface.surfaceIds.push_back(0);
  const Inspection result = inspect(surface);
  EXPECT_EQ(result.total.nonManifoldEdges, 1u);
  EXPECT_EQ(result.total.openEdges, 2u);
  EXPECT_EQ(result.surfaces[0].nonManifoldEdges, 0u);
}

TEST(Inspection, TakesPointsOfEqualCoordinatesAloneForOne)
{
  TriangleSurface surface = tetrahedron();
  EXPECT_EQ(inspect(surface).points, 4u);
  EXPECT_EQ(inspect(surface).total.openEdges, 0u);
  surface.points[0].x() += 1e-6;
  EXPECT_GT(inspect(surface).total.openEdges, 0u);
}

TEST(Inspection, CountsDegenerateTrianglesWithoutTheirEdges)
{
  TriangleSurface surface;
  surface.names = {"a", "unused"};
  surface.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  surface.triangles = {{0, 1, 2}, {0, 1, 3}};
  surface.surfaceIds = {0, 0};
  const Inspection result = inspect(surface);
  EXPECT_EQ(result.total.degenerate, 2u);
  EXPECT_EQ(result.total.openEdges, 0u);
  EXPECT_EQ(result.points, 3u);
  EXPECT_TRUE(result.surfaces[1].bounds.empty());
}

TEST(Inspection, TakesAnEmptyModel)
{
  const Inspection result = inspect({});
  EXPECT_EQ(result.total.triangles, 0u);
  EXPECT_TRUE(result.total.bounds.empty());
}

TEST(Inspection, TellsWhatIsWrongWithItsInput)
{
  TriangleSurface surface = tetrahedron();
  surface.points[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(inspect(surface), atria::Error);
  surface = tetrahedron();
  surface.triangles[2][1] = 99;
  EXPECT_THROW(inspect(surface), atria::Error);
  surface = tetrahedron();
  surface.surfaceIds[0] = 2;
  EXPECT_THROW(inspect(surface), atria::Error);
}

} // namespace
