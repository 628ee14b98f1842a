// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpenFOAMCase.h"

#include "CaseTable.h"
#include "FoamText.h"
#include "OutputFolders.h"
#include "PolyMeshWriter.h"
#include "Support/Error.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

namespace atria {

namespace {

namespace fs = std::filesystem;

/// Removes zones and compressed files of an earlier mesh, which would be read along with, or instead of, the new ones.
void removeEarlierMesh(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const char* name : {"points", "faces", "owner", "neighbour", "boundary", "cellZones", "faceZones", "pointZones",
                           "cellLevel", "pointLevel", "level0Edge", "surfaceIndex"})
  {
    files.push_back(folder / name);
    files.push_back(folder / (std::string(name) + ".gz"));
  }
  removeFiles(files);
}

/// Returns a name for a comment of one line.
std::string comment(std::string name)
{
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F || c == '\\'; }, ' ');
  return '"' + name + '"';
}

/// Returns zones with names valid in OpenFOAM.
template <typename Zone> std::vector<Zone> withNames(std::vector<Zone> zones)
{
  std::vector<std::string> names;
  std::ranges::transform(zones, std::back_inserter(names), &Zone::name);
  const std::vector<PatchName> words = makePatchNames(names, openFOAMNames);
  for (std::size_t z = 0; z < zones.size(); ++z)
  {
    zones[z].name = words[z].word;
  }
  return zones;
}

/// Writes a dictionary that a mesh without a flow needs, unless there is one.
void writeDictionary(const fs::path& caseFolder, const char* file)
{
  if (!fs::exists(caseFolder / file))
  {
    writeFoamFile(caseFolder, file, "dictionary", textOf(caseFiles(), file, {{"meshOnly"}, {}}));
  }
}

/// True if OpenFOAM would take a folder of that name for the fields of a time after the first.
bool isLaterTime(const std::string& name)
{
  return name.find_first_not_of("0123456789.e-+") == std::string::npos && std::atof(name.c_str()) > 0.0;
}

} // namespace

void checkLabels(const FaceMesh& mesh)
{
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (mesh.facePoints.size() > most || mesh.faceCount() >= most || mesh.points.size() > most)
  {
    throw Error("the mesh is too large for OpenFOAM's 32-bit labels");
  }
}

std::vector<PatchEntry> patchEntries(std::span<const SolverPatch> of)
{
  const std::vector<PatchName> names = namesOf(of, openFOAMNames);
  std::vector<PatchEntry> patches;
  for (std::size_t p = 0; p < names.size(); ++p)
  {
    const SolverPatch& patch = of[p];
    const std::string& group = names[p].group;
    PatchEntry entry{names[p].word,
                     {{"type", patch.isWall() ? "wall" : "patch"}},
                     patch.firstFace,
                     patch.faceCount,
                     comment(patch.name)};
    if (!group.empty())
    {
      // OpenFOAM puts a wall into the group `wall` only where no other groups are given.
      entry.entries.emplace_back("inGroups", (patch.isWall() && group != "wall" ? "2(wall " : "1(") + group + ")");
    }
    patches.push_back(std::move(entry));
  }
  return patches;
}

std::vector<CellZone> namedZones(std::vector<CellZone> zones) { return withNames(std::move(zones)); }
std::vector<FaceZone> namedZones(std::vector<FaceZone> zones) { return withNames(std::move(zones)); }

void removeMesh(const fs::path& caseFolder) { removeEarlierMesh(caseFolder / "constant" / "polyMesh"); }

void writePolyMesh(const fs::path& caseFolder, const SolverMesh& mesh, OpenFOAMFormat format, const RunContext& context)
{
  checkLabels(mesh.mesh);
  const fs::path folder = caseFolder / "constant" / "polyMesh";
  makeFolder(folder);
  const UnfinishedFolder unfinished(folder / ".unfinished");
  const PolyMeshWriter writer(unfinished.path, mesh.mesh, format, context.progress);
  context.progress.report(0.0, "Writing points and faces");
  const std::array files{&PolyMeshWriter::writeFaces, &PolyMeshWriter::writePoints, &PolyMeshWriter::writeOwners,
                         &PolyMeshWriter::writeNeighbors};
  context.executor.forEach(files.size(), 1, [&](std::size_t i) { (writer.*files[i])(); });
  context.progress.report(0.9, "Writing patches");
  writer.writeBoundary(patchEntries(mesh.patches));
  writer.writeFaceZones(namedZones(mesh.faceZones));
  writer.writeCellZones(namedZones(mesh.cellZones));
  context.progress.report(1.0, "Mesh written");
  removeEarlierMesh(folder);
  unfinished.moveFilesTo(folder);
}

void completeCase(const fs::path& caseFolder)
{
  for (const char* file : {"system/controlDict", "system/fvSchemes", "system/fvSolution"})
  {
    writeDictionary(caseFolder, file);
  }
  const fs::path whole = fs::absolute(caseFolder).lexically_normal();
  const fs::path named = whole.has_filename() ? whole : whole.parent_path(); // "case/" means "case"
  const fs::path marker = caseFolder / (named.filename().string() + ".foam");
  if (!std::ofstream(marker, std::ios::app))
  {
    throw OutputError("cannot write '" + marker.string() + "'");
  }
}

std::string resultIn(const fs::path& caseFolder)
{
  if (!fs::is_directory(caseFolder))
  {
    return {};
  }
  const bool isOfProcessor = caseFolder.filename().string().starts_with("processor");
  for (const fs::directory_entry& entry : fs::directory_iterator(caseFolder))
  {
    std::string name = entry.path().filename().string();
    if (name.starts_with("log.") || name == "postProcessing" || (entry.is_directory() && isLaterTime(name)) ||
        (isOfProcessor && name != "0" && name != "constant"))
    {
      return name;
    }
    const bool isPart = name.starts_with("processor") || name.starts_with("wind_") || name == emptyDomainFolder;
    if (const std::string result = isPart ? resultIn(entry.path()) : std::string(); !result.empty())
    {
      return name.append("/").append(result);
    }
  }
  return {};
}

void refuseResult(const fs::path& caseFolder, const std::string& result)
{
  if (!result.empty())
  {
    throw Error("'" + caseFolder.string() + "' holds results of a run (" + result +
                "): run ./Allclean there or choose another folder");
  }
}

} // namespace atria
