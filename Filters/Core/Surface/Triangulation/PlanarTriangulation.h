// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

using Vec2 = Eigen::Vector2d;

struct PlanarTriangulation
{
  /// The given points, then those where segments cross.
  std::vector<Vec2> points;
  /// Counter-clockwise; of points in one place the first is used.
  std::vector<std::array<Index, 3>> triangles;
  /// Per triangle: the region it is in. Segments part regions; 0 is what one comes to from the hull without passing
  /// through a segment.
  std::vector<Index> regions;
  Index regionCount = 0;

  bool isOutside(std::size_t triangle) const { return regions[triangle] == 0; }
};

/// Constrained Delaunay triangulation (CGAL) of the convex hull of points, with segments between them as edges.
/// Segments may cross, overlap and pass through points. Triangles are in an order that depends on the input alone.
PlanarTriangulation triangulatePlane(std::span<const Vec2> points, std::span<const std::array<Index, 2>> segments);

} // namespace atria
