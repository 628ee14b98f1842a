// SPDX-License-Identifier: GPL-3.0-or-later
/// What face zones part: rooms.
#pragma once

#include "Dual/Zones/ZoneSummary.h"

#include <map>
#include <span>

namespace atria {

/// Of grid points that are in no room.
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

/// Whether there are rooms to be found: some surface is a face zone.
bool hasRooms(const SurfaceModel& model);

/// `zoneFaces` as findZoneFaces() has them, `summaries` with the kind of each zone. Where an opening found by rule
/// leads to a part that is no room of its own, as where a pane closes it, its faces are taken out of `zoneFaces`.
Rooms findRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model, const RoomOptions& options,
                const RunContext& context);

/// What is known of a part that face zones divide zones into, or of some points of it.
struct RoomPart
{
  std::size_t size = 0;
  bool isWide = false;    ///< has a point that is not at the border
  bool isOutside = false; ///< reaches a bare side of the domain but the bottom
  bool isInRoom = false;  ///< is kept, and not the inside of a solid

  void add(const RoomPart& other);
};

/// Faces of face zones between two parts, by these.
using PartBorders = std::map<std::pair<Index, Index>, std::size_t>;

/// Grid points as face zones part them.
class PartedPoints
{
public:
  PartedPoints(const Crossings& found, const std::vector<ZoneFace>& zoneFaces, const SurfaceModel& surfaces);

  /// The neighbor in a direction, if nothing is between; noIndex otherwise.
  Index nextTo(Index point, int direction) const;
  /// What is known of parts from points in a row, of which `partOf` gives their parts, from `first` on.
  std::vector<RoomPart> describe(Index first, std::span<const Index> partOf, std::size_t partCount, const Zones& zones,
                                 const std::vector<ZoneSummary>& summaries, const RoomOptions& options) const;
  /// Of the faces of zones whose elements are in that row; `partOf` is that of all points.
  PartBorders borders(Index first, Index end, std::span<const Index> partOf) const;

private:
  bool isWide(Index point) const;

  const Crossings& crossings;
  const SurfaceModel& model;
  /// By direction, where a face of a face zone is.
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

/// Rooms of points from those of their parts, and faces that lead nowhere taken out.
Rooms roomsOf(const PartedRooms& rooms, std::span<const Index> partOf, const Crossings& crossings,
              std::vector<ZoneFace>& zoneFaces, const SurfaceModel& model);

} // namespace atria
