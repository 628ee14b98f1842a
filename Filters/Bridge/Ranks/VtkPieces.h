// SPDX-License-Identifier: GPL-3.0-or-later
/// Joins the pieces of one data object that the ranks of a parallel run hold.
#pragma once

#include "Support/Types.h"

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace atria {

/// True if the data has no cells in any block.
bool isEmptyPiece(vtkDataObject* piece);

/// Returns the piece, or a copy without cells of other pieces. A mesh whose cells and points have global ids keeps its
/// ghosts; joinPieces() removes them.
vtkSmartPointer<vtkDataObject> withoutGhosts(vtkDataObject* piece);

/// Joins a mesh or patches that consist of several pieces with global ids, one after the other; returns other data
/// unchanged.
vtkSmartPointer<vtkDataObject> inOnePiece(vtkDataObject* data);

/// Joins all pieces into one object, in their order. Surfaces of models become blocks of one composite, with the first
/// piece's field data. Collections are merged; sets of the same name become one set. Unstructured grids are merged;
/// points with the same global id (GlobalPointIds) become one point. Throws Error if they have no such ids, as the two
/// sides of a sheet have the same positions, and for other types. Grids, and polygons of collections, whose cells have
/// global ids too become what they were before they were divided; see VtkNumberedPieces.h. \pre There is at least one.
///
/// `pieceOfCells`, if given, becomes the piece of each cell of such a grid; it stays empty for other data.
vtkSmartPointer<vtkDataObject> joinPieces(const std::vector<vtkSmartPointer<vtkDataObject>>& pieces,
                                          std::vector<Index>* pieceOfCells = nullptr);

} // namespace atria
