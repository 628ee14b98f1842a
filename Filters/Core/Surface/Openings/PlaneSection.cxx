// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Openings/PlaneSection.h"

#include "Surface/Triangles/EachEdge.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace atria {

namespace {

std::vector<NumberedBox> boxesOfWalls(const SurfaceModel& model)
{
  std::vector<NumberedBox> boxes;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (!model.isPermeable(t) && !model.isTurnedSide(t))
    {
      boxes.push_back({boundsOf(model.corner(t, 0), model.corner(t, 1), model.corner(t, 2)), t});
    }
  }
  return boxes;
}

bool contains(const std::array<Vec2, 3>& triangle, const Vec2& p)
{
  const auto side = [&](int i) {
    const Vec2 along = triangle[(i + 1) % 3] - triangle[i];
    const Vec2 to = p - triangle[i];
    return along[0] * to[1] - along[1] * to[0];
  };
  const double a = side(0), b = side(1), c = side(2);
  return (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
}

class Sectioner
{
public:
  Sectioner(const WallPlane& p, std::span<const EdgeKey> l, const SectionSource& s)
      : plane(p), lines(l), source(s), model(s.model)
  {
  }

  PlaneSection run()
  {
    findEnds();
    if (out.ends.empty())
    {
      return std::move(out);
    }
    addOutline();
    addCrossing();
    addSides();
    for (const auto& [a, b] : lines)
    {
      segments.push_back({pointOf(a), pointOf(b)});
    }
    out.parted = triangulatePlane(points, segments);
    findCovered();
    return std::move(out);
  }

private:
  bool isInPlane(Index triangle) const { return std::ranges::binary_search(plane.triangles, triangle); }

  double heightOf(const LatticePoint& p) const
  {
    const double height = plane.heightOf(toVector(p));
    return std::abs(height) <= source.distance ? 0.0 : height;
  }

  Index add(const Vec3& p, const LatticePoint& lattice)
  {
    points.push_back(plane.placeOf(p));
    out.corners.push_back(lattice);
    return static_cast<Index>(points.size() - 1);
  }

  Index pointOf(Index corner)
  {
    const auto [at, isNew] = ofCorner.try_emplace(corner, noIndex);
    if (isNew)
    {
      at->second = add(toVector(model.points[corner]), model.points[corner]);
    }
    return at->second;
  }

  /// Returns the point where an edge of the model passes through the plane. It is the same for all triangles of the
  /// edge.
  Index pointOf(EdgeKey edge)
  {
    const auto [at, isNew] = ofEdge.try_emplace(edge, noIndex);
    if (isNew)
    {
      const Vec3 a = toVector(model.points[edge.first]);
      const Vec3 b = toVector(model.points[edge.second]);
      const double below = plane.heightOf(a);
      const Vec3 p = a + below / (below - plane.heightOf(b)) * (b - a);
      at->second = add(p, {std::llround(p[0]), std::llround(p[1]), std::llround(p[2])});
    }
    return at->second;
  }

  /// Finds the ends of walls: edges that one triangle of the plane has, if all others there go back from it.
  void findEnds()
  {
    for (const Index t : plane.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        addEnd(t, i);
      }
    }
  }

  void addEnd(Index t, int i)
  {
    if (model.isPermeable(t))
    {
      return;
    }
    const auto& corners = model.triangles[t];
    WallEnd end{plane.placeOf(toVector(model.points[corners[i]])),
                plane.placeOf(toVector(model.points[corners[(i + 1) % 3]])),
                t,
                {}};
    const double front = model.normal(t).dot(plane.normal) > 0.0 ? 1.0 : -1.0;
    for (const SoupEdgeUse& use : source.usesOf[t][i])
    {
      if (use.triangle == t)
      {
        continue;
      }
      const double height = front * heightOf(model.points[thirdOf(use)]);
      if (isInPlane(use.triangle) || height >= 0.0)
      {
        return;
      }
      end.reveals.push_back(model.charts[use.triangle]);
    }
    out.ends.push_back(std::move(end));
  }

  Index thirdOf(const SoupEdgeUse& use) const
  {
    const auto& corners = model.triangles[use.triangle];
    return *std::ranges::find_if(corners, [&](Index p) { return p != use.edge.first && p != use.edge.second; });
  }

  void addOutline()
  {
    for (const Index t : plane.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        const auto uses = source.usesOf[t][i];
        const auto inPlane =
            std::ranges::count_if(uses, [&](const SoupEdgeUse& use) { return isInPlane(use.triangle); });
        if (inPlane == 1 || uses.size() > 2)
        {
          segments.push_back({pointOf(model.triangles[t][i]), pointOf(model.triangles[t][(i + 1) % 3])});
        }
      }
    }
  }

  void addCrossing()
  {
    LatticeBox box;
    const double reach = 0.5 * (plane.bounds.max - plane.bounds.min).norm();
    for (int axis = 0; axis < 3; ++axis)
    {
      // Extent along the axis of a circle of radius `reach` in the plane.
      const double along = reach * std::hypot(plane.u[axis], plane.v[axis]) + source.distance;
      box.low[axis] = static_cast<std::int64_t>(std::floor(plane.bounds.min[axis] - along));
      box.high[axis] = static_cast<std::int64_t>(std::ceil(plane.bounds.max[axis] + along));
    }
    std::vector<Index> near;
    source.triangles.eachTouching(box, 0, [&](std::size_t at) { near.push_back(source.triangles.box(at).id); });
    std::ranges::sort(near);
    for (const Index t : near)
    {
      if (!isInPlane(t))
      {
        addCut(t);
      }
    }
  }

  /// Adds the segment in which a triangle meets the plane, if any.
  void addCut(Index t)
  {
    const auto& corners = model.triangles[t];
    std::array<double, 3> heights;
    std::ranges::transform(corners, heights.begin(), [&](Index p) { return heightOf(model.points[p]); });
    std::vector<Index> ends;
    for (int i = 0; i < 3; ++i)
    {
      if (heights[i] == 0.0)
      {
        ends.push_back(pointOf(corners[i]));
      }
      const int j = (i + 1) % 3;
      if (heights[i] * heights[j] < 0.0)
      {
        ends.push_back(pointOf(edgeKey(corners[i], corners[j])));
      }
    }
    for (std::size_t i = 1; i < ends.size(); ++i)
    {
      segments.push_back({ends[i - 1], ends[i]});
    }
    if (ends.size() == 3)
    {
      segments.push_back({ends[2], ends[0]});
    }
  }

  /// Adds the lines in which the domain's bottom, or all of its sides, cut the plane.
  void addSides()
  {
    const GridFrame& frame = source.frame;
    const double reach = 2.0 * (toVector(frame.domainHigh) - toVector(frame.domainLow)).norm();
    for (int direction = 0; direction < 6; ++direction)
    {
      const int axis = axisOf(direction);
      const Vec3 normal = Vec3::Unit(axis);
      const Vec3 along = plane.normal.cross(normal);
      if ((direction != zMin && !source.sidesAreWalls) || along.norm() < 0.1)
      {
        continue;
      }
      const double at = static_cast<double>(isUpper(direction) ? frame.domainHigh[axis] : frame.domainLow[axis]);
      const Vec3 within = (normal - plane.normal * plane.normal[axis]).normalized();
      const Vec3 foot = plane.origin + within * ((at - plane.origin[axis]) / within[axis]);
      const Vec3 way = along.normalized() * reach;
      const Vec3 from = foot - way;
      const Vec3 to = foot + way;
      const auto rounded = [](const Vec3& p) {
        return LatticePoint{std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
      };
      const Index first = add(from, rounded(from));
      segments.push_back({first, add(to, rounded(to))});
    }
  }

  void findCovered()
  {
    const PlanarTriangulation& parted = out.parted;
    const auto areaOf = [&](std::size_t t) {
      const auto& [a, b, c] = parted.triangles[t];
      const Vec2 p = parted.points[b] - parted.points[a];
      const Vec2 q = parted.points[c] - parted.points[a];
      return p[0] * q[1] - p[1] * q[0];
    };
    std::vector<std::size_t> largest(parted.regionCount, parted.triangles.size());
    for (std::size_t t = 0; t < parted.triangles.size(); ++t)
    {
      std::size_t& best = largest[parted.regions[t]];
      best = best == parted.triangles.size() || areaOf(t) > areaOf(best) ? t : best;
    }
    out.covered.assign(parted.regionCount, 0);
    for (Index region = 1; region < parted.regionCount; ++region)
    {
      const auto& [a, b, c] = parted.triangles[largest[region]];
      out.covered[region] = isCovered((parted.points[a] + parted.points[b] + parted.points[c]) / 3.0) ? 1 : 0;
    }
  }

  bool isCovered(const Vec2& p) const
  {
    return std::ranges::any_of(plane.triangles, [&](Index t) {
      return contains({plane.placeOf(toVector(model.corner(t, 0))), plane.placeOf(toVector(model.corner(t, 1))),
                       plane.placeOf(toVector(model.corner(t, 2)))},
                      p);
    });
  }

  const WallPlane& plane;
  std::span<const EdgeKey> lines;
  const SectionSource& source;
  const SurfaceModel& model;
  std::vector<Vec2> points;
  std::vector<std::array<Index, 2>> segments;
  std::map<Index, Index> ofCorner;
  std::map<EdgeKey, Index> ofEdge;
  PlaneSection out;
};

} // namespace

SectionSource::SectionSource(const SurfaceModel& m, const GridFrame& f, bool walls, double d, const RunContext& context)
    : model(m), frame(f), sidesAreWalls(walls), distance(d), triangles(boxesOfWalls(m), context),
      uses(sortedEdgeUses(m.triangles, m.points.size(), context.executor)), usesOf(m.triangles.size())
{
  eachEdge(uses, [&](std::span<const SoupEdgeUse> edge) {
    for (const auto& [key, t, forward] : edge)
    {
      for (int i = 0; i < 3; ++i)
      {
        usesOf[t][i] = edgeKey(model.triangles[t], i) == key ? edge : usesOf[t][i];
      }
    }
  });
}

PlaneSection sectionAt(const WallPlane& plane, std::span<const EdgeKey> lines, const SectionSource& source)
{
  return Sectioner(plane, lines, source).run();
}

} // namespace atria
