// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the kept zones into rooms at face zones.
#pragma once

#include "Dual/Zones/ZoneSummary.h"

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

/// True if there are rooms to find: some surface is a face zone.
bool hasRooms(const SurfaceModel& model);

/// `zoneFaces` as findZoneFaces() has them, `summaries` with the kind of each zone. Takes faces of an opening found by
/// rule out of `zoneFaces` if it leads to a part that is no room of its own, as where a pane closes it.
Rooms findRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                std::vector<ZoneFace>& zoneFaces, const GridPart& part, const SurfaceModel& model,
                const RoomOptions& options, const RunContext& context);

} // namespace atria
