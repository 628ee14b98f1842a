// SPDX-License-Identifier: GPL-3.0-or-later
/// What ranks know of each other's grid points, against the whole grid.
#include "Dual/Zones/Zones.h"
#include "Ranks/SharedPoints.h"
#include "Support/GlobalCount.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr std::size_t blockSize = 500;

/// The grid of an octree, its crossings and zones.
struct Grid
{
  Grid(const Octree& tree, const SurfaceModel& model)
      : octree(tree), points(findGridPoints(tree, quietContext())),
        crossings(findCrossings(GridPlaces(tree, points), model, quietContext()))
  {
  }

  LatticePoint at(Index point) const { return positionOf(octree, points.leaves[point]); }

  const Octree& octree;
  GridPoints points;
  Crossings crossings;
};

/// A soup at one end of a long domain, so that ranks have parts of the octree.
Meshed meshLongDomain(unsigned seed)
{
  GridOptions grid;
  grid.domain = {Vec3(-4.3, -4.3, -4.3), Vec3(28.1, 4.1, 4.1)};
  grid.sizeMin = grid.sizeMid = 0.25;
  grid.sizeMax = 0.5;
  return meshIt(randomSoup(seed), grid);
}

class SharedPointsTest : public ::testing::TestWithParam<int>
{
protected:
  /// Calls `test(part, grid, first)` on all ranks; `first` is the number in the whole of the rank's first own point.
  template <typename Test> void onAll(const Meshed& whole, Test&& test) const
  {
    const RefinedSets sets = whole.octree.refinedSets();
    onRanks(GetParam(), [&](RankExchange& exchange) {
      const RankShare share(sets, whole.model, whole.frame, blockSize, exchange, quietContext());
      const Octree octree = share.makeOctree(whole.model, ShareRows{}, quietContext());
      const Grid grid(octree, whole.model);
      const SharedPoints part(share, octree, grid.points, quietContext());
      test(part, grid, static_cast<Index>(countBefore(part.points().size(), exchange).before));
    });
  }
};

/// Numbers in the whole grid of all points that a rank knows; -1 for others.
std::vector<std::int32_t> numbersOf(const GridPart& part, std::size_t points, Index first)
{
  std::vector<std::int32_t> numbers(points, 0);
  std::iota(numbers.begin() + part.points().begin, numbers.begin() + part.points().end,
            static_cast<std::int32_t>(first));
  part.refresh(numbers, -1);
  return numbers;
}

TEST_P(SharedPointsTest, EveryPointHasOneOwnerAndIsKnownAsThereElsewhere)
{
  const Meshed whole = meshLongDomain(3);
  const Grid grid(whole.octree, whole.model);
  std::atomic<std::size_t> own = 0;
  std::atomic<std::size_t> ofOthers = 0;
  onAll(whole, [&](const SharedPoints& part, const Grid& ofRank, Index first) {
    own += part.points().size();
    const std::vector<std::int32_t> numbers = numbersOf(part, ofRank.points.size(), first);
    std::size_t wrong = 0;
    for (Index point = 0; point < numbers.size(); ++point)
    {
      wrong += numbers[point] >= 0 && ofRank.at(point) != grid.at(static_cast<Index>(numbers[point])) ? 1 : 0;
      ofOthers += numbers[point] >= 0 && !part.owns(point) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U);
  });
  EXPECT_EQ(own, grid.points.size());
  EXPECT_EQ(ofOthers > 0, GetParam() > 1);
}

TEST_P(SharedPointsTest, ValuesReachTheOwnersOfTheirPoints)
{
  const Meshed whole = meshLongDomain(4);
  std::atomic<std::size_t> sent = 0;
  std::atomic<std::size_t> received = 0;
  onAll(whole, [&](const SharedPoints& part, const Grid& ofRank, Index first) {
    const std::vector<std::int32_t> numbers = numbersOf(part, ofRank.points.size(), first);
    std::vector<AtPoint<std::int32_t>> values;
    for (Index point = 0; point < numbers.size(); ++point)
    {
      if (numbers[point] >= 0)
      {
        values.push_back({point, numbers[point]});
      }
    }
    sent += values.size();
    for (const auto& [point, number] : part.send(values))
    {
      ++received;
      ASSERT_TRUE(part.owns(point));
      ASSERT_EQ(numbers[point], number);
    }
  });
  EXPECT_EQ(received, sent);
}

TEST_P(SharedPointsTest, ZonesAreThoseOfTheWhole)
{
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    SCOPED_TRACE(seed);
    const Meshed whole = meshLongDomain(seed);
    const Grid grid(whole.octree, whole.model);
    const std::size_t surfaces = whole.model.names.size();
    const Zones zones = findZones(grid.crossings, surfaces, GridPart(grid.points), quietContext());
    onAll(whole, [&](const SharedPoints& part, const Grid& ofRank, Index first) {
      const Zones shared = findZones(ofRank.crossings, surfaces, part, quietContext());
      EXPECT_EQ(shared.sizes, zones.sizes);
      EXPECT_EQ(shared.sides, zones.sides);
      EXPECT_EQ(shared.openSides, zones.openSides);
      const std::vector<std::int32_t> numbers = numbersOf(part, ofRank.points.size(), first);
      std::size_t wrong = 0;
      for (Index point = 0; point < numbers.size(); ++point)
      {
        const std::int32_t expected = numbers[point] < 0 ? static_cast<std::int32_t>(zones.count())
                                                         : zones.ofPoint[static_cast<std::size_t>(numbers[point])];
        wrong += shared.ofPoint[point] != expected ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0U);
    });
  }
}

TEST(GridPart, OfAllPointsHasNothingToAsk)
{
  GridPoints points;
  points.leaves.resize(5);
  points.atCorner.resize(3);
  const GridPart part(points);
  EXPECT_TRUE(part.isWhole());
  EXPECT_EQ(part.points().size(), 5U);
  EXPECT_EQ(part.leaves().size(), 3U);
  const PointSets sets{{0, 1, 0, 2, 1}, 3};
  const JoinedSets joined = part.join(sets, [](Index, int) { return noIndex; });
  EXPECT_EQ(joined.count, 3U);
  EXPECT_EQ(joined.ofSet, (std::vector<std::vector<Index>>{{0, 1, 2}}));
  EXPECT_EQ(part.sum(joined, std::vector{2, 2, 1}, [](int more, int& sum) { sum += more; }), (std::vector{2, 2, 1}));
  const auto received = part.send(std::vector<AtPoint<int>>{{4, 7}, {1, 8}});
  ASSERT_EQ(received.size(), 2U);
  EXPECT_EQ(received[0].point, 4U);
  EXPECT_EQ(received[1].value, 8);
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedPointsTest, ::testing::Values(1, 2, 3, 5),
                         [](const auto& one) { return std::to_string(one.param); });

} // namespace
