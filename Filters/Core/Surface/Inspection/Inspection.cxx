// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Inspection/Inspection.h"

#include "Support/Error.h"
#include "Support/Sorting.h"
#include "Surface/Triangles/PointPlaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace atria {

namespace {

void validate(const TriangleSurface& surface)
{
  if (surface.surfaceIds.size() != surface.triangles.size())
  {
    throw Error("the model has " + std::to_string(surface.triangles.size()) + " triangles but " +
                std::to_string(surface.surfaceIds.size()) + " surface ids");
  }
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    for (const Index p : surface.triangles[i])
    {
      if (p >= surface.points.size() || !surface.points[p].allFinite())
      {
        throw Error("triangle " + std::to_string(i) + " has a point that does not exist or is not finite");
      }
    }
    if (surface.surfaceIds[i] >= surface.names.size())
    {
      throw Error("triangle " + std::to_string(i) + " belongs to a surface without a name");
    }
  }
}

struct Edge
{
  Index a;
  Index b;
  Index surface;
  auto operator<=>(const Edge&) const = default;
};

void countUses(SurfaceSummary& summary, std::size_t uses)
{
  summary.openEdges += uses == 1 ? 1 : 0;
  summary.nonManifoldEdges += uses > 2 ? 1 : 0;
}

void countEdges(Inspection& out, std::vector<Edge>& edges)
{
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();)
  {
    const std::size_t first = i;
    while (i < edges.size() && edges[i].a == edges[first].a && edges[i].b == edges[first].b)
    {
      const std::size_t ofSurface = i;
      while (i < edges.size() && edges[i] == edges[ofSurface])
      {
        ++i;
      }
      countUses(out.surfaces[edges[ofSurface].surface], i - ofSurface);
    }
    countUses(out.total, i - first);
  }
}

void addTriangle(SurfaceSummary& summary, const std::array<Vec3, 3>& corners, double area, bool degenerate)
{
  ++summary.triangles;
  summary.degenerate += degenerate ? 1 : 0;
  summary.area += area;
  for (const Vec3& p : corners)
  {
    summary.bounds.extend(p);
  }
}

} // namespace

Inspection inspect(const TriangleSurface& surface)
{
  validate(surface);
  Inspection out;
  for (const std::string& name : surface.names)
  {
    out.surfaces.emplace_back().name = name;
  }
  const std::vector<Index> places = placesOf(surface.points, 0.0);
  std::vector<Edge> edges;
  std::vector<Index> used;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    const auto& t = surface.triangles[i];
    const Index id = surface.surfaceIds[i];
    const std::array<Index, 3> at{places[t[0]], places[t[1]], places[t[2]]};
    const std::array<Vec3, 3> corners{surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
    const double area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
    const bool degenerate = at[0] == at[1] || at[1] == at[2] || at[2] == at[0] || !(area > 0.0);
    addTriangle(out.surfaces[id], corners, area, degenerate);
    addTriangle(out.total, corners, area, degenerate);
    used.insert(used.end(), at.begin(), at.end());
    for (int k = 0; k < 3 && !degenerate; ++k)
    {
      const auto [a, b] = std::minmax(at[k], at[(k + 1) % 3]);
      edges.push_back({a, b, id});
    }
  }
  countEdges(out, edges);
  sortUnique(used);
  out.points = used.size();
  return out;
}

} // namespace atria
