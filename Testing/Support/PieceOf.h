// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of meshes that ranks have made, against the whole.
#pragma once

#include "Ranks/SharedPiece.h"

namespace atria::testing {

/// That the elements of a piece are those of the whole of their numbers, with the same points, bit by bit, the same
/// labels, and the same faces on the boundary and on zones.
void expectPiece(const DualMesh& whole, const SharedPiece& piece, int rank);

} // namespace atria::testing
