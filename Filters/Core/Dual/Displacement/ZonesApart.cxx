// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/ZonesApart.h"

#include "Dual/Zones/Zones.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <unordered_map>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

/// Follows zones, breadth first, from points that keep theirs through moved points and points of no zone.
class JoiningPoints
{
public:
  JoiningPoints(const GridPlaces& places, const Crossings& found, const std::vector<Index>& zones)
      : grid(places), crossings(found), apart(zones)
  {
  }

  std::vector<Index> find()
  {
    for (const Index point : grid.displacedPoints())
    {
      for (const std::int32_t neighbor : crossings.neighbors[point])
      {
        if (neighbor >= 0 && isFixed(static_cast<Index>(neighbor)))
        {
          visit(static_cast<Index>(neighbor), point);
        }
      }
    }
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      for (const std::int32_t neighbor : crossings.neighbors[front[i]])
      {
        if (neighbor >= 0)
        {
          visit(front[i], static_cast<Index>(neighbor));
        }
      }
    }
    return {joining.begin(), joining.end()};
  }

private:
  struct Reached
  {
    Index zone;
    Index from;
  };

  bool isFixed(Index point) const { return apart[point] != noIndex && !grid.isDisplaced(point); }

  void visit(Index from, Index point)
  {
    if (apart[from] == zoneElsewhere || apart[point] == zoneElsewhere)
    {
      return;
    }
    const Index zone = isFixed(from) ? apart[from] : reached.at(from).zone;
    if (!isFixed(point) && reached.try_emplace(point, Reached{zone, from}).second)
    {
      front.push_back(point);
      return;
    }
    const Index there = isFixed(point) ? apart[point] : reached.at(point).zone;
    if (there != zone)
    {
      addMoved(point);
      addMoved(from);
    }
  }

  /// Adds the last moved point on the way to a point, if there is one.
  void addMoved(Index point)
  {
    while (!isFixed(point) && !grid.isDisplaced(point))
    {
      point = reached.at(point).from;
    }
    if (grid.isDisplaced(point))
    {
      joining.insert(point);
    }
  }

  const GridPlaces& grid;
  const Crossings& crossings;
  const std::vector<Index>& apart;
  std::unordered_map<Index, Reached> reached;
  std::vector<Index> front;
  std::set<Index> joining;
};

/// Marks the grid points around which surfaces cut no octant.
std::vector<char> pointsInTheOpen(const GridPoints& points, const Crossings& crossings, const RunContext& context)
{
  std::vector<char> isCut(points.atCorner.size(), 0);
  for (const CrossedEdge& edge : crossings.crossedEdges)
  {
    std::for_each(edge.segment.about.begin(), edge.segment.about.end(), [&](Index leaf) { isCut[leaf] = 1; });
  }
  std::vector<char> isOpen(points.size());
  context.executor.forEach(isOpen.size(), grain, [&](std::size_t point) {
    const auto& leaves = points.leaves[point];
    isOpen[point] = std::none_of(leaves.begin(), leaves.end(), [&](Index leaf) { return isCut[leaf] != 0; }) ? 1 : 0;
  });
  return isOpen;
}

} // namespace

std::vector<Index> wideZones(const GridPoints& points, const Crossings& crossings, std::size_t surfaceCount,
                             const GridPart& part, const RunContext& context)
{
  const Zones zones = findZones(crossings, surfaceCount, part, context);
  const std::vector<char> isOpen = pointsInTheOpen(points, crossings, context);
  std::vector<char> isWide(zones.count(), 0);
  const IndexRange& own = part.points();
  context.executor.forEach(own.size(), grain, [&](std::size_t i) {
    const std::size_t point = own.begin + i;
    const std::atomic_ref wide(isWide[static_cast<std::size_t>(zones.ofPoint[point])]);
    if (isOpen[point] && wide.load(std::memory_order_relaxed) == 0)
    {
      wide.store(1, std::memory_order_relaxed);
    }
  });
  isWide = anyOfAll(part.exchange(), std::move(isWide));
  std::vector<Index> out(zones.ofPoint.size());
  context.executor.forEach(out.size(), grain, [&](std::size_t point) {
    const auto zone = static_cast<std::size_t>(zones.ofPoint[point]);
    out[point] = zone >= isWide.size() ? zoneElsewhere : isWide[zone] ? static_cast<Index>(zone) : noIndex;
  });
  return out;
}

std::vector<Index> joiningPoints(const GridPlaces& grid, const Crossings& crossings, const std::vector<Index>& zones)
{
  return JoiningPoints(grid, crossings, zones).find();
}

} // namespace atria
