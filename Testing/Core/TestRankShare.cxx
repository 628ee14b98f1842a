// SPDX-License-Identifier: GPL-3.0-or-later
/// What of an octree each of several ranks has.
#include "Ranks/RankShare.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace atria;
using namespace atria::testing;

/// A soup at one end of a long domain, where nearly all walls are.
Meshed meshSoupAtOneEnd(unsigned seed)
{
  GridOptions grid;
  grid.domain = {Vec3(-4.3, -4.3, -4.3), Vec3(28.1, 4.1, 4.1)};
  grid.sizeMin = 0.25;
  grid.sizeMid = 0.5;
  grid.sizeMax = 0.5;
  return meshIt(randomSoup(seed), grid);
}

std::vector<std::size_t> costsOf(const OctreeBlocks& blocks, const Octree& octree)
{
  std::vector<std::size_t> costs(blocks.count(), 0);
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    if (octree.inDomain(leaf))
    {
      costs[blocks.blockOf(octree.finestKey(leaf))] += octree.items(leaf).empty() ? 1 : RankShare::wallCost;
    }
  }
  return costs;
}

TEST(RankShare, SharesCostTheSameButForABlock)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const Meshed whole = meshSoupAtOneEnd(seed);
    const RefinedSets sets = whole.octree.refinedSets();
    for (const int ranks : {2, 3, 5})
    {
      SCOPED_TRACE(ranks);
      onRanks(ranks, [&](RankExchange& exchange) {
        const RankShare share(sets, whole.model, whole.frame, 500, exchange, quietContext());
        const std::vector<std::size_t> costs = costsOf(share.blocks(), whole.octree);
        const std::size_t all = std::accumulate(costs.begin(), costs.end(), std::size_t{0});
        const std::size_t own =
            std::accumulate(costs.begin() + share.firstBlock(), costs.begin() + share.endBlock(), std::size_t{0});
        EXPECT_NEAR(static_cast<double>(own), static_cast<double>(all) / ranks,
                    static_cast<double>(*std::ranges::max_element(costs)));
      });
    }
  }
}

} // namespace
