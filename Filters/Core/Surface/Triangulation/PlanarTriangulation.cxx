// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace atria {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// A vertex's point; none, at first, where segments cross.
struct Number
{
  Index value = noIndex;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
/// A face knows whether it is outside.
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<char, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

void markOutside(Triangulation& plane)
{
  for (auto face = plane.all_faces_begin(); face != plane.all_faces_end(); ++face)
  {
    face->info() = 0;
  }
  std::vector<Triangulation::Face_handle> open{plane.infinite_face()};
  open.front()->info() = 1;
  while (!open.empty())
  {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i)
    {
      const Triangulation::Face_handle next = face->neighbor(i);
      if (next->info() == 0 && !plane.is_constrained({face, i}))
      {
        next->info() = 1;
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
  markOutside(plane);
  for (auto face = plane.finite_faces_begin(); face != plane.finite_faces_end(); ++face)
  {
    out.triangles.push_back(
        {face->vertex(0)->info().value, face->vertex(1)->info().value, face->vertex(2)->info().value});
    out.outside.push_back(face->info());
  }
  return out;
}

} // namespace atria
