// SPDX-License-Identifier: GPL-3.0-or-later
/// Heat of a flow case: temperatures and heat of surfaces, heat of cell zones, and the temperature of incoming air.
#pragma once

#include "CaseMesh.h"

#include <map>
#include <string>
#include <vector>

namespace atria {

struct FlowCaseSettings;
struct PatchChoice;

/// Temperature of surfaces, or of the air that comes in at openings. The last of several matching rules holds.
struct TemperatureRule
{
  std::string pattern;  ///< see matchesPattern; of patches
  double celsius = 0.0; ///< degrees Celsius
};

/// Heat that cell zones or surfaces give to the air; negative heat cools. Several rules for a place add up.
struct HeatRule
{
  std::string pattern;    ///< see matchesPattern; of a cell zone, or else of surfaces
  double amount = 0.0;    ///< W over all that match, or W/m2
  bool isPerArea = false; ///< the amount is in W/m2
};

/// Parses `PATTERN CELSIUS`. Throws Error if a part is missing, or for a temperature that looks like kelvin.
TemperatureRule temperatureRuleFrom(const std::string& text);
/// Parses `PATTERN AMOUNT`, such as "Office 600W" or "Floor 50W/m2"; W is the unit without any. Throws Error if a part
/// is missing, or is no amount.
HeatRule heatRuleFrom(const std::string& text);

/// The heat of all rules. Cell zones and patches are named as in OpenFOAM.
struct CaseHeat
{
  std::map<std::string, double> zones;        ///< heat of cell zones, W
  std::map<std::string, double> surfaces;     ///< heat of patches, W
  std::map<std::string, double> temperatures; ///< temperatures of surfaces, degrees Celsius
  std::map<std::string, double> incoming;     ///< temperatures of incoming air by patch, degrees Celsius
};

/// Returns the heat of the settings, which is empty without warm air. Heat of several zones or patches is divided among
/// them in proportion to volume or area. Throws Error for
/// - rules, calm air or a transient run without warm air, and warm air for the Foundation's dialects,
/// - a rule that matches no place, or places without cells or faces,
/// - heat at patches that air passes, W/m2 of a cell zone, or both heat and a temperature for a surface,
/// - air that nothing warms or cools,
/// - a passive scalar with the name of the temperature.
CaseHeat caseHeat(const CaseMesh& mesh, const FlowCaseSettings& settings, const std::vector<PatchChoice>& choices);

/// Returns warnings of temperatures that differ too much for the model.
std::vector<std::string> warnOfHeat(const CaseHeat& heat, double outdoorTemperature);

/// Properties of air at a temperature in degrees Celsius.
struct WarmAir
{
  double expansion = 0.0;    ///< 1/K
  double heatCapacity = 0.0; ///< J/(m3 K)
};
WarmAir warmAirAt(double celsius);

/// Returns a typical speed of air that only heat moves, m/s: that of a plume as high as the mesh, or that by the
/// largest difference of temperatures, whichever is larger.
double speedOfWarmAir(const CaseHeat& heat, double outdoorTemperature, double height);

} // namespace atria
