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

/// A mesh whose points are the vertices of `anchors`.
ClassifiedMesh classified(DualMesh mesh, VertexClassification classification);

/// Slides points so that no wall face is folded; see unfoldFaces. The sheets of the mesh are not split yet.
ClassifiedMesh unfoldWalls(ClassifiedMesh given, const MeshingContext& context);

/// Gives both sides of sheets points of their own; see splitSheets.
ClassifiedMesh splitPoints(ClassifiedMesh given, const MeshingContext& context);

/// An element that is not in the mesh, as it could not be made valid.
struct LeftOutElement
{
  Vec3 middle;
  double size;        ///< the edge of a cube of its volume
  Index beside;       ///< an element that is in the mesh; noIndex where there is none
  Index number;       ///< its own, before it was left out
  Index besideBefore; ///< that of the element beside it then
};

struct ImprovedMesh
{
  DualMesh mesh;
  /// Empty without rules.
  LayerReport layers;
  /// Points that are not where the model wants them, in rising order.
  std::vector<DetachedVertex> detached;
  std::vector<LeftOutElement> leftOut;
  /// By element before these were left out its number now, or noIndex; empty where none was. The same by point.
  std::vector<Index> numbers;
  std::vector<Index> pointNumbers;
};

/// Grows layers on walls and makes the elements at the boundary valid (see improveLayer), also where rules ask for no
/// layer. Without rules the mesh is returned as it is. Elements at walls that stay invalid however they are written are
/// left out, but where neither layers are asked for nor elements are to be supported.
ImprovedMesh growLayers(ClassifiedMesh given, const WallOptions& wallOptions, MeshPort& port,
                        const MeshingContext& context);

} // namespace atria
