// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Crossings.h"

#include <string>

namespace atria {

/// Which zones are kept.
enum class ZoneRule : std::uint8_t
{
  outside, ///< those that reach a side of the domain other than its bottom (or, if none does, the bottom)
  all,
  seeds ///< those that hold one of given points
};

/// Zones: grid points joined across uncut edges. Zone 0 has the most points, and so on down; equal ones by first point.
struct Zones
{
  std::vector<std::int32_t> ofPoint;
  std::vector<std::size_t> sizes;
  /// Per zone, the domain sides it reaches, as bits by Direction.
  std::vector<std::uint8_t> sides;

  std::size_t count() const { return sizes.size(); }
};

Zones findZones(const Crossings& crossings, const RunContext& context);

/// Whether each zone is kept. Throws Error for a seed outside the domain, and where no zone is left.
std::vector<char> keptZones(const Zones& zones, ZoneRule rule, const std::vector<Vec3>& seeds, const Octree& octree,
                            const GridPoints& points);

} // namespace atria
