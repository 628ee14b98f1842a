// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseHeat.h"

#include "CasePlaces.h"
#include "FlowCase.h"
#include "Support/Error.h"
#include "Support/Text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace atria {

namespace {

constexpr double absoluteZero = -273.15;
constexpr double gravity = 9.81;
/// Pressure over the gas constant of dry air: density times absolute temperature, kg K/m3.
constexpr double densityTimesTemperature = 101325.0 / 287.055;
constexpr double specificHeat = 1005.0; ///< J/(kg K)
/// Temperatures of surfaces and incoming air, degrees Celsius. Others are mistakes, such as kelvin.
constexpr double coldest = -90.0;
constexpr double hottest = 200.0;
/// Largest difference of temperatures for which the density may be taken as linear in it, K.
constexpr double largestDifference = 30.0;

bool readNumber(const std::string& text, double& number, std::string& unit)
{
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  unit.assign(end, last);
  return error == std::errc() && std::isfinite(number);
}

std::string shortNumber(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(5) << value;
  return text.str();
}

/// Returns the pattern and the amount of a rule. Throws Error with `form` if a part is missing.
std::pair<std::string, std::string> partsOf(const std::string& text, const char* form)
{
  std::istringstream in(text);
  std::string pattern, amount, more;
  if (!(in >> std::quoted(pattern) >> amount) || in >> more)
  {
    throw Error("'" + text + "' is not of the form " + form);
  }
  return {pattern, amount};
}

/// Adds heat. Returns why it cannot, or nothing.
std::string addHeat(const HeatRule& rule, const Places& places, CaseHeat& heat)
{
  const Sizes zones = matching(rule.pattern, places.zones);
  const Sizes surfaces = matching(rule.pattern, places.surfaces);
  if (sum(zones) > 0.0 && !rule.isPerArea)
  {
    divide(rule.amount, zones, heat.zones);
    return {};
  }
  if (surfaces.empty() && !zones.empty())
  {
    return rule.isPerArea ? "a cell zone has no area: give its heat in W, such as 600W" : "the zone has no cells";
  }
  if (surfaces.empty())
  {
    return "air flows through it: give the temperature of the air that comes in by TemperatureRules";
  }
  if (!(sum(surfaces) > 0.0))
  {
    return "the mesh has no faces of it";
  }
  divide(rule.isPerArea ? rule.amount * sum(surfaces) : rule.amount, surfaces, heat.surfaces);
  return {};
}

/// Adds the temperature of surfaces and openings. Returns why it cannot, or nothing.
std::string addTemperature(const TemperatureRule& rule, const Places& places, CaseHeat& heat)
{
  const Sizes surfaces = matching(rule.pattern, places.surfaces);
  const Sizes openings = matching(rule.pattern, places.openings);
  for (const auto& [name, area] : surfaces)
  {
    heat.temperatures[name] = rule.celsius;
  }
  for (const auto& [name, area] : openings)
  {
    heat.incoming[name] = rule.celsius;
  }
  return !surfaces.empty() || !openings.empty() ? ""
                                                : "a cell zone has no temperature of its own: give its heat in W by "
                                                  "HeatRules";
}

template <class Rules, class Add>
void addRules(const char* what, const Rules& rules, const Places& places, CaseHeat& heat, Add add)
{
  for (const auto& rule : rules)
  {
    const std::string fault = isKnown(rule.pattern, places) ? add(rule, places, heat) : unmatched(rule.pattern, places);
    if (!fault.empty())
    {
      throw Error(std::string(what) + " of '" + rule.pattern + "': " + fault);
    }
  }
}

/// Throws Error for settings that have no meaning without warm air.
void refuseWithoutWarmAir(const FlowCaseSettings& settings)
{
  const std::pair<const char*, bool> given[] = {{"HeatRules", !settings.heatRules.empty()},
                                                {"TemperatureRules", !settings.temperatureRules.empty()},
                                                {"Calm", settings.calm},
                                                {"TransientDuration", settings.transientDuration > 0.0}};
  for (const auto& [what, isGiven] : given)
  {
    if (isGiven)
    {
      throw Error(std::string("there is no warm air for ") + what +
                  ": set WarmAir and OutdoorTemperature, degrees Celsius");
    }
  }
}

double largestDifferenceIn(const CaseHeat& heat, double outdoorTemperature)
{
  double largest = 0.0;
  for (const auto* temperatures : {&heat.temperatures, &heat.incoming})
  {
    for (const auto& [name, celsius] : *temperatures)
    {
      largest = std::max(largest, std::abs(celsius - outdoorTemperature));
    }
  }
  return largest;
}

double wholeHeat(const CaseHeat& heat)
{
  double whole = 0.0;
  for (const auto* sources : {&heat.zones, &heat.surfaces})
  {
    for (const auto& [name, watts] : *sources)
    {
      whole += std::abs(watts);
    }
  }
  return whole;
}

/// Throws Error for heat and a temperature of the same surface, and where nothing moves the air: neither heat nor fans
/// nor inlets that blow.
void checkHeat(const CaseHeat& heat, const FlowCaseSettings& settings, const std::vector<PatchChoice>& choices)
{
  for (const auto& [name, watts] : heat.surfaces)
  {
    if (heat.temperatures.contains(name))
    {
      throw Error("surface '" + name + "' has both a temperature and heat: give one of them");
    }
  }
  const bool isBlown =
      !settings.fanRules.empty() || std::ranges::any_of(choices, [](const auto& c) { return c.supply.has_value(); });
  if (!(settings.calm && isBlown) && !(wholeHeat(heat) > 0.0) &&
      !(largestDifferenceIn(heat, settings.outdoorTemperature) > 0.0))
  {
    throw Error(
        "nothing warms or cools the air: the heat of all sources adds up to nothing, and no temperature differs "
        "from that outdoors. Give HeatRules or TemperatureRules");
  }
}

} // namespace

TemperatureRule temperatureRuleFrom(const std::string& text)
{
  const auto [pattern, amount] =
      partsOf(text, "PATTERN CELSIUS, the temperature of surfaces or of incoming air, such as Radiator 50");
  TemperatureRule rule{pattern, 0.0};
  std::string unit;
  if (!readNumber(amount, rule.celsius, unit) || !(unit.empty() || unit == "C"))
  {
    throw Error("temperature of '" + pattern + "': '" + amount + "' is no number of degrees Celsius");
  }
  if (rule.celsius < coldest || rule.celsius > hottest)
  {
    throw Error("temperature of '" + pattern + "': " + amount + " is not from " + shortNumber(coldest) + " to " +
                shortNumber(hottest) + " degrees Celsius. " +
                (rule.celsius > 0.0 ? amount + " kelvin are " + shortNumber(rule.celsius + absoluteZero)
                                    : "Give degrees Celsius"));
  }
  return rule;
}

HeatRule heatRuleFrom(const std::string& text)
{
  const auto [pattern, amount] = partsOf(text, "PATTERN AMOUNT, such as Office 600W or Floor 50W/m2");
  HeatRule rule{pattern, 0.0, false};
  std::string unit;
  const bool isNumber = readNumber(amount, rule.amount, unit);
  rule.isPerArea = unit == "W/m2";
  if (!isNumber || !(rule.isPerArea || unit == "W" || unit.empty()))
  {
    throw Error("heat of '" + pattern + "': '" + amount +
                "' is no amount of heat. Units are W, of all places together, and W/m2 of surfaces, such as 600W");
  }
  return rule;
}

CaseHeat caseHeat(const CaseMesh& mesh, const FlowCaseSettings& settings, const std::vector<PatchChoice>& choices)
{
  if (!settings.warmAir)
  {
    refuseWithoutWarmAir(settings);
    return {};
  }
  if (isFoundation(settings.dialect))
  {
    throw Error(
        "warm air is for OpenCFD's releases of OpenFOAM: the Foundation's solver of air with one density carries "
        "no temperature and has no buoyancy. Make the case for opencfd-1912 or opencfd-2006");
  }
  for (const ScalarRule& rule : settings.scalarRules)
  {
    if (rule.scalar == "T" || rule.scalar == "temperature")
    {
      throw Error("a scalar cannot be called '" + rule.scalar + "' where the air has a temperature");
    }
  }
  const Places places = placesOf(mesh, choices);
  CaseHeat heat;
  addRules("heat", settings.heatRules, places, heat, addHeat);
  addRules("temperature", settings.temperatureRules, places, heat, addTemperature);
  checkHeat(heat, settings, choices);
  return heat;
}

std::vector<std::string> warnOfHeat(const CaseHeat& heat, double outdoorTemperature)
{
  std::vector<std::string> names;
  for (const auto* temperatures : {&heat.temperatures, &heat.incoming})
  {
    for (const auto& [name, celsius] : *temperatures)
    {
      if (std::abs(celsius - outdoorTemperature) > largestDifference)
      {
        names.push_back("'" + name + "' (" + shortNumber(celsius) + ")");
      }
    }
  }
  if (names.empty())
  {
    return {};
  }
  return {"temperatures differ by more than " + shortNumber(largestDifference) + " K from the " +
          shortNumber(outdoorTemperature) + " degrees Celsius outdoors: " + joined(names) +
          ". The case takes the density as linear in the temperature, which holds for smaller differences"};
}

WarmAir warmAirAt(double celsius)
{
  const double kelvin = celsius - absoluteZero;
  return {1.0 / kelvin, specificHeat * densityTimesTemperature / kelvin};
}

double speedOfWarmAir(const CaseHeat& heat, double outdoorTemperature, double height)
{
  const WarmAir air = warmAirAt(outdoorTemperature);
  const double buoyancy = gravity * air.expansion;
  const double ofPlume = std::cbrt(buoyancy * wholeHeat(heat) / air.heatCapacity / height);
  return std::max(ofPlume, std::sqrt(buoyancy * largestDifferenceIn(heat, outdoorTemperature) * height));
}

} // namespace atria
