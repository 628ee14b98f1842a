// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh of a processor, made by the rank that has its cells of what it has.
#pragma once

#include "Decomposition.h"
#include "PieceNumbers.h"

#include <string>
#include <vector>

namespace atria {

/// A rank's piece once cells were united.
struct UnitedPiece
{
  const JudgedMesh& now;
  const UnitedCells& cells;
  std::vector<Index> patchOf;      ///< by boundary face
  std::vector<PatchEntry> patches; ///< those of the whole
  std::vector<FaceZone> faceZones; ///< those of the whole, with faces by their numbers here
  std::vector<CellZone> cellZones; ///< the same of cells
};

/// As decompose() makes it of the whole mesh that one process writes. Without numbers of the whole where these are more
/// than a label of 32 bits can tell.
ProcessorMesh makeProcessor(const UnitedPiece& piece, const PieceNumbers& numbers, const FaceNumbers& faceNumbers,
                            std::size_t self);

} // namespace atria
