// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the zones inside of the model's closed bodies, and chooses the zones to keep.
#pragma once

#include "Dual/Zones/ZoneSummary.h"
#include "Surface/Search/ClosedBodies.h"

#include <map>

namespace atria {

/// The model as it was drawn, before it was repaired, along its own axes.
struct DrawnModel
{
  const TriangleSurface& surface;
  /// One entry per surface.
  std::vector<char> isGround;
  /// Closed bodies of its walls.
  ClosedBodies bodies;
};

/// The closed bodies around a place of each zone. Bodies of one zone lie in each other, or cross.
class ZoneEnclosures
{
public:
  /// Has no bodies, so that nothing is enclosed.
  ZoneEnclosures() = default;
  /// O(log triangles) for each zone.
  ZoneEnclosures(const ClosedBodies& bodies, const ZoneFacts& facts, const GridFrame& frame, const RunContext& context);

  /// Number of bodies around a zone's place.
  std::size_t depth(std::size_t zone) const { return zone < around_.size() ? around_[zone].size() : 0; }
  /// True if an odd number of bodies that lie in each other is around a zone, or bodies that cross. The space between a
  /// closed body and those within it is its inside; the space within those is not. A body that crosses a larger one has
  /// an inside everywhere, such as furniture partly in a wall, unless its winding makes it a hollow.
  bool isWithinBody(std::size_t zone) const;
  /// True if the innermost body around a zone lies in another one and is drawn the other way round.
  bool isHollow(std::size_t zone) const;
  /// Marks the closed bodies around a kept zone that is within a body (isWithinBody).
  std::vector<char> holdsAir(const std::vector<char>& kept) const;
  /// Returns the enclosure of each zone by bodies. A body around a zone that is kept holds air, unless the zone is in a
  /// hollow of it. A hollow is a body within another one that is wound the other way.
  std::vector<Enclosure> kinds(const std::vector<char>& kept) const;

private:
  bool isChain(const std::vector<Index>& bodies) const;
  bool isInside(Index inner, Index outer) const;

  std::vector<std::vector<Index>> around_; ///< bodies around each zone, the largest first
  std::vector<double> volumes_;            ///< signed, one per body
  std::map<std::pair<Index, Index>, bool> isInside_;
  std::vector<char> crossesLarger_; ///< one per body, as far as zones show it
};

/// Recognizes places inside of solids, with or without a point of the grid there.
class SolidPlaces
{
public:
  /// Recognizes no place.
  SolidPlaces() = default;
  SolidPlaces(const ClosedBodies& bodies, std::vector<char> holdsAir, const Placement& placement)
      : bodies_(&bodies), holdsAir_(std::move(holdsAir)), placement_(placement)
  {
  }

  /// True if bodies lie around a place and none of these holds air. The place is along the grid's axes, in model units.
  bool contains(const Vec3& place) const;

private:
  const ClosedBodies* bodies_ = nullptr;
  std::vector<char> holdsAir_;
  Placement placement_;
};

/// Marks the zones to keep: those that the rule keeps, and in a turned domain only those inside it. `farthest` is from
/// farthestFromSides, or empty. With ZoneRule::outside, the inside of a shell that touches the domain's sides is no air
/// if rooms are behind it. So rooms are kept instead of zones at the sides if these are within closed bodies or see
/// only backs, and if the rooms are no smaller than they are (no smaller than a tenth, if the winding agrees). Throws
/// Error if no zone is left.
std::vector<char> chooseZones(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones,
                              const std::vector<double>& farthest, const ZoneFacts& facts,
                              const ZoneEnclosures& enclosures, const GridFrame& frame);

} // namespace atria
