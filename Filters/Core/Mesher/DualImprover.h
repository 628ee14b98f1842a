// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the mesh of a model valid and good at its boundary.
#pragma once

#include "Layer/LayerCoverage.h"
#include "Mesher/Blocks/ClassifiedMesh.h"
#include "Mesher/Improvement/LayerImprover.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// A mesh whose points are the vertices of `anchors`.
ClassifiedMesh classified(DualMesh mesh, VertexClassification classification);

/// Slides points so that no wall face is folded; see unfoldFaces. The sheets of the mesh are not split yet.
ClassifiedMesh unfoldWalls(ClassifiedMesh given, const MeshingContext& context);

/// Gives both sides of sheets points of their own; see splitSheets.
ClassifiedMesh splitPoints(ClassifiedMesh given, const MeshingContext& context);

/// What is made of walls.
struct WallOptions
{
  /// Layers of elements on walls. Elements at the boundary are made valid, too, also by a rule that asks for no layers;
  /// without rules the mesh is the dual as it is.
  std::vector<LayerRule> layers = {};
  /// Whether walls for which a rule asks for no layers have one at elements that cannot be valid without: those that
  /// are concave there or have too few neighbors, wherever their vertices are.
  bool supportElements = true;
  /// Where walls have a layer.
  CurvedWallTargets curvedWalls = {};
  /// Where it is not 0, vertices of blocks of about so many octants at most are improved together; see improveBlocks.
  std::size_t blockSize = 0;
};

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

/// What walls are to have, by rule and where elements need it. `onGround`: whether a surface lies on the domain's
/// bottom anywhere.
LayerOptions layerOptionsOf(const WallOptions& wallOptions, bool onGround, const MeshingContext& context);
bool hasGround(const DualMesh& mesh, Index surfaceCount);

/// Removes jogs, and finds the walls of the mesh then.
LayerWalls prepareWalls(ClassifiedMesh& plain, const LayerOptions& options, const MeshingContext& context);

/// Puts the boundary faces of a mesh in the order that they have in any part of it.
void orderFaces(ImprovedMesh& improved);

/// Grows layers on walls and makes the elements at the boundary valid (see improveLayer), also where rules ask for no
/// layer. Without rules the mesh is returned as it is. Elements at walls that stay invalid however they are written are
/// left out, but where neither layers are asked for nor elements are to be supported.
ImprovedMesh growLayers(ClassifiedMesh given, const WallOptions& wallOptions, const MeshingContext& context);

} // namespace atria
