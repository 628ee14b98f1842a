// SPDX-License-Identifier: GPL-3.0-or-later
/// How often closed surfaces lie about grid points.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPlaces.h"

#include <limits>
#include <optional>

namespace atria {

/// Grid points within the bounds of a surface that edges join, whatever they cross. Depths, how often the surface lies
/// about a point, are counted from one of the points.
struct DepthPart
{
  static constexpr int none = std::numeric_limits<int>::max();

  /// Of points beyond the bounds that uncut edges lead to, if there are any: that of all of them.
  int beyond = none;
  /// The least of those beyond walls, which may have taken faces of the surface; and of the part's own points.
  int beyondWalls = none;
  int least = 0;
};

/// A grid point, and its depth in its part.
struct PointDepth
{
  Index point;
  Index part;
  int depth;
};

/// Of one surface, what points in a row tell.
struct SurfaceDepths
{
  std::vector<DepthPart> parts;
  /// Those within the bounds, by point: all in parts that edges cross the surface in, or that lead out of the row.
  std::vector<PointDepth> points;
  /// Points within the bounds, but not in the row, beside such points, with the depth they have from there.
  std::vector<PointDepth> joints;
  bool isMet = false;   ///< an edge crosses the surface
  bool isClosed = true; ///< no two ways lead to different depths
};

/// For surfaces that are cell zones, from points of a row.
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
  /// By surface, its bounds and the crossed edges that it cuts.
  std::vector<Box3> bounds;
  std::vector<std::vector<Index>> edges;
  /// Points of the row beside others.
  std::vector<Index> atEnds;
};

/// Two parts that edges join: what is `depth` in the other one is 0 in the first.
struct DepthLink
{
  Index part;
  Index other;
  int depth;

  auto operator<=>(const DepthLink&) const = default;
};

/// By part the depth of what is not enclosed, if it is one: that beyond the bounds, else beyond walls there, else the
/// least. Parts that links join have it together.
std::optional<std::vector<int>> depthsOutside(const std::vector<DepthPart>& parts, const std::vector<DepthLink>& links);

} // namespace atria
