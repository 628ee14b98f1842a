// SPDX-License-Identifier: GPL-3.0-or-later
/// Fits arguments of IFC entities to the ones that assimp accepts.
#pragma once

#include "StepText.h"

namespace atria::model::ifc {

/// Changes the arguments of entities to those that assimp demands. Appends missing ones, writes integers as reals where
/// reals belong, and takes out optional values of another type. Gives a neutral value to mandatory ones that later
/// schemas leave out or declare otherwise. Leaves mandatory values that a shape needs unchanged.
void fitArguments(step::File& content);

} // namespace atria::model::ifc
