// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the kept zones into rooms at face zones.
#pragma once

#include "Dual/Zones/ZoneSummary.h"

namespace atria {

/// Value for grid points that are in no room.
inline constexpr std::int32_t noRoom = -1;

/// Rooms are the parts into which face zones divide the kept zones. The outdoors is one room, with all parts that reach
/// a bare side of the domain other than its bottom. A part all of whose points are at its border, such as a sliver
/// between a wall and a face zone, belongs to the room with which it has most faces in common. Insides of solids are in
/// no room.
struct Rooms
{
  /// One entry per grid point; empty if no surface is a face zone.
  std::vector<std::int32_t> ofPoint;
  /// Number of rooms. The outdoors comes first, if there is one; then rooms by falling number of points.
  std::size_t count = 0;
  bool hasOutside = false;
};

/// True if a surface is a face zone, so that there are rooms to find.
bool hasRooms(const SurfaceModel& model);

/// Finds the rooms. `zoneFaces` are those of findZoneFaces(); faces of an opening that was found by rule are removed
/// from them if it leads to a part that is no room of its own, as where a pane closes it.
Rooms findRooms(const Zones& zones, const std::vector<ZoneSummary>& summaries, const Crossings& crossings,
                std::vector<ZoneFace>& zoneFaces, const GridPart& part, const SurfaceModel& model,
                const RoomOptions& options, const RunContext& context);

} // namespace atria
