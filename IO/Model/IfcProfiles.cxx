// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcProfiles.h"

#include "IfcPlacement.h"

#include "Support/Types.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace atria::model::ifc {

namespace {

using step::argument;
using step::Instance;
using step::reference;

using Outline = std::vector<Vec3>; ///< counterclockwise in the plane of x and y

/// The outer line, and that of the hole in a hollow profile.
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

/// Around the origin, with half the lengths.
Outline rectangle(double x, double y) { return {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}}; }

/// Two flanges, `bottom` and `top` wide in half, and a web that is `web` thick in half.
Outline sectionI(double bottom, double top, double depth, double web, double bottomThick, double topThick)
{
  const double y = 0.5 * depth;
  const double low = bottomThick - y;
  const double high = y - topThick;
  return {{-bottom, -y, 0.0}, {bottom, -y, 0.0}, {bottom, low, 0.0}, {web, low, 0.0},
          {web, high, 0.0},   {top, high, 0.0},  {top, y, 0.0},      {-top, y, 0.0},
          {-top, high, 0.0},  {-web, high, 0.0}, {-web, low, 0.0},   {-bottom, low, 0.0}};
}

/// A C of sheet metal that opens in x, with lips of the length `girth`.
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

/// The lines of a profile before it is placed; nothing for other kinds.
std::optional<Lines> linesOf(const Instance& profile)
{
  const std::string& type = profile.type;
  bool isGood = true;
  const auto length = [&](std::size_t i) {
    const auto value = step::numberIn(argument(profile, i));
    isGood = isGood && value && *value > 0.0;
    return value.value_or(0.0);
  };
  const auto half = [&](std::size_t i) { return 0.5 * length(i); };
  Lines out;
  if (type == "IFCISHAPEPROFILEDEF")
  {
    out.outer = sectionI(half(3), half(3), length(4), half(5), length(6), length(6));
  }
  else if (type == "IFCASYMMETRICISHAPEPROFILEDEF")
  {
    const double top = step::numberIn(argument(profile, 9)) ? length(9) : length(6);
    out.outer = sectionI(half(3), half(8), length(4), half(5), length(6), top);
  }
  else if (type == "IFCLSHAPEPROFILEDEF")
  {
    const double y = half(3);
    const double x = step::numberIn(argument(profile, 4)) ? half(4) : y;
    const double thick = length(5);
    out.outer = {{-x, -y, 0.0},       {x, -y, 0.0}, {x, thick - y, 0.0}, {thick - x, thick - y, 0.0},
                 {thick - x, y, 0.0}, {-x, y, 0.0}};
  }
  else if (type == "IFCTSHAPEPROFILEDEF")
  {
    const double y = half(3);
    const double x = half(4);
    const double web = half(5);
    const double low = y - length(6);
    out.outer = {{-web, -y, 0.0}, {web, -y, 0.0}, {web, low, 0.0}, {x, low, 0.0},
                 {x, y, 0.0},     {-x, y, 0.0},   {-x, low, 0.0},  {-web, low, 0.0}};
  }
  else if (type == "IFCUSHAPEPROFILEDEF")
  {
    const double y = half(3);
    const double x = half(4);
    const double web = length(5) - x;
    const double thick = length(6);
    out.outer = {{-x, -y, 0.0},         {x, -y, 0.0},        {x, thick - y, 0.0}, {web, thick - y, 0.0},
                 {web, y - thick, 0.0}, {x, y - thick, 0.0}, {x, y, 0.0},         {-x, y, 0.0}};
  }
  else if (type == "IFCCSHAPEPROFILEDEF")
  {
    out.outer = sectionC(half(4), half(3), length(5), length(6));
  }
  else if (type == "IFCZSHAPEPROFILEDEF")
  {
    const double y = half(3);
    const double web = half(5);
    const double x = length(4) - web;
    const double thick = length(6);
    out.outer = {{-web, -y, 0.0}, {x, -y, 0.0}, {x, thick - y, 0.0},  {web, thick - y, 0.0},
                 {web, y, 0.0},   {-x, y, 0.0}, {-x, y - thick, 0.0}, {-web, y - thick, 0.0}};
  }
  else if (type == "IFCTRAPEZIUMPROFILEDEF")
  {
    const double x = half(3);
    const double y = half(5);
    const double left = step::numberIn(argument(profile, 6)).value_or(0.0) - x;
    out.outer = {{-x, -y, 0.0}, {x, -y, 0.0}, {left + length(4), y, 0.0}, {left, y, 0.0}};
  }
  else if (type == "IFCELLIPSEPROFILEDEF")
  {
    out.outer = ellipse(length(3), length(4));
  }
  else if (type == "IFCCIRCLEHOLLOWPROFILEDEF")
  {
    const double radius = length(3);
    const double hole = radius - length(4);
    out.outer = ellipse(radius, radius);
    out.inner = ellipse(hole, hole);
    isGood = isGood && hole > 0.0;
  }
  else if (type == "IFCRECTANGLEHOLLOWPROFILEDEF")
  {
    const double x = half(3);
    const double y = half(4);
    const double thick = length(5);
    out.outer = rectangle(x, y);
    out.inner = rectangle(x - thick, y - thick);
    isGood = isGood && thick < std::min(x, y);
  }
  return isGood && !out.outer.empty() ? std::optional(out) : std::nullopt;
}

/// A closed polyline in the file, by reference.
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
