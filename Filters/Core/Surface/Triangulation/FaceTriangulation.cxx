// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/FaceTriangulation.h"

#include "Grid/Predicates.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <map>
#include <set>

namespace atria {

namespace {

enum class Side : std::uint8_t
{
  unknown,
  inside,
  outside
};

/// A vertex that the triangulation adds itself has none.
struct PointId
{
  Index id = noIndex;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<PointId, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Side, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>>;
using Point2 = Kernel::Point_2;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;

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

/// Triangles of the fan that have the same points bound nothing together, and are left out in pairs.
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

/// One object a face.
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
    insertOutline();
    for (const Index p : face.inside)
    {
      vertexOf(p);
    }
    for (const auto& [p, q] : face.segments)
    {
      insertSegment(p, q);
    }
    flood();
    collect(out);
  }

private:
  using VertexPair = std::pair<Vertex, Vertex>;

  Vertex vertexOf(Index id)
  {
    const auto known = vertices.find(id);
    if (known != vertices.end())
    {
      return known->second;
    }
    return addVertex(id, project(id));
  }

  /// Measured from the corner: small numbers leave the filters of the predicates less to decide exactly.
  Point2 project(Index id) const
  {
    const LatticePoint& origin = points[face.corners[0]];
    const LatticePoint& p = points[id];
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    return {static_cast<double>(p[u] - origin[u]), static_cast<double>(p[v] - origin[v])};
  }

  /// A place for a point along edge i, on an arc that bends in from the edge a little. Rounded points may lie beyond
  /// their edge; taken as they are, they would be joined to both of its ends, in a triangle without width.
  Point2 placeAlong(int i, Index id) const
  {
    const Point2 a = project(face.corners[i]);
    const Point2 b = project(face.corners[(i + 1) % 3]);
    const Kernel::Vector_2 edge = b - a;
    const Kernel::Vector_2 inward = project(face.corners[(i + 2) % 3]) - a;
    const double t = std::clamp((project(id) - a) * edge / edge.squared_length(), 0.0, 1.0);
    const double height = std::abs(edge.x() * inward.y() - edge.y() * inward.x()) / std::sqrt(edge.squared_length());
    const double bend = std::min(0.25 * reach / height, 0.05);
    return a + t * edge + 4.0 * t * (1.0 - t) * bend * (inward - (inward * edge) / edge.squared_length() * edge);
  }

  Vertex addVertex(Index id, const Point2& place)
  {
    const Vertex vertex = cdt.insert(place, vertices.empty() ? Face() : last->face());
    if (vertex->info().id == noIndex)
    {
      vertex->info().id = id; // of points that fall together the first stands for all
    }
    last = vertex;
    vertices.emplace(id, vertex);
    return vertex;
  }

  Triangulation::Constraint_id insertSegment(Index p, Index q)
  {
    const Vertex a = vertexOf(p);
    const Vertex b = vertexOf(q);
    return a == b ? Triangulation::Constraint_id() : cdt.insert_constraint(a, b);
  }

  void insertOutline()
  {
    const std::vector<Index> outline = outlineOf(face);
    for (int i = 0; i < 3; ++i)
    {
      vertexOf(face.corners[i]);
    }
    for (int i = 0; i < 3; ++i)
    {
      for (const Index p : face.alongEdges[i])
      {
        if (vertices.count(p) == 0)
        {
          addVertex(p, placeAlong(i, p));
        }
      }
    }
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
      const auto constraint = insertSegment(outline[i], outline[(i + 1) % outline.size()]);
      if (constraint != Triangulation::Constraint_id())
      {
        outlineConstraints.push_back(constraint);
      }
    }
  }

  static VertexPair pairOf(Vertex a, Vertex b) { return &*a < &*b ? VertexPair(a, b) : VertexPair(b, a); }

  /// Pieces of the outline that are walked an odd number of times bound the inside.
  std::set<VertexPair> boundary() const
  {
    std::set<VertexPair> odd;
    for (const auto& constraint : outlineConstraints)
    {
      auto next = cdt.vertices_in_constraint_begin(constraint);
      for (auto at = next++; next != cdt.vertices_in_constraint_end(constraint); at = next++)
      {
        const VertexPair piece = pairOf(*at, *next);
        if (!odd.erase(piece))
        {
          odd.insert(piece);
        }
      }
    }
    return odd;
  }

  void flood()
  {
    const std::set<VertexPair> odd = boundary();
    for (const Face f : cdt.all_face_handles())
    {
      f->info() = Side::unknown;
    }
    std::vector<Face> open{cdt.infinite_face()};
    open.back()->info() = Side::outside;
    while (!open.empty())
    {
      const Face f = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i)
      {
        const Face next = f->neighbor(i);
        if (next->info() == Side::unknown)
        {
          const bool crosses = odd.count(pairOf(f->vertex(cdt.cw(i)), f->vertex(cdt.ccw(i)))) != 0;
          next->info() = (f->info() == Side::inside) != crosses ? Side::inside : Side::outside;
          open.push_back(next);
        }
      }
    }
  }

  /// The point of the lattice nearest to the vertex, put on the face's plane.
  Index lift(Vertex vertex)
  {
    if (vertex->info().id == noIndex)
    {
      const LatticePoint& origin = points[face.corners[0]];
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      const long double x = vertex->point().x();
      const long double y = vertex->point().y();
      const auto n = [&](int i) { return static_cast<long double>(normal.n[i]); };
      LatticePoint p;
      p[u] = origin[u] + std::llroundl(x);
      p[v] = origin[v] + std::llroundl(y);
      p[axis] = origin[axis] + std::llroundl(-(n(u) * x + n(v) * y) / n(axis));
      vertex->info().id = static_cast<Index>(points.size());
      points.push_back(p);
    }
    return vertex->info().id;
  }

  void collect(std::vector<std::array<Index, 3>>& out)
  {
    const bool reversed = normal.n[axis] < 0;
    for (const Face f : cdt.finite_face_handles())
    {
      if (f->info() == Side::inside)
      {
        std::array<Index, 3> t{lift(f->vertex(0)), lift(f->vertex(1)), lift(f->vertex(2))};
        if (reversed)
        {
          std::swap(t[1], t[2]);
        }
        out.push_back(t);
      }
    }
  }

  std::vector<LatticePoint>& points;
  const DividedFace& face;
  const LatticeNormal& normal;
  int axis;
  double reach;
  Triangulation cdt;
  Vertex last;
  std::map<Index, Vertex> vertices;
  std::vector<Triangulation::Constraint_id> outlineConstraints;
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
