// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/PolygonTriangulation.h"

#include "Surface/Triangulation/PlanarTriangulation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace atria {

namespace {

/// The polygon moved and scaled into the unit box, so that neither national-grid nor millimeter coordinates cost
/// digits.
struct Outline
{
  std::vector<Index> ids;
  std::vector<Vec3> points;
  Vec3 normal = Vec3::Zero(); ///< Newell's: twice the vector area
};

/// Fills `out` and reuses its memory. Returns false if there is nothing to triangulate.
bool normalize(std::span<const Vec3> points, std::span<const Index> polygon, Outline& out)
{
  out.ids.clear();
  out.points.clear();
  out.normal = Vec3::Zero();
  Box3 box;
  for (const Index id : polygon)
  {
    if (id >= points.size() || !points[id].allFinite())
    {
      return false;
    }
    if (out.ids.empty() || points[id] != points[out.ids.back()])
    {
      out.ids.push_back(id);
      box.extend(points[id]);
    }
  }
  while (out.ids.size() > 1 && points[out.ids.front()] == points[out.ids.back()])
  {
    out.ids.pop_back();
  }
  const double extent = out.ids.size() < 3 ? 0.0 : box.size().maxCoeff();
  if (!(extent > 0.0) || !std::isfinite(extent))
  {
    return false;
  }
  for (const Index id : out.ids)
  {
    out.points.push_back((points[id] - box.min) / extent);
  }
  for (std::size_t i = 0; i < out.points.size(); ++i)
  {
    out.normal += (out.points[i] - out.points[0]).cross(out.points[(i + 1) % out.points.size()] - out.points[0]);
  }
  return true;
}

/// Area in the unit box up to which it may be due to rounding alone.
constexpr double noArea = 1e-14;

/// Cuts a quad, with its points as in an Outline, in two if one of its diagonals lies inside. Returns false if none
/// does.
bool cutQuad(std::span<const Index, 4> ids, std::span<const Vec3, 4> points, const Vec3& normal, PolygonTriangles& out)
{
  const double least = noArea * normal.norm();
  const auto cornerArea = [&](int a, int b, int c) {
    return (points[b] - points[a]).cross(points[c] - points[a]).dot(normal);
  };
  const auto valid = [&](int a) {
    return cornerArea(a, a + 1, (a + 2) % 4) > least && cornerArea(a, (a + 2) % 4, (a + 3) % 4) > least;
  };
  const bool first = valid(0);
  const bool second = valid(1);
  if (!first && !second)
  {
    return false;
  }
  const double length0 = (points[2] - points[0]).squaredNorm();
  const double length1 = (points[3] - points[1]).squaredNorm();
  const int a = first && (!second || length0 <= length1) ? 0 : 1;
  const auto id = [&](int i) { return ids[i % 4]; };
  out.triangles.push_back({id(a), id(a + 1), id(a + 2)});
  out.triangles.push_back({id(a), id(a + 2), id(a + 3)});
  return true;
}

/// Cuts a quad in a fraction of the time that any polygon takes, with the same result. Returns false if it needs the
/// general way.
bool cutPlainQuad(std::span<const Vec3> points, std::span<const Index, 4> ids, PolygonTriangles& out)
{
  if (std::max({ids[0], ids[1], ids[2], ids[3]}) >= points.size())
  {
    return false;
  }
  std::array<Vec3, 4> p{points[ids[0]], points[ids[1]], points[ids[2]], points[ids[3]]};
  if (p[0] == p[1] || p[1] == p[2] || p[2] == p[3] || p[3] == p[0])
  {
    return false;
  }
  const Vec3 low = p[0].cwiseMin(p[1]).cwiseMin(p[2].cwiseMin(p[3]));
  const Vec3 high = p[0].cwiseMax(p[1]).cwiseMax(p[2].cwiseMax(p[3]));
  const double extent = (high - low).maxCoeff();
  if (!(extent > 0.0) || !std::isfinite(extent) || !p[0].allFinite() || !p[1].allFinite() || !p[2].allFinite() ||
      !p[3].allFinite())
  {
    return false;
  }
  for (Vec3& each : p)
  {
    each = (each - low) / extent;
  }
  const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]) + (p[2] - p[0]).cross(p[3] - p[0]);
  return normal.norm() > noArea && cutQuad(ids, p, normal, out);
}

std::vector<Vec2> project(const Outline& outline)
{
  const Vec3 n = outline.normal.normalized();
  int axis = 0;
  n.cwiseAbs().minCoeff(&axis);
  const Vec3 u = n.cross(Vec3::Unit(axis)).normalized();
  const Vec3 v = n.cross(u);
  std::vector<Vec2> flat;
  for (const Vec3& p : outline.points)
  {
    flat.emplace_back(p.dot(u), p.dot(v));
  }
  return flat;
}

/// Returns the edges between places that are walked an odd number of times. All others bound nothing.
std::vector<std::array<Index, 2>> oddEdges(const std::vector<Vec2>& flat)
{
  std::map<std::pair<double, double>, Index> places;
  std::vector<Index> placeOf;
  placeOf.reserve(flat.size());
  for (const Vec2& p : flat)
  {
    placeOf.push_back(places.try_emplace({p[0], p[1]}, static_cast<Index>(placeOf.size())).first->second);
  }
  std::set<std::array<Index, 2>> odd;
  for (std::size_t i = 0; i < flat.size(); ++i)
  {
    const auto [low, high] = std::minmax(placeOf[i], placeOf[(i + 1) % flat.size()]);
    if (low != high && !odd.erase({low, high}))
    {
      odd.insert({low, high});
    }
  }
  return {odd.begin(), odd.end()};
}

bool isInside(const std::vector<Vec2>& flat, const Vec2& p)
{
  bool inside = false;
  for (std::size_t i = 0; i < flat.size(); ++i)
  {
    const Vec2& a = flat[i];
    const Vec2& b = flat[(i + 1) % flat.size()];
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
    {
      inside = !inside;
    }
  }
  return inside;
}

/// Triangulates any outline. If it crosses itself, edges are missing from the triangulation, which then does not know
/// its sides: each triangle's center is tested instead.
PolygonTriangles triangulateOutline(const Outline& outline)
{
  const std::vector<Vec2> flat = project(outline);
  const std::vector<std::array<Index, 2>> edges = oddEdges(flat);
  const PlanarTriangulation plane = triangulatePlane(flat, edges, {flat.size(), edges.size(), false});
  PolygonTriangles out;
  out.simple = plane.simple;
  for (std::size_t t = 0; t < plane.triangles.size(); ++t)
  {
    const auto& [a, b, c] = plane.triangles[t];
    if (plane.simple ? !plane.isOutside(t) : isInside(flat, (flat[a] + flat[b] + flat[c]) / 3.0))
    {
      out.triangles.push_back({outline.ids[a], outline.ids[b], outline.ids[c]});
    }
  }
  return out;
}

/// True if corners are not all in a line.
bool isWide(const Outline& outline)
{
  const Vec3& first = outline.points.front();
  for (std::size_t i = 2; i < outline.points.size(); ++i)
  {
    if ((outline.points[i - 1] - first).cross(outline.points[i] - first).norm() > noArea)
    {
      return true;
    }
  }
  return false;
}

/// True if a triangle is a valid polygon; takes a fraction of the time of the general way.
bool hasArea(std::span<const Vec3> points, std::span<const Index> t)
{
  const std::size_t last = std::max({t[0], t[1], t[2]});
  if (last >= points.size())
  {
    return false;
  }
  const Vec3 u = points[t[1]] - points[t[0]];
  const Vec3 v = points[t[2]] - points[t[0]];
  const Vec3 high = u.cwiseMax(v).cwiseMax(Vec3::Zero());
  const Vec3 low = u.cwiseMin(v).cwiseMin(Vec3::Zero());
  const double extent = (high - low).maxCoeff();
  return extent > 0.0 && std::isfinite(extent) && (u / extent).cross(v / extent).norm() > noArea;
}

} // namespace

void triangulatePolygon(std::span<const Vec3> points, std::span<const Index> polygon, PolygonTriangles& out)
{
  if (polygon.size() == 3)
  {
    out.triangles.clear();
    out.simple = true;
    if (hasArea(points, polygon))
    {
      out.triangles.push_back({polygon[0], polygon[1], polygon[2]});
    }
    return;
  }
  if (polygon.size() == 4)
  {
    out.triangles.clear();
    out.simple = true;
    if (cutPlainQuad(points, polygon.first<4>(), out))
    {
      return;
    }
  }
  static thread_local Outline outline; // allocation would take most of the time
  out.triangles.clear();
  out.simple = true;
  if (!normalize(points, polygon, outline))
  {
    return;
  }
  if (!(outline.normal.norm() > noArea))
  {
    out.simple = !isWide(outline);
    return;
  }
  if (outline.ids.size() == 3)
  {
    out.triangles.push_back({outline.ids[0], outline.ids[1], outline.ids[2]});
  }
  else if (outline.ids.size() != 4 ||
           !cutQuad(std::span(outline.ids).first<4>(), std::span(outline.points).first<4>(), outline.normal, out))
  {
    out = triangulateOutline(outline);
  }
}

PolygonTriangles triangulatePolygon(std::span<const Vec3> points, std::span<const Index> polygon)
{
  PolygonTriangles out;
  triangulatePolygon(points, polygon, out);
  return out;
}

} // namespace atria
