// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh in which a rank improves its own elements: these, and those of other ranks around them.
#pragma once

#include "Mesher/Blocks/MeshBlocks.h"
#include "Ranks/PlainShare.h"

namespace atria {

/// A rank's own elements, and those of other ranks around them, as these have them. The rank needs them to improve its
/// own, and as ghosts.
struct SharedWindow
{
  /// Ends in faces of a tag of its own where neighbors are missing. Tags of the domain's sides are one higher.
  ClassifiedMesh plain;
  /// Own elements are from `firstOwn` up to `endOwn`.
  Index firstOwn = 0;
  Index endOwn = 0;
  /// One entry per element, in rising order: the grid point it stands for.
  std::vector<PointKey> elementKeys;
  /// One entry per point: vertices first, and then the others, each in rising order.
  std::vector<SharedPoint> points;
  Index vertexCount = 0;
  /// Same as in the mesh of all ranks.
  NearBoundary near;
  bool isOwn(Index element) const { return element >= firstOwn && element < endOwn; }
  /// Returns the number of a point here; noIndex if it is not here.
  Index find(const SharedPoint& point) const;
};

/// Makes the window from the plain meshes of all ranks. Leaves of vertices are numbered in `octree`, which becomes that
/// of the window.
SharedWindow makeWindow(PlainShare own, Index cutTag, const RankShare& share, const SurfaceModel& model, Octree& octree,
                        const RunContext& context);

} // namespace atria
