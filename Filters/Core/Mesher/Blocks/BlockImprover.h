// SPDX-License-Identifier: GPL-3.0-or-later
/// Improves large meshes block by block.
#pragma once

#include "Mesher/Blocks/BlockExchange.h"
#include "Mesher/Blocks/MeshBlocks.h"

namespace atria {

/// As improveLayer, but block by block. A block is improved in a window, together with what is some rows about it; then
/// its own points stay where they are, with the layers above them, and blocks beside it begin from there. So what
/// becomes of a block depends on nothing but its window. All blocks take the first part of the improver, and then all
/// the second: where blocks meet, what layers are divided from is whole, and few elements fail. What does is opened and
/// improved once more, from where it is.
///
/// Blocks whose windows do not touch are improved at the same time, here and on other ranks. There are no crease
/// sheets, which are as long as creases. `traits` are those of the whole mesh.
ImprovedLayer improveBlocks(const MeshingContext& context, const VertexClassification& classification,
                            const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                            const LayerOptions& options, const CurvedWallTargets& curvedWalls, const MeshTraits& traits,
                            const MeshBlocks& blocks, BlockExchange& exchange);

} // namespace atria
