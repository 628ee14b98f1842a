// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/CheckMesh.h"
#include "Support/MeshIt.h"

namespace atria::testing {

/// What checkMesh says of a mesh as it is written, with faces of a patch that are in one plane merged where no layer
/// is. Fails where it cannot be written or checkMesh does not come to a verdict.
CheckMeshReport checkAsWritten(const Meshed& meshed);

} // namespace atria::testing
