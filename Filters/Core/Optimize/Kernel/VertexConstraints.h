// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RunContext.h"
#include "Support/Types.h"

#include <array>
#include <span>

namespace atria {

/// Directions a point may go in, of length 1 and at right angles to each other.
struct Ways
{
  std::array<Vec3, 3> along{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  int count = 3;
};

/// Where the points of a mesh may go.
class VertexConstraints
{
public:
  virtual ~VertexConstraints() = default;
  /// Told which points are about to be moved.
  virtual void prepare(std::span<const Index> /*points*/, const RunContext& /*context*/) {}
  /// Whether the point may move at all.
  virtual bool isMovable(Index point) const = 0;
  /// Points with the same leader move as one: each goes its share of the leader's way. The leader's own share is 1.
  virtual Index leaderOf(Index point) const { return point; }
  virtual double shareOf(Index /*point*/) const { return 1.0; }
  /// The allowed place nearest to p. Called by several threads, but for one point by one at a time.
  virtual Vec3 place(Index point, const Vec3& p) const = 0;
  /// The ways a point that is at p, an allowed place, may go by as little as `step`. As `place`, by which they are
  /// found unless other constraints know better.
  virtual Ways waysFrom(Index point, const Vec3& p, double step) const;
};

} // namespace atria
