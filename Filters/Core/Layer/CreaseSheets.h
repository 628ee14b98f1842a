// SPDX-License-Identifier: GPL-3.0-or-later
/// Crease sheets of hexahedra along creases.
#pragma once

#include "Layer/LayerTopology.h"

#include <algorithm>

namespace atria {

/// Walls by the smooth pieces they are on, and which of these get crease sheets.
struct CreaseCharts
{
  /// Per boundary face a number for its chart and side; noIndex where the layer is not whole or something is behind the
  /// face.
  std::vector<Index> pieceOf;
  /// By piece.
  std::vector<char> isParted;

  bool isEmpty() const { return std::ranges::find(isParted, 1) == isParted.end(); }
};

/// Where a crease runs across the grid, it follows steps of the mesh: wall faces have two edges on it, and the elements
/// there an angle of 180 degrees, wherever their points are. Found are pieces with such a face. Linear in the faces of
/// walls.
CreaseCharts findCreaseCharts(const LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls);

/// Parts pieces from what is about them by a sheet of hexahedra that runs above the layer and down to the wall along
/// creases (pillowing; Mitchell and Tautges, Pillowing doublets: refining a mesh to ensure that faces share at most one
/// edge, 1995). So the layer there is in two halves, and between crease and steps is a row of faces with one edge each
/// on the crease. New points lie between those they were split from; those on the wall by `width` of the way from the
/// crease to the points beside it.
///
/// `layer` has one prism on each face, grown from `plain`. Linear in the faces of walls.
CreaseSheets insertCreaseSheets(LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls,
                                const CreaseCharts& charts, double width);

} // namespace atria
