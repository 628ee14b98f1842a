// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh of a processor, made by the rank that holds its cells.
#pragma once

#include "Decomposition.h"
#include "Ranks/PieceNumbers.h"

#include <string>
#include <vector>

namespace atria {

/// A rank's piece after unions of cells.
struct UnitedPiece
{
  const JudgedMesh& now;
  const UnitedCells& cells;
  std::vector<Index> patchOf;      ///< one per boundary face
  std::vector<PatchEntry> patches; ///< all patches of the whole mesh
  std::vector<FaceZone> faceZones; ///< all face zones of the whole mesh, with this rank's face numbers
  std::vector<CellZone> cellZones; ///< all cell zones of the whole mesh, with this rank's cell numbers
};

/// Returns the mesh that decompose() makes of the whole mesh in one process. Numbers in the whole mesh are left out if
/// 32-bit labels cannot hold them.
ProcessorMesh makeProcessor(const UnitedPiece& piece, const PieceNumbers& numbers, const FaceNumbers& faceNumbers,
                            std::size_t self);

} // namespace atria
