// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of cells, and the quality that a group of cells would have as one cell.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/RunContext.h"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace atria {

/// Merged cells: the cell that each one belongs to, and the faces of cells that others belong to. Also cells that are
/// to be cut into pyramids, see splitIntoPyramids(); they keep their number and faces here.
class CellUnions
{
public:
  /// `patchOf` as for mergeCoplanarFaces(), `zoneOf` as in KeptParts; they must outlive this, as the mesh must.
  CellUnions(const FaceMesh& mesh, std::span<const Index> patchOf, const Executor& executor,
             std::span<const Index> zoneOf = {});

  /// Returns the patch of a boundary face.
  Index patchOf(Index face) const { return patches.empty() ? 0 : patches[face - mesh.internalFaceCount()]; }

  /// Returns the cell that represents the union that `cell` is part of: the lowest of its cells.
  Index cellOf(Index cell) const { return into[cell]; }
  /// Returns the two current cells of a face; the second is noIndex on the boundary.
  std::pair<Index, Index> sidesOf(Index face) const;
  std::span<const Index> facesOf(Index cell) const;
  /// Returns the faces that these cells do not share with each other; rising.
  std::vector<Index> outerFaces(std::span<const Index> cells) const;
  /// Returns the cells beyond the outer faces of these, except cells beyond a face of a zone; rising.
  std::vector<Index> neighborsOf(std::span<const Index> cells) const;
  /// Merges these cells. None of them may be marked for cutting.
  void unite(std::span<const Index> cells);
  /// True if other cells belong to this one.
  bool isUnited(Index cell) const { return united.contains(cell); }
  /// Marks a cell for cutting. No other cell may belong to it.
  void split(Index cell) { cut.insert(cell); }
  bool isSplit(Index cell) const { return cut.contains(cell); }
  const std::set<Index>& splitCells() const { return cut; }

  const FaceMesh& mesh;

private:
  bool isOfZone(Index face) const { return face < zones.size() && zones[face] != noIndex; }

  std::span<const Index> patches;
  std::span<const Index> zones;
  CellFaces faces;
  std::vector<Index> into;
  std::map<Index, std::vector<Index>> united;    ///< faces of cells that others belong to
  std::map<Index, std::vector<Index>> membersOf; ///< and the cells they were
  std::set<Index> cut;
};

/// Verdict of checkMesh() on the cell that a group of cells would become.
struct UnionVerdict
{
  bool isBall = false;     ///< true if it is a closed ball with four faces at least; if not, all other values are false
                           ///< or 0
  bool sound = false;      ///< fails no check that is an error, except determinant and concavity, and its penalty is at
                           ///< most 0.99 (69.3 degrees of non-orthogonality, skewness 3.96)
  bool determined = false; ///< passes the check of its determinant
  bool concave = false;
  double penalty = 0.0; ///< penalty of its worst face: 1 at 70 degrees of non-orthogonality or a skewness of 4
};

/// Judges the union of cells that are connected over faces, both as it is and after merging its coplanar faces.
UnionVerdict judgeUnion(const CellUnions& unions, std::span<const Index> cells, const Executor& executor);

/// Returns the greatest penalty (see UnionVerdict) of the pyramids that a cell would be cut into. Returns nullopt
/// unless, after merging coplanar faces, the pyramids pass all checks of checkMesh() that are errors, their penalty is
/// at most 0.99, and the cell's neighbors pass all such checks that they pass now.
std::optional<double> splitPenalty(const CellUnions& unions, Index cell, const Executor& executor);

} // namespace atria
