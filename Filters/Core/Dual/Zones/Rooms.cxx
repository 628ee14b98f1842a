// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/Rooms.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace atria {

namespace {

constexpr std::uint8_t bitOf(int direction) { return static_cast<std::uint8_t>(1u << direction); }

/// Parts of zones, and what is to be known of them to make them rooms.
struct Parts
{
  std::vector<Index> ofPoint;
  std::vector<std::size_t> sizes;
  std::vector<char> wide;    ///< has a point that is not at the border
  std::vector<char> outside; ///< reaches a bare side of the domain but the bottom
  std::vector<char> inRoom;  ///< is kept, and not the inside of a solid
};

class RoomFinder
{
public:
  RoomFinder(const Crossings& found, const std::vector<ZoneFace>& faces, const SurfaceModel& surfaces)
      : crossings(found), model(surfaces), blocked(found.neighbors.size(), 0)
  {
    for (const ZoneFace& face : faces)
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

  Rooms find(const Zones& zones, const std::vector<ZoneSummary>& summaries, const RoomOptions& options,
             const RunContext& context)
  {
    findParts(context);
    describeParts(zones, summaries, options);
    UnionFind sets = joinParts();
    return number(sets);
  }

  /// Whether a face is that of an opening which leads to a narrow part of a room.
  bool leadsNowhere(const ZoneFace& face) const
  {
    const std::pair sides{parts.ofPoint[face.element],
                          parts.ofPoint[crossings.neighbors[face.element][face.direction]]};
    return model.wallOf(face.tag) != face.tag && std::ranges::binary_search(narrow, sides);
  }

private:
  /// The neighbor in a direction, if nothing is between; noIndex otherwise.
  Index nextTo(std::size_t point, int direction) const
  {
    const std::int32_t code = crossings.neighbors[point][direction];
    return code >= 0 && (blocked[point] & bitOf(direction)) == 0 ? static_cast<Index>(code) : noIndex;
  }

  void findParts(const RunContext& context)
  {
    const std::size_t count = crossings.neighbors.size();
    UnionFind sets(count);
    for (std::size_t point = 0; point < count; ++point)
    {
      if (point % 65536 == 0)
      {
        context.progress.check();
      }
      for (int direction = 1; direction < 6; direction += 2)
      {
        if (const Index other = nextTo(point, direction); other != noIndex)
        {
          sets.join(static_cast<Index>(point), other);
        }
      }
    }
    parts.ofPoint.resize(count);
    for (Index point = 0; point < count; ++point)
    {
      const Index root = sets.find(point); // the smallest of its set, so numbered before
      parts.ofPoint[point] = root == point ? static_cast<Index>(parts.sizes.size()) : parts.ofPoint[root];
      if (root == point)
      {
        parts.sizes.push_back(0);
      }
      ++parts.sizes[parts.ofPoint[point]];
    }
  }

  void describeParts(const Zones& zones, const std::vector<ZoneSummary>& summaries, const RoomOptions& options)
  {
    parts.wide.assign(parts.sizes.size(), 0);
    parts.outside.assign(parts.sizes.size(), 0);
    parts.inRoom.assign(parts.sizes.size(), 0);
    for (std::size_t point = 0; point < parts.ofPoint.size(); ++point)
    {
      const Index part = parts.ofPoint[point];
      const ZoneSummary& zone = summaries[zones.ofPoint[point]];
      parts.inRoom[part] = zone.kept && zone.kind != ZoneKind::solid ? 1 : 0;
      if (!parts.wide[part])
      {
        parts.wide[part] = nextTo(point, 0) != noIndex && nextTo(point, 1) != noIndex && nextTo(point, 2) != noIndex &&
                           nextTo(point, 3) != noIndex && nextTo(point, 4) != noIndex && nextTo(point, 5) != noIndex;
      }
    }
    const std::size_t surfaces = model.names.size();
    for (const BoundaryFace& face : crossings.boundaryFaces)
    {
      if (!options.sidesAreWalls && face.onDomainSide && face.tag >= surfaces && face.tag - surfaces != zMin)
      {
        parts.outside[parts.ofPoint[face.element]] = 1;
      }
    }
  }

  /// Joins the parts outdoors, and those that are not wide to the ones beside them.
  UnionFind joinParts()
  {
    UnionFind sets(parts.sizes.size());
    Index outside = noIndex;
    for (Index part = 0; part < parts.sizes.size(); ++part)
    {
      if (parts.outside[part] && parts.inRoom[part])
      {
        outside = outside == noIndex ? part : outside;
        sets.join(outside, part);
      }
    }
    std::map<std::pair<Index, Index>, int> shared;
    for (const auto& [a, b] : between)
    {
      const Index p = parts.ofPoint[a];
      const Index q = parts.ofPoint[b];
      ++shared[{p, q}];
      ++shared[{q, p}];
    }
    for (auto at = shared.begin(); at != shared.end();)
    {
      const Index part = at->first.first;
      std::pair most{0, noIndex};
      for (; at != shared.end() && at->first.first == part; ++at)
      {
        const Index other = at->first.second;
        // Narrow ones take each other in the order of their numbers, so that no two wait for each other.
        const bool takes = other != part && (parts.wide[other] || other < part);
        most = takes && at->second > most.first ? std::pair(at->second, other) : most;
      }
      if (!parts.wide[part] && !parts.outside[part] && most.second != noIndex)
      {
        sets.join(part, most.second);
        narrow.emplace_back(part, most.second);
        narrow.emplace_back(most.second, part);
      }
    }
    std::ranges::sort(narrow);
    return sets;
  }

  Rooms number(UnionFind& sets) const
  {
    const std::size_t count = parts.sizes.size();
    std::vector<std::size_t> sizes(count, 0);
    std::vector<char> outside(count, 0);
    std::vector<Index> roots;
    for (Index part = 0; part < count; ++part)
    {
      const Index root = sets.find(part);
      sizes[root] += parts.inRoom[part] ? parts.sizes[part] : 0;
      outside[root] |= parts.outside[part];
    }
    for (Index part = 0; part < count; ++part)
    {
      if (sets.find(part) == part && sizes[part] > 0)
      {
        roots.push_back(part);
      }
    }
    std::ranges::sort(roots, [&](Index l, Index r) {
      return std::tuple(!outside[l], sizes[r], l) < std::tuple(!outside[r], sizes[l], r);
    });
    std::vector<std::int32_t> roomOf(count, noRoom);
    for (std::size_t room = 0; room < roots.size(); ++room)
    {
      roomOf[roots[room]] = static_cast<std::int32_t>(room);
    }
    Rooms rooms{{}, roots.size(), !roots.empty() && outside[roots[0]] != 0};
    rooms.ofPoint.resize(parts.ofPoint.size());
    for (std::size_t point = 0; point < rooms.ofPoint.size(); ++point)
    {
      const Index part = parts.ofPoint[point];
      rooms.ofPoint[point] = parts.inRoom[part] ? roomOf[sets.find(part)] : noRoom;
    }
    return rooms;
  }

  const Crossings& crossings;
  const SurfaceModel& model;
  /// By direction, where a face of a face zone is.
  std::vector<std::uint8_t> blocked;
  std::vector<std::pair<Index, Index>> between;
  Parts parts;
  /// Parts that are narrow and those they were joined with, either way; sorted.
  std::vector<std::pair<Index, Index>> narrow;
};

} // namespace

Rooms findRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model, const RoomOptions& options,
                const RunContext& context)
{
  if (std::ranges::find(model.kinds, SurfaceKind::faceZone) == model.kinds.end())
  {
    return {};
  }
  RoomFinder finder(crossings, zoneFaces, model);
  Rooms rooms = finder.find(zones, summaries, options, context);
  std::erase_if(zoneFaces, [&](const ZoneFace& face) { return finder.leadsNowhere(face); });
  return rooms;
}

} // namespace atria
