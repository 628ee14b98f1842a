// SPDX-License-Identifier: GPL-3.0-or-later
/// A flow case for one wind direction, or for a room: mesh, settings, and what rules chose.
#pragma once

#include "CaseTable.h"
#include "FlowCase.h"

#include <cstddef>
#include <string>
#include <vector>

namespace atria {

/// A flow case for one wind direction, or for a room; its files are written from it.
struct CaseOfDirection
{
  const CaseMesh& mesh;
  const FlowCaseSettings& settings;
  Vec3 wind;                        ///< length 1; zero in a room
  std::vector<PatchChoice> choices; ///< one per patch
  std::vector<Vec3> probes;
  std::vector<CaseScalar> scalars = {};
  std::vector<CaseCanopy> canopies = {};
  std::vector<CaseBaffle> baffles = {};
  CaseHeat heat = {};

  std::vector<std::string> namesOf(PatchRole role) const;
  /// Returns the names of all walls but the ground.
  std::vector<std::string> walls() const;
  /// Returns the walls that are buildings, by index of the patch: all but those as long as the domain along the wind,
  /// such as the sides of a wind tunnel.
  std::vector<std::size_t> buildings() const;
  /// Returns the roughness length of a Ground, meters.
  double roughnessOf(const PatchChoice& choice) const { return choice.roughness.value_or(settings.wind.roughness); }
  /// True if the case has sources of turbulence by leaves: OpenFOAM has them in a variant of k-epsilon only.
  bool leavesMakeTurbulence() const { return !canopies.empty() && settings.turbulence == TurbulenceModel::KEpsilon; }
  bool isRoom() const { return settings.kind == FlowKind::Room; }
  /// True for a case of wind that blows.
  bool hasWind() const { return !isRoom() && !settings.calm; }
};

/// Returns the fields of a case: those of all cases, and its scalars. Some have no file.
std::vector<CaseField> fieldsOf(const CaseOfDirection& flow);
/// Returns the scalar of a field, or null.
const CaseScalar* scalarOf(const CaseOfDirection& flow, const CaseField& field);

} // namespace atria
