// SPDX-License-Identifier: GPL-3.0-or-later
/// A rank's piece of a mesh that several have made.
#pragma once

#include "Ranks/SharedLayers.h"

namespace atria {

/// The part of a rank's mesh with layers that stays once it is done: own elements and those around them.
struct SharedPiece
{
  /// Boundary faces, and faces of zones, are those of own elements. There are no neighbors except across faces of
  /// zones.
  DualMesh mesh;
  /// Numbers of elements, points and boundary faces in the rank's mesh before.
  std::vector<Index> elementsBefore;
  std::vector<Index> pointsBefore;
  std::vector<Index> facesBefore;
  /// One flag per boundary face: nonzero if there is an element on the other side of the sheet, which may not be in the
  /// piece.
  std::vector<char> hasOpposite;
  /// Owners of elements and points, and their numbers in the mesh of all ranks.
  std::vector<int> elementRanks;
  std::vector<int> pointRanks;
  std::vector<std::uint64_t> elementNumbers;
  std::vector<std::uint64_t> pointNumbers;
  std::uint64_t elementCount = 0;
  std::uint64_t pointCount = 0;
  /// Numbers of the requested elements, on any rank; noNumber for those that were left out.
  std::vector<std::uint64_t> askedNumbers;
};

inline constexpr std::uint64_t noNumber = ~std::uint64_t{0};

/// Numbers of elements and points by their numbers before some were left out: noIndex for those. Empty if all stayed.
struct KeptNumbers
{
  const std::vector<Index>& elements;
  const std::vector<Index>& points;
};

/// Takes a rank's piece. `mesh` has layers, and lacks elements that were left out. The piece has `ghostLevels` rings of
/// elements around own ones, at least one; each shares points with the one before. `asked` are elements as they were
/// before any were left out.
SharedPiece takePiece(const DualMesh& mesh, const KeptNumbers& kept, const SharedLayers& layers, const LayerMesh& layer,
                      const RankShare& share, int ghostLevels, const std::vector<SharedElement>& asked);

} // namespace atria
