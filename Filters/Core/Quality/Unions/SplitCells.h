// SPDX-License-Identifier: GPL-3.0-or-later
/// Cuts cells into pyramids over their faces.
#pragma once

#include "Quality/Faces/FaceMesh.h"

#include <span>
#include <vector>

namespace atria {

struct SplitCells
{
  std::vector<Index> faceOf; ///< one entry per old face: its new number
  /// One entry per pyramid, except the first of each cell, which has the cell's number: the cell that it is part of.
  /// These pyramids are numbered from the old cell count on.
  std::vector<Index> cellOf;
};

/// Cuts each of these cells into pyramids from its centroid over its faces. The centroids become new points after all
/// others. Faces of the cells stay and have the order that FaceMesh requires. `cells` must be distinct and their
/// centroids must see all their faces. O(n log n) in the number of faces.
SplitCells splitIntoPyramids(FaceMesh& mesh, std::span<const Index> cells);

} // namespace atria
