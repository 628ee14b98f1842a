// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseBaffles.h"

#include "FlowCase.h"
#include "NumberTable.h"
#include "PatchNames.h"
#include "Quality/Faces/Geometry.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <map>
#include <optional>
#include <sstream>

namespace atria {

namespace {

/// Share of a zone's faces that face one way from which it is plane, as for the areas of openings.
constexpr double planeShare = 0.95;
/// Share of the mean width of cells beside a zone below which a cell does not count: slivers would slow the run.
constexpr double leastCellShare = 0.25;

std::optional<double> numberFrom(std::string_view text)
{
  double number = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Returns the two words of a rule, or nothing.
std::optional<std::pair<std::string, std::string>> twoWords(const std::string& text)
{
  std::istringstream in(text);
  std::string pattern, value, more;
  const bool fits = in >> std::quoted(pattern) >> std::quoted(value) && !(in >> more);
  return fits ? std::optional(std::pair(pattern, value)) : std::nullopt;
}

/// Refuses a curve that a fan cannot have. `where` returns the place of a point.
template <typename Where> void checkCurve(const FanCurve& curve, Where&& where)
{
  for (std::size_t i = 0; i < curve.size(); ++i)
  {
    const auto& [flow, pressure] = curve[i];
    const bool isFirst = i == 0;
    const std::string fault = flow < 0.0                         ? "the flow rate is negative"
                              : pressure * curve[0].second < 0.0 ? "the pressure changes its sign"
                              : isFirst                          ? ""
                              : flow <= curve[i - 1].first       ? "the flow rate is not above that of the line before"
                              : std::abs(pressure) > std::abs(curve[i - 1].second)
                                  ? "the pressure is above that of the line before"
                                  : "";
    if (!fault.empty())
    {
      throw Error(where(i) + ": " + fault +
                  ". The curve of a fan has rising flow rates, m3/s, with pressures that fall or stay, Pa");
    }
  }
}

/// The screen or fan that rules choose for a face zone.
struct Choice
{
  std::optional<ScreenRule> screen;
  std::optional<FanCurve> curve;
};
using Choices = std::map<std::string, Choice>;

std::vector<std::string> zoneNames(const PolyMesh& poly)
{
  std::vector<std::string> names;
  for (const FaceZone& zone : poly.faceZones)
  {
    names.push_back(zone.name);
  }
  return names;
}

/// Returns the zones that match. Throws Error if there are none.
std::vector<std::string> matching(const PolyMesh& poly, const std::string& what, const std::string& pattern)
{
  std::vector<std::string> names = zoneNames(poly);
  std::erase_if(names, [&](const std::string& name) { return !matchesPatchName(pattern, name, openFOAMNames); });
  if (!names.empty())
  {
    return names;
  }
  const auto isOther = [&](const auto& named) { return matchesPatchName(pattern, named.name, openFOAMNames); };
  const std::string other = std::ranges::any_of(poly.patches, isOther)     ? " is a patch, and no face zone"
                            : std::ranges::any_of(poly.cellZones, isOther) ? " is a cell zone, and no face zone"
                                                                           : ": no face zone matches";
  throw Error(what + " '" + pattern + "'" + other + "; " +
              (poly.faceZones.empty()
                   ? "the mesh has no face zones: FindOpenings makes them of windows and doors, FaceZones of surfaces"
                   : namesInstead(pattern, zoneNames(poly))));
}

Choices choicesOf(const PolyMesh& poly, const FlowCaseSettings& settings)
{
  Choices choices;
  for (const ScreenRule& rule : settings.screenRules)
  {
    for (const std::string& zone : matching(poly, "screen", rule.pattern))
    {
      choices[zone].screen = rule;
    }
  }
  for (const FanRule& rule : settings.fanRules)
  {
    const FanCurve curve = fanCurveFrom(rule.pressure);
    for (const std::string& zone : matching(poly, "fan", rule.pattern))
    {
      choices[zone].curve = curve;
    }
  }
  return choices;
}

/// Sets what a baffle does to the pressure.
void fill(const Choice& choice, CaseBaffle& baffle)
{
  if (choice.screen && choice.curve)
  {
    throw Error("face zone '" + baffle.zone +
                "' has a screen and a fan: subtract the screen's loss from the fan's curve");
  }
  if (choice.screen)
  {
    baffle.resistance = choice.screen->resistance;
    baffle.linear = choice.screen->linear;
    return;
  }
  baffle.curve = *choice.curve;
  baffle.blowsBack = baffle.curve[0].second < 0.0;
  for (auto& [flow, pressure] : baffle.curve)
  {
    pressure = std::abs(pressure);
  }
}

/// Sets the geometry of a baffle.
void measure(const FaceMesh& mesh, const MeshGeometry& geometry, const FaceZone& zone, CaseBaffle& baffle)
{
  Vec3 vector = Vec3::Zero();
  double widths = 0.0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < zone.faces.size(); ++i)
  {
    const Index face = zone.faces[i];
    const double area = geometry.faceAreas[face].norm();
    vector += zone.flips[i] ? Vec3(-geometry.faceAreas[face]) : geometry.faceAreas[face];
    baffle.faceArea += area;
    if (face >= mesh.internalFaceCount())
    {
      throw Error("face zone '" + zone.name +
                  "' has faces on the boundary of the mesh: a screen or a fan needs air on "
                  "both sides");
    }
    for (const Index cell : {mesh.owner[face], mesh.neighbor[face]})
    {
      const double width = geometry.cellVolumes[cell] / area;
      widths += 0.5 * width * area;
      least = std::min(least, width);
    }
  }
  baffle.area = vector.norm();
  if (!(baffle.area > planeShare * baffle.faceArea))
  {
    throw Error("face zone '" + zone.name +
                (zone.faces.empty() ? "' has no faces"
                                    : "' is not plane: a screen or a fan needs a zone for each plane "
                                      "part"));
  }
  baffle.normal = vector / baffle.area;
  baffle.cellWidth = std::max(least, leastCellShare * widths / baffle.faceArea);
}

} // namespace

ScreenRule screenRuleFrom(const std::string& text)
{
  const auto words = twoWords(text);
  const std::string value = words ? words->second : "";
  const std::size_t comma = value.find(',');
  const auto resistance = numberFrom(std::string_view(value).substr(0, comma));
  const auto linear = comma == std::string::npos ? 0.0 : numberFrom(std::string_view(value).substr(comma + 1));
  const bool fits = resistance && linear && *resistance >= 0.0 && *linear >= 0.0 && *resistance + *linear > 0.0;
  if (!fits)
  {
    throw Error("the screen '" + text +
                "' is not of the form PATTERN RESISTANCE, with the loss coefficient of the screen, such as Window 2.5, "
                "or with a linear part in Pa for each m/s, such as Window 2.5,0.4. Neither is negative");
  }
  return {words->first, *resistance, *linear};
}

FanRule fanRuleFrom(const std::string& text)
{
  const auto words = twoWords(text);
  if (!words)
  {
    throw Error(
        "the fan '" + text +
        "' is not of the form PATTERN PRESSURE|FILE, with the pressure rise in Pa, such as Fan 20, or the table "
        "of its curve, such as Fan fan.csv");
  }
  return {words->first, words->second};
}

FanCurve fanCurveFrom(const std::string& pressure)
{
  if (const auto constant = numberFrom(pressure))
  {
    if (*constant == 0.0)
    {
      throw Error("a fan of 0 Pa does nothing");
    }
    return {{0.0, *constant}};
  }
  if (!std::filesystem::exists(pressure))
  {
    throw Error("the fan's pressure '" + pressure +
                "' is neither a number of Pa, without a unit, nor a file with its curve");
  }
  const auto isPoint = [](const std::vector<double>& n) {
    return n.size() == 2 && std::isfinite(n[0]) && std::isfinite(n[1]);
  };
  const std::vector<NumberRow> rows = readNumbers(
      pressure, {"curve of the fan", "a point of a fan's curve has a flow rate, m3/s, and a pressure, Pa", isPoint});
  FanCurve curve;
  for (const NumberRow& row : rows)
  {
    curve.emplace_back(row.numbers[0], row.numbers[1]);
  }
  checkCurve(curve, [&](std::size_t i) { return "'" + pressure + "', line " + std::to_string(rows[i].line); });
  if (curve[0].second == 0.0)
  {
    throw Error("'" + pressure + "': a fan of 0 Pa does nothing");
  }
  return curve;
}

double speedOf(const CaseBaffle& baffle)
{
  return baffle.isFan() ? std::sqrt(2.0 * baffle.curve[0].second / airDensity) : 0.0;
}

std::vector<CaseBaffle> bafflesOf(const PolyMesh& poly, const FlowCaseSettings& settings, const RunContext& context)
{
  const Choices choices = choicesOf(poly, settings);
  std::vector<CaseBaffle> baffles;
  if (choices.empty())
  {
    return baffles;
  }
  const MeasuredMesh measured = measureMesh(poly.mesh, context);
  for (const FaceZone& zone : poly.faceZones)
  {
    if (const auto choice = choices.find(zone.name); choice != choices.end())
    {
      CaseBaffle& baffle = baffles.emplace_back();
      baffle.zone = zone.name;
      fill(choice->second, baffle);
      measure(poly.mesh, measured.geometry, zone, baffle);
    }
  }
  return baffles;
}

} // namespace atria
