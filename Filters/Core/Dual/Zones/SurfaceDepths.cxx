// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/SurfaceDepths.h"

#include "Dual/Zones/ZoneFaces.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace atria {

namespace {

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

/// The point at the other end of an edge, whatever is between.
Index across(const Crossings& crossings, Index point, int direction)
{
  const std::int32_t code = crossings.neighbors[point][direction];
  return code >= 0                    ? static_cast<Index>(code)
         : DualMesh::isBoundary(code) ? crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite
                                      : noIndex;
}

/// By point and direction, how often the edge crosses a surface along its normal, less against it.
using Senses = std::map<std::pair<Index, std::uint8_t>, int>;

Senses sensesOf(Index surface, const std::vector<Index>& edges, const Crossings& crossings, const SurfaceModel& model)
{
  Senses senses;
  for (const Index e : edges)
  {
    const CrossedEdge& edge = crossings.crossedEdges[e];
    const int sense = senseOf(crossings.of(edge), surface, model);
    if (sense != 0 && edge.other != noIndex)
    {
      senses[{edge.point, edge.direction}] = sense;
      senses[{edge.other, static_cast<std::uint8_t>(opposite(edge.direction))}] = -sense;
    }
  }
  return senses;
}

/// Adds what another part has, whose depths are so much more. False where beyond the bounds they are others.
bool add(const DepthPart& other, int more, DepthPart& part)
{
  const auto less = [more](int depth) { return depth == DepthPart::none ? depth : depth - more; };
  part.least = std::min(part.least, less(other.least));
  part.beyondWalls = std::min(part.beyondWalls, less(other.beyondWalls));
  const bool agree =
      part.beyond == DepthPart::none || other.beyond == DepthPart::none || part.beyond == less(other.beyond);
  part.beyond = std::min(part.beyond, less(other.beyond));
  return agree;
}

/// Follows edges from point to point.
class Flood
{
public:
  Flood(const Box3& box, const Senses& ofEdges, const Crossings& found, const GridPlaces& gridPlaces, Index first,
        Index end)
      : bounds(box), senses(ofEdges), crossings(found), grid(gridPlaces), firstPoint(first), endPoint(end)
  {
  }

  bool isBeyond(Index point) const
  {
    const Vec3 p = toVector(grid.place(point));
    return (p.array() < bounds.min.array()).any() || (p.array() > bounds.max.array()).any();
  }

  void run(Index start)
  {
    if (!isInRow(start) || isBeyond(start) || depths.contains(start))
    {
      return;
    }
    const auto part = static_cast<Index>(out.parts.size());
    out.parts.emplace_back();
    depths[start] = 0;
    const std::size_t first = out.points.size();
    out.points.push_back({start, part, 0});
    for (std::size_t i = first; i < out.points.size(); ++i)
    {
      const PointDepth at = out.points[i];
      out.parts[part].least = std::min(out.parts[part].least, at.depth);
      for (std::uint8_t direction = 0; direction < 6; ++direction)
      {
        if (const Index other = across(crossings, at.point, direction); other != noIndex)
        {
          // Along the normal the way leads out.
          const auto sense = senses.find({at.point, direction});
          meet({other, part, at.depth - (sense == senses.end() ? 0 : sense->second)},
               crossings.neighbors[at.point][direction] >= 0);
        }
      }
    }
  }

  SurfaceDepths take()
  {
    std::ranges::sort(out.points, {}, &PointDepth::point);
    return std::move(out);
  }

private:
  bool isInRow(Index point) const { return point >= firstPoint && point < endPoint; }

  void meet(const PointDepth& met, bool isOpen)
  {
    if (isBeyond(met.point))
    {
      DepthPart beyond;
      (isOpen ? beyond.beyond : beyond.beyondWalls) = met.depth;
      out.isClosed = add(beyond, 0, out.parts[met.part]) && out.isClosed;
    }
    else if (!isInRow(met.point))
    {
      out.joints.push_back(met);
    }
    else if (const auto [known, isNew] = depths.try_emplace(met.point, met.depth); isNew)
    {
      out.points.push_back(met);
    }
    else
    {
      out.isClosed = out.isClosed && known->second == met.depth;
    }
  }

  const Box3& bounds;
  const Senses& senses;
  const Crossings& crossings;
  const GridPlaces& grid;
  Index firstPoint;
  Index endPoint;
  std::unordered_map<Index, int> depths; ///< of the points met
  SurfaceDepths out;
};

} // namespace

DepthFinder::DepthFinder(const Crossings& found, const GridPlaces& places, const SurfaceModel& surfaces, Index first,
                         Index end)
    : crossings(found), grid(places), model(surfaces), firstPoint(first), endPoint(end),
      bounds(boundsOfZones(surfaces)), edges(edgesOfZones(found, surfaces))
{
  const auto isElsewhere = [&](Index point) { return point != noIndex && (point < firstPoint || point >= endPoint); };
  const bool isWhole = firstPoint == 0 && endPoint == crossings.neighbors.size();
  for (Index point = firstPoint; point < endPoint && !isWhole; ++point)
  {
    bool isAtEnd = false;
    for (int direction = 0; direction < 6; ++direction)
    {
      isAtEnd = isAtEnd || isElsewhere(across(crossings, point, direction));
    }
    if (isAtEnd)
    {
      atEnds.push_back(point);
    }
  }
}

SurfaceDepths DepthFinder::find(Index surface) const
{
  const Senses senses = sensesOf(surface, edges[surface], crossings, model);
  Flood flood(bounds[surface], senses, crossings, grid, firstPoint, endPoint);
  for (const auto& [edge, sense] : senses)
  {
    flood.run(edge.first);
  }
  std::ranges::for_each(atEnds, [&](Index point) { flood.run(point); });
  SurfaceDepths out = flood.take();
  out.isMet = std::ranges::any_of(
      senses, [&](const auto& edge) { return edge.first.first >= firstPoint && edge.first.first < endPoint; });
  return out;
}

std::optional<std::vector<int>> depthsOutside(const std::vector<DepthPart>& parts, const std::vector<DepthLink>& links)
{
  std::vector<std::vector<std::pair<Index, int>>> beside(parts.size());
  for (const DepthLink& link : links)
  {
    beside[link.part].emplace_back(link.other, link.depth);
    beside[link.other].emplace_back(link.part, -link.depth);
  }
  std::vector<int> outside(parts.size());
  std::vector<int> zero(parts.size()); // the depth that is 0 in the first part of those joined
  std::vector<char> isKnown(parts.size(), 0);
  for (Index first = 0; first < parts.size(); ++first)
  {
    if (isKnown[first])
    {
      continue;
    }
    std::vector<Index> joined{first};
    isKnown[first] = 1;
    DepthPart all;
    for (std::size_t i = 0; i < joined.size(); ++i)
    {
      const Index at = joined[i];
      if (!add(parts[at], zero[at], all))
      {
        return std::nullopt;
      }
      for (const auto& [other, depth] : beside[at])
      {
        if (!isKnown[other])
        {
          isKnown[other] = 1;
          zero[other] = zero[at] + depth;
          joined.push_back(other);
        }
        else if (zero[other] != zero[at] + depth)
        {
          return std::nullopt;
        }
      }
    }
    const int depth = all.beyond != DepthPart::none        ? all.beyond
                      : all.beyondWalls != DepthPart::none ? all.beyondWalls
                                                           : all.least;
    std::ranges::for_each(joined, [&](Index at) { outside[at] = depth + zero[at]; });
  }
  return outside;
}

} // namespace atria
