// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/RankShare.h"

#include "Octree/Tree/Balance.h"
#include "Octree/Tree/LeafRows.h"

#include <algorithm>
#include <functional>
#include <tuple>

namespace atria {

namespace {

/// Rows of leaves around a leaf in which pieces of the model are searched. The search reaches half the size of the
/// leaf: into leaves that touch it, which may be half as large, and into those that touch these.
constexpr int rowsLookedAt = 2;

LeafMasks both(LeafMasks a, const LeafMasks& b)
{
  std::ranges::transform(a, b, a.begin(), std::bit_and<>());
  return a;
}

LeafMasks any(LeafMasks a, const LeafMasks& b)
{
  std::ranges::transform(a, b, a.begin(), std::bit_or<>());
  return a;
}

/// Returns the cost of each block, in leaves that are not at the model.
std::vector<std::size_t> costsOf(const OctreeBlocks& blocks, const RefinedSets& refined, const SurfaceModel& model,
                                 const GridFrame& frame, const RunContext& context)
{
  if (blocks.count() < 2)
  {
    return blocks.leaves; // the root may be a leaf
  }
  const LeafRows leaves(refined, frame);
  std::vector<std::size_t> costs = leaves.countBetween(blocks.begins, leaves.inDomain());
  const std::vector<std::size_t> atWalls = leaves.countBetween(blocks.begins, leaves.withModel(model, context));
  std::ranges::transform(costs, atWalls, costs.begin(),
                         [](std::size_t all, std::size_t some) { return all + (RankShare::wallCost - 1) * some; });
  return costs;
}

} // namespace

RankShare::RankShare(const RefinedSets& refined, const SurfaceModel& model, const GridFrame& frame,
                     std::size_t blockSize, RankExchange& exchange, const RunContext& context)
    : whole_(refined), frame_(frame), exchange_(exchange), blocks_(findBlocks(refined, frame, blockSize)),
      firstBlocks_(
          divideBlocks(costsOf(blocks_, refined, model, frame, context), static_cast<std::size_t>(exchange.ranks()))),
      own_(MortonRange{blocks_.begins[firstBlock()], blocks_.begins[endBlock()]})
{
}

int RankShare::rankOfBlock(Index block) const
{
  return static_cast<int>(std::ranges::upper_bound(firstBlocks_, block) - firstBlocks_.begin()) - 1;
}

Octree RankShare::makeOctree(const SurfaceModel& model, const ShareRows& rows, const RunContext& context) const
{
  return octreeOf(setsNeeded(model, rows, context), model, context);
}

Octree RankShare::makeOctree(const std::vector<MortonKey>& leaves, const SurfaceModel& model,
                             const RunContext& context) const
{
  if (blocks_.count() < 2)
  {
    return octreeOf(whole_, model, context);
  }
  const LeafRows rows(whole_, frame_);
  return octreeOf(rows.setsOf(rows.grow(rows.of(leaves), rowsLookedAt, rows.inDomain())), model, context);
}

Octree RankShare::octreeOf(RefinedSets refined, const SurfaceModel& model, const RunContext& context) const
{
  balance(refined, frame_, context);
  Octree octree(frame_, refined, context.executor);
  release(refined);
  locateModel(octree, model, context);
  return octree;
}

/// Returns the sets of the own leaves and of those around them that are to be as in the whole.
RefinedSets RankShare::setsNeeded(const SurfaceModel& model, const ShareRows& rows, const RunContext& context) const
{
  if (blocks_.count() < 2)
  {
    return whole_; // it is small, and its root may be a leaf
  }
  const LeafRows leaves(whole_, frame_);
  const LeafMasks& anywhere = leaves.inDomain();
  const LeafMasks own = leaves.in(own_);
  const LeafMasks atWalls = leaves.grow(leaves.withSurfaces(model, context), 1, anywhere);
  const LeafMasks window = leaves.grow(both(own, atWalls), rows.atWalls, anywhere);
  const LeafMasks beside = leaves.grow(own, rows.beside, anywhere);
  return leaves.setsOf(leaves.grow(any(window, beside), rows.beside, anywhere));
}

bool RankShare::isExact(const Octree& octree, Index leaf) const
{
  const auto level = static_cast<std::size_t>(octree.level(leaf));
  return level >= whole_.size() || !std::ranges::binary_search(whole_[level], octree.key(leaf));
}

} // namespace atria
