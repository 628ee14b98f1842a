// SPDX-License-Identifier: GPL-3.0-or-later
#include "Grid/Prism.h"

#include "Support/Error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace atria {

namespace {

constexpr std::string_view prismSidePrefix = "domainSide";

/// Returns the corners of the regular polygon around the unit circle; the first side starts at the first one.
std::vector<Vec2> regularCorners(int sideCount)
{
  std::vector<Vec2> corners;
  const double radius = 1.0 / std::cos(std::numbers::pi / sideCount);
  for (int i = 0; i < sideCount; ++i)
  {
    const double angle = std::numbers::pi * (1.0 + (2.0 * i - 1.0) / sideCount);
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return corners;
}

std::pair<Vec2, Vec2> boundsOf(const std::vector<Vec2>& points)
{
  std::pair bounds(points.front(), points.front());
  for (const Vec2& p : points)
  {
    bounds = {bounds.first.cwiseMin(p), bounds.second.cwiseMax(p)};
  }
  return bounds;
}

/// Returns a value from `low` to `high` for shares from 0 to 1; exact at both ends, even if shares are rounded.
double between(double low, double high, double share)
{
  constexpr double rounding = 1e-12;
  return share < rounding ? low : share > 1.0 - rounding ? high : low + share * (high - low);
}

void checkCount(int sideCount)
{
  if (sideCount < fewestPrismSides || sideCount > mostPrismSides)
  {
    throw Error("a domain has " + std::to_string(fewestPrismSides) + " to " + std::to_string(mostPrismSides) +
                " upright sides, not " + std::to_string(sideCount));
  }
}

double crossProduct(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Returns the turn to the left at a corner, in degrees from -180 to 180.
double turnAt(const std::vector<Vec2>& corners, std::size_t i)
{
  const std::size_t count = corners.size();
  const Vec2 from = corners[i] - corners[(i + count - 1) % count];
  const Vec2 to = corners[(i + 1) % count] - corners[i];
  return std::atan2(crossProduct(from, to), from.dot(to)) * 180.0 / std::numbers::pi;
}

std::string nameOf(std::size_t i, const Vec2& corner)
{
  std::ostringstream text;
  text << "corner " << i + 1 << " (" << corner[0] << ", " << corner[1] << ")";
  return text.str();
}

void refuseRepeated(const std::vector<Vec2>& corners)
{
  const auto [low, high] = boundsOf(corners);
  const double same = 1e-9 * (high - low).norm();
  for (std::size_t j = 1; j < corners.size(); ++j)
  {
    for (std::size_t i = 0; i < j; ++i)
    {
      if (!((corners[i] - corners[j]).norm() > same))
      {
        throw Error("the polygon of the domain: " + nameOf(j, corners[j]) + " repeats corner " + std::to_string(i + 1) +
                    "; each is given once, and the last is joined to the first");
      }
    }
  }
}

/// Returns the corners of a convex polygon counterclockwise, from the first on. Throws Error that names the corner as
/// given if the polygon is not convex.
std::vector<Vec2> counterclockwise(std::vector<Vec2> corners)
{
  constexpr double straight = 1.0; // degrees
  const auto isFinite = [](const Vec2& corner) { return corner.allFinite(); };
  if (!std::ranges::all_of(corners, isFinite))
  {
    throw Error("the polygon of the domain has a corner that is no number");
  }
  refuseRepeated(corners);
  double around = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    around += turnAt(corners, i);
  }
  const double way = around < 0.0 ? -1.0 : 1.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const double turn = way * turnAt(corners, i);
    if (std::abs(turn) < straight || turn > 180.0 - straight)
    {
      throw Error("the polygon of the domain: at " + nameOf(i, corners[i]) + " its sides " +
                  (turn > straight ? "fold back" : "go straight on") + " to within a degree; leave the corner out");
    }
    if (turn < 0.0)
    {
      throw Error("the polygon of the domain is not convex at " + nameOf(i, corners[i]) +
                  ": all of its corners must turn the same way; leave the corner out, or move it outwards");
    }
  }
  if (std::abs(around) > 540.0)
  {
    throw Error("the polygon of the domain goes round more than once: its sides cross each other");
  }
  if (way < 0.0)
  {
    std::reverse(corners.begin() + 1, corners.end());
  }
  return corners;
}

Vec2 nearestOn(const PrismSide& side, const Vec2& p)
{
  const Vec2 along = side.end - side.start;
  const double share = along.dot(p - side.start) / along.squaredNorm();
  return share <= 0.0 ? side.start : share >= 1.0 ? side.end : side.foot(p);
}

} // namespace

std::string sideName(Index number)
{
  return number < firstPrismSide ? sideNames[number]
                                 : std::string(prismSidePrefix) + std::to_string(number - firstPrismSide + 1);
}

bool isSideName(std::string_view name)
{
  for (Index number = 0; number < sideNumbers; ++number)
  {
    if (name == sideName(number))
    {
      return true;
    }
  }
  return false;
}

PlacedPrism::PlacedPrism(const PlacedBox& box, int sideCount) : PlacedBox(box)
{
  checkCount(sideCount);
  std::vector<Vec2> corners = regularCorners(sideCount);
  const auto [low, high] = boundsOf(corners);
  for (Vec2& corner : corners)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const double share = (corner[axis] - low[axis]) / (high[axis] - low[axis]);
      corner[axis] = between(bounds.min[axis], bounds.max[axis], share);
    }
  }
  setSides(corners, sideCount == 4);
}

PlacedPrism::PlacedPrism(const Placement& axesOfCorners, const std::vector<Vec2>& corners, double bottom, double top)
{
  checkCount(static_cast<int>(corners.size()));
  const std::vector<Vec2> round = counterclockwise(corners);
  const auto [low, high] = boundsOf(round);
  axes = axesOfCorners;
  bounds = {{low[0], low[1], bottom}, {high[0], high[1], top}};
  setSides(round, false);
}

void PlacedPrism::setSides(const std::vector<Vec2>& corners, bool isOfBox)
{
  constexpr std::array<Index, 4> ofBox{xMin, yMin, xMax, yMax}; // counterclockwise
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    PrismSide side;
    side.number = isOfBox ? ofBox[i] : firstPrismSide + static_cast<Index>(i);
    side.start = corners[i];
    side.end = corners[(i + 1) % corners.size()];
    const Vec2 along = side.end - side.start;
    side.normal = Vec2(along[1], -along[0]).normalized();
    side.offset = side.normal.dot(side.start);
    sides_.push_back(side);
  }
}

double PlacedPrism::beyond(const Vec2& p) const
{
  double most = -std::numeric_limits<double>::infinity();
  for (const PrismSide& side : sides_)
  {
    most = std::max(most, side.beyond(p));
  }
  return most;
}

bool PlacedPrism::contains(const Vec3& modelPoint) const
{
  const Vec3 p = axes.fromModel(modelPoint);
  return p[2] >= bounds.min[2] && p[2] <= bounds.max[2] && beyond(p.head<2>()) <= 0.0;
}

Vec2 PlacedPrism::nearest(const Vec2& p, SideBits on) const
{
  if (on == 0 && beyond(p) <= 0.0)
  {
    return p;
  }
  const auto isOn = [&](const PrismSide& side) { return on == 0 || (on >> side.number & 1) != 0; };
  Vec2 best = p;
  double least = std::numeric_limits<double>::infinity();
  bool atCorner = false;
  for (std::size_t i = 0; i < sides_.size(); ++i)
  {
    const PrismSide& side = sides_[i];
    if (!isOn(side))
    {
      continue;
    }
    // If two requested sides meet, their common corner takes precedence.
    const bool meets = on != 0 && isOn(sides_[(i + 1) % sides_.size()]);
    const Vec2 place = meets ? side.end : nearestOn(side, p);
    const double distance = (place - p).squaredNorm();
    if ((meets && !atCorner) || (meets == atCorner && distance < least))
    {
      best = place;
      least = distance;
      atCorner = meets;
    }
  }
  return best;
}

double PlacedPrism::volume() const
{
  double area = 0.0;
  for (const PrismSide& side : sides_)
  {
    area += 0.5 * (side.start[0] * side.end[1] - side.end[0] * side.start[1]);
  }
  return area * bounds.size()[2];
}

Box3 boundsAboutCircle(const Vec2& center, double radius, int sideCount, double bottom, double top)
{
  const auto [low, high] = boundsOf(regularCorners(sideCount));
  const Vec2 min = center + radius * low;
  const Vec2 max = center + radius * high;
  return {{min[0], min[1], bottom}, {max[0], max[1], top}};
}

Box3 boundsAlong(const Placement& axes, const PlacedPrism& prism)
{
  const Placement relative(axes.angle() - prism.axes.angle());
  Box3 out;
  for (const PrismSide& side : prism.sides())
  {
    out.extend(relative.fromModel({side.start[0], side.start[1], prism.bounds.min[2]}));
    out.extend(relative.fromModel({side.start[0], side.start[1], prism.bounds.max[2]}));
  }
  return out;
}

} // namespace atria
