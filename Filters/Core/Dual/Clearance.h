// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Zones.h"

namespace atria {

/// How far surfaces are from the grid points of a zone, and from the octree edges that join them. Surfaces on the
/// domain's sides count too, and its bottom, which is ground even where it is bare.
///
/// Beside surfaces distances are exact. Farther away they are to the nearest of those triangles that are nearest to
/// neighbouring points (Danielsson 1980), which may be too far by little.
class Clearance
{
public:
  /// O(n log n) in the zone's points.
  Clearance(std::int32_t zone, const Zones& zones, const Crossings& crossings, const Octree& octree,
            const GridPoints& points, const SurfaceModel& model, const RunContext& context);

  Vec3 position(Index point) const;
  double ofPoint(Index point) const;
  /// Of the uncut edge between two points: the least distance, and where on the edge it is.
  struct OfEdge
  {
    double distance;
    Vec3 place;
  };
  OfEdge ofEdge(Index from, Index to) const;

private:
  double distanceTo(Index triangle, const Vec3& p) const;
  /// The triangles in the leaves about a point, some of them more than once.
  void collect(Index point, std::vector<Index>& triangles) const;
  void spread(const std::vector<Index>& seeds, const Crossings& crossings);

  const Octree& octree;
  const GridPoints& points;
  const SurfaceModel& model;
  std::vector<Index> nearest;
  std::vector<double> distances;
};

/// A narrow place between surfaces.
struct Passage
{
  /// The centre of the largest ball that fits there, and its diameter.
  Vec3 center;
  double width;
  /// The surfaces that the ball all but touches, nearest first; noIndex for the bare bottom of the domain.
  std::vector<Index> surfaces;
};
/// The narrowest passage along a part of a way, not longer than some octants of `size`. At points along it, the ball is
/// moved to where surfaces are farthest: in the plane of the gap, and by two octants at most.
Passage passageAlong(const std::vector<Vec3>& way, double size, const Octree& octree, const SurfaceModel& model);

} // namespace atria
