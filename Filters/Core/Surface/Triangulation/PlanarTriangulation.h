// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangulates points and segments in the plane.
#pragma once

#include "Grid/Prism.h"

#include <span>
#include <vector>

namespace atria {

/// Numbers of the first points and segments that are the outline, and the treatment of crossings.
struct PlanarOutline
{
  std::size_t points = 0;
  std::size_t segments = 0;
  bool cutsCrossings = true; ///< true if points are added where segments cross
};

struct PlanarTriangulation
{
  /// The given points, then those at crossings of segments.
  std::vector<Vec2> points;
  /// Counterclockwise. The first of several points in one place is used.
  std::vector<std::array<Index, 3>> triangles;
  /// Per triangle: the region it is in. With an outline, 0 is outside of it and 1 inside, by the even-odd rule, as
  /// parts of it may be walked several times. Without one, segments separate regions, and 0 is the region that is
  /// reached from the hull without crossing a segment.
  std::vector<Index> regions;
  Index regionCount = 0;
  /// False if segments cross that are not cut. Crossing segments found later are then left out, and `regions` is empty.
  bool simple = true;

  bool isOutside(std::size_t triangle) const { return regions[triangle] == 0; }
};

/// Returns a constrained Delaunay triangulation (CGAL) of the convex hull of points, with segments between them as
/// edges. Segments may cross, overlap and pass through points. Triangles are in an order that depends on the input
/// alone.
PlanarTriangulation triangulatePlane(std::span<const Vec2> points, std::span<const std::array<Index, 2>> segments,
                                     const PlanarOutline& outline = {});

} // namespace atria
