// SPDX-License-Identifier: GPL-3.0-or-later
/// Which zones are inside of the model's closed bodies, and which are kept on that account.
#pragma once

#include "Dual/Zones/ZoneSummary.h"
#include "Surface/Search/ClosedBodies.h"

#include <map>

namespace atria {

/// The model as it was drawn, before it was repaired, along its own axes.
struct DrawnModel
{
  const TriangleSurface& surface;
  /// By surface.
  std::vector<char> isGround;
  /// Of its walls.
  ClosedBodies bodies;
};

/// The closed bodies around a place of each zone. Bodies of one zone lie in each other, or cross.
class ZoneEnclosures
{
public:
  /// Without bodies nothing is enclosed.
  ZoneEnclosures() = default;
  /// O(log triangles) for each zone.
  ZoneEnclosures(const ClosedBodies& bodies, const ZoneFacts& facts, const GridFrame& frame, const RunContext& context);

  /// How many bodies lie around a zone's place.
  std::size_t depth(std::size_t zone) const { return zone < around_.size() ? around_[zone].size() : 0; }
  /// Whether an odd number of bodies that lie in each other is around a zone, or bodies that cross: what is between a
  /// closed body and those within it is its inside, and what is within those is not. A body that crosses a larger one
  /// has an inside everywhere, such as furniture partly in a wall, unless its winding makes it a hollow.
  bool isWithinBody(std::size_t zone) const;
  /// Whether the innermost body around a zone lies in another one and is drawn the other way round.
  bool isHollow(std::size_t zone) const;
  /// By closed body, whether a zone around which it lies is kept.
  std::vector<char> holdsAir(const std::vector<char>& kept) const;
  /// What each zone is, where bodies tell. A body around a zone that is kept holds air, unless the zone is in a hollow
  /// of it. A hollow is a body within another one that is wound the other way.
  std::vector<Enclosure> kinds(const std::vector<char>& kept) const;

private:
  bool isChain(const std::vector<Index>& bodies) const;
  bool isInside(Index inner, Index outer) const;

  std::vector<std::vector<Index>> around_; ///< by zone, the largest first
  std::vector<double> volumes_;            ///< by body, signed
  std::map<std::pair<Index, Index>, bool> isInside_;
  std::vector<char> crossesLarger_; ///< by body, as far as zones tell
};

/// Tells places inside of solids, whether or not a point of the grid is there.
class SolidPlaces
{
public:
  /// Nowhere.
  SolidPlaces() = default;
  SolidPlaces(const ClosedBodies& bodies, std::vector<char> holdsAir, const Placement& placement)
      : bodies_(&bodies), holdsAir_(std::move(holdsAir)), placement_(placement)
  {
  }

  /// Of a place along the grid's axes, in model units: whether bodies lie around it, and none of these holds air.
  bool contains(const Vec3& place) const;

private:
  const ClosedBodies* bodies_ = nullptr;
  std::vector<char> holdsAir_;
  Placement placement_;
};

/// Which zones are kept. Those that a rule keeps, where the domain is turned only those inside: `farthest` is from
/// farthestFromSides, or empty. With ZoneRule::outside, what is inside of a shell that touches the domain's sides is no
/// air where rooms are behind it: if zones at the sides are within closed bodies, or see only backs, and if the rooms
/// that they enclose are larger (or no smaller than a tenth, where all faces are wound so), rooms are kept instead.
/// Throws Error where no zone is left.
std::vector<char> chooseZones(const Zones& zones, ZoneRule rule, const std::vector<std::int32_t>& seedZones,
                              const std::vector<double>& farthest, const ZoneFacts& facts,
                              const ZoneEnclosures& enclosures, const GridFrame& frame);

} // namespace atria
