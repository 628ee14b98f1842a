// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Shares/SharedLabels.h"

#include "Mesher/Shares/SharedSets.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <span>

namespace atria {

namespace {

struct BorderCount
{
  Index part;
  Index other;
  std::size_t faces;
};

/// Of all ranks.
PartBorders sumBorders(const PartBorders& own, RankExchange& exchange)
{
  std::vector<BorderCount> counts;
  for (const auto& [sides, faces] : own)
  {
    counts.push_back({sides.first, sides.second, faces});
  }
  PartBorders all;
  for (const std::vector<BorderCount>& some : gatherAll(exchange, counts))
  {
    for (const BorderCount& count : some)
    {
      all[{count.part, count.other}] += count.faces;
    }
  }
  return all;
}

Rooms findSharedRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                      const SharedPoints& points, std::vector<ZoneFace>& zoneFaces, const RoomOptions& options,
                      const RankShare& share, const MeshingContext& context)
{
  if (!hasRooms(context.model))
  {
    return {};
  }
  context.progress.check();
  const PartedPoints parted(crossings, zoneFaces, context.model);
  const SharedSets sets(points, share, [&](Index point, int direction) { return parted.nextTo(point, direction); });
  const std::vector<RoomPart> parts =
      sets.sum(parted.describe(points.firstOwn(), sets.ofOwn(), sets.ownCount(), zones, summaries, options),
               [](const RoomPart& more, RoomPart& sum) { sum.add(more); });
  const std::vector<Index> partOf = fillFromRanks(crossings.neighbors.size(), points, share, sets.count(),
                                                  [&](Index point) { return sets.of(point); });
  const PartBorders borders = sumBorders(parted.borders(points.firstOwn(), points.endOwn(), partOf), share.exchange());
  return roomsOf(joinParts(parts, borders), partOf, crossings, zoneFaces, context.model);
}

/// A point of another rank within a surface's bounds, and the depth that it has as seen from a part.
struct SharedJoint
{
  PointKey key;
  Index part;
  int depth;
  bool isSure; ///< as in DepthLink
};

/// What ranks have of one surface, joined. Parts are numbered by rank.
class SharedDepths
{
public:
  SharedDepths(const SurfaceDepths& found, const SharedPoints& sharedPoints, const RankShare& rankShare)
      : depths(found), points(sharedPoints), share(rankShare)
  {
    for (const std::vector<DepthPart>& some : gatherAll(share.exchange(), depths.parts))
    {
      firstParts.push_back(static_cast<Index>(parts.size()));
      parts.insert(parts.end(), some.begin(), some.end());
    }
  }

  /// Gives own points that it encloses the surface's number, as fillCellZone does. False, on all ranks, where it is not
  /// closed.
  bool fill(Index surface, std::vector<std::int32_t>& zoneOf) const
  {
    const std::optional<std::vector<int>> outside = depthsOutside(parts, links());
    if (isAnywhere(!depths.isClosed || !outside, share.exchange()))
    {
      return false;
    }
    const auto own = std::span(*outside).subspan(firstPart(share.rank()), depths.parts.size());
    const bool encloses = fillCellZone(surface, depths, own, points.firstOwn(), zoneOf);
    return isAnywhere(encloses, share.exchange()) || !isAnywhere(depths.isMet, share.exchange());
  }

private:
  Index firstPart(int rank) const { return firstParts[static_cast<std::size_t>(rank)]; }

  std::vector<DepthLink> links() const
  {
    const Index first = firstPart(share.rank());
    std::vector<std::vector<SharedJoint>> toRanks(static_cast<std::size_t>(share.ranks()));
    for (const auto& [seen, isSure] : depths.joints)
    {
      toRanks[static_cast<std::size_t>(points.rankOf(seen.point))].push_back(
          {points.key(seen.point), first + seen.part, seen.depth, isSure});
    }
    std::vector<DepthLink> own;
    for (const DepthLink& link : depths.links)
    {
      own.push_back({first + link.part, first + link.other, link.depth, link.isSure});
    }
    for (const std::vector<SharedJoint>& some : exchangeLists(share.exchange(), toRanks))
    {
      for (const SharedJoint& joint : some)
      {
        const PointDepth& at = depthAt(points.ownOf(joint.key));
        own.push_back({joint.part, first + at.part, at.depth - joint.depth, joint.isSure});
      }
    }
    sortUnique(own);
    std::vector<DepthLink> all;
    for (const std::vector<DepthLink>& some : gatherAll(share.exchange(), own))
    {
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  const PointDepth& depthAt(Index point) const
  {
    const auto found = std::ranges::lower_bound(depths.points, point, {}, &PointDepth::point);
    if (found == depths.points.end() || found->point != point)
    {
      throw RanksDisagree("ranks do not have the same points where their shares meet");
    }
    return *found;
  }

  const SurfaceDepths& depths;
  const SharedPoints& points;
  const RankShare& share;
  std::vector<DepthPart> parts;
  std::vector<Index> firstParts; ///< by rank
};

std::vector<std::int32_t> findSharedCellZones(const Crossings& crossings, const GridPlaces& grid,
                                              const SharedPoints& points, const RankShare& share,
                                              const MeshingContext& context)
{
  const SurfaceModel& model = context.model;
  if (cellZonesOf(model).empty())
  {
    return {};
  }
  const Index first = points.firstOwn();
  const DepthFinder finder(crossings, grid, model, first, points.endOwn());
  std::vector<std::int32_t> zoneOf(points.endOwn() - first, noCellZone);
  for (const Index surface : cellZonesOf(model))
  {
    context.progress.check();
    const SurfaceDepths depths = finder.find(surface);
    if (!SharedDepths(depths, points, share).fill(surface, zoneOf))
    {
      failOpenCellZone(model.names[surface]);
    }
  }
  return fillFromRanks(crossings.neighbors.size(), points, share, noCellZone,
                       [&](Index point) { return zoneOf[point - first]; });
}

} // namespace

Labels findSharedLabels(const Zones& zones, const std::vector<ZoneSummary>& summaries, const DisplacedGrid& grid,
                        const SharedPoints& points, const RoomOptions& options, const RankShare& share,
                        const MeshingContext& context)
{
  const auto& [places, crossings] = grid;
  Labels labels;
  labels.zoneFaces = findZoneFaces(crossings, context.model);
  labels.rooms = findSharedRooms(zones, summaries, crossings, points, labels.zoneFaces, options, share, context);
  labels.cellZones = findSharedCellZones(crossings, places, points, share, context);
  return labels;
}

} // namespace atria
