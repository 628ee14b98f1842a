// SPDX-License-Identifier: GPL-3.0-or-later
/// Options for meshing a model.
#pragma once

#include "Dual/Zones/ZoneOptions.h"
#include "Layer/LayerRules.h"
#include "Mesher/ModelOptions.h"
#include "Optimize/Kernel/CurvedWallTargets.h"

namespace atria {

/// Options for the faces of the mesh at gaps of the model.
struct CrossingOptions
{
  /// Closes cracks beside boundary edges that are no wider than this part of the octants there; 0 closes none. Wider
  /// ones are open where an edge of the grid passes.
  double crackTolerance = 0.5;
};

/// Options for walls.
struct WallOptions
{
  /// Layers of elements on walls. Any rule makes elements at the boundary valid, even if it requests no layers; without
  /// rules the mesh is the dual as it is.
  std::vector<LayerRule> layers = {};
  /// True if walls for which no layers are requested get one at elements that cannot be valid without: those that are
  /// concave there or have too few neighbors, wherever their vertices are.
  bool supportElements = true;
  /// Targets at curved walls that have a layer.
  CurvedWallTargets curvedWalls = {};
  /// Improves together the vertices of blocks of at most about this many octants; see improveBlocks. 0 improves the
  /// mesh as a whole.
  std::size_t blockSize = 0;
};

/// Options for elements before walls are improved.
struct ElementOptions : ZoneOptions
{
  /// True if all elements are hexahedra. The octree must be balanced in families, and its sizes uniform at walls.
  bool hexahedra = false;
};

/// Options for the mesh of an octree.
struct DualMeshOptions : CrossingOptions, ElementOptions, WallOptions
{
};

/// All options of meshModel().
struct MesherOptions : ModelOptions
{
  DualMeshOptions mesh;
};

} // namespace atria
