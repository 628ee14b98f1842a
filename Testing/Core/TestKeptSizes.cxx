// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sizes that are kept under a limit, and the steps in which they are given up.
#include "Octree/Sizing/KeptSizes.h"
#include "SizingFrame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::array<OctantNeed, needCount> needs{OctantNeed::open, OctantNeed::region, OctantNeed::surface,
                                                  OctantNeed::feature};

TEST(KeptSizes, KeepTheStartLevelAndEachNeedDownToItsOwn)
{
  const KeptSizes sizes{{3, 1, 4, 5}, 2, 2};
  for (int level = 0; level < 7; ++level)
  {
    for (std::size_t need = 0; need < needCount; ++need)
    {
      EXPECT_EQ(sizes.keeps(level, needs.at(need)), level < std::max(2, sizes.levels.at(need))) << level;
    }
  }
}

TEST(RequestedSizes, AreThoseOfTheFrameAndTheFinestRules)
{
  GridFrame frame = frameOf(6); // 64 m at level 0
  frame.startLevel = 2;
  frame.topLevel = 3;
  ModelLevels levels;
  levels.ofSurface = {1, 4, 0};
  levels.featureOfSurface = {5, 4, 0};
  SizingOptions options;
  options.cellsPerLevel = 7;
  const auto levelsOf = [&] { return requestedSizes(frame, levels, options).levels; };
  EXPECT_THAT(levelsOf(), ElementsAre(3, 0, 4, 5));
  EXPECT_EQ(requestedSizes(frame, levels, options).startLevel, 2);
  EXPECT_EQ(requestedSizes(frame, levels, options).cellsPerLevel, 7);
  frame.topLevel = 1;
  EXPECT_THAT(levelsOf(), ElementsAre(2, 0, 4, 5)) << "the start level holds in the open";
  options.boxes = {{{}, 8.0}, {{}, 16.0}};
  EXPECT_THAT(levelsOf(), ElementsAre(2, 3, 4, 5));
  options.distanceSizes = {{"A", 1.0, 1.0}, {"A", 1.0, 2.0}};
  EXPECT_THAT(levelsOf(), ElementsAre(2, 6, 6, 5)) << "regions are at surfaces, too";
  options.boxes.clear();
  options.distanceSizes.clear();
  options.curvatureAngle = 10.0;
  EXPECT_THAT(levelsOf(), ElementsAre(2, 0, 5, 5));
  options.curvatureAngle = 0.0;
  options.cellsAcrossGap = 1;
  EXPECT_THAT(levelsOf(), ElementsAre(2, 5, 5, 5));
}

/// Levels of all needs, then the layers.
using State = std::array<int, needCount + 1>;

State stateOf(const SizeSteps& steps)
{
  const KeptSizes& kept = steps.kept();
  return {kept.levels[0], kept.levels[1], kept.levels[2], kept.levels[3], kept.cellsPerLevel};
}

/// The states of all steps where octants of all needs exist down to what is kept.
std::vector<State> allSteps(const GridFrame& frame, const KeptSizes& requested, bool withGrowth)
{
  SizeSteps steps(frame, requested);
  std::vector<State> states;
  EXPECT_FALSE(steps.isReduced());
  while (steps.giveUpMore(steps.kept().levels, withGrowth) && states.size() < 99)
  {
    EXPECT_TRUE(steps.isReduced());
    states.push_back(stateOf(steps));
  }
  return states;
}

TEST(SizeSteps, GiveUpOneLevelOrLayerAtATimeInTheirOrder)
{
  GridFrame frame = frameOf(6);
  frame.startLevel = 2;
  const KeptSizes requested{{4, 3, 4, 5}, 3, 2};
  EXPECT_THAT(allSteps(frame, requested, true),
              ElementsAre(State{3, 3, 4, 5, 3}, State{2, 3, 4, 5, 3}, State{2, 3, 4, 5, 2}, State{2, 3, 4, 5, 1},
                          State{2, 2, 4, 5, 1}, State{2, 2, 3, 5, 1}, State{2, 2, 2, 5, 1}, State{2, 2, 2, 4, 1},
                          State{2, 2, 2, 3, 1}, State{2, 2, 2, 2, 1}));
  EXPECT_THAT(allSteps(frame, requested, false),
              ElementsAre(State{3, 3, 4, 5, 3}, State{2, 3, 4, 5, 3}, State{2, 2, 4, 5, 1}, State{2, 2, 3, 5, 1},
                          State{2, 2, 2, 5, 1}, State{2, 2, 2, 4, 1}, State{2, 2, 2, 3, 1}, State{2, 2, 2, 2, 1}));
}

TEST(SizeSteps, KeepTheFacesOfNarrowSidesUntilTheEnd)
{
  GridFrame frame = frameOf(6);
  frame.startLevel = 1;
  // Each side is 8 m times the diagonal of a square: octants of 8 m, of level 3, have faces on it.
  frame.turnedDomain = PlacedPrism(Placement(), {Vec2(8, 0), Vec2(0, 8), Vec2(-8, 0), Vec2(0, -8)}, 0.0, 9.0);
  EXPECT_THAT(allSteps(frame, {{4, 1, 1, 2}, 1, 1}, true),
              ElementsAre(State{3, 1, 1, 2, 1}, State{3, 1, 1, 1, 1}, State{2, 1, 1, 1, 1}, State{1, 1, 1, 1, 1}));
  EXPECT_THAT(allSteps(frame, {{2, 1, 1, 2}, 1, 1}, true), ElementsAre(State{2, 1, 1, 1, 1}, State{1, 1, 1, 1, 1}))
      << "the requested level, where that is coarser";
}

TEST(SizeSteps, GoBelowTheOctantsThatExist)
{
  GridFrame frame = frameOf(6);
  frame.startLevel = 1;
  SizeSteps steps(frame, {{6, 6, 6, 6}, 1, 1});
  EXPECT_TRUE(steps.giveUpMore({3, 4, 5, 6}, true));
  EXPECT_EQ(stateOf(steps), (State{2, 6, 6, 6, 1}));
  EXPECT_TRUE(steps.giveUpMore({1, 4, 5, 6}, true)) << "none are left in the open";
  EXPECT_EQ(stateOf(steps), (State{1, 3, 6, 6, 1}));
  EXPECT_TRUE(steps.giveUpMore({1, 1, 5, 6}, true));
  EXPECT_EQ(stateOf(steps), (State{1, 1, 4, 6, 1}));
  EXPECT_TRUE(steps.giveUpMore({1, 1, 0, 2}, true));
  EXPECT_EQ(stateOf(steps), (State{1, 1, 1, 1, 1}));
  EXPECT_FALSE(steps.giveUpMore({1, 1, 1, 1}, true));
}

TEST(SizeSteps, NameWhatIsKeptInsteadOfWhatWasAsked)
{
  GridFrame frame = frameOf(6); // 64 m at level 0 to 1 m at level 6
  frame.startLevel = 2;
  frame.midLevel = 4;
  frame.featureLevel = 5;
  SizingOptions options;
  const std::string features = "feature curves, corners and close surfaces ";
  const auto textAfter = [&](int count) {
    SizeSteps steps(frame, {{4, 3, 4, 5}, 2, 2});
    for (int i = 0; i < count; ++i)
    {
      EXPECT_TRUE(steps.giveUpMore(steps.kept().levels, true));
    }
    return steps.text(frame, options);
  };
  EXPECT_EQ(textAfter(1), "SizeMax 8 instead of 4; surfaces, " + features + "have the sizes requested");
  EXPECT_EQ(textAfter(3), "SizeMax 16 instead of 4, CellsPerLevel 1 instead of 2; surfaces, " + features +
                              "have the sizes requested");
  EXPECT_EQ(textAfter(4), textAfter(3)) << "there are no regions";
  EXPECT_THAT(textAfter(5), HasSubstr("2, SizeMid 8 instead of 4; " + features));
  EXPECT_THAT(textAfter(7), HasSubstr(features + "no finer than 4 instead of 2 (SizeMin)"));
  options.boxes = {{{}, 8.0}};
  EXPECT_THAT(textAfter(4), HasSubstr(", RefinementBoxes no finer than 16 instead of 8 away from surfaces;"));
  options.cellsAcrossGap = 2;
  EXPECT_THAT(textAfter(4), HasSubstr("RefinementBoxes and CellsAcrossGap no finer"));
  options.distanceSizes = {{"A", 1.0, 8.0}};
  EXPECT_THAT(textAfter(4), HasSubstr("RefinementBoxes, DistanceSizeRules and CellsAcrossGap no finer"));
  options.surfaceSizes = {{"A", 4.0, {}}};
  EXPECT_THAT(textAfter(5), HasSubstr("surfaces away from feature curves, corners and close surfaces no finer than 8"));
}

} // namespace
