// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/FaceTriangulation.h"

#include "Grid/Predicates.h"
#include "Surface/Triangulation/LatticeSegments.h"
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace atria {

namespace {

std::vector<Index> outlineOf(const DividedFace& face)
{
  std::vector<Index> outline;
  for (int i = 0; i < 3; ++i)
  {
    outline.push_back(face.corners[i]);
    outline.insert(outline.end(), face.alongEdges[i].begin(), face.alongEdges[i].end());
  }
  return outline;
}

int dominantAxis(const LatticeNormal& normal)
{
  const auto size = [&](int i) { return normal.n[i] < 0 ? -normal.n[i] : normal.n[i]; };
  return size(0) > size(1) ? (size(0) > size(2) ? 0 : 2) : (size(1) > size(2) ? 1 : 2);
}

/// Cuts the outline into a fan. Triangles with the same points bound nothing together, and are left out in pairs.
void cutIntoFan(const DividedFace& face, std::vector<std::array<Index, 3>>& out)
{
  const std::vector<Index> outline = outlineOf(face);
  std::map<std::array<Index, 3>, std::array<Index, 3>> fan;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
  {
    const std::array<Index, 3> triangle{outline[0], outline[i], outline[i + 1]};
    std::array<Index, 3> key = triangle;
    std::sort(key.begin(), key.end());
    if (!fan.erase(key))
    {
      fan.emplace(key, triangle);
    }
  }
  for (const auto& [key, triangle] : fan)
  {
    out.push_back(triangle);
  }
}

/// Triangulates one face.
class Triangulator
{
public:
  Triangulator(std::vector<LatticePoint>& points_, const DividedFace& face_, const LatticeNormal& normal_,
               double reach_)
      : points(points_), face(face_), normal(normal_), axis(dominantAxis(normal_)), reach(reach_)
  {
  }

  void run(std::vector<std::array<Index, 3>>& out)
  {
    const PlanarOutline outline = addOutline();
    for (const Index p : face.inside)
    {
      add(p, project(p));
    }
    for (const auto& [p, q] : face.segments)
    {
      segments.push_back({numbers.at(p), numbers.at(q)});
    }
    const PlanarTriangulation plane = triangulatePlane(places, segments, outline);
    const bool reversed = normal.n[axis] < 0;
    for (std::size_t t = 0; t < plane.triangles.size(); ++t)
    {
      if (!plane.isOutside(t))
      {
        const auto& [a, b, c] = plane.triangles[t];
        const Index first = lift(plane, a), second = lift(plane, b), third = lift(plane, c);
        out.push_back({first, reversed ? third : second, reversed ? second : third});
      }
    }
  }

private:
  /// Returns the point in the plane, relative to the first corner. With small numbers, the filters of the predicates
  /// leave fewer cases to decide exactly.
  Vec2 project(Index id) const
  {
    const LatticePoint& origin = points[face.corners[0]];
    const LatticePoint& p = points[id];
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    return {static_cast<double>(p[u] - origin[u]), static_cast<double>(p[v] - origin[v])};
  }

  /// Returns a place for a point along edge i, on an arc that bends in from the edge a little. Rounded points may lie
  /// beyond their edge. They would then be joined to both of its ends, in a triangle without width.
  Vec2 placeAlong(int i, Index id) const
  {
    const Vec2 a = project(face.corners[i]);
    const Vec2 edge = project(face.corners[(i + 1) % 3]) - a;
    const Vec2 inward = project(face.corners[(i + 2) % 3]) - a;
    const Vec2 way = project(id) - a;
    const auto dot = [](const Vec2& l, const Vec2& r) { return l[0] * r[0] + l[1] * r[1]; };
    const double squared = dot(edge, edge);
    const double t = std::clamp(dot(way, edge) / squared, 0.0, 1.0);
    const double height = std::abs(edge[0] * inward[1] - edge[1] * inward[0]) / std::sqrt(squared);
    const double bend = std::min(0.25 * reach / height, 0.05);
    return a + t * edge + 4.0 * t * (1.0 - t) * bend * (inward - dot(inward, edge) / squared * edge);
  }

  void add(Index id, const Vec2& place)
  {
    if (numbers.emplace(id, static_cast<Index>(ids.size())).second)
    {
      ids.push_back(id);
      places.push_back(place);
    }
  }

  PlanarOutline addOutline()
  {
    for (const Index corner : face.corners)
    {
      add(corner, project(corner));
    }
    for (int i = 0; i < 3; ++i)
    {
      for (const Index p : face.alongEdges[i])
      {
        add(p, placeAlong(i, p));
      }
    }
    const std::vector<Index> outline = outlineOf(face);
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
      segments.push_back({numbers.at(outline[i]), numbers.at(outline[(i + 1) % outline.size()])});
    }
    return {places.size(), segments.size()};
  }

  /// Returns the lattice point nearest to a point of the plane, put on the face's plane.
  Index lift(const PlanarTriangulation& plane, Index i)
  {
    ids.resize(plane.points.size(), noIndex);
    if (ids[i] == noIndex)
    {
      const LatticePoint& origin = points[face.corners[0]];
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      const long double x = plane.points[i][0];
      const long double y = plane.points[i][1];
      const auto n = [&](int k) { return static_cast<long double>(normal.n[k]); };
      LatticePoint p;
      p[u] = origin[u] + std::llroundl(x);
      p[v] = origin[v] + std::llroundl(y);
      p[axis] = origin[axis] + std::llroundl(-(n(u) * x + n(v) * y) / n(axis));
      ids[i] = static_cast<Index>(points.size());
      points.push_back(p);
    }
    return ids[i];
  }

  std::vector<LatticePoint>& points;
  const DividedFace& face;
  const LatticeNormal& normal;
  int axis;
  double reach;
  std::map<Index, Index> numbers; ///< in the plane, of points
  std::vector<Index> ids;         ///< lattice points of points in the plane
  std::vector<Vec2> places;
  std::vector<std::array<Index, 2>> segments;
};

} // namespace

void triangulateFace(std::vector<LatticePoint>& points, DividedFace& face, double reach,
                     std::vector<std::array<Index, 3>>& out)
{
  const LatticeNormal normal(points[face.corners[0]], points[face.corners[1]], points[face.corners[2]]);
  if (normal.n[0] == 0 && normal.n[1] == 0 && normal.n[2] == 0)
  {
    cutIntoFan(face, out);
    return;
  }
  cutSegments(points, face, dominantAxis(normal), reach);
  Triangulator(points, face, normal, reach).run(out);
}

} // namespace atria
