// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/Prism.h"

#include <span>
#include <vector>

namespace atria {

/// How many of the first points and segments are the outline, and what is to be done where segments cross.
struct PlanarOutline
{
  std::size_t points = 0;
  std::size_t segments = 0;
  bool cutsCrossings = true; ///< whether points are added there
};

struct PlanarTriangulation
{
  /// The given points, then those where segments cross.
  std::vector<Vec2> points;
  /// Counter-clockwise; of points in one place the first is used.
  std::vector<std::array<Index, 3>> triangles;
  /// Per triangle: the region it is in. With an outline 0 is outside of it and 1 inside, by the even-odd rule, as parts
  /// of it may be walked several times. Without, segments part regions, and 0 is what one comes to from the hull
  /// without passing through one.
  std::vector<Index> regions;
  Index regionCount = 0;
  /// False where segments cross that are not cut. Those found later are left out then, and `regions` is empty.
  bool simple = true;

  bool isOutside(std::size_t triangle) const { return regions[triangle] == 0; }
};

/// Constrained Delaunay triangulation (CGAL) of the convex hull of points, with segments between them as edges.
/// Segments may cross, overlap and pass through points. Triangles are in an order that depends on the input alone.
PlanarTriangulation triangulatePlane(std::span<const Vec2> points, std::span<const std::array<Index, 2>> segments,
                                     const PlanarOutline& outline = {});

} // namespace atria
