// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes a mesh as an OpenFOAM case.
#pragma once

#include "OpenFOAMFile.h"
#include "PolyMeshWriter.h"
#include "SolverMesh.h"
#include "Support/RunContext.h"

#include <filesystem>
#include <string>

namespace atria {

/// Writes constant/polyMesh into a case: points, faces, owner, neighbor and boundary, and cellZones where the mesh has
/// zones. Makes the folder where it is missing; files of an earlier mesh are replaced once all new ones are complete,
/// and stay if writing fails or is aborted. Large files are written side by side.
/// - Walls are of OpenFOAM's type `wall`, all other patches of type `patch`.
/// - Names become valid and unique (see PatchNames.h); a comment in `boundary` records what they were.
/// - Zones are named zone<id>.
/// Throws Error for a folder or file that cannot be written, and for a mesh too large for 32-bit labels.
void writePolyMesh(const std::filesystem::path& caseFolder, const SolverMesh& mesh, OpenFOAMFormat format,
                   const RunContext& context);

/// Returns patches as they stand in `boundary`, with names valid in OpenFOAM.
std::vector<PatchEntry> patchEntries(std::span<const SolverPatch> patches);

/// Return zones with names valid in OpenFOAM.
std::vector<CellZone> namedZones(std::vector<CellZone> zones);
std::vector<FaceZone> namedZones(std::vector<FaceZone> zones);

/// Removes the mesh of a case and all files that depend on it.
void removeMesh(const std::filesystem::path& caseFolder);

/// Throws Error for a mesh too large for 32-bit labels.
void checkLabels(const FaceMesh& mesh);

/// Adds the least that OpenFOAM's utilities require, if missing: system/controlDict, fvSchemes and fvSolution. Also
/// adds an empty <case>.foam by which ParaView opens the case. Throws Error for a file that cannot be written.
void completeCase(const std::filesystem::path& caseFolder);

/// Folder of a case for its domain without buildings.
inline constexpr const char* emptyDomainFolder = "empty_domain";

/// Returns the path, within the case, of a result that a run has left, such as the fields of a later time. Also
/// searches the folders of processors, wind directions and the empty domain. Returns an empty string if there is none.
std::string resultIn(const std::filesystem::path& caseFolder);

/// Throws Error unless `result`, from resultIn(), is empty: the result would be taken for one of another mesh or case.
void refuseResult(const std::filesystem::path& caseFolder, const std::string& result);

} // namespace atria
