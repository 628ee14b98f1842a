// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the zones of grid points that surfaces separate, and chooses those to keep.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPart.h"
#include "Dual/Zones/ZoneOptions.h"
#include "Support/RunContext.h"

namespace atria {

/// Zones of the whole grid: grid points joined across uncut edges. They are sorted by falling number of points, and
/// equal ones by their first points.
struct Zones
{
  /// One entry per grid point: its zone; count() if this process does not know it.
  std::vector<std::int32_t> ofPoint;
  std::vector<std::size_t> sizes;
  /// One entry per zone: the domain sides that it reaches, and those that it reaches where no surface lies on them.
  std::vector<SideBits> sides;
  std::vector<SideBits> openSides;

  std::size_t count() const { return sizes.size(); }
};

Zones findZones(const Crossings& crossings, std::size_t surfaceCount, const GridPart& part, const RunContext& context);

/// Returns the grid point whose zone a seed means: of the points of the seed's leaf and its neighbors, the nearest one,
/// by displaced positions, that no surface hides from the seed. If all are hidden, it is the nearest corner of the
/// leaf. Throws Error, which calls the seed `kind`, for a seed outside the domain or without a point.
Index pointOfSeed(const Vec3& seed, const char* kind, const GridPlaces& grid, const SurfaceModel& model);

/// Marks the zones that a rule keeps, which may be none; `seedZones` are those that hold seeds. Throws Error if seeds
/// are missing.
std::vector<char> zonesByRule(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones);

/// Throws Error if no zone is kept.
void checkKept(const std::vector<char>& kept, ZoneRule rule);

/// Marks the zones that a rule keeps. Throws Error if no zone is left.
std::vector<char> keptZones(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones);

/// Returns the zones that hold seeds. Throws as pointOfSeed().
std::vector<std::int32_t> zonesOfSeeds(const Zones& zones, const std::vector<Vec3>& seeds, const GridPlaces& grid,
                                       const GridPart& part, const SurfaceModel& model, const char* kind = "seed");

} // namespace atria
