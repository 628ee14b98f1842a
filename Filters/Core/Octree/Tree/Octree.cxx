// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/Octree.h"

#include "Support/Error.h"

#include <algorithm>
#include <atomic>

namespace atria {

namespace {

/// Returns the first refined octant of each level, and the end.
std::vector<Index> beginsOf(const RefinedSets& refined)
{
  std::vector<Index> begins{0};
  for (const auto& set : refined)
  {
    begins.push_back(begins.back() + static_cast<Index>(set.size()));
  }
  return begins;
}

constexpr std::size_t grain = 4096;

/// Links refined octants of level l to those of level l + 1; children that are not refined stay marked as leaves.
void linkLevel(std::span<const MortonKey> parents, std::span<const MortonKey> next, Index nextBegin,
               std::span<std::array<Octree::Node, 8>> children, const Executor& executor)
{
  std::atomic<std::size_t> linked{0};
  executor.forRanges(parents.size(), grain, [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<std::size_t>(std::ranges::lower_bound(next, parents[begin] << 3) - next.begin());
    std::size_t j = first;
    for (std::size_t i = begin; i < end; ++i)
    {
      for (unsigned k = 0; k < 8; ++k)
      {
        const bool refined = j < next.size() && next[j] == (parents[i] << 3 | k);
        children[i][k] = refined ? nextBegin + static_cast<Index>(j++) : Octree::leafBit;
      }
    }
    linked += j - first;
  });
  if (linked != next.size())
  {
    throw Error("the octree is broken: an octant is refined although its parent is not");
  }
}

} // namespace

Octree::Octree(const GridFrame& frame, const RefinedSets& refined, const Executor& executor)
    : frame_(frame), levelBegins_(beginsOf(refined))
{
  if (refined.empty() || refined[0].empty())
  {
    keys_ = {0};
    levels_ = {0};
    return;
  }
  children_.resize(levelBegins_.back());
  const int levelCount = static_cast<int>(refined.size());
  if (levelCount > frame.depth)
  {
    throw Error("the octree is broken: octants are refined below the finest level");
  }
  for (int l = 0; l < levelCount; ++l)
  {
    linkLevel(refined[l], l + 1 < levelCount ? std::span(refined[l + 1]) : std::span<const MortonKey>(),
              levelBegins_[l + 1], std::span(children_).subspan(levelBegins_[l], refined[l].size()), executor);
  }
  numberLeaves(refined, executor);
  root_ = 0;
}

/// Counts the leaves below each refined octant from the finest level up, and numbers them from the root down.
void Octree::numberLeaves(const RefinedSets& refined, const Executor& executor)
{
  Buffer<Index> below(children_.size());
  for (std::size_t l = refined.size(); l-- > 0;)
  {
    executor.forEach(refined[l].size(), grain, [&](std::size_t i) {
      Index count = 0;
      for (const Node child : children_[levelBegins_[l] + i])
      {
        count += isLeaf(child) ? 1 : below[child];
      }
      below[levelBegins_[l] + i] = count;
    });
  }
  keys_.resize(below[0]);
  levels_.resize(below[0]);
  Buffer<Index> firstLeaf(children_.size());
  firstLeaf[0] = 0;
  for (std::size_t l = 0; l < refined.size(); ++l)
  {
    const int level = static_cast<int>(l) + 1;
    executor.forEach(refined[l].size(), grain, [&](std::size_t i) {
      Index leaf = firstLeaf[levelBegins_[l] + i];
      auto& family = children_[levelBegins_[l] + i];
      for (unsigned k = 0; k < 8; ++k)
      {
        if (!isLeaf(family[k]))
        {
          firstLeaf[family[k]] = leaf;
          leaf += below[family[k]];
          continue;
        }
        keys_[leaf] = (refined[l][i] << 3 | k) << (3 * (frame_.depth - level));
        levels_[leaf] = static_cast<std::uint8_t>(level);
        family[k] = leafBit | leaf++;
      }
    });
  }
}

int Octree::maximumLevel() const { return levels_.empty() ? 0 : *std::max_element(levels_.begin(), levels_.end()); }

Octree::Node Octree::nodeAt(MortonKey key, int level) const
{
  Node node = root_;
  for (int l = 1; l <= level && !isLeaf(node); ++l)
  {
    node = children_[node][key >> (3 * (level - l)) & 7];
  }
  return node;
}

Index Octree::leafAt(const LatticePoint& p) const
{
  GridCell cell;
  for (int axis = 0; axis < 3; ++axis)
  {
    cell[axis] = static_cast<std::uint32_t>(p[axis] >> frame_.subBits);
  }
  return leafOf(nodeAt(mortonKey(cell), frame_.depth));
}

LatticePoint Octree::cornerOf(Index leaf, unsigned which) const
{
  const GridCell cell = anchor(leaf);
  const std::int64_t size = frame_.latticeSize(levels_[leaf]);
  return {(std::int64_t{cell[0]} << frame_.subBits) + (which & 1 ? size : 0),
          (std::int64_t{cell[1]} << frame_.subBits) + (which & 2 ? size : 0),
          (std::int64_t{cell[2]} << frame_.subBits) + (which & 4 ? size : 0)};
}

Vec3 Octree::center(Index leaf) const
{
  const double half = 0.5 * frame_.sizeOf(levels_[leaf]);
  return frame_.toModel(lowCorner(leaf)) + Vec3::Constant(half);
}

bool Octree::inDomain(Index leaf) const
{
  const LatticePoint low = lowCorner(leaf);
  const LatticePoint high = highCorner(leaf);
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    inside = inside && low[axis] < frame_.domainHigh[axis] && high[axis] > frame_.domainLow[axis];
  }
  return inside;
}

void Octree::setItems(std::vector<Index> offsets, std::vector<ModelItem> items, std::vector<FeatureType> types)
{
  itemOffsets_ = std::move(offsets);
  items_ = std::move(items);
  featureTypes_ = std::move(types);
}

RefinedSets Octree::refinedSets() const
{
  RefinedSets sets(levelBegins_.empty() ? 0 : levelBegins_.size() - 1);
  if (isLeaf(root_))
  {
    return sets;
  }
  sets[0] = {0};
  for (std::size_t l = 0; l + 1 < sets.size(); ++l)
  {
    for (std::size_t i = 0; i < sets[l].size(); ++i)
    {
      for (unsigned k = 0; k < 8; ++k)
      {
        if (!isLeaf(children_[levelBegins_[l] + i][k]))
        {
          sets[l + 1].push_back(sets[l][i] << 3 | k);
        }
      }
    }
  }
  return sets;
}

} // namespace atria
