// SPDX-License-Identifier: GPL-3.0-or-later
/// Cases of steady wind around and through buildings, of ventilated rooms, and of warm air, for simpleFoam; of air that
/// varies, for pimpleFoam.
#pragma once

#include "CaseBaffles.h"
#include "CaseCanopies.h"
#include "CaseHeat.h"
#include "CaseMesh.h"
#include "CaseScalars.h"
#include "OpenFOAMFile.h"
#include "Support/RunContext.h"
#include "WindProfile.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace atria {

enum class TurbulenceModel
{
  KEpsilon,
  RealizableKEpsilon,
  KOmegaSST
};

/// The OpenFOAM distribution that the case is for.
enum class OpenFOAMDialect
{
  OpenCFD1912, ///< as Debian 12 has it
  OpenCFD,     ///< v2006 and later
  Foundation,  ///< 11 to 13
  Foundation14 ///< 14 and later, which keeps the wind in a file of its own
};

inline bool isFoundation(OpenFOAMDialect dialect)
{
  return dialect == OpenFOAMDialect::Foundation || dialect == OpenFOAMDialect::Foundation14;
}

/// The cause of the flow.
enum class FlowKind
{
  Automatic, ///< Room if isRoom() says so, else Wind
  Wind,      ///< the atmosphere's wind, which crosses the sides of the domain, or calm air in their place
  Room       ///< inlets that blow into a space between walls
};

/// Quantity of air that an inlet blows in, along its own normal.
struct Supply
{
  enum Quantity
  {
    Speed,   ///< amount in m/s
    FlowRate ///< amount in m3/s, through the whole patch
  };
  Quantity quantity = Speed;
  double amount = 1.0;

  /// Return m/s and m3/s, through an area in square meters.
  double speed(double area) const { return quantity == Speed ? amount : amount / area; }
  double flowRate(double area) const { return quantity == FlowRate ? amount : amount * area; }
};

enum class PatchRole
{
  Inlet,
  Outlet,
  InletOutlet, ///< inlet where air comes in, outlet where it goes out
  Slip,
  Ground, ///< a wall with a roughness length, that of the wind's profile or its own
  Wall,
  RoughWall, ///< with sand-grain roughness
  Constraint ///< a type of OpenFOAM's mesh that each field has too, such as symmetryPlane
};

inline bool letsAirThrough(PatchRole role)
{
  return role == PatchRole::Inlet || role == PatchRole::Outlet || role == PatchRole::InletOutlet;
}

inline bool isWall(PatchRole role)
{
  return role == PatchRole::Ground || role == PatchRole::Wall || role == PatchRole::RoughWall;
}

struct PatchChoice
{
  PatchRole role = PatchRole::Wall;
  double sandGrain = 0.0; ///< height of the sand grains of a RoughWall, meters
  /// Supply of an Inlet. Without it an inlet of a wind case has the wind's profile, and one of a room the room's
  /// supply.
  std::optional<Supply> supply = std::nullopt;
  /// Roughness length of a Ground, meters. Without it a Ground has that of the wind's profile.
  std::optional<double> roughness = std::nullopt;
};

/// A user's choice for patches whose name matches. The last of several matching rules holds.
struct PatchRule
{
  std::string pattern; ///< see matchesPattern; of names in the model or in the case
  PatchChoice choice;
};

/// Entries that replace those of patches whose name matches, in one field.
struct ConditionRule
{
  std::string pattern;
  std::string field;   ///< U, p, k, epsilon, omega, nut, age, T, or a scalar
  std::string entries; ///< as in a dictionary, such as "type fixedValue; value uniform (1 0 0);"
};

struct FlowCaseSettings
{
  FlowKind kind = FlowKind::Automatic;
  WindProfile wind;
  Supply supply; ///< for each inlet of a room whose rule gives none
  /// Directions the wind blows to, degrees from x, counterclockwise from above. One makes a plain case. Several make a
  /// folder of a case for each, and these share the mesh. Without any the wind blows from the domain's xMin to its
  /// xMax, or into its domainSide1.
  std::vector<double> directions;
  double north = 0.0; ///< degrees from y, counterclockwise; names the directions
  TurbulenceModel turbulence = TurbulenceModel::RealizableKEpsilon;
  OpenFOAMDialect dialect = OpenFOAMDialect::OpenCFD1912;
  int iterations = 1000;
  int processors = 1;
  OpenFOAMFormat format = OpenFOAMFormat::Ascii; ///< for the processors' meshes
  double pedestrianHeight = 1.75;                ///< meters
  bool ageOfAir = false;
  bool checkProfile = false; ///< adds an empty domain, which says how the wind's profile changes on its way
  std::vector<ScalarRule> scalarRules;
  std::vector<CanopyRule> canopyRules;
  std::filesystem::path treeFile; ///< see readTrees(); none if empty
  std::vector<ScreenRule> screenRules;
  std::vector<FanRule> fanRules;
  bool warmAir = false;             ///< air has a temperature and rises where it is warm
  double outdoorTemperature = 20.0; ///< degrees Celsius
  std::vector<TemperatureRule> temperatureRules;
  std::vector<HeatRule> heatRules;
  /// Neither wind nor inlets move the air: sides and top of a domain are open, and so are inlets and outlets without a
  /// supply, both ways.
  bool calm = false;
  double transientDuration = 0.0; ///< seconds; 0 is a steady run
  std::vector<PatchRule> patchRules;
  std::vector<ConditionRule> conditionRules;
};

/// Parses "inlet", "inlet:0.5m/s", "rough:0.02" and so on. Throws Error listing the known roles.
PatchChoice patchChoiceFrom(const std::string& text);
/// Parse `PATTERN ROLE` and `PATTERN FIELD ENTRIES`. A pattern with blanks is in double quotes. Throw Error if a part
/// is missing.
PatchRule patchRuleFrom(const std::string& text);
ConditionRule conditionRuleFrom(const std::string& text);

/// Returns the role of every patch for wind in the direction `wind`. Without a rule:
/// - patches of a constraint type keep it;
/// - sides, which are plane, upright and no walls, are inlets where the wind crosses them inwards, outlets where it
///   does so outwards, and slip where it runs along them to a degree; an upright patch that is not plane, such as a
///   cylinder, is both by the flow;
/// - patches that face down (the sky) are slip;
/// - patches that face up are ground if they are no wall, or a wall that reaches sides;
/// - all others are walls.
/// In calm air upright sides and the sky are open both ways, and so are inlets and outlets without a supply.
/// Throws Error if a rule matches no patch, if no patch lets air in or if none lets it out.
std::vector<PatchChoice> choosePatches(const CaseMesh& mesh, const FlowCaseSettings& settings, const Vec3& wind);

/// Returns true for a mesh that is a ventilated room. All of these hold:
/// - no wind direction is given;
/// - a patch is an inlet or an outlet by a rule or by its name (see ventilationOpeningOf);
/// - all other patches are walls, by their type or by a rule. A missing floor counts as a wall.
/// A patch that a rule makes ground, a side that slips, and a patch of a constraint type belong to wind cases.
bool isRoom(const CaseMesh& mesh, const FlowCaseSettings& settings);

/// Returns the role of every patch of a room. Without a rule, patches are inlets and outlets by their names, and all
/// others walls. Each inlet has its supply; in calm air those without one of their own are open both ways, and so are
/// outlets. Throws Error if a rule matches no patch, if a rule makes a patch ground, if
/// no patch blows air in or if none lets it out.
std::vector<PatchChoice> chooseRoomPatches(const CaseMesh& mesh, const FlowCaseSettings& settings);

/// Returns names of inlets that the wind does not enter, because it runs along them or out of them. The air at such an
/// inlet stands still. Not included are inlets with a supply, inlets whose velocity a condition gives, and patches that
/// face all ways.
std::vector<std::string> inletsWithoutWind(const CaseMesh& mesh, const FlowCaseSettings& settings,
                                           const std::vector<PatchChoice>& choices, const Vec3& wind);

/// Returns the last rule for a patch in a field, or null.
const ConditionRule* conditionOf(const FlowCaseSettings& settings, const std::string& field, const std::string& patch);

struct WrittenCase
{
  FlowKind kind = FlowKind::Wind; ///< never Automatic
  std::string summary; ///< openings of a room through which air enters and leaves, and trees; a line for each
  std::vector<std::string> warnings;
};

/// Writes the case beside its mesh: 0, constant, system, Allrun, Allclean, and case.json, which describes the case to
/// `atria report`. Each of several directions has a folder `wind_<from>` with a link to the mesh. Sets the types of
/// patches in the mesh's `boundary` to `wall` or `patch` by their role. Each of several processors has its part in
/// `processor<i>`, as decomposePar would make it. Throws Error as choosePatches() or chooseRoomPatches() does, for a
/// room with wind directions, and for files that cannot be written.
WrittenCase writeFlowCase(const std::filesystem::path& caseFolder, FlowCaseSettings settings,
                          const RunContext& context);

} // namespace atria
