// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangulates polygons.
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Triangulates a polygon that may be concave, not quite planar, degenerate or self-touching.
///
/// `polygon` holds indices into `points`. The triangles keep the polygon's winding and use only its indices. Triangles
/// and quads are cut directly, a quad along its shorter valid diagonal; all others go through a constrained Delaunay
/// triangulation (CGAL) of their projection along the Newell normal. Points repeated in a row are dropped, and edges
/// walked both ways (bridges to holes) cancel out. A polygon without area, or with a point that is not finite, gives no
/// triangle. Throws only for lack of memory. O(n log n); O(n^2) if the outline crosses itself.
///
/// If the outline crosses itself, its even-odd inside is triangulated as far as existing points allow, and `simple` is
/// set to false.
struct PolygonTriangles
{
  std::vector<std::array<Index, 3>> triangles;
  bool simple = true;
};
PolygonTriangles triangulatePolygon(std::span<const Vec3> points, std::span<const Index> polygon);

/// The same, into a value whose memory is reused, for callers with many polygons.
void triangulatePolygon(std::span<const Vec3> points, std::span<const Index> polygon, PolygonTriangles& out);

} // namespace atria
