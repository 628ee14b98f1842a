// SPDX-License-Identifier: GPL-3.0-or-later
/// What one of several ranks makes of a mesh.
#pragma once

#include "Octree/Sizing/Refinement.h"
#include "Octree/Tree/OctreeBlocks.h"
#include "Support/RankExchange.h"

#include <algorithm>
#include <utility>

namespace atria {

/// A grid point by the first leaf that has it as a corner, and which: the same on all ranks, in the order of points.
using PointKey = std::uint64_t;

/// Rows of leaves that a rank's octree has as the whole does: about the rank's own at walls, and about all of its own;
/// and about all that as many as beside. So elements at its leaves are those of the whole. Found by trying; where they
/// are too few, ranks tell.
struct ShareRows
{
  int atWalls = 4;
  int beside = 2;

  ShareRows times(int factor) const { return {factor * atWalls, factor * beside}; }
};

/// Each rank has blocks of the octree in a row that cost as much as those of others, and makes its own octree: the
/// whole's there and so many rows about it, coarser elsewhere.
class RankShare
{
public:
  /// What a leaf at the model costs, in those that are not: elements of its layers, and places for its vertices.
  static constexpr std::size_t wallCost = 8;

  /// Of the balanced sets of a whole octree, which must outlive this; so must `exchange`.
  RankShare(const RefinedSets& refined, const SurfaceModel& model, const GridFrame& frame, std::size_t blockSize,
            RankExchange& exchange, const RunContext& context);

  RankExchange& exchange() const { return exchange_; }
  int rank() const { return exchange_.rank(); }
  int ranks() const { return exchange_.ranks(); }
  const OctreeBlocks& blocks() const { return blocks_; }
  /// The first of this rank, and the one after its last.
  Index firstBlock() const { return firstBlocks_[static_cast<std::size_t>(rank())]; }
  Index endBlock() const { return firstBlocks_[static_cast<std::size_t>(rank()) + 1]; }
  /// The rank's octree, whose leaves know their pieces of the model.
  Octree makeOctree(const SurfaceModel& model, const ShareRows& rows, const RunContext& context) const;
  /// One in which these leaves of the whole, by their keys in the finest grid, and those about them are as there, so
  /// far as vertices of these leaves look for pieces of the model.
  Octree makeOctree(const std::vector<MortonKey>& leaves, const SurfaceModel& model, const RunContext& context) const;

  int rankOfBlock(Index block) const;
  /// Of a leaf, by its key in the finest grid.
  int rankOf(MortonKey key) const { return rankOfBlock(blocks_.blockOf(key)); }
  const MortonRange& own() const { return own_; }
  bool isOwn(MortonKey key) const { return key >= own_.begin && key < own_.end; }

  /// Whether a leaf of this rank's octree is one of the whole.
  bool isExact(const Octree& octree, Index leaf) const;

private:
  RefinedSets setsNeeded(const SurfaceModel& model, const ShareRows& rows, const RunContext& context) const;
  Octree octreeOf(RefinedSets refined, const SurfaceModel& model, const RunContext& context) const;

  const RefinedSets& whole_;
  const GridFrame& frame_;
  RankExchange& exchange_;
  OctreeBlocks blocks_;
  std::vector<Index> firstBlocks_;
  MortonRange own_;
};

/// Of what is not of the whole.
inline constexpr PointKey noKey = ~PointKey{0};

inline bool isOwn(PointKey key, const RankShare& share) { return key != noKey && share.isOwn(key >> 3); }

/// Where own keys are in a list that has them in a row: the first, and the one after the last.
template <typename Keys> std::pair<Index, Index> ownRange(const Keys& keys, const RankShare& share)
{
  const auto isOfShare = [&](PointKey key) { return isOwn(key, share); };
  const auto first = std::ranges::find_if(keys, isOfShare);
  const auto end = std::find_if_not(first, keys.end(), isOfShare);
  return {static_cast<Index>(first - keys.begin()), static_cast<Index>(end - keys.begin())};
}

/// The number of a key in a list that has own ones from `first` up to `end`, rising. Throws RanksDisagree if it is none
/// of these.
template <typename Keys> Index findOwn(const Keys& keys, Index first, Index end, PointKey key)
{
  const auto last = keys.begin() + end;
  const auto found = std::lower_bound(keys.begin() + first, last, key);
  if (found == last || *found != key)
  {
    throw RanksDisagree("ranks do not have the same mesh where their shares meet");
  }
  return static_cast<Index>(found - keys.begin());
}

} // namespace atria
