// SPDX-License-Identifier: GPL-3.0-or-later
/// Exchanges what becomes of points while blocks are improved on several ranks.
#pragma once

#include "Mesher/Blocks/BlockExchange.h"
#include "Ranks/SharedWindow.h"

namespace atria {

/// Exchange between blocks on several ranks. Points and elements are those of the rank's window. The change of a point
/// goes to the rank that owns it, and from there to all that have it.
class SharedBlocks : public BlockExchange
{
public:
  /// `plain` is the window's mesh. All arguments must outlive this.
  SharedBlocks(const SharedWindow& window, const DualMesh& plain, const RankShare& share);

  /// Moves points of other ranks to where their owners have them, and takes the limits of their displacement. Earlier
  /// stages may depend on more than the rows around a share.
  void takePlaces(std::vector<Vec3>& points, std::unordered_map<Index, DisplacementLimit>& limits) const;
  std::vector<std::vector<Index>> allTouching(const std::vector<std::vector<Index>>& own) override;
  PointChanges allChanges(const PointChanges& own) override;
  std::vector<PoorElement> allPoor(const std::vector<PoorElement>& own) override;
  bool isAny(bool own) override;

private:
  /// Points that this rank and another one have, in the same order on both; `places` are the places in this list,
  /// sorted by point.
  struct SharedList
  {
    std::vector<Index> points;
    std::vector<Index> places;

    void sortPlaces();
    /// Returns noIndex for points that are not in the list.
    Index placeOf(Index point) const;
  };

  std::vector<PointChanges> sendChanges(const PointChanges& changes, const std::vector<SharedList>& to,
                                        const std::vector<SharedList>& from) const;

  const SharedWindow& window_;
  const DualMesh& plain_;
  RankExchange& exchange_;
  /// One list per rank: points here that the other rank owns, and own points that the other rank has.
  std::vector<SharedList> theirs_;
  std::vector<SharedList> ours_;
};

} // namespace atria
