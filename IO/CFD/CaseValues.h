// SPDX-License-Identifier: GPL-3.0-or-later
/// The facts and values that the templates of a flow case are filled with.
#pragma once

#include "CaseOfDirection.h"

#include <array>

namespace atria {

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

/// Returns OpenFOAM's name, which is also a fact.
const char* modelName(TurbulenceModel model);

/// Returns the diffusivities of heat in air at rest (m2/s), and over the viscosity of eddies.
std::array<double, 2> heatDiffusivities();

/// Returns what all templates of the case may name. Each patch has a copy, so long lists are not in it.
Filling fillingOf(const CaseOfDirection& flow);
/// Adds what boundary conditions of a patch may name.
void addPatch(Filling& filling, const CaseOfDirection& flow, const CasePatch& patch, const PatchChoice& choice);
/// True if the jump at a baffle depends on the flow, so that a model has to steady it. The solver takes the jump of the
/// flow before, which diverges where the loss coefficient is above some 1.
bool isSteadied(const CaseBaffle& baffle);
/// Adds what the sides of a face zone and its model may name.
void addBaffle(Filling& filling, const CaseBaffle& baffle);
/// Adds what boundary conditions of a patch may name for the temperature.
void addTemperatureAt(Filling& filling, const CaseOfDirection& flow, const CasePatch& patch);
/// Adds what boundary conditions of a patch may name for a scalar.
void addScalarAt(Filling& filling, const CaseScalar& scalar, const CasePatch& patch);

} // namespace atria
