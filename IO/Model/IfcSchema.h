// SPDX-License-Identifier: GPL-3.0-or-later
/// Entities of IFC 2x3.
#pragma once

#include "StepText.h"

#include <string>
#include <string_view>

namespace atria::model::ifc {

/// Whether IFC 2x3 has an entity of this name, in capitals. Those that came later are not.
bool isIn2x3(std::string_view type);

/// The name of an entity as it is written in words, such as IfcWallStandardCase. Only elements have more than one
/// capital behind Ifc.
std::string classNameOf(std::string_view type);

/// Whether it begins with a global identifier and an owner, as all that is not geometry or a value does.
bool isRoot(const step::Instance& instance);

/// Whether representations of an identifier are the body of an element, and not an axis, a plan and the like.
bool isBody(std::string_view identifier);

} // namespace atria::model::ifc
