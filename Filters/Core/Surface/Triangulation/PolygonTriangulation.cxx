// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/PolygonTriangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace atria {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;

enum class Side : std::uint8_t
{
  unknown,
  inside,
  outside
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Side, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;

/// The polygon moved and scaled into the unit box, so that neither national-grid nor millimeter coordinates
/// cost digits.
struct Outline
{
  std::vector<Index> ids;
  std::vector<Vec3> points;
  Vec3 normal = Vec3::Zero(); ///< Newell's: twice the vector area
};

/// Fills `out`; its memory is used again. False where there is nothing to triangulate.
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

/// Rounding alone gives areas of this order in the unit box.
constexpr double noArea = 1e-14;

/// Cuts a quad, with its points as in an Outline, in two where one of its diagonals lies inside; false otherwise.
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

/// Cuts a quad in a fraction of the time that any polygon takes, with the same result; false where it takes more.
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

/// The general way: one object a polygon.
class Triangulator
{
public:
  explicit Triangulator(const Outline& source) : outline(source) {}

  PolygonTriangles run()
  {
    project();
    insertPoints();
    insertEdges();
    if (cdt.dimension() == 2)
    {
      countEdges();
      out.simple ? flood() : classifyByRays();
      collect();
    }
    return std::move(out);
  }

private:
  void project()
  {
    const Vec3 n = outline.normal.normalized();
    int axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    const Vec3 u = n.cross(Vec3::Unit(axis)).normalized();
    const Vec3 v = n.cross(u);
    for (const Vec3& p : outline.points)
    {
      flat.emplace_back(p.dot(u), p.dot(v));
    }
  }

  void insertPoints()
  {
    Face hint;
    for (std::size_t i = 0; i < flat.size(); ++i)
    {
      const std::size_t before = cdt.number_of_vertices();
      const Vertex v = cdt.insert(flat[i], hint);
      if (cdt.number_of_vertices() > before)
      {
        v->info() = static_cast<Index>(i); // of points that fall together the first stands for all
      }
      vertices.push_back(v);
      hint = v->face();
    }
  }

  using Edge = std::pair<Index, Index>;
  static Edge edgeOf(Vertex a, Vertex b) { return std::minmax(a->info(), b->info()); }

  static void toggle(std::set<Edge>& edges, const Edge& edge)
  {
    if (!edges.erase(edge))
    {
      edges.insert(edge);
    }
  }

  /// Edges walked an even number of times bound nothing.
  void insertEdges()
  {
    std::set<Edge> odd;
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      const Vertex next = vertices[(i + 1) % vertices.size()];
      if (vertices[i] != next)
      {
        toggle(odd, edgeOf(vertices[i], next));
      }
    }
    for (const Edge& e : odd)
    {
      edges.emplace_back(vertices[e.first], vertices[e.second]);
      try
      {
        cdt.insert_constraint(edges.back().first, edges.back().second);
      }
      catch (const Triangulation::Intersection_of_constraints_exception&)
      {
        out.simple = false;
      }
    }
  }

  /// Splits the edges at points that lie on them, and counts the pieces: overlaps cancel out.
  void countEdges()
  {
    for (auto [from, to] : edges)
    {
      while (from != to)
      {
        Vertex next;
        Face face;
        int i = 0;
        if (!cdt.includes_edge(from, to, next, face, i))
        {
          out.simple = false;
          break;
        }
        toggle(boundary, edgeOf(from, next));
        from = next;
      }
    }
  }

  bool isBoundary(Face face, int i) const
  {
    const Vertex a = face->vertex(Triangulation::cw(i));
    const Vertex b = face->vertex(Triangulation::ccw(i));
    return !cdt.is_infinite(a) && !cdt.is_infinite(b) && boundary.count(edgeOf(a, b)) != 0;
  }

  /// From the outside inwards: each boundary crossed changes sides.
  void flood()
  {
    for (const Face face : cdt.all_face_handles())
    {
      face->info() = Side::unknown;
    }
    std::vector<Face> open{cdt.infinite_face()};
    open.back()->info() = Side::outside;
    while (!open.empty())
    {
      const Face face = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i)
      {
        const Face next = face->neighbor(i);
        if (next->info() == Side::unknown)
        {
          const bool inside = (face->info() == Side::inside) != isBoundary(face, i);
          next->info() = inside ? Side::inside : Side::outside;
          open.push_back(next);
        }
      }
    }
  }

  /// Where edges are missing from the triangulation the sides cannot be flooded: ask for each triangle's
  /// center.
  void classifyByRays()
  {
    for (const Face face : cdt.finite_face_handles())
    {
      const Point2 center = CGAL::centroid(cdt.triangle(face));
      face->info() = insideOutline(center) ? Side::inside : Side::outside;
    }
  }

  bool insideOutline(const Point2& p) const
  {
    bool inside = false;
    for (std::size_t i = 0; i < flat.size(); ++i)
    {
      const Point2& a = flat[i];
      const Point2& b = flat[(i + 1) % flat.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      {
        inside = !inside;
      }
    }
    return inside;
  }

  void collect()
  {
    for (const Face face : cdt.finite_face_handles())
    {
      if (face->info() == Side::inside)
      {
        out.triangles.push_back({outline.ids[face->vertex(0)->info()], outline.ids[face->vertex(1)->info()],
                                 outline.ids[face->vertex(2)->info()]});
      }
    }
  }

  const Outline& outline;
  std::vector<Point2> flat;
  Triangulation cdt;
  std::vector<Vertex> vertices;
  std::vector<std::pair<Vertex, Vertex>> edges;
  std::set<Edge> boundary;
  PolygonTriangles out;
};

} // namespace

namespace {

/// Whether a triangle passes as a polygon does, in a fraction of the time.
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
  static thread_local Outline outline; // asking for memory would take most of the time
  out.triangles.clear();
  out.simple = true;
  if (!normalize(points, polygon, outline) || !(outline.normal.norm() > noArea))
  {
    return;
  }
  if (outline.ids.size() == 3)
  {
    out.triangles.push_back({outline.ids[0], outline.ids[1], outline.ids[2]});
  }
  else if (outline.ids.size() != 4 ||
           !cutQuad(std::span(outline.ids).first<4>(), std::span(outline.points).first<4>(), outline.normal, out))
  {
    out = Triangulator(outline).run();
  }
}

PolygonTriangles triangulatePolygon(std::span<const Vec3> points, std::span<const Index> polygon)
{
  PolygonTriangles out;
  triangulatePolygon(points, polygon, out);
  return out;
}

} // namespace atria
