// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/OctreeBlocks.h"

#include <numeric>

namespace atria {

namespace {

/// Number of leaves that refining a leaf adds.
constexpr std::size_t leavesOfRefined = 7;

class Divider
{
public:
  Divider(const RefinedSets& sets, const GridFrame& itsFrame, std::size_t limit)
      : refined(sets), frame(itsFrame), most(limit)
  {
    for (std::size_t level = 0; level < sets.size(); ++level)
    {
      std::ranges::transform(sets[level], std::back_inserter(places),
                             [&](MortonKey key) { return finest(key, static_cast<int>(level)); });
    }
    std::ranges::sort(places);
  }

  OctreeBlocks run()
  {
    out.begins = {0};
    divide(0, 0);
    return std::move(out);
  }

private:
  MortonKey finest(MortonKey key, int level) const { return key << (3 * (frame.depth - level)); }

  std::size_t leavesIn(MortonKey begin, MortonKey end) const
  {
    return 1 + leavesOfRefined * static_cast<std::size_t>(std::ranges::lower_bound(places, end) -
                                                          std::ranges::lower_bound(places, begin));
  }

  bool isRefined(MortonKey key, int level) const
  {
    return level < static_cast<int>(refined.size()) && std::ranges::binary_search(refined[level], key);
  }

  void divide(MortonKey key, int level)
  {
    const MortonKey end = finest(key + 1, level);
    const std::size_t leaves = leavesIn(out.begins.back(), end);
    if (leaves <= most || !isRefined(key, level))
    {
      out.begins.push_back(end);
      out.leaves.push_back(leaves);
      return;
    }
    bool isLastWhole = false; // true if the last child is one block
    for (MortonKey child = key << 3; child < (key + 1) << 3; ++child)
    {
      const std::size_t before = out.count();
      divide(child, level + 1);
      const bool isWhole = out.count() == before + 1;
      if (isWhole && isLastWhole && out.leaves[before - 1] + out.leaves[before] <= most)
      {
        out.leaves[before - 1] += out.leaves[before];
        out.leaves.pop_back();
        out.begins.erase(out.begins.end() - 2);
      }
      isLastWhole = isWhole;
    }
  }

  const RefinedSets& refined;
  const GridFrame& frame;
  std::size_t most;
  std::vector<MortonKey> places; ///< keys of the refined octants in the finest grid, in order
  OctreeBlocks out;
};

} // namespace

OctreeBlocks findBlocks(const RefinedSets& refined, const GridFrame& frame, std::size_t most)
{
  return Divider(refined, frame, most).run();
}

std::vector<Index> divideBlocks(const std::vector<std::size_t>& costs, std::size_t ranks)
{
  const auto all = std::accumulate(costs.begin(), costs.end(), std::size_t{0});
  std::vector<Index> firsts{0};
  std::size_t before = 0;
  for (Index block = 0; block < costs.size(); ++block)
  {
    // A block belongs to the rank whose share holds the block's middle.
    while (firsts.size() < ranks && (2 * before + costs[block]) * ranks > 2 * all * firsts.size())
    {
      firsts.push_back(block);
    }
    before += costs[block];
  }
  const auto count = static_cast<Index>(costs.size());
  firsts.resize(ranks, count);
  for (std::size_t rank = 1; count >= ranks && rank < ranks; ++rank)
  {
    firsts[rank] = std::clamp(firsts[rank], firsts[rank - 1] + 1, count - static_cast<Index>(ranks - rank));
  }
  firsts.push_back(count);
  return firsts;
}

} // namespace atria
