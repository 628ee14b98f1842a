// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/Blocks/MeshBlocks.h"
#include "Ranks/PlainShare.h"

namespace atria {

/// A rank's own elements, and those of other ranks about them that it needs to improve them and as ghosts, as these
/// have them.
struct SharedWindow
{
  /// Where neighbors are missing it ends in faces of a tag of its own; tags of the domain's sides are one higher.
  ClassifiedMesh plain;
  /// Own elements are from `firstOwn` up to `endOwn`.
  Index firstOwn = 0;
  Index endOwn = 0;
  /// By element, in rising order, the grid point it stands for.
  std::vector<PointKey> elementKeys;
  /// By point: vertices first, and then the others, each in rising order.
  std::vector<SharedPoint> points;
  Index vertexCount = 0;
  /// As in the mesh of all ranks.
  NearBoundary near;
  bool isOwn(Index element) const { return element >= firstOwn && element < endOwn; }
  /// The number of a point here; noIndex where it is not.
  Index find(const SharedPoint& point) const;
};

/// Of the plain meshes of all ranks. Leaves of vertices are numbered in `octree`, which becomes that of the window.
SharedWindow makeWindow(PlainShare own, Index cutTag, const RankShare& share, const SurfaceModel& model, Octree& octree,
                        const RunContext& context);

} // namespace atria
