// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// A triangle with the points and segments that its neighbors put on it. All are indices of points of the lattice,
/// which lie on the triangle but for rounding.
struct DividedFace
{
  std::array<Index, 3> corners;
  /// The points along each edge, ends left out, in the order of the winding.
  std::array<std::vector<Index>, 3> alongEdges;
  /// Points inside.
  std::vector<Index> inside;
  /// Segments that must become edges; their ends are among the points above.
  std::vector<EdgeKey> segments;
};

/// Triangulates a divided face by a constrained Delaunay triangulation (CGAL) of its projection along an axis, and
/// appends the triangles, in the winding of the face, to `out`. Segments are cut first where they cross and at points
/// within the reach (see cutSegments); points this takes are added to `points`. The boundary of the result is the
/// outline of the face, edge by edge, which keeps a closed surface closed. A face without area is cut into a fan, of
/// which triangles that cover each other are left out.
void triangulateFace(std::vector<LatticePoint>& points, DividedFace& face, double reach,
                     std::vector<std::array<Index, 3>>& out);

} // namespace atria
