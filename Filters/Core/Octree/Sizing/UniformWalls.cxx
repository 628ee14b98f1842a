// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/UniformWalls.h"

#include "Octree/Sizing/Refinement.h"
#include "Octree/Tree/Balance.h"
#include "Octree/Tree/GeometryLists.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"
#include "Support/UnionFind.h"

#include <algorithm>

namespace atria {

namespace {

/// Numbers of octants off a surface within which there are no larger and no smaller ones. These are the least for
/// which no octant beside finer ones touches an octant that holds a surface.
constexpr int ringsOfLarger = 1;
constexpr int ringsOfSmaller = 2;

/// Looks at the octants near surfaces of an octree.
class WallOctants
{
public:
  WallOctants(const Octree& octree, const SurfaceModel& model, const RunContext& context)
      : octree_(octree), model_(model),
        walls_(chosenNumbers(octree.leafCount(), context.executor,
                             [&](std::size_t leaf) { return isAtWall(static_cast<Index>(leaf)); })),
        near_(walls_.size())
  {
    context.executor.forEach(walls_.size(), 64, [&](std::size_t i) {
      const Index leaf = walls_[i];
      near_[i] = leavesTouching(octree, boxAround(leaf, ringsOfSmaller));
      std::erase_if(near_[i], [&](Index other) { return !octree.inDomain(other); });
    });
  }

  /// Returns the leaves to refine, in order.
  std::vector<Index> toRefine() const
  {
    const std::vector<int> levels = wantedLevels();
    std::vector<Index> leaves;
    for (std::size_t i = 0; i < walls_.size(); ++i)
    {
      const LatticeBox box = boxAround(walls_[i], ringsOfLarger);
      std::ranges::copy_if(near_[i], std::back_inserter(leaves), [&](Index leaf) {
        return octree_.level(leaf) < levels[i] && overlap(box, {octree_.lowCorner(leaf), octree_.highCorner(leaf)});
      });
    }
    sortUnique(leaves);
    return leaves;
  }

private:
  /// Returns a box that touches the octants as large as a leaf that are at most so many rings away.
  LatticeBox boxAround(Index leaf, int rings) const
  {
    const std::int64_t reach = rings * octree_.frame().latticeSize(octree_.level(leaf)) - 1;
    return grown({octree_.lowCorner(leaf), octree_.highCorner(leaf)}, reach);
  }

  bool isAtWall(Index leaf) const
  {
    return std::ranges::any_of(octree_.items(leaf, ModelItem::triangle),
                               [&](ModelItem item) { return !model_.isTurnedSide(item.index); });
  }

  /// Returns the level that each leaf at a wall should have: the finest near the leaves that are connected with it.
  std::vector<int> wantedLevels() const
  {
    UnionFind sets(walls_.size());
    std::vector<int> finest(walls_.size(), 0);
    for (Index i = 0; i < walls_.size(); ++i)
    {
      for (const Index leaf : near_[i])
      {
        finest[i] = std::max(finest[i], octree_.level(leaf));
        const auto wall = std::ranges::lower_bound(walls_, leaf);
        if (wall != walls_.end() && *wall == leaf)
        {
          sets.join(i, static_cast<Index>(wall - walls_.begin()));
        }
      }
    }
    std::vector<int> wanted(walls_.size(), 0);
    for (Index i = 0; i < walls_.size(); ++i)
    {
      wanted[sets.find(i)] = std::max(wanted[sets.find(i)], finest[i]);
    }
    for (Index i = 0; i < walls_.size(); ++i)
    {
      wanted[i] = wanted[sets.find(i)];
    }
    return wanted;
  }

  const Octree& octree_;
  const SurfaceModel& model_;
  std::vector<Index> walls_;
  /// One entry per leaf of `walls_`: the leaves in the domain that are near it.
  std::vector<std::vector<Index>> near_;
};

} // namespace

void makeUniformAtWalls(RefinedSets& refined, const SurfaceModel& model, const GridFrame& frame, int cellsPerLevel,
                        const RunContext& context)
{
  for (;;)
  {
    balance(refined, frame, context, cellsPerLevel, true);
    Octree octree(frame, refined, context.executor);
    locateModel(octree, model, context.part(1.0, 1.0));
    const std::vector<Index> leaves = WallOctants(octree, model, context).toRefine();
    if (leaves.empty())
    {
      return;
    }
    RefinedSets more(static_cast<std::size_t>(octree.maximumLevel())); // no finer than the finest
    for (const Index leaf : leaves)
    {
      more[octree.level(leaf)].push_back(octree.key(leaf));
    }
    for (std::size_t level = 0; level < more.size(); ++level)
    {
      mergeUnique(refined[level], more[level]);
    }
  }
}

} // namespace atria
