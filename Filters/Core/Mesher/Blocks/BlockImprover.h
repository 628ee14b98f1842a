// SPDX-License-Identifier: GPL-3.0-or-later
/// Improves large meshes block by block.
#pragma once

#include "Mesher/Blocks/BlockExchange.h"
#include "Mesher/Blocks/MeshBlocks.h"

namespace atria {

/// What becomes of a mesh that is improved block by block.
struct ImprovedBlocks
{
  SettledPoints layers;
  std::vector<DetachedVertex> detached;
  /// Where this is a part of a mesh, of all parts.
  std::vector<PoorElement> poor;
};

/// As improveLayer, but block by block. A block is improved in a window, together with what is some rows about it; then
/// its own points stay where they are, with the layers above them, and blocks beside it begin from there. So what
/// becomes of a block depends on nothing but its window. All blocks take the first part of the improver, and then all
/// the second: where blocks meet, what layers are divided from is whole, and few elements fail. What does is opened and
/// improved once more, from where it is.
///
/// Blocks whose windows do not touch are improved at the same time, here and on other ranks. There are no crease
/// sheets, which are as long as creases. `traits` are those of the whole mesh. Points of the plain mesh are moved.
ImprovedBlocks improveBlocks(const MeshingContext& context, const VertexClassification& classification,
                             const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                             const LayerOptions& options, const CurvedWallTargets& curvedWalls,
                             const MeshTraits& traits, const MeshBlocks& blocks, BlockExchange& exchange);

/// The mesh with its layers; all is taken out of the plain mesh but what takeLayer leaves. Apart from the improver, so
/// that what only this needs may be freed before: what is made now is as large as the mesh.
ImprovedLayer layersOfBlocks(const ImprovedBlocks& improved, DualMesh& plain, const LayerWalls& walls,
                             const MeshTraits& traits, const RunContext& context);

} // namespace atria
