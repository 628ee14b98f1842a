// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Clearance.h"

#include "Octree/Tree/GeometryLists.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>

namespace atria {

namespace {

using Corners = std::array<Vec3, 3>;

Corners cornersOf(Index triangle, const SurfaceModel& model, const GridFrame& frame)
{
  return {frame.toModel(model.corner(triangle, 0)), frame.toModel(model.corner(triangle, 1)),
          frame.toModel(model.corner(triangle, 2))};
}

/// A plane with two directions in it.
struct Plane
{
  Plane(const Vec3& point, const Vec3& across) : origin(point), normal(across.stableNormalized())
  {
    u = normal.unitOrthogonal();
    v = normal.cross(u);
  }
  bool isNone() const { return normal.squaredNorm() < 0.5; }

  Vec3 origin;
  Vec3 normal;
  Vec3 u;
  Vec3 v;
};

/// The surfaces around a place.
class Surroundings
{
public:
  Surroundings(const Vec3& place, double reach, const Octree& octree, const SurfaceModel& surfaces)
      : model(surfaces), frame(octree.frame())
  {
    triangles = trianglesNear(
        octree, {frame.toLattice(place - Vec3::Constant(reach)), frame.toLattice(place + Vec3::Constant(reach))});
    std::erase_if(triangles, [&](Index triangle) { return model.isPermeable(triangle); });
    for (const Index triangle : triangles)
    {
      corners.push_back(cornersOf(triangle, model, frame));
    }
  }

  double clearance(const Vec3& p) const
  {
    double least = p[2] - frame.domain.min[2];
    for (const Corners& c : corners)
    {
      least = std::min(least, (nearestOnTriangle(p, c[0], c[1], c[2]) - p).norm());
    }
    return least;
  }

  /// Returns the planes in which a gap at p may lie if the way through it runs along `along`: those of triangles that
  /// end where they are nearest to p, and those through the nearest point that the way crosses.
  std::vector<Plane> planesOfGap(const Vec3& p, const Vec3& along) const
  {
    Vec3 nearest(p[0], p[1], frame.domain.min[2]);
    for (const Corners& c : corners)
    {
      const Vec3 candidate = nearestOnTriangle(p, c[0], c[1], c[2]);
      nearest = (candidate - p).norm() < (nearest - p).norm() ? candidate : nearest;
    }
    const Vec3 towards = (nearest - p).stableNormalized();
    std::vector<Plane> planes;
    const auto add = [&](const Vec3& across) {
      const Plane plane(nearest, across);
      const bool known = std::any_of(planes.begin(), planes.end(), [&](const Plane& other) {
        return std::abs(other.normal.dot(plane.normal)) > 1.0 - 1e-9;
      });
      if (!known && !plane.isNone())
      {
        planes.push_back(plane);
      }
    };
    add(along);
    add(along - towards * towards.dot(along));
    for (const Corners& c : corners)
    {
      for (int i = 0; i < 3; ++i)
      {
        if ((nearestOnSegment(p, c[i], c[(i + 1) % 3]) - nearest).norm() <= latticeRounding * frame.latticeUnit())
        {
          add((c[1] - c[0]).cross(c[2] - c[0]));
          add(towards.cross(c[(i + 1) % 3] - c[i]));
        }
      }
    }
    return planes;
  }

  /// Returns the surfaces within `reach` of p, nearest first, each once.
  std::vector<Index> within(const Vec3& p, double reach) const
  {
    std::vector<std::pair<double, Index>> found;
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      const Corners& c = corners[i];
      const double distance = (nearestOnTriangle(p, c[0], c[1], c[2]) - p).norm();
      if (distance <= reach)
      {
        found.emplace_back(distance, model.surfaceIds[triangles[i]]);
      }
    }
    const double height = p[2] - frame.domain.min[2];
    const bool named = std::any_of(found.begin(), found.end(),
                                   [&](const auto& f) { return std::abs(f.first - height) <= frame.latticeUnit(); });
    if (height <= reach && !named)
    {
      found.emplace_back(height, noIndex);
    }
    std::sort(found.begin(), found.end());
    std::vector<Index> surfaces;
    for (const auto& [distance, surface] : found)
    {
      if (std::find(surfaces.begin(), surfaces.end(), surface) == surfaces.end())
      {
        surfaces.push_back(surface);
      }
    }
    return surfaces;
  }

private:
  const SurfaceModel& model;
  const GridFrame& frame;
  std::vector<Index> triangles;
  std::vector<Corners> corners;
};

struct Ball
{
  Vec3 center;
  double radius;
};

/// Climbs in a plane from the point nearest to `place` to where surfaces are farthest. The ball is infinite if that
/// leads farther than `reach`: the plane is not that of a gap then.
Ball largestBall(const Surroundings& about, const Vec3& place, const Plane& plane, double size, double reach)
{
  const Vec3 start = place - plane.normal * plane.normal.dot(place - plane.origin);
  Ball ball{start, about.clearance(start)};
  for (double step = 0.5 * size; step > coincidentRatio * size;)
  {
    bool moved = false;
    for (int i = 0; i < 8; ++i)
    {
      const double angle = 0.25 * std::numbers::pi * i;
      const Vec3 candidate = ball.center + step * (std::cos(angle) * plane.u + std::sin(angle) * plane.v);
      const double there = about.clearance(candidate);
      if (there > ball.radius)
      {
        if ((candidate - start).norm() > reach)
        {
          return {place, std::numeric_limits<double>::infinity()};
        }
        ball = {candidate, there};
        moved = true;
      }
    }
    step = moved ? step : 0.5 * step;
  }
  return ball;
}

/// Returns the largest ball in the gap around a place: in the plane with least room, but with enough room for the place
/// itself.
Ball gapAt(const Surroundings& about, const Vec3& place, const Vec3& along, double size, double reach)
{
  // A smaller ball is in a crevice beside the place, not in its gap.
  constexpr double leastPart = 0.7;
  const double here = about.clearance(place);
  Ball least{place, std::numeric_limits<double>::infinity()};
  for (const Plane& plane : about.planesOfGap(place, along))
  {
    const Ball ball = largestBall(about, place, plane, size, reach);
    least = ball.radius < least.radius && ball.radius >= leastPart * here ? ball : least;
  }
  return least;
}

} // namespace

Clearance::Clearance(std::int32_t zone, const Zones& zones, const Crossings& crossings, const GridPlaces& places,
                     const SurfaceModel& surfaces, const RunContext& context)
    : grid(places), octree(places.octree()), points(places.points()), model(surfaces), nearest(points.size(), noIndex),
      distances(points.size(), std::numeric_limits<double>::infinity())
{
  context.executor.forRanges(points.size(), 4096, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    std::vector<Index> triangles;
    for (std::size_t point = begin; point < end; ++point)
    {
      if (zones.ofPoint[point] != zone)
      {
        continue;
      }
      triangles.clear();
      collect(static_cast<Index>(point), triangles);
      const Vec3 p = position(static_cast<Index>(point));
      for (const Index triangle : triangles)
      {
        const double distance = distanceTo(triangle, p);
        if (distance < distances[point])
        {
          distances[point] = distance;
          nearest[point] = triangle;
        }
      }
    }
  });
  std::vector<Index> seeds;
  for (Index point = 0; point < points.size(); ++point)
  {
    if (nearest[point] != noIndex)
    {
      seeds.push_back(point);
    }
  }
  spread(seeds, crossings);
}

Vec3 Clearance::position(Index point) const { return octree.frame().toModel(grid.place(point)); }

double Clearance::distanceTo(Index triangle, const Vec3& p) const
{
  const Corners c = cornersOf(triangle, model, octree.frame());
  return (nearestOnTriangle(p, c[0], c[1], c[2]) - p).norm();
}

void Clearance::collect(Index point, std::vector<Index>& triangles) const
{
  for (const Index leaf : points.leaves[point])
  {
    for (const ModelItem piece : octree.items(leaf))
    {
      if (piece.kind == ModelItem::triangle && !model.isPermeable(piece.index))
      {
        triangles.push_back(piece.index);
      }
    }
  }
}

void Clearance::spread(const std::vector<Index>& seeds, const Crossings& crossings)
{
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (const Index point : seeds)
  {
    front.emplace(distances[point], point);
  }
  while (!front.empty())
  {
    const auto [distance, point] = front.top();
    front.pop();
    if (distance > distances[point])
    {
      continue;
    }
    for (const std::int32_t code : crossings.neighbors[point])
    {
      if (code < 0)
      {
        continue;
      }
      const auto other = static_cast<Index>(code);
      const double there = distanceTo(nearest[point], position(other));
      if (there < distances[other])
      {
        distances[other] = there;
        nearest[other] = nearest[point];
        front.emplace(there, other);
      }
    }
  }
}

double Clearance::ofPoint(Index point) const
{
  return std::min(distances[point], position(point)[2] - octree.frame().domain.min[2]);
}

Clearance::OfEdge Clearance::ofEdge(Index from, Index to) const
{
  const double atFrom = ofPoint(from);
  const double atTo = ofPoint(to);
  const Vec3 p = position(from);
  const Vec3 q = position(to);
  OfEdge least = atFrom <= atTo ? OfEdge{atFrom, p} : OfEdge{atTo, q};
  std::vector<Index> triangles;
  collect(from, triangles);
  collect(to, triangles);
  for (const Index point : {from, to})
  {
    if (nearest[point] != noIndex)
    {
      triangles.push_back(nearest[point]);
    }
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  for (const Index triangle : triangles)
  {
    const Corners c = cornersOf(triangle, model, octree.frame());
    const NearestPair pair = nearestOfSegmentAndTriangle(p, q, c[0], c[1], c[2]);
    if (pair.distance() < least.distance)
    {
      least = {pair.distance(), pair.first};
    }
  }
  return least;
}

Passage passageBetween(const Vec3& p, const Vec3& q, double size, const Octree& octree, const SurfaceModel& model)
{
  // Distance in octants beyond which a ball is in another gap.
  constexpr double farthestMove = 2.0;
  // Number of places along the way, as a gap may be anywhere on it.
  constexpr int samples = 5;
  const double clearance = Surroundings(p, 2.0 * size, octree, model).clearance(p);
  const double reach = std::min(clearance, octree.frame().rootSize()) + (q - p).norm();
  const Surroundings about(p, reach + (2.0 * farthestMove + 1.0) * size, octree, model);
  Passage passage;
  passage.center = p;
  for (int k = 0; k < samples; ++k)
  {
    const Vec3 place = p + (k + 0.5) / samples * (q - p);
    const Ball ball = gapAt(about, place, q - p, size, farthestMove * size);
    if (2.0 * ball.radius < passage.width)
    {
      passage.center = ball.center;
      passage.width = 2.0 * ball.radius;
    }
  }
  // The center of the ball may be off by as much as the search is.
  passage.surfaces = about.within(passage.center, 0.5 * passage.width + 2.0 * coincidentRatio * size);
  return passage;
}

} // namespace atria
