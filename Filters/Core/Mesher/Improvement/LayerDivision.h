// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the conforming layer into boundary layers, as many as leave elements valid.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

#include <optional>

namespace atria {

/// Flattens the outer faces of poor elements of a single layer before it is divided.
void flattenTops(ImproverState& state);

/// Divides a layer and takes layers away where elements stay bad.
class LayerDivision
{
public:
  explicit LayerDivision(ImproverState& state) : state_(state) {}

  /// Divides the layer, then improves it until no element is bad that could lose a layer.
  void run();
  /// Takes layers away at cells after run(), and improves their surroundings. Returns false if there was no layer to
  /// take away.
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
  /// The single layer before division, and with its outermost points where they are now.
  LayerMesh given_;
  LayerMesh one_;
  /// One entry per point of the plain mesh each: layers wanted; layers it has; 1 if it is back where it was in
  /// `given_`, to stay.
  std::vector<Index> wanted_;
  std::vector<Index> counts_;
  std::vector<char> held_;
};

/// Moves points of layers to the requested heights where cells stay sound: whole layers first, then the points within
/// them. Does nothing if no first height is requested.
void restoreHeights(ImproverState& state);

} // namespace atria
