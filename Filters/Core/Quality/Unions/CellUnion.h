// SPDX-License-Identifier: GPL-3.0-or-later
/// What a group of cells would be as one cell.
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

/// Cells that are made one: which cell each now belongs to, and the faces of those that others belong to. And cells
/// that are to be cut into pyramids, see splitIntoPyramids(); they keep their number and faces here.
class CellUnions
{
public:
  /// `patchOf` as for mergeCoplanarFaces(), `zoneOf` as in KeptParts; they must outlive this, as the mesh must.
  CellUnions(const FaceMesh& mesh, std::span<const Index> patchOf, const Executor& executor,
             std::span<const Index> zoneOf = {});

  /// Of a boundary face.
  Index patchOf(Index face) const { return patches.empty() ? 0 : patches[face - mesh.internalFaceCount()]; }

  /// The cell that stands for the one that `cell` is part of: the lowest of its cells.
  Index cellOf(Index cell) const { return into[cell]; }
  /// The two cells of a face, as they are now; the second is noIndex on the boundary.
  std::pair<Index, Index> sidesOf(Index face) const;
  std::span<const Index> facesOf(Index cell) const;
  /// The faces that some of these cells have and do not share with each other; rising.
  std::vector<Index> outerFaces(std::span<const Index> cells) const;
  /// The cells beyond the outer faces of these, but for those beyond a face of a zone; rising.
  std::vector<Index> neighborsOf(std::span<const Index> cells) const;
  /// Makes these one. None of them is to be cut.
  void unite(std::span<const Index> cells);
  /// Whether other cells belong to this one.
  bool isUnited(Index cell) const { return united.contains(cell); }
  /// Has a cell cut to which no others belong.
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

/// A cell that others would become, as checkMesh() judges it.
struct UnionVerdict
{
  bool isBall = false;     ///< is closed and a ball, with four faces at least; all else is false where it is not
  bool sound = false;      ///< fails in nothing but its determinant and concavity, with 69 degrees of
                           ///< non-orthogonality and a skewness of 3.9 at most
  bool determined = false; ///< nor in its determinant
  bool concave = false;
  double penalty = 0.0; ///< of its worst face, 1 at 70 degrees of non-orthogonality or a skewness of 4
};

/// Judges the union of cells that are connected over faces, as it is and once its coplanar faces are merged.
UnionVerdict judgeUnion(const CellUnions& unions, std::span<const Index> cells, const Executor& executor);

/// The greatest penalty of the pyramids of a cell, as UnionVerdict has it. Nothing unless these would pass all of
/// checkMesh()'s checks, with 69 degrees of non-orthogonality and a skewness of 3.9 at most, and the cell's neighbors
/// all they pass now, once coplanar faces are merged.
std::optional<double> splitPenalty(const CellUnions& unions, Index cell, const Executor& executor);

} // namespace atria
