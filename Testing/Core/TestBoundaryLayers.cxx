// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the thickness and the heights of layers on blocks of cubes, and layer points that stay.
#include "Layer/BoundaryLayers.h"
#include "Layer/ConformingLayer.h"
#include "Layer/LayerHeights.h"
#include "Layer/SettledPoints.h"
#include "LayerBlock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Thickness, IsTheSumOfHeightsOrAShareOfTheSize)
{
  LayerOptions options;
  options.relativeThickness = 0.3;
  options.dividedThickness = 0.7;
  EXPECT_NEAR(thicknessAsked({1, 0.0, 2.0}, 10.0, options), 3.0, 1e-12);
  EXPECT_NEAR(thicknessAsked({2, 0.0, 2.0}, 10.0, options), 7.0, 1e-12);
  EXPECT_NEAR(thicknessAsked({1, 0.1, 2.0}, 10.0, options), 0.1, 1e-12);
  EXPECT_NEAR(thicknessAsked({4, 0.1, 2.0}, 10.0, options), 1.5, 1e-12);
  EXPECT_NEAR(thicknessAsked({4, 0.1, 1.0}, 10.0, options), 0.4, 1e-12);
  EXPECT_NEAR(thicknessAsked({3, 0.1, 0.5}, 10.0, options), 0.175, 1e-12);
}

TEST(Heights, HaveTheGrowthAskedAndFillTheWay)
{
  for (const double growth : {0.5, 1.0, 1.2, 2.0, 5.0})
  {
    for (int layers = 1; layers <= 6; ++layers)
    {
      double sum = 0.0;
      for (int i = 0; i < layers; ++i)
      {
        sum += std::pow(growth, i);
      }
      for (const WallLayers& wall : {WallLayers{layers, 0.0, growth}, {layers, 0.1, growth}})
      {
        const std::vector<double> shares = divideWay(wall, 0.1 * sum);
        ASSERT_EQ(shares.size(), static_cast<std::size_t>(layers));
        EXPECT_EQ(shares.back(), 1.0);
        double before = 0.0;
        for (std::size_t i = 0; i < shares.size(); ++i)
        {
          EXPECT_NEAR(shares[i] - before, std::pow(growth, static_cast<double>(i)) / sum, 1e-9);
          before = shares[i];
        }
      }
    }
  }
}

TEST(Heights, KeepTheFirstAndGrowFasterWhereTheWayIsLong)
{
  const WallLayers wall{4, 0.1, 1.1};
  for (const double growth : {1.2, 1.5, 1.9, 2.0})
  {
    const double way = 0.1 * (1 + growth + growth * growth + growth * growth * growth);
    const std::vector<double> shares = divideWay(wall, way);
    EXPECT_NEAR(shares[0] * way, 0.1, 1e-9) << growth;
    EXPECT_NEAR(shares[1] * way, 0.1 + 0.1 * growth, 1e-9);
    EXPECT_NEAR(shares[2] * way, 0.1 + 0.1 * growth + 0.1 * growth * growth, 1e-9);
  }
  const std::vector<double> longest = divideWay(wall, 150.0);
  EXPECT_NEAR(longest[0], 1.0 / 15.0, 1e-9) << "growth ends at two";
  const std::vector<double> fast = divideWay({3, 0.1, 3.0}, 130.0);
  EXPECT_NEAR(fast[0], 1.0 / 13.0, 1e-9) << "or at what is asked for";
  EXPECT_NEAR(divideWay({3, 0.1, 1.5}, 0.35)[0] * 0.35, 0.1, 1e-9) << "growth falls where the way is short";
  EXPECT_NEAR(divideWay({3, 0.1, 1.5}, 0.15)[0], 1.0 / 3.0, 1e-9) << "to 1 at least";
  EXPECT_NEAR(divideWay({3, 0.0, 1.1}, 1e9)[0], 1.0 / 3.31, 1e-9) << "no height, no way to keep it";
}

TEST(Heights, AreThoseOfTheWallWithMostLayersAroundAPoint)
{
  const Grown of({3, 3, 3}, {{"zMin", {4, 0.2, 1.5}}, {"xMin", {3, 0.0, 1.2}}, {"yMin", {5, 0.1, 1.9}}});
  const std::vector<WallLayers> layers = layersOfPoints(of.block.mesh, of.walls, of.options);
  const auto at = [&](Index i, Index j, Index k) { return layers[of.block.pointAt(i, j, k)]; };
  EXPECT_EQ(at(1, 1, 0), (WallLayers{4, 0.2, 1.5}));
  EXPECT_EQ(at(0, 1, 1), (WallLayers{3, 0.0, 1.2}));
  EXPECT_EQ(at(1, 0, 1), (WallLayers{5, 0.1, 1.9}));
  EXPECT_EQ(at(0, 1, 0), (WallLayers{4, 0.2, 1.5}));
  EXPECT_EQ(at(0, 0, 1), (WallLayers{5, 0.1, 1.9}));
  EXPECT_EQ(at(1, 0, 0), (WallLayers{5, 0.1, 1.9}));
  EXPECT_EQ(at(0, 0, 0), (WallLayers{5, 0.1, 1.9}));
  EXPECT_EQ(at(2, 2, 2).layers, 0);
}

TEST(Heights, AreTheSmallestOfWallsWithAsMany)
{
  const Grown of({3, 3, 3}, {{"zMin", {4, 0.2, 1.5}}, {"xMin", {4, 0.0, 1.2}}, {"yMin", {4, 0.1, 1.9}}});
  const std::vector<WallLayers> layers = layersOfPoints(of.block.mesh, of.walls, of.options);
  const auto at = [&](Index i, Index j, Index k) { return layers[of.block.pointAt(i, j, k)]; };
  EXPECT_EQ(at(0, 1, 0), (WallLayers{4, 0.2, 1.2})) << "of heights that are given";
  EXPECT_EQ(at(0, 0, 1), (WallLayers{4, 0.1, 1.2}));
  EXPECT_EQ(at(1, 0, 0), (WallLayers{4, 0.1, 1.5}));
  EXPECT_EQ(at(0, 0, 0), (WallLayers{4, 0.1, 1.2}));
}

TEST(Heights, AreWantedWhereALayerStands)
{
  Grown of({4, 3, 2}, {{"zMin", {3, 0.02, 1.2}}});
  std::vector<char> excluded(of.block.mesh.points.size(), 0);
  excluded[of.block.pointAt(2, 1, 0)] = 1;
  const LayerMesh one = of.grow(excluded);
  const std::vector<Index> counts = layersWanted(of.walls, one);
  for (Index p = 0; p < counts.size(); ++p)
  {
    const bool isOnWall = of.block.mesh.points[p][2] == 0.0;
    EXPECT_EQ(counts[p], isOnWall && !excluded[p] ? 3U : 0U);
    EXPECT_EQ(one.copies[p] != noIndex, isOnWall && !excluded[p]);
  }
}

TEST(Heights, StandOnTheStraightLinesToTheCopies)
{
  Grown of({4, 4, 2}, {{"zMin", {3, 0.05, 2.0}}});
  const LayerMesh one = of.grow();
  std::vector<Index> counts = layersWanted(of.walls, one);
  counts[of.block.pointAt(2, 2, 0)] = 2;
  counts[of.block.pointAt(2, 1, 0)] = 0;
  const LayerMesh divided = divideLayer(of.block.mesh, of.walls, one, of.options, counts);
  std::map<Index, Index> made;
  for (std::size_t i = 0; i < divided.wallPoints.size(); ++i)
  {
    const Index wall = divided.wallPoints[i];
    const Index point = divided.plainPoints + static_cast<Index>(i);
    const bool isShort = wall == of.block.pointAt(2, 2, 0);
    // The short one fills the way of 0.35 with two layers: growth is raised to two, then both are scaled up.
    const std::array<double, 3> heights = isShort ? std::array{0.35 / 3.0, 0.35, 0.0} : std::array{0.05, 0.15, 0.35};
    const Vec3 expected = of.block.mesh.points[wall] + heights.at(divided.places[i] - 1) * Vec3::UnitZ();
    EXPECT_NEAR((divided.mesh.points[point] - expected).norm(), 0.0, 1e-9) << wall;
    ++made[wall];
  }
  for (Index p = 0; p < counts.size(); ++p)
  {
    EXPECT_EQ(made[p], counts[p]);
  }
}

TEST(Heights, WithoutAFirstOneAreEqualBesideFewerLayers)
{
  Grown of({4, 4, 2}, {{"zMin", {3, 0.0, 2.0}}});
  const LayerMesh one = of.grow();
  std::vector<Index> counts = layersWanted(of.walls, one);
  counts[of.block.pointAt(0, 0, 0)] = 2;
  const LayerMesh divided = divideLayer(of.block.mesh, of.walls, one, of.options, counts);
  const auto firstShare = [&](Index i, Index j) {
    const Index wall = of.block.pointAt(i, j, 0);
    const Index copy = divided.copies[wall];
    const Index first = copy + 1 - counts[wall];
    return divided.mesh.points[first][2] / divided.mesh.points[copy][2];
  };
  EXPECT_NEAR(firstShare(1, 1), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(firstShare(1, 0), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(firstShare(2, 1), 1.0 / 7.0, 1e-9);
  EXPECT_NEAR(firstShare(0, 0), 1.0 / 3.0, 1e-9) << "it has fewer, not more";
}

TEST(SettledPoints, KeepPlacesAndReplaceThem)
{
  SettledPoints settled;
  EXPECT_TRUE(settled.isEmpty());
  EXPECT_FALSE(settled.has(0) || settled.stays(0) || settled.keepsLayers(0) || settled.isAtCut(0));
  settled.open(4);
  EXPECT_FALSE(settled.isEmpty() || settled.has(2));
  const auto heightsOf = [&](Index point) {
    std::vector<double> heights;
    std::ranges::transform(settled.aboveOf(point), std::back_inserter(heights), [](const Vec3& p) { return p[2]; });
    return heights;
  };
  settled.settle(2, std::vector<Vec3>{{0, 0, 1}, {0, 0, 2}});
  settled.settle(1, std::vector<Vec3>{{0, 0, 3}});
  settled.settle(2, std::vector<Vec3>{{0, 0, 4}, {0, 0, 5}});
  EXPECT_THAT(heightsOf(2), ElementsAre(4, 5));
  EXPECT_THAT(heightsOf(1), ElementsAre(3));
  EXPECT_EQ(settled.above.size(), 3U) << "as many places take the earlier ones'";
  settled.settle(2, std::vector<Vec3>{{0, 0, 6}});
  settled.settle(3, std::vector<Vec3>{});
  EXPECT_THAT(heightsOf(2), ElementsAre(6));
  EXPECT_TRUE(settled.has(3));
  EXPECT_THAT(heightsOf(3), IsEmpty());
  EXPECT_FALSE(settled.keepsLayers(2));
  settled.areDivided = true;
  EXPECT_TRUE(settled.keepsLayers(2));
  EXPECT_FALSE(settled.keepsLayers(0));
  settled.fixed = {1, 0, 0, 0};
  settled.atCut = {0, 1, 0, 0};
  EXPECT_TRUE(settled.stays(0) && settled.keepsLayers(0) && settled.isAtCut(1));
  EXPECT_FALSE(settled.stays(1) || settled.isAtCut(0));
}

} // namespace
