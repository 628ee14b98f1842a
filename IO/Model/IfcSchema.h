// SPDX-License-Identifier: GPL-3.0-or-later
/// Names and kinds of the entities of IFC 2x3.
#pragma once

#include "StepText.h"

#include <string>
#include <string_view>

namespace atria::model::ifc {

/// True if IFC 2x3 has an entity of this name, in capitals. False for those of later schemas.
bool isIn2x3(std::string_view type);

/// Returns the name of an entity as it is written in words, such as IfcWallStandardCase. Only elements have more than
/// one capital behind Ifc.
std::string classNameOf(std::string_view type);

/// True if the entity begins with a global identifier and an owner, as all but geometry and values do.
bool isRoot(const step::Instance& instance);

/// True if representations of an identifier are the body of an element, and not an axis, a plan and the like.
bool isBody(std::string_view identifier);

} // namespace atria::model::ifc
