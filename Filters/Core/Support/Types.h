// SPDX-License-Identifier: GPL-3.0-or-later
/// The few types every stage shares.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace atria {

/// A point or vector in model units (meters unless the model says otherwise).
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// Index of a point, element or leaf; `noIndex` stands for "none".
using Index = std::uint32_t;
inline constexpr Index noIndex = std::numeric_limits<Index>::max();

/// Axis-aligned box; empty (min > max) when default constructed.
struct Box3
{
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return (min.array() > max.array()).any(); }
  Vec3 size() const { return max - min; }
  Vec3 center() const { return 0.5 * (min + max); }
  void extend(const Vec3& p)
  {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  /// Touching counts.
  bool touches(const Box3& other) const
  {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  double squaredDistance(const Vec3& p) const { return (p.cwiseMax(min).cwiseMin(max) - p).squaredNorm(); }
};

/// The six axis directions, in the order in which faces of elements and sides of the domain are kept.
enum Direction : std::uint8_t
{
  xMin,
  xMax,
  yMin,
  yMax,
  zMin,
  zMax
};
inline constexpr int axisOf(int direction) { return direction >> 1; }
inline constexpr bool isUpper(int direction) { return (direction & 1) != 0; }
inline constexpr int opposite(int direction) { return direction ^ 1; }

/// Names of the domain's sides, by Direction.
inline constexpr std::array<const char*, 6> sideNames{"xMin", "xMax", "yMin", "yMax", "zMin", "zMax"};

} // namespace atria
