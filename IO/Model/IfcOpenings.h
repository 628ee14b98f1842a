// SPDX-License-Identifier: GPL-3.0-or-later
/// Rewrites openings of IFC elements that are boxes, extruded in another direction.
///
/// assimp cuts an opening right only where it is extruded through the element. A box is the same whichever way it is
/// extruded.
#pragma once

#include "StepText.h"

#include <cstdint>

namespace atria::model::ifc {

/// The sides of the section that a box is extruded from.
enum class BoxSide
{
  shorter,
  longer,
};

/// Writes an opening that is one extruded rectangle as the same box extruded along a side of its rectangle. Returns
/// false, and changes nothing, for any other opening.
bool extrudeAlong(step::File& file, std::uint64_t opening, BoxSide side);

} // namespace atria::model::ifc
