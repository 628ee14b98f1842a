// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the mesh of a model valid and good at its boundary.
#pragma once

#include "Layer/LayerCoverage.h"
#include "Mesher/Blocks/ClassifiedMesh.h"
#include "Mesher/Improvement/LayerImprover.h"
#include "Mesher/MeshOptions.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

class MeshPort;

/// Returns a mesh whose points are the vertices of `classification`.
ClassifiedMesh classified(DualMesh mesh, VertexClassification classification);

/// Slides points so that no wall face is folded; see unfoldFaces. The sheets of the mesh are not split yet.
ClassifiedMesh unfoldWalls(ClassifiedMesh given, const MeshingContext& context);

/// Gives both sides of sheets points of their own; see splitSheets.
ClassifiedMesh splitPoints(ClassifiedMesh given, const MeshingContext& context);

/// An element that is not in the mesh, as it could not be made valid.
struct LeftOutElement
{
  Vec3 middle;
  double size;        ///< edge of a cube with its volume
  Index beside;       ///< number of a neighbor in the mesh; noIndex if it has none
  Index number;       ///< its own number, before it was left out
  Index besideBefore; ///< number of that neighbor before elements were left out
};

struct ImprovedMesh
{
  DualMesh mesh;
  /// Empty without rules.
  LayerReport layers;
  /// Points that are not where the model wants them, in rising order.
  std::vector<DetachedVertex> detached;
  std::vector<LeftOutElement> leftOut;
  /// One entry per element before elements were left out: its number now, or noIndex. Empty if none was left out.
  /// `pointNumbers` has the same for points.
  std::vector<Index> numbers;
  std::vector<Index> pointNumbers;
};

/// Grows layers on walls and makes the elements at the boundary valid (see improveLayer), even if rules request no
/// layer. Without rules, returns the mesh as it is. Leaves out elements at walls that stay invalid however they are
/// written, unless no layers are requested and no elements are to be supported.
ImprovedMesh growLayers(ClassifiedMesh given, const WallOptions& wallOptions, MeshPort& port,
                        const MeshingContext& context);

} // namespace atria
