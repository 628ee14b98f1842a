// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/SurfaceDepths.h"

#include "Dual/Zones/ZoneFaces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <map>
#include <span>

namespace atria {

namespace {

/// Returns bounds per surface; empty ones for surfaces that are no cell zone.
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

/// Returns the crossed edges that each surface cuts; none for surfaces that are no cell zone.
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

std::uint64_t keyOf(Index point, int direction) { return 6 * static_cast<std::uint64_t>(point) + direction; }

OpenEdges findOpenEdges(const Crossings& crossings, const SurfaceModel& model)
{
  OpenEdges surfaces;
  for (const CrossedEdge& edge : crossings.crossedEdges)
  {
    const std::span<const SurfaceCrossing> cuts = crossings.of(edge);
    if (edge.other == noIndex || crossings.neighbors[edge.point][edge.direction] < 0)
    {
      continue;
    }
    const Index first = model.surfaceIds[cuts.front().triangle];
    const bool isOne =
        std::ranges::all_of(cuts, [&](const SurfaceCrossing& cut) { return model.surfaceIds[cut.triangle] == first; });
    surfaces[keyOf(edge.point, edge.direction)] = isOne ? first : noIndex;
    surfaces[keyOf(edge.other, opposite(edge.direction))] = isOne ? first : noIndex;
  }
  return surfaces;
}

/// Returns the point at the other end of an edge, whatever is between.
Index across(const Crossings& crossings, Index point, int direction)
{
  const std::int32_t code = crossings.neighbors[point][direction];
  return code >= 0                    ? static_cast<Index>(code)
         : DualMesh::isBoundary(code) ? crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite
                                      : noIndex;
}

/// Number of crossings of an edge, given by point and direction, along a surface's normal, minus those against it.
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

/// Adds another part, whose depths are higher by `more`. Returns false if the depths beyond the bounds disagree.
bool add(const DepthPart& other, int more, DepthPart& part)
{
  const auto less = [more](int depth) { return depth == DepthPart::none ? depth : depth - more; };
  part.least = std::min(part.least, less(other.least));
  part.beyondOthers = std::min(part.beyondOthers, less(other.beyondOthers));
  const bool agree =
      part.beyond == DepthPart::none || other.beyond == DepthPart::none || part.beyond == less(other.beyond);
  part.beyond = std::min(part.beyond, less(other.beyond));
  return agree;
}

/// Follows edges from point to point, and starts another part behind edges that cross other surfaces.
class Flood
{
public:
  Flood(Index ofSurface, const Box3& box, const Senses& ofEdges, const OpenEdges& open, const Crossings& found,
        const GridPlaces& gridPlaces, Index first, Index end)
      : surface(ofSurface), bounds(box), senses(ofEdges), openEdges(open), crossings(found), grid(gridPlaces),
        firstPoint(first), endPoint(end)
  {
  }

  void run(Index start)
  {
    if (!isInRow(start) || isBeyond(start) || places.contains(start))
    {
      return;
    }
    const auto part = static_cast<Index>(out.parts.size());
    out.parts.emplace_back();
    const auto first = static_cast<Index>(out.points.size());
    add({start, part, 0});
    for (Index i = first; i < out.points.size(); ++i)
    {
      const PointDepth at = out.points[i];
      out.parts[part].least = std::min(out.parts[part].least, at.depth);
      for (std::uint8_t direction = 0; direction < 6; ++direction)
      {
        if (const Index other = across(crossings, at.point, direction); other != noIndex)
        {
          // A way along the normal leads out.
          const auto sense = senses.find({at.point, direction});
          meet({other, part, at.depth - (sense == senses.end() ? 0 : sense->second)}, isSure(at.point, direction));
        }
      }
    }
  }

  SurfaceDepths take()
  {
    for (std::size_t i = 0; i < behindOthers.size(); ++i)
    {
      run(behindOthers[i].point);
    }
    for (const PointDepth& seen : behindOthers)
    {
      if (const PointDepth& at = out.points[places.at(seen.point)]; at.part != seen.part)
      {
        out.links.push_back({seen.part, at.part, at.depth - seen.depth, false});
      }
    }
    sortUnique(out.links);
    std::ranges::sort(out.points, {}, &PointDepth::point);
    return std::move(out);
  }

private:
  bool isInRow(Index point) const { return point >= firstPoint && point < endPoint; }

  bool isBeyond(Index point) const
  {
    const Vec3 p = toVector(grid.place(point));
    return (p.array() < bounds.min.array()).any() || (p.array() > bounds.max.array()).any();
  }

  /// True if an edge crosses no other surface.
  bool isSure(Index point, int direction) const
  {
    const auto found = openEdges.find(keyOf(point, direction));
    return crossings.neighbors[point][direction] >= 0 && (found == openEdges.end() || found->second == surface);
  }

  void add(const PointDepth& met)
  {
    places[met.point] = static_cast<Index>(out.points.size());
    out.points.push_back(met);
  }

  void meet(const PointDepth& met, bool sure)
  {
    if (isBeyond(met.point))
    {
      DepthPart beyond;
      (sure ? beyond.beyond : beyond.beyondOthers) = met.depth;
      out.isClosed = atria::add(beyond, 0, out.parts[met.part]) && out.isClosed;
    }
    else if (!isInRow(met.point))
    {
      out.joints.push_back({met, sure});
    }
    else if (!sure)
    {
      behindOthers.push_back(met);
    }
    else if (const auto known = places.find(met.point); known == places.end())
    {
      add(met);
    }
    else
    {
      out.isClosed = out.isClosed && out.points[known->second].depth == met.depth;
    }
  }

  Index surface;
  const Box3& bounds;
  const Senses& senses;
  const OpenEdges& openEdges;
  const Crossings& crossings;
  const GridPlaces& grid;
  Index firstPoint;
  Index endPoint;
  std::unordered_map<Index, Index> places; ///< places of points in the list of points
  std::vector<PointDepth> behindOthers;    ///< points in the row behind other surfaces, as seen from a part
  SurfaceDepths out;
};

/// Groups of parts that sure links join. The parts of a group have one depth outside.
class JoinedParts
{
public:
  JoinedParts(const std::vector<DepthPart>& given, const std::vector<DepthLink>& givenLinks)
      : parts(given), links(givenLinks), zero(given.size()), groupOf(given.size(), noIndex)
  {
  }

  /// Joins the parts. Returns false if ways lead to different depths.
  bool join()
  {
    std::vector<std::vector<std::pair<Index, int>>> beside(parts.size());
    for (const DepthLink& link : links)
    {
      if (link.isSure)
      {
        beside[link.part].emplace_back(link.other, link.depth);
        beside[link.other].emplace_back(link.part, -link.depth);
      }
    }
    bool agree = true;
    for (Index first = 0; first < parts.size() && agree; ++first)
    {
      agree = groupOf[first] != noIndex || joinFrom(first, beside);
    }
    return agree;
  }

  std::vector<int> depthsOutside() const
  {
    std::vector<int> outside(groups.size());
    std::ranges::transform(groups, outside.begin(), &DepthPart::beyond);
    while (settleMore(outside))
    {
    }
    std::vector<int> out(parts.size());
    for (Index part = 0; part < parts.size(); ++part)
    {
      const Index group = groupOf[part];
      out[part] = zero[part] + (outside[group] == DepthPart::none ? groups[group].least : outside[group]);
    }
    return out;
  }

private:
  bool joinFrom(Index first, const std::vector<std::vector<std::pair<Index, int>>>& beside)
  {
    const auto group = static_cast<Index>(groups.size());
    DepthPart& all = groups.emplace_back(parts[first]);
    std::vector<Index> joined{first};
    groupOf[first] = group;
    bool agree = true;
    for (std::size_t i = 0; i < joined.size() && agree; ++i)
    {
      const Index at = joined[i];
      agree = add(parts[at], zero[at], all);
      for (const auto& [other, depth] : beside[at])
      {
        if (groupOf[other] == noIndex)
        {
          groupOf[other] = group;
          zero[other] = zero[at] + depth;
          joined.push_back(other);
        }
        agree = agree && zero[other] == zero[at] + depth;
      }
    }
    return agree;
  }

  /// Gives groups without a depth outside the least one beyond other surfaces. Returns true if some got one; others may
  /// then follow.
  bool settleMore(std::vector<int>& outside) const
  {
    std::vector<int> next = outside;
    const auto lower = [&](Index group, int depth) {
      next[group] = outside[group] == DepthPart::none ? std::min(next[group], depth) : next[group];
    };
    for (Index group = 0; group < groups.size(); ++group)
    {
      lower(group, groups[group].beyondOthers);
    }
    for (const DepthLink& link : links)
    {
      const Index one = groupOf[link.part];
      const Index other = groupOf[link.other];
      const int more = zero[link.part] + link.depth - zero[link.other]; // excess of the other's depths
      if (outside[other] != DepthPart::none)
      {
        lower(one, outside[other] - more);
      }
      if (outside[one] != DepthPart::none)
      {
        lower(other, outside[one] + more);
      }
    }
    const bool isMore = next != outside;
    outside = std::move(next);
    return isMore;
  }

  const std::vector<DepthPart>& parts;
  const std::vector<DepthLink>& links;
  std::vector<int> zero; ///< one per part: the depth that is 0 in its group
  std::vector<Index> groupOf;
  std::vector<DepthPart> groups;
};

} // namespace

DepthFinder::DepthFinder(const Crossings& found, const GridPlaces& places, const SurfaceModel& surfaces, Index first,
                         Index end)
    : crossings(found), grid(places), model(surfaces), firstPoint(first), endPoint(end),
      bounds(boundsOfZones(surfaces)), edges(edgesOfZones(found, surfaces)), openEdges(findOpenEdges(found, surfaces))
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
  Flood flood(surface, bounds[surface], senses, openEdges, crossings, grid, firstPoint, endPoint);
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
  JoinedParts joined(parts, links);
  return joined.join() ? std::optional(joined.depthsOutside()) : std::nullopt;
}

} // namespace atria
