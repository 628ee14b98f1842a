// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Leaks.h"

#include "Dual/Zones/Clearance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <set>
#include <tuple>

namespace atria {

namespace {

/// Finds ways in one zone.
class WayFinder
{
public:
  WayFinder(const Crossings& found, const Clearance& distances, std::size_t surfaces)
      : crossings(found), clearance(distances), surfaceCount(surfaces), parents(found.neighbors.size(), noIndex)
  {
  }

  /// Returns the face of an open side, other than the bottom, that a point reaches, or null.
  const BoundaryFace* exitAt(Index point) const
  {
    for (const std::uint8_t direction : {zMax, xMin, xMax, yMin, yMax})
    {
      const std::int32_t code = crossings.neighbors[point][direction];
      if (DualMesh::isBoundary(code))
      {
        const BoundaryFace& face = crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)];
        if (face.onDomainSide && face.tag >= surfaceCount)
        {
          return &face;
        }
      }
    }
    return nullptr;
  }

  /// Returns the number of the side that a face is on.
  Index sideOf(const BoundaryFace& face) const { return face.tag - static_cast<Index>(surfaceCount); }

  /// Returns the widest way to an open side. All ways on a tree that grows by its widest edges are widest (Prim 1957).
  std::vector<Index> widest(Index from)
  {
    struct Step
    {
      double clearance;
      Index from;
      Index to;
      bool operator<(const Step& other) const
      {
        return std::tuple(clearance, other.from, other.to) < std::tuple(other.clearance, from, to);
      }
    };
    std::priority_queue<Step> front;
    front.push({0.0, from, from});
    while (!front.empty())
    {
      const Step step = front.top();
      front.pop();
      if (parents[step.to] != noIndex)
      {
        continue;
      }
      parents[step.to] = step.from;
      if (exitAt(step.to))
      {
        return wayTo(step.to);
      }
      for (const std::int32_t code : crossings.neighbors[step.to])
      {
        if (code >= 0 && parents[code] == noIndex)
        {
          const auto other = static_cast<Index>(code);
          front.push({clearance.ofEdge(step.to, other).distance, step.to, other});
        }
      }
    }
    return {};
  }

  /// Returns the shortest way from `from` to `to`, or to an open side if `to` is noIndex, with at least `least`
  /// clearance and none of the points in `closed`; empty if there is none.
  std::vector<Index> shortest(Index from, Index to, double least, const std::set<Index>& closed)
  {
    std::fill(parents.begin(), parents.end(), noIndex);
    using Step = std::tuple<double, Index, Index>; // length so far, point, the one before
    std::priority_queue<Step, std::vector<Step>, std::greater<>> front;
    front.push({0.0, from, from});
    while (!front.empty())
    {
      const auto [length, point, before] = front.top();
      front.pop();
      if (parents[point] != noIndex)
      {
        continue;
      }
      parents[point] = before;
      if (to == noIndex ? exitAt(point) != nullptr : point == to)
      {
        return wayTo(point);
      }
      for (const std::int32_t code : crossings.neighbors[point])
      {
        if (code < 0 || parents[code] != noIndex || closed.count(static_cast<Index>(code)) != 0)
        {
          continue;
        }
        const auto other = static_cast<Index>(code);
        if (clearance.ofEdge(point, other).distance >= least)
        {
          front.push({length + (clearance.position(other) - clearance.position(point)).norm(), other, point});
        }
      }
    }
    return {};
  }

private:
  std::vector<Index> wayTo(Index point) const
  {
    std::vector<Index> way{point};
    while (parents[way.back()] != way.back())
    {
      way.push_back(parents[way.back()]);
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

  const Crossings& crossings;
  const Clearance& clearance;
  std::size_t surfaceCount;
  std::vector<Index> parents;
};

std::vector<Clearance::OfEdge> clearancesAlong(const std::vector<Index>& way, const Clearance& clearance)
{
  std::vector<Clearance::OfEdge> edges;
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
  {
    edges.push_back(clearance.ofEdge(way[i], way[i + 1]));
  }
  return edges;
}

/// Returns the edges of a way to search for its narrowest place, narrowest first. These are clearly narrower than the
/// way was before, so that a seed close to a wall does not count; if there is none, the one that is narrowest compared
/// with the way before. Only those nearly as narrow as the narrowest are kept, and the neighbors of that: a grid point
/// close to a wall makes edges beside the gap seem narrow.
std::vector<std::size_t> narrowEdges(const std::vector<Clearance::OfEdge>& edges)
{
  constexpr double clearlyNarrower = 0.75;
  constexpr double nearlyAsNarrow = 1.3;
  constexpr std::size_t most = 64;
  std::vector<std::size_t> narrow;
  double widest = 0.0;
  double leastRatio = std::numeric_limits<double>::infinity();
  std::size_t tightest = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const double clearance = edges[i].distance;
    widest = std::max(widest, clearance);
    if (clearance <= clearlyNarrower * widest)
    {
      narrow.push_back(i);
    }
    if (widest > 0.0 && clearance / widest < leastRatio)
    {
      leastRatio = clearance / widest;
      tightest = i;
    }
  }
  if (narrow.empty())
  {
    narrow.push_back(tightest);
  }
  std::stable_sort(narrow.begin(), narrow.end(),
                   [&](std::size_t l, std::size_t r) { return edges[l].distance < edges[r].distance; });
  const std::size_t neck = narrow.front();
  const auto wider = std::find_if(narrow.begin(), narrow.end(), [&](std::size_t i) {
    return edges[i].distance > nearlyAsNarrow * edges[neck].distance;
  });
  narrow.erase(wider, narrow.end());
  narrow.resize(std::min(narrow.size(), most));
  for (const std::size_t i : {neck - 1, neck + 1})
  {
    if (i < edges.size() && std::find(narrow.begin(), narrow.end(), i) == narrow.end())
    {
      narrow.push_back(i);
    }
  }
  return narrow;
}

double leastOf(const std::vector<Clearance::OfEdge>& edges, std::size_t begin, std::size_t end)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = begin; i < end; ++i)
  {
    least = std::min(least, edges[i].distance);
  }
  return least;
}

/// Returns a way with, on either side of the neck, the shortest way that is as wide as the given one. The widest way
/// keeps to the middle of every space it passes.
std::vector<Index> shorten(const std::vector<Index>& way, const std::vector<Clearance::OfEdge>& edges, std::size_t neck,
                           WayFinder& finder)
{
  std::vector<Index> out = finder.shortest(way.front(), way[neck], leastOf(edges, 0, neck), {way[neck + 1]});
  if (out.empty())
  {
    return way;
  }
  const std::set<Index> used(out.begin(), out.end());
  const std::vector<Index> rest = finder.shortest(way[neck + 1], noIndex, leastOf(edges, neck + 1, edges.size()), used);
  if (rest.empty())
  {
    return way;
  }
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

/// Returns the place of the leak's side that is nearest to a point.
Vec3 onSide(const Leak& leak, const Vec3& point, const GridFrame& frame)
{
  Vec3 end = point;
  if (!frame.turnedDomain || !isUprightSide(leak.side))
  {
    end[axisOf(leak.direction)] = frame.planeOf(leak.direction);
    return end;
  }
  const Placement relative(frame.turnedDomain->axes.angle() - frame.placement.angle());
  end = relative.fromModel(end);
  end.head<2>() = frame.turnedDomain->nearest(end.head<2>(), SideBits{1} << leak.side);
  return relative.toModel(end);
}

void drawPath(Leak& leak, const Clearance& clearance, const GridFrame& frame)
{
  for (const Index point : leak.points)
  {
    leak.path.push_back(clearance.position(point));
  }
  leak.path.push_back(onSide(leak, leak.path.back(), frame));
}

/// Returns the edge length of the finest leaf around a point.
double sizeAt(Index point, const Octree& octree, const GridPoints& points)
{
  double size = octree.frame().rootSize();
  for (const Index leaf : points.leaves[point])
  {
    size = std::min(size, octree.frame().sizeOf(octree.level(leaf)));
  }
  return size;
}

/// Finds the narrowest place of the way, and shortens the way on both sides of it.
void narrowDown(Leak& leak, const Clearance& clearance, WayFinder& finder, const Octree& octree,
                const GridPoints& points, const SurfaceModel& model)
{
  const std::vector<Clearance::OfEdge> edges = clearancesAlong(leak.points, clearance);
  const std::vector<std::size_t> candidates = narrowEdges(edges);
  std::size_t neck = candidates.front();
  Passage narrowest;
  narrowest.center = edges[neck].place;
  for (const std::size_t i : candidates)
  {
    const Index from = leak.points[i];
    Passage passage = passageBetween(clearance.position(from), clearance.position(leak.points[i + 1]),
                                     sizeAt(from, octree, points), octree, model);
    if (passage.width < narrowest.width)
    {
      narrowest = std::move(passage);
      neck = i;
    }
  }
  leak.place = narrowest.center;
  leak.width = std::isfinite(narrowest.width) ? narrowest.width : 2.0 * edges[neck].distance;
  leak.surfaces = std::move(narrowest.surfaces);
  leak.point = leak.points[neck];
  leak.points = shorten(leak.points, edges, neck, finder);
}

Leak leakFrom(Index start, const Clearance& clearance, const Crossings& crossings, const Octree& octree,
              const GridPoints& points, const SurfaceModel& model)
{
  WayFinder finder(crossings, clearance, model.names.size());
  Leak leak{};
  leak.points = finder.widest(start);
  if (leak.points.size() > 1)
  {
    narrowDown(leak, clearance, finder, octree, points, model);
  }
  else
  {
    leak.point = start;
    leak.place = clearance.position(start);
    leak.width = 2.0 * clearance.ofPoint(start);
  }
  const BoundaryFace& exit = *finder.exitAt(leak.points.back());
  leak.side = finder.sideOf(exit);
  leak.direction = exit.direction;
  drawPath(leak, clearance, octree.frame());
  return leak;
}

/// True if a zone reaches an open side of the domain other than its bottom.
bool isLeaking(std::int32_t zone, const Zones& zones)
{
  return (zones.openSides[static_cast<std::size_t>(zone)] & ~(SideBits{1} << zMin)) != 0;
}

} // namespace

std::vector<Leak> findLeaks(const std::vector<Vec3>& sealedSeeds, const Zones& zones, const Crossings& crossings,
                            const GridPlaces& grid, const GridPart& part, const SurfaceModel& model,
                            const RunContext& context)
{
  constexpr const char* kind = "sealed seed";
  const std::vector<std::int32_t> zonesOfAll = zonesOfSeeds(zones, sealedSeeds, grid, part, model, kind);
  if (std::ranges::none_of(zonesOfAll, [&](std::int32_t zone) { return isLeaking(zone, zones); }))
  {
    return {};
  }
  if (!part.isWhole())
  {
    throw WholeNeeded("the zone of a sealed seed leaks; one process has to search the way");
  }
  std::vector<Leak> leaks;
  std::optional<Clearance> clearance;
  std::int32_t measured = -1;
  for (std::size_t i = 0; i < sealedSeeds.size(); ++i)
  {
    const Index start = pointOfSeed(sealedSeeds[i], kind, grid, model);
    const std::int32_t zone = zones.ofPoint[start];
    if (!isLeaking(zone, zones))
    {
      continue;
    }
    context.progress.check();
    if (zone != measured)
    {
      clearance.emplace(zone, zones, crossings, grid, model, context);
      measured = zone;
    }
    leaks.push_back(leakFrom(start, *clearance, crossings, grid.octree(), grid.points(), model));
    leaks.back().index = i;
    leaks.back().seed = sealedSeeds[i];
  }
  return leaks;
}

} // namespace atria
