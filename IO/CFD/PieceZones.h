// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones where a mesh is in pieces.
#pragma once

#include "MeshPiece.h"
#include "Quality/Unions/JudgedUnions.h"
#include "ZonedFaces.h"

#include <vector>

namespace atria {

/// Those of the whole, of which each rank sees all faces between cells that it has.
class PieceZones
{
public:
  /// Of all ranks.
  PieceZones(const MeshPiece& piece, RankExchange& exchange);

  std::size_t count() const { return all.patches.size(); }

  /// Finds them in the mesh of a wide piece. Throws RanksDisagree where one is no face between its cells.
  void find(const WideNumbers& piece, const FaceMesh& mesh, const Executor& executor);

  /// By zone of the whole, in the mesh before unions.
  const std::vector<ZonedFaces>& faces() const { return found; }

private:
  VtkPatches all; ///< with numbers of the whole
  std::vector<ZonedFaces> found;
};

} // namespace atria
