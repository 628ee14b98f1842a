// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures the walls of a model, which show its unit of length.
#pragma once

#include "Scene.h"

namespace atria::scene {

/// Returns the size of walls if `upAxis` (1 y, 2 z) is up: a third of their area is in smooth pieces of upright faces
/// that are at least so high and wide. Returns 0 without walls. Pieces that are not `least` high and wide may count as
/// 0, which makes it fast for most models. Storeys and gables of buildings are some meters; few towers have sides of
/// more than sixty.
double wallSize(const Scene& scene, int upAxis, double least);

} // namespace atria::scene
