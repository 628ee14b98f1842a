// SPDX-License-Identifier: GPL-3.0-or-later
/// Interface that limits where the points of a mesh may move.
#pragma once

#include "Support/RunContext.h"
#include "Support/Types.h"

#include <array>
#include <span>

namespace atria {

/// Directions in which a point may move: orthogonal unit vectors, of which the first `count` are valid.
struct Ways
{
  std::array<Vec3, 3> along{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  int count = 3;
};

/// Limits where the points of a mesh may move.
class VertexConstraints
{
public:
  virtual ~VertexConstraints() = default;
  /// Called with points before they are moved.
  virtual void prepare(std::span<const Index> /*points*/, const RunContext& /*context*/) {}
  /// Returns true if the point may move at all.
  virtual bool isMovable(Index point) const = 0;
  /// Returns the leader of a point. Points with the same leader move together: each moves by its share of the leader's
  /// displacement. The leader's own share is 1.
  virtual Index leaderOf(Index point) const { return point; }
  virtual double shareOf(Index /*point*/) const { return 1.0; }
  /// Returns the allowed position nearest to p, or one near it. Several threads call it, each for another point.
  virtual Vec3 place(Index point, const Vec3& p) const = 0;
  /// Returns the directions in which a point at p, an allowed position, may move by `step` (model units). The default
  /// finds them by place(). Several threads call it, each for another point.
  virtual Ways waysFrom(Index point, const Vec3& p, double step) const;
};

} // namespace atria
