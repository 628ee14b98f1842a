// SPDX-License-Identifier: GPL-3.0-or-later
/// Exchanges which elements are near the boundary, across ranks.
#pragma once

#include "Mesher/Blocks/MeshBlocks.h"
#include "Ranks/PlainShare.h"

namespace atria {

/// Exchange between ranks of what is near the boundary of their mesh. Each exchange sends a byte for each element
/// beside a share, and for each vertex of another rank.
class SharedNear : public NearExchange
{
public:
  /// Both arguments must outlive this. Takes 8 bytes an element beside the share, and as many for a vertex of another
  /// rank.
  SharedNear(const PlainShare& own, const RankShare& share);

  bool isOwn(Index element) const override { return own_.isOwn(element); }
  std::vector<Index> takeElements(std::vector<std::uint8_t>& values) const override;
  void takeVertices(std::vector<char>& values) const override;
  bool isAny(bool own) const override { return isAnywhere(own, exchange_); }

private:
  using Lists = std::vector<std::vector<Index>>;
  template <typename T> std::vector<Index> take(const Lists& ours, const Lists& theirs, std::vector<T>& values) const;

  const PlainShare& own_;
  RankExchange& exchange_;
  /// One list per rank: what this rank has of the other, and what the other has of this one, in the same order on both.
  Lists theirElements_;
  Lists ourElements_;
  Lists theirVertices_;
  Lists ourVertices_;
};

} // namespace atria
