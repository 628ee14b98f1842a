// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells cut into pyramids over their faces.
#pragma once

#include "Quality/Faces/FaceMesh.h"

#include <span>
#include <vector>

namespace atria {

struct SplitCells
{
  std::vector<Index> faceOf; ///< for each face before, the same face now
  /// For each pyramid but the first of its cell, which has the cell's number, the cell that it is a part of. These
  /// pyramids have the numbers from the cell count before on.
  std::vector<Index> cellOf;
};

/// Cuts each of these cells into pyramids over its faces about its centroid, a new point behind all others. Faces of
/// the cells stay, and have the order FaceMesh asks for. `cells` are different ones whose centroids see all their
/// faces. Time as for sorting all faces.
SplitCells splitIntoPyramids(FaceMesh& mesh, std::span<const Index> cells);

} // namespace atria
