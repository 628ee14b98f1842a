// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/ZoneKinds.h"

#include "Support/Pieces.h"

#include <cmath>

namespace atria {

namespace {

struct Share
{
  std::int32_t zone;
  double volume;
};

/// An eighth of each leaf for the zone at each of its corners.
std::vector<Share> sharesOf(std::size_t begin, std::size_t end, const Zones& zones, const GridPlaces& grid)
{
  const Octree& octree = grid.octree();
  std::vector<Share> shares;
  for (std::size_t leaf = begin; leaf < end; ++leaf)
  {
    const double eighth = std::pow(octree.frame().sizeOf(octree.level(static_cast<Index>(leaf))), 3) / 8.0;
    for (const Index point : grid.points().atCorner[leaf])
    {
      if (point == noIndex)
      {
        continue;
      }
      const std::int32_t zone = zones.ofPoint[point];
      if (shares.empty() || shares.back().zone != zone)
      {
        shares.push_back({zone, 0.0});
      }
      shares.back().volume += eighth;
    }
  }
  return shares;
}

void measure(std::vector<ZoneSummary>& summaries, const Zones& zones, const GridPlaces& grid, const RunContext& context)
{
  const Pieces pieces(grid.octree().leafCount());
  std::vector<std::vector<Share>> shares(pieces.count);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    shares[piece] = sharesOf(pieces.begin(piece), pieces.end(piece), zones, grid);
  });
  for (const std::vector<Share>& some : shares)
  {
    for (const Share& share : some)
    {
      summaries[share.zone].volume += share.volume;
    }
  }
}

/// Zones that have an element with elements on all of its sides.
std::vector<char> wideZones(const Zones& zones, const Crossings& crossings)
{
  std::vector<char> wide(zones.count(), 0);
  for (std::size_t point = 0; point < zones.ofPoint.size(); ++point)
  {
    char& isWide = wide[zones.ofPoint[point]];
    if (!isWide)
    {
      const auto& neighbors = crossings.neighbors[point];
      isWide = std::all_of(neighbors.begin(), neighbors.end(), [](std::int32_t code) { return code >= 0; });
    }
  }
  return wide;
}

/// Zones that see nothing but the backs of one surface. What is below them is not looked at: solids stand on the
/// ground.
std::vector<char> solidZones(const Zones& zones, const Crossings& crossings, std::size_t surfaceCount)
{
  std::vector<Index> only(zones.count(), noIndex);
  std::vector<char> solid(zones.count(), 1);
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    const std::int32_t zone = zones.ofPoint[face.element];
    if (face.tag < surfaceCount && face.direction != zMin)
    {
      solid[zone] = solid[zone] && face.side == SheetSide::back && (only[zone] == noIndex || only[zone] == face.tag);
      only[zone] = face.tag;
    }
  }
  return solid;
}

/// Zones that see the sides of a turned domain, which are sheets there, from outside.
std::vector<char> zonesBeyond(const Zones& zones, const Crossings& crossings, std::size_t surfaceCount)
{
  std::vector<char> beyond(zones.count(), 0);
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (face.tag >= surfaceCount && face.opposite != noIndex && face.side == SheetSide::front)
    {
      beyond[zones.ofPoint[face.element]] = 1;
    }
  }
  return beyond;
}

} // namespace

void describeZones(std::vector<ZoneSummary>& summaries, const Zones& zones, const Crossings& crossings,
                   const GridPlaces& grid, std::size_t surfaceCount, const RunContext& context)
{
  measure(summaries, zones, grid, context);
  context.progress.check();
  const std::vector<char> wide = wideZones(zones, crossings);
  const std::vector<char> solid = solidZones(zones, crossings, surfaceCount);
  const std::vector<char> beyond = zonesBeyond(zones, crossings, surfaceCount);
  constexpr SideBits bottom = SideBits{1} << zMin;
  for (std::size_t i = 0; i < summaries.size(); ++i)
  {
    summaries[i].kind = beyond[i]                         ? ZoneKind::beyond
                        : (zones.sides[i] & ~bottom) != 0 ? ZoneKind::open
                        : solid[i]                        ? ZoneKind::solid
                        : wide[i]                         ? ZoneKind::room
                                                          : ZoneKind::narrow;
  }
}

} // namespace atria
