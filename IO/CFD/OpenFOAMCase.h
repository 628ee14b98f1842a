// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a mesh as an OpenFOAM case.
#pragma once

#include "OpenFOAMFile.h"
#include "Quality/Faces/FaceMesh.h"
#include "Support/RunContext.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace atria {

/// Some of a mesh's boundary faces under one name. The names of the domain's sides (xMin … zMax) make it of
/// OpenFOAM's type `patch`, any other a `wall`.
struct BoundaryPatch
{
  std::string name;
  std::vector<Index> faces;
};

/// Writes constant/polyMesh into a case: points, faces, owner, neighbor and boundary, and cellZones where
/// `zoneIds` (one per cell, or none) has more than one value. Makes the folder where it is missing; files of an earlier
/// mesh are replaced once all new ones are complete, and stay if writing fails or is aborted. Large files are written
/// side by side.
/// - Points no face has are left out.
/// - Names become valid and unique (see OpenFOAMNames.h); a comment in `boundary` records what they were.
/// - Boundary faces in no patch come last, in a patch `defaultFaces` of type `patch`.
/// - Zones are named zone<id>.
/// Throws Error for a folder or file that cannot be written, for faces in patches that are not on the
/// boundary or in two patches, and for a mesh too large for 32-bit labels.
void writePolyMesh(const std::filesystem::path& caseFolder, const FaceMesh& mesh,
                   std::span<const BoundaryPatch> patches, std::span<const std::int64_t> zoneIds, OpenFOAMFormat format,
                   const RunContext& context);

/// Adds the least that OpenFOAM's utilities ask for, where it is not there: system/controlDict, fvSchemes and
/// fvSolution, and an empty <case>.foam by which ParaView opens it. Throws Error for a file that cannot be
/// written.
void completeCase(const std::filesystem::path& caseFolder);

} // namespace atria
