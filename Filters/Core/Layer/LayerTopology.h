// SPDX-License-Identifier: GPL-3.0-or-later
/// Builds the elements between walls and the mesh beside them.
#pragma once

#include "Layer/LayerWalls.h"

namespace atria {

/// Additions of crease sheets (CreaseSheets.h) to a mesh with a layer. Earlier points, elements and boundary faces keep
/// their numbers.
struct CreaseSheets
{
  struct Point
  {
    Index wallPoint; ///< the point of the plain mesh it was split from
    Index chart;     ///< chart of its wall; noIndex on a bare side of the domain and inside
    bool onWall;     ///< else it is inside
    bool onSide;     ///< true if the row ends there on a side of the domain
  };

  Index firstPoint = 0;
  std::vector<Point> points;
  /// One entry per boundary face, from firstFace on: the wall's face that the row was taken from; noIndex on sides of
  /// the domain.
  Index firstFace = 0;
  std::vector<Index> wallFaces;

  /// Returns the point of the plain mesh that a point at a wall was split from; the point itself if it was not split.
  Index sourceOf(Index point) const
  {
    return points.empty() || point < firstPoint ? point : points[point - firstPoint].wallPoint;
  }
};

/// A mesh with layers, and its relation to the plain mesh it was grown from. Points and elements of the plain mesh keep
/// their numbers; so do its boundary faces. Additional faces of the domain's sides, on which layers end, follow them.
/// The plain points are the wall's; elements that were at the wall use the last point above it, the copy.
struct LayerMesh
{
  DualMesh mesh;
  Index plainPoints = 0;
  Index plainElements = 0;
  /// One entry per point of the plain mesh: its copy, or noIndex if it has none.
  std::vector<Index> copies;
  /// One entry per new point, from plainPoints on: the wall point it stands above, and its place in the chain from
  /// there, 1 and up.
  std::vector<Index> wallPoints;
  std::vector<Index> places;
  /// One entry per new element, from plainElements on: the boundary face it stands on, in rising order, and its place
  /// in the stack, 0 and up.
  std::vector<Index> wallFaces;
  std::vector<Index> heights;
  /// These are no part of the stacks.
  CreaseSheets creaseSheets;

  bool isNew(Index point) const { return point >= plainPoints; }
  /// Returns the wall point that a new point stands above; a plain point itself.
  Index wallPointOf(Index point) const { return isNew(point) ? wallPoints[point - plainPoints] : point; }
  /// Returns the element at a place of the stack on a boundary face; noIndex if there is none. O(log n).
  Index prismOn(Index face, Index height) const;
};

/// Returns the LayerMesh of a mesh that gets no layer.
LayerMesh withoutLayer(DualMesh plain);

/// Builds stacks of prisms on the walls. `counts` gives each point the number of its new points, at most that of
/// `walls.counts`; 0 leaves it single. New points still lie on the wall. A prism is a hexahedron in the axes of the
/// element that had the wall: the lower face in that direction, the upper one against it. Prisms on faces that share an
/// edge are neighbors through the face between them, whose directions then need not be opposite. Prisms above the end
/// of a chain have its last point in their lower and upper face.
///
/// The mesh is conformal for any counts: two walls (or a wall and a side) have one face between them across each edge,
/// at the same heights.
LayerMesh buildLayer(const DualMesh& plain, const LayerWalls& walls, const std::vector<Index>& counts,
                     const Executor& executor = SerialExecutor());

/// The same, with a third less memory: moves everything out of the plain mesh except its neighbors and boundary faces,
/// which are needed to find the wall of each prism.
LayerMesh takeLayer(DualMesh& plain, const LayerWalls& walls, const std::vector<Index>& counts,
                    const Executor& executor = SerialExecutor());

} // namespace atria
