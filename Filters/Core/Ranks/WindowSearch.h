// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the elements of other ranks that a rank needs around its own.
#pragma once

#include "Mesher/Blocks/MeshBlocks.h"
#include "Ranks/PlainShare.h"

#include <unordered_map>

namespace atria {

/// Finds the elements of other ranks that a rank needs to improve its own and as ghosts: those beside own elements, all
/// among which points of these are improved (WindowRows), and a row around all that. So no window of a block ends where
/// this one does, and elements to leave out near own ones are judged among all their neighbors. Asks ranks for the
/// connections of their elements, row by row; 64 bytes an element.
class WindowSearch
{
public:
  /// `near` has the rows of the whole mesh. All arguments must outlive this.
  WindowSearch(const PlainShare& own, const NearBoundary& near, const RankShare& share);
  /// Returns the keys in rising order.
  std::vector<PointKey> run();

private:
  /// An element of another rank: one entry per face, for the element across it or on the other side of the sheet.
  struct Connections
  {
    std::array<PointKey, 6> beyond;
    std::uint8_t row;
    std::uint8_t sheets; ///< faces on sheets, as bits
  };

  std::vector<PointKey> keysAbout() const;
  std::vector<PointKey> wantedOf(const std::vector<Index>& grown, const std::vector<PointKey>& about) const;
  Connections connectionsOf(Index own) const;
  void addOwn();
  void addFaces(const Connections& connections);
  void fetch(const std::vector<PointKey>& keys);
  void link(Index element, std::size_t direction, Index other);
  void linkBack(Index element, PointKey key, Index other);
  Index numberOf(PointKey key) const;
  std::vector<PointKey> missingBeside(const std::vector<Index>& elements) const;

  const PlainShare& own_;
  const NearBoundary& ofOwn_;
  const RankShare& share_;
  /// Own elements, and then those fetched. This mesh has only what WindowRows needs.
  DualMesh graph_;
  NearBoundary near_;
  std::vector<PointKey> keys_;
  std::vector<Connections> fetched_;
  std::unordered_map<PointKey, Index> numbers_; ///< fetched elements by key
};

} // namespace atria
