// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sets of octants under a limit.
#include "Octree/Sizing/ElementBudget.h"
#include "Octree/Sizing/Estimate.h"
#include "Octree/Sizing/OctantSets.h"
#include "Octree/Tree/Balance.h"
#include "SizingFrame.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::HasSubstr;

/// Octants added one list after the other.
struct Added
{
  int level;
  std::vector<MortonKey> keys;
  OctantNeed need;
};

/// What is left of added octants under a limit.
struct Left
{
  RefinedSets refined;
  std::string warning;
};

Left addAll(const GridFrame& frame, const std::vector<Added>& lists, std::size_t limit)
{
  const SurfaceModel model;
  SizingOptions options;
  options.maxElements = limit;
  ElementBudget budget(model, frame, options);
  OctantSets sets(frame, {{4, 4, 4, 4}, 1, frame.startLevel}, options, budget);
  EXPECT_EQ(sets.isLimited(), limit > 0);
  for (const Added& added : lists)
  {
    sets.add(added.level, added.keys, std::vector<OctantNeed>(added.keys.size(), added.need), quietContext());
  }
  Left left;
  left.refined = sets.balanced(
      [&](RefinedSets& all, int cellsPerLevel) { balance(all, frame, quietContext(), cellsPerLevel); }, quietContext());
  while (left.refined.back().empty())
  {
    left.refined.pop_back();
  }
  left.warning = sets.warning();
  return left;
}

std::size_t elementsOf(const RefinedSets& refined, const GridFrame& frame)
{
  return countElements(refined, false, frame, quietContext());
}

const Added root{0, {0}, OctantNeed::open};
const std::vector<MortonKey> allEight{0, 1, 2, 3, 4, 5, 6, 7};

TEST(OctantSets, AreTheUnionOfWhatSourcesAdd)
{
  const GridFrame frame = frameOf(4);
  for (unsigned one = 0; one < 256; one += 3)
  {
    const unsigned other = (one * 77 + 13) % 256;
    const auto keysOf = [](unsigned bits) {
      std::vector<MortonKey> keys;
      std::ranges::copy_if(allEight, std::back_inserter(keys), [&](MortonKey key) { return (bits >> key & 1) != 0; });
      return keys;
    };
    const Left left =
        addAll(frame, {root, {1, keysOf(one), OctantNeed::region}, root, {1, keysOf(other), OctantNeed::surface}}, 0);
    const std::vector<MortonKey> both = keysOf(one | other);
    ASSERT_EQ(left.refined.size(), both.empty() ? 1U : 2U);
    EXPECT_EQ(left.refined.back(), both.empty() ? root.keys : both);
    EXPECT_EQ(left.warning, "");
  }
}

TEST(OctantSets, GiveUpTheWeakestNeedInAnyOrderAndKeepToTheLimit)
{
  GridFrame frame = frameOf(4);
  frame.startLevel = 1;
  const RefinedSets wanted{{0}, {1, 4, 6}};
  const std::size_t limit = elementsOf(wanted, frame);
  const Added open{1, allEight, OctantNeed::open};
  const Added strong{1, wanted[1], OctantNeed::surface};
  for (const std::vector<Added>& lists : {std::vector<Added>{root, open, strong}, {root, strong, open}})
  {
    const Left left = addAll(frame, lists, limit);
    EXPECT_EQ(left.refined, wanted);
    EXPECT_THAT(left.warning, HasSubstr("MaxElements " + std::to_string(limit)));
    EXPECT_THAT(left.warning, HasSubstr("up to " + std::to_string(limit) + " elements"));
    EXPECT_EQ(addAll(frame, lists, limit - 1).refined, RefinedSets{{0}});
    const std::size_t all = elementsOf({{0}, allEight}, frame);
    EXPECT_EQ(addAll(frame, lists, all).refined, (RefinedSets{{0}, allEight}));
    EXPECT_EQ(addAll(frame, lists, all).warning, "");
    EXPECT_EQ(addAll(frame, lists, all - 1).refined, wanted);
  }
}

TEST(OctantSets, LeaveOutChildrenOfWhatTheyLeaveOut)
{
  GridFrame frame = frameOf(4);
  frame.startLevel = 1;
  const RefinedSets wanted{{0}, {7}, {63}};
  const Left left = addAll(frame,
                           {root,
                            {1, {0}, OctantNeed::open},
                            {2, {0}, OctantNeed::feature},
                            {1, {7}, OctantNeed::surface},
                            {2, {63}, OctantNeed::feature}},
                           elementsOf(wanted, frame));
  EXPECT_EQ(left.refined, wanted);
}

TEST(OctantSets, AreRefusedWhereTheStartLevelIsTooMuch)
{
  std::vector<MortonKey> keys(64);
  std::iota(keys.begin(), keys.end(), MortonKey{0});
  const std::vector<Added> lists{root, {1, allEight, OctantNeed::open}, {2, keys, OctantNeed::open}};
  for (const auto& [level, reason] : std::map<int, std::string>{{2, "the domain's shortest side"}, {3, "StartLevel"}})
  {
    GridFrame frame = frameOf(4);
    frame.startLevel = level;
    RefinedSets wanted{{0}, allEight, keys};
    wanted.resize(static_cast<std::size_t>(level));
    const std::size_t least = elementsOf(wanted, frame);
    EXPECT_EQ(addAll(frame, lists, least).refined, wanted);
    try
    {
      addAll(frame, lists, least - 1);
      FAIL() << "not refused";
    }
    catch (const Error& error)
    {
      const std::string limit = "MaxElements " + std::to_string(least - 1);
      EXPECT_THAT(error.what(), HasSubstr(reason + " asks for, make more than " + limit));
    }
  }
}

} // namespace
