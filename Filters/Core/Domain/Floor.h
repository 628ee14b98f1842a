// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the height of the ground if no surface is ground.
#pragma once

#include "Domain/ModelBodies.h"

namespace atria {

/// Returns the height at which most of a model stands, by the faces that have nothing below them. It is the least
/// costly of their heights (see groundModel), and the lowest of several such heights. Returns `lowestPoint` if no face
/// has anything above it.
double findFloor(const std::vector<LowestFace>& faces, double lowestPoint);

} // namespace atria
