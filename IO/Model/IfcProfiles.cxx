// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcProfiles.h"

#include "IfcPlacement.h"

#include "Support/Types.h"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

namespace atria::model::ifc {

namespace {

using namespace step;

using Outline = std::vector<Vec3>; ///< counterclockwise in the plane of x and y

/// The outer line, and the line of the hole in a hollow profile.
struct Lines
{
  Outline outer;
  Outline inner;
};

Outline ellipse(double a, double b)
{
  constexpr int pieces = 32;
  Outline out;
  for (int i = 0; i < pieces; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * i / pieces;
    out.emplace_back(a * std::cos(angle), b * std::sin(angle), 0.0);
  }
  return out;
}

/// Returns a rectangle around the origin, with half the lengths.
Outline rectangle(double x, double y) { return {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}}; }

/// Returns two flanges, `bottom` and `top` wide in half, and a web that is `web` thick in half.
Outline sectionI(double bottom, double top, double depth, double web, double bottomThick, double topThick)
{
  const double y = 0.5 * depth;
  const double low = bottomThick - y;
  const double high = y - topThick;
  return {{-bottom, -y, 0.0}, {bottom, -y, 0.0}, {bottom, low, 0.0}, {web, low, 0.0},
          {web, high, 0.0},   {top, high, 0.0},  {top, y, 0.0},      {-top, y, 0.0},
          {-top, high, 0.0},  {-web, high, 0.0}, {-web, low, 0.0},   {-bottom, low, 0.0}};
}

/// Returns a C of sheet metal that opens in x, with lips of the length `girth`.
Outline sectionC(double x, double y, double thick, double girth)
{
  return {{-x, -y, 0.0},
          {x, -y, 0.0},
          {x, girth - y, 0.0},
          {x - thick, girth - y, 0.0},
          {x - thick, thick - y, 0.0},
          {thick - x, thick - y, 0.0},
          {thick - x, y - thick, 0.0},
          {x - thick, y - thick, 0.0},
          {x - thick, y - girth, 0.0},
          {x, y - girth, 0.0},
          {x, y, 0.0},
          {-x, y, 0.0}};
}

/// Reads the lengths of a profile, all of which must be positive.
class Lengths
{
public:
  explicit Lengths(const Instance& instance) : profile(instance) {}

  double at(std::size_t i)
  {
    const auto value = step::numberIn(argument(profile, i));
    areGood = areGood && value && *value > 0.0;
    return value.value_or(0.0);
  }
  double half(std::size_t i) { return 0.5 * at(i); }
  /// Returns a length of any sign.
  std::optional<double> optional(std::size_t i) const { return step::numberIn(argument(profile, i)); }

  void require(bool isGood) { areGood = areGood && isGood; }
  bool good() const { return areGood; }

private:
  const Instance& profile;
  bool areGood = true;
};

Lines asymmetricI(Lengths& of)
{
  const double top = of.optional(9) ? of.at(9) : of.at(6);
  return {sectionI(of.half(3), of.half(8), of.at(4), of.half(5), of.at(6), top), {}};
}

Lines sectionL(Lengths& of)
{
  const double y = of.half(3);
  const double x = of.optional(4) ? of.half(4) : y;
  const double thick = of.at(5);
  return {{{-x, -y, 0.0},
           {x, -y, 0.0},
           {x, thick - y, 0.0},
           {thick - x, thick - y, 0.0},
           {thick - x, y, 0.0},
           {-x, y, 0.0}},
          {}};
}

Lines sectionT(Lengths& of)
{
  const double y = of.half(3);
  const double x = of.half(4);
  const double web = of.half(5);
  const double low = y - of.at(6);
  return {{{-web, -y, 0.0},
           {web, -y, 0.0},
           {web, low, 0.0},
           {x, low, 0.0},
           {x, y, 0.0},
           {-x, y, 0.0},
           {-x, low, 0.0},
           {-web, low, 0.0}},
          {}};
}

Lines sectionU(Lengths& of)
{
  const double y = of.half(3);
  const double x = of.half(4);
  const double web = of.at(5) - x;
  const double thick = of.at(6);
  return {{{-x, -y, 0.0},
           {x, -y, 0.0},
           {x, thick - y, 0.0},
           {web, thick - y, 0.0},
           {web, y - thick, 0.0},
           {x, y - thick, 0.0},
           {x, y, 0.0},
           {-x, y, 0.0}},
          {}};
}

Lines sectionZ(Lengths& of)
{
  const double y = of.half(3);
  const double web = of.half(5);
  const double x = of.at(4) - web;
  const double thick = of.at(6);
  return {{{-web, -y, 0.0},
           {x, -y, 0.0},
           {x, thick - y, 0.0},
           {web, thick - y, 0.0},
           {web, y, 0.0},
           {-x, y, 0.0},
           {-x, y - thick, 0.0},
           {-web, y - thick, 0.0}},
          {}};
}

Lines trapezium(Lengths& of)
{
  const double x = of.half(3);
  const double y = of.half(5);
  const double left = of.optional(6).value_or(0.0) - x;
  return {{{-x, -y, 0.0}, {x, -y, 0.0}, {left + of.at(4), y, 0.0}, {left, y, 0.0}}, {}};
}

Lines hollowCircle(Lengths& of)
{
  const double radius = of.at(3);
  const double hole = radius - of.at(4);
  of.require(hole > 0.0);
  return {ellipse(radius, radius), ellipse(hole, hole)};
}

Lines hollowRectangle(Lengths& of)
{
  const double x = of.half(3);
  const double y = of.half(4);
  const double thick = of.at(5);
  of.require(thick < std::min(x, y));
  return {rectangle(x, y), rectangle(x - thick, y - thick)};
}

/// Returns the lines of a profile before it is placed; nothing for other kinds.
std::optional<Lines> linesOf(const Instance& profile)
{
  using Make = Lines (*)(Lengths&);
  static const std::map<std::string_view, Make> kinds{
      {"IFCISHAPEPROFILEDEF",
       [](Lengths& of) -> Lines {
         return {sectionI(of.half(3), of.half(3), of.at(4), of.half(5), of.at(6), of.at(6)), {}};
       }},
      {"IFCASYMMETRICISHAPEPROFILEDEF", asymmetricI},
      {"IFCLSHAPEPROFILEDEF", sectionL},
      {"IFCTSHAPEPROFILEDEF", sectionT},
      {"IFCUSHAPEPROFILEDEF", sectionU},
      {"IFCCSHAPEPROFILEDEF",
       [](Lengths& of) -> Lines {
         return {sectionC(of.half(4), of.half(3), of.at(5), of.at(6)), {}};
       }},
      {"IFCZSHAPEPROFILEDEF", sectionZ},
      {"IFCTRAPEZIUMPROFILEDEF", trapezium},
      {"IFCELLIPSEPROFILEDEF",
       [](Lengths& of) -> Lines {
         return {ellipse(of.at(3), of.at(4)), {}};
       }},
      {"IFCCIRCLEHOLLOWPROFILEDEF", hollowCircle},
      {"IFCRECTANGLEHOLLOWPROFILEDEF", hollowRectangle}};
  const auto kind = kinds.find(profile.type);
  if (kind == kinds.end())
  {
    return std::nullopt;
  }
  Lengths lengths(profile);
  Lines lines = kind->second(lengths);
  return lengths.good() ? std::optional(std::move(lines)) : std::nullopt;
}

/// Adds a closed polyline to the file, and returns its reference.
std::string polyline(step::File& content, const Outline& outline, const Frame& frame)
{
  std::string points;
  std::string first;
  for (const Vec3& p : outline)
  {
    const Vec3 placed = frame.placed(p);
    const std::string text = "(" + textOf(placed.x()) + "," + textOf(placed.y()) + ")";
    const std::string point = reference(content.add("IFCCARTESIANPOINT", text));
    first = first.empty() ? point : first;
    points += point + ",";
  }
  return reference(content.add("IFCPOLYLINE", "(" + points + first + ")"));
}

} // namespace

void writeProfilesAsOutlines(step::File& content)
{
  const std::size_t count = content.instances().size(); // without those it adds
  for (std::size_t i = 0; i < count; ++i)
  {
    const Instance profile = content.instances()[i];
    const auto lines = profile.type.ends_with("PROFILEDEF") ? linesOf(profile) : std::nullopt;
    const auto frame = lines ? frameAt(content, argument(profile, 2)) : std::nullopt;
    if (!frame)
    {
      continue;
    }
    std::string arguments = std::string(argument(profile, 0)) + "," + std::string(argument(profile, 1)) + "," +
                            polyline(content, lines->outer, *frame);
    arguments += lines->inner.empty() ? "" : ",(" + polyline(content, lines->inner, *frame) + ")";
    Instance& own = content.instances()[i];
    own.type = lines->inner.empty() ? "IFCARBITRARYCLOSEDPROFILEDEF" : "IFCARBITRARYPROFILEDEFWITHVOIDS";
    own.arguments = arguments;
  }
}

} // namespace atria::model::ifc
