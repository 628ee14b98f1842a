// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Zones.h"

#include "Octree/Tree/GeometryLists.h"
#include "Support/Error.h"
#include "Support/Pieces.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace atria {

namespace {

constexpr SideBits bottom = SideBits{1} << zMin;
constexpr SideBits top = SideBits{1} << zMax;

/// Points in a row that are of one set.
struct Run
{
  Index root;
  Index points;
};

void addToRuns(std::vector<Run>& runs, Index root)
{
  if (runs.empty() || runs.back().root != root)
  {
    runs.push_back({root, 0});
  }
  ++runs.back().points;
}

/// Roots of sets, the largest first. `sizes`, which are 0, get those of each root.
std::vector<Index> rootsBySize(const std::vector<std::vector<Run>>& runs, std::vector<Index>& sizes)
{
  std::vector<Index> roots;
  for (const std::vector<Run>& piece : runs)
  {
    for (const Run& run : piece)
    {
      if (sizes[run.root] == 0)
      {
        roots.push_back(run.root);
      }
      sizes[run.root] += run.points;
    }
  }
  std::ranges::sort(roots, [&](Index l, Index r) { return sizes[l] != sizes[r] ? sizes[l] > sizes[r] : l < r; });
  return roots;
}

/// Keeps the zones that reach one of `sides`, by their bits in `reached`. Returns whether there are any.
bool keepReaching(SideBits sides, const std::vector<SideBits>& reached, std::vector<char>& kept)
{
  std::transform(reached.begin(), reached.end(), kept.begin(), [&](SideBits r) { return (r & sides) != 0 ? 1 : 0; });
  return std::find(kept.begin(), kept.end(), 1) != kept.end();
}

void keepOutside(const Zones& zones, std::vector<char>& kept)
{
  // The domain is a room or a building if no side is open, and its sides are the walls. Otherwise zones that reach only
  // the lateral sides are under the ground, if any zone reaches the top.
  const bool anyOpen = keepReaching(~bottom, zones.openSides, kept);
  if (!(anyOpen && keepReaching(top, zones.sides, kept)) && !keepReaching(~bottom, zones.sides, kept))
  {
    keepReaching(bottom, zones.sides, kept);
  }
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

/// True if no surface is between a place and a grid point near it.
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
  return EdgeProbe(octree, model).cut(sight, leavesTouching(octree, boundsOf(sight))).empty();
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
  const std::size_t count = crossings.neighbors.size();
  UnionFind sets(count);
  std::vector<std::vector<std::pair<Index, Index>>> between((count + length - 1) / length);
  context.executor.forEach(between.size(), 1, [&](std::size_t piece) {
    context.progress.check();
    const std::size_t end = std::min((piece + 1) * length, count);
    for (std::size_t point = piece * length; point < end; ++point)
    {
      for (int direction = 1; direction < 6; direction += 2)
      {
        const std::int32_t neighbor = crossings.neighbors[point][direction];
        const auto other = static_cast<std::size_t>(neighbor);
        if (neighbor >= 0 && other >= piece * length && other < end)
        {
          sets.join(static_cast<Index>(point), static_cast<Index>(neighbor));
        }
        else if (neighbor >= 0)
        {
          between[piece].emplace_back(static_cast<Index>(point), static_cast<Index>(neighbor));
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
  const std::size_t count = crossings.neighbors.size();
  UnionFind sets = joinPoints(crossings, context);
  Zones zones;
  zones.ofPoint.resize(count);
  const Pieces pieces(count);
  std::vector<std::vector<Run>> runs(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    for (std::size_t point = pieces.begin(piece); point < pieces.end(piece); ++point)
    {
      const Index root = sets.find(static_cast<Index>(point));
      zones.ofPoint[point] = static_cast<std::int32_t>(root);
      addToRuns(runs[piece], root);
    }
  });
  std::vector<Index> ofRoot(count, 0); // the number of its points, then its zone
  const std::vector<Index> roots = rootsBySize(runs, ofRoot);
  for (Index zone = 0; zone < roots.size(); ++zone)
  {
    zones.sizes.push_back(std::exchange(ofRoot[roots[zone]], zone));
  }
  context.executor.forEach(count, Pieces::length, [&](std::size_t point) {
    zones.ofPoint[point] = static_cast<std::int32_t>(ofRoot[static_cast<std::size_t>(zones.ofPoint[point])]);
  });
  zones.sides.resize(roots.size(), 0);
  zones.openSides.resize(roots.size(), 0);
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (face.onDomainSide)
    {
      const bool isOpen = face.tag >= surfaceCount;
      const SideBits bit = SideBits{1} << (isOpen ? face.tag - surfaceCount : face.direction);
      const std::int32_t zone = zones.ofPoint[face.element];
      zones.sides[zone] |= bit;
      zones.openSides[zone] |= isOpen ? bit : 0;
    }
  }
  return zones;
}

std::vector<std::int32_t> zonesOfSeeds(const Zones& zones, const std::vector<Vec3>& seeds, const GridPlaces& grid,
                                       const SurfaceModel& model, const char* kind)
{
  std::vector<std::int32_t> out;
  std::ranges::transform(seeds, std::back_inserter(out),
                         [&](const Vec3& seed) { return zones.ofPoint[pointOfSeed(seed, kind, grid, model)]; });
  return out;
}

std::vector<char> zonesByRule(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones)
{
  std::vector<char> kept(zones.count(), rule == ZoneRule::all ? 1 : 0);
  if (rule == ZoneRule::outside)
  {
    keepOutside(zones, kept);
  }
  else if (rule == ZoneRule::seeds)
  {
    if (seedZones.empty())
    {
      throw Error("zones are to be kept by seeds, but there is no seed: give at least one point inside a zone");
    }
    std::ranges::for_each(seedZones, [&](std::int32_t zone) { kept[zone] = 1; });
  }
  return kept;
}

void checkKept(const std::vector<char>& kept, ZoneRule rule)
{
  if (std::find(kept.begin(), kept.end(), 1) == kept.end())
  {
    throw Error(rule == ZoneRule::all ? "there is nothing to mesh: no grid point is inside the domain"
                                      : "no zone is left to mesh: none reaches a side of the domain; keep all "
                                        "zones, or give seeds");
  }
}

std::vector<char> keptZones(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones)
{
  std::vector<char> kept = zonesByRule(zones, rule, seedZones);
  checkKept(kept, rule);
  return kept;
}

} // namespace atria
