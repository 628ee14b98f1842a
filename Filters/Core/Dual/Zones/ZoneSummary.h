// SPDX-License-Identifier: GPL-3.0-or-later
/// Gathers facts about zones, kept or not, and summarizes them.
#pragma once

#include "Dual/Zones/ZoneReport.h"
#include "Dual/Zones/Zones.h"

#include <limits>

namespace atria {

/// Position of a zone relative to closed bodies of the model.
enum class Enclosure : std::uint8_t
{
  none,  ///< it is in none
  solid, ///< it is inside of one
  hollow ///< it is in a hollow of one
};

/// Facts about zones.
struct ZoneFacts
{
  /// Faces that a zone sees, except looking down, on ground and on sides of the domain.
  struct Faces
  {
    std::size_t fronts = 0;
    std::size_t backs = 0;

    void add(const Faces& other)
    {
      fronts += other.fronts;
      backs += other.backs;
    }
  };
  struct Zone
  {
    /// A place of the zone, in octants as large as possible, and the level of the finest octant around it. The level is
    /// the greatest number if one of these holds a piece of the model.
    bool hasPlace = false;
    int finest = std::numeric_limits<int>::max();
    Vec3 inside = Vec3::Zero();
    /// True if an element has elements on all of its sides.
    bool isWide = false;
    /// True if it sees sides of a turned domain from outside.
    bool isBeyond = false;
    /// True if it sees nothing but backs of one surface, and this surface.
    bool seesBacksOfOne = true;
    Index surface = noIndex;
    /// True if it stands on ground, or on the bottom of the domain.
    bool seesGround = false;
    Faces faces;
  };
  struct Count
  {
    std::int32_t zone;
    Index of;
    std::size_t count;
  };

  std::vector<Zone> zones;
  /// Faces of surfaces, in order.
  std::vector<Count> faces;
  /// Corners of leaves of a level, in order.
  std::vector<Count> corners;
};

/// Returns the facts about the zones of the whole grid. The result does not depend on threads. `isGround` is by
/// surface; nothing is ground if it is empty. O(points + faces · log faces).
ZoneFacts findZoneFacts(const Zones& zones, const Crossings& crossings, const GridPlaces& grid,
                        std::size_t surfaceCount, const GridPart& part, const RunContext& context,
                        const std::vector<char>& isGround = {});

/// Returns per zone the volume of the octants, shared out among their corners, in cubic model units.
std::vector<double> zoneVolumes(const ZoneFacts& facts, std::size_t zoneCount, const GridFrame& frame);

/// `enclosures` is by zone; nothing is enclosed where it is empty. `isGround` is as of findZoneFacts().
std::vector<ZoneSummary> summarizeZones(const Zones& zones, const std::vector<char>& kept, const ZoneFacts& facts,
                                        const std::vector<Enclosure>& enclosures, const std::vector<char>& isGround,
                                        const GridFrame& frame);

/// Same for the whole grid.
std::vector<ZoneSummary> summarizeZones(const Zones& zones, const std::vector<char>& kept, const Crossings& crossings,
                                        const GridPlaces& grid, std::size_t surfaceCount, const RunContext& context);

} // namespace atria
