// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones where a mesh is in pieces.
#pragma once

#include "MeshPiece.h"
#include "MeshZones.h"
#include "Quality/Unions/JudgedUnions.h"

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

  /// Gives internal faces the numbers of their zones.
  void mark(std::vector<Index>& zoneOf) const;

  /// With the faces that are here now, as solverMeshFrom() makes them.
  std::vector<FaceZone> zonesOf(const JudgedMesh& now) const;

private:
  /// A face of the mesh before unions, and its area along the normal of its zone.
  struct ZonedFace
  {
    Index face;
    Vec3 normal;
  };

  VtkPatches all;                            ///< with numbers of the whole
  std::vector<std::vector<ZonedFace>> found; ///< by zone
};

} // namespace atria
