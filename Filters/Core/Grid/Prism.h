// SPDX-License-Identifier: GPL-3.0-or-later
/// Domains that stand upright on a convex polygon; a box is one of four sides.
#pragma once

#include "Grid/Placement.h"

#include <string>
#include <string_view>
#include <vector>

namespace atria {

/// Sides of a domain have numbers. Sides of a box, and the bottom and top of any domain, are numbered by Direction. The
/// upright sides of other prisms follow.
inline constexpr int fewestPrismSides = 3;
inline constexpr int mostPrismSides = 48;
inline constexpr Index firstPrismSide = 6;
inline constexpr Index sideNumbers = firstPrismSide + mostPrismSides;
/// A set of sides, by number.
using SideBits = std::uint64_t;
static_assert(sideNumbers <= 64);

inline bool isUprightSide(Index number) { return number != zMin && number != zMax; }
/// Returns `xMin` … `zMax`; `domainSide1` and so on for upright sides of other prisms.
std::string sideName(Index number);
bool isSideName(std::string_view name);

/// An upright side; coordinates are along the prism's axes.
struct PrismSide
{
  Index number = 0;
  Vec2 normal = Vec2::Zero(); ///< outwards, a unit vector
  double offset = 0.0;        ///< coordinate of its points along the normal
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero(); ///< start of the next side, counterclockwise seen from above

  /// Returns how far a point is beyond the side's plane; negative within.
  double beyond(const Vec2& p) const { return normal.dot(p) - offset; }
  /// Returns the unit vector along the side, counterclockwise.
  Vec2 tangent() const { return {-normal[1], normal[0]}; }
  /// Returns the nearest point of the side's plane.
  Vec2 foot(const Vec2& p) const { return offset * normal + tangent().dot(p) * tangent(); }
};

/// A regular polygon, stretched to fill `bounds`, from bottom to top. The normal of its first side points along -x,
/// others follow counterclockwise: with four sides it is the box. Or any convex polygon by its corners.
class PlacedPrism : public PlacedBox
{
public:
  PlacedPrism() = default;
  /// Throws Error if `sideCount` is out of range.
  PlacedPrism(const PlacedBox& box, int sideCount = 4);
  /// Takes corners along `axes`; the first side starts at the first corner, others follow counterclockwise. Clockwise
  /// corners are reversed. Throws Error that names the corner at which the polygon is not convex, is straight to within
  /// a degree, or repeats a corner. Throws Error, too, if there are too few or too many sides.
  PlacedPrism(const Placement& axes, const std::vector<Vec2>& corners, double bottom, double top);

  const std::vector<PrismSide>& sides() const { return sides_; }
  bool isBox() const { return !sides_.empty() && sides_.front().number < firstPrismSide; }
  /// Returns how far a point along the prism's axes is beyond the upright side it is farthest out of; negative within
  /// all.
  double beyond(const Vec2& p) const;
  /// True if the prism contains the point, given in model coordinates.
  bool contains(const Vec3& modelPoint) const;
  /// Returns the place nearest to `p` that is within the prism and on all of the sides `on`.
  Vec2 nearest(const Vec2& p, SideBits on) const;
  double volume() const;

private:
  void setSides(const std::vector<Vec2>& corners, bool isOfBox);

  std::vector<PrismSide> sides_;
};

/// Returns the bounds of a regular prism around a circle, which touches its sides.
Box3 boundsAboutCircle(const Vec2& center, double radius, int sideCount, double bottom, double top);

/// Returns the bounds of a prism along other axes.
Box3 boundsAlong(const Placement& axes, const PlacedPrism& prism);

} // namespace atria
