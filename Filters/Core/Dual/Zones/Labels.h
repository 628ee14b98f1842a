// SPDX-License-Identifier: GPL-3.0-or-later
/// Labels that permeable surfaces give to the grid: zone faces, rooms and cell zones.
#pragma once

#include "Dual/Zones/CellZones.h"
#include "Dual/Zones/Rooms.h"
#include "Dual/Zones/ZoneFaces.h"

namespace atria {

struct Labels
{
  std::vector<ZoneFace> zoneFaces;
  Rooms rooms;
  std::vector<std::int32_t> cellZones;
};

} // namespace atria
