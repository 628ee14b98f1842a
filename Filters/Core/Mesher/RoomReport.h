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
  /// `outside` for the outdoors; that of the storey or group which most of its surfaces are of, as in `Storey1/Wall`;
  /// else `room_1` and so on. No two are the same.
  std::string name;
  double volume = 0.0;
  /// Of all that looks up in it, within 45 degrees, as seen from above.
  double floorArea = 0.0;
  /// Into RoomReport::openings.
  std::vector<Index> openings;
};

/// A face zone and the two rooms that most of it lies between.
struct RoomOpening
{
  Index surface = noIndex;
  /// The surface it is an opening of; itself where it was drawn.
  Index wall = noIndex;
  double area = 0.0;
  /// The one at the back of the surface first; -1 for none.
  std::array<std::int32_t, 2> rooms{-1, -1};
};

struct RoomReport
{
  /// The first is the outdoors if there are any.
  std::vector<Room> rooms;
  bool hasOutside = false;
  std::vector<RoomOpening> openings;
  /// How many surfaces, the last ones, are openings found by rule; some may not be in the mesh.
  std::size_t found = 0;
};

} // namespace atria
