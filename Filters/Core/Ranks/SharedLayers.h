// SPDX-License-Identifier: GPL-3.0-or-later
/// Identifies elements and points of a mesh with layers across ranks.
#pragma once

#include "Layer/LayerTopology.h"
#include "Mesher/Improvement/ElementsToLeaveOut.h"
#include "Ranks/SharedWindow.h"

namespace atria {

/// An element of a mesh with layers. An element of the plain mesh is known by the grid point it stands for. One of a
/// layer is known by the grid point of the element it stands on, the direction of the face, and its place in the stack.
struct SharedElement
{
  PointKey point;
  /// noIndex for elements of the plain mesh.
  Index height;
  Index direction;

  bool isPlain() const { return height == noIndex; }
  auto operator<=>(const SharedElement&) const = default;
};

/// Elements and points of a rank's mesh with layers.
class SharedLayers
{
public:
  /// All arguments must outlive this; `plain` is the window's mesh.
  SharedLayers(const SharedWindow& window, const DualMesh& plain, const LayerMesh& layer);

  SharedElement elementOf(Index element) const;
  bool isOwn(Index element) const { return window_.isOwn(plainElementOf(element)); }
  /// Returns noIndex if the element is not here.
  Index find(const SharedElement& element) const;
  /// Returns the element of the plain mesh that it is or stands on.
  Index plainElementOf(Index element) const;
  /// Returns the number of a point of the plain mesh; noIndex if it is not here.
  Index find(const SharedPoint& point) const { return window_.find(point); }
  const SharedPoint& wallPointOf(Index point) const { return window_.points[layer_.wallPointOf(point)]; }

private:
  const SharedWindow& window_;
  const DualMesh& plain_;
  const LayerMesh& layer_;
};

/// Agreement of ranks on the elements to leave out; see findElementsToLeaveOut. Considers elements up to some rows from
/// own ones, except those where the window ends, in faces with the tag `cutTag`.
class SharedLeaveOut : public LeaveOutExchange
{
public:
  SharedLeaveOut(const DualMesh& mesh, const SharedLayers& layers, Index cutTag, RankExchange& exchange);
  bool isSeen(Index element) const override { return seen_[element] != 0; }
  bool isOwn(Index element) const override { return layers_.isOwn(element); }
  std::size_t sum(std::size_t own) override { return countBefore(own, exchange_).all; }
  std::vector<Index> all(const std::vector<Index>& own) override;

private:
  const SharedLayers& layers_;
  RankExchange& exchange_;
  std::vector<char> seen_;
};

} // namespace atria
