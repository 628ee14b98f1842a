// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Shares/SharedZones.h"

#include "Dual/Vertices/TurnedDomain.h"
#include "Dual/Zones/Leaks.h"
#include "Mesher/Shares/SharedSets.h"

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

/// What is known of a zone, or of a part of it.
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

/// By set of own points.
std::vector<ZonePart> partsOfZones(const SharedSets& sets, const Crossings& crossings, const SharedPoints& points,
                                   std::size_t surfaceCount)
{
  std::vector<ZonePart> parts(sets.ownCount());
  for (const Index set : sets.ofOwn())
  {
    ++parts[set].size;
  }
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (face.onDomainSide && points.isOwn(face.element))
    {
      const bool isOpen = face.tag >= surfaceCount;
      const SideBits bit = SideBits{1} << (isOpen ? face.tag - surfaceCount : face.direction);
      parts[sets.ofOwn()[face.element - points.firstOwn()]].add({0, bit, isOpen ? bit : SideBits{0}});
    }
  }
  return parts;
}

/// Each rank knows the zones of seeds in its share.
std::vector<std::int32_t> zonesOfSharedSeeds(const Zones& zones, const std::vector<Vec3>& seeds, const GridPlaces& grid,
                                             const RankShare& share, const SurfaceModel& model, const char* kind)
{
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  std::vector<Vec3> own;
  std::ranges::copy_if(seeds, std::back_inserter(own), [&](const Vec3& seed) {
    const LatticePoint at = frame.toLattice(frame.placement.fromModel(seed));
    // All ranks say so of those outside.
    return !seed.allFinite() || !frame.inDomain(at) || share.isOwn(octree.finestKey(octree.leafAt(at)));
  });
  std::vector<std::int32_t> all;
  for (const auto& some : gatherAll(share.exchange(), zonesOfSeeds(zones, own, grid, model, kind)))
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

} // namespace

Zones findSharedZones(const Crossings& crossings, const SharedPoints& points, std::size_t surfaceCount,
                      const RankShare& share, const RunContext& context)
{
  context.progress.check();
  const SharedSets sets(points, share, [&](Index point, int direction) {
    const std::int32_t code = crossings.neighbors[point][direction];
    return code >= 0 ? static_cast<Index>(code) : noIndex;
  });
  const std::vector<ZonePart> whole = sets.sum(partsOfZones(sets, crossings, points, surfaceCount),
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
  zones.ofPoint = fillFromRanks(crossings.neighbors.size(), points, share, static_cast<std::int32_t>(zones.count()),
                                [&](Index point) { return zoneOf[sets.of(point)]; });
  return zones;
}

std::vector<Index> sharedWideZones(const GridPoints& grid, const Crossings& crossings, const SharedPoints& points,
                                   std::size_t surfaceCount, const RankShare& share, const RunContext& context)
{
  const Zones zones = findSharedZones(crossings, points, surfaceCount, share, context);
  const std::vector<char> isOpen = pointsInTheOpen(grid, crossings, context);
  std::vector<char> isWide(zones.count(), 0);
  for (Index point = points.firstOwn(); point < points.endOwn(); ++point)
  {
    isWide[static_cast<std::size_t>(zones.ofPoint[point])] |= isOpen[point];
  }
  for (const std::vector<char>& some : gatherAll(share.exchange(), isWide))
  {
    std::ranges::transform(some, isWide, isWide.begin(), [](char a, char b) { return a | b; });
  }
  std::vector<Index> out(zones.ofPoint.size());
  std::ranges::transform(zones.ofPoint, out.begin(), [&](std::int32_t zone) {
    const auto number = static_cast<std::size_t>(zone);
    return number >= isWide.size() ? zoneElsewhere : isWide[number] ? static_cast<Index>(number) : noIndex;
  });
  return out;
}

std::vector<char> keptSharedZones(const Zones& zones, ZoneRule rule, const std::vector<Vec3>& seeds,
                                  const GridPlaces& grid, const SharedPoints& points, const RankShare& share,
                                  const SurfaceModel& model, const ZoneFacts& facts, const ZoneEnclosures& enclosures)
{
  const GridFrame& frame = grid.octree().frame();
  const std::vector<std::int32_t> seedZones = zonesOfSharedSeeds(zones, seeds, grid, share, model, "seed");
  if (!frame.turnedDomain)
  {
    return chooseZones(zones, rule, seedZones, {}, facts, enclosures, frame);
  }
  std::vector<double> farthest(zones.count(), 0.0);
  for (const std::vector<double>& some :
       gatherAll(share.exchange(), farthestFromSides(zones, grid, points.firstOwn(), points.endOwn())))
  {
    std::ranges::transform(some, farthest, farthest.begin(),
                           [](double a, double b) { return std::abs(a) > std::abs(b) ? a : b; });
  }
  return chooseZones(zones, rule, seedZones, farthest, facts, enclosures, frame);
}

bool isAnyLeaking(const std::vector<Vec3>& sealedSeeds, const Zones& zones, const GridPlaces& grid,
                  const RankShare& share, const SurfaceModel& model)
{
  return std::ranges::any_of(zonesOfSharedSeeds(zones, sealedSeeds, grid, share, model, "sealed seed"),
                             [&](std::int32_t zone) { return isLeaking(zone, zones); });
}

} // namespace atria
