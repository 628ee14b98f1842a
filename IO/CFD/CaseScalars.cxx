// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseScalars.h"

#include "CasePlaces.h"
#include "FlowCase.h"
#include "Support/Error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

namespace atria {

namespace {

/// Names that a scalar cannot have: a case has them already.
constexpr const char* takenNames[] = {"U",     "p",     "k",     "epsilon", "omega",   "nut",    "age",        "phi",
                                      "yPlus", "nuEff", "UMean", "pMean",   "average", "forces", "pedestrians"};

bool isPlainName(const std::string& name)
{
  const auto isPlain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return std::ranges::all_of(name, isPlain) && !name.empty() && !(name[0] >= '0' && name[0] <= '9');
}

void checkName(const std::string& name)
{
  if (!isPlainName(name) || std::ranges::find(takenNames, name) != std::end(takenNames))
  {
    throw Error("a scalar cannot be called '" + name +
                "': a name has letters and digits, such as CO2, and is none of the flow's own fields");
  }
}

/// Adds a source. Returns why it cannot, or nothing.
std::string addSource(const ScalarRule& rule, const Places& places, bool takesSurfaces, CaseScalar& scalar)
{
  const Sizes zones = matching(rule.pattern, places.zones);
  Sizes surfaces = matching(rule.pattern, places.surfaces);
  if (sum(zones) > 0.0)
  {
    divide(rule.amount, zones, scalar.zones);
    return {};
  }
  if (std::erase_if(surfaces, [&](const auto& named) { return places.slipping.contains(named.first); }) > 0 &&
      surfaces.empty())
  {
    return "'" + rule.pattern + "' is a side along which air slips, and no wall: name a wall, a ground or a cell zone";
  }
  if (surfaces.empty())
  {
    return "air flows through '" + rule.pattern + "': give the concentration of the air that comes in, without /s";
  }
  if (!takesSurfaces)
  {
    return "'" + rule.pattern +
           "' is a surface, and the Foundation's OpenFOAM has no condition for a given flux: name a cell zone";
  }
  if (!(sum(surfaces) > 0.0))
  {
    return "the mesh has no faces of '" + rule.pattern + "'";
  }
  divide(rule.amount, surfaces, scalar.surfaces);
  return {};
}

/// Adds a concentration. Returns why it cannot, or nothing. With other directions of the wind, air may come in at a
/// side along which it slips with this one.
std::string addIncoming(const ScalarRule& rule, const Places& places, bool hasOtherDirections, CaseScalar& scalar)
{
  const Sizes openings = matching(rule.pattern, places.openings);
  for (const auto& [name, size] : openings)
  {
    scalar.incoming[name] = rule.amount;
  }
  const bool mayComeIn = hasOtherDirections && !matching(rule.pattern, places.slipping).empty();
  return !openings.empty() || mayComeIn
             ? ""
             : "no air comes in at '" + rule.pattern + "': name an inlet, or give a source per second, such as 5e-6/s";
}

CaseScalar& scalarCalled(const std::string& name, std::vector<CaseScalar>& scalars)
{
  const auto found = std::ranges::find(scalars, name, &CaseScalar::name);
  return found != scalars.end() ? *found : scalars.emplace_back(CaseScalar{name, {}, {}, {}});
}

void refuseNothing(const CaseScalar& scalar, const std::vector<ScalarRule>& rules)
{
  const auto isSomething = [&](const ScalarRule& rule) { return rule.scalar == scalar.name && rule.amount > 0.0; };
  if (std::ranges::none_of(rules, isSomething))
  {
    throw Error("scalar '" + scalar.name + "': its sources add up to nothing, and none comes in with the air");
  }
}

/// Returns an amount, which is a source if `/s` follows it.
std::optional<ScalarRule> amountFrom(const std::string& text)
{
  ScalarRule rule;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, rule.amount);
  const std::string_view unit(end, static_cast<std::size_t>(last - end));
  rule.isSource = unit == "/s";
  const bool isAmount = error == std::errc() && std::isfinite(rule.amount) && rule.amount >= 0.0;
  return isAmount && (rule.isSource || unit.empty()) ? std::optional(rule) : std::nullopt;
}

} // namespace

ScalarRule scalarRuleFrom(const std::string& text)
{
  std::istringstream in(text);
  std::string name, pattern, amount, more;
  if (!(in >> name >> std::quoted(pattern) >> amount) || in >> more)
  {
    throw Error("the scalar '" + text + "' is not of the form NAME PATTERN AMOUNT, such as CO2 Office 5e-6/s");
  }
  checkName(name);
  auto rule = amountFrom(amount);
  if (!rule)
  {
    throw Error("scalar '" + name + "': '" + amount +
                "' is no amount. A source is per second, such as 5e-6/s; the concentration of incoming air has no "
                "unit, such as 400. Neither is negative");
  }
  rule->scalar = name;
  rule->pattern = pattern;
  return *rule;
}

std::vector<CaseScalar> caseScalars(const CaseMesh& mesh, const FlowCaseSettings& settings,
                                    const std::vector<PatchChoice>& choices)
{
  const Places places = placesOf(mesh, choices);
  std::vector<CaseScalar> scalars;
  for (const ScalarRule& rule : settings.scalarRules)
  {
    CaseScalar& scalar = scalarCalled(rule.scalar, scalars);
    const std::string fault = !isKnown(rule.pattern, places) ? unmatched(rule.pattern, places)
                              : rule.isSource ? addSource(rule, places, !isFoundation(settings.dialect), scalar)
                                              : addIncoming(rule, places, settings.directions.size() > 1, scalar);
    if (!fault.empty())
    {
      throw Error("scalar '" + rule.scalar + "': " + fault);
    }
  }
  for (const CaseScalar& scalar : scalars)
  {
    refuseNothing(scalar, settings.scalarRules);
  }
  return scalars;
}

double CaseScalar::incomingAt(const std::string& patch) const
{
  const auto found = incoming.find(patch);
  return found == incoming.end() ? 0.0 : found->second;
}

double startOf(const CaseScalar& scalar, const CaseMesh& mesh, const std::vector<PatchChoice>& choices)
{
  std::optional<double> least;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const bool airComesIn = choices[i].role == PatchRole::Inlet || choices[i].role == PatchRole::InletOutlet;
    if (airComesIn && mesh.patches[i].area > 0.0)
    {
      const double incoming = scalar.incomingAt(mesh.patches[i].name);
      least = std::min(least.value_or(incoming), incoming);
    }
  }
  return least.value_or(0.0);
}

} // namespace atria
