// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Inspection/Inspection.h"

#include "Support/Error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace atria {

namespace {

void validate(const TriangleSurface& surface, double tolerance)
{
  if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
  {
    throw Error("the tolerance for merging points must be zero or more, not " + std::to_string(tolerance));
  }
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

/// Finds one representative for all points of a place.
class Places
{
public:
  Places(const std::vector<Vec3>& source, double distance)
      : points(source), tolerance(distance), parents(source.size()), order(source.size())
  {
    std::iota(parents.begin(), parents.end(), Index{0});
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return less(a, b); });
    tolerance > 0.0 ? mergeNear() : mergeEqual();
  }

  Index of(Index point)
  {
    while (parents[point] != point)
    {
      parents[point] = parents[parents[point]];
      point = parents[point];
    }
    return point;
  }

private:
  bool less(Index a, Index b) const
  {
    const Vec3& p = points[a];
    const Vec3& q = points[b];
    return std::tuple(p.x(), p.y(), p.z(), a) < std::tuple(q.x(), q.y(), q.z(), b);
  }

  void mergeEqual()
  {
    for (std::size_t i = 1; i < order.size(); ++i)
    {
      if (points[order[i]] == points[order[i - 1]])
      {
        parents[order[i]] = of(order[i - 1]);
      }
    }
  }

  /// Cells of the tolerance's size hold the candidates: neighbors are in the 27 cells around.
  void mergeNear()
  {
    using Cell = std::array<double, 3>; // whole numbers; doubles, since a cell number may exceed every integer type
    const auto cellOf = [&](Index i) {
      const Vec3& p = points[i];
      return Cell{std::floor(p.x() / tolerance), std::floor(p.y() / tolerance), std::floor(p.z() / tolerance)};
    };
    std::vector<std::pair<Cell, Index>> cells;
    for (const Index i : order)
    {
      cells.emplace_back(cellOf(i), i);
    }
    std::sort(cells.begin(), cells.end());
    for (const auto& [cell, i] : cells)
    {
      for (double x = -1; x <= 1; ++x)
      {
        for (double y = -1; y <= 1; ++y)
        {
          // Cells that differ in z only follow each other.
          const Cell first{cell[0] + x, cell[1] + y, cell[2] - 1};
          const Cell last{cell[0] + x, cell[1] + y, cell[2] + 1};
          for (auto it = std::lower_bound(cells.begin(), cells.end(), std::pair(first, Index{0}));
               it != cells.end() && it->first <= last; ++it)
          {
            if (it->second < i && (points[it->second] - points[i]).norm() <= tolerance)
            {
              join(it->second, i);
            }
          }
        }
      }
    }
  }

  void join(Index a, Index b)
  {
    const auto [low, high] = std::minmax({of(a), of(b)});
    parents[high] = low;
  }

  const std::vector<Vec3>& points;
  double tolerance;
  std::vector<Index> parents;
  std::vector<Index> order;
};

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

Inspection inspect(const TriangleSurface& surface, double tolerance)
{
  validate(surface, tolerance);
  Inspection out;
  for (const std::string& name : surface.names)
  {
    out.surfaces.emplace_back().name = name;
  }
  Places places(surface.points, tolerance);
  std::vector<Edge> edges;
  std::vector<Index> used;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    const auto& t = surface.triangles[i];
    const Index id = surface.surfaceIds[i];
    const std::array<Index, 3> at{places.of(t[0]), places.of(t[1]), places.of(t[2])};
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
  std::sort(used.begin(), used.end());
  out.points = static_cast<std::size_t>(std::unique(used.begin(), used.end()) - used.begin());
  return out;
}

} // namespace atria
