// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/Terrain.h"

#include "Domain/Domain.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Surface/Triangles/Weld.h"
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace atria {

namespace {

/// A border edge of the terrain with the terrain on its left, seen from above.
struct Border
{
  Index from;
  Index to;
  Index surface;
};

/// Units of the lattice on which points are welded, in the tolerance.
constexpr std::int64_t stepsOfTolerance = 16;

class Outline
{
public:
  Outline(const TriangleSurface& surface, const SurfaceFlags& isTerrain, double tolerance)
  {
    const double unit = std::max(tolerance, 1e-12) / stepsOfTolerance;
    std::vector<LatticePoint> places;
    std::vector<Index> numbers;
    PointWelder welder(places, stepsOfTolerance);
    const auto numbered = [&](const Vec3& p) {
      places.push_back({std::llround(p[0] / unit), std::llround(p[1] / unit), std::llround(p[2] / unit)});
      const Index first = welder.addNext();
      const bool isNew = first + 1 == places.size();
      if (isNew)
      {
        points.push_back(p);
      }
      numbers.push_back(isNew ? static_cast<Index>(points.size() - 1) : numbers[first]);
      return numbers.back();
    };
    struct Use
    {
      int count = 0;
      Border border;
    };
    std::map<std::array<Index, 2>, Use> edges;
    double upwards = 0.0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      if (!isTerrain[surface.surfaceIds[t]])
      {
        continue;
      }
      std::array<Index, 3> ids;
      std::transform(surface.triangles[t].begin(), surface.triangles[t].end(), ids.begin(),
                     [&](Index p) { return numbered(surface.points[p]); });
      const double area = areaFromAbove(ids);
      upwards += area;
      for (int i = 0; i < 3; ++i)
      {
        const Index a = ids[area < 0.0 ? (i + 1) % 3 : i];
        const Index b = ids[area < 0.0 ? i : (i + 1) % 3];
        Use& use = edges[{std::min(a, b), std::max(a, b)}];
        ++use.count;
        use.border = {a, b, surface.surfaceIds[t]};
      }
    }
    facesUp = upwards >= 0.0;
    for (const auto& [ends, use] : edges)
    {
      found.nonManifoldEdges += use.count > 2 ? 1 : 0;
      if (use.count == 1 && ends[0] != ends[1])
      {
        borders.push_back(use.border);
      }
    }
    found.borderEdges = borders.size();
  }

  std::vector<Vec3> points;
  std::vector<Border> borders;
  bool facesUp = true;
  TerrainOutline found;

private:
  double areaFromAbove(const std::array<Index, 3>& t) const
  {
    const Vec3 u = points[t[1]] - points[t[0]];
    const Vec3 v = points[t[2]] - points[t[0]];
    return u[0] * v[1] - u[1] * v[0];
  }
};

/// Builds the ring between an outline and a rectangle.
class Ring
{
public:
  Ring(const Outline& terrain, const Box3& within) : outline(terrain), box(within) {}

  void build(TriangleSurface& surface, TerrainOutline& found)
  {
    addOutline();
    const std::size_t outlinePoints = plane.size();
    for (int direction = xMin; direction <= yMax; ++direction)
    {
      for (std::size_t i = 0; i < outlinePoints; ++i)
      {
        project(static_cast<Index>(i), direction);
      }
    }
    for (const auto& [x, y] : {std::pair(box.min[0], box.min[1]), std::pair(box.max[0], box.min[1]),
                               std::pair(box.max[0], box.max[1]), std::pair(box.min[0], box.max[1])})
    {
      add(x, y, nearest(x, y));
    }
    PlanarTriangulation ring = triangulatePlane(plane, segments);
    for (std::size_t i = plane.size(); i < ring.points.size(); ++i)
    {
      const Index at = nearest(ring.points[i][0], ring.points[i][1]);
      heights.push_back(heights[at]);
      ids.push_back(ids[at]);
    }
    append(surface, ring);
    found.openBorders = openBorders(ring);
  }

private:
  void add(double x, double y, Index like)
  {
    plane.emplace_back(x, y);
    heights.push_back(heights[like]);
    ids.push_back(ids[like]);
  }

  void addOutline()
  {
    std::vector<Index> numbers(outline.points.size(), noIndex);
    const auto numbered = [&](Index p, Index surface) {
      if (numbers[p] == noIndex)
      {
        numbers[p] = static_cast<Index>(plane.size());
        plane.emplace_back(outline.points[p][0], outline.points[p][1]);
        heights.push_back(outline.points[p][2]);
        ids.push_back(surface);
      }
      return numbers[p];
    };
    for (const Border& border : outline.borders)
    {
      const Index a = numbered(border.from, border.surface);
      const Index b = numbered(border.to, border.surface);
      segments.push_back({a, b});
      around.resize(plane.size());
      around[a].push_back(static_cast<Index>(segments.size() - 1));
      around[b].push_back(static_cast<Index>(segments.size() - 1));
    }
    borderCount = segments.size();
  }

  double distanceTo(const Vec2& p, int direction) const
  {
    const int axis = axisOf(direction);
    return isUpper(direction) ? box.max[axis] - p[axis] : p[axis] - box.min[axis];
  }

  /// True if the ray from the point straight to the side meets no border but those at the point.
  bool sees(Index point, int direction) const
  {
    const int axis = axisOf(direction);
    const double sign = isUpper(direction) ? 1.0 : -1.0;
    const Vec2& p = plane[point];
    for (std::size_t s = 0; s < borderCount; ++s)
    {
      const Vec2& a = plane[segments[s][0]];
      const Vec2& b = plane[segments[s][1]];
      const double u = a[1 - axis] - p[1 - axis];
      const double v = b[1 - axis] - p[1 - axis];
      if ((u > 0.0 && v > 0.0) || (u < 0.0 && v < 0.0) || segments[s][0] == point || segments[s][1] == point)
      {
        continue;
      }
      const double at =
          u == v ? std::max(sign * a[axis], sign * b[axis]) : sign * (a[axis] + u / (u - v) * (b[axis] - a[axis]));
      if (at > sign * p[axis])
      {
        return false;
      }
    }
    return true;
  }

  /// True if no border at the point has its terrain on the side the direction points to.
  bool pointsAway(Index point, int direction) const
  {
    const double sign = isUpper(direction) ? 1.0 : -1.0;
    return std::all_of(around[point].begin(), around[point].end(), [&](Index s) {
      const Vec2 along = plane[segments[s][1]] - plane[segments[s][0]];
      // The outward normal is on the right.
      const double outward = axisOf(direction) == 0 ? along[1] : -along[0];
      return sign * outward >= -1e-9 * along.norm();
    });
  }

  /// Continues a point of the outline straight to a side that it faces.
  void project(Index point, int direction)
  {
    const Vec2 p = plane[point];
    double least = std::numeric_limits<double>::infinity();
    for (int other = xMin; other <= yMax; ++other)
    {
      least = std::min(least, sees(point, other) ? distanceTo(p, other) : least);
    }
    const double own = distanceTo(p, direction);
    if (own <= 0.0 || !(pointsAway(point, direction) || own <= least) || !sees(point, direction))
    {
      return;
    }
    Vec2 q = p;
    q[axisOf(direction)] = isUpper(direction) ? box.max[axisOf(direction)] : box.min[axisOf(direction)];
    if (!crossesProjection(p, q, axisOf(direction)))
    {
      add(q[0], q[1], point);
      segments.push_back({point, static_cast<Index>(plane.size() - 1)});
    }
  }

  /// True if the segment crosses a projection. A part of the ring would then be cut off from the rectangle.
  bool crossesProjection(const Vec2& p, const Vec2& q, int axis) const
  {
    return std::any_of(
        segments.begin() + static_cast<std::ptrdiff_t>(borderCount), segments.end(), [&](const auto& segment) {
          const Vec2& a = plane[segment[0]];
          const Vec2& b = plane[segment[1]];
          return a[axis] == b[axis] && std::min(p[axis], q[axis]) < a[axis] && a[axis] < std::max(p[axis], q[axis]) &&
                 std::min(a[1 - axis], b[1 - axis]) < p[1 - axis] && p[1 - axis] < std::max(a[1 - axis], b[1 - axis]);
        });
  }

  Index nearest(double x, double y) const
  {
    Index best = 0;
    for (Index i = 0; i < around.size(); ++i)
    {
      best = (plane[i] - Vec2(x, y)).squaredNorm() < (plane[best] - Vec2(x, y)).squaredNorm() ? i : best;
    }
    return best;
  }

  void append(TriangleSurface& surface, const PlanarTriangulation& ring) const
  {
    std::vector<Index> numbers(ring.points.size(), noIndex);
    for (std::size_t t = 0; t < ring.triangles.size(); ++t)
    {
      if (!ring.isOutside(t))
      {
        continue;
      }
      std::array<Index, 3> triangle = ring.triangles[t];
      surface.surfaceIds.push_back(ids[*std::min_element(triangle.begin(), triangle.end())]);
      for (Index& p : triangle)
      {
        if (numbers[p] == noIndex)
        {
          numbers[p] = static_cast<Index>(surface.points.size());
          surface.points.emplace_back(ring.points[p][0], ring.points[p][1], heights[p]);
        }
        p = numbers[p];
      }
      if (!outline.facesUp)
      {
        std::swap(triangle[1], triangle[2]);
      }
      surface.triangles.push_back(triangle);
    }
  }

  /// Returns the number of borders that the ring does not touch.
  std::size_t openBorders(const PlanarTriangulation& ring) const
  {
    std::vector<char> touched(plane.size(), 0);
    for (std::size_t t = 0; t < ring.triangles.size(); ++t)
    {
      for (const Index p : ring.triangles[t])
      {
        touched[std::min<std::size_t>(p, plane.size() - 1)] |= ring.isOutside(t) ? 1 : 0;
      }
    }
    return std::count_if(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(borderCount),
                         [&](const auto& s) { return !touched[s[0]] && !touched[s[1]]; });
  }

  const Outline& outline;
  Box3 box;
  std::vector<Vec2> plane;
  std::vector<double> heights;
  std::vector<Index> ids;
  std::vector<std::array<Index, 2>> segments;
  std::vector<std::vector<Index>> around; ///< borders at a point of the outline
  std::size_t borderCount = 0;
};

} // namespace

SurfaceFlags terrainSurfaces(const TriangleSurface& surface, const std::string& pattern, const std::string& site,
                             double flatness)
{
  if (!pattern.empty())
  {
    return matchingSurfaces(pattern, surface.names, "which is to be the terrain");
  }
  SurfaceFlags flags(surface.names.size(), 0);
  std::ranges::transform(surface.names, flags.begin(), [&](const std::string& name) { return name == site ? 1 : 0; });
  const Ground candidate(surface, flags, 0.0);
  const bool flat = candidate.empty() || candidate.bounds().size()[2] <= flatness;
  return flat ? SurfaceFlags(flags.size(), 0) : flags;
}

TerrainOutline extendTerrain(TriangleSurface& surface, const SurfaceFlags& isTerrain, const Box3& reach,
                             double tolerance)
{
  const Outline outline(surface, isTerrain, tolerance);
  Box3 box;
  for (const Vec3& p : outline.points)
  {
    box.extend(p);
  }
  if (box.empty() || !(box.size()[0] > 0.0) || !(box.size()[1] > 0.0))
  {
    throw Error("the terrain has no extent in x and y: correct TerrainName, or remove the surface");
  }
  if (outline.borders.empty())
  {
    throw Error("the terrain is closed, like a solid: take it out of TerrainName, or give its upper side alone");
  }
  box.extend(reach.min);
  box.extend(reach.max);
  TerrainOutline found = outline.found;
  Ring(outline, box).build(surface, found);
  return found;
}

} // namespace atria
