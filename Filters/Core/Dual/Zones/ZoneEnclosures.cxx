// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/ZoneEnclosures.h"

#include "Support/Error.h"

#include <algorithm>

namespace atria {

namespace {

constexpr SideBits bottom = SideBits{1} << zMin;
constexpr SideBits top = SideBits{1} << zMax;

/// Least volume of rooms, over that of the walls around them, with which rooms are kept instead of walls. Furniture
/// hardly ever fills half of a room without touching its sides. Walls of a bunker may be larger than its rooms, but are
/// recognized by their winding.
constexpr double leastRooms = 1.0;
constexpr double leastRoomsWound = 0.1;

/// The part of faces that must agree for the winding to count.
constexpr double clearPart = 0.9;

/// Rooms behind thick walls, as far as zones show them.
class ThickWalls
{
public:
  ThickWalls(const Zones& allZones, const ZoneFacts& allFacts, const ZoneEnclosures& bodies,
             const std::vector<char>& within, const GridFrame& frame)
      : zones(allZones), facts(allFacts), enclosures(bodies), isWithin(within),
        volumes(zoneVolumes(allFacts, allZones.count(), frame))
  {
    for (std::size_t zone = 0; zone < zones.count(); ++zone)
    {
      isOpenAbove = isOpenAbove || (isWithin[zone] && (zones.openSides[zone] & top) != 0);
    }
  }

  std::vector<char> keepRooms(std::vector<char> kept) const
  {
    std::vector<std::size_t> walls;
    std::vector<std::size_t> rooms;
    for (std::size_t zone = 0; zone < zones.count(); ++zone)
    {
      if (kept[zone] && isWall(zone))
      {
        walls.push_back(zone);
      }
      else if (isWithin[zone] && isRoom(zone, kept[zone] != 0))
      {
        rooms.push_back(zone);
      }
    }
    const bool isEmpty = std::ranges::find(kept, 1) == kept.end();
    if (rooms.empty() || (walls.empty() && !isEmpty) || volumeOf(rooms) < leastPart(walls, rooms) * volumeOf(walls))
    {
      return kept;
    }
    std::ranges::for_each(walls, [&](std::size_t zone) { kept[zone] = 0; });
    std::ranges::for_each(rooms, [&](std::size_t zone) { kept[zone] = 1; });
    return kept;
  }

private:
  bool seesBacks(std::size_t zone) const
  {
    const auto& [fronts, backs] = facts.zones[zone].faces;
    return backs > 0 && static_cast<double>(backs) >= clearPart * static_cast<double>(fronts + backs);
  }

  bool isWall(std::size_t zone) const
  {
    return (zones.openSides[zone] & ~bottom) == 0 && (enclosures.isWithinBody(zone) || seesBacks(zone));
  }

  /// True if the zone lies in a hollow, is closed, or is open to the sides like a channel; false if it is under a
  /// terrain.
  bool isRoom(std::size_t zone, bool kept) const
  {
    if (facts.zones[zone].isBeyond || enclosures.isWithinBody(zone))
    {
      return false;
    }
    const bool isHollow = enclosures.depth(zone) > 0;
    const bool reachesSides = (zones.sides[zone] & ~bottom) != 0;
    const bool reachesBottom = (zones.sides[zone] & bottom) != 0;
    const bool isRoomy = facts.zones[zone].isWide && !seesBacks(zone) && !(reachesSides && reachesBottom && !kept);
    return isHollow || (isRoomy && !isOpenAbove);
  }

  double volumeOf(const std::vector<std::size_t>& some) const
  {
    double sum = 0.0;
    std::ranges::for_each(some, [&](std::size_t zone) { sum += volumes[zone]; });
    return sum;
  }

  double leastPart(const std::vector<std::size_t>& walls, const std::vector<std::size_t>& rooms) const
  {
    ZoneFacts::Faces ofWalls;
    ZoneFacts::Faces ofRooms;
    std::ranges::for_each(walls, [&](std::size_t zone) { ofWalls.add(facts.zones[zone].faces); });
    std::ranges::for_each(rooms, [&](std::size_t zone) { ofRooms.add(facts.zones[zone].faces); });
    const auto isClear = [](std::size_t part, std::size_t other) {
      return static_cast<double>(part) >= clearPart * static_cast<double>(part + other);
    };
    // The repair turns closed bodies outwards; as drawn, hollows are recognized by their winding.
    const bool areHollows = std::ranges::all_of(rooms, [&](std::size_t zone) { return enclosures.isHollow(zone); });
    const bool areClear = isClear(ofWalls.backs, ofWalls.fronts) && isClear(ofRooms.fronts, ofRooms.backs);
    return areHollows || areClear ? leastRoomsWound : leastRooms;
  }

  const Zones& zones;
  const ZoneFacts& facts;
  const ZoneEnclosures& enclosures;
  const std::vector<char>& isWithin;
  std::vector<double> volumes;
  /// True if the top of the domain is bare somewhere.
  bool isOpenAbove = false;
};

} // namespace

ZoneEnclosures::ZoneEnclosures(const ClosedBodies& bodies, const ZoneFacts& facts, const GridFrame& frame,
                               const RunContext& context)
{
  if (facts.zones.size() < 2)
  {
    return;
  }
  std::ranges::transform(bodies.bodies(), std::back_inserter(volumes_), &DrawnBody::volume);
  around_.resize(facts.zones.size());
  context.executor.forEach(around_.size(), 16, [&](std::size_t zone) {
    if (facts.zones[zone].hasPlace)
    {
      around_[zone] = bodies.around(frame.placement.toModel(facts.zones[zone].inside));
    }
  });
  for (const std::vector<Index>& some : around_)
  {
    for (std::size_t i = 1; i < some.size(); ++i)
    {
      const std::pair pair(some[i], some[i - 1]);
      if (!isInside_.contains(pair))
      {
        isInside_[pair] = bodies.isInside(pair.first, pair.second);
      }
    }
  }
  crossesLarger_.assign(volumes_.size(), 0);
  for (const auto& [pair, isInside] : isInside_)
  {
    crossesLarger_[pair.first] |= isInside ? 0 : 1;
  }
}

bool ZoneEnclosures::isInside(Index inner, Index outer) const
{
  const auto found = isInside_.find({inner, outer});
  return found != isInside_.end() && found->second;
}

bool ZoneEnclosures::isChain(const std::vector<Index>& bodies) const
{
  bool isChain = true;
  for (std::size_t i = 1; i < bodies.size(); ++i)
  {
    isChain = isChain && isInside(bodies[i], bodies[i - 1]);
  }
  return isChain;
}

bool ZoneEnclosures::isWithinBody(std::size_t zone) const
{
  if (depth(zone) == 0)
  {
    return false;
  }
  const bool isHollowByDepth = depth(zone) % 2 == 0 && isChain(around_[zone]);
  return !isHollowByDepth || (crossesLarger_[around_[zone].back()] && !isHollow(zone));
}

bool ZoneEnclosures::isHollow(std::size_t zone) const
{
  if (depth(zone) < 2)
  {
    return false;
  }
  const Index inner = around_[zone].back();
  const Index outer = around_[zone][depth(zone) - 2];
  return isInside(inner, outer) && (volumes_[inner] < 0.0) != (volumes_[outer] < 0.0);
}

std::vector<char> ZoneEnclosures::holdsAir(const std::vector<char>& kept) const
{
  std::vector<char> holdsAir(volumes_.size(), 0);
  for (std::size_t zone = 0; zone < around_.size(); ++zone)
  {
    if (kept[zone] && isWithinBody(zone))
    {
      std::ranges::for_each(around_[zone], [&](Index body) { holdsAir[body] = 1; });
    }
  }
  return holdsAir;
}

bool SolidPlaces::contains(const Vec3& place) const
{
  if (!bodies_)
  {
    return false;
  }
  const std::vector<Index> around = bodies_->around(placement_.toModel(place));
  return !around.empty() &&
         std::ranges::none_of(around, [&](Index body) { return body < holdsAir_.size() && holdsAir_[body] != 0; });
}

std::vector<Enclosure> ZoneEnclosures::kinds(const std::vector<char>& kept) const
{
  const std::vector<char> airs = holdsAir(kept);
  std::vector<Enclosure> out(kept.size(), Enclosure::none);
  for (std::size_t zone = 0; zone < around_.size(); ++zone)
  {
    Index before = noIndex;
    for (const Index body : around_[zone])
    {
      if (!airs[body])
      {
        const bool isHollow = out[zone] == Enclosure::solid && isInside(body, before) &&
                              (volumes_[body] < 0.0) != (volumes_[before] < 0.0);
        out[zone] = isHollow ? Enclosure::hollow : Enclosure::solid;
        before = body;
      }
    }
  }
  return out;
}

std::vector<char> chooseZones(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones,
                              const std::vector<double>& farthest, const ZoneFacts& facts,
                              const ZoneEnclosures& enclosures, const GridFrame& frame)
{
  std::vector<char> kept = zonesByRule(zones, rule, seedZones);
  const bool isAnyKept = std::ranges::find(kept, 1) != kept.end();
  std::vector<char> isWithin(zones.count(), 1);
  if (!farthest.empty())
  {
    std::ranges::transform(farthest, isWithin.begin(), [](double beyond) { return beyond < 0.0 ? 1 : 0; });
  }
  std::ranges::transform(kept, isWithin, kept.begin(), [](char a, char b) { return a && b ? 1 : 0; });
  if (rule == ZoneRule::outside)
  {
    kept = ThickWalls(zones, facts, enclosures, isWithin, frame).keepRooms(std::move(kept));
  }
  if (std::ranges::find(kept, 1) == kept.end() && isAnyKept)
  {
    throw Error("no zone is left to mesh inside the domain: keep all zones, or give seeds inside it");
  }
  checkKept(kept, rule);
  return kept;
}

} // namespace atria
