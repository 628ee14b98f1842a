// SPDX-License-Identifier: GPL-3.0-or-later
/// A rank's piece of a mesh that several have made.
#pragma once

#include "Ranks/SharedLayers.h"

namespace atria {

/// What stays of a rank's mesh with layers once it is done: its own elements and those about them.
struct SharedPiece
{
  /// Boundary faces, and those of zones, are those of own elements. Without neighbors but those across faces of zones.
  DualMesh mesh;
  /// Where they were before.
  std::vector<Index> elementsBefore;
  std::vector<Index> pointsBefore;
  std::vector<Index> facesBefore;
  /// By boundary face, whether there is an element on the other side of the sheet; it may be none of the piece.
  std::vector<char> hasOpposite;
  /// The ranks whose they are, and their numbers in the mesh of all ranks.
  std::vector<int> elementRanks;
  std::vector<int> pointRanks;
  std::vector<std::uint64_t> elementNumbers;
  std::vector<std::uint64_t> pointNumbers;
  std::uint64_t elementCount = 0;
  std::uint64_t pointCount = 0;
  /// Of the elements asked for, on whichever rank they are; noNumber for those that are not in the mesh any more.
  std::vector<std::uint64_t> askedNumbers;
};

inline constexpr std::uint64_t noNumber = ~std::uint64_t{0};

/// Which elements and points there are no more, by their numbers before: noIndex; empty where all are there.
struct KeptNumbers
{
  const std::vector<Index>& elements;
  const std::vector<Index>& points;
};

/// `mesh` is that of the layer without elements that were left out; `ghostLevels` rings of elements that share points
/// with those before stay about own ones, one at least. `asked` are elements as they were before any was left out.
SharedPiece takePiece(const DualMesh& mesh, const KeptNumbers& kept, const SharedLayers& layers, const LayerMesh& layer,
                      const RankShare& share, int ghostLevels, const std::vector<SharedElement>& asked);

} // namespace atria
