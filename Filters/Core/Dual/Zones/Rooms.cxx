// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Rooms.h"

#include "Dual/Grid/JoinedPoints.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace atria {

namespace {

/// Facts about one of the parts into which face zones divide zones, or about some points of it.
struct RoomPart
{
  std::size_t size = 0;
  bool isWide = false;    ///< has a point that is not at the border
  bool isOutside = false; ///< reaches a bare side of the domain other than the bottom
  bool isInRoom = false;  ///< is kept, and not the inside of a solid

  void add(const RoomPart& other)
  {
    size += other.size;
    isWide = isWide || other.isWide;
    isOutside = isOutside || other.isOutside;
    isInRoom = isInRoom || other.isInRoom;
  }
};

/// Number of faces of face zones between two parts, by pair of parts.
using PartBorders = std::map<std::pair<Index, Index>, std::size_t>;

/// Rooms of parts, which are in the order of their first points.
struct PartedRooms
{
  std::vector<std::int32_t> ofPart;
  std::size_t count = 0;
  bool hasOutside = false;
  /// Pairs of a part that is no room of its own and the part it was joined with, in both orders; sorted.
  std::vector<std::pair<Index, Index>> narrow;
};

constexpr std::uint8_t bitOf(int direction) { return static_cast<std::uint8_t>(1u << direction); }

/// Grid points, divided by face zones.
class PartedPoints
{
public:
  PartedPoints(const Crossings& found, const std::vector<ZoneFace>& zoneFaces, const SurfaceModel& surfaces)
      : crossings(found), model(surfaces), blocked(found.neighbors.size(), 0)
  {
    for (const ZoneFace& face : zoneFaces)
    {
      if (model.kinds[face.tag] == SurfaceKind::faceZone)
      {
        const auto other = static_cast<Index>(crossings.neighbors[face.element][face.direction]);
        blocked[face.element] |= bitOf(face.direction);
        blocked[other] |= bitOf(opposite(face.direction));
        between.emplace_back(face.element, other);
      }
    }
  }

  /// Returns the neighbor in a direction, if nothing is between; noIndex otherwise.
  Index nextTo(Index point, int direction) const
  {
    const std::int32_t code = crossings.neighbors[point][direction];
    return code >= 0 && (blocked[point] & bitOf(direction)) == 0 ? static_cast<Index>(code) : noIndex;
  }

  /// Returns the facts about sets of own points.
  std::vector<RoomPart> describe(const PointSets& sets, const IndexRange& own, const Zones& zones,
                                 const std::vector<ZoneSummary>& summaries, const RoomOptions& options) const
  {
    std::vector<RoomPart> parts(sets.count);
    for (Index i = 0; i < own.size(); ++i)
    {
      RoomPart& part = parts[sets.ofOwn[i]];
      const ZoneSummary& zone = summaries[static_cast<std::size_t>(zones.ofPoint[own.begin + i])];
      ++part.size;
      part.isInRoom = zone.kept && zone.kind != ZoneKind::solid;
      part.isWide = part.isWide || isWide(own.begin + i);
    }
    const std::size_t surfaces = model.names.size();
    for (const BoundaryFace& face : crossings.boundaryFaces)
    {
      const bool isBare = face.onDomainSide && face.tag >= surfaces && face.tag - surfaces != zMin;
      if (!options.sidesAreWalls && isBare && own.contains(face.element))
      {
        parts[sets.ofOwn[face.element - own.begin]].isOutside = true;
      }
    }
    return parts;
  }

  /// Counts the faces between parts that belong to own points. `partOf` has one entry per grid point.
  PartBorders borders(const IndexRange& own, const std::vector<std::int32_t>& partOf) const
  {
    PartBorders borders;
    for (const auto& [a, b] : between)
    {
      if (own.contains(a))
      {
        ++borders[{static_cast<Index>(partOf[a]), static_cast<Index>(partOf[b])}];
      }
    }
    return borders;
  }

private:
  bool isWide(Index point) const
  {
    return nextTo(point, 0) != noIndex && nextTo(point, 1) != noIndex && nextTo(point, 2) != noIndex &&
           nextTo(point, 3) != noIndex && nextTo(point, 4) != noIndex && nextTo(point, 5) != noIndex;
  }

  const Crossings& crossings;
  const SurfaceModel& model;
  /// One entry per grid point, with a bit for each direction in which a face of a face zone is.
  std::vector<std::uint8_t> blocked;
  std::vector<std::pair<Index, Index>> between;
};

PartBorders addBorders(const PartBorders& own, RankExchange& exchange)
{
  struct Entry
  {
    Index part;
    Index other;
    std::size_t faces;
  };
  std::vector<Entry> entries;
  for (const auto& [sides, faces] : own)
  {
    entries.push_back({sides.first, sides.second, faces});
  }
  PartBorders all;
  for (const Entry& entry : joinAll(exchange, std::move(entries)))
  {
    all[{entry.part, entry.other}] += entry.faces;
  }
  return all;
}

class PartJoiner
{
public:
  PartJoiner(const std::vector<RoomPart>& known, const PartBorders& borders) : parts(known), sets(parts.size())
  {
    joinOutside();
    joinNarrow(borders);
  }

  PartedRooms number()
  {
    std::vector<std::size_t> sizes(parts.size(), 0);
    std::vector<char> outside(parts.size(), 0);
    std::vector<Index> roots;
    for (Index part = 0; part < parts.size(); ++part)
    {
      const Index root = sets.find(part);
      sizes[root] += parts[part].isInRoom ? parts[part].size : 0;
      outside[root] |= parts[part].isOutside ? 1 : 0;
    }
    for (Index part = 0; part < parts.size(); ++part)
    {
      if (sets.find(part) == part && sizes[part] > 0)
      {
        roots.push_back(part);
      }
    }
    std::ranges::sort(roots, [&](Index l, Index r) {
      return std::tuple(!outside[l], sizes[r], l) < std::tuple(!outside[r], sizes[l], r);
    });
    std::vector<std::int32_t> roomOf(parts.size(), noRoom);
    for (std::size_t room = 0; room < roots.size(); ++room)
    {
      roomOf[roots[room]] = static_cast<std::int32_t>(room);
    }
    out.count = roots.size();
    out.hasOutside = !roots.empty() && outside[roots[0]] != 0;
    for (Index part = 0; part < parts.size(); ++part)
    {
      out.ofPart.push_back(parts[part].isInRoom ? roomOf[sets.find(part)] : noRoom);
    }
    return std::move(out);
  }

private:
  void joinOutside()
  {
    Index outside = noIndex;
    for (Index part = 0; part < parts.size(); ++part)
    {
      if (parts[part].isOutside && parts[part].isInRoom)
      {
        outside = outside == noIndex ? part : outside;
        sets.join(outside, part);
      }
    }
  }

  /// Joins parts that are not wide to the parts with which they have most faces in common.
  void joinNarrow(const PartBorders& borders)
  {
    PartBorders shared;
    for (const auto& [sides, count] : borders)
    {
      shared[sides] += count;
      shared[{sides.second, sides.first}] += count;
    }
    for (auto at = shared.begin(); at != shared.end();)
    {
      const Index part = at->first.first;
      std::pair<std::size_t, Index> most{0, noIndex};
      for (; at != shared.end() && at->first.first == part; ++at)
      {
        const Index other = at->first.second;
        // A narrow part joins only narrow parts with lower numbers, so that no two wait for each other.
        const bool takes = other != part && (parts[other].isWide || other < part);
        most = takes && at->second > most.first ? std::pair(at->second, other) : most;
      }
      if (!parts[part].isWide && !parts[part].isOutside && most.second != noIndex)
      {
        sets.join(part, most.second);
        out.narrow.emplace_back(part, most.second);
        out.narrow.emplace_back(most.second, part);
      }
    }
    std::ranges::sort(out.narrow);
  }

  const std::vector<RoomPart>& parts;
  UnionFind sets;
  PartedRooms out;
};

/// Returns the rooms of points from those of their parts, and removes faces that lead nowhere.
Rooms roomsOf(const PartedRooms& rooms, const std::vector<std::int32_t>& partOf, const Crossings& crossings,
              std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model)
{
  Rooms out{{}, rooms.count, rooms.hasOutside};
  out.ofPoint.resize(partOf.size());
  std::ranges::transform(partOf, out.ofPoint.begin(), [&](std::int32_t part) {
    return static_cast<std::size_t>(part) < rooms.ofPart.size() ? rooms.ofPart[static_cast<std::size_t>(part)] : noRoom;
  });
  // Removes openings that lead to a narrow part of a room.
  std::erase_if(zoneFaces, [&](const ZoneFace& face) {
    const auto other = static_cast<Index>(crossings.neighbors[face.element][face.direction]);
    const std::pair sides{static_cast<Index>(partOf[face.element]), static_cast<Index>(partOf[other])};
    return model.wallOf(face.tag) != face.tag && std::ranges::binary_search(rooms.narrow, sides);
  });
  return out;
}

} // namespace

bool hasRooms(const SurfaceModel& model)
{
  return std::ranges::find(model.kinds, SurfaceKind::faceZone) != model.kinds.end();
}

Rooms findRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                std::vector<ZoneFace>& zoneFaces, const GridPart& part, const SurfaceModel& model,
                const RoomOptions& options, const RunContext& context)
{
  if (!hasRooms(model))
  {
    return {};
  }
  context.progress.check();
  const PartedPoints points(crossings, zoneFaces, model);
  const IndexRange& own = part.points();
  const auto nextTo = [&](Index point, int direction) { return points.nextTo(point, direction); };
  const PointSets sets = joinOwn(own, nextTo, context);
  const JoinedSets joined = part.join(sets, nextTo);
  const std::vector<RoomPart> parts = part.sum(joined, points.describe(sets, own, zones, summaries, options),
                                               [](const RoomPart& more, RoomPart& sum) { sum.add(more); });
  const std::vector<Index>& ofSet = joined.ofSet[static_cast<std::size_t>(part.exchange().rank())];
  std::vector<std::int32_t> partOf(crossings.neighbors.size());
  for (Index i = 0; i < own.size(); ++i)
  {
    partOf[own.begin + i] = static_cast<std::int32_t>(ofSet[sets.ofOwn[i]]);
  }
  part.refresh(partOf, static_cast<std::int32_t>(joined.count));
  const PartBorders borders = addBorders(points.borders(own, partOf), part.exchange());
  return roomsOf(PartJoiner(parts, borders).number(), partOf, crossings, zoneFaces, model);
}

} // namespace atria
