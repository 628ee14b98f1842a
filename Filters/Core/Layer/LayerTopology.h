// SPDX-License-Identifier: GPL-3.0-or-later
/// Elements between walls and the mesh beside them.
#pragma once

#include "Layer/LayerWalls.h"

namespace atria {

/// What sheets along creases (CreaseSheets.h) added to a mesh with a layer. Points, elements and boundary faces that
/// were there keep their numbers.
struct CreaseSheets
{
  struct Point
  {
    Index wallPoint; ///< the point of the plain mesh it was split from
    Index chart;     ///< of its wall; noIndex on a side of the domain
    bool onWall;     ///< else it is inside
    bool onSide;     ///< where the row ends on a side of the domain
  };

  Index firstPoint = 0;
  std::vector<Point> points;
  /// Per boundary face, from firstFace on: the wall's face that the row was taken from; noIndex on sides of the domain.
  Index firstFace = 0;
  std::vector<Index> wallFaces;

  /// The point of the plain mesh that one at a wall was split from; itself where it was not.
  Index sourceOf(Index point) const
  {
    return points.empty() || point < firstPoint ? point : points[point - firstPoint].wallPoint;
  }
};

/// A mesh with layers, and how it is connected with the plain one it was grown from. Points and elements of the plain
/// mesh keep their numbers; its boundary faces too, those of the domain's sides that layers end on follow them. The
/// plain points are the wall's; elements that were at the wall use the last point above it, the copy.
struct LayerMesh
{
  DualMesh mesh;
  Index plainPoints = 0;
  Index plainElements = 0;
  /// Per point of the plain mesh: its copy, or noIndex where it has none.
  std::vector<Index> copies;
  /// Per new point, from plainPoints on: the point of the wall it stands above, and its place in the chain from there,
  /// 1 and up.
  std::vector<Index> wallPoints;
  std::vector<Index> places;
  /// Per new element, from plainElements on: the boundary face it stands on, in rising order, and its place in the
  /// stack, 0 and up.
  std::vector<Index> wallFaces;
  std::vector<Index> heights;
  /// These are no part of the stacks.
  CreaseSheets creaseSheets;

  bool isNew(Index point) const { return point >= plainPoints; }
  /// The point of the wall that a new point stands above; a plain one is its own.
  Index wallPointOf(Index point) const { return isNew(point) ? wallPoints[point - plainPoints] : point; }
  /// The element at a place of the stack on a boundary face; noIndex where there is none. O(log n).
  Index prismOn(Index face, Index height) const;
};

/// A mesh that gets no layer.
LayerMesh withoutLayer(DualMesh plain);

/// Builds stacks of prisms on the walls. `counts` gives each point the number of its new points, at most that of
/// `walls.counts`; 0 leaves it single. New points lie on the wall yet. A prism is a hexahedron in the axes of the
/// element that had the wall: the lower face in that direction, the upper one against it. Prisms on faces that share an
/// edge are neighbors through the face between them, whose directions then need not be opposite. Where a chain has
/// ended, prisms above it have its last point in their lower and upper face.
///
/// Conformal for any counts, as between two walls (or a wall and a side) there is one face across each edge, and both
/// have it at the same heights.
LayerMesh buildLayer(const DualMesh& plain, const LayerWalls& walls, const std::vector<Index>& counts,
                     const Executor& executor = SerialExecutor());

/// The same, with a third less memory: all is taken out of the plain mesh but its neighbors and boundary faces, which
/// tell what stands on what.
LayerMesh takeLayer(DualMesh& plain, const LayerWalls& walls, const std::vector<Index>& counts,
                    const Executor& executor = SerialExecutor());

} // namespace atria
