// SPDX-License-Identifier: GPL-3.0-or-later
/// Counts how often closed surfaces lie around grid points.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPlaces.h"

#include <compare>
#include <limits>
#include <optional>
#include <unordered_map>

namespace atria {

/// Grid points within the bounds of a surface, joined by edges that cross no other surface. If two surfaces coincide,
/// only one of them has faces, so edges across another surface may cross this one unseen. A depth is how often the
/// surface lies around a point, counted from one of the points.
struct DepthPart
{
  static constexpr int none = std::numeric_limits<int>::max();

  /// Common depth of all points beyond the bounds, if there are any.
  int beyond = none;
  /// Least depth beyond other surfaces, and of the part's own points.
  int beyondOthers = none;
  int least = 0;
};

/// Two parts that edges join: `depth` in the other one is 0 in the first.
struct DepthLink
{
  Index part;
  Index other;
  int depth;
  bool isSure; ///< no other surface is between them

  auto operator<=>(const DepthLink&) const = default;
};

/// A grid point, and its depth in its part.
struct PointDepth
{
  Index point;
  Index part;
  int depth;
};

/// A point outside the row, as seen from a part.
struct DepthJoint
{
  PointDepth seen;
  bool isSure; ///< as in DepthLink
};

/// Depths around one surface, for a row of consecutive points.
struct SurfaceDepths
{
  std::vector<DepthPart> parts;
  /// Points within the bounds that edges lead to from where they cross the surface or leave the row; sorted.
  std::vector<PointDepth> points;
  /// Links between parts, across other surfaces.
  std::vector<DepthLink> links;
  /// Points within the bounds, but not in the row, beside such points, with their depth as seen from there.
  std::vector<DepthJoint> joints;
  bool isMet = false;   ///< an edge crosses the surface
  bool isClosed = true; ///< no two ways within a part lead to different depths
};

/// The permeable surface that cuts an edge that no wall cuts, by point and direction; noIndex if several do.
using OpenEdges = std::unordered_map<std::uint64_t, Index>;

/// Finds the depths around surfaces that are cell zones, for the points [first, end).
class DepthFinder
{
public:
  DepthFinder(const Crossings& found, const GridPlaces& places, const SurfaceModel& surfaces, Index first, Index end);

  SurfaceDepths find(Index surface) const;

private:
  const Crossings& crossings;
  const GridPlaces& grid;
  const SurfaceModel& model;
  Index firstPoint;
  Index endPoint;
  /// Bounds of each surface, and the crossed edges that it cuts.
  std::vector<Box3> bounds;
  std::vector<std::vector<Index>> edges;
  OpenEdges openEdges;
  /// Points of the row beside others.
  std::vector<Index> atEnds;
};

/// Returns one entry per part: the depth of what is not enclosed, which is the depth beyond the bounds. A part that
/// does not lead there has the least depth beyond other surfaces, or else of its own points. Returns nullopt if the
/// parts contradict each other.
std::optional<std::vector<int>> depthsOutside(const std::vector<DepthPart>& parts, const std::vector<DepthLink>& links);

} // namespace atria
