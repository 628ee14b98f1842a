// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RunContext.h"
#include "Support/Types.h"

#include <span>

namespace atria {

/// Where the points of a mesh may go.
class VertexGuide
{
public:
  virtual ~VertexGuide() = default;
  /// Told which points are about to be moved.
  virtual void prepare(std::span<const Index> /*points*/, const RunContext& /*context*/) {}
  /// Whether the point may move at all.
  virtual bool isMovable(Index point) const = 0;
  /// Points with the same leader are in one place and move as one.
  virtual Index leaderOf(Index point) const { return point; }
  /// The allowed place nearest to p. Called by several threads, but for one point by one at a time.
  virtual Vec3 place(Index point, const Vec3& p) const = 0;
};

} // namespace atria
