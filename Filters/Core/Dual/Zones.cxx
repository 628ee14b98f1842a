// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones.h"

#include "Octree/GeometryLists.h"
#include "Support/Error.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <sstream>

namespace atria {

namespace {

constexpr unsigned bottom = 1u << zMin;
constexpr unsigned top = 1u << zMax;

/// Keeps the zones that reach one of `sides`, by their bits in `reached`. Returns whether there are any.
bool keepReaching(unsigned sides, const std::vector<std::uint8_t>& reached, std::vector<char>& kept)
{
  std::transform(reached.begin(), reached.end(), kept.begin(), [&](unsigned r) { return (r & sides) != 0 ? 1 : 0; });
  return std::find(kept.begin(), kept.end(), 1) != kept.end();
}

void keepOutside(const Zones& zones, std::vector<char>& kept)
{
  // Where no side is open, the domain is a room or a building, and its sides are the walls. Otherwise what reaches only
  // the lateral sides is under the ground, if anything reaches the top.
  const bool anyOpen = keepReaching(~bottom, zones.openSides, kept);
  if (!(anyOpen && keepReaching(top, zones.sides, kept)) && !keepReaching(~bottom, zones.sides, kept))
  {
    keepReaching(bottom, zones.sides, kept);
  }
}

/// Whether nothing of the model is in any leaf about a point.
bool isFree(const Octree& octree, const std::array<Index, 8>& leaves)
{
  return std::all_of(leaves.begin(), leaves.end(), [&](Index leaf) { return octree.items(leaf).empty(); });
}

/// A place near a grid point from which pointOfSeed finds that point again.
Vec3 placeAt(Index point, const GridPlaces& grid)
{
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  const Vec3 at = frame.toModel(grid.place(point));
  if (grid.isMoved(point))
  {
    return at;
  }
  const std::array<Index, 8>& leaves = grid.points().leaves[point];
  // Well inside an octant that has the point as its corner; nearer to the point where surfaces or the domain's sides
  // pass.
  for (const double part : {0.25, 1e-3})
  {
    for (unsigned slot = 0; slot < 8; ++slot)
    {
      const Vec3 place = at + part * (octree.center(leaves[slot]) - at);
      if (grid.points().atCorner[leaves[slot]][7 - slot] == point && frame.inDomain(frame.toLattice(place)) &&
          (part < 0.01 || octree.items(leaves[slot]).empty()))
      {
        return place;
      }
    }
  }
  return at;
}

/// For each zone, the point with the largest octants about it and nothing of the model in them; else its first point.
std::vector<Index> roomiestPoints(const Zones& zones, const Octree& octree, const GridPoints& points)
{
  std::vector<Index> best(zones.count(), noIndex);
  std::vector<int> finestThere(zones.count(), 0);
  for (Index point = 0; point < zones.ofPoint.size(); ++point)
  {
    const std::int32_t zone = zones.ofPoint[point];
    const auto& leaves = points.leaves[point];
    if (best[zone] != noIndex && octree.level(leaves.front()) >= finestThere[zone])
    {
      continue;
    }
    int finest = std::numeric_limits<int>::max();
    if (isFree(octree, leaves))
    {
      finest = 0;
      for (const Index leaf : leaves)
      {
        finest = std::max(finest, octree.level(leaf));
      }
    }
    if (best[zone] == noIndex || finest < finestThere[zone])
    {
      best[zone] = point;
      finestThere[zone] = finest;
    }
  }
  return best;
}

/// The grid points of a leaf and of those that touch it, by distance from p; only those inside a turned domain.
std::vector<std::pair<double, Index>> pointsAround(Index leaf, const Vec3& p, const GridPlaces& grid)
{
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  std::vector<Index> points;
  for (const Index near : leavesTouching(octree, {octree.cornerOf(leaf, 0), octree.cornerOf(leaf, 7)}))
  {
    const auto& corners = grid.points().atCorner[near];
    std::copy_if(corners.begin(), corners.end(), std::back_inserter(points), [](Index i) { return i != noIndex; });
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<std::pair<double, Index>> out;
  for (const Index point : points)
  {
    const Vec3 at = frame.toModel(grid.place(point));
    if (!frame.turnedDomain || frame.turnedDomain->contains(frame.placement.toModel(at)))
    {
      out.emplace_back((at - p).squaredNorm(), point);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Whether no surface is between a place and a grid point near it.
bool seesPlace(const LatticePoint& from, Index point, const GridPlaces& grid, const SurfaceModel& model)
{
  EdgeSegment sight;
  sight.start = from;
  sight.end = grid.place(point);
  sight.axis = -1;
  const Octree& octree = grid.octree();
  sight.about.fill(octree.leafAt(from));
  sight.size = octree.frame().latticeSize(octree.level(sight.about[0]));
  if (sight.start == sight.end)
  {
    return true;
  }
  LatticeBox box{from, from};
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::min(sight.start[axis], sight.end[axis]);
    box.high[axis] = std::max(sight.start[axis], sight.end[axis]);
  }
  return EdgeProbe(octree, model).cut(sight, leavesTouching(octree, box)).empty();
}

void nameSurfaces(std::vector<ZoneSummary>& summaries, const Zones& zones, const Crossings& crossings,
                  std::size_t surfaceCount)
{
  std::vector<std::pair<std::int32_t, Index>> uses;
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (face.tag < surfaceCount)
    {
      uses.emplace_back(zones.ofPoint[face.element], face.tag);
    }
  }
  std::sort(uses.begin(), uses.end());
  struct Count
  {
    std::int32_t zone;
    std::size_t faces;
    Index surface;
  };
  std::vector<Count> counts;
  for (const auto& [zone, surface] : uses)
  {
    if (counts.empty() || counts.back().zone != zone || counts.back().surface != surface)
    {
      counts.push_back({zone, 0, surface});
    }
    ++counts.back().faces;
  }
  std::stable_sort(counts.begin(), counts.end(), [](const Count& l, const Count& r) { return l.faces > r.faces; });
  for (const Count& count : counts)
  {
    summaries[count.zone].surfaces.push_back(count.surface);
  }
}

} // namespace

Index pointOfSeed(const Vec3& seed, const char* kind, const GridPlaces& grid, const SurfaceModel& model)
{
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  const Vec3 placed = frame.placement.fromModel(seed);
  if (!seed.allFinite() || (placed.array() < frame.domain.min.array()).any() ||
      (placed.array() > frame.domain.max.array()).any() || !frame.inDomain(frame.toLattice(placed)) ||
      (frame.turnedDomain && !frame.turnedDomain->contains(seed)))
  {
    throw Error((std::ostringstream() << "the " << kind << " " << seed.transpose()
                                      << " is outside the domain: give a point between " << frame.domain.min.transpose()
                                      << " and " << frame.domain.max.transpose())
                    .str());
  }
  const Index leaf = octree.leafAt(frame.toLattice(placed));
  const auto around = pointsAround(leaf, placed, grid);
  const auto visible = std::find_if(around.begin(), around.end(), [&](const auto& candidate) {
    return seesPlace(frame.toLattice(placed), candidate.second, grid, model);
  });
  if (visible != around.end())
  {
    return visible->second;
  }
  const auto& corners = grid.points().atCorner[leaf];
  const auto corner = std::find_if(around.begin(), around.end(), [&](const auto& candidate) {
    return std::find(corners.begin(), corners.end(), candidate.second) != corners.end();
  });
  if (corner == around.end())
  {
    throw Error(
        (std::ostringstream() << "the " << kind << " " << seed.transpose() << " has no element about it").str());
  }
  return corner->second;
}

UnionFind joinPoints(const Crossings& crossings, const RunContext& context)
{
  // Points of a piece are joined with each other first, by all threads.
  constexpr std::size_t length = 16384;
  const std::size_t count = crossings.neighbours.size();
  UnionFind sets(count);
  std::vector<std::vector<std::pair<Index, Index>>> between((count + length - 1) / length);
  context.executor.forEach(between.size(), 1, [&](std::size_t piece) {
    context.progress.check();
    const std::size_t end = std::min((piece + 1) * length, count);
    for (std::size_t point = piece * length; point < end; ++point)
    {
      for (int direction = 1; direction < 6; direction += 2)
      {
        const std::int32_t neighbour = crossings.neighbours[point][direction];
        const auto other = static_cast<std::size_t>(neighbour);
        if (neighbour >= 0 && other >= piece * length && other < end)
        {
          sets.join(static_cast<Index>(point), static_cast<Index>(neighbour));
        }
        else if (neighbour >= 0)
        {
          between[piece].emplace_back(static_cast<Index>(point), static_cast<Index>(neighbour));
        }
      }
    }
  });
  for (const auto& pairs : between)
  {
    context.progress.check();
    for (const auto& [a, b] : pairs)
    {
      sets.join(a, b);
    }
  }
  return sets;
}

Zones findZones(const Crossings& crossings, std::size_t surfaceCount, const RunContext& context)
{
  const std::size_t count = crossings.neighbours.size();
  UnionFind sets = joinPoints(crossings, context);
  std::vector<Index> roots;
  std::vector<Index> sizes(count, 0);
  for (Index point = 0; point < count; ++point)
  {
    const Index root = sets.find(point);
    if (root == point)
    {
      roots.push_back(root);
    }
    ++sizes[root];
  }
  std::stable_sort(roots.begin(), roots.end(), [&](Index l, Index r) { return sizes[l] > sizes[r]; });
  Zones zones;
  zones.sides.resize(roots.size(), 0);
  zones.openSides.resize(roots.size(), 0);
  zones.ofPoint.resize(count);
  for (std::size_t i = 0; i < roots.size(); ++i)
  {
    zones.sizes.push_back(sizes[roots[i]]);
    zones.ofPoint[roots[i]] = static_cast<std::int32_t>(i);
  }
  for (Index point = 0; point < count; ++point)
  {
    zones.ofPoint[point] = zones.ofPoint[sets.find(point)];
  }
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (face.onDomainSide)
    {
      const auto bit = static_cast<std::uint8_t>(1u << face.direction);
      const std::int32_t zone = zones.ofPoint[face.element];
      zones.sides[zone] |= bit;
      zones.openSides[zone] |= face.tag >= surfaceCount ? bit : std::uint8_t{0};
    }
  }
  return zones;
}

std::vector<char> keptZones(const Zones& zones, ZoneRule rule, const std::vector<Vec3>& seeds, const GridPlaces& grid,
                            const SurfaceModel& model)
{
  std::vector<char> kept(zones.count(), rule == ZoneRule::all ? 1 : 0);
  if (rule == ZoneRule::outside)
  {
    keepOutside(zones, kept);
  }
  else if (rule == ZoneRule::seeds)
  {
    if (seeds.empty())
    {
      throw Error("zones are to be kept by seeds, but there is no seed: give at least one point inside a zone");
    }
    for (const Vec3& seed : seeds)
    {
      kept[zones.ofPoint[pointOfSeed(seed, "seed", grid, model)]] = 1;
    }
  }
  if (std::find(kept.begin(), kept.end(), 1) == kept.end())
  {
    throw Error(rule == ZoneRule::all ? "there is nothing to mesh: no grid point is inside the domain"
                                      : "no zone is left to mesh: none reaches a side of the domain; keep all "
                                        "zones, or give seeds");
  }
  return kept;
}

std::vector<ZoneSummary> summariseZones(const Zones& zones, const std::vector<char>& kept, const Crossings& crossings,
                                        const GridPlaces& grid, std::size_t surfaceCount)
{
  std::vector<ZoneSummary> summaries(zones.count());
  const std::vector<Index> roomiest = roomiestPoints(zones, grid.octree(), grid.points());
  for (std::size_t i = 0; i < zones.count(); ++i)
  {
    summaries[i].elements = zones.sizes[i];
    summaries[i].kept = kept[i] != 0;
    summaries[i].sides = zones.sides[i];
    summaries[i].inside = placeAt(roomiest[i], grid);
  }
  nameSurfaces(summaries, zones, crossings, surfaceCount);
  return summaries;
}

} // namespace atria
