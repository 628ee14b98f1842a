// SPDX-License-Identifier: GPL-3.0-or-later
/// The folders constant and system of a flow case: models, schemes, solvers and functions.
#pragma once

#include "CaseFields.h"

namespace atria {

/// Most iterations for the age of air each time it is written.
inline constexpr int ageCorrectors = 200;

/// Schemes and correctors by the largest angle between a face's normal and the line between its cells, after common
/// practice with OpenFOAM. Up to 60 degrees the correction is full, up to 70 degrees half, above a third.
struct OrthogonalityRule
{
  std::string correction; ///< for Laplacians and normal gradients
  /// Correction for k, epsilon and omega. A correction limited to the share c is at most c / (1 - c) of the implicit
  /// part. With c of 1 - r at most, for a relaxation r, it takes less from a cell than relaxation keeps there, (1 - r)
  /// / r of its previous value. Values stay positive, unless neighbors fall by half in one iteration. OpenFOAM replaces
  /// a negative epsilon by nearly zero; the viscosity then has no limit and the wind blows up.
  std::string turbulenceCorrection;
  int correctors; ///< additional solutions of the pressure
  double pressureRelaxation;
  double equationRelaxation;   ///< for U
  double turbulenceRelaxation; ///< for k, epsilon, omega
};
OrthogonalityRule ruleForAngle(double worstNonOrthogonality);

/// Write the folders constant (except the mesh) and system. Throw Error if a file cannot be written.
void writeConstant(const std::filesystem::path& folder, const CaseOfDirection& flow);
void writeSystem(const std::filesystem::path& folder, const CaseOfDirection& flow);
/// Adds the functions of system/controlDict: quantities measured while the case runs.
void addFunctions(FoamText& text, const CaseOfDirection& flow);

} // namespace atria
