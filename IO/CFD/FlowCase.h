// SPDX-License-Identifier: GPL-3.0-or-later
/// Cases of steady wind around and through buildings, and of ventilated rooms, for simpleFoam.
#pragma once

#include "CaseMesh.h"
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

/// Whose OpenFOAM the case is for.
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

/// What moves the air.
enum class FlowKind
{
  Automatic, ///< Room where isRoom() says so, else Wind
  Wind,      ///< the atmosphere's wind, which crosses the sides of the domain
  Room       ///< inlets that blow into a space between walls
};

/// How an inlet blows air in, along its own normal.
struct Supply
{
  enum Quantity
  {
    Speed,   ///< amount in m/s
    FlowRate ///< amount in m3/s, through the whole patch
  };
  Quantity quantity = Speed;
  double amount = 1.0;

  /// m/s and m3/s, through an area in square meters.
  double speed(double area) const { return quantity == Speed ? amount : amount / area; }
  double flowRate(double area) const { return quantity == FlowRate ? amount : amount * area; }
};

enum class PatchRole
{
  Inlet,
  Outlet,
  InletOutlet, ///< inlet where air comes in, outlet where it goes out
  Slip,
  Ground, ///< a wall with the roughness length of the wind's profile
  Wall,
  RoughWall, ///< with sand-grain roughness
  Constraint ///< a type of OpenFOAM's mesh that each field has too, such as symmetryPlane
};

struct PatchChoice
{
  PatchRole role = PatchRole::Wall;
  double sandGrain = 0.0; ///< of a RoughWall, meters
  /// How an Inlet blows. Without it an inlet of a wind case has the wind's profile, and one of a room the room's
  /// supply.
  std::optional<Supply> supply = std::nullopt;
};

/// What a user says of patches whose name matches; of several rules that match the last holds.
struct PatchRule
{
  std::string pattern; ///< see matchesPattern; of names in the model or in the case
  PatchChoice choice;
};

/// Entries that replace those of patches whose name matches in one field.
struct ConditionRule
{
  std::string pattern;
  std::string field;   ///< U, p, k, epsilon, omega, nut, age
  std::string entries; ///< as in a dictionary, such as "type fixedValue; value uniform (1 0 0);"
};

struct FlowCaseSettings
{
  FlowKind kind = FlowKind::Automatic;
  WindProfile wind;
  Supply supply; ///< of each inlet of a room whose rule gives none
  /// Where the wind blows to, degrees from x, counterclockwise from above. One makes a plain case; several make a
  /// folder of a case for each, which share the mesh. None: from the domain's xMin to its xMax, or into its
  /// domainSide1.
  std::vector<double> directions;
  double north = 0.0; ///< degrees from y, counterclockwise; names the directions
  TurbulenceModel turbulence = TurbulenceModel::RealizableKEpsilon;
  OpenFOAMDialect dialect = OpenFOAMDialect::OpenCFD1912;
  int iterations = 1000;
  int processors = 1;
  OpenFOAMFormat format = OpenFOAMFormat::Ascii; ///< of the processors' meshes
  double pedestrianHeight = 1.75;                ///< meters
  bool ageOfAir = false;
  std::vector<PatchRule> patchRules;
  std::vector<ConditionRule> conditionRules;
};

/// Of "inlet", "inlet:0.5m/s", "rough:0.02" and so on. Throws Error naming what there is.
PatchChoice patchChoiceFrom(const std::string& text);
/// Of `PATTERN ROLE` and `PATTERN FIELD ENTRIES`, the pattern in double quotes where it holds blanks. Throw Error where
/// a part is missing.
PatchRule patchRuleFrom(const std::string& text);
ConditionRule conditionRuleFrom(const std::string& text);

/// The role of every patch for wind in the direction `wind`. By themselves
/// - patches of a constraint type keep it;
/// - sides, which are plane, upright and no walls, are inlets where the wind crosses them inwards, outlets where it
///   does so outwards, and slip where it runs along them to a degree; an upright patch that is not plane, such as a
///   cylinder, is both by the flow;
/// - what faces down (the sky) is slip;
/// - what faces up is ground if it is no wall, or a wall that reaches sides;
/// - all others are walls.
/// Throws Error where a rule matches no patch, and where no patch lets air in or none lets it out.
std::vector<PatchChoice> choosePatches(const CaseMesh& mesh, const FlowCaseSettings& settings, const Vec3& wind);

/// Returns true for a mesh that is a ventilated room. All of these hold:
/// - no wind direction is given;
/// - a patch is an inlet or an outlet by a rule or by its name (see ventilationOpeningOf);
/// - all other patches are walls, by their type or by a rule. A missing floor counts as a wall.
/// A patch that a rule makes ground, a side that slips, and a patch of a constraint type belong to wind cases.
bool isRoom(const CaseMesh& mesh, const FlowCaseSettings& settings);

/// The role of every patch of a room. By themselves patches are inlets and outlets by their names, and walls. Each
/// inlet has its supply. Throws Error where a rule matches no patch, where a rule makes a patch ground, and where no
/// patch blows air in or none lets it out.
std::vector<PatchChoice> chooseRoomPatches(const CaseMesh& mesh, const FlowCaseSettings& settings);

/// Returns names of inlets that the wind does not enter, because it runs along them or out of them. The air at such an
/// inlet stands still. Those that blow by themselves are not among them, nor are those whose velocity a condition
/// gives, and patches that face all ways.
std::vector<std::string> inletsWithoutWind(const CaseMesh& mesh, const FlowCaseSettings& settings,
                                           const std::vector<PatchChoice>& choices, const Vec3& wind);

/// The last rule for a patch in a field, or null.
const ConditionRule* conditionOf(const FlowCaseSettings& settings, const std::string& field, const std::string& patch);

struct WrittenCase
{
  FlowKind kind = FlowKind::Wind; ///< never Automatic
  std::string summary;            ///< of a room: what flows in and where out, in a sentence
  std::vector<std::string> warnings;
};

/// Writes the case beside its mesh: 0, constant, system, Allrun, Allclean, and case.json, which tells `atria report`
/// what the case is. Of several directions each has a folder `wind_<from>` with a link to the mesh. Sets the types of
/// patches in the mesh's `boundary` to `wall` or `patch` by their role. For several processors each has its part in
/// `processor<i>`, as decomposePar would make it. Throws Error as choosePatches() or chooseRoomPatches() does, for a
/// room with wind directions, and for what cannot be written.
WrittenCase writeFlowCase(const std::filesystem::path& caseFolder, FlowCaseSettings settings,
                          const RunContext& context);

} // namespace atria
