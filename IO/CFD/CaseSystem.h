// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "CaseFields.h"

namespace atria {

/// How often the age of air is solved for where it is written, at most.
inline constexpr int ageCorrectors = 200;

/// Schemes and correctors by the worst angle between a face's normal and the line between its cells, after the rules
/// that users of OpenFOAM share: to 60 degrees all is corrected, to 70 half of it, beyond a third.
struct OrthogonalityRule
{
  std::string correction; ///< of Laplacians and normal gradients
  /// Of k, epsilon and omega. Limited to the share c, it is at most c / (1 - c) of what is solved for. With c of 1 - r
  /// at most, for a relaxation r, it takes less from a cell than relaxation keeps there, (1 - r) / r of what it had:
  /// values stay positive, unless those beside fall by half in one iteration. Where epsilon gets negative, OpenFOAM
  /// makes it next to nothing, so that the viscosity has no limit and the wind blows up.
  std::string turbulenceCorrection;
  int correctors; ///< solutions of the pressure more
  double pressureRelaxation;
  double equationRelaxation;   ///< of U
  double turbulenceRelaxation; ///< of k, epsilon, omega
};
OrthogonalityRule ruleForAngle(double worstNonOrthogonality);

/// Writes the folders constant (but for the mesh) and system. Throws Error for a file that cannot be written.
void writeConstant(const std::filesystem::path& folder, const CaseOfDirection& flow);
void writeSystem(const std::filesystem::path& folder, const CaseOfDirection& flow);
/// The functions of system/controlDict: what is measured while the case runs.
void addFunctions(FoamText& text, const CaseOfDirection& flow);

} // namespace atria
