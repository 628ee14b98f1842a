// SPDX-License-Identifier: GPL-3.0-or-later
/// How often closed surfaces lie about grid points.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPlaces.h"

#include <compare>
#include <limits>
#include <optional>
#include <unordered_map>

namespace atria {

/// Grid points within the bounds of a surface that edges join, but those that cross other surfaces: where two coincide
/// the faces are one's alone, so that such edges may cross this one, too, unseen. Depths, how often the surface lies
/// about a point, are counted from one of the points.
struct DepthPart
{
  static constexpr int none = std::numeric_limits<int>::max();

  /// Of points beyond the bounds, if there are any: that of all of them.
  int beyond = none;
  /// The least of those beyond other surfaces, and of the part's own points.
  int beyondOthers = none;
  int least = 0;
};

/// Two parts that edges join: what is `depth` in the other one is 0 in the first.
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

/// A point of another row as seen from a part.
struct DepthJoint
{
  PointDepth seen;
  bool isSure; ///< as in DepthLink
};

/// Of one surface, what points in a row tell.
struct SurfaceDepths
{
  std::vector<DepthPart> parts;
  /// Those within the bounds, by point: all that edges lead to from where they cross the surface or leave the row.
  std::vector<PointDepth> points;
  /// Between parts: over other surfaces.
  std::vector<DepthLink> links;
  /// Points within the bounds, but not in the row, beside such points, with the depth they have from there.
  std::vector<DepthJoint> joints;
  bool isMet = false;   ///< an edge crosses the surface
  bool isClosed = true; ///< no two ways within a part lead to different depths
};

/// By point and direction, of edges that no wall cuts, the surface that does; noIndex where these are several.
using OpenEdges = std::unordered_map<std::uint64_t, Index>;

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
  OpenEdges openEdges;
  /// Points of the row beside others.
  std::vector<Index> atEnds;
};

/// By part the depth of what is not enclosed. That is what is beyond the bounds; a part that does not lead there has it
/// of those beyond other surfaces, the least, or else of its own points. Nothing where there is none that all agree on.
std::optional<std::vector<int>> depthsOutside(const std::vector<DepthPart>& parts, const std::vector<DepthLink>& links);

} // namespace atria
