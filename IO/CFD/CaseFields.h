// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "FlowCase.h"
#include "FoamText.h"

namespace atria {

/// What the files of one wind direction, or of a room, are written from.
struct CaseOfDirection
{
  const CaseMesh& mesh;
  const FlowCaseSettings& settings;
  Vec3 wind;                        ///< of length 1; zero in a room
  std::vector<PatchChoice> choices; ///< by patch
  std::vector<Vec3> probes;

  std::vector<std::string> namesOf(PatchRole role) const;
  bool isRoom() const { return settings.kind == FlowKind::Room; }
  bool usesOmega() const { return settings.turbulence == TurbulenceModel::KOmegaSST; }
};

/// Writes the folder 0. Throws Error where a condition rule names a field that there is not.
void writeFields(const std::filesystem::path& folder, const CaseOfDirection& flow);

} // namespace atria
