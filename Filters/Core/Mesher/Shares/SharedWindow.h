// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a plain mesh that a rank keeps.
#pragma once

#include "Mesher/Blocks/MeshBlocks.h"
#include "Mesher/Blocks/MeshWindow.h"
#include "Mesher/Shares/SharedNumbers.h"

namespace atria {

/// A rank's own elements, and those about them that it needs to improve them and as ghosts.
struct SharedWindow
{
  /// Numbers of the whole mesh in it are those of the rank's octree.
  MeshWindow mesh;
  /// Own elements are from `firstOwn` up to `endOwn`.
  Index firstOwn;
  Index endOwn;
  /// By element of the window, in rising order, the grid point it stands for.
  std::vector<PointKey> elementKeys;
  /// By point of the window: vertices first, and then the others, each in rising order.
  std::vector<SharedPoint> points;
  Index vertexCount;
  /// As in the mesh of all ranks.
  NearBoundary near;
  bool isOwn(Index element) const { return element >= firstOwn && element < endOwn; }
  /// The number of a point here; noIndex where it is not.
  Index find(const SharedPoint& point) const;
};

/// Of the plain mesh of a rank's octree; `elementKeys` has the grid points of its elements, in order.
SharedWindow keepShare(const DualMesh& mesh, const VertexClassification& classification,
                       const std::vector<Index>& vertexOf, const std::vector<PointKey>& elementKeys, Index cutTag,
                       const Octree& octree, const RankShare& share, const RunContext& context);

} // namespace atria
