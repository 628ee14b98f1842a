// SPDX-License-Identifier: GPL-3.0-or-later
/// The grid points of a rank's octree as a part of the whole grid.
#pragma once

#include "Dual/Grid/GridPart.h"
#include "Ranks/RankShare.h"

namespace atria {

/// A point is known as one of the whole if all of its leaves are leaves of the whole octree. Its owner is the rank that
/// owns its first leaf. Functions throw RanksDisagree if ranks do not know the same points where their shares meet.
class SharedPoints : public GridPart
{
public:
  /// Takes 8 bytes a point. Throws RanksDisagree if the octree ends within the rank's share.
  SharedPoints(const RankShare& share, const Octree& octree, const GridPoints& points, const RunContext& context);

  /// Returns the key of a known point; noKey for others.
  PointKey key(Index point) const { return keys_[point]; }

  JoinedSets join(const PointSets& own, const std::function<Index(Index point, int direction)>& nextTo) const override;
  void refresh(std::vector<std::int32_t>& values, std::int32_t elsewhere) const override;

protected:
  Address addressOf(Index point) const override { return {rankOf(point), keys_[point]}; }
  Index pointAt(std::uint64_t key) const override { return findOwn(keys_, points().begin, points().end, key); }

private:
  /// An own set, and a point of another rank beside it.
  struct Joint
  {
    PointKey key;
    Index set;

    auto operator<=>(const Joint&) const = default;
  };

  SharedPoints(const RankShare& share, const Octree& octree, Buffer<PointKey> keys);
  int rankOf(Index point) const;

  const RankShare& share_;
  Buffer<PointKey> keys_;
};

} // namespace atria
