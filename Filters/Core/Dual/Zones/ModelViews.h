// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds what each side of the model's triangles sees: air that is meshed, or another kind of space.
#pragma once

#include "Dual/Zones/ZoneSummary.h"

namespace atria {

/// Kind of space in front of one side of a triangle.
enum class View : std::uint8_t
{
  nothing, ///< no edge of the grid decides: the piece is finer than the grid
  air,     ///< a zone that is meshed
  ground,  ///< an open zone that is not meshed: under the ground
  solid,   ///< the inside of a solid
  narrow,  ///< a closed space without an element that has elements on all of its sides
  room,    ///< a closed room that is not meshed
  beyond   ///< the outside of the domain
};
inline constexpr std::size_t viewCount = 7;

/// Views of the front of a triangle, then of its back, as in SheetSide.
using TriangleViews = std::array<View, 2>;

/// Returns the view that triangles have of each zone beside them.
std::vector<View> viewsOfZones(const std::vector<ZoneSummary>& zones);

/// Returns one entry per triangle: the number of the piece of the model that it belongs to. Sets the count of pieces.
/// Triangles of a piece are joined across edges that no third one has, and are wound alike.
std::vector<Index> piecesBetweenEdges(const SurfaceModel& model, Index& count, const Executor& executor);

/// Returns the view of a grid point's zone; `nothing` beyond the domain.
inline View viewAt(Index point, const Zones& zones, const std::vector<View>& ofZone)
{
  const auto zone = point == noIndex ? ofZone.size() : static_cast<std::size_t>(zones.ofPoint[point]);
  return zone < ofZone.size() ? ofZone[zone] : View::nothing;
}

/// Returns the views of each triangle of the model.
///
/// The triangles of a piece see the same, as the repair cuts triangles wherever others pass through. The edges of the
/// grid that cut such a piece vote: the first triangle on an edge sees the zone of its first point, the last one that
/// of its other point, and neighbors between them see each other's zone. The majority decides. The result does not
/// depend on threads. O(triangles · log triangles + crossings).
/// \param zones  The zones of `crossings`.
/// \param ofZone  One view per zone; zones beyond its end are `nothing`.
std::vector<TriangleViews> findModelViews(const Crossings& crossings, const GridPlaces& grid, const Zones& zones,
                                          const std::vector<View>& ofZone, const SurfaceModel& model,
                                          const GridPart& part, const RunContext& context);

/// Returns one entry per triangle: the part of the grid edges through it that see air. It is 1 if nearly all of them
/// do, or if too few edges cut it to decide. From the rest of a triangle, air is behind another surface that is nearer
/// than the next point of the grid, as between walls with a thin gap.
std::vector<float> findAirParts(const Crossings& crossings, const Zones& zones, const std::vector<View>& ofZone,
                                const SurfaceModel& model, const GridPart& part, const RunContext& context);

} // namespace atria
