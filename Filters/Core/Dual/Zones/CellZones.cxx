// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CellZones.h"

#include "Support/Error.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <unordered_map>

namespace atria {

namespace {

/// The points that one closed surface encloses.
class EnclosedPoints
{
public:
  /// `edges` are the crossed edges that the surface cuts.
  EnclosedPoints(Index s, const Box3& box, std::span<const Index> edges, const Crossings& found,
                 const GridPlaces& places, const SurfaceModel& surfaces)
      : surface(s), bounds(box), crossings(found), grid(places), model(surfaces)
  {
    for (const Index e : edges)
    {
      const CrossedEdge& edge = crossings.crossedEdges[e];
      int sense = 0;
      for (const SurfaceCrossing& cut : crossings.of(edge))
      {
        sense += model.surfaceIds[cut.triangle] == surface ? cut.orientation : 0;
      }
      if (sense != 0 && edge.other != noIndex)
      {
        senses[{edge.point, edge.direction}] = sense;
        senses[{edge.other, static_cast<std::uint8_t>(opposite(edge.direction))}] = -sense;
      }
    }
  }

  /// Rising. How often the surface lies about a point follows from the crossings on the way to it from beyond the
  /// surface's bounds.
  std::vector<Index> find()
  {
    std::vector<Index> inside;
    std::set<Index> seen;
    for (const auto& [edge, sense] : senses)
    {
      if (isBeyond(edge.first) || seen.contains(edge.first))
      {
        continue;
      }
      flood(edge.first);
      const int beyond = anchor();
      for (const Index point : front)
      {
        if (!isBeyond(point))
        {
          seen.insert(point);
        }
        if (depths.at(point) > beyond)
        {
          inside.push_back(point);
        }
      }
    }
    if (inside.empty() && !senses.empty())
    {
      fail();
    }
    std::ranges::sort(inside);
    return inside;
  }

private:
  [[noreturn]] void fail() const
  {
    throw Error("surface '" + model.names[surface] +
                "' is to enclose a cell zone, but it is not closed: close its holes, or leave it out");
  }

  bool isBeyond(Index point) const
  {
    const Vec3 p = toVector(grid.place(point));
    return (p.array() < bounds.min.array()).any() || (p.array() > bounds.max.array()).any();
  }

  /// The point at the other end of an edge, whatever is between.
  Index across(Index point, int direction) const
  {
    const std::int32_t code = crossings.neighbors[point][direction];
    return code >= 0                    ? static_cast<Index>(code)
           : DualMesh::isBoundary(code) ? crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite
                                        : noIndex;
  }

  /// Depths of the points about one, as far as the surface's bounds.
  void flood(Index start)
  {
    front.assign(1, start);
    depths.clear();
    depths[start] = 0;
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      const Index point = front[i];
      for (std::uint8_t direction = 0; direction < 6 && !isBeyond(point); ++direction)
      {
        const Index other = across(point, direction);
        if (other == noIndex)
        {
          continue;
        }
        // Along the normal the way leads out.
        const auto found = senses.find({point, direction});
        const int depth = depths.at(point) - (found == senses.end() ? 0 : found->second);
        const auto [known, isNew] = depths.try_emplace(other, depth);
        if (isNew)
        {
          front.push_back(other);
        }
        else if (known->second != depth)
        {
          fail();
        }
      }
    }
  }

  /// The depth of the points that are surely not enclosed.
  int anchor() const
  {
    const auto beyond = std::ranges::find_if(front, [&](Index point) { return isBeyond(point); });
    const auto depth = [&](Index point) { return depths.at(point); };
    return beyond != front.end() ? depth(*beyond) : depth(std::ranges::min(front, {}, depth));
  }

  Index surface;
  const Box3& bounds;
  const Crossings& crossings;
  const GridPlaces& grid;
  const SurfaceModel& model;
  /// By point and direction, how often the edge crosses the surface along its normal, less against it.
  std::map<std::pair<Index, std::uint8_t>, int> senses;
  std::unordered_map<Index, int> depths;
  std::vector<Index> front;
};

/// By surface that is a cell zone.
std::vector<Box3> boundsOfZones(const SurfaceModel& model)
{
  std::vector<Box3> bounds(model.names.size());
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (model.kindOf(t) == SurfaceKind::cellZone)
    {
      bounds[model.surfaceIds[t]].extend(model.bounds(t).min);
      bounds[model.surfaceIds[t]].extend(model.bounds(t).max);
    }
  }
  return bounds;
}

/// By surface that is a cell zone the crossed edges that it cuts.
std::vector<std::vector<Index>> edgesOfZones(const Crossings& crossings, const SurfaceModel& model)
{
  std::vector<std::vector<Index>> edges(model.names.size());
  for (Index e = 0; e < crossings.crossedEdges.size(); ++e)
  {
    for (const SurfaceCrossing& cut : crossings.of(crossings.crossedEdges[e]))
    {
      if (model.kindOf(cut.triangle) == SurfaceKind::cellZone)
      {
        std::vector<Index>& of = edges[model.surfaceIds[cut.triangle]];
        if (of.empty() || of.back() != e)
        {
          of.push_back(e);
        }
      }
    }
  }
  return edges;
}

} // namespace

std::vector<std::int32_t> findCellZones(const Crossings& crossings, const GridPlaces& grid, const SurfaceModel& model,
                                        const RunContext& context)
{
  if (std::ranges::find(model.kinds, SurfaceKind::cellZone) == model.kinds.end())
  {
    return {};
  }
  std::vector<std::int32_t> zoneOf(crossings.neighbors.size(), noCellZone);
  const std::vector<Box3> bounds = boundsOfZones(model);
  const std::vector<std::vector<Index>> edges = edgesOfZones(crossings, model);
  for (Index surface = 0; surface < edges.size(); ++surface)
  {
    context.progress.check();
    for (const Index point : EnclosedPoints(surface, bounds[surface], edges[surface], crossings, grid, model).find())
    {
      zoneOf[point] = zoneOf[point] == noCellZone ? static_cast<std::int32_t>(surface) : zoneOf[point];
    }
  }
  return zoneOf;
}

std::vector<std::string> warningsOfEmptyCellZones(std::span<const std::int32_t> zones, const SurfaceModel& model)
{
  const std::set<std::int32_t> met(zones.begin(), zones.end());
  std::vector<std::string> warnings;
  for (std::size_t surface = 0; surface < model.kinds.size(); ++surface)
  {
    if (model.kinds[surface] == SurfaceKind::cellZone && !met.contains(static_cast<std::int32_t>(surface)))
    {
      warnings.push_back("cell zone '" + model.names[surface] +
                         "' holds no element: it is outside of the mesh, within another zone, or smaller than elements "
                         "there; if so, give its surface a size");
    }
  }
  return warnings;
}

} // namespace atria
