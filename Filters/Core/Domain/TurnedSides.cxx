// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/TurnedSides.h"

#include "Surface/Triangulation/PlanarTriangulation.h"

#include <algorithm>
#include <tuple>

namespace atria {

namespace {

using Polygon = std::vector<Vec3>;

double planeOf(const Box3& box, int direction)
{
  return isUpper(direction) ? box.max[axisOf(direction)] : box.min[axisOf(direction)];
}

void snap(std::vector<Vec3>& points, const Box3& domain, double tolerance)
{
  for (Vec3& p : points)
  {
    for (int direction = xMin; direction <= yMax; ++direction)
    {
      const double plane = planeOf(domain, direction);
      if (std::abs(p[axisOf(direction)] - plane) <= tolerance)
      {
        p[axisOf(direction)] = plane;
      }
    }
  }
}

/// Where the edge meets the plane; the same bits from both ends, so that neighbors stay connected.
Vec3 cutEdge(const Vec3& p, const Vec3& q, int axis, double plane)
{
  const bool ordered = std::tie(p[0], p[1], p[2]) < std::tie(q[0], q[1], q[2]);
  const Vec3& a = ordered ? p : q;
  const Vec3& b = ordered ? q : p;
  Vec3 at = a + (plane - a[axis]) / (b[axis] - a[axis]) * (b - a);
  at[axis] = plane;
  return at;
}

/// The part of a convex polygon on the inner side of a plane (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, const Box3& domain, int direction)
{
  const int axis = axisOf(direction);
  const double plane = planeOf(domain, direction);
  const double sign = isUpper(direction) ? 1.0 : -1.0;
  const auto beyond = [&](const Vec3& p) { return sign * (p[axis] - plane); };
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec3& p = polygon[i];
    const Vec3& q = polygon[(i + 1) % polygon.size()];
    if (beyond(p) <= 0.0)
    {
      out.push_back(p);
    }
    if ((beyond(p) < 0.0 && beyond(q) > 0.0) || (beyond(p) > 0.0 && beyond(q) < 0.0))
    {
      out.push_back(cutEdge(p, q, axis, plane));
    }
  }
  return out;
}

bool liesIn(const Polygon& polygon, int axis, double plane)
{
  return std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& p) { return p[axis] == plane; });
}

/// One side of the domain: the outline, what surfaces draw on it, and triangles of surfaces that lie in it.
class Side
{
public:
  Side(const Box3& box, int ofDirection, double reach)
      : direction(ofDirection), across(axisOf(ofDirection)), along(1 - axisOf(ofDirection)),
        plane(planeOf(box, ofDirection)), low(box.min[along], box.min[2] - reach),
        high(box.max[along], box.max[2] + reach)
  {
  }

  void draw(const Polygon& polygon)
  {
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Vec3& p = polygon[i];
      const Vec3& q = polygon[(i + 1) % polygon.size()];
      if (p[across] == plane && q[across] == plane)
      {
        const auto first = static_cast<Index>(points.size());
        points.push_back(flat(p));
        points.push_back(flat(q));
        segments.push_back({first, first + 1});
        for (const Vec3& r : {p, q})
        {
          low[1] = std::min(low[1], r[2]);
          high[1] = std::max(high[1], r[2]);
        }
      }
    }
  }

  bool holds(const Polygon& polygon) const { return liesIn(polygon, across, plane); }

  void cover(const Polygon& triangle, Index surface) { covers.push_back({triangle, surface}); }

  void append(TriangleSurface& to, double lowest, double highest)
  {
    const double bottom = std::min(low[1], lowest);
    const double top = std::max(high[1], highest);
    points.insert(points.begin(), {{low[0], bottom}, {high[0], bottom}, {high[0], top}, {low[0], top}});
    for (auto& segment : segments)
    {
      segment = {segment[0] + 4, segment[1] + 4};
    }
    const PlanarTriangulation flatSide = triangulatePlane(points, segments);
    const auto base = static_cast<Index>(to.points.size());
    for (const Vec2& p : flatSide.points)
    {
      Vec3 q;
      q[across] = plane;
      q[along] = p[0];
      q[2] = p[1];
      to.points.push_back(q);
    }
    // Counter-clockwise in (x, z) looks along +y, in (y, z) against +x.
    const bool outwards = (across == 0) == isUpper(direction);
    for (const auto& [a, b, c] : flatSide.triangles)
    {
      to.triangles.push_back({base + a, base + (outwards ? b : c), base + (outwards ? c : b)});
      const Vec2 middle = (flatSide.points[a] + flatSide.points[b] + flatSide.points[c]) / 3.0;
      to.surfaceIds.push_back(coveredBy(middle, static_cast<Index>(to.names.size()) + direction));
    }
  }

  double bottom() const { return low[1]; }
  double top() const { return high[1]; }

private:
  Vec2 flat(const Vec3& p) const { return {p[along], p[2]}; }

  Index coveredBy(const Vec2& p, Index otherwise) const
  {
    for (const auto& [triangle, surface] : covers)
    {
      int signs[3];
      for (int i = 0; i < 3; ++i)
      {
        const Vec2 a = flat(triangle[i]);
        const Vec2 edge = flat(triangle[(i + 1) % 3]) - a;
        signs[i] = edge[0] * (p[1] - a[1]) - edge[1] * (p[0] - a[0]) > 0.0 ? 1 : -1;
      }
      if (signs[0] == signs[1] && signs[1] == signs[2])
      {
        return surface;
      }
    }
    return otherwise;
  }

  int direction;
  int across;
  int along;
  double plane;
  Vec2 low;
  Vec2 high;
  std::vector<Vec2> points;
  std::vector<std::array<Index, 2>> segments;
  std::vector<std::pair<Polygon, Index>> covers;
};

void appendPolygon(TriangleSurface& to, const Polygon& polygon, Index surface)
{
  const auto base = static_cast<Index>(to.points.size());
  to.points.insert(to.points.end(), polygon.begin(), polygon.end());
  for (Index i = 2; i < polygon.size(); ++i)
  {
    to.triangles.push_back({base, base + i - 1, base + i});
    to.surfaceIds.push_back(surface);
  }
}

} // namespace

void cutToSides(TriangleSurface& surface, const Box3& domain, double reach, double tolerance)
{
  snap(surface.points, domain, tolerance);
  std::vector<Side> sides;
  for (int direction = xMin; direction <= yMax; ++direction)
  {
    sides.emplace_back(domain, direction, reach);
  }
  TriangleSurface out;
  out.names = surface.names;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    Polygon polygon{surface.points[a], surface.points[b], surface.points[c]};
    const Polygon whole = polygon;
    for (int direction = xMin; direction <= yMax; ++direction)
    {
      polygon = clipped(polygon, domain, direction);
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
        side.cover(whole, surface.surfaceIds[t]);
        onSide = true;
      }
    }
    if (!onSide)
    {
      appendPolygon(out, polygon, surface.surfaceIds[t]);
    }
  }
  // All sides end at the same heights, so that they share their upright edges.
  double bottom = domain.min[2];
  double top = domain.max[2];
  for (const Side& side : sides)
  {
    bottom = std::min(bottom, side.bottom());
    top = std::max(top, side.top());
  }
  for (Side& side : sides)
  {
    side.append(out, bottom, top);
  }
  surface = std::move(out);
}

} // namespace atria
