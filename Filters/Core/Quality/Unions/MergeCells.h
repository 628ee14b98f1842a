// SPDX-License-Identifier: GPL-3.0-or-later
/// Merges cells with too few neighbors into others, for formats with polyhedra.
#pragma once

#include "Quality/Unions/MergeFaces.h"
#include "Support/RunContext.h"

#include <cstddef>
#include <span>
#include <vector>

namespace atria {

struct MergedCells
{
  std::vector<Index> cellOf; ///< one entry per old cell: its new cell, or the first pyramid if it was cut; empty if
                             ///< none changed
  std::vector<Index> faceOf; ///< one entry per old face: its new number; noIndex inside a merged cell; empty likewise
  std::size_t count = 0;     ///< number of cells that became part of another one
  /// One entry per pyramid, except the first of each cell, which has the cell's number: the new number of the cell that
  /// was cut. These pyramids are the last cells.
  std::vector<Index> added;
};

/// Merges each cell whose neighbors do not determine a gradient (in a corner between walls it has only one or two) with
/// a neighbor, or with several if one is not enough. Cuts the cell into pyramids around its centroid instead if these
/// pass all of checkMesh()'s checks that are errors, and there is no such union, the union is concave, or its faces are
/// worse.
///
/// A union is accepted if it is a closed ball with four faces at least, is determined, has a penalty of at most 0.99
/// (UnionVerdict) and fails no other check of checkMesh() that is an error, except concavity. This must hold both as it
/// is and after merging its coplanar faces, for which `patchOf` is as for mergeCoplanarFaces(). Unions with the fewest
/// cells are preferred, among these one that is not concave, then the one whose faces are least skew and oblique. Cells
/// without an accepted union or pyramids stay as they are; so do all cells of a mesh that is one cell thick.
///
/// Points and boundary faces stay, but faces may get other numbers; apices follow all other points. Cells keep their
/// order; a union has the place of its lowest cell. Faces have the order that FaceMesh requires. Cells are tried one
/// after the other in rising order of their numbers: the result does not depend on the number of threads. Linear in the
/// number of faces, except for sorting them if cells change. Throws Aborted when asked to.
MergedCells mergeUnderdeterminedCells(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                                      const KeptParts& kept = {});

} // namespace atria
