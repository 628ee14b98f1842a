// SPDX-License-Identifier: GPL-3.0-or-later
/// Arguments of IFC entities, such as assimp takes them.
#pragma once

#include "StepText.h"

namespace atria::model::ifc {

/// Makes the arguments of entities those that assimp demands: appends missing ones, writes integers as reals where
/// reals belong, takes out optional values of another type, and gives mandatory ones that later schemas leave out or
/// declare otherwise a value that says nothing. Leaves alone mandatory values that a shape needs.
void fitArguments(step::File& content);

} // namespace atria::model::ifc
