// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the sides of turned domains.
#include "Domain/TurnedSides.h"
#include "Support/Shapes.h"
#include "TerrainSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

/// A diamond with corners 2 m from the origin, from 0 to 3 m.
PlacedPrism diamond() { return {Placement(), {Vec2(2, 0), Vec2(0, 2), Vec2(-2, 0), Vec2(0, -2)}, 0.0, 3.0}; }
const double diamondSide = 2.0 * std::sqrt(2.0);

std::map<Index, double> areasById(const TriangleSurface& surface)
{
  std::map<Index, double> areas;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    areas[surface.surfaceIds[t]] += areaVector(surface, t).norm();
  }
  return areas;
}

/// Expects four sides of a height that face outwards, less what covers the first of them.
void expectSides(const TriangleSurface& surface, Index names, double height, double covered = 0.0)
{
  const std::map<Index, double> areas = areasById(surface);
  for (Index side = 0; side < 4; ++side)
  {
    const auto found = areas.find(names + firstPrismSide + side);
    ASSERT_NE(found, areas.end());
    EXPECT_NEAR(found->second, diamondSide * height - (side == 0 ? covered : 0.0), 1e-9) << side;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.surfaceIds[t] >= names)
    {
      const Vec2 out = areaVector(surface, t).head<2>();
      EXPECT_GT(out.dot(middleOf(surface, t).head<2>()), 0.0) << "outwards";
    }
  }
}

TEST(TurnedSides, OfAnEmptyModelAreSheetsThatShareTheirEdges)
{
  TriangleSurface surface;
  surface.names = {"House", "Tree"};
  EXPECT_TRUE(cutToSides(surface, diamond(), 1.5, 1e-6).empty());
  expectSides(surface, 2, 6.0);
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : surface.points)
  {
    EXPECT_TRUE(p[2] == -1.5 || p[2] == 4.5);
    places.insert({p[0], p[1], p[2]});
  }
  EXPECT_EQ(places.size(), 8U) << "corners have the same bits on both sides";
}

TEST(TurnedSides, CutOffWhatIsBeyond)
{
  TriangleSurface surface;
  addSheet(surface, "Wide", Vec3(-9, -9, 1), Vec3(18, 0, 0), Vec3(0, 18, 0));
  addSheet(surface, "Within", Vec3(-0.5, -0.5, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  addSheet(surface, "Beyond", Vec3(3, 3, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  addSheet(surface, "Half", Vec3(0, -9, 2.5), Vec3(9, 0, 0), Vec3(0, 18, 0));
  EXPECT_TRUE(cutToSides(surface, diamond(), 1.5, 1e-6).empty());
  std::map<Index, double> areas = areasById(surface);
  EXPECT_NEAR(areas[0], 8.0, 1e-9);
  EXPECT_NEAR(areas[1], 1.0, 1e-9);
  EXPECT_EQ(areas[2], 0.0);
  EXPECT_NEAR(areas[3], 4.0, 1e-9);
  expectSides(surface, 4, 6.0);
  EXPECT_NEAR(areaFromAbove(surface), 13.0, 1e-9) << "fronts stay fronts";
  for (const Vec3& p : surface.points)
  {
    EXPECT_LE(std::abs(p[0]) + std::abs(p[1]), 2.0 + 1e-12);
  }
}

using PlacePair = std::array<std::array<double, 3>, 2>;

/// Number of uses of each edge by the triangles whose ids `isWanted`.
template <typename IsWanted> std::map<PlacePair, int> edgesOf(const TriangleSurface& surface, IsWanted&& isWanted)
{
  const auto placeOf = [&](Index p) {
    return std::array{surface.points[p][0], surface.points[p][1], surface.points[p][2]};
  };
  std::map<PlacePair, int> uses;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (std::size_t i = 0; i < 3 && isWanted(surface.surfaceIds[t]); ++i)
    {
      PlacePair edge{placeOf(surface.triangles[t].at(i)), placeOf(surface.triangles[t].at((i + 1) % 3))};
      std::ranges::sort(edge);
      ++uses[edge];
    }
  }
  return uses;
}

TEST(TurnedSides, ShareEdgesWithWhatTheyCut)
{
  TriangleSurface surface;
  addSheet(surface, "Slope", Vec3(-9, -9, 1), Vec3(18, 0, 0.5), Vec3(0, 18, 0.7));
  cutToSides(surface, diamond(), 1.5, 1e-6);
  const auto ofSlope = edgesOf(surface, [](Index id) { return id == 0; });
  const auto ofSides = edgesOf(surface, [](Index id) { return id != 0; });
  int borders = 0;
  for (const auto& [edge, count] : ofSlope)
  {
    borders += count == 1 ? 1 : 0;
    EXPECT_EQ(ofSides.contains(edge), count == 1);
  }
  EXPECT_GE(borders, 4);
}

TEST(TurnedSides, GiveWayToTrianglesInTheirPlanes)
{
  const Vec3 along(-1, 1, 0); // of the first side, from (2, 0) to (0, 2)
  TriangleSurface surface;
  addSheet(surface, "Gate", Vec3(1.5, 0.5, 1), along, Vec3(0, 0, 1));
  EXPECT_TRUE(cutToSides(surface, diamond(), 1.0, 1e-6).empty());
  const double gate = along.norm();
  EXPECT_NEAR(areasById(surface)[0], gate, 1e-9);
  expectSides(surface, 1, 5.0, gate);
}

TEST(TurnedSides, TakeTheSmallerOfTwoInOnePlaceAndTellWhatItShares)
{
  const Vec3 along(-1, 1, 0);
  for (const bool isWallFirst : {false, true})
  {
    TriangleSurface surface;
    const auto addWall = [&] { addSheet(surface, "Wall", Vec3(1.75, 0.25, 1), 1.5 * along, Vec3(0, 0, 1)); };
    const auto addGate = [&] { addSheet(surface, "Gate", Vec3(1.5, 0.5, 1), 0.5 * along, Vec3(0, 0, 0.5)); };
    isWallFirst ? (addWall(), addGate()) : (addGate(), addWall());
    const Index wall = isWallFirst ? 0 : 1;
    const std::vector<SharedArea> shared = cutToSides(surface, diamond(), 1.0, 1e-6);
    const double unit = along.norm();
    ASSERT_EQ(shared.size(), 1U);
    EXPECT_EQ(shared[0].gives, wall);
    EXPECT_EQ(shared[0].keeps, 1 - wall);
    EXPECT_NEAR(shared[0].area, 0.25 * unit, 1e-9);
    EXPECT_EQ(shared[0].equalArea, 0.0);
    EXPECT_NEAR(areasById(surface)[1 - wall], 0.25 * unit, 1e-9);
    EXPECT_NEAR(areasById(surface)[wall], 1.25 * unit, 1e-9);
    expectSides(surface, 2, 5.0, 1.5 * unit);
  }
}

TEST(TurnedSides, PutPointsOnThemWithinTheTolerance)
{
  for (const auto& [distance, isOn] : {std::pair(0.009, true), {-0.009, true}, {-0.011, false}})
  {
    const double off = distance / std::sqrt(2.0);
    TriangleSurface surface;
    addSheet(surface, "Gate", Vec3(1.5 + off, 0.5 + off, 1), Vec3(-1, 1, 0), Vec3(0, 0, 1));
    cutToSides(surface, diamond(), 1.0, 0.01);
    EXPECT_NEAR(areasById(surface)[0], std::sqrt(2.0), 1e-9);
    expectSides(surface, 1, 5.0, isOn ? std::sqrt(2.0) : 0.0);
  }
  TriangleSurface beyond;
  addSheet(beyond, "Gate", Vec3(1.51, 0.51, 1), Vec3(-1, 1, 0), Vec3(0, 0, 1));
  cutToSides(beyond, diamond(), 1.0, 0.01);
  EXPECT_EQ(areasById(beyond).count(0), 0U) << "what lies beyond is dropped";
}

TEST(TurnedSides, ReachAsFarAsTheSurfacesThatMeetThem)
{
  TriangleSurface surface;
  addSheet(surface, "Tower", Vec3(0, -9, -8), Vec3(0, 18, 0), Vec3(0, 0, 20));
  cutToSides(surface, diamond(), 1.0, 1e-6);
  expectSides(surface, 1, 20.0);
  TriangleSurface inside;
  addSheet(inside, "Tower", Vec3(0, -1, -8), Vec3(0, 2, 0), Vec3(0, 0, 20));
  cutToSides(inside, diamond(), 1.0, 1e-6);
  expectSides(inside, 1, 5.0);
}

} // namespace
