// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones where a mesh is in pieces.
#pragma once

#include "Quality/Unions/JudgedUnions.h"
#include "Ranks/MeshPiece.h"
#include "ZonedFaces.h"

#include <vector>

namespace atria {

/// The face zones of the whole mesh. Each rank sees all zone faces between cells that it has.
class PieceZones
{
public:
  /// All ranks call it at the same time.
  PieceZones(const MeshPiece& piece, RankExchange& exchange);

  std::size_t count() const { return all.patches.size(); }

  /// Finds the zone faces in the mesh of a wide piece. Throws RanksDisagree if one is no face between its cells.
  void find(const WideNumbers& piece, const FaceMesh& mesh, const Executor& executor);

  /// One entry per zone of the whole mesh, for the mesh before unions.
  const std::vector<ZonedFaces>& faces() const { return found; }

private:
  VtkPatches all; ///< numbers refer to the whole mesh
  std::vector<ZonedFaces> found;
};

} // namespace atria
