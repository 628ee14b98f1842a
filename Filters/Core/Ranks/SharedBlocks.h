// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/Blocks/BlockExchange.h"
#include "Ranks/SharedWindow.h"

namespace atria {

/// What blocks on several ranks tell each other. Points and elements are those of the rank's window. What becomes of a
/// point goes to the rank that owns it, and from there to all that have it.
class SharedBlocks : public BlockExchange
{
public:
  /// `plain` is the window's mesh. All must outlive this.
  SharedBlocks(const SharedWindow& window, const DualMesh& plain, const RankShare& share);

  /// Puts points of other ranks where these have them, with how far they may go from there: stages before may reach
  /// farther than what is about a share.
  void takePlaces(std::vector<Vec3>& points, std::unordered_map<Index, DisplacementLimit>& limits) const;
  std::vector<std::vector<Index>> allTouching(const std::vector<std::vector<Index>>& own) override;
  PointChanges allChanges(const PointChanges& own) override;
  std::vector<PoorElement> allPoor(const std::vector<PoorElement>& own) override;
  bool isAny(bool own) override;

private:
  /// Points that this rank and another one have, in the same order on both; and the places in this list by rising
  /// point.
  struct SharedList
  {
    std::vector<Index> points;
    std::vector<Index> places;

    void sortPlaces();
    /// noIndex for points that are not in it.
    Index placeOf(Index point) const;
  };

  std::vector<PointChanges> sendChanges(const PointChanges& changes, const std::vector<SharedList>& to,
                                        const std::vector<SharedList>& from) const;

  const SharedWindow& window_;
  const DualMesh& plain_;
  RankExchange& exchange_;
  /// By rank, this one's points that are that one's own, and that one's points that are this one's own.
  std::vector<SharedList> theirs_;
  std::vector<SharedList> ours_;
};

} // namespace atria
