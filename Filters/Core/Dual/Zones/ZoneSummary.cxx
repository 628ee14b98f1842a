// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/ZoneSummary.h"

#include "Support/Pieces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace atria {

namespace {

/// True if no leaf around a point holds a piece of the model.
bool isFree(const Octree& octree, const std::array<Index, 8>& leaves)
{
  return std::all_of(leaves.begin(), leaves.end(), [&](Index leaf) { return octree.items(leaf).empty(); });
}

/// Returns a place near a grid point from which pointOfSeed finds that point again.
Vec3 placeAt(Index point, const GridPlaces& grid)
{
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  Vec3 at = frame.toModel(grid.place(point));
  if (grid.isDisplaced(point))
  {
    return at;
  }
  const std::array<Index, 8>& leaves = grid.points().leaves[point];
  // Tries places well inside octants that have the point as their corner, then places nearer to the point, for octants
  // with surfaces or sides of the domain.
  for (const double part : {0.25, 1e-3})
  {
    for (unsigned slot = 0; slot < 8; ++slot)
    {
      Vec3 place = at + part * (octree.center(leaves[slot]) - at);
      if (grid.points().atCorner[leaves[slot]][7 - slot] == point && frame.inDomain(frame.toLattice(place)) &&
          (part < 0.01 || octree.items(leaves[slot]).empty()))
      {
        return place;
      }
    }
  }
  return at;
}

/// A point of a zone and the level of the finest octant around it, or the greatest number if one holds a piece of the
/// model.
struct RoomyPoint
{
  std::int32_t zone;
  Index point;
  int finest;
};

/// Returns, for each run of points [begin, end) of one zone, the first point with the largest octants around it.
std::vector<RoomyPoint> roomiestOf(const Zones& zones, Index begin, Index end, const GridPlaces& grid)
{
  const Octree& octree = grid.octree();
  std::vector<RoomyPoint> best;
  for (Index point = begin; point < end; ++point)
  {
    const std::int32_t zone = zones.ofPoint[point];
    const auto& leaves = grid.points().leaves[point];
    const bool first = best.empty() || best.back().zone != zone;
    if (!first && octree.level(leaves.front()) >= best.back().finest)
    {
      continue;
    }
    int finest = std::numeric_limits<int>::max();
    if (isFree(octree, leaves))
    {
      finest = octree.level(std::ranges::max(leaves, {}, [&](Index leaf) { return octree.level(leaf); }));
    }
    if (first)
    {
      best.push_back({zone, point, finest});
    }
    else if (finest < best.back().finest)
    {
      best.back() = {zone, point, finest};
    }
  }
  return best;
}

void findPlaces(const Zones& zones, const GridPlaces& grid, const GridPart& part, const RunContext& context,
                ZoneFacts& facts)
{
  const Pieces pieces(part.points().size());
  std::vector<std::vector<RoomyPoint>> found(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    found[piece] = roomiestOf(zones, part.points().begin + static_cast<Index>(pieces.begin(piece)),
                              part.points().begin + static_cast<Index>(pieces.end(piece)), grid);
  });
  std::vector<Index> best(zones.count(), noIndex);
  for (const std::vector<RoomyPoint>& piece : found)
  {
    for (const RoomyPoint& one : piece)
    {
      Index& point = best[static_cast<std::size_t>(one.zone)];
      int& finest = facts.zones[static_cast<std::size_t>(one.zone)].finest;
      if (point == noIndex || one.finest < finest)
      {
        point = one.point;
        finest = one.finest;
      }
    }
  }
  for (std::size_t zone = 0; zone < best.size(); ++zone)
  {
    if (best[zone] != noIndex)
    {
      facts.zones[zone].hasPlace = true;
      facts.zones[zone].inside = placeAt(best[zone], grid);
    }
  }
}

using CountList = std::vector<ZoneFacts::Count>;

/// Sorts counts, and adds up those of the same zone and thing.
void addUp(CountList& list)
{
  std::ranges::sort(list,
                    [](const auto& l, const auto& r) { return std::pair(l.zone, l.of) < std::pair(r.zone, r.of); });
  CountList sums;
  for (const ZoneFacts::Count& some : list)
  {
    if (sums.empty() || sums.back().zone != some.zone || sums.back().of != some.of)
    {
      sums.push_back({some.zone, some.of, 0});
    }
    sums.back().count += some.count;
  }
  list = std::move(sums);
}

/// Adds what zones see, and how many faces of which surfaces they have.
void lookAtFaces(const Zones& zones, const Crossings& crossings, std::size_t surfaceCount, const GridPart& part,
                 const std::vector<char>& isGround, ZoneFacts& facts)
{
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (!part.owns(face.element))
    {
      continue;
    }
    const std::int32_t number = zones.ofPoint[face.element];
    ZoneFacts::Zone& zone = facts.zones[static_cast<std::size_t>(number)];
    zone.seesGround = zone.seesGround || (face.onDomainSide && face.direction == zMin) ||
                      (face.tag < isGround.size() && isGround[face.tag]);
    if (face.tag >= surfaceCount)
    {
      // Sides of a turned domain are sheets.
      zone.isBeyond = zone.isBeyond || (face.opposite != noIndex && face.side == SheetSide::front);
      continue;
    }
    facts.faces.push_back({number, face.tag, 1});
    if (face.direction != zMin) // faces below do not count, as solids stand on the ground
    {
      zone.seesBacksOfOne =
          zone.seesBacksOfOne && face.side == SheetSide::back && (zone.surface == noIndex || zone.surface == face.tag);
      zone.surface = face.tag;
      if (!face.onDomainSide && (face.tag >= isGround.size() || !isGround[face.tag]))
      {
        ++(face.side == SheetSide::back ? zone.faces.backs : zone.faces.fronts);
      }
    }
  }
  addUp(facts.faces);
}

void findWideZones(const Zones& zones, const Crossings& crossings, const GridPart& part, ZoneFacts& facts)
{
  for (Index point = part.points().begin; point < part.points().end; ++point)
  {
    bool& isWide = facts.zones[static_cast<std::size_t>(zones.ofPoint[point])].isWide;
    if (!isWide)
    {
      const auto& neighbors = crossings.neighbors[point];
      isWide = std::all_of(neighbors.begin(), neighbors.end(), [](std::int32_t code) { return code >= 0; });
    }
  }
}

CountList cornersOf(const Zones& zones, const GridPlaces& grid, const GridPart& part, const RunContext& context)
{
  const Octree& octree = grid.octree();
  const Pieces pieces(part.leaves().size());
  std::vector<CountList> found(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    CountList& list = found[piece];
    for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i)
    {
      const Index leaf = part.leaves().begin + static_cast<Index>(i);
      const auto level = static_cast<Index>(octree.level(leaf));
      for (const Index point : grid.points().atCorner[leaf])
      {
        if (point == noIndex)
        {
          continue;
        }
        if (list.empty() || list.back().zone != zones.ofPoint[point] || list.back().of != level)
        {
          list.push_back({zones.ofPoint[point], level, 0});
        }
        ++list.back().count;
      }
    }
    addUp(list);
  });
  CountList all;
  for (const CountList& some : found)
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  addUp(all);
  return all;
}

/// Adds facts from another process about the same zone.
void append(const ZoneFacts::Zone& more, ZoneFacts::Zone& zone)
{
  if (more.hasPlace && (!zone.hasPlace || more.finest < zone.finest))
  {
    zone.hasPlace = true;
    zone.finest = more.finest;
    zone.inside = more.inside;
  }
  zone.isWide = zone.isWide || more.isWide;
  zone.isBeyond = zone.isBeyond || more.isBeyond;
  zone.seesGround = zone.seesGround || more.seesGround;
  const bool areSame = zone.surface == noIndex || more.surface == noIndex || zone.surface == more.surface;
  zone.seesBacksOfOne = zone.seesBacksOfOne && more.seesBacksOfOne && areSame;
  zone.surface = more.surface == noIndex ? zone.surface : more.surface;
  zone.faces.add(more.faces);
}

/// Joins the facts of all processes.
ZoneFacts joinFacts(ZoneFacts own, RankExchange& exchange)
{
  if (exchange.ranks() == 1)
  {
    return own;
  }
  ZoneFacts all;
  all.zones = addAll(exchange, std::move(own.zones),
                     [](const ZoneFacts::Zone& more, ZoneFacts::Zone& zone) { append(more, zone); });
  all.faces = joinAll(exchange, std::move(own.faces));
  all.corners = joinAll(exchange, std::move(own.corners));
  addUp(all.faces);
  addUp(all.corners);
  return all;
}

/// Largest part of the faces that the inside of a solid sees from the front, if no closed body decides. One of a
/// house's walls may be a neighbor's, or wound the wrong way.
constexpr double fewFronts = 0.25;

/// True if a zone that is closed is the inside of a solid. Fewer signs count for a kept zone.
bool isSolid(const ZoneFacts::Zone& zone, Enclosure enclosure, bool kept)
{
  const auto& [fronts, backs] = zone.faces;
  const bool seesBacks = backs > 0 && static_cast<double>(fronts) <= fewFronts * static_cast<double>(fronts + backs);
  const bool isLikeOne = zone.seesBacksOfOne || (!kept && seesBacks && zone.seesGround);
  return enclosure == Enclosure::solid || (enclosure == Enclosure::none && isLikeOne);
}

bool isUnderGround(const ZoneSummary& zone, const std::vector<char>& isGround)
{
  constexpr SideBits bottom = SideBits{1} << zMin;
  const bool seesMostOfGround =
      !zone.surfaces.empty() && zone.surfaces.front() < isGround.size() && isGround[zone.surfaces.front()];
  return zone.kind == ZoneKind::open && !zone.kept && (zone.sides & bottom) != 0 && seesMostOfGround;
}

ZoneKind kindOf(const ZoneFacts::Zone& zone, SideBits sides, Enclosure enclosure, bool kept)
{
  constexpr SideBits bottom = SideBits{1} << zMin;
  const bool isShell = enclosure == Enclosure::solid && !kept; // even if it touches sides
  return zone.isBeyond                    ? ZoneKind::beyond
         : isShell                        ? ZoneKind::solid
         : (sides & ~bottom) != 0         ? ZoneKind::open
         : isSolid(zone, enclosure, kept) ? ZoneKind::solid
         : zone.isWide                    ? ZoneKind::room
                                          : ZoneKind::narrow;
}

} // namespace

ZoneFacts findZoneFacts(const Zones& zones, const Crossings& crossings, const GridPlaces& grid,
                        std::size_t surfaceCount, const GridPart& part, const RunContext& context,
                        const std::vector<char>& isGround)
{
  ZoneFacts facts;
  facts.zones.resize(zones.count());
  findPlaces(zones, grid, part, context, facts);
  facts.corners = cornersOf(zones, grid, part, context);
  context.progress.check();
  findWideZones(zones, crossings, part, facts);
  lookAtFaces(zones, crossings, surfaceCount, part, isGround, facts);
  return joinFacts(std::move(facts), part.exchange());
}

std::vector<double> zoneVolumes(const ZoneFacts& facts, std::size_t zoneCount, const GridFrame& frame)
{
  std::vector<double> volumes(zoneCount, 0.0);
  for (const ZoneFacts::Count& some : facts.corners)
  {
    // Points of other ranks are in one more zone.
    if (static_cast<std::size_t>(some.zone) < zoneCount)
    {
      const double octant = std::pow(frame.sizeOf(static_cast<int>(some.of)), 3);
      volumes[static_cast<std::size_t>(some.zone)] += octant / 8.0 * static_cast<double>(some.count);
    }
  }
  return volumes;
}

std::vector<ZoneSummary> summarizeZones(const Zones& zones, const std::vector<char>& kept, const ZoneFacts& facts,
                                        const std::vector<Enclosure>& enclosures, const std::vector<char>& isGround,
                                        const GridFrame& frame)
{
  std::vector<ZoneSummary> summaries(zones.count());
  const std::vector<double> volumes = zoneVolumes(facts, zones.count(), frame);
  for (std::size_t i = 0; i < zones.count(); ++i)
  {
    summaries[i].elements = zones.sizes[i];
    summaries[i].kept = kept[i] != 0;
    summaries[i].sides = zones.sides[i];
    summaries[i].inside = facts.zones[i].inside;
    summaries[i].volume = volumes[i];
    const Enclosure enclosure = i < enclosures.size() ? enclosures[i] : Enclosure::none;
    summaries[i].kind = kindOf(facts.zones[i], zones.sides[i], enclosure, summaries[i].kept);
  }
  std::vector<ZoneFacts::Count> faces = facts.faces;
  std::stable_sort(faces.begin(), faces.end(), [](const auto& l, const auto& r) { return l.count > r.count; });
  for (const ZoneFacts::Count& some : faces)
  {
    summaries[static_cast<std::size_t>(some.zone)].surfaces.push_back(some.of);
  }
  for (ZoneSummary& zone : summaries)
  {
    zone.kind = isUnderGround(zone, isGround) ? ZoneKind::ground : zone.kind;
  }
  return summaries;
}

std::vector<ZoneSummary> summarizeZones(const Zones& zones, const std::vector<char>& kept, const Crossings& crossings,
                                        const GridPlaces& grid, std::size_t surfaceCount, const RunContext& context)
{
  const GridPart whole(grid.points());
  return summarizeZones(zones, kept, findZoneFacts(zones, crossings, grid, surfaceCount, whole, context), {}, {},
                        grid.octree().frame());
}

} // namespace atria
