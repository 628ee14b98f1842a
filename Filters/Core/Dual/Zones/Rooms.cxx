// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Rooms.h"

#include <algorithm>
#include <tuple>

namespace atria {

namespace {

constexpr std::uint8_t bitOf(int direction) { return static_cast<std::uint8_t>(1u << direction); }

struct Parts
{
  std::vector<Index> ofPoint;
  std::size_t count = 0;
};

Parts findParts(const PartedPoints& points, std::size_t pointCount, const RunContext& context)
{
  UnionFind sets(pointCount);
  for (Index point = 0; point < pointCount; ++point)
  {
    if (point % 65536 == 0)
    {
      context.progress.check();
    }
    for (int direction = 1; direction < 6; direction += 2)
    {
      if (const Index other = points.nextTo(point, direction); other != noIndex)
      {
        sets.join(point, other);
      }
    }
  }
  Parts parts{std::vector<Index>(pointCount)};
  for (Index point = 0; point < pointCount; ++point)
  {
    const Index root = sets.find(point); // the smallest of its set, so numbered before
    parts.ofPoint[point] = root == point ? static_cast<Index>(parts.count++) : parts.ofPoint[root];
  }
  return parts;
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

  /// Joins those that are not wide to the ones beside them.
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
        // Narrow ones take each other in the order of their numbers, so that no two wait for each other.
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

} // namespace

void RoomPart::add(const RoomPart& other)
{
  size += other.size;
  isWide = isWide || other.isWide;
  isOutside = isOutside || other.isOutside;
  isInRoom = isInRoom || other.isInRoom;
}

PartedPoints::PartedPoints(const Crossings& found, const std::vector<ZoneFace>& zoneFaces, const SurfaceModel& surfaces)
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

Index PartedPoints::nextTo(Index point, int direction) const
{
  const std::int32_t code = crossings.neighbors[point][direction];
  return code >= 0 && (blocked[point] & bitOf(direction)) == 0 ? static_cast<Index>(code) : noIndex;
}

bool PartedPoints::isWide(Index point) const
{
  return nextTo(point, 0) != noIndex && nextTo(point, 1) != noIndex && nextTo(point, 2) != noIndex &&
         nextTo(point, 3) != noIndex && nextTo(point, 4) != noIndex && nextTo(point, 5) != noIndex;
}

std::vector<RoomPart> PartedPoints::describe(Index first, std::span<const Index> partOf, std::size_t partCount,
                                             const Zones& zones, const std::vector<ZoneSummary>& summaries,
                                             const RoomOptions& options) const
{
  std::vector<RoomPart> parts(partCount);
  for (Index i = 0; i < partOf.size(); ++i)
  {
    RoomPart& part = parts[partOf[i]];
    const ZoneSummary& zone = summaries[static_cast<std::size_t>(zones.ofPoint[first + i])];
    ++part.size;
    part.isInRoom = zone.kept && zone.kind != ZoneKind::solid;
    part.isWide = part.isWide || isWide(first + i);
  }
  const std::size_t surfaces = model.names.size();
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    const bool isBare = face.onDomainSide && face.tag >= surfaces && face.tag - surfaces != zMin;
    if (!options.sidesAreWalls && isBare && face.element >= first && face.element - first < partOf.size())
    {
      parts[partOf[face.element - first]].isOutside = true;
    }
  }
  return parts;
}

PartBorders PartedPoints::borders(Index first, Index end, std::span<const Index> partOf) const
{
  PartBorders borders;
  for (const auto& [a, b] : between)
  {
    if (a >= first && a < end)
    {
      ++borders[{partOf[a], partOf[b]}];
    }
  }
  return borders;
}

PartedRooms joinParts(const std::vector<RoomPart>& parts, const PartBorders& borders)
{
  return PartJoiner(parts, borders).number();
}

Rooms roomsOf(const PartedRooms& rooms, std::span<const Index> partOf, const Crossings& crossings,
              std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model)
{
  Rooms out{{}, rooms.count, rooms.hasOutside};
  out.ofPoint.resize(partOf.size());
  std::ranges::transform(partOf, out.ofPoint.begin(),
                         [&](Index part) { return part < rooms.ofPart.size() ? rooms.ofPart[part] : noRoom; });
  // Openings that lead to a narrow part of a room.
  std::erase_if(zoneFaces, [&](const ZoneFace& face) {
    const std::pair sides{partOf[face.element],
                          partOf[static_cast<Index>(crossings.neighbors[face.element][face.direction])]};
    return model.wallOf(face.tag) != face.tag && std::ranges::binary_search(rooms.narrow, sides);
  });
  return out;
}

bool hasRooms(const SurfaceModel& model)
{
  return std::ranges::find(model.kinds, SurfaceKind::faceZone) != model.kinds.end();
}

Rooms findRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model, const RoomOptions& options,
                const RunContext& context)
{
  if (!hasRooms(model))
  {
    return {};
  }
  const PartedPoints points(crossings, zoneFaces, model);
  const auto count = static_cast<Index>(crossings.neighbors.size());
  const Parts parts = findParts(points, count, context);
  const PartedRooms rooms = joinParts(points.describe(0, parts.ofPoint, parts.count, zones, summaries, options),
                                      points.borders(0, count, parts.ofPoint));
  return roomsOf(rooms, parts.ofPoint, crossings, zoneFaces, model);
}

} // namespace atria
