// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Triangulates a polygon that may be concave, not quite planar, degenerate or self-touching.
///
/// `polygon` holds indices into `points`. The triangles keep the polygon's winding and use its indices only.
/// Convex polygons of up to four points are cut directly; all others go through a constrained Delaunay triangulation
/// (CGAL) of their projection along the Newell normal. Points repeated in a row are dropped. A polygon without
/// area gives no triangle. O(n log n).
///
/// Where the outline crosses itself the even-odd inside is triangulated as far as existing points
/// allow; `simple` is then set to false.
struct PolygonTriangles
{
  std::vector<std::array<Index, 3>> triangles;
  bool simple = true;
};
PolygonTriangles triangulatePolygon(std::span<const Vec3> points, std::span<const Index> polygon);

} // namespace atria
