// SPDX-License-Identifier: GPL-3.0-or-later
#include "Grid/Prism.h"

#include "Support/Error.h"

#include <algorithm>
#include <charconv>

namespace atria {

namespace {

constexpr std::string_view prismSidePrefix = "domainSide";

/// Corners of the regular polygon about the unit circle, the first where the first side starts.
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

/// From `low` to `high` for shares from 0 to 1; exact at both, and where rounding is all that keeps a share from them.
double between(double low, double high, double share)
{
  constexpr double rounding = 1e-12;
  return share < rounding ? low : share > 1.0 - rounding ? high : low + share * (high - low);
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
  if (sideCount < fewestPrismSides || sideCount > mostPrismSides)
  {
    throw Error("a domain has " + std::to_string(fewestPrismSides) + " to " + std::to_string(mostPrismSides) +
                " upright sides, not " + std::to_string(sideCount));
  }
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
  constexpr std::array<Index, 4> ofBox{xMin, yMin, xMax, yMax}; // counterclockwise
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    PrismSide side;
    side.number = sideCount == 4 ? ofBox[i] : firstPrismSide + static_cast<Index>(i);
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
    // Where two sides are asked for that meet, it is where they meet.
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
