// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that several ranks make, each its share.
#pragma once

#include "Mesher/DualMesher.h"
#include "Mesher/Shares/SharedPiece.h"

#include <optional>

namespace atria {

/// What a rank has of a mesh that it makes with others. What was found is of this rank's share, but for zones and the
/// report on layers.
struct SharedDual
{
  /// Without a mesh; what is by element or face is by those of the piece.
  DualMeshResult found;
  SharedPiece piece;
};

/// `octree` is that of the rank's share, whose leaves know their pieces of the model. The blocks of the share are those
/// of `options`. All ranks call it at the same time. Nothing, on all ranks, where a zone that should be sealed is not:
/// its way out is to be found in the whole. Throws as makeDualMesh, and where ranks find something else where their
/// shares meet: see RankExchange.
std::optional<SharedDual> makeSharedMesh(Octree octree, const SurfaceModel& model, const DualMeshOptions& options,
                                         const RankShare& share, int ghostLevels, StageClock& clock,
                                         const RunContext& context, const DrawnModel* drawn = nullptr);

} // namespace atria
