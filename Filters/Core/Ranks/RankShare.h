// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a mesh that one of several ranks makes.
#pragma once

#include "Octree/Sizing/Refinement.h"
#include "Octree/Tree/OctreeBlocks.h"
#include "Support/RankExchange.h"

#include <algorithm>
#include <utility>

namespace atria {

/// A grid point by the first leaf that has it as a corner, and that corner. It is the same on all ranks, in the order
/// of points.
using PointKey = std::uint64_t;

/// Width, in rows of leaves, of the halo in which a rank's octree is that of the whole: `atWalls` around own leaves at
/// walls and `beside` around all own leaves, then `beside` more around all of these. So elements at the rank's leaves
/// are those of the whole. The numbers were found by trial. If they are too small, ranks throw RanksDisagree.
struct ShareRows
{
  int atWalls = 4;
  int beside = 2;

  ShareRows times(int factor) const { return {factor * atWalls, factor * beside}; }
};

/// Each rank has a run of blocks of the octree that cost as much as those of others. It makes its own octree: that of
/// the whole in these blocks and some rows around them, coarser elsewhere.
class RankShare
{
public:
  /// Cost of a leaf at the model, in leaves that are not: elements of its layers, and places for its vertices.
  static constexpr std::size_t wallCost = 8;

  /// Divides the octree with the balanced sets `refined`. These must outlive this; so must `frame` and `exchange`.
  RankShare(const RefinedSets& refined, const SurfaceModel& model, const GridFrame& frame, std::size_t blockSize,
            RankExchange& exchange, const RunContext& context);

  RankExchange& exchange() const { return exchange_; }
  int rank() const { return exchange_.rank(); }
  int ranks() const { return exchange_.ranks(); }
  const OctreeBlocks& blocks() const { return blocks_; }
  /// Return the first block of this rank, and the one after its last.
  Index firstBlock() const { return firstBlocks_[static_cast<std::size_t>(rank())]; }
  Index endBlock() const { return firstBlocks_[static_cast<std::size_t>(rank()) + 1]; }
  /// Makes the rank's octree, whose leaves know their pieces of the model.
  Octree makeOctree(const SurfaceModel& model, const ShareRows& rows, const RunContext& context) const;
  /// Makes an octree in which the given leaves of the whole are as there. So are the leaves around them, as far as
  /// vertices of the given leaves search pieces of the model. `leaves` are keys in the finest grid.
  Octree makeOctree(const std::vector<MortonKey>& leaves, const SurfaceModel& model, const RunContext& context) const;

  int rankOfBlock(Index block) const;
  /// Returns the rank of a leaf, by its key in the finest grid.
  int rankOf(MortonKey key) const { return rankOfBlock(blocks_.blockOf(key)); }
  const MortonRange& own() const { return own_; }
  bool isOwn(MortonKey key) const { return key >= own_.begin && key < own_.end; }

  /// True if a leaf of this rank's octree is one of the whole.
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

/// Key of points and elements that are not part of the whole.
inline constexpr PointKey noKey = ~PointKey{0};

inline bool isOwn(PointKey key, const RankShare& share) { return key != noKey && share.isOwn(key >> 3); }

/// Returns the range of own keys, which follow each other in a list: the first, and the one after the last.
template <typename Keys> std::pair<Index, Index> ownRange(const Keys& keys, const RankShare& share)
{
  const auto isOfShare = [&](PointKey key) { return isOwn(key, share); };
  const auto first = std::ranges::find_if(keys, isOfShare);
  const auto end = std::find_if_not(first, keys.end(), isOfShare);
  return {static_cast<Index>(first - keys.begin()), static_cast<Index>(end - keys.begin())};
}

/// Returns the number of a key in a list whose own keys, from `first` up to `end`, rise. Throws RanksDisagree if it is
/// none of these.
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
