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
    /// True if one of its elements has elements on all sides.
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
  /// Numbers of faces by zone and surface, in order.
  std::vector<Count> faces;
  /// Numbers of leaf corners by zone and level of the leaf, in order.
  std::vector<Count> corners;
};

/// Returns the facts about the zones of the whole grid. The result does not depend on threads. `isGround` has one entry
/// per surface; nothing is ground if it is empty. O(points + faces · log faces).
ZoneFacts findZoneFacts(const Zones& zones, const Crossings& crossings, const GridPlaces& grid,
                        std::size_t surfaceCount, const GridPart& part, const RunContext& context,
                        const std::vector<char>& isGround = {});

/// Returns one entry per zone: the volume of the octants, divided among their corners, in cubic model units.
std::vector<double> zoneVolumes(const ZoneFacts& facts, std::size_t zoneCount, const GridFrame& frame);

/// Summarizes zones. `enclosures` has one entry per zone, or is empty. `isGround` is as in findZoneFacts().
std::vector<ZoneSummary> summarizeZones(const Zones& zones, const std::vector<char>& kept, const ZoneFacts& facts,
                                        const std::vector<Enclosure>& enclosures, const std::vector<char>& isGround,
                                        const GridFrame& frame);

/// The same for the whole grid, without enclosures and ground.
std::vector<ZoneSummary> summarizeZones(const Zones& zones, const std::vector<char>& kept, const Crossings& crossings,
                                        const GridPlaces& grid, std::size_t surfaceCount, const RunContext& context);

} // namespace atria
