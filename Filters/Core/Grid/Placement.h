// SPDX-License-Identifier: GPL-3.0-or-later
/// Axes turned around the vertical, and upright boxes along them.
#pragma once

#include "Support/Types.h"

#include <cmath>
#include <numbers>

namespace atria {

/// Axes that are turned around the vertical through the model's origin. Angles are in degrees from the model's x axis,
/// counterclockwise seen from above. Quarter turns are exact, and an angle of 0 changes no bit.
class Placement
{
public:
  Placement() = default;
  explicit Placement(double degrees) : angle_(std::remainder(degrees, 360.0))
  {
    const double quarters = std::round(angle_ / 90.0);
    const double rest = (angle_ - 90.0 * quarters) * std::numbers::pi / 180.0;
    double c = std::cos(rest);
    double s = std::sin(rest);
    for (int i = static_cast<int>(quarters); i != 0; i += i < 0 ? 1 : -1)
    {
      const double turned = quarters < 0 ? s : -s;
      s = quarters < 0 ? -c : c;
      c = turned;
    }
    cosine_ = c;
    sine_ = s;
  }

  double angle() const { return angle_; }
  /// Returns the coordinates of a point of the model along the turned axes.
  Vec3 fromModel(const Vec3& p) const
  {
    return angle_ == 0.0 ? p : Vec3(cosine_ * p[0] + sine_ * p[1], cosine_ * p[1] - sine_ * p[0], p[2]);
  }
  /// Returns the point of the model with given coordinates along the turned axes.
  Vec3 toModel(const Vec3& p) const
  {
    return angle_ == 0.0 ? p : Vec3(cosine_ * p[0] - sine_ * p[1], cosine_ * p[1] + sine_ * p[0], p[2]);
  }

private:
  double angle_ = 0.0;
  double cosine_ = 1.0;
  double sine_ = 0.0;
};

/// A box that stands upright along turned axes; `bounds` are coordinates along them.
struct PlacedBox
{
  Placement axes;
  Box3 bounds;

  bool contains(const Vec3& modelPoint) const
  {
    const Vec3 p = axes.fromModel(modelPoint);
    return (p.array() >= bounds.min.array()).all() && (p.array() <= bounds.max.array()).all();
  }
};

/// Returns a box along turned axes with the center and the lengths of `box`.
PlacedBox turnedAboutMiddle(const Box3& box, double degrees);

} // namespace atria
