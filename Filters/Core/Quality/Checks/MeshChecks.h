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

/// Result of one check. A check fails if a value is beyond its limit.
struct MeshCheck
{
  const char* name;  ///< as in docs/arrays.md
  const char* set;   ///< checkMesh's name for the set of failing parts; empty if it has none
  MeshPart part;     ///< kind of part that `failing` lists; the whole mesh is one part, number 0
  bool isError;      ///< true if checkMesh counts it as failed; else it only reports it
  bool greaterFails; ///< true if values above the limit fail, else values below
  double limit;
  double worst;               ///< over the mesh; not a number if there is nothing to judge
  double mean;                ///< likewise; for angles between A and d, the angle of the mean cosine in degrees
  std::vector<Index> failing; ///< rising
  std::size_t failingCount;   ///< number of failing parts; in a part of a mesh, that of the whole
  Vec3 first;                 ///< centroid of the first failing cell or face; in a part of a mesh, that of the whole
};

/// A part of a mesh whose other parts are on other ranks: its own cells and at least two rings of cells around them, in
/// their order in the whole mesh (WidePiece.h).
struct CheckedPart
{
  std::span<const char> isOwn;            ///< one entry per cell
  std::span<const std::int64_t> cellIds;  ///< numbers that put cells in the order of the whole, rising
  std::span<const std::int64_t> pointIds; ///< numbers of points in the whole, rising
  RankExchange& exchange;
};

/// All checks of geometry that make sense without coupled or empty patches, in checkMesh's order.
struct MeshVerdict
{
  std::vector<MeshCheck> checks;

  const MeshCheck& operator[](const std::string& name) const; ///< throws Error for a name that no check has
  /// Returns the number that checkMesh prints: it counts open and long cells as one check.
  int failedChecks() const;
  bool ok() const { return failedChecks() == 0; }
};

/// Judges a mesh with the limits and the rounding of OpenFOAM 1912: values exactly on a limit fail here if they fail
/// there. The faces are those of `mesh`; a polyMesh with the same faces in another order has the same failing cells.
/// Throws Aborted when asked to. The result has the same bits for any number of threads. With `part`, all ranks call it
/// at the same time. Worst values, and means up to rounding, are then those of the whole mesh, as are verdicts on own
/// cells and their faces and points. `failing` lists local failures, ghosts included.
MeshVerdict checkMesh(const MeasuredMesh& mesh, const RunContext& context, const CheckedPart* part = nullptr);

/// Returns the checks that each cell, one of its faces or one of its points fails: bit i stands for checks[i].
std::vector<std::uint32_t> failedChecksOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict);

/// The same, for checks that are errors only.
std::vector<std::uint32_t> failedErrorsOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict);

} // namespace atria
