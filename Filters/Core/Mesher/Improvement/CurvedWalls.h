// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes what is valid good at curved walls, where angles are to be small.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

/// For a single layer of no asked height.
class CurvedWalls
{
public:
  /// Finds how walls turn from face to face at points.
  CurvedWalls(ImproverState& state, const CurvedWallTargets& wanted);

  /// Whether there are none.
  bool isEmpty() const { return curved_.empty(); }
  /// Makes the layer thicker there as far as no cell falls short by it.
  void thicken();
  /// Brings elements there to what is wanted: all hexahedra, and what else is far from it where all walls are smooth.
  void improve();

private:
  /// How walls turn at a point, as bits.
  enum Bend : std::uint8_t
  {
    straight = 0,
    curved = 1, ///< as a curved wall does
    edged = 2   ///< as at an edge; with `curved`, as a wall that is curved but not smooth, or meets another
  };

  bool isAwayFromCreases(Index cell) const;
  bool hasCurved(Index cell) const;
  bool isAtCurved(Index cell) const;
  bool isHexahedronAtCurved(Index cell) const;
  bool isAtSmooth(Index cell) const;
  std::vector<Index> pointsAtCurved() const;
  void takeBack(std::vector<WantedPlace> thick);
  std::vector<ShortCell> farAtSmooth(const QualityTargets& wanted, float share);
  void bringClose();

  ImproverState& state_;
  CurvedWallTargets wanted_;
  /// By point of the plain mesh; empty where no wall is curved.
  std::vector<std::uint8_t> curved_;
};

} // namespace atria
