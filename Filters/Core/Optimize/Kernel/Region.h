// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a mesh that is optimized, in arrays of its own.
#pragma once

#include "Optimize/Kernel/CellMeasure.h"
#include "Optimize/Kernel/VertexConstraints.h"
#include "Support/Buffer.h"

namespace atria {

/// Faces and corners of the judged cells of a region, or of some of them.
struct RegionCells
{
  /// Faces of judged cells, once each; the normal points out of the owner, which is judged. `neighbor` is a cell of
  /// either kind, or noIndex on the mesh's boundary.
  std::vector<Index> faceOffsets{0};
  std::vector<Index> facePoints;
  std::vector<Index> owner;
  std::vector<Index> neighbor;
  /// Of each judged cell, its corners numbered as in `points`; empty unless they were asked for.
  std::vector<NativeCell> natives;
};

/// Cells about points that may move, and beside them cells that are only measured. Every cell about a
/// point that may move is judged, so what is outside the region does not change. Cells are any closed polyhedra.
struct Region : RegionCells
{
  /// Points of the judged cells, and their numbers in the mesh, in whose order they are where some may move.
  std::vector<Vec3> points;
  std::vector<Index> pointIds;
  /// Faces of each judged cell; the judged cells are the first, in the order of the mesh.
  Buffer<Index> cellOffsets{0};
  Buffer<Index> cellFaces;
  std::vector<Index> cellIds;
  /// The others, after the judged ones.
  std::vector<SizedCell> ghosts;
  /// Points that may move, in sets that move as one: the leader of each set, its members with their shares of its way,
  /// and the cells about them.
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

/// The region of some cells, in order, in which no point may move; points and cells beside are in no order.
Region extractCells(const CellSource& source, std::vector<Index> cells, bool withNatives, const RunContext& context);

/// The region in which the points marked may move, each with all others that have the same leader; these are marked,
/// too, and their leader is one of them. O(cells) to find it, the rest in the region's size.
Region extractRegion(const CellSource& source, const std::vector<char>& marked, const VertexConstraints& constraints,
                     bool withNatives, const RunContext& context);

} // namespace atria
