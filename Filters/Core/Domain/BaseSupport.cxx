// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/BaseSupport.h"

#include <algorithm>
#include <array>

namespace atria {

namespace {

std::vector<Index> bodiesOfPlaces(const TriangleSurface& surface, const ModelBodies& bodies)
{
  std::vector<Index> bodyOf(surface.points.size(), noIndex);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (const Index p : surface.triangles[t])
    {
      Index& body = bodyOf[bodies.placeOf[p]];
      body = bodies.ofTriangle[t] == noIndex ? body : bodies.ofTriangle[t];
    }
  }
  return bodyOf;
}

std::vector<Box3> placesOfBodies(const TriangleSurface& surface, const std::vector<Index>& bodyOf)
{
  std::vector<Box3> boxes(bodyOf.size());
  for (std::size_t place = 0; place < bodyOf.size(); ++place)
  {
    if (bodyOf[place] != noIndex)
    {
      boxes[place].extend(surface.points[place]);
    }
  }
  return boxes;
}

/// Returns true if p is more than `margin` inside of all sides.
bool isInside(const std::vector<Vec2>& corners, const Vec2& p, double margin)
{
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vec2 along = corners[(i + 1) % corners.size()] - corners[i];
    const Vec2 to = p - corners[i];
    if (along[0] * to[1] - along[1] * to[0] <= margin * along.norm())
    {
      return false;
    }
  }
  return corners.size() > 2;
}

} // namespace

double GroundBelow::heightAt(const Vec3& p) const
{
  const double level = floor.value_or(-std::numeric_limits<double>::infinity());
  return useSurface ? std::max(surface.heightAt(p[0], p[1]), level) : level;
}

SupportSearch::SupportSearch(const TriangleSurface& model, const ModelBodies& modelBodies, const PlumbLines& plumbLines,
                             const std::vector<BodyBase>& bodyBases, double touching, double equal)
    : surface(model), bodies(modelBodies), lines(plumbLines), bases(bodyBases), reach(touching), tolerance(equal),
      bodyBins(bodies.boxes), bodyOfPlace(bodiesOfPlaces(model, bodies)), placeBins(placesOfBodies(model, bodyOfPlace)),
      baseOfTriangle(model.triangles.size(), noIndex)
{
  for (Index base = 0; base < bases.size(); ++base)
  {
    for (const Index t : bases[base].triangles)
    {
      baseOfTriangle[t] = base;
    }
  }
}

bool SupportSearch::isBesideOther(Index body, double low, double ground) const
{
  const Vec3 margin = Vec3::Constant(reach);
  const Box3 box{bodies.boxes[body].min - margin, bodies.boxes[body].max + margin};
  bool found = false;
  bodyBins.eachNear(box.min, box.max, [&](Index other) {
    const Box3& b = bodies.boxes[other];
    found = found || (other != body && b.touches(box) && b.min[2] <= low + tolerance && b.max[2] > ground + tolerance);
  });
  return found;
}

BaseSupport SupportSearch::find(Index number, double ground) const
{
  const BodyBase& base = bases[number];
  Box3 below;
  for (const Index place : base.places)
  {
    below.extend(surface.points[place]);
  }
  bool mayBeOver = false;
  bodyBins.eachNear(below.min, below.max, [&](Index other) {
    const Box3& b = bodies.boxes[other];
    const bool overlaps =
        b.min[0] <= below.max[0] && b.max[0] >= below.min[0] && b.min[1] <= below.max[1] && b.max[1] >= below.min[1];
    mayBeOver = mayBeOver || (overlaps && mayHold(other, base, ground));
  });
  if (mayBeOver && (hasBodyBelow(base, ground) || hasPointsBelow(number, ground)))
  {
    return BaseSupport::below;
  }
  const bool isLowest = base.low <= bodies.boxes[base.body].min[2] + tolerance;
  return !isLowest || isBesideOther(base.body, base.low, ground) ? BaseSupport::beside : BaseSupport::none;
}

/// Returns true if the other body may hold the base up. Cellars, which end at the ground, hold nothing up.
bool SupportSearch::mayHold(Index other, const BodyBase& base, double ground) const
{
  return other != base.body && bodies.boxes[other].min[2] < base.low - tolerance &&
         bodies.boxes[other].max[2] > ground + tolerance;
}

bool SupportSearch::hasBodyBelow(const BodyBase& base, double ground) const
{
  constexpr double leastPart = 0.05; // a part of the base's area
  std::vector<PlumbHit> hits;
  // The shell of a room, for example, is within that of its house.
  const auto isWithinOther = [&](const Vec3& p) {
    return std::ranges::any_of(hits, [&](const PlumbHit& one) {
      const Index other = bodies.ofTriangle[one.triangle];
      const auto count = [&](bool isAbove) {
        return std::ranges::count_if(hits, [&](const PlumbHit& hit) {
          return bodies.ofTriangle[hit.triangle] == other && (hit.height > p[2] + tolerance) == isAbove;
        });
      };
      return mayHold(other, base, ground) && count(true) % 2 == 1 && count(false) % 2 == 1;
    });
  };
  const auto isOver = [&](const Vec3& p) {
    lines.find(p[0], p[1], hits);
    return isWithinOther(p) || std::ranges::any_of(hits, [&](const PlumbHit& hit) {
             return hit.height > ground + tolerance && hit.height <= p[2] + tolerance &&
                    mayHold(bodies.ofTriangle[hit.triangle], base, ground);
           });
  };
  double all = 0.0;
  double over = 0.0;
  for (const Index t : base.triangles)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec2 u = (surface.points[b] - surface.points[a]).head<2>();
    const Vec2 v = (surface.points[c] - surface.points[a]).head<2>();
    const double area = std::abs(u[0] * v[1] - u[1] * v[0]);
    all += area;
    over += isOver((surface.points[a] + surface.points[b] + surface.points[c]) / 3.0) ? area : 0.0;
  }
  const Vec2& middle = base.outline.middle;
  return base.triangles.empty() ? isOver({middle[0], middle[1], base.low}) : over > leastPart * all;
}

bool SupportSearch::hasPointsBelow(Index number, double ground) const
{
  const BodyBase& base = bases[number];
  Box3 box;
  for (const Vec2& corner : base.outline.corners)
  {
    box.extend({corner[0], corner[1], 0.0});
  }
  bool found = false;
  placeBins.eachNear(box.min, box.max, [&](Index place) {
    const Vec3& p = surface.points[place];
    found = found || (p[2] < base.low - tolerance && bodyOfPlace[place] != base.body &&
                      mayHold(bodyOfPlace[place], base, ground) && isWithin(number, p));
  });
  return found;
}

/// Returns true if p is under the base, but not at its border, where neighbors stand.
bool SupportSearch::isWithin(Index number, const Vec3& p) const
{
  const double margin = std::max(10.0 * tolerance, reach);
  if (bases[number].triangles.empty())
  {
    return isInside(bases[number].outline.corners, p.head<2>(), margin);
  }
  std::vector<PlumbHit> hits;
  const auto isBelow = [&](double x, double y) {
    lines.find(p[0] + x, p[1] + y, hits);
    return std::ranges::any_of(hits, [&](const PlumbHit& hit) { return baseOfTriangle[hit.triangle] == number; });
  };
  return isBelow(margin, 0.0) && isBelow(-margin, 0.0) && isBelow(0.0, margin) && isBelow(0.0, -margin);
}

} // namespace atria
