// SPDX-License-Identifier: GPL-3.0-or-later
/// What ranks tell each other of a mesh with layers.
#pragma once

#include "Layer/LayerTopology.h"
#include "Mesher/Improvement/ElementsToLeaveOut.h"
#include "Ranks/SharedWindow.h"

namespace atria {

/// An element of a mesh with layers: the grid point it stands for, or the grid point, direction and height of the
/// element, its face, and the place in the stack there.
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
  /// All must outlive this; `plain` is the window's mesh.
  SharedLayers(const SharedWindow& window, const DualMesh& plain, const LayerMesh& layer);

  SharedElement elementOf(Index element) const;
  bool isOwn(Index element) const { return window_.isOwn(plainElementOf(element)); }
  /// noIndex where it is not here.
  Index find(const SharedElement& element) const;
  /// The element of the plain mesh that it is or stands on.
  Index plainElementOf(Index element) const;
  /// Of the plain mesh.
  Index find(const SharedPoint& point) const { return window_.find(point); }
  const SharedPoint& wallPointOf(Index point) const { return window_.points[layer_.wallPointOf(point)]; }

private:
  const SharedWindow& window_;
  const DualMesh& plain_;
  const LayerMesh& layer_;
};

/// See findElementsToLeaveOut. Elements are looked at up to so many rows from own ones, but for those where the window
/// ends, in faces with the tag `cutTag`.
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
