// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <set>
#include <utility>

namespace atria {

namespace {

/// The point of a vertex, which is missing at first where segments cross; or the region of a face.
struct Number
{
  Index value = noIndex;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Number, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
/// A triangulation that knows into which edges a segment was cut.
template <typename Crossing>
using Triangulation =
    CGAL::Constrained_triangulation_plus_2<CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, Crossing>>;

/// Makes one triangulation.
template <typename Crossing> class Plane
{
public:
  Plane(std::span<const Vec2> points_, std::span<const std::array<Index, 2>> segments_, const PlanarOutline& outline_)
      : points(points_), segments(segments_), outline(outline_)
  {
    out.points.assign(points.begin(), points.end());
    vertices.reserve(points.size());
  }

  PlanarTriangulation run()
  {
    insertPoints(outline.points);
    insertSegments(0, outline.segments);
    insertPoints(points.size());
    insertSegments(outline.segments, segments.size());
    if (plane.dimension() == 2)
    {
      numberCrossings();
      if (out.simple)
      {
        findRegions();
      }
      collect();
    }
    return std::move(out);
  }

private:
  using Cgal = Triangulation<Crossing>;
  using Vertex = typename Cgal::Vertex_handle;
  using Face = typename Cgal::Face_handle;
  using Edge = std::pair<Vertex, Vertex>;

  bool hasOutline() const { return outline.points > 0; }
  static Edge edgeOf(Vertex a, Vertex b) { return &*a < &*b ? Edge(a, b) : Edge(b, a); }

  void insertPoints(std::size_t end)
  {
    for (std::size_t i = vertices.size(); i < end; ++i)
    {
      const Face near = vertices.empty() ? Face() : vertices.back()->face();
      vertices.push_back(plane.insert({points[i][0], points[i][1]}, near));
      Index& number = vertices.back()->info().value;
      number = number == noIndex ? static_cast<Index>(i) : number;
    }
  }

  void insertSegments(std::size_t begin, std::size_t end)
  {
    for (const auto& [a, b] : segments.subspan(begin, end - begin))
    {
      if (vertices[a] == vertices[b])
      {
        continue;
      }
      try
      {
        constraints.push_back(plane.insert_constraint(vertices[a], vertices[b]));
      }
      catch (const typename Cgal::Intersection_of_constraints_exception&)
      {
        out.simple = false;
      }
    }
    if (begin == 0)
    {
      outlineConstraints = constraints.size();
    }
  }

  void numberCrossings()
  {
    for (const Vertex vertex : plane.finite_vertex_handles())
    {
      if (vertex->info().value == noIndex)
      {
        vertex->info().value = static_cast<Index>(out.points.size());
        out.points.emplace_back(vertex->point().x(), vertex->point().y());
      }
    }
  }

  /// Returns the edges of the outline that are walked an odd number of times.
  std::set<Edge> boundary() const
  {
    std::set<Edge> odd;
    for (std::size_t i = 0; i < outlineConstraints; ++i)
    {
      auto next = plane.vertices_in_constraint_begin(constraints[i]);
      for (auto at = next++; next != plane.vertices_in_constraint_end(constraints[i]); at = next++)
      {
        const Edge edge = edgeOf(*at, *next);
        if (!odd.erase(edge))
        {
          odd.insert(edge);
        }
      }
    }
    return odd;
  }

  void findRegions()
  {
    const std::set<Edge> odd = boundary();
    flood(plane.infinite_face(), odd);
    for (const Face face : plane.finite_face_handles())
    {
      if (face->info().value == noIndex)
      {
        flood(face, odd);
      }
    }
    out.regionCount = hasOutline() ? 2 : out.regionCount;
  }

  /// Gives the next region number to all faces reached from the first one. Crossing an edge of an outline changes
  /// sides. Without an outline, segments are not crossed.
  void flood(Face first, const std::set<Edge>& odd)
  {
    std::vector<Face> open{first};
    first->info().value = out.regionCount++;
    while (!open.empty())
    {
      const Face face = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i)
      {
        const Face next = face->neighbor(i);
        if (next->info().value != noIndex)
        {
          continue;
        }
        if (hasOutline())
        {
          const bool crosses = odd.count(edgeOf(face->vertex(Cgal::cw(i)), face->vertex(Cgal::ccw(i)))) != 0;
          next->info().value = face->info().value ^ Index { crosses };
          open.push_back(next);
        }
        else if (!plane.is_constrained({face, i}))
        {
          next->info().value = face->info().value;
          open.push_back(next);
        }
      }
    }
  }

  void collect()
  {
    for (const Face face : plane.finite_face_handles())
    {
      out.triangles.push_back(
          {face->vertex(0)->info().value, face->vertex(1)->info().value, face->vertex(2)->info().value});
      if (out.simple)
      {
        out.regions.push_back(face->info().value);
      }
    }
  }

  std::span<const Vec2> points;
  std::span<const std::array<Index, 2>> segments;
  const PlanarOutline& outline;
  Cgal plane;
  std::vector<Vertex> vertices;
  std::vector<typename Cgal::Constraint_id> constraints;
  std::size_t outlineConstraints = 0;
  PlanarTriangulation out;
};

} // namespace

PlanarTriangulation triangulatePlane(std::span<const Vec2> points, std::span<const std::array<Index, 2>> segments,
                                     const PlanarOutline& outline)
{
  return outline.cutsCrossings
             ? Plane<CGAL::Exact_predicates_tag>(points, segments, outline).run()
             : Plane<CGAL::No_constraint_intersection_requiring_constructions_tag>(points, segments, outline).run();
}

} // namespace atria
