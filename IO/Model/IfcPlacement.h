// SPDX-License-Identifier: GPL-3.0-or-later
/// Points, directions and placements of an IFC file as numbers, and numbers as text.
#pragma once

#include "StepText.h"

#include "Support/Types.h"

#include <array>
#include <optional>

namespace atria::model::ifc {

/// The place of an object, and its axes as unit vectors.
struct Frame
{
  Vec3 origin = Vec3::Zero();
  std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};

  Vec3 placed(const Vec3& p) const { return origin + p.x() * axes[0] + p.y() * axes[1] + p.z() * axes[2]; }
};

/// Returns the numbers of a point or direction, with z 0 if it has two; nothing for anything else.
std::optional<Vec3> coordinatesIn(const step::Instance* instance);

/// Returns the unit vector that an optional reference leads to, `fallback` for `$`; nothing if it is damaged.
std::optional<Vec3> directionAt(const step::File& file, std::string_view at, const Vec3& fallback);

/// Returns the frame of a placement in a plane or in space, that of the origin for `$`; nothing if it is damaged.
std::optional<Frame> frameAt(const step::File& file, std::string_view at);

/// Returns a number with all its digits.
std::string textOf(double value);

} // namespace atria::model::ifc
