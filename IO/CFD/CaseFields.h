// SPDX-License-Identifier: GPL-3.0-or-later
/// The folder 0 of a flow case: initial fields and boundary conditions.
#pragma once

#include "FlowCase.h"
#include "FoamText.h"

namespace atria {

/// A flow case for one wind direction, or for a room; its files are written from it.
struct CaseOfDirection
{
  const CaseMesh& mesh;
  const FlowCaseSettings& settings;
  Vec3 wind;                        ///< length 1; zero in a room
  std::vector<PatchChoice> choices; ///< one per patch
  std::vector<Vec3> probes;

  std::vector<std::string> namesOf(PatchRole role) const;
  bool isRoom() const { return settings.kind == FlowKind::Room; }
  bool usesOmega() const { return settings.turbulence == TurbulenceModel::KOmegaSST; }
};

/// Writes the folder 0. Throws Error if a condition rule names an unknown field.
void writeFields(const std::filesystem::path& folder, const CaseOfDirection& flow);

} // namespace atria
