// SPDX-License-Identifier: GPL-3.0-or-later
/// A part of a plain mesh, as a mesh of its own.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Layer/LayerWalls.h"

namespace atria {

/// Elements, points and boundary faces keep their order. Where neighbors are missing the mesh ends in faces of a tag of
/// its own, which has no layers; tags of the domain's sides are one higher. Vertices are numbered as in
/// VertexClassification.
struct MeshWindow
{
  DualMesh mesh;
  VertexClassification classification;
  std::vector<Index> vertexOf;
  /// The numbers of points, elements and boundary faces in the whole mesh; faces that are none there have none.
  std::vector<Index> pointIds;
  std::vector<Index> elementIds;
  std::vector<Index> faceIds;

  std::size_t vertexCount() const { return classification.classes.size(); }
};

/// Of elements that are in order; `points` are in place of those of the whole mesh. Faces where the window is cut have
/// the tag `cutTag`. O(n log n) in the elements.
MeshWindow extractWindow(const DualMesh& whole, const std::vector<Vec3>& points,
                         const VertexClassification& classification, const std::vector<Index>& vertexOf,
                         const std::vector<Index>& elements, Index cutTag);

/// By point of a window, whether it is where the window is cut.
std::vector<char> pointsAtCut(const MeshWindow& window, Index cutTag);

/// Options of windows of a mesh with such options; the cut has the last tag of surfaces.
LayerOptions optionsOfWindows(LayerOptions options);

} // namespace atria
