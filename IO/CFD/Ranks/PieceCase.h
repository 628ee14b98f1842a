// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes an OpenFOAM case with one processor per rank; no rank holds the whole mesh.
#pragma once

#include "OpenFOAMFile.h"
#include "Quality/Checks/MeshChecks.h"
#include "Ranks/MeshPiece.h"

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
  std::function<void(FaceMesh&)> place; ///< moves points to their final places
};

/// Results for the whole mesh.
struct WrittenPieces
{
  MeshVerdict verdict;
  std::vector<std::string> failures;
  std::size_t mergedCells = 0;
  std::size_t addedCells = 0;
  std::size_t mergedFaces = 0;
  bool hasNumbers = true; ///< cells, faces and points are numbered in the whole mesh; false if 32 bits are too few
};

/// Has each rank write the folder of the processor of its number, with the cells that the rank has. The files are bit
/// by bit those of writeProcessors() for the same division. Folders are put in place when all are complete. `grid` is
/// the grid that `piece` was made of. All ranks call it at the same time. Throws Error for a rank without cells and for
/// files that cannot be written, RanksDisagree if only the whole mesh can be written.
WrittenPieces writePieces(const PieceCase& target, const MeshPiece& piece, vtkUnstructuredGrid* grid,
                          RankExchange& exchange, const RunContext& context);

} // namespace atria
