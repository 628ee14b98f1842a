// SPDX-License-Identifier: GPL-3.0-or-later
/// The verdict of OpenFOAM's `checkMesh -allGeometry` on a mesh, without OpenFOAM.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/RankExchange.h"
#include "Support/RunContext.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace atria {

enum class MeshPart : std::uint8_t
{
  Mesh,
  Cells,
  Faces,
  Points
};

/// What one check found. A check fails where a value is beyond its limit.
struct MeshCheck
{
  const char* name;  ///< as in docs/arrays.md
  const char* set;   ///< checkMesh's name of the set of what fails; empty where it has none
  MeshPart part;     ///< what `failing` numbers; all of the mesh is one thing, number 0
  bool isError;      ///< checkMesh counts it as failed; else it only tells
  bool greaterFails; ///< beyond the limit is above it, else below
  double limit;
  double worst;               ///< over the mesh; not a number where there is nothing to judge
  double mean;                ///< likewise; of the cosine, in degrees, for angles between A and d
  std::vector<Index> failing; ///< rising
  std::size_t failingCount;   ///< how many these are; of a part of a mesh, how many of the whole
  Vec3 first;                 ///< centroid of the first of them, if they are cells or faces; of a part, of the whole
};

/// A part of a mesh whose other parts are with other ranks: its own cells and at least two rings of cells about them,
/// in the order that they have in the whole (WidePiece.h).
struct CheckedPart
{
  std::span<const char> isOwn;            ///< by cell
  std::span<const std::int64_t> cellIds;  ///< numbers that put cells in the order of the whole, rising
  std::span<const std::int64_t> pointIds; ///< numbers of points in the whole, rising
  RankExchange& exchange;
};

/// All checks of geometry that make sense without coupled or empty patches, in checkMesh's order.
struct MeshVerdict
{
  std::vector<MeshCheck> checks;

  const MeshCheck& operator[](const std::string& name) const; ///< throws Error for a name that no check has
  /// The number checkMesh prints: it takes open and long cells for one check.
  int failedChecks() const;
  bool ok() const { return failedChecks() == 0; }
};

/// Judges a mesh with the limits and to the rounding of OpenFOAM 1912: what lies exactly on a limit fails here where it
/// fails there. The faces are those of `mesh`; a polyMesh with the same faces in another order has the same failing
/// cells. Throws Aborted when asked to. The result has the same bits for any number of threads. Of a part the worst
/// values, and up to rounding the means, are those of the whole, as are verdicts on own cells and their faces and
/// points; `failing` numbers what fails here, ghosts among them. All ranks call it at the same time.
MeshVerdict checkMesh(const MeasuredMesh& mesh, const RunContext& context, const CheckedPart* part = nullptr);

/// For each cell the checks that it, one of its faces or one of its points fails: bit i stands for checks[i].
std::vector<std::uint32_t> failedChecksOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict);

/// The same of checks that are errors.
std::vector<std::uint32_t> failedErrorsOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict);

} // namespace atria
