// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of one data object, as the ranks of a parallel run hold them.
#pragma once

#include "Support/Types.h"

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace atria {

/// Without cells, however many blocks there are.
bool isEmptyPiece(vtkDataObject* piece);

/// The piece, or a copy of it without cells that are another piece's. A mesh whose cells and points have global ids
/// keeps them: joinPieces() knows.
vtkSmartPointer<vtkDataObject> withoutGhosts(vtkDataObject* piece);

/// A mesh, or patches, in one where it stands in several pieces with global ids, one after the other; else as it is.
vtkSmartPointer<vtkDataObject> inOnePiece(vtkDataObject* data);

/// One object of all pieces, in their order. Surfaces of models become blocks of one composite, with the first piece's
/// field data. Collections become one, whose sets of the same name are one set. Unstructured grids become one whose
/// points of the same global id (GlobalPointIds) are one point. Throws Error where they have no such ids, as the two
/// sides of a sheet have the same places, and for other types. Grids, and polygons of collections, whose cells have
/// global ids too, are what they were before they were divided; see VtkNumberedPieces.h. \pre There is at least one.
///
/// `pieceOfCells`, if given, becomes the piece of each cell of such a grid, and else is left empty.
vtkSmartPointer<vtkDataObject> joinPieces(const std::vector<vtkSmartPointer<vtkDataObject>>& pieces,
                                          std::vector<Index>* pieceOfCells = nullptr);

} // namespace atria
