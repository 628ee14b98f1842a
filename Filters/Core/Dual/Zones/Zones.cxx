// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Zones.h"

#include "Dual/Grid/JoinedPoints.h"
#include "Octree/Tree/GeometryLists.h"
#include "Support/Error.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

namespace atria {

namespace {

constexpr SideBits bottom = SideBits{1} << zMin;
constexpr SideBits top = SideBits{1} << zMax;

/// Facts about a zone, or about a part of it.
struct ZonePart
{
  std::size_t size = 0;
  SideBits sides = 0;
  SideBits openSides = 0;

  void add(const ZonePart& other)
  {
    size += other.size;
    sides |= other.sides;
    openSides |= other.openSides;
  }
};

/// Returns the facts about sets of own points.
std::vector<ZonePart> describe(const PointSets& sets, const Crossings& crossings, const IndexRange& own,
                               std::size_t surfaceCount)
{
  std::vector<ZonePart> parts(sets.count);
  for (std::size_t begin = 0; begin < sets.ofOwn.size();) // neighbors mostly are of one set
  {
    std::size_t end = begin + 1;
    while (end < sets.ofOwn.size() && sets.ofOwn[end] == sets.ofOwn[begin])
    {
      ++end;
    }
    parts[sets.ofOwn[begin]].size += end - begin;
    begin = end;
  }
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (face.onDomainSide && own.contains(face.element))
    {
      const bool isOpen = face.tag >= surfaceCount;
      const SideBits bit = SideBits{1} << (isOpen ? face.tag - surfaceCount : face.direction);
      parts[sets.ofOwn[face.element - own.begin]].add({0, bit, isOpen ? bit : SideBits{0}});
    }
  }
  return parts;
}

/// Keeps the zones that reach one of `sides`, by their bits in `reached`. Returns true if there are any.
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

/// True if a place, along the grid's axes, is in the domain's box.
bool isInDomain(const Vec3& placed, const GridFrame& frame)
{
  return placed.allFinite() && (placed.array() >= frame.domain.min.array()).all() &&
         (placed.array() <= frame.domain.max.array()).all() && frame.inDomain(frame.toLattice(placed));
}

/// Returns the box around the domain along the axes of the model.
Box3 boundsInModel(const GridFrame& frame)
{
  Box3 bounds;
  for (int corner = 0; corner < 8; ++corner)
  {
    const auto at = [&](int axis) { return (corner >> axis & 1 ? frame.domain.max : frame.domain.min)[axis]; };
    bounds.extend(frame.placement.toModel(Vec3(at(0), at(1), at(2))));
  }
  return bounds;
}

/// Returns the grid points of a leaf and of leaves that touch it, by distance from p; of a turned domain, those inside.
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
  if (!isInDomain(placed, frame) || (frame.turnedDomain && !frame.turnedDomain->contains(seed)))
  {
    const Box3 bounds = boundsInModel(frame);
    throw Error((std::ostringstream() << "the " << kind << " " << seed.transpose()
                                      << " is outside the domain: give a point between " << bounds.min.transpose()
                                      << " and " << bounds.max.transpose())
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

Zones findZones(const Crossings& crossings, std::size_t surfaceCount, const GridPart& part, const RunContext& context)
{
  context.progress.check();
  const IndexRange& own = part.points();
  const auto nextTo = [&](Index point, int direction) {
    const std::int32_t code = crossings.neighbors[point][direction];
    return code >= 0 ? static_cast<Index>(code) : noIndex;
  };
  const PointSets sets = joinOwn(own, nextTo, context);
  const JoinedSets joined = part.join(sets, nextTo);
  const std::vector<ZonePart> whole = part.sum(joined, describe(sets, crossings, own, surfaceCount),
                                               [](const ZonePart& more, ZonePart& sum) { sum.add(more); });
  std::vector<Index> order(whole.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(
      order, [&](Index l, Index r) { return whole[l].size != whole[r].size ? whole[l].size > whole[r].size : l < r; });
  Zones zones;
  std::vector<std::int32_t> zoneOf(whole.size());
  for (const Index set : order)
  {
    zoneOf[set] = static_cast<std::int32_t>(zones.count());
    zones.sizes.push_back(whole[set].size);
    zones.sides.push_back(whole[set].sides);
    zones.openSides.push_back(whole[set].openSides);
  }
  const std::vector<Index>& ofSet = joined.ofSet[static_cast<std::size_t>(part.exchange().rank())];
  zones.ofPoint.resize(crossings.neighbors.size());
  context.executor.forEach(own.size(), Pieces::length,
                           [&](std::size_t i) { zones.ofPoint[own.begin + i] = zoneOf[ofSet[sets.ofOwn[i]]]; });
  part.refresh(zones.ofPoint, static_cast<std::int32_t>(zones.count()));
  return zones;
}

std::vector<std::int32_t> zonesOfSeeds(const Zones& zones, const std::vector<Vec3>& seeds, const GridPlaces& grid,
                                       const GridPart& part, const SurfaceModel& model, const char* kind)
{
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  // Every process refuses a seed outside the domain; the owner of its leaf knows its zone.
  const auto isOwn = [&](const Vec3& seed) {
    const Vec3 placed = frame.placement.fromModel(seed);
    return part.isWhole() || !isInDomain(placed, frame) ||
           part.leaves().contains(octree.leafAt(frame.toLattice(placed)));
  };
  std::vector<std::int32_t> own;
  for (const Vec3& seed : seeds)
  {
    if (isOwn(seed))
    {
      own.push_back(zones.ofPoint[pointOfSeed(seed, kind, grid, model)]);
    }
  }
  return joinAll(part.exchange(), std::move(own));
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
