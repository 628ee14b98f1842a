// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of cells and faces that make no sound cell fail checkMesh's checks where that can be avoided.
#pragma once

#include "Quality/Checks/MeshChecks.h"
#include "Quality/Faces/FaceMesh.h"
#include "Quality/Unions/UnionRanks.h"
#include "Support/RunContext.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace atria {

struct UnionOptions
{
  bool mergeCells = true; ///< see mergeUnderdeterminedCells()
  bool mergeFaces = true; ///< see mergeCoplanarFaces()
  /// For each internal face the number of its zone or noIndex, as in KeptParts.
  std::span<const Index> zoneOf = {};
  /// Cells that are not made one with others, nor cut, rising.
  std::span<const Index> keptCells = {};
};

struct JudgedMesh
{
  FaceMesh mesh;
  std::vector<Index> cellOf; ///< for each cell before, the cell that it now is or is a part of, its first pyramid where
                             ///< it was cut; empty where no cells changed
  std::vector<Index> added;  ///< for each further pyramid, which are the last cells, the cell that was cut, by its
                             ///< number now
  std::vector<Index> faceOf; ///< for each face before, the face that it now is or is a part of, noIndex within a cell;
                             ///< empty where no faces changed
  std::size_t mergedCells = 0;
  std::size_t mergedFaces = 0;
  MeshVerdict verdict;
  std::vector<std::string> failures; ///< see failureTexts()

  /// The cell that an entry of `added` stands for.
  std::size_t pyramid(std::size_t i) const { return mesh.cellCount - added.size() + i; }
};

/// Merges cells and faces of a mesh, judges what comes of it, and undoes unions of sound cells about cells that fail a
/// check though they were sound before. Sound cells fail no check that is an error. Unions of cells that failed already
/// stay: mostly they trade a cell with too few neighbors for a concave one, which solvers rather take. `makeMesh` gives
/// the mesh; it is called once more where a union may have to be undone, of a part on all ranks. `patchOf` is as for
/// mergeCoplanarFaces(). The result does not depend on threads. Throws Aborted when asked to.
///
/// Of a part the mesh is that of its piece: of own cells, and of those that have faces with these, the result is that
/// of the whole, as are verdict and failures; counts are those of the part. All ranks call it at the same time. Throws
/// RanksDisagree where unions reach farther than the pieces.
JudgedMesh uniteAndJudge(const std::function<FaceMesh()>& makeMesh, std::span<const Index> patchOf,
                         const UnionOptions& options, const RunContext& context, const PieceOnRanks* part = nullptr);

} // namespace atria
