// SPDX-License-Identifier: GPL-3.0-or-later
/// Merges cells and faces, and avoids that valid cells fail checkMesh's checks because of it.
#pragma once

#include "Quality/Checks/MeshChecks.h"
#include "Quality/Faces/FaceMesh.h"
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
  /// Cells that are neither merged nor cut, rising.
  std::span<const Index> keptCells = {};
};

struct JudgedMesh
{
  FaceMesh mesh;
  std::vector<Index> cellOf; ///< one entry per old cell: its new cell, or the first pyramid if it was cut; empty if no
                             ///< cells changed
  std::vector<Index> added;  ///< one entry per further pyramid, which are the last cells: the new number of the cell
                             ///< that was cut
  std::vector<Index> faceOf; ///< one entry per old face: its new face, noIndex if it is now inside a cell; empty if no
                             ///< faces changed
  std::size_t mergedCells = 0;
  std::size_t mergedFaces = 0;
  MeshVerdict verdict;
  std::vector<std::string> failures; ///< see failureTexts()

  /// Returns the cell of an entry of `added`.
  std::size_t pyramid(std::size_t i) const { return mesh.cellCount - added.size() + i; }
};

/// Exchanges data about unions with the other parts of a mesh. This base class serves a whole mesh.
class UnionPort
{
public:
  virtual ~UnionPort() = default;
  /// Returns cells some of whose neighbors are missing.
  virtual std::vector<Index> cellsAtEnd() const { return {}; }
  /// Returns true if `here` is true in any part.
  virtual bool isAnywhere(bool here) const { return here; }
  /// Keeps the own cells of a list of cells before unions, and adds the cells that other parts found and that are in
  /// this one too. Sorts the list and removes duplicates.
  virtual void share(std::vector<Index>& cells) const;
  /// Returns the part before unions; null for a whole mesh.
  virtual const CheckedPart* before() const { return nullptr; }
  /// Returns the part after unions, valid until the next call; null for a whole mesh.
  virtual const CheckedPart* after(const JudgedMesh&) { return nullptr; }
  /// Throws RanksDisagree if parts made different unions of the same cells, or gave them different faces.
  virtual void expectSame(const JudgedMesh&) const {}
};

/// Merges cells and faces of a mesh and judges the result. Undoes unions of valid cells around cells that fail a check
/// but were valid before. Valid cells fail no check that is an error. Unions of cells that failed before stay: they
/// mostly trade a cell with too few neighbors for a concave one, which solvers tolerate better. `makeMesh` returns the
/// mesh; it is called again if a union may have to be undone, for a part in all parts. `patchOf` is as for
/// mergeCoplanarFaces(). The result does not depend on the number of threads. Throws Aborted when asked to.
///
/// For a part, the result equals that of the whole mesh for own cells and for cells that share faces with them; so do
/// verdict and failures. Counts are those of the part. All parts call it at the same time. Throws RanksDisagree if
/// unions reach farther than the part.
JudgedMesh uniteAndJudge(const std::function<FaceMesh()>& makeMesh, std::span<const Index> patchOf,
                         const UnionOptions& options, const RunContext& context, UnionPort& port);

/// The same for a whole mesh.
JudgedMesh uniteAndJudge(const std::function<FaceMesh()>& makeMesh, std::span<const Index> patchOf,
                         const UnionOptions& options, const RunContext& context);

} // namespace atria
