// SPDX-License-Identifier: GPL-3.0-or-later
#include "FlowCase.h"

#include "CaseDescription.h"
#include "CaseFiles.h"
#include "Decomposition.h"
#include "EmptyDomain.h"
#include "FoamText.h"
#include "Grid/Prism.h"
#include "GroundRoughness.h"
#include "OutputFolders.h"
#include "PolyMeshWriter.h"
#include "ProcessorFolders.h"
#include "Support/Error.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>

namespace atria {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostProbes = 100;
/// Distance of probes from buildings, in heights of these.
constexpr double probeHeights = 1.5;

/// Returns the direction from the domain's xMin to its xMax, or against its first side, if there is such a side.
double directionOfDomain(const CaseMesh& mesh)
{
  for (const CasePatch& patch : mesh.patches)
  {
    if ((patch.name == sideNames[xMin] || patch.name == sideName(firstPrismSide)) && patch.area > 0.0)
    {
      return std::atan2(-patch.areaVector[1], -patch.areaVector[0]) * 180.0 / std::numbers::pi;
    }
  }
  return 0.0;
}

/// Returns the box for probes: around the walls, or over the whole ground if there are none.
Box3 surroundings(const CaseMesh& mesh, const std::vector<PatchChoice>& choices)
{
  Box3 walls;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    if (isWall(choices[i].role) && choices[i].role != PatchRole::Ground)
    {
      walls.extend(mesh.patches[i].bounds.min);
      walls.extend(mesh.patches[i].bounds.max);
    }
  }
  if (walls.empty())
  {
    return mesh.bounds;
  }
  const Vec3 margin = Vec3::Constant(probeHeights * walls.size()[2]);
  return {(walls.min - margin).cwiseMax(mesh.bounds.min), (walls.max + margin).cwiseMin(mesh.bounds.max)};
}

/// Returns new mesh types for patches whose role needs another one. Roles that depend on the wind are all of type
/// `patch`.
std::map<std::string, std::string> changedTypes(const CaseMesh& mesh, const std::vector<PatchChoice>& choices)
{
  std::map<std::string, std::string> types;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const PatchRole role = choices[i].role;
    const char* const wanted = isWall(role) ? "wall" : "patch";
    if (role != PatchRole::Constraint && mesh.patches[i].type != wanted)
    {
      types[mesh.patches[i].name] = wanted;
    }
  }
  return types;
}

/// Links a mesh. `other` is the case that has the mesh, as seen from the folder constant.
void linkMesh(const fs::path& folder, const fs::path& other)
{
  makeFolder(folder / "constant");
  const fs::path link = folder / "constant" / "polyMesh";
  std::error_code error;
  if (fs::is_symlink(link))
  {
    fs::remove(link, error);
  }
  fs::create_directory_symlink(other / "constant" / "polyMesh", link, error);
  if (error)
  {
    throw OutputError("cannot make the link '" + link.string() + "': " + error.message());
  }
}

void setTypes(const fs::path& caseFolder, PolyMesh& poly, const std::map<std::string, std::string>& types)
{
  setPatchTypes(caseFolder, types);
  for (PolyPatch& patch : poly.patches)
  {
    const auto wanted = types.find(patch.name);
    patch.type = wanted == types.end() ? patch.type : wanted->second;
  }
}

/// Writes the fields of each processor, which equal the case's as long as these are uniform. A direction also gets a
/// link to each processor's mesh.
void addProcessors(const fs::path& folder, bool isDirection, int processors)
{
  for (int i = 0; processors > 1 && i < processors; ++i)
  {
    const std::string name = "processor" + std::to_string(i);
    if (isDirection)
    {
      linkMesh(folder / name, fs::path("../../..") / name);
    }
    std::error_code error;
    fs::copy(folder / "0", folder / name / "0", fs::copy_options::recursive, error);
    if (error)
    {
      throw OutputError("cannot copy the fields to '" + (folder / name / "0").string() + "': " + error.message());
    }
  }
}

/// Returns the folders of the directions, within that of the case.
std::vector<std::string> foldersOf(const FlowCaseSettings& settings)
{
  if (settings.directions.size() == 1)
  {
    return {"."};
  }
  std::vector<std::string> folders;
  for (const double towards : settings.directions)
  {
    folders.push_back("wind_" + windLabel(windFrom(towards, settings.north)));
  }
  if (std::set(folders.begin(), folders.end()).size() != folders.size())
  {
    throw Error("a wind direction is given twice");
  }
  return folders;
}

/// Makes walls of inlets and outlets without faces, as conditions and functions of OpenFOAM divide by their areas.
/// Returns a warning for each.
std::vector<std::string> closeEmptyOpenings(CaseOfDirection& flow)
{
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    PatchChoice& choice = flow.choices[i];
    if (letsAirThrough(choice.role) && flow.mesh.patches[i].area <= 0.0)
    {
      warnings.push_back("no air passes '" + flow.mesh.patches[i].name + "': the mesh has no faces of it");
      choice = {};
    }
  }
  return warnings;
}

/// Returns the roughness length of the ground upstream if grounds have their own.
std::optional<double> ownRoughnessUpstream(const PolyMesh& poly, const CaseOfDirection& flow)
{
  const bool hasOwn =
      std::ranges::any_of(flow.choices, [](const PatchChoice& choice) { return choice.roughness.has_value(); });
  return hasOwn ? roughnessUpstream(poly, flow) : std::nullopt;
}

/// Settles openings without faces, and the scalars and the heat of a flow. Returns warnings of what may be wrong with
/// its patches.
std::vector<std::string> settle(CaseOfDirection& flow)
{
  std::vector<std::string> warnings = closeEmptyOpenings(flow);
  flow.scalars = caseScalars(flow.mesh, flow.settings, flow.choices);
  flow.heat = caseHeat(flow.mesh, flow.settings, flow.choices);
  std::ranges::copy(warnOfHeat(flow.heat, flow.settings.outdoorTemperature), std::back_inserter(warnings));
  std::ranges::copy(warnOfSheets(flow), std::back_inserter(warnings));
  if (flow.hasWind())
  {
    std::ranges::copy(warnOfRoughness(flow), std::back_inserter(warnings));
  }
  return warnings;
}

/// Links the folder of a direction to the mesh of the case.
void shareMesh(const fs::path& folder)
{
  removeProcessors(folder);
  linkMesh(folder, "../..");
  writePlainFile(folder / (folder.filename().string() + ".foam"), "");
}

/// Divides the zones of screens and fans. Returns true if there are any.
bool divideBaffles(PolyMesh& poly, const CaseOfDirection& flow)
{
  std::vector<DividedZone> zones;
  std::ranges::transform(flow.baffles, std::back_inserter(zones), &CaseBaffle::division);
  if (!zones.empty())
  {
    divideZones(poly, zones);
  }
  return !zones.empty();
}

/// Parts of a mesh that differ from those on file.
struct Changes
{
  bool faces = false;
  bool cellZones = false;
};

/// Divides the zones of screens and fans, sets the types of patches by their roles, writes what has changed, and the
/// parts for several processors.
void finishMesh(const fs::path& caseFolder, PolyMesh& poly, Changes changed, const CaseOfDirection& flow,
                const RunContext& context)
{
  const FlowCaseSettings& settings = flow.settings;
  changed.faces = divideBaffles(poly, flow) || changed.faces;
  if (changed.faces)
  {
    writePolyMesh(caseFolder, poly, settings.format, context.progress);
  }
  else if (changed.cellZones)
  {
    const fs::path polyMesh = caseFolder / "constant" / "polyMesh";
    fs::remove(polyMesh / "cellZones"); // without zones there is no file
    PolyMeshWriter(polyMesh, poly.mesh, settings.format, context.progress).writeCellZones(poly.cellZones);
  }
  setTypes(caseFolder, poly, changedTypes(flow.mesh, flow.choices));
  if (settings.processors > 1)
  {
    writeProcessors(caseFolder, poly, static_cast<std::size_t>(settings.processors), settings.format, context);
  }
}

std::string joinedLines(const std::string& first, const std::string& second)
{
  return second.empty() ? first : first + "\n" + second;
}

/// Settles the kind and, for wind, the directions. A room has one "direction" of no length.
void settleKind(const CaseMesh& mesh, FlowCaseSettings& settings)
{
  settings.kind = isRoom(mesh, settings) ? FlowKind::Room : FlowKind::Wind;
  if (settings.kind == FlowKind::Room && !settings.directions.empty())
  {
    throw Error("a room has no wind: give no wind directions, or make a case of wind");
  }
  if (settings.calm && !settings.directions.empty())
  {
    throw Error("Calm is without wind: give no wind directions");
  }
  if (settings.directions.empty())
  {
    settings.directions = {settings.kind == FlowKind::Room || settings.calm ? 0.0 : directionOfDomain(mesh)};
  }
}

/// Removes what an earlier case in the folder has added: fields of scalars and sources on file, zones of trees from the
/// mesh in memory. Returns true if there were zones of trees.
bool dropEarlier(const fs::path& caseFolder, PolyMesh& poly)
{
  std::ifstream in(caseFolder / "case.json");
  const auto earlier = nlohmann::json::parse(in, nullptr, false);
  if (!in || !earlier.is_object())
  {
    return false;
  }
  const auto listOf = [&](const char* name) { return earlier.value(name, nlohmann::json::array()); };
  for (const auto& direction : listOf("directions"))
  {
    const fs::path folder = caseFolder / direction.value("folder", ".");
    for (const auto& scalar : listOf("scalars"))
    {
      fs::remove(folder / "0" / scalar.value("name", "-"));
    }
    for (const auto& canopy : listOf("canopies"))
    {
      const std::string surface = surfaceFileOf({canopy.value("zone", "")});
      fs::remove(folder / surfaceFolder(OpenFOAMDialect::OpenCFD1912) / surface);
      fs::remove(folder / surfaceFolder(OpenFOAMDialect::Foundation) / surface);
    }
    if (earlier.contains("warm_air"))
    {
      fs::remove(folder / "0" / "T");
      fs::remove(folder / "constant" / "g");
    }
    fs::remove(folder / "constant" / "fvOptions");
    fs::remove(folder / "constant" / "fvModels");
  }
  const nlohmann::json trees = listOf("tree_zones");
  return std::erase_if(poly.cellZones, [&](const CellZone& zone) {
           return std::ranges::find(trees, nlohmann::json(zone.name)) != trees.end();
         }) > 0;
}

/// Adds the trees of the settings' file to the mesh, in memory.
PlantedTrees addTrees(PolyMesh& poly, const CaseOfDirection& flow, const RunContext& context)
{
  const std::vector<Tree> trees = readTrees(flow.settings.treeFile);
  PlantedTrees planted = plantTrees(poly, trees, flow.namesOf(PatchRole::Ground), context);
  if (planted.zones.empty())
  {
    throw Error("no tree of '" + flow.settings.treeFile.string() + "' has a cell of the mesh in its crown");
  }
  poly.cellZones.insert(poly.cellZones.end(), planted.zones.begin(), planted.zones.end());
  return planted;
}

/// Plants trees for the first direction; the others have the same. Returns the canopies of rules and trees.
std::vector<CaseCanopy> canopiesOfCase(PolyMesh& poly, const CaseOfDirection& flow, WrittenCase& written,
                                       nlohmann::ordered_json& report, const RunContext& context)
{
  std::vector<CaseCanopy> canopies = canopiesOf(flow.mesh, flow.settings.canopyRules);
  if (!flow.settings.treeFile.empty())
  {
    const PlantedTrees planted = addTrees(poly, flow, context);
    written.summary += summaryOf(planted);
    std::ranges::copy(warnOfMissed(planted), std::back_inserter(written.warnings));
    for (const CaseCanopy& canopy : planted.canopies)
    {
      report["tree_zones"].push_back(canopy.zone);
      canopies.push_back(canopy);
    }
  }
  if (canopies.empty())
  {
    return canopies;
  }
  if (flow.settings.turbulence == TurbulenceModel::KEpsilon)
  {
    addCenters(poly, canopies, context);
  }
  else
  {
    written.warnings.emplace_back("canopies slow the air, but this model of turbulence has no sources by leaves: k and "
                                  "epsilon behind trees are rough estimates. k-epsilon has them");
  }
  return canopies;
}

CaseOfDirection chosen(const CaseMesh& mesh, const FlowCaseSettings& settings, double towards)
{
  CaseOfDirection flow{mesh, settings, Vec3::Zero(), {}, {}};
  if (flow.isRoom())
  {
    flow.choices = chooseRoomPatches(mesh, settings);
    return flow;
  }
  flow.wind = settings.calm ? Vec3(Vec3::Zero()) : windVector(towards);
  flow.choices = choosePatches(mesh, settings, flow.wind);
  return flow;
}

/// Adds the folder of a direction to those in which inlets have no wind.
void addWindless(const std::vector<std::string>& inlets, const std::string& folder, Windless& windless)
{
  for (const std::string& name : inlets)
  {
    windless[name].push_back(folder);
  }
}

} // namespace

WrittenCase writeFlowCase(const fs::path& caseFolder, FlowCaseSettings settings, const RunContext& context)
{
  PolyMesh poly = readPolyMesh(caseFolder);
  Changes changed;
  changed.faces = uniteSides(poly);
  changed.cellZones = dropEarlier(caseFolder, poly);
  const CaseMesh mesh = describeMesh(poly, context);
  settleKind(mesh, settings);
  const std::vector<std::string> folders = foldersOf(settings);
  nlohmann::ordered_json report;
  WrittenCase written{settings.kind, {}, {}};
  Windless windless;
  std::vector<Upstream> upstreams;
  std::vector<CaseCanopy> canopies;
  const std::vector<CaseBaffle> baffles = bafflesOf(poly, settings, context);
  nlohmann::ordered_json treeReport = nlohmann::ordered_json::object();
  removeProcessors(caseFolder); // they belong to another mesh or number of processors
  for (std::size_t d = 0; d < folders.size(); ++d)
  {
    const fs::path folder = folders[d] == "." ? caseFolder : caseFolder / folders[d];
    CaseOfDirection flow = chosen(mesh, settings, settings.directions[d]);
    const std::vector<std::string> warnings = settle(flow);
    canopies = d == 0 ? canopiesOfCase(poly, flow, written, treeReport, context) : canopies;
    flow.canopies = canopies;
    flow.baffles = baffles;
    const std::optional<double> upstream = flow.hasWind() ? ownRoughnessUpstream(poly, flow) : std::nullopt;
    upstreams.push_back({folders[d], upstream.value_or(settings.wind.roughness)});
    addWindless(inletsWithoutWind(mesh, settings, flow.choices, flow.wind), folders[d], windless);
    flow.probes = probePlaces(poly, flow.namesOf(PatchRole::Ground), surroundings(mesh, flow.choices),
                              settings.pedestrianHeight, mostProbes);
    writeCaseFiles(folder, flow);
    if (folders[d] != ".")
    {
      shareMesh(folder);
    }
    if (d == 0)
    {
      report = describeCase(flow);
      report.update(treeReport);
      written.summary = flow.isRoom() ? joinedLines(summaryOfRoom(flow), written.summary) : written.summary;
      written.warnings.insert(written.warnings.begin(), warnings.begin(), warnings.end());
      changed.cellZones = changed.cellZones || !treeReport.empty();
      finishMesh(caseFolder, poly, changed, flow, context);
    }
    addProcessors(folder, folders[d] != ".", settings.processors);
    addIncoming(flow, report);
    report["directions"].push_back(describeDirection(flow, settings.directions[d], folders[d]));
    removeEmptyDomain(folder);
    if (settings.checkProfile && flow.hasWind())
    {
      report["directions"].back()["empty_domain"] = writeEmptyDomain(folder, flow, upstream);
    }
  }
  if (folders.size() > 1)
  {
    writeRoseScripts(caseFolder, folders);
  }
  writePlainFile(caseFolder / "case.json", report.dump(2) + "\n");
  std::ranges::copy(warnOfUpstream(settings.wind, upstreams), std::back_inserter(written.warnings));
  std::ranges::copy(warnOfWindless(windless, folders), std::back_inserter(written.warnings));
  return written;
}

} // namespace atria
