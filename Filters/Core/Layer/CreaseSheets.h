// SPDX-License-Identifier: GPL-3.0-or-later
/// Inserts sheets of hexahedra along creases that run across the grid.
#pragma once

#include "Layer/LayerTopology.h"

#include <algorithm>

namespace atria {

/// Smooth pieces that walls belong to, and which of these get crease sheets.
struct CreaseCharts
{
  /// One entry per boundary face: a number for its chart and side; noIndex if the layer is not whole or another face is
  /// behind it.
  std::vector<Index> pieceOf;
  /// One entry per piece.
  std::vector<char> isParted;

  bool isEmpty() const { return std::ranges::find(isParted, 1) == isParted.end(); }
};

/// Finds pieces with steps. A crease that runs across the grid follows steps of the mesh: wall faces there have two
/// edges on it, so their elements have an angle of 180 degrees, wherever their points are. Linear in the faces of
/// walls.
CreaseCharts findCreaseCharts(const LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls);

/// Separates pieces from their surroundings by a sheet of hexahedra that runs above the layer and down to the wall
/// along creases (pillowing; Mitchell and Tautges, Pillowing doublets: refining a mesh to ensure that faces share at
/// most one edge, 1995). The layer there is then in two halves, and a row of faces with one edge each on the crease
/// lies between crease and steps. New points inside lie between those they were split from. New points on the wall lie
/// at `width` (a ratio) of the way from the crease to the points beside it.
///
/// `layer` has one prism on each wall face and was grown from `plain`. Linear in the faces of walls.
CreaseSheets insertCreaseSheets(LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls,
                                const CreaseCharts& charts, double width);

} // namespace atria
