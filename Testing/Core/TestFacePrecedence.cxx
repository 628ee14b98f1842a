// SPDX-License-Identifier: GPL-3.0-or-later
/// Which of surfaces that lie upon each other keeps its faces.
#include "Support/Shapes.h"
#include "Surface/Triangles/FacePrecedence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace {

using atria::FacePrecedence;
using atria::Index;
using atria::PlanarPatches;
using atria::SurfaceKind;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addSheet;
using atria::testing::addSurface;

/// Points in one place become one.
PlanarPatches patchesOf(TriangleSurface surface)
{
  for (auto& triangle : surface.triangles)
  {
    for (Index& p : triangle)
    {
      const Vec3& place = surface.points[p];
      p = static_cast<Index>(std::ranges::find(surface.points, place) - surface.points.begin());
    }
  }
  return atria::findPlanarPatches(surface.points, surface.triangles, surface.surfaceIds);
}

TEST(PlanarPatches, AreWhatHangsTogetherInOnePlane)
{
  TriangleSurface surface;
  atria::testing::addBox(surface, "Box", {{0, 0, 0}, {2, 3, 4}});
  const PlanarPatches patches = patchesOf(surface);
  std::vector<double> areas = patches.areas;
  std::ranges::sort(areas);
  const std::vector<double> wanted{6, 6, 6, 6, 8, 8, 8, 8, 12, 12, 12, 12};
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    EXPECT_NEAR(areas[i], wanted[i], 1e-12);
  }
  ASSERT_EQ(patches.surfaceAreas.size(), 1u);
  EXPECT_NEAR(patches.surfaceAreas[0], 52.0, 1e-12);
  EXPECT_TRUE(patches.isClosed[0]);
}

TEST(PlanarPatches, HangTogetherAtPointsWhereEdgesDoNotMatch)
{
  // One long triangle below, two above that end in the middle of its edge.
  TriangleSurface surface;
  addSurface(surface, "Wall", {{0, 0, 0}, {4, 0, 0}, {0, 0, -4}, {2, 0, 0}, {0, 0, 2}, {4, 0, 2}},
             {{0, 2, 1}, {0, 3, 4}, {3, 1, 5}});
  for (const double area : patchesOf(surface).areas)
  {
    EXPECT_NEAR(area, 12.0, 1e-12);
  }
}

TEST(PlanarPatches, CountWhatASurfaceRepeatsOnce)
{
  TriangleSurface surface;
  const std::vector<Vec3> square{{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}};
  addSurface(surface, "Pane", square, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}, {0, 1, 2}});
  addSurface(surface, "Other", square, {{0, 1, 2}, {0, 2, 3}});
  const PlanarPatches patches = patchesOf(surface);
  for (const double area : patches.areas)
  {
    EXPECT_NEAR(area, 4.0, 1e-12);
  }
  EXPECT_NEAR(patches.surfaceAreas[0], 4.0, 1e-12);
  EXPECT_FALSE(patches.isClosed[0]);
}

TEST(PlanarPatches, EndAtFacetsOfRoundWalls)
{
  TriangleSurface surface;
  atria::testing::addTube(surface, "Tube", {0, 0, 0}, {0, 0, 1}, 10.0, 360);
  const double facet = 2.0 * 10.0 * std::sin(std::numbers::pi / 360.0);
  for (const double area : patchesOf(surface).areas)
  {
    EXPECT_NEAR(area, facet, 1e-9);
  }
}

/// A window of 1, a wall of 6, the same wall under another name with 100 elsewhere, and again.
class Precedence : public ::testing::Test
{
protected:
  enum : Index
  {
    window = 0,
    wall = 2,
    large = 4,
    elsewhere = 6,
    copy = 8
  };

  Precedence()
  {
    addSheet(surface, "Window", {1, 0, 1}, {1, 0, 0}, {0, 0, 1});
    addSheet(surface, "Wall", {0, 0, 0}, {3, 0, 0}, {0, 0, 2});
    addSheet(surface, "Large", {0, 0, 0}, {3, 0, 0}, {0, 0, 2});
    addSheet(surface, "Elsewhere", {0, 50, 0}, {10, 0, 0}, {0, 10, 0});
    surface.surfaceIds[6] = surface.surfaceIds[7] = 2;
    addSheet(surface, "Copy", {0, 0, 0}, {3, 0, 0}, {0, 0, 2});
  }

  FacePrecedence with(std::vector<SurfaceKind> kinds = {}) const
  {
    return {patchesOf(surface), surface.surfaceIds, surface.names.size(), std::move(kinds)};
  }

  TriangleSurface surface;
};

TEST_F(Precedence, IsOfTheSmallerPatchWhateverTheOrder)
{
  const FacePrecedence precedence = with();
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{window, wall}), 0u);
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{wall, window}), 1u);
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{large, wall, copy, window}), 3u);
  EXPECT_FALSE(precedence.areEqual(window, wall));
}

TEST_F(Precedence, IsOfTheSmallerSurfaceWherePatchesAreEqual)
{
  const FacePrecedence precedence = with();
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{large, copy}), 1u);
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{copy, large}), 0u);
  EXPECT_FALSE(precedence.areEqual(large, wall));
}

TEST_F(Precedence, IsOfTheFirstWhereAllIsEqual)
{
  const FacePrecedence precedence = with();
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{copy, wall}), 1u);
  EXPECT_TRUE(precedence.areEqual(copy, wall));
  EXPECT_FALSE(precedence.areEqual(wall, wall)) << "of one surface";
}

TEST_F(Precedence, OfWallsThatAreNotLargerIsThatBeforeFaceZones)
{
  std::vector<SurfaceKind> kinds(surface.names.size(), SurfaceKind::wall);
  kinds[surface.surfaceIds[wall]] = SurfaceKind::faceZone;
  kinds[surface.surfaceIds[window]] = SurfaceKind::faceZone;
  const FacePrecedence precedence = with(kinds);
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{wall, copy}), 1u);
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{wall, large}), 1u);
  EXPECT_EQ(precedence.keptOf(std::vector<Index>{copy, window}), 1u) << "a smaller face zone opens the wall";
  EXPECT_FALSE(precedence.areEqual(wall, copy));
}

TEST_F(Precedence, OfCellZonesAndSidesIsBehindAllOthers)
{
  std::vector<SurfaceKind> kinds(surface.names.size(), SurfaceKind::wall);
  kinds[surface.surfaceIds[window]] = SurfaceKind::cellZone;
  EXPECT_EQ(with(kinds).keptOf(std::vector<Index>{window, wall}), 1u);
  surface.surfaceIds[copy] = surface.surfaceIds[copy + 1] = static_cast<Index>(surface.names.size()) + 3;
  EXPECT_EQ(with(kinds).keptOf(std::vector<Index>{copy, large}), 1u);
  EXPECT_EQ(with(kinds).keptOf(std::vector<Index>{copy, window}), 1u);
}

TEST_F(Precedence, TakesAreasForEqualThatDifferByRounding)
{
  addSheet(surface, "Rounded", {0, 0, 0}, {3.001, 0, 0}, {0, 0, 2});
  const FacePrecedence precedence = with();
  EXPECT_TRUE(precedence.areEqual(wall, 10));
  addSheet(surface, "Smaller", {0, 0, 0}, {2.9, 0, 0}, {0, 0, 2});
  EXPECT_FALSE(with().areEqual(wall, 12));
}

} // namespace
