// SPDX-License-Identifier: GPL-3.0-or-later
/// Rooms and openings as the mesh has them.
#pragma once

#include "Support/Types.h"

#include <array>
#include <string>
#include <vector>

namespace atria {

struct Room
{
  /// `outside` for the outdoors; else the storey or group that has more than half of its surfaces by area, as in
  /// `Storey1/Wall`; else `room_1` and so on. Names are unique.
  std::string name;
  double volume = 0.0;
  /// Area seen from above of all faces in it that look up within 45 degrees.
  double floorArea = 0.0;
  /// Indices into RoomReport::openings.
  std::vector<Index> openings;
};

/// A face zone and the two rooms that most of it lies between.
struct RoomOpening
{
  Index surface = noIndex;
  /// The surface that it is an opening of; the surface itself if it was drawn.
  Index wall = noIndex;
  double area = 0.0;
  /// The room at the back of the surface first; -1 for none.
  std::array<std::int32_t, 2> rooms{-1, -1};
};

struct RoomReport
{
  /// The first is the outdoors if there are any.
  std::vector<Room> rooms;
  bool hasOutside = false;
  std::vector<RoomOpening> openings;
  /// Number of surfaces, the last ones, that are openings found by rule; some may not be in the mesh.
  std::size_t found = 0;
};

} // namespace atria
