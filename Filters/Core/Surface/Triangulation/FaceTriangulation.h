// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangulates a face with points and segments on it.
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// A triangle with the points and segments that its neighbors put on it. All numbers are indices of lattice points that
/// lie on the triangle except for rounding.
struct DividedFace
{
  std::array<Index, 3> corners;
  /// Points along each edge without its ends, in the order of the winding.
  std::array<std::vector<Index>, 3> alongEdges;
  /// Points inside.
  std::vector<Index> inside;
  /// Segments that must become edges; their ends are among the points above.
  std::vector<EdgeKey> segments;
};

/// Triangulates a divided face by a constrained Delaunay triangulation (CGAL) of its projection along an axis, and
/// appends the triangles, in the winding of the face, to `out`. Segments are cut first where they cross and at points
/// within the reach (see cutSegments); points needed for this are added to `points`. The boundary of the result is the
/// outline of the face, edge by edge, which keeps a closed surface closed. A face without area is cut into a fan,
/// without triangles that cover each other.
void triangulateFace(std::vector<LatticePoint>& points, DividedFace& face, double reach,
                     std::vector<std::array<Index, 3>>& out);

} // namespace atria
