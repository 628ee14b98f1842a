// SPDX-License-Identifier: GPL-3.0-or-later
/// The verdict of OpenFOAM's `checkMesh -allGeometry` on a mesh, without OpenFOAM.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/RunContext.h"

#include <cstdint>
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
/// cells. Throws Aborted when asked to. The result has the same bits for any number of threads.
MeshVerdict checkMesh(const MeasuredMesh& mesh, const RunContext& context);

/// For each cell the checks that it, one of its faces or one of its points fails: bit i stands for checks[i].
std::vector<std::uint32_t> failedChecksOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict);

/// The same of checks that are errors.
std::vector<std::uint32_t> failedErrorsOfCells(const MeasuredMesh& mesh, const MeshVerdict& verdict);

} // namespace atria
