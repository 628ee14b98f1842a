// SPDX-License-Identifier: GPL-3.0-or-later
#include "FlowCase.h"

#include "OpeningNames.h"
#include "PatchNames.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Support/Text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <numbers>
#include <sstream>

namespace atria {

namespace {

/// Share of its area that a patch must face one way to be the sky, the ground or a plane side.
constexpr double oneWay = 0.99;
constexpr double mostlyOneWay = 0.5;
/// The same for an inlet whose faces the wind enters all or not at all; a half cylinder has 0.64.
constexpr double nearlyPlane = 0.9;
/// Largest angle between the wind and a side with slip, degrees.
constexpr double alongSide = 1.0;

/// The roles that have no number come first, in the order of PatchRole.
const std::vector<std::string> roleNames{"inlet",  "outlet", "inletOutlet", "slip",
                                         "ground", "wall",   "rough:SIZE",  "inlet:AMOUNTm/s"};
constexpr std::size_t plainRoles = 6;

struct SupplyUnit
{
  std::string_view name;
  Supply::Quantity quantity;
  double inSi;
};
constexpr SupplyUnit supplyUnits[] = {{"m/s", Supply::Speed, 1.0},
                                      {"m3/s", Supply::FlowRate, 1.0},
                                      {"m3/h", Supply::FlowRate, 1.0 / 3600.0},
                                      {"l/s", Supply::FlowRate, 1e-3}};

bool isConstraint(const std::string& type) { return type != "patch" && type != "wall" && !type.starts_with("mapped"); }

PatchRole roleOfUpright(const CasePatch& patch, const Vec3& wind)
{
  if (patch.flatness() < oneWay)
  {
    return PatchRole::InletOutlet;
  }
  const double outwards = patch.areaVector.dot(wind) / patch.areaVector.norm();
  const double limit = std::sin(alongSide * std::numbers::pi / 180.0);
  return outwards < -limit ? PatchRole::Inlet : outwards > limit ? PatchRole::Outlet : PatchRole::Slip;
}

PatchRole roleOf(const CasePatch& patch, const Vec3& wind)
{
  const double up = patch.area > 0.0 ? patch.areaVector[2] / patch.area : 0.0;
  if (isConstraint(patch.type))
  {
    return PatchRole::Constraint;
  }
  if (patch.type == "wall")
  {
    return patch.meetsSides && up < -mostlyOneWay ? PatchRole::Ground : PatchRole::Wall;
  }
  return up > mostlyOneWay ? PatchRole::Slip : up < -mostlyOneWay ? PatchRole::Ground : roleOfUpright(patch, wind);
}

/// True for a patch at the base of a cell zone, such as a hedge, that stands on the ground.
bool isBaseOfZone(const CasePatch& patch, const CaseMesh& mesh)
{
  return patch.areaVector[2] < -mostlyOneWay * patch.area &&
         std::ranges::find(mesh.rooms, patch.name, &CaseRoom::name) != mesh.rooms.end();
}

/// Returns the role of a patch in calm air, where sides and the sky are open.
PatchRole roleInCalm(const CasePatch& patch)
{
  const PatchRole role = roleOf(patch, Vec3::Zero());
  return role == PatchRole::Slip ? PatchRole::InletOutlet : role;
}

/// Opens inlets without a supply and outlets both ways: in calm air nothing says which way the air goes.
void openBothWays(std::vector<PatchChoice>& choices)
{
  for (PatchChoice& choice : choices)
  {
    const bool isOpening = choice.role == PatchRole::Inlet || choice.role == PatchRole::Outlet;
    choice.role = isOpening && !choice.supply ? PatchRole::InletOutlet : choice.role;
  }
}

/// Throws Error for a speed and a flow rate for the same patches: neither rule is meant to correct the other.
void refuseTwoSupplies(const std::vector<PatchRule>& rules)
{
  for (const PatchRule& a : rules)
  {
    for (const PatchRule& b : rules)
    {
      if (a.pattern == b.pattern && a.choice.supply && b.choice.supply &&
          a.choice.supply->quantity != b.choice.supply->quantity)
      {
        throw Error("inlet '" + a.pattern + "' has both a speed and a flow rate: give one of them");
      }
    }
  }
}

/// Returns, for each patch, the last rule that matches it, or null.
std::vector<const PatchRule*> rulesOf(const CaseMesh& mesh, const std::vector<PatchRule>& rules)
{
  refuseTwoSupplies(rules);
  std::vector<std::string> names;
  for (const CasePatch& patch : mesh.patches)
  {
    names.push_back(patch.name);
  }
  std::vector<const PatchRule*> found(names.size(), nullptr);
  for (const PatchRule& rule : rules)
  {
    bool isUsed = false;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (matchesPatchName(rule.pattern, names[i], openFOAMNames))
      {
        found[i] = &rule;
        isUsed = true;
      }
    }
    if (!isUsed)
    {
      throw Error("no patch matches '" + rule.pattern + "'; " + namesInstead(rule.pattern, names));
    }
  }
  return found;
}

PatchRole roleInRoom(const CasePatch& patch)
{
  if (isConstraint(patch.type))
  {
    return PatchRole::Constraint;
  }
  const auto opening = ventilationOpeningOf(patch.name);
  return !opening ? PatchRole::Wall : *opening == VentilationOpening::Inlet ? PatchRole::Inlet : PatchRole::Outlet;
}

/// Returns the roles before inlets get their supplies.
std::vector<PatchChoice> rolesInRoom(const CaseMesh& mesh, const std::vector<const PatchRule*>& rules)
{
  std::vector<PatchChoice> choices;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i)
  {
    choices.push_back(rules[i] ? rules[i]->choice : PatchChoice{roleInRoom(mesh.patches[i]), 0.0});
  }
  return choices;
}

std::vector<std::string> namesOf(const CaseMesh& mesh, const std::vector<PatchChoice>& choices, PatchRole role)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    if (choices[i].role == role && mesh.patches[i].area > 0.0)
    {
      names.push_back("'" + mesh.patches[i].name + "'");
    }
  }
  return names;
}

/// Throws Error unless a room has both an inlet and an outlet, or, in calm air, an opening.
void requireInletAndOutlet(const CaseMesh& mesh, const std::vector<PatchChoice>& choices,
                           const FlowCaseSettings& settings)
{
  const std::vector<std::string> inlets = namesOf(mesh, choices, PatchRole::Inlet);
  std::vector<std::string> outlets = namesOf(mesh, choices, PatchRole::Outlet);
  std::ranges::copy(namesOf(mesh, choices, PatchRole::InletOutlet), std::back_inserter(outlets));
  if (inlets.empty() && outlets.empty())
  {
    throw Error("no patch lets air into the room, and none out. Name them, such as PatchRules NAME inlet and "
                "PatchRules NAME outlet");
  }
  if (outlets.empty())
  {
    throw Error("no patch lets air out of the room: it has inlets only (" + joined(inlets) +
                "). Name an outlet, such as PatchRules NAME outlet");
  }
  if (inlets.empty() && !settings.calm)
  {
    throw Error("no patch blows air into the room: it has outlets only (" + joined(outlets) +
                "), and nothing would flow. Name an inlet, such as PatchRules NAME inlet" +
                (settings.warmAir             ? "; or let warm air move by itself, Calm"
                 : !settings.fanRules.empty() ? "; or let fans move the air, Calm with WarmAir and OutdoorTemperature"
                                              : ""));
  }
}

/// True if a mesh for a wind case would be taken for a room automatically.
bool wouldBeRoom(const CaseMesh& mesh, FlowCaseSettings settings)
{
  settings.kind = FlowKind::Automatic;
  settings.directions.clear();
  return isRoom(mesh, settings);
}

PatchChoice supplyFrom(const std::string& text, std::string_view amount)
{
  double number = 0.0;
  const auto [end, error] = std::from_chars(amount.data(), amount.data() + amount.size(), number);
  const std::string_view unit(end, static_cast<std::size_t>(amount.data() + amount.size() - end));
  const auto* const found = std::ranges::find(supplyUnits, unit, &SupplyUnit::name);
  if (error != std::errc() || found == std::end(supplyUnits) || !(number > 0.0) || !std::isfinite(number))
  {
    throw Error("'" + text +
                "': behind inlet: stands how air is blown in, as a speed or a flow rate with its unit (m/s, " +
                "m3/s, m3/h, l/s), such as inlet:0.5m/s or inlet:50l/s");
  }
  return {PatchRole::Inlet, 0.0, Supply{found->quantity, number * found->inSi}};
}

} // namespace

PatchChoice patchChoiceFrom(const std::string& text)
{
  constexpr std::string_view rough = "rough:";
  if (text.starts_with(rough))
  {
    double size = 0.0;
    const char* const first = text.data() + rough.size();
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(first, last, size);
    if (error != std::errc() || end != last || !(size > 0.0) || !std::isfinite(size))
    {
      throw Error("'" + text + "': behind rough: stands the height of sand grains in meters, such as rough:0.02");
    }
    return {PatchRole::RoughWall, size};
  }
  constexpr std::string_view inlet = "inlet:";
  if (text.starts_with(inlet))
  {
    return supplyFrom(text, std::string_view(text).substr(inlet.size()));
  }
  constexpr PatchRole roles[] = {PatchRole::Inlet, PatchRole::Outlet, PatchRole::InletOutlet,
                                 PatchRole::Slip,  PatchRole::Ground, PatchRole::Wall};
  static_assert(std::size(roles) == plainRoles);
  const auto last = roleNames.begin() + plainRoles;
  const auto found = std::find(roleNames.begin(), last, text);
  if (found == last)
  {
    throw Error("'" + text + "' is not what a patch can be; " + namesInstead(text, roleNames));
  }
  return {roles[found - roleNames.begin()], 0.0};
}

PatchRule patchRuleFrom(const std::string& text)
{
  std::istringstream in(text);
  std::string pattern;
  std::string role;
  std::string more;
  if (!(in >> std::quoted(pattern) >> role) || in >> more)
  {
    throw Error("the rule '" + text + "' for patches is not of the form PATTERN ROLE");
  }
  return {pattern, patchChoiceFrom(role)};
}

ConditionRule conditionRuleFrom(const std::string& text)
{
  std::istringstream in(text);
  ConditionRule rule;
  in >> std::quoted(rule.pattern) >> rule.field >> std::ws;
  std::getline(in, rule.entries, '\0');
  if (rule.entries.empty() || (rule.entries.back() != ';' && rule.entries.back() != '}'))
  {
    throw Error("the condition '" + text +
                "' is not of the form PATTERN FIELD ENTRIES, such as: Fan* U type fixedValue; value uniform (1 0 0);");
  }
  return rule;
}

std::vector<PatchChoice> choosePatches(const CaseMesh& mesh, const FlowCaseSettings& settings, const Vec3& wind)
{
  const std::vector<const PatchRule*> rules = rulesOf(mesh, settings.patchRules);
  std::vector<PatchChoice> choices;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i)
  {
    const CasePatch& patch = mesh.patches[i];
    const PatchRole role = isBaseOfZone(patch, mesh) ? PatchRole::Ground
                           : settings.calm           ? roleInCalm(patch)
                                                     : roleOf(patch, wind);
    choices.push_back(rules[i] ? rules[i]->choice : PatchChoice{role, 0.0});
  }
  if (settings.calm)
  {
    openBothWays(choices);
  }
  const auto has = [&](PatchRole role) {
    return std::any_of(choices.begin(), choices.end(), [&](const PatchChoice& choice) {
      return choice.role == role || choice.role == PatchRole::InletOutlet;
    });
  };
  for (const auto& [role, what] : {std::pair(PatchRole::Inlet, "in"), std::pair(PatchRole::Outlet, "out")})
  {
    if (!has(role))
    {
      const bool isInlet = role == PatchRole::Inlet;
      throw Error(std::string("no patch lets air ") + what + ": the mesh has no " +
                  (settings.calm ? "upright side and no top. " : "plane, upright side across the wind. ") +
                  "Name one, such as PatchRules NAME " +
                  (settings.calm ? "inletOutlet"
                   : isInlet     ? "inlet"
                                 : "outlet") +
                  (wouldBeRoom(mesh, settings) ? "; without wind it is a room" : ""));
    }
  }
  return choices;
}

bool isRoom(const CaseMesh& mesh, const FlowCaseSettings& settings)
{
  if (settings.kind != FlowKind::Automatic || !settings.directions.empty())
  {
    return settings.kind == FlowKind::Room;
  }
  const std::vector<const PatchRule*> rules = rulesOf(mesh, settings.patchRules);
  const std::vector<PatchChoice> choices = rolesInRoom(mesh, rules);
  bool hasOpening = false;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const CasePatch& patch = mesh.patches[i];
    const PatchRole role = choices[i].role;
    const bool isSide = patch.type != "wall" && patch.area > 0.0;
    const bool isFloor = patch.areaVector[2] < -oneWay * patch.area;
    const bool isOpenSide = isSide && (role == PatchRole::Slip || (role == PatchRole::Wall && !rules[i] && !isFloor));
    if (isOpenSide || role == PatchRole::Ground || role == PatchRole::Constraint)
    {
      return false;
    }
    hasOpening = hasOpening || (letsAirThrough(role) && patch.area > 0.0);
  }
  return hasOpening;
}

std::vector<PatchChoice> chooseRoomPatches(const CaseMesh& mesh, const FlowCaseSettings& settings)
{
  std::vector<PatchChoice> choices = rolesInRoom(mesh, rulesOf(mesh, settings.patchRules));
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    if (choices[i].role == PatchRole::Ground)
    {
      throw Error("a room has no ground with the roughness of the wind's profile: make '" + mesh.patches[i].name +
                  "' wall or rough:SIZE");
    }
    if (choices[i].role == PatchRole::Inlet && !choices[i].supply && !settings.calm)
    {
      choices[i].supply = settings.supply;
    }
  }
  if (settings.calm)
  {
    openBothWays(choices);
  }
  requireInletAndOutlet(mesh, choices, settings);
  return choices;
}

const ConditionRule* conditionOf(const FlowCaseSettings& settings, const std::string& field, const std::string& patch)
{
  const auto& rules = settings.conditionRules;
  const auto found = std::find_if(rules.rbegin(), rules.rend(), [&](const ConditionRule& rule) {
    return rule.field == field && matchesPatchName(rule.pattern, patch, openFOAMNames);
  });
  return found == rules.rend() ? nullptr : &*found;
}

std::vector<std::string> inletsWithoutWind(const CaseMesh& mesh, const FlowCaseSettings& settings,
                                           const std::vector<PatchChoice>& choices, const Vec3& wind)
{
  std::vector<std::string> names;
  const double limit = std::sin(alongSide * std::numbers::pi / 180.0);
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const CasePatch& patch = mesh.patches[i];
    const bool takesWind = choices[i].role == PatchRole::Inlet && !choices[i].supply;
    const bool hasOneNormal = patch.flatness() > nearlyPlane;
    if (takesWind && hasOneNormal && patch.areaVector.dot(wind) > -limit * patch.areaVector.norm() &&
        !conditionOf(settings, "U", patch.name))
    {
      names.push_back(patch.name);
    }
  }
  return names;
}

} // namespace atria
