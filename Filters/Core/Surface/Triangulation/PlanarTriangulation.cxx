// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace atria {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// A vertex's point, which there is none of at first where segments cross; or a face's region.
struct Number
{
  Index value = noIndex;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
/// A face knows its region.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<Number, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

/// Gives a region to the faces one comes to from one without passing through a segment.
void markRegion(Triangulation& plane, Triangulation::Face_handle first, Index region)
{
  std::vector<Triangulation::Face_handle> open{first};
  first->info().value = region;
  while (!open.empty())
  {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i)
    {
      const Triangulation::Face_handle next = face->neighbor(i);
      if (next->info().value == noIndex && !plane.is_constrained({face, i}))
      {
        next->info().value = region;
        open.push_back(next);
      }
    }
  }
}

} // namespace

PlanarTriangulation triangulatePlane(std::span<const Vec2> points, std::span<const std::array<Index, 2>> segments)
{
  Triangulation plane;
  std::vector<Triangulation::Vertex_handle> vertices;
  Triangulation::Face_handle near;
  for (Index i = 0; i < points.size(); ++i)
  {
    const auto vertex = plane.insert({points[i][0], points[i][1]}, near);
    if (vertex->info().value == noIndex)
    {
      vertex->info().value = i;
    }
    near = vertex->face();
    vertices.push_back(vertex);
  }
  for (const auto& [a, b] : segments)
  {
    if (vertices[a] != vertices[b])
    {
      plane.insert_constraint(vertices[a], vertices[b]);
    }
  }
  PlanarTriangulation out;
  out.points.assign(points.begin(), points.end());
  for (auto vertex = plane.finite_vertices_begin(); vertex != plane.finite_vertices_end(); ++vertex)
  {
    if (vertex->info().value == noIndex)
    {
      vertex->info().value = static_cast<Index>(out.points.size());
      out.points.emplace_back(vertex->point().x(), vertex->point().y());
    }
  }
  markRegion(plane, plane.infinite_face(), out.regionCount++);
  for (auto face = plane.finite_faces_begin(); face != plane.finite_faces_end(); ++face)
  {
    if (face->info().value == noIndex)
    {
      markRegion(plane, face, out.regionCount++);
    }
    out.triangles.push_back(
        {face->vertex(0)->info().value, face->vertex(1)->info().value, face->vertex(2)->info().value});
    out.regions.push_back(face->info().value);
  }
  return out;
}

} // namespace atria
