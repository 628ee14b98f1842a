// SPDX-License-Identifier: GPL-3.0-or-later
/// Improves valid elements at curved walls until their angles are small.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

/// Improves the elements of a single layer whose height is left to the mesh.
class CurvedWalls
{
public:
  /// Finds how walls turn from face to face at each point.
  CurvedWalls(ImproverState& state, const CurvedWallTargets& wanted);

  /// True if no wall is curved.
  bool isEmpty() const { return curved_.empty(); }
  /// Makes the layer thicker at curved walls, where no cell falls short by that.
  void thicken();
  /// Improves hexahedra at curved walls toward the targets; where all walls are smooth, also the other cells far from
  /// these.
  void improve();

private:
  /// How walls turn at a point, as bits.
  enum Bend : std::uint8_t
  {
    straight = 0,
    curved = 1, ///< like a curved wall
    edged = 2   ///< like an edge; with `curved`, the wall is curved but not smooth, or meets another
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
  /// One entry per point of the plain mesh; empty if no wall is curved.
  std::vector<std::uint8_t> curved_;
};

} // namespace atria
