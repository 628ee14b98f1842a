// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/TurnedSides.h"

#include "Surface/Triangles/FacePrecedence.h"
#include "Surface/Triangles/PointPlaces.h"
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

namespace atria {

namespace {

/// A point, and the sides on which it lies.
struct Corner
{
  Vec3 at;
  SideBits on = 0;
};
using Polygon = std::vector<Corner>;

bool isOn(const Corner& corner, const PrismSide& side) { return (corner.on >> side.number & 1) != 0; }

/// Returns the corner moved onto sides within `tolerance`, or onto their edge if there are two.
Corner snapped(Corner corner, const PlacedPrism& domain, double tolerance)
{
  const std::vector<PrismSide>& sides = domain.sides();
  const Vec2 at = corner.at.head<2>();
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const PrismSide& side = sides[i];
    if (isOn(corner, side) || std::abs(side.beyond(at)) <= tolerance)
    {
      corner.on |= SideBits{1} << side.number;
      corner.at.head<2>() = side.foot(at);
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    if (isOn(corner, sides[i]) && isOn(corner, sides[(i + 1) % sides.size()]))
    {
      corner.at.head<2>() = sides[i].end;
    }
  }
  return corner;
}

double beyond(const Corner& corner, const PrismSide& side)
{
  return isOn(corner, side) ? 0.0 : side.beyond(corner.at.head<2>());
}

/// Returns the point where the edge meets the side. It has the same bits from both ends, so that neighbors stay
/// connected.
Corner cutEdge(const Corner& p, const Corner& q, const PrismSide& side)
{
  const bool ordered = std::tie(p.at[0], p.at[1], p.at[2]) < std::tie(q.at[0], q.at[1], q.at[2]);
  const Corner& a = ordered ? p : q;
  const Corner& b = ordered ? q : p;
  const double from = beyond(a, side);
  return {a.at + from / (from - beyond(b, side)) * (b.at - a.at), (a.on & b.on) | SideBits{1} << side.number};
}

/// Returns the part of a convex polygon on the inner side of a plane (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, const PlacedPrism& domain, const PrismSide& side, double tolerance)
{
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Corner& p = polygon[i];
    const Corner& q = polygon[(i + 1) % polygon.size()];
    const double ofP = beyond(p, side);
    const double ofQ = beyond(q, side);
    if (ofP <= 0.0)
    {
      out.push_back(p);
    }
    if ((ofP < 0.0 && ofQ > 0.0) || (ofP > 0.0 && ofQ < 0.0))
    {
      out.push_back(snapped(cutEdge(p, q, side), domain, tolerance));
    }
  }
  return out;
}

/// Chooses among triangles that cover the same part of a side, and sums up what surfaces share.
class CoverChoice
{
public:
  explicit CoverChoice(const TriangleSurface& drawn) : surface(drawn) {}

  /// Returns the surface that keeps its faces where `sources` cover so much area; noIndex without any.
  Index surfaceOf(std::span<const Index> sources, double area)
  {
    if (sources.size() < 2)
    {
      return sources.empty() ? noIndex : surface.surfaceIds[sources[0]];
    }
    if (!precedence)
    {
      Box3 bounds;
      std::ranges::for_each(surface.points, [&](const Vec3& p) { bounds.extend(p); });
      precedence.emplace(surface, placesOf(surface.points, placeStep(bounds)));
    }
    const Index kept = sources[precedence->keptOf(sources)];
    const Index keeps = surface.surfaceIds[kept];
    for (const Index source : sources)
    {
      if (const Index gives = surface.surfaceIds[source]; gives != keeps)
      {
        SharedArea& entry = byPair[{gives, keeps}];
        entry.keeps = keeps;
        entry.gives = gives;
        entry.area += area;
        entry.equalArea += precedence->areEqual(source, kept) ? area : 0.0;
      }
    }
    return keeps;
  }

  std::vector<SharedArea> shared() const
  {
    std::vector<SharedArea> all;
    std::ranges::transform(byPair, std::back_inserter(all), [](const auto& entry) { return entry.second; });
    return all;
  }

private:
  const TriangleSurface& surface;
  std::optional<FacePrecedence> precedence; ///< set on first use
  std::map<std::pair<Index, Index>, SharedArea> byPair;
};

/// One side of the domain: the outline, what surfaces draw on it, and triangles of surfaces that lie in it. Seen from
/// outside, counterclockwise is counterclockwise in (along, z).
class Side
{
public:
  Side(const PrismSide& ofPrism, double bottom, double top) : prismSide(ofPrism), low(bottom), high(top) {}

  void draw(const Polygon& polygon)
  {
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Corner& p = polygon[i];
      const Corner& q = polygon[(i + 1) % polygon.size()];
      if (isOn(p, prismSide) && isOn(q, prismSide))
      {
        const auto first = static_cast<Index>(places.size());
        places.push_back(p.at);
        places.push_back(q.at);
        segments.push_back({first, first + 1});
        low = std::min({low, p.at[2], q.at[2]});
        high = std::max({high, p.at[2], q.at[2]});
      }
    }
  }

  bool holds(const Polygon& polygon) const
  {
    return std::ranges::all_of(polygon, [&](const Corner& corner) { return isOn(corner, prismSide); });
  }

  /// Adds a triangle that lies in the side; `source` is its number.
  void cover(const Polygon& triangle, Index source)
  {
    const Cover cover{{flat(triangle[0].at), flat(triangle[1].at), flat(triangle[2].at)}, source};
    if (areaOf(cover.triangle) > 0.0)
    {
      covers.push_back(cover);
    }
  }

  void append(TriangleSurface& to, double bottom, double top, CoverChoice& choice)
  {
    for (const auto& [corner, height] : {std::pair(prismSide.start, bottom), std::pair(prismSide.end, bottom),
                                         std::pair(prismSide.end, top), std::pair(prismSide.start, top)})
    {
      places.emplace_back(corner[0], corner[1], height);
    }
    std::vector<Vec2> points(places.size());
    std::ranges::transform(places, points.begin(), [&](const Vec3& p) { return flat(p); });
    const PlanarTriangulation triangulation = triangulatePlane(points, segments);
    const auto base = static_cast<Index>(to.points.size());
    to.points.insert(to.points.end(), places.begin(), places.end());
    for (std::size_t i = places.size(); i < triangulation.points.size(); ++i)
    {
      to.points.push_back(placeOf(triangulation.points[i]));
    }
    for (const auto& [a, b, c] : triangulation.triangles)
    {
      to.triangles.push_back({base + a, base + b, base + c});
      const Vec2 middle = (triangulation.points[a] + triangulation.points[b] + triangulation.points[c]) / 3.0;
      const double area = areaOf({triangulation.points[a], triangulation.points[b], triangulation.points[c]});
      const Index covering = choice.surfaceOf(coversAt(middle), area);
      to.surfaceIds.push_back(covering != noIndex ? covering : static_cast<Index>(to.names.size()) + prismSide.number);
    }
  }

  double bottom() const { return low; }
  double top() const { return high; }

private:
  struct Cover
  {
    std::array<Vec2, 3> triangle;
    Index source;
  };

  static double areaOf(const std::array<Vec2, 3>& triangle)
  {
    const Vec2 u = triangle[1] - triangle[0];
    const Vec2 v = triangle[2] - triangle[0];
    return 0.5 * std::abs(u[0] * v[1] - u[1] * v[0]);
  }

  Vec2 flat(const Vec3& p) const { return {prismSide.tangent().dot(p.head<2>()), p[2]}; }

  Vec3 placeOf(const Vec2& p) const
  {
    const Vec2 at = prismSide.offset * prismSide.normal + p[0] * prismSide.tangent();
    return {at[0], at[1], p[1]};
  }

  std::vector<Index> coversAt(const Vec2& p) const
  {
    std::vector<Index> sources;
    for (const auto& [triangle, source] : covers)
    {
      int signs[3];
      for (int i = 0; i < 3; ++i)
      {
        const Vec2 edge = triangle[(i + 1) % 3] - triangle[i];
        signs[i] = edge[0] * (p[1] - triangle[i][1]) - edge[1] * (p[0] - triangle[i][0]) > 0.0 ? 1 : -1;
      }
      if (signs[0] == signs[1] && signs[1] == signs[2])
      {
        sources.push_back(source);
      }
    }
    return sources;
  }

  PrismSide prismSide;
  double low;
  double high;
  std::vector<Vec3> places;
  std::vector<std::array<Index, 2>> segments;
  std::vector<Cover> covers;
};

void appendPolygon(TriangleSurface& to, const Polygon& polygon, Index surface)
{
  const auto base = static_cast<Index>(to.points.size());
  std::ranges::transform(polygon, std::back_inserter(to.points), &Corner::at);
  for (Index i = 2; i < polygon.size(); ++i)
  {
    to.triangles.push_back({base, base + i - 1, base + i});
    to.surfaceIds.push_back(surface);
  }
}

} // namespace

std::vector<SharedArea> cutToSides(TriangleSurface& surface, const PlacedPrism& domain, double reach, double tolerance)
{
  std::vector<Corner> corners(surface.points.size());
  std::ranges::transform(surface.points, corners.begin(),
                         [&](const Vec3& p) { return snapped({p}, domain, tolerance); });
  // All sides end at the same heights, so that they share their upright edges.
  double bottom = domain.bounds.min[2] - reach;
  double top = domain.bounds.max[2] + reach;
  std::vector<Side> sides;
  for (const PrismSide& side : domain.sides())
  {
    sides.emplace_back(side, bottom, top);
  }
  TriangleSurface out;
  out.names = surface.names;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const Polygon whole{corners[a], corners[b], corners[c]};
    Polygon polygon = whole;
    for (const PrismSide& side : domain.sides())
    {
      polygon = clipped(polygon, domain, side, tolerance);
    }
    if (polygon.size() < 3)
    {
      continue;
    }
    bool onSide = false;
    for (Side& side : sides)
    {
      side.draw(polygon);
      if (side.holds(polygon))
      {
        side.cover(whole, static_cast<Index>(t));
        onSide = true;
      }
    }
    if (!onSide)
    {
      appendPolygon(out, polygon, surface.surfaceIds[t]);
    }
  }
  for (const Side& side : sides)
  {
    bottom = std::min(bottom, side.bottom());
    top = std::max(top, side.top());
  }
  CoverChoice choice(surface);
  for (Side& side : sides)
  {
    side.append(out, bottom, top, choice);
  }
  std::vector<SharedArea> shared = choice.shared();
  surface = std::move(out);
  return shared;
}

} // namespace atria
