// SPDX-License-Identifier: GPL-3.0-or-later
/// The height of the ground where no surface is ground.
#pragma once

#include "Domain/ModelBodies.h"

namespace atria {

/// The height at which most of a model stands, by the faces that it has nothing below: the least costly of their
/// heights (see groundModel), of several the lowest. `lowestPoint` where no face has anything above it.
double findFloor(const std::vector<LowestFace>& faces, double lowestPoint);

} // namespace atria
