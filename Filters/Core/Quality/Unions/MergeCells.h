// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells with too few neighbors made part of one, for formats that know polyhedra.
#pragma once

#include "Quality/Unions/MergeFaces.h"
#include "Support/RunContext.h"

#include <cstddef>
#include <span>
#include <vector>

namespace atria {

struct MergedCells
{
  std::vector<Index> cellOf; ///< for each cell before, the cell that it now is or is a part of, its first pyramid where
                             ///< it was cut; empty where none changed
  std::vector<Index> faceOf; ///< for each face before, the same face now; noIndex within a merged cell. Empty likewise
  std::size_t count = 0;     ///< how many cells became a part of another one
  /// For each pyramid but the first of its cell, which has the cell's number, the cell that was cut, by its number now.
  /// These pyramids are the last cells.
  std::vector<Index> added;
};

/// Makes each cell from whose neighbors no gradient can be determined (in a corner between walls it has but one or
/// two) one with a neighbor, or with several where one does not do; or, where no such union is convex, cuts it into
/// pyramids about its centroid if these pass all of checkMesh()'s checks. Points and boundary faces stay, except that
/// faces may get other numbers; apices come behind all other points. Cells keep their order, that of the lowest of
/// those that became one, and faces have the order FaceMesh asks for. Cells serve where their union is a closed ball
/// with four faces at least, is determined, has no more than 69 degrees of non-orthogonality and a skewness of 3.9, and
/// fails in no other check of checkMesh()'s, concavity apart, neither as it is nor once its coplanar faces are merged,
/// for which `patchOf` is as for mergeCoplanarFaces(). Of those that serve, with the fewest cells, one that is not
/// concave is taken as far as there is one, and then the one whose faces are least skew and oblique. Cells for which
/// none serves stay as they are, and all do in a mesh that is one cell thick. They are tried in rising order of their
/// numbers, one after the other: the result does not depend on threads. Linear in the number of faces, but for their
/// sorting where cells change. Throws Aborted when asked to.
MergedCells mergeUnderdeterminedCells(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                                      const KeptParts& kept = {});

} // namespace atria
