// SPDX-License-Identifier: GPL-3.0-or-later
/// Holds the part of a mesh that is optimized, in arrays of its own.
#pragma once

#include "Optimize/Kernel/CellMeasure.h"
#include "Optimize/Kernel/VertexConstraints.h"
#include "Support/Buffer.h"

namespace atria {

/// Faces and corners of the judged cells of a region, or of some of them.
struct RegionCells
{
  /// Faces of judged cells, each once. The normal points out of the owner, which is a judged cell. The neighbor is a
  /// judged cell or a ghost; noIndex on the boundary of the mesh.
  std::vector<Index> faceOffsets{0};
  std::vector<Index> facePoints;
  std::vector<Index> owner;
  std::vector<Index> neighbor;
  /// One entry per judged cell: its corners as indices into `points`. Empty if they were not requested.
  std::vector<NativeCell> natives;
};

/// Cells that are judged, around points that may move, and ghosts: cells beside them that are only measured. Every cell
/// around a point that may move is judged, so nothing outside the region changes. Cells are closed polyhedra of any
/// shape.
struct Region : RegionCells
{
  /// Points of the judged cells, and their numbers in the mesh. They are in the order of these numbers if some may
  /// move.
  std::vector<Vec3> points;
  std::vector<Index> pointIds;
  /// Faces of each judged cell, and the cells' numbers in the mesh. Judged cells come first, in the order of the mesh.
  Buffer<Index> cellOffsets{0};
  Buffer<Index> cellFaces;
  std::vector<Index> cellIds;
  /// Measures of the ghosts, which are numbered after the judged cells.
  std::vector<SizedCell> ghosts;
  /// Points that may move, in sets that move together. Each set has a leader, members with their shares of the leader's
  /// displacement, and the judged cells around them.
  std::vector<Index> movable;
  std::vector<Index> memberOffsets{0};
  Buffer<Index> members;
  std::vector<double> shares;
  std::vector<Index> aboutOffsets{0};
  Buffer<Index> about;

  std::size_t judgedCount() const { return cellOffsets.size() - 1; }
  std::size_t cellCount() const { return judgedCount() + ghosts.size(); }
  std::size_t faceCount() const { return owner.size(); }
  std::span<const Index> face(std::size_t f) const
  {
    return {facePoints.data() + faceOffsets[f], facePoints.data() + faceOffsets[f + 1]};
  }
  std::span<const Index> facesOf(std::size_t cell) const
  {
    return {cellFaces.data() + cellOffsets[cell], cellFaces.data() + cellOffsets[cell + 1]};
  }
  std::span<const Index> membersOf(std::size_t movablePoint) const
  {
    return {members.data() + memberOffsets[movablePoint], members.data() + memberOffsets[movablePoint + 1]};
  }
  std::span<const double> sharesOf(std::size_t movablePoint) const
  {
    return {shares.data() + memberOffsets[movablePoint], shares.data() + memberOffsets[movablePoint + 1]};
  }
  std::span<const Index> cellsAbout(std::size_t movablePoint) const
  {
    return {about.data() + aboutOffsets[movablePoint], about.data() + aboutOffsets[movablePoint + 1]};
  }
};

/// Returns the region of `cells`, which are in order. No point of it may move, and its points and ghosts are in no
/// order. Throws Aborted when asked to.
Region extractCells(const CellSource& source, std::vector<Index> cells, bool withNatives, const RunContext& context);

/// Returns the region in which the marked points may move. With a marked point, its leader and all points that have
/// this leader must be marked. Marks take O(cells and points of the mesh); all else depends on the size of the region.
/// Throws Aborted when asked to.
Region extractRegion(const CellSource& source, const std::vector<char>& marked, const VertexConstraints& constraints,
                     bool withNatives, const RunContext& context);

} // namespace atria
