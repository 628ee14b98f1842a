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
  const Sizes surfaces = matching(rule.pattern, places.surfaces);
  if (sum(zones) > 0.0)
  {
    divide(rule.amount, zones, scalar.zones);
    return {};
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

std::string addIncoming(const ScalarRule& rule, const Places& places, CaseScalar& scalar)
{
  const Sizes openings = matching(rule.pattern, places.openings);
  for (const auto& [name, size] : openings)
  {
    scalar.incoming[name] = rule.amount;
  }
  return !openings.empty()
             ? ""
             : "no air comes in at '" + rule.pattern + "': name an inlet, or give a source per second, such as 5e-6/s";
}

CaseScalar& scalarCalled(const std::string& name, std::vector<CaseScalar>& scalars)
{
  const auto found = std::ranges::find(scalars, name, &CaseScalar::name);
  return found != scalars.end() ? *found : scalars.emplace_back(CaseScalar{name, {}, {}, {}});
}

void refuseNothing(const CaseScalar& scalar)
{
  if (!(sum(scalar.zones) + sum(scalar.surfaces) + sum(scalar.incoming) > 0.0))
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
                                              : addIncoming(rule, places, scalar);
    if (!fault.empty())
    {
      throw Error("scalar '" + rule.scalar + "': " + fault);
    }
  }
  std::ranges::for_each(scalars, refuseNothing);
  return scalars;
}

} // namespace atria
