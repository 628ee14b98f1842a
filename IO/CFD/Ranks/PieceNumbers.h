// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers that cells, points and faces of a rank's piece have in the whole mesh as it is written.
#pragma once

#include "Ranks/UnionsOnRanks.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atria {

/// Numbers in a mesh that is written as a whole. Cells that became part of others and points without faces have none;
/// pyramids and their apices come last.
struct PieceNumbers
{
  std::vector<std::int64_t> cells;  ///< one per present cell
  std::vector<std::int64_t> points; ///< one per point
  std::int64_t cellCount = 0;       ///< in the whole mesh
  std::int64_t pointCount = 0;
};

/// `ownPoints` is pointsOfOwn() of the mesh before unions. All ranks call it at the same time. Throws RanksDisagree if
/// the numbers of cells or points of the whole mesh have gaps.
PieceNumbers numberPiece(const JudgedMesh& now, const UnitedCells& united, const PieceOnRanks& piece,
                         std::span<const char> ownPoints);

/// Numbers of faces in the file of the whole mesh: internal faces first, then patch by patch.
struct FaceNumbers
{
  std::vector<std::int64_t> faces; ///< one per face; -1 for faces without an own cell
  std::int64_t faceCount = 0;      ///< in the whole mesh
};

/// `patchOf` has the patch of each boundary face. All ranks call it at the same time.
FaceNumbers numberFaces(const FaceMesh& mesh, const UnitedCells& united, const PieceNumbers& numbers,
                        const std::vector<Index>& patchOf, RankExchange& exchange);

} // namespace atria
