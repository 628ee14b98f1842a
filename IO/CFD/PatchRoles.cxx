// SPDX-License-Identifier: GPL-3.0-or-later
#include "FlowCase.h"

#include "PatchNames.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

namespace atria {

namespace {

/// Share of its area that a patch must turn one way to be the sky, the ground or a plane side.
constexpr double oneWay = 0.99;
constexpr double mostlyOneWay = 0.5;
/// Air that slips along a side is turned by no more than this, degrees.
constexpr double alongSide = 1.0;

const std::vector<std::string> roleNames{"inlet", "outlet", "inletOutlet", "slip", "ground", "wall", "rough:SIZE"};

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

void applyRules(const CaseMesh& mesh, const std::vector<PatchRule>& rules, std::vector<PatchChoice>& choices)
{
  std::vector<std::string> names;
  for (const CasePatch& patch : mesh.patches)
  {
    names.push_back(patch.name);
  }
  for (const PatchRule& rule : rules)
  {
    bool isUsed = false;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (matchesPatchName(rule.pattern, names[i], openFOAMNames))
      {
        choices[i] = rule.choice;
        isUsed = true;
      }
    }
    if (!isUsed)
    {
      throw Error("no patch matches '" + rule.pattern + "'; " + namesInstead(rule.pattern, names));
    }
  }
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
  constexpr PatchRole roles[] = {PatchRole::Inlet, PatchRole::Outlet, PatchRole::InletOutlet,
                                 PatchRole::Slip,  PatchRole::Ground, PatchRole::Wall};
  const auto found = std::find(roleNames.begin(), roleNames.end() - 1, text);
  if (found == roleNames.end() - 1)
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
  std::vector<PatchChoice> choices;
  for (const CasePatch& patch : mesh.patches)
  {
    choices.push_back({roleOf(patch, wind), 0.0});
  }
  applyRules(mesh, settings.patchRules, choices);
  const auto has = [&](PatchRole role) {
    return std::any_of(choices.begin(), choices.end(), [&](const PatchChoice& choice) {
      return choice.role == role || choice.role == PatchRole::InletOutlet;
    });
  };
  for (const auto& [role, what] : {std::pair(PatchRole::Inlet, "in"), std::pair(PatchRole::Outlet, "out")})
  {
    if (!has(role))
    {
      throw Error(std::string("no patch lets air ") + what + ": the mesh has no plane, upright side across the wind. " +
                  "Name one, such as --patch NAME " + (role == PatchRole::Inlet ? "inlet" : "outlet"));
    }
  }
  return choices;
}

} // namespace atria
