// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the zones of grid points that surfaces separate, and chooses those to keep.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPart.h"
#include "Dual/Zones/ZoneOptions.h"
#include "Support/RunContext.h"

namespace atria {

/// Zones of the whole grid: grid points joined across uncut edges. Zone 0 has the most points, and so on down; equal
/// ones by first point.
struct Zones
{
  /// Per grid point; count() where a process does not know it.
  std::vector<std::int32_t> ofPoint;
  std::vector<std::size_t> sizes;
  /// Per zone, the domain sides it reaches; and those it reaches where no surface lies on them.
  std::vector<SideBits> sides;
  std::vector<SideBits> openSides;

  std::size_t count() const { return sizes.size(); }
};

Zones findZones(const Crossings& crossings, std::size_t surfaceCount, const GridPart& part, const RunContext& context);

/// The grid point whose zone a seed means: the nearest one, where it stands in the displaced grid, that no surface
/// hides from the seed, of those at the leaf it lies in and its neighbors; where all are hidden, the nearest corner of
/// that leaf. Throws Error for a seed outside the domain; `kind` names it there, such as "seed".
Index pointOfSeed(const Vec3& seed, const char* kind, const GridPlaces& grid, const SurfaceModel& model);

/// Marks the zones that a rule keeps, which may be none; `seedZones` are those that hold seeds. Throws Error if seeds
/// are missing.
std::vector<char> zonesByRule(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones);

/// Throws Error where no zone is kept.
void checkKept(const std::vector<char>& kept, ZoneRule rule);

/// The zones that a rule keeps. Throws Error where no zone is left.
std::vector<char> keptZones(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones);

/// Returns the zones that hold seeds. Throws as pointOfSeed().
std::vector<std::int32_t> zonesOfSeeds(const Zones& zones, const std::vector<Vec3>& seeds, const GridPlaces& grid,
                                       const GridPart& part, const SurfaceModel& model, const char* kind = "seed");

} // namespace atria
