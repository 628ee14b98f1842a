// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers that cells, points and faces of a rank's piece have in the whole mesh as it is written.
#pragma once

#include "Quality/Unions/JudgedUnions.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atria {

/// Numbers are those of a mesh that is written as a whole: cells that became part of others, and points without faces,
/// are left out, pyramids and their apices come last.
struct PieceNumbers
{
  std::vector<std::int64_t> cells;  ///< by cell as it is now
  std::vector<std::int64_t> points; ///< by point
  std::int64_t cellCount = 0;       ///< of the whole
  std::int64_t pointCount = 0;
};

/// `ownPoints` is pointsOfOwn() of the mesh before unions. Of all ranks. Throws RanksDisagree where numbers of cells or
/// points of the whole have gaps.
PieceNumbers numberPiece(const JudgedMesh& now, const UnitedCells& united, const PieceOnRanks& piece,
                         std::span<const char> ownPoints);

/// Faces of the whole as they are on file: internal ones, then patch by patch.
struct FaceNumbers
{
  std::vector<std::int64_t> faces; ///< by face that an own cell has; -1 for others
  std::int64_t faceCount = 0;      ///< of the whole
};

/// `patchOf` has the patch of each boundary face. Of all ranks.
FaceNumbers numberFaces(const FaceMesh& mesh, const UnitedCells& united, const PieceNumbers& numbers,
                        const std::vector<Index>& patchOf, RankExchange& exchange);

} // namespace atria
