// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh with the vertex of the model that each of its points stands for.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Dual/Vertices/DualVertices.h"

namespace atria {

/// A mesh that knows what its points stand for.
struct ClassifiedMesh
{
  DualMesh mesh;
  VertexClassification classification;
  /// One entry per point of the mesh: the vertex of the anchors that it stands for.
  std::vector<Index> vertexOf;
};

} // namespace atria
