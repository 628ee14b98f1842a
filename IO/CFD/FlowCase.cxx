// SPDX-License-Identifier: GPL-3.0-or-later
#include "FlowCase.h"

#include "CaseSystem.h"
#include "Decomposition.h"
#include "Grid/Prism.h"
#include "OutputFolders.h"
#include "Support/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace atria {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t mostProbes = 100;
/// Probes stand as far from buildings as these are high, in this many heights.
constexpr double probeHeights = 1.5;

const char* roleName(PatchRole role)
{
  constexpr const char* names[] = {"inlet", "outlet", "inletOutlet", "slip", "ground", "wall", "rough", "constraint"};
  return names[static_cast<std::size_t>(role)];
}

/// From the domain's xMin to its xMax, or against its first side, where there is such a side.
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

/// Where probes go: about the walls, or over the whole ground without any.
Box3 surroundings(const CaseMesh& mesh, const std::vector<PatchChoice>& choices)
{
  Box3 walls;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    if (choices[i].role == PatchRole::Wall || choices[i].role == PatchRole::RoughWall)
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

/// Mesh types of patches whose role needs another one. Roles that depend on the wind are all of type `patch`.
std::map<std::string, std::string> changedTypes(const CaseMesh& mesh, const std::vector<PatchChoice>& choices)
{
  std::map<std::string, std::string> types;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const PatchRole role = choices[i].role;
    const bool isWall = role == PatchRole::Ground || role == PatchRole::Wall || role == PatchRole::RoughWall;
    const char* const wanted = isWall ? "wall" : "patch";
    if (role != PatchRole::Constraint && mesh.patches[i].type != wanted)
    {
      types[mesh.patches[i].name] = wanted;
    }
  }
  return types;
}

void writeScript(const fs::path& path, const std::string& text)
{
  writePlainFile(path, text);
  std::error_code ignored;
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add,
                  ignored);
}

const char* const scriptHead = "#!/bin/sh\n"
                               "cd \"${0%/*}\" || exit 1\n";

std::string runScript(const CaseOfDirection& flow)
{
  const bool isParallel = flow.settings.processors > 1;
  const std::string solver = flow.settings.dialect == OpenFOAMDialect::Foundation ? "foamRun" : "simpleFoam";
  std::string text = scriptHead;
  text += "# Debian's OpenFOAM sets no environment of its own; this much it needs.\n"
          "[ -n \"$WM_PROJECT_DIR\" ] || export WM_PROJECT_DIR=/usr/share/openfoam\n\n"
          "# Runs an application once, its output in log.<application>.\n"
          "run() {\n"
          "  name=$1; shift\n"
          "  if [ -e \"log.$name\" ]; then echo \"$name has run: ./Allclean to begin anew\"; return; fi\n"
          "  echo \"Running $name in $PWD\"\n"
          "  if ! \"$@\" > \"log.$name\" 2>&1; then echo \"$name failed: see $PWD/log.$name\" >&2; exit 1; fi\n"
          "}\n\n";
  const auto run = [&](const std::string& name, const std::string& options) {
    const std::string parallel = "mpirun -np " + std::to_string(flow.settings.processors) + " ";
    text +=
        "run " + name + " " + (isParallel ? parallel : "") + name + options + (isParallel ? " -parallel" : "") + "\n";
  };
  if (isParallel)
  {
    text += "# Comes with the case; made again where it was removed.\n"
            "[ -d processor0 ] || run decomposePar decomposePar\n";
  }
  run(solver, "");
  if (isParallel)
  {
    text += "run reconstructPar reconstructPar -latestTime\n";
  }
  return text;
}

std::string cleanScript()
{
  return std::string(scriptHead) +
         "# All that a run leaves; meshes and the folder 0 stay.\n"
         "rm -rf postProcessing log.* [1-9]* 0.[0-9]* 0/uniform dynamicCode processor*/[1-9]* processor*/0.[0-9]*\n"
         "for processor in processor*; do\n"
         "  if [ -d \"$processor\" ]; then rm -rf \"$processor/0\" && cp -r 0 \"$processor/0\"; fi\n"
         "done\n";
}

std::string scriptOfAll(const std::vector<std::string>& folders, const char* script)
{
  std::string text = scriptHead;
  for (const std::string& folder : folders)
  {
    text += folder + "/" + script + " || exit 1\n";
  }
  return text;
}

/// `other` is the case that has the mesh, as seen from the folder constant.
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

Json describeSettings(const FlowCaseSettings& settings)
{
  constexpr const char* models[] = {"kEpsilon", "realizableKE", "kOmegaSST"};
  const WindProfile& wind = settings.wind;
  return {{"reference_speed", wind.speed},
          {"reference_height", wind.referenceHeight},
          {"roughness_length", wind.roughness},
          {"friction_velocity", wind.frictionVelocity()},
          {"turbulence", models[static_cast<std::size_t>(settings.turbulence)]},
          {"iterations", settings.iterations},
          {"pedestrian_height", settings.pedestrianHeight},
          {"age_of_air", settings.ageOfAir}};
}

Json describeCase(const CaseMesh& mesh, const FlowCaseSettings& settings)
{
  Json report = describeSettings(settings);
  report["mesh"] = {{"cells", mesh.cells},
                    {"faces", mesh.faces},
                    {"bounds",
                     {mesh.bounds.min[0], mesh.bounds.max[0], mesh.bounds.min[1], mesh.bounds.max[1],
                      mesh.bounds.min[2], mesh.bounds.max[2]}},
                    {"worst_non_orthogonality", mesh.worstNonOrthogonality},
                    {"mean_non_orthogonality", mesh.meanNonOrthogonality},
                    {"worst_skewness", mesh.worstSkewness},
                    {"failed_checks", mesh.failedChecks}};
  report["openings"] = Json::array();
  for (const CaseOpening& opening : mesh.openings)
  {
    report["openings"].push_back({{"name", opening.name}, {"area", opening.area}, {"rooms", opening.rooms}});
  }
  report["rooms"] = Json::array();
  for (const CaseRoom& room : mesh.rooms)
  {
    report["rooms"].push_back({{"name", room.name}, {"volume", room.volume}});
  }
  report["directions"] = Json::array();
  return report;
}

Json describeDirection(const CaseOfDirection& flow, double towards, const std::string& folder)
{
  Json patches = Json::object();
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    patches[flow.mesh.patches[i].name] = roleName(flow.choices[i].role);
  }
  return {
      {"folder", folder}, {"towards", towards}, {"from", windFrom(towards, flow.settings.north)}, {"patches", patches}};
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

/// The fields of each processor, which are the case's as long as these are uniform, and of a direction a link to its
/// mesh.
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

/// The folders of the directions, within that of the case.
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

} // namespace

std::vector<std::string> writeFlowCase(const fs::path& caseFolder, FlowCaseSettings settings, const RunContext& context)
{
  PolyMesh poly = readPolyMesh(caseFolder);
  const CaseMesh mesh = describeMesh(poly, context);
  if (settings.directions.empty())
  {
    settings.directions = {directionOfDomain(mesh)};
  }
  const std::vector<std::string> folders = foldersOf(settings);
  Json report = describeCase(mesh, settings);
  std::vector<std::string> notes;
  removeProcessors(caseFolder); // of another mesh, and of another number
  for (std::size_t d = 0; d < folders.size(); ++d)
  {
    const fs::path folder = folders[d] == "." ? caseFolder : caseFolder / folders[d];
    CaseOfDirection flow{mesh, settings, windVector(settings.directions[d]), {}, {}};
    flow.choices = choosePatches(mesh, settings, flow.wind);
    flow.probes = probePlaces(poly, flow.namesOf(PatchRole::Ground), surroundings(mesh, flow.choices),
                              settings.pedestrianHeight, mostProbes);
    writeFields(folder, flow);
    writeConstant(folder, flow);
    writeSystem(folder, flow);
    writeScript(folder / "Allrun", runScript(flow));
    writeScript(folder / "Allclean", cleanScript());
    if (folders[d] != ".")
    {
      removeProcessors(folder);
      linkMesh(folder, "../..");
      writePlainFile(folder / (folders[d] + ".foam"), "");
    }
    if (d == 0)
    {
      setTypes(caseFolder, poly, changedTypes(mesh, flow.choices));
      if (settings.processors > 1)
      {
        writeProcessors(caseFolder, poly, static_cast<std::size_t>(settings.processors), settings.format, context);
      }
    }
    addProcessors(folder, folders[d] != ".", settings.processors);
    report["directions"].push_back(describeDirection(flow, settings.directions[d], folders[d]));
  }
  if (folders.size() > 1)
  {
    writeScript(caseFolder / "Allrun", scriptOfAll(folders, "Allrun"));
    writeScript(caseFolder / "Allclean", scriptOfAll(folders, "Allclean"));
  }
  writePlainFile(caseFolder / "case.json", report.dump(2) + "\n");
  return notes;
}

} // namespace atria
