// SPDX-License-Identifier: GPL-3.0-or-later
/// Compares the input of stages bit by bit.
#pragma once

#include "Mesher/DualMesher.h"
#include "Mesher/ModelOptions.h"
#include "Octree/Tree/Octree.h"

namespace atria {

bool isSame(const TriangleSurface& a, const TriangleSurface& b);
bool isSame(const OctreeSets& a, const OctreeSets& b);
bool isSame(const ModelOptions& a, const ModelOptions& b);
bool isSame(const CrossingOptions& a, const CrossingOptions& b);
bool isSame(const ZoneOptions& a, const ZoneOptions& b);
bool isSame(const ElementOptions& a, const ElementOptions& b);

} // namespace atria
