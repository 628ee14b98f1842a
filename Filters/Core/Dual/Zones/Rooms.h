// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the kept zones into rooms at face zones.
#pragma once

#include "Dual/Zones/ZoneSummary.h"

#include <map>
#include <span>

namespace atria {

/// Value for grid points that are in no room.
inline constexpr std::int32_t noRoom = -1;

/// Rooms are the parts of the kept zones that faces of face zones divide them into. The outdoors is one room, whatever
/// parts it has: those that reach a side of the domain, but for its bottom, where no surface lies on it. A part all of
/// whose points are at its border, such as a sliver between a wall and a face zone, belongs to the room with which it
/// has most faces in common. Insides of solids are in no room.
struct Rooms
{
  /// Per grid point; empty where no surface is a face zone.
  std::vector<std::int32_t> ofPoint;
  /// The outdoors first, if there are any, then by falling number of points.
  std::size_t count = 0;
  bool hasOutside = false;
};

struct RoomOptions
{
  /// The domain is a room or a building whose walls are its sides: there are no outdoors.
  bool sidesAreWalls = false;
};

/// True if there are rooms to find: some surface is a face zone.
bool hasRooms(const SurfaceModel& model);

/// `zoneFaces` as findZoneFaces() has them, `summaries` with the kind of each zone. Takes faces of an opening found by
/// rule out of `zoneFaces` if it leads to a part that is no room of its own, as where a pane closes it.
Rooms findRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model, const RoomOptions& options,
                const RunContext& context);

/// Facts about a part that face zones divide zones into, or about some points of it.
struct RoomPart
{
  std::size_t size = 0;
  bool isWide = false;    ///< has a point that is not at the border
  bool isOutside = false; ///< reaches a bare side of the domain but the bottom
  bool isInRoom = false;  ///< is kept, and not the inside of a solid

  void add(const RoomPart& other);
};

/// Number of faces of face zones between two parts, by pair of parts.
using PartBorders = std::map<std::pair<Index, Index>, std::size_t>;

/// Grid points as face zones part them.
class PartedPoints
{
public:
  PartedPoints(const Crossings& found, const std::vector<ZoneFace>& zoneFaces, const SurfaceModel& surfaces);

  /// The neighbor in a direction, if nothing is between; noIndex otherwise.
  Index nextTo(Index point, int direction) const;
  /// Returns the facts about parts that follow from points in a row. `partOf` gives the parts of these points, from
  /// `first` on.
  std::vector<RoomPart> describe(Index first, std::span<const Index> partOf, std::size_t partCount, const Zones& zones,
                                 const std::vector<ZoneSummary>& summaries, const RoomOptions& options) const;
  /// Counts the zone faces between parts whose elements are in that row; `partOf` is that of all points.
  PartBorders borders(Index first, Index end, std::span<const Index> partOf) const;

private:
  bool isWide(Index point) const;

  const Crossings& crossings;
  const SurfaceModel& model;
  /// One entry per grid point, with a bit for each direction in which a face of a face zone is.
  std::vector<std::uint8_t> blocked;
  std::vector<std::pair<Index, Index>> between;
};

/// Rooms of parts, which are in the order of their first points.
struct PartedRooms
{
  std::vector<std::int32_t> ofPart;
  std::size_t count = 0;
  bool hasOutside = false;
  /// Parts that are no rooms of their own and those they were joined with, either way; sorted.
  std::vector<std::pair<Index, Index>> narrow;
};
PartedRooms joinParts(const std::vector<RoomPart>& parts, const PartBorders& borders);

/// Returns the rooms of points from those of their parts, and removes faces that lead nowhere.
Rooms roomsOf(const PartedRooms& rooms, std::span<const Index> partOf, const Crossings& crossings,
              std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model);

} // namespace atria
