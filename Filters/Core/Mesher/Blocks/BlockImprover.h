// SPDX-License-Identifier: GPL-3.0-or-later
/// Improves large meshes block by block.
#pragma once

#include "Mesher/Blocks/BlockExchange.h"
#include "Mesher/Blocks/MeshBlocks.h"

namespace atria {

/// Result of improving a mesh block by block.
struct ImprovedBlocks
{
  SettledPoints layers;
  std::vector<DetachedVertex> detached;
  /// Poor elements of all processes that are here, too.
  std::vector<PoorElement> poor;
};

/// Improves a mesh as improveLayer does, but block by block. Each block is improved in a window with some rows around
/// it, and its result depends only on this window. Its points and the layers above them then stay, and blocks beside it
/// start from there. All blocks take the first part of the improver before any takes the second: layers are divided
/// when they are complete, so that few elements fail where blocks meet. Poor elements there are improved again.
///
/// Blocks whose windows have no vertices of each other are improved at the same time, on threads and on ranks. There
/// are no crease sheets, as these are as long as creases. `traits` are those of the whole mesh. Moves points of
/// `plain`.
ImprovedBlocks improveBlocks(const MeshingContext& context, const VertexClassification& classification,
                             const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                             const LayerOptions& options, const CurvedWallTargets& curvedWalls,
                             const MeshTraits& traits, const MeshBlocks& blocks, BlockExchange& exchange);

/// Returns the mesh with its layers. Moves everything out of the plain mesh except what takeLayer leaves. The caller
/// can free what only improveBlocks needs before this, as the result is as large as the mesh.
ImprovedLayer layersOfBlocks(const ImprovedBlocks& improved, DualMesh& plain, const LayerWalls& walls,
                             const MeshTraits& traits, const RunContext& context);

} // namespace atria
