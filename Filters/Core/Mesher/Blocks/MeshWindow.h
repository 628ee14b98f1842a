// SPDX-License-Identifier: GPL-3.0-or-later
/// A part of a plain mesh, as a mesh of its own.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Layer/LayerWalls.h"

namespace atria {

/// A part of a plain mesh. Elements, points and boundary faces keep their order. The mesh ends in boundary faces where
/// neighbors are missing. These have a tag of their own, which has no layers; tags of the domain's sides are one
/// higher. Vertices are numbered as in VertexClassification.
struct MeshWindow
{
  DualMesh mesh;
  VertexClassification classification;
  std::vector<Index> vertexOf;
  /// Numbers of points, elements and boundary faces in the whole mesh; noIndex for faces at the cut.
  std::vector<Index> pointIds;
  std::vector<Index> elementIds;
  std::vector<Index> faceIds;

  std::size_t vertexCount() const { return classification.classes.size(); }
};

/// Returns the window of `elements`, which are in order. `points` replace the points of the whole mesh. Faces at the
/// cut get the tag `cutTag`. O(n log n) in the elements.
MeshWindow extractWindow(const DualMesh& whole, const std::vector<Vec3>& points,
                         const VertexClassification& classification, const std::vector<Index>& vertexOf,
                         const std::vector<Index>& elements, Index cutTag);

/// Returns one entry per point of a window: 1 if the window is cut there.
std::vector<char> pointsAtCut(const MeshWindow& window, Index cutTag);

/// Returns a mesh's options for its windows. The cut gets one more surface tag, the last, without layers.
LayerOptions optionsOfWindows(LayerOptions options);

} // namespace atria
