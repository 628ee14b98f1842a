// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the upper sides of closed ground, and slabs below a model.
#include "Domain/UpperSide.h"
#include "Support/Shapes.h"
#include "TerrainSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double rounding = 1e-9;

/// True if the middle of a face is on the outer sides or the bottom of a block from the origin to `high`.
bool isBelowOrAround(const Vec3& middle, const Vec3& high)
{
  return middle[2] < rounding || middle[0] < rounding || middle[1] < rounding || middle[0] > high[0] - rounding ||
         middle[1] > high[1] - rounding;
}

TEST(UpperSides, OfBlocksWithPitsAndNotchesAreAllButBottomAndOuterSides)
{
  Random random(4);
  for (int round = 0; round < 60; ++round)
  {
    std::array<int, 9> heights{};
    std::ranges::generate(heights, [&] { return 1 + static_cast<int>(random.below(3)); });
    TriangleSurface surface;
    addCells(surface, "Ground", 3, Vec3(1, 2, 0.5),
             [&](int i, int j, int k) { return k < heights.at(static_cast<std::size_t>(3 * i + j)); });
    addBox(surface, "House", {Vec3(0.5, 0.5, 9), Vec3(2, 2, 12)});
    std::vector<std::array<Index, 3>> expected;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      if (surface.surfaceIds[t] == 1 || !isBelowOrAround(middleOf(surface, t), Vec3(3, 6, 1.5)))
      {
        expected.push_back(surface.triangles[t]);
      }
    }
    EXPECT_THAT(keepUpperSides(surface, {1, 0}, 1e-6), ElementsAre(0));
    EXPECT_EQ(surface.triangles, expected);
    EXPECT_EQ(surface.surfaceIds.size(), expected.size());
    EXPECT_EQ(std::ranges::count(surface.surfaceIds, 1U), 12);
  }
}

TEST(UpperSides, AreTakenOfClosedGroundAlone)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  addBox(surface, "Slab", {Vec3(2, 0, 0), Vec3(3, 1, 1)});
  addBox(surface, "Open", {Vec3(4, 0, 0), Vec3(5, 1, 1)});
  surface.triangles.pop_back();
  surface.surfaceIds.pop_back();
  addSheet(surface, "Sheet", Vec3(6, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const std::vector<std::array<Index, 3>> before = surface.triangles;
  EXPECT_THAT(keepUpperSides(surface, {0, 0, 1, 1}, 1e-6), IsEmpty());
  EXPECT_EQ(surface.triangles, before);
  EXPECT_THAT(keepUpperSides(surface, {0, 1, 1, 1}, 1e-6), ElementsAre(1));
  std::array<std::ptrdiff_t, 4> counts{};
  for (Index id = 0; id < 4; ++id)
  {
    counts.at(id) = std::ranges::count(surface.surfaceIds, id);
  }
  EXPECT_THAT(counts, ElementsAre(12, 2, 11, 2));
}

TEST(UpperSides, HaveNothingOfTheirBodyMoreThanTheToleranceAbove)
{
  for (const auto& [tolerance, kept] : {std::pair(0.09, std::size_t{2}), {0.11, std::size_t{12}}})
  {
    TriangleSurface surface;
    addBox(surface, "Slab", {Vec3(0, 0, 0), Vec3(3, 3, 0.1)});
    keepUpperSides(surface, {1}, tolerance);
    EXPECT_EQ(surface.triangles.size(), kept);
  }
  TriangleSurface stacked; // another body above takes nothing away
  addBox(stacked, "Lower", {Vec3(0, 0, 0), Vec3(3, 3, 1)});
  addBox(stacked, "Upper", {Vec3(0, 0, 2), Vec3(3, 3, 3)});
  EXPECT_THAT(keepUpperSides(stacked, {1, 1}, 1e-6), ElementsAre(0, 1));
  EXPECT_THAT(stacked.surfaceIds, ElementsAre(0, 0, 1, 1));
}

/// A slab from the origin with its top at 0, and a house on it.
struct SlabCase
{
  Vec3 slab;
  Box3 house;
  Index expected;
};

Index slabOf(const TriangleSurface& surface, double tolerance = 1e-3)
{
  return findGroundSlab(surface, findBodies(surface, SurfaceFlags(surface.names.size(), 0)), tolerance);
}

TriangleSurface slabAndHouse(const SlabCase& of)
{
  TriangleSurface surface;
  addBox(surface, "House", of.house);
  addBox(surface, "Slab", {Vec3(0, 0, -of.slab[2]), Vec3(of.slab[0], of.slab[1], 0)});
  return surface;
}

TEST(GroundSlab, IsFlatAndWideAndHoldsAllElse)
{
  const Box3 house{Vec3(3, 3, 0.01), Vec3(10, 10, 6)};
  for (const SlabCase& of : {SlabCase{Vec3(20, 30, 1), house, 1},
                             {Vec3(20, 30, 1.99), house, 1},
                             {Vec3(20, 30, 2.01), house, noIndex},
                             {Vec3(30, 20, 2.01), house, noIndex},
                             {Vec3(20, 30, 0.0005), house, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, 3, -0.5), Vec3(10, 10, 6)}, 1},
                             {Vec3(20, 30, 1), {Vec3(3, 3, -1.1), Vec3(10, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(-0.1, 3, 0.01), Vec3(10, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, -0.1, 0.01), Vec3(10, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, 3, 0.01), Vec3(20.1, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, 3, 0.01), Vec3(10, 30.1, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(1, 1, 0.01), Vec3(19, 17.6, 6)}, 1},
                             {Vec3(20, 30, 1), {Vec3(1, 1, 0.01), Vec3(19, 17.7, 6)}, noIndex}})
  {
    EXPECT_EQ(slabOf(slabAndHouse(of)), of.expected) << of.slab.transpose() << ", " << of.house.min.transpose();
  }
}

TEST(GroundSlab, IsClosedAndHasItsNameForItself)
{
  const SlabCase good{Vec3(20, 20, 1), {Vec3(3, 3, 0.01), Vec3(10, 10, 6)}, 1};
  TriangleSurface open = slabAndHouse(good);
  open.triangles.pop_back();
  open.surfaceIds.pop_back();
  EXPECT_EQ(slabOf(open), noIndex);
  TriangleSurface sameName = slabAndHouse(good);
  addBox(sameName, "Shed", {Vec3(12, 12, 0.01), Vec3(14, 14, 2)});
  EXPECT_EQ(slabOf(sameName), 1U);
  std::ranges::replace(sameName.surfaceIds, Index{2}, Index{1});
  EXPECT_EQ(slabOf(sameName), noIndex);
  TriangleSurface alone;
  addBox(alone, "Slab", {Vec3(0, 0, -1), Vec3(20, 20, 0)});
  EXPECT_EQ(slabOf(alone), noIndex);
  EXPECT_EQ(slabOf({}), noIndex);
}

} // namespace
