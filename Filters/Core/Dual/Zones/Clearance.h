// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures distances from surfaces, and the narrowest passages between them.
#pragma once

#include "Dual/Zones/Zones.h"

namespace atria {

/// Distances from the grid points of a zone, and from the octree edges that join them, to surfaces. Surfaces on the
/// domain's sides count too, and so does its bottom, which is ground even where it is bare.
///
/// Distances beside surfaces are exact. Farther away only triangles that are nearest to neighboring points are tried
/// (Danielsson 1980), so that distances may be a little too large.
class Clearance
{
public:
  /// O(n log n) in the zone's points.
  Clearance(std::int32_t zone, const Zones& zones, const Crossings& crossings, const GridPlaces& grid,
            const SurfaceModel& model, const RunContext& context);

  Vec3 position(Index point) const;
  double ofPoint(Index point) const;
  /// Least distance of the uncut edge between two points, and its place on the edge.
  struct OfEdge
  {
    double distance;
    Vec3 place;
  };
  OfEdge ofEdge(Index from, Index to) const;

private:
  double distanceTo(Index triangle, const Vec3& p) const;
  /// Lists the triangles in the leaves around a point, some of them more than once.
  void collect(Index point, std::vector<Index>& triangles) const;
  void spread(const std::vector<Index>& seeds, const Crossings& crossings);

  const GridPlaces& grid;
  const Octree& octree;
  const GridPoints& points;
  const SurfaceModel& model;
  std::vector<Index> nearest;
  std::vector<double> distances;
};

/// A narrow place between surfaces.
struct Passage
{
  /// The center of the largest ball that fits there, and its diameter.
  Vec3 center;
  double width = std::numeric_limits<double>::infinity();
  /// The surfaces that the ball all but touches, nearest first; noIndex for the bare bottom of the domain.
  std::vector<Index> surfaces;
};
/// Returns the narrowest passage on the way from p to q, which are neighboring grid points with octants of `size`. At
/// places between them, a ball is moved away from surfaces in the planes in which a gap may lie, by two octants at
/// most, until it touches some on opposite sides. The smallest ball is the passage. It is infinitely wide, with `p` as
/// its center, if there is none.
Passage passageBetween(const Vec3& p, const Vec3& q, double size, const Octree& octree, const SurfaceModel& model);

} // namespace atria
