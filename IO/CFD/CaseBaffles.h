// SPDX-License-Identifier: GPL-3.0-or-later
/// Screens and fans of a flow case: face zones where the pressure jumps.
#pragma once

#include "CaseMesh.h"
#include "Support/RunContext.h"
#include "ZoneSides.h"

#include <string>
#include <utility>
#include <vector>

namespace atria {

/// Density of air at 15 degrees Celsius, kg/m3, by which pressures become those of OpenFOAM, Pa m3/kg.
inline constexpr double airDensity = 1.225;

struct FlowCaseSettings;

/// A porous screen in face zones. The pressure falls by resistance * density * U^2 / 2 + linear * U, U being the speed
/// through the screen. The last of several matching rules holds.
struct ScreenRule
{
  std::string pattern;     ///< see matchesPattern
  double resistance = 0.0; ///< loss coefficient, not negative
  double linear = 0.0;     ///< Pa for each m/s, not negative
};

/// Parses `PATTERN RESISTANCE`, such as `Window 2.5` or `Window 2.5,0.4` with a linear part. Throws Error if a part is
/// missing, negative or no number, or if there is no resistance at all.
ScreenRule screenRuleFrom(const std::string& text);

/// A fan in face zones. The last of several matching rules holds.
struct FanRule
{
  std::string pattern;  ///< see matchesPattern
  std::string pressure; ///< a number, Pa, or the file of a curve
};

/// Parses `PATTERN PRESSURE|FILE`. Throws Error if a part is missing.
FanRule fanRuleFrom(const std::string& text);

/// Pressure rise over flow rate, m3/s and Pa. Between the points it is linear, and beyond them constant.
using FanCurve = std::vector<std::pair<double, double>>;

/// Reads a fan's curve: a number is a constant pressure, otherwise a table with lines of flow rate and pressure. All
/// pressures are negative for a fan that blows against the zone's normal. Throws Error naming a line with other than
/// two numbers, where the flow rate does not rise, or where the pressure rises or changes its sign.
FanCurve fanCurveFrom(const std::string& pressure);

/// A face zone with a screen or a fan.
struct CaseBaffle
{
  std::string zone;
  Vec3 normal = Vec3::Zero(); ///< unit normal of the zone
  double area = 0.0;          ///< area of its outline, m2
  double faceArea = 0.0;      ///< sum of its faces, m2; larger if they are uneven
  double cellWidth = 0.0;     ///< width of the thinner cells beside it, along the normal, meters
  double resistance = 0.0;
  double linear = 0.0;
  FanCurve curve;         ///< pressures are not negative; empty for a screen
  bool blowsBack = false; ///< the fan blows against the normal

  bool isFan() const { return !curve.empty(); }
  DividedZone division() const { return {zone, blowsBack}; }
};

/// Returns the speed of free air that the fan's greatest pressure gives, m/s; 0 for a screen.
double speedOf(const CaseBaffle& baffle);

/// Returns the screens and fans that rules make of the mesh's face zones. Throws Error if a rule matches no zone, if a
/// zone has a screen and a fan, or if it is not nearly plane.
std::vector<CaseBaffle> bafflesOf(const PolyMesh& poly, const FlowCaseSettings& settings, const RunContext& context);

} // namespace atria
