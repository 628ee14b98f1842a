// SPDX-License-Identifier: GPL-3.0-or-later
/// An OpenFOAM case whose processors are the ranks, written without the whole mesh being anywhere.
#pragma once

#include "MeshPiece.h"
#include "OpenFOAMFile.h"
#include "Quality/Checks/MeshChecks.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace atria {

struct PieceCase
{
  std::filesystem::path folder;
  OpenFOAMFormat format;
  bool mergeCells; ///< as in UnionOptions
  bool mergeFaces;
  std::function<void(FaceMesh&)> place; ///< puts points where they are to be
};

/// Of the whole.
struct WrittenCase
{
  MeshVerdict verdict;
  std::vector<std::string> failures;
  std::size_t mergedCells = 0;
  std::size_t addedCells = 0;
  std::size_t mergedFaces = 0;
  bool hasNumbers = true; ///< of cells, faces and points in the whole; 32 bits may not hold them
};

/// Has each rank write the folder of the processor of its number, with the cells that it has of the mesh: as
/// writeProcessors() writes it of the same division, bit by bit. Folders are put in place when all are complete. `grid`
/// is what `piece` was made of. Throws Error for a rank without cells and for what cannot be written, RanksDisagree
/// where only the whole mesh can be written. Of all ranks.
WrittenCase writePieces(const PieceCase& target, const MeshPiece& piece, vtkUnstructuredGrid* grid,
                        RankExchange& exchange, const RunContext& context);

} // namespace atria
