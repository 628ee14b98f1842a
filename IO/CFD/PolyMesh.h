// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh as OpenFOAM has it on file.
#pragma once

#include "MeshZones.h"

#include "Quality/Faces/FaceMesh.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace atria {

struct PolyPatch
{
  std::string name;
  std::string type;
  std::vector<Index> faces;                       ///< in the order of the file
  std::map<std::string, std::string> others = {}; ///< entries but for its type and place, such as inGroups
};

struct PolyMesh
{
  FaceMesh mesh; ///< boundary faces are sorted by owner, so they have other numbers than on file
  std::vector<PolyPatch> patches;
  std::vector<FaceZone> faceZones;
  std::vector<CellZone> cellZones;
};

/// Reads constant/polyMesh of a case, ascii or binary, compressed or not. Throws Error naming the file and line where
/// one is missing or damaged, or where numbers do not go together.
PolyMesh readPolyMesh(const std::filesystem::path& caseFolder);

/// Changes types of patches, by name, and leaves all else in the file as it stands.
void setPatchTypes(const std::filesystem::path& caseFolder, const std::map<std::string, std::string>& types);

} // namespace atria
