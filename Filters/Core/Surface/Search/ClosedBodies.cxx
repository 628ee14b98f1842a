// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Search/ClosedBodies.h"

#include "Support/UnionFind.h"
#include "Surface/Triangles/EachEdge.h"
#include "Surface/Triangles/Weld.h"
#include "Surface/Triangles/WoundSolids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace atria {

namespace {

/// Lattice units along the longest edge of the bounds. Products of two coordinates fit 64 bits.
constexpr double latticeUnits = 1 << 28;

/// Returns twice the area of the triangle a, b, p seen from above: positive if p is to the left of the way from a to b.
std::int64_t areaAbove(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p)
{
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/// True if p is to the left of the way from a to b seen from above. A point on the way counts as moved by very little
/// along x, and by even less along y, so that the triangles around an edge or a point agree.
bool isLeftOf(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p)
{
  const std::int64_t area = areaAbove(a, b, p);
  return area != 0 ? area > 0 : a[1] != b[1] ? a[1] > b[1] : b[0] > a[0];
}

/// Joins triangles at an edge: those of each surface that has an even number of them there, and all others.
void joinAtEdge(std::span<const SoupEdgeUse> uses, const TriangleSoup& soup, UnionFind& parts)
{
  if (uses.size() <= 2)
  {
    parts.join(uses.front().triangle, uses.back().triangle);
    return;
  }
  std::map<Index, std::vector<Index>> bySurface;
  for (const SoupEdgeUse& use : uses)
  {
    bySurface[soup.surfaceIds[use.triangle]].push_back(use.triangle);
  }
  Index other = noIndex;
  for (const auto& [surface, triangles] : bySurface)
  {
    const bool isEven = triangles.size() % 2 == 0;
    const Index with = isEven || other == noIndex ? triangles.front() : other;
    std::ranges::for_each(triangles, [&](Index triangle) { parts.join(with, triangle); });
    other = isEven ? other : with;
  }
}

/// Returns the solid of each triangle. Fronts are on the side that gives more triangles a solid.
std::vector<Index> solidsOf(const TriangleSoup& soup)
{
  std::vector<Vec3> points;
  std::ranges::transform(soup.points, std::back_inserter(points), [](const LatticePoint& p) { return toVector(p); });
  std::vector<Index> solids = findWoundSolids(points, soup.triangles, Front::outside);
  if (const auto without = std::ranges::count(solids, noIndex); 2 * without > std::ssize(solids))
  {
    std::vector<Index> turned = findWoundSolids(points, soup.triangles, Front::inside);
    return std::ranges::count(turned, noIndex) < without ? turned : solids;
  }
  return solids;
}

/// Returns the parts with an edge that an odd number of their triangles use.
std::set<Index> openParts(std::span<const SoupEdgeUse> uses, UnionFind& parts)
{
  std::set<Index> open;
  eachEdge(uses, [&](std::span<const SoupEdgeUse> edge) {
    std::vector<Index> roots;
    std::ranges::transform(edge, std::back_inserter(roots),
                           [&](const SoupEdgeUse& use) { return parts.find(use.triangle); });
    std::ranges::sort(roots);
    for (auto begin = roots.begin(); begin != roots.end();)
    {
      const auto end = std::ranges::upper_bound(begin, roots.end(), *begin);
      if ((end - begin) % 2 != 0)
      {
        open.insert(*begin);
      }
      begin = end;
    }
  });
  return open;
}

} // namespace

ClosedBodies::ClosedBodies(const TriangleSurface& surface, const std::function<bool(Index)>& wants, double weldDistance,
                           const RunContext& context)
{
  weld(surface, wants, weldDistance);
  context.progress.check();
  findBodies(context);
}

LatticePoint ClosedBodies::latticeOf(const Vec3& point) const
{
  LatticePoint p;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Far places count the same as places just beyond the bounds.
    const double at = std::clamp((point[axis] - origin_[axis]) / unit_, -latticeUnits, 2.0 * latticeUnits);
    p[axis] = std::llround(at);
  }
  return p;
}

/// Makes the soup. Merges points, and drops repeated triangles.
void ClosedBodies::weld(const TriangleSurface& surface, const std::function<bool(Index)>& wants, double weldDistance)
{
  Box3 bounds;
  std::ranges::for_each(surface.points, [&](const Vec3& p) { bounds.extend(p); });
  if (bounds.empty() || !bounds.min.allFinite() || !bounds.max.allFinite())
  {
    return;
  }
  origin_ = bounds.min;
  unit_ = std::max(bounds.size().maxCoeff() / latticeUnits, std::numeric_limits<double>::min());
  std::ranges::transform(surface.points, std::back_inserter(soup_.points), [&](const Vec3& p) { return latticeOf(p); });
  const auto distance = std::max<std::int64_t>(1, std::llround(weldDistance / unit_));
  const std::vector<Index> first = weldPoints(soup_.points, distance);
  struct Wound
  {
    std::array<Index, 3> corners; ///< from the first one on, as they are wound
    Index surface;
    Index triangle;
  };
  std::vector<Wound> all;
  for (Index t = 0; t < surface.triangles.size(); ++t)
  {
    std::array<Index, 3> triangle = surface.triangles[t];
    std::ranges::transform(triangle, triangle.begin(), [&](Index p) { return first[p]; });
    if (!hasRepeatedPoint(triangle) && wants(t))
    {
      std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
      all.push_back({triangle, surface.surfaceIds[t], t});
    }
  }
  std::ranges::sort(all, [](const Wound& l, const Wound& r) {
    return std::tie(l.corners, l.surface, l.triangle) < std::tie(r.corners, r.surface, r.triangle);
  });
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (i == 0 || all[i].corners != all[i - 1].corners || all[i].surface != all[i - 1].surface)
    {
      soup_.add(all[i].corners, all[i].surface, all[i].triangle);
    }
  }
}

void ClosedBodies::add(Index triangle, DrawnBody& body)
{
  const auto& [a, b, c] = soup_.triangles[triangle];
  const LatticeBox box = boundsOf(soup_.points[a], soup_.points[b], soup_.points[c]);
  if (body.triangles.empty())
  {
    body.bounds = box;
    body.surface = soup_.surfaceIds[triangle];
  }
  body.bounds.extend(box);
  body.triangles.push_back(triangle);
}

double ClosedBodies::volumeOf(const DrawnBody& body) const
{
  const LatticePoint& origin = soup_.corner(body.triangles.front(), 0);
  double volume = 0.0;
  for (const Index t : body.triangles)
  {
    const Vec3 a = between(origin, soup_.corner(t, 0));
    volume += a.dot(between(origin, soup_.corner(t, 1)).cross(between(origin, soup_.corner(t, 2)))) / 6.0;
  }
  return volume * std::pow(unit_, 3);
}

void ClosedBodies::findBodies(const RunContext& context)
{
  const auto count = static_cast<Index>(soup_.triangles.size());
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup_, context.executor);
  UnionFind parts(count);
  const std::vector<Index> solids = solidsOf(soup_);
  for (Index t = 0; t < count; ++t)
  {
    parts.join(t, solids[t] == noIndex ? t : solids[t]);
  }
  std::vector<SoupEdgeUse> others;
  eachEdge(uses, [&](std::span<const SoupEdgeUse> edge) {
    others.clear();
    std::ranges::copy_if(edge, std::back_inserter(others),
                         [&](const SoupEdgeUse& use) { return solids[use.triangle] == noIndex; });
    if (!others.empty())
    {
      joinAtEdge(others, soup_, parts);
    }
  });
  const std::set<Index> isOpen = openParts(uses, parts);
  bodyOf_.assign(count, noIndex);
  std::vector<Index> openOf(count, noIndex);
  std::vector<NumberedBox> boxes;
  for (Index t = 0; t < count; ++t)
  {
    const Index root = parts.find(t); // the first of its part
    const bool isClosed = !isOpen.contains(root);
    std::vector<DrawnBody>& bodies = isClosed ? bodies_ : open_;
    std::vector<Index>& numbers = isClosed ? bodyOf_ : openOf;
    if (root == t)
    {
      numbers[t] = static_cast<Index>(bodies.size());
      bodies.emplace_back();
    }
    numbers[t] = numbers[root];
    add(t, bodies[numbers[t]]);
    if (isClosed)
    {
      boxes.push_back({boundsOf(soup_.corner(t, 0), soup_.corner(t, 1), soup_.corner(t, 2)), t});
    }
  }
  std::ranges::for_each(bodies_, [&](DrawnBody& body) { body.volume = volumeOf(body); });
  if (!boxes.empty())
  {
    tree_ = std::make_unique<BoxTree>(std::move(boxes), context);
  }
}

std::array<Vec3, 3> ClosedBodies::corners(Index triangle) const
{
  return {toModel(soup_.corner(triangle, 0)), toModel(soup_.corner(triangle, 1)), toModel(soup_.corner(triangle, 2))};
}

bool ClosedBodies::isBelow(const LatticePoint& p, const std::array<Index, 3>& triangle) const
{
  const auto& [a, b, c] = triangle;
  const std::vector<LatticePoint>& points = soup_.points;
  const bool isLeft = isLeftOf(points[a], points[b], p);
  if (isLeftOf(points[b], points[c], p) != isLeft || isLeftOf(points[c], points[a], p) != isLeft)
  {
    return false;
  }
  const Vec3 normal = between(points[a], points[b]).cross(between(points[a], points[c]));
  const double above = normal.dot(between(points[a], p));
  return normal[2] > 0.0 ? above < 0.0 : above > 0.0;
}

std::vector<ClosedBodies::Crossing> ClosedBodies::crossings(double x, double y, double top) const
{
  std::vector<Crossing> found;
  if (!tree_)
  {
    return found;
  }
  const LatticePoint high = latticeOf({x, y, top});
  const LatticePoint start{high[0], high[1], -1}; // below all triangles
  tree_->eachTouching({start, {high[0], high[1], high[2] + 1}}, 0, [&](std::size_t place) {
    const Index triangle = tree_->box(place).id;
    if (isBelow(start, soup_.triangles[triangle]))
    {
      const auto [a, b, c] = corners(triangle);
      const Vec3 normal = (b - a).cross(c - a);
      const double rise = normal[0] * (x - a[0]) + normal[1] * (y - a[1]);
      found.push_back({std::clamp(a[2] - rise / normal[2], std::min({a[2], b[2], c[2]}), std::max({a[2], b[2], c[2]})),
                       bodyOf_[triangle]});
    }
  });
  std::ranges::sort(found, {}, [](const Crossing& crossing) { return std::pair(crossing.height, crossing.body); });
  return found;
}

std::vector<Index> ClosedBodies::aroundLattice(const LatticePoint& p) const
{
  std::vector<Index> crossed;
  if (tree_)
  {
    const LatticePoint top{p[0], p[1], std::numeric_limits<std::int32_t>::max()};
    tree_->eachTouching({p, top}, 0, [&](std::size_t place) {
      const Index triangle = tree_->box(place).id;
      if (isBelow(p, soup_.triangles[triangle]))
      {
        crossed.push_back(bodyOf_[triangle]);
      }
    });
  }
  std::ranges::sort(crossed);
  std::vector<Index> around;
  for (auto begin = crossed.begin(); begin != crossed.end();)
  {
    const auto end = std::ranges::upper_bound(begin, crossed.end(), *begin);
    if ((end - begin) % 2 != 0)
    {
      around.push_back(*begin);
    }
    begin = end;
  }
  std::ranges::stable_sort(around, std::ranges::greater{}, [&](Index body) { return std::abs(bodies_[body].volume); });
  return around;
}

bool ClosedBodies::isInside(Index inner, Index outer) const
{
  constexpr std::size_t most = 64; // points that are tested
  const LatticeBox& in = bodies_[inner].bounds;
  const LatticeBox& out = bodies_[outer].bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (in.low[axis] <= out.low[axis] || in.high[axis] >= out.high[axis])
    {
      return false;
    }
  }
  const std::vector<Index>& triangles = bodies_[inner].triangles;
  const std::size_t step = (triangles.size() + most - 1) / most;
  for (std::size_t i = 0; i < triangles.size(); i += step)
  {
    const std::vector<Index> around = aroundLattice(soup_.corner(triangles[i], 0));
    if (std::ranges::find(around, outer) == around.end())
    {
      return false;
    }
  }
  return true;
}

} // namespace atria
