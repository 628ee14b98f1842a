// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds what holds bodies up besides the ground.
#pragma once

#include "Domain/ModelBodies.h"

#include <optional>

namespace atria {

/// The ground: surfaces, a level floor, or the higher one of both.
struct GroundBelow
{
  Ground surface;
  std::optional<double> floor;
  bool isTerrain = false;
  bool useSurface = false;

  double heightAt(const Vec3& p) const;
};

enum class BaseSupport : std::uint8_t
{
  none,
  beside, ///< the body touches what reaches as low, or reaches lower itself
  below   ///< another body lies between the base and the ground, or around the base
};

/// Searches bodies by their place.
class SupportSearch
{
public:
  /// Keeps references to all of these. Bodies closer than `reach` touch. Heights within `tolerance` are equal.
  SupportSearch(const TriangleSurface& surface, const ModelBodies& bodies, const PlumbLines& lines,
                const std::vector<BodyBase>& bases, double reach, double tolerance);

  /// Returns what holds up the base of this number. `ground` is the height of the lowest ground below it.
  BaseSupport find(Index base, double ground) const;
  /// True if the body's box touches that of another one that reaches down to `low` or lower and rises above `ground`.
  bool isBesideOther(Index body, double low, double ground) const;

private:
  bool mayHold(Index other, const BodyBase& base, double ground) const;
  bool hasBodyBelow(const BodyBase& base, double ground) const;
  bool hasPointsBelow(Index number, double ground) const;
  bool isWithin(Index number, const Vec3& p) const;

  const TriangleSurface& surface;
  const ModelBodies& bodies;
  const PlumbLines& lines;
  const std::vector<BodyBase>& bases;
  double reach;
  double tolerance;
  PlanBins bodyBins;
  std::vector<Index> bodyOfPlace;
  PlanBins placeBins;
  std::vector<Index> baseOfTriangle;
};

} // namespace atria
