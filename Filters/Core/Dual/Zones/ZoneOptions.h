// SPDX-License-Identifier: GPL-3.0-or-later
/// Options that decide which zones of a model are meshed.
#pragma once

#include "Support/Types.h"

#include <cstdint>
#include <vector>

namespace atria {

/// Rule by which zones are kept.
enum class ZoneRule : std::uint8_t
{
  /// Zones that reach the top of the domain. If none does, or if surfaces lie on all of its sides but the bottom, zones
  /// that reach any side but the bottom; if none does, zones that reach the bottom.
  outside,
  all,
  seeds ///< zones that hold one of the given points
};

struct RoomOptions
{
  /// True if the domain is a room or a building whose walls are its sides, so that there are no outdoors.
  bool sidesAreWalls = false;
};

/// Options that decide which zones are meshed, and what is a room.
struct ZoneOptions
{
  ZoneRule zoneRule = ZoneRule::outside;
  /// Along the model's axes.
  std::vector<Vec3> seeds;
  /// Points in zones that should be closed; see findLeaks.
  std::vector<Vec3> sealedSeeds;
  RoomOptions rooms = {};
};

/// Returns the seeds, if the rule uses them.
inline std::vector<Vec3> seedsOf(const ZoneOptions& options)
{
  return options.zoneRule == ZoneRule::seeds ? options.seeds : std::vector<Vec3>();
}

} // namespace atria
