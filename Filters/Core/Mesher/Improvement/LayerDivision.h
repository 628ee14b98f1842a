// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the conforming layer into boundary layers, as many as elements are valid with.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

#include <optional>

namespace atria {

/// Improves poor elements of a single layer, and those beside it, before it is divided.
void flattenTops(ImproverState& state);

class LayerDivision
{
public:
  explicit LayerDivision(ImproverState& state) : state_(state) {}

  void run();
  /// After that: takes layers away at cells, and improves what is about these. Whether there were some
  /// to take away.
  bool giveWay(const std::vector<ShortCell>& cells);

private:
  void improveUntilSound(std::vector<char> marked);
  std::vector<ShortCell> improve(const std::vector<char>& marked);
  std::optional<std::vector<char>> takeAway(const std::vector<ShortCell>& cells);
  void lower(const std::vector<ShortCell>& cells);
  void lowerNeighbors();
  Index mostOn(const std::array<Index, 4>& points) const;
  bool isHeld(const ShortCell& cell) const;
  void restore(const std::vector<ShortCell>& cells, const std::vector<Index>& counts, std::vector<char>& changed);

  ImproverState& state_;
  /// The layer before it was divided, and with its outermost points as they are now.
  LayerMesh given_;
  LayerMesh one_;
  /// By point of the plain mesh: how many layers are wanted, how many it has, and whether it is back where it was in
  /// `given_`, to stay.
  std::vector<Index> wanted_;
  std::vector<Index> counts_;
  std::vector<char> held_;
};

/// Moves the points of layers whose first height was asked for back to that height, where cells stay sound: the whole
/// of the layers first, else those within them. Does nothing without such layers.
void restoreHeights(ImproverState& state);

} // namespace atria
