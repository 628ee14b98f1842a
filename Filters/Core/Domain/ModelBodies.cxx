// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/ModelBodies.h"

#include "Support/Sorting.h"
#include "Support/UnionFind.h"
#include "Surface/Triangles/PointPlaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace atria {

namespace {

/// Cosine of the slope up to which faces are a bottom: some 25 degrees. On a ball or a lying cylinder such faces cover
/// less than half of the outline.
constexpr double levelCosine = 0.9;
/// Cosine of the slope from which on faces are walls: some 63 degrees.
constexpr double uprightCosine = 0.45;
/// The part of a body's height, from below, in which it may have bases.
constexpr double lowerPart = 0.5;

/// Returns twice the triangle's area vector.
Vec3 areaOf(const TriangleSurface& surface, std::size_t triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  return (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]);
}

double cross(const Vec2& o, const Vec2& a, const Vec2& b)
{
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/// Returns the hull counterclockwise (Andrew 1979).
std::vector<Vec2> convexHull(std::vector<Vec2> points)
{
  const auto less = [](const Vec2& l, const Vec2& r) { return std::pair(l[0], l[1]) < std::pair(r[0], r[1]); };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end(), [](const Vec2& l, const Vec2& r) { return l == r; }),
               points.end());
  if (points.size() < 3)
  {
    return points;
  }
  std::vector<Vec2> hull;
  const auto addAll = [&](auto begin, auto end) {
    const std::size_t least = hull.size() + 1;
    for (auto p = begin; p != end; ++p)
    {
      while (hull.size() > least && cross(hull[hull.size() - 2], hull.back(), *p) <= 0.0)
      {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  addAll(points.begin(), points.end());
  addAll(points.rbegin(), points.rend());
  return hull;
}

} // namespace

ModelBodies findBodies(const TriangleSurface& surface, const SurfaceFlags& leftOut)
{
  ModelBodies out;
  Box3 bounds;
  std::for_each(surface.points.begin(), surface.points.end(), [&](const Vec3& p) { bounds.extend(p); });
  if (bounds.empty())
  {
    return out;
  }
  out.placeOf = placesOf(surface.points, placeStep(bounds));
  UnionFind sets(surface.points.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (!leftOut[surface.surfaceIds[t]])
    {
      const auto& [a, b, c] = surface.triangles[t];
      sets.join(out.placeOf[a], out.placeOf[b]);
      sets.join(out.placeOf[a], out.placeOf[c]);
    }
  }
  std::vector<Index> bodyOf(surface.points.size(), noIndex);
  out.ofTriangle.assign(surface.triangles.size(), noIndex);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (leftOut[surface.surfaceIds[t]])
    {
      continue;
    }
    Index& body = bodyOf[sets.find(out.placeOf[surface.triangles[t][0]])];
    if (body == noIndex)
    {
      body = static_cast<Index>(out.boxes.size());
      out.boxes.emplace_back();
    }
    out.ofTriangle[t] = body;
    for (const Index p : surface.triangles[t])
    {
      out.boxes[body].extend(surface.points[p]);
    }
  }
  return out;
}

std::vector<FreeEdge> findFreeEdges(const TriangleSurface& surface, const ModelBodies& bodies)
{
  std::vector<FreeEdge> uses;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (int i = 0; i < 3 && bodies.ofTriangle[t] != noIndex; ++i)
    {
      const Index a = bodies.placeOf[surface.triangles[t][i]];
      const Index b = bodies.placeOf[surface.triangles[t][(i + 1) % 3]];
      if (a != b)
      {
        uses.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t)});
      }
    }
  }
  std::ranges::sort(uses, [](const FreeEdge& l, const FreeEdge& r) {
    return std::tie(l.a, l.b, l.triangle) < std::tie(r.a, r.b, r.triangle);
  });
  std::vector<FreeEdge> free;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    for (end = begin + 1; end < uses.size() && uses[end].a == uses[begin].a && uses[end].b == uses[begin].b; ++end)
    {
    }
    if (end == begin + 1)
    {
      free.push_back(uses[begin]);
    }
  }
  return free;
}

Outline2 hullOf(std::vector<Vec2> points)
{
  const std::vector<Vec2> hull = convexHull(std::move(points));
  Outline2 out;
  if (hull.empty())
  {
    return out;
  }
  for (std::size_t i = 0; i < hull.size(); ++i)
  {
    out.middle += hull[i] / static_cast<double>(hull.size());
    out.area += 0.5 * cross(hull[0], hull[i], hull[(i + 1) % hull.size()]);
  }
  out.corners = hull;
  if (hull.size() < 3)
  {
    return out;
  }
  out.width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, far = 1; i < hull.size(); ++i)
  {
    const Vec2& a = hull[i];
    const Vec2& b = hull[(i + 1) % hull.size()];
    while (cross(a, b, hull[(far + 1) % hull.size()]) > cross(a, b, hull[far]))
    {
      far = (far + 1) % hull.size();
    }
    out.width = std::min(out.width, cross(a, b, hull[far]) / (b - a).norm());
  }
  return out;
}

namespace {

class BaseSearch
{
public:
  BaseSearch(const TriangleSurface& model, const ModelBodies& modelBodies, const PlumbLines& plumbLines, double size,
             double equal)
      : surface(model), bodies(modelBodies), lines(plumbLines), leastSize(size), tolerance(equal),
        sets(model.points.size())
  {
  }

  BodyBases run()
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      if (bodies.ofTriangle[t] != noIndex && bodies.boxes[bodies.ofTriangle[t]].size().norm() >= leastSize)
      {
        look(static_cast<Index>(t));
      }
    }
    for (const FreeEdge& edge : findFreeEdges(surface, bodies))
    {
      lookAtRim(edge);
    }
    collect();
    return std::move(out);
  }

private:
  const Vec3& at(Index place) const { return surface.points[place]; }

  bool isLow(double height, Index body) const
  {
    const Box3& box = bodies.boxes[body];
    return height <= box.min[2] + lowerPart * box.size()[2] + tolerance;
  }

  void join(Index a, Index b, Index triangle)
  {
    sets.join(a, b);
    isBase.resize(surface.points.size(), 0);
    isBase[a] = isBase[b] = 1;
    elements.push_back({a, triangle});
  }

  void look(Index t)
  {
    const Vec3 area = areaOf(surface, t);
    const auto& [ia, ib, ic] = surface.triangles[t];
    const Vec3 center = (surface.points[ia] + surface.points[ib] + surface.points[ic]) / 3.0;
    const Index body = bodies.ofTriangle[t];
    if (std::abs(area[2]) < levelCosine * area.norm() || !(area.norm() > 0.0) || !isLow(center[2], body))
    {
      return;
    }
    lines.find(center[0], center[1], hits);
    bool ownBelow = false;
    bool ownAbove = false;
    double top = center[2];
    for (const PlumbHit& hit : hits)
    {
      const bool isOwn = bodies.ofTriangle[hit.triangle] == body;
      ownBelow = ownBelow || (isOwn && hit.height < center[2] - tolerance);
      ownAbove = ownAbove || (isOwn && hit.height > center[2] + tolerance);
      top = isOwn ? std::max(top, hit.height) : top;
    }
    const bool isLowest = hits.empty() || hits.front().height >= center[2] - tolerance;
    if (isLowest)
    {
      const double low = std::min({surface.points[ia][2], surface.points[ib][2], surface.points[ic][2]});
      out.lowest.push_back({low, 0.5 * std::abs(area[2]), hits.empty() ? 0.0 : hits.back().height - center[2]});
    }
    if (ownAbove && !ownBelow)
    {
      topOf[t] = top;
      bottoms.push_back({t, isLowest ? static_cast<Index>(out.lowest.size() - 1) : noIndex});
      join(bodies.placeOf[ia], bodies.placeOf[ib], t);
      join(bodies.placeOf[ia], bodies.placeOf[ic], t);
    }
  }

  /// Adds the lower end of a wall if it slopes less than the wall itself.
  void lookAtRim(const FreeEdge& edge)
  {
    const Index body = bodies.ofTriangle[edge.triangle];
    const Vec3 along = at(edge.b) - at(edge.a);
    const double high = std::max(at(edge.a)[2], at(edge.b)[2]);
    const Vec3 area = areaOf(surface, edge.triangle);
    const bool isUpright = std::abs(area[2]) <= uprightCosine * area.norm();
    if (!isUpright || bodies.boxes[body].size().norm() < leastSize || !isLow(high, body) ||
        std::abs(along[2]) > along.head<2>().norm())
    {
      return;
    }
    for (const Index p : surface.triangles[edge.triangle])
    {
      const Index place = bodies.placeOf[p];
      if (place != edge.a && place != edge.b && at(place)[2] <= high + tolerance)
      {
        return;
      }
    }
    const Vec3 middle = 0.5 * (at(edge.a) + at(edge.b)) - Vec3(0.0, 0.0, 2.0 * tolerance);
    bool isAboveWall = false;
    lines.eachUprightBelow(middle, bodies.boxes[body].min[2] - tolerance, 0.5 * tolerance,
                           [&](Index other) { isAboveWall = isAboveWall || bodies.ofTriangle[other] == body; });
    if (!isAboveWall)
    {
      join(edge.a, edge.b, edge.triangle);
    }
  }

  void collect()
  {
    std::map<Index, Index> numbers; // base number per set
    std::vector<std::map<Index, double>> areas;
    for (const auto& [place, triangle] : elements)
    {
      const auto [found, isNew] = numbers.try_emplace(sets.find(place), static_cast<Index>(out.bases.size()));
      if (isNew)
      {
        out.bases.emplace_back().body = bodies.ofTriangle[triangle];
        areas.emplace_back();
      }
      areas[found->second][surface.surfaceIds[triangle]] += areaOf(surface, triangle).norm();
    }
    for (const auto& [t, lowest] : bottoms)
    {
      const Index number = numbers[sets.find(bodies.placeOf[surface.triangles[t][0]])];
      BodyBase& base = out.bases[number];
      if (lowest != noIndex)
      {
        out.lowest[lowest].base = number;
      }
      base.top = base.triangles.empty() ? topOf[t] : std::max(base.top, topOf[t]);
      base.triangles.push_back(t);
    }
    for (Index place = 0; place < isBase.size(); ++place)
    {
      if (isBase[place])
      {
        out.bases[numbers[sets.find(place)]].places.push_back(place);
      }
    }
    for (std::size_t i = 0; i < out.bases.size(); ++i)
    {
      measure(static_cast<Index>(i));
      out.bases[i].surface =
          std::ranges::max_element(areas[i], {}, [](const auto& entry) { return entry.second; })->first;
    }
  }

  void measure(Index number)
  {
    BodyBase& base = out.bases[number];
    std::vector<Vec2> points;
    base.low = std::numeric_limits<double>::infinity();
    base.high = -base.low;
    for (const Index place : base.places)
    {
      points.emplace_back(at(place).head<2>());
      base.lowest = at(place)[2] < base.low ? at(place) : base.lowest;
      base.low = std::min(base.low, at(place)[2]);
      base.high = std::max(base.high, at(place)[2]);
    }
    base.outline = hullOf(std::move(points));
    if (!base.triangles.empty())
    {
      return;
    }
    base.top = bodies.boxes[base.body].max[2];
    lines.find(base.outline.middle[0], base.outline.middle[1], hits);
    if (hits.empty() || hits.front().height >= base.low - tolerance)
    {
      out.lowest.push_back({base.low, base.outline.area, base.top - base.low, number});
    }
  }

  struct Element
  {
    Index place;
    Index triangle;
  };
  struct Bottom
  {
    Index triangle;
    Index lowest; ///< its place among the lowest faces, if it is one
  };

  const TriangleSurface& surface;
  const ModelBodies& bodies;
  const PlumbLines& lines;
  double leastSize;
  double tolerance;
  UnionFind sets;
  std::vector<char> isBase; ///< one entry per place
  std::vector<Element> elements;
  std::vector<Bottom> bottoms;
  std::map<Index, double> topOf;
  std::vector<PlumbHit> hits;
  BodyBases out;
};

} // namespace

BodyBases findBases(const TriangleSurface& surface, const ModelBodies& bodies, const PlumbLines& lines,
                    double leastSize, double tolerance)
{
  return BaseSearch(surface, bodies, lines, leastSize, tolerance).run();
}

} // namespace atria
