// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a mesh that is optimised, in arrays of its own.
#pragma once

#include "Dual/DualMesh.h"
#include "Optimise/VertexGuide.h"
#include "Quality/Geometry.h"

#include <span>
#include <vector>

namespace atria {

/// A cell of a type that has a scaled Jacobian, with its corners in VTK's order; type 0 for any other.
struct NativeCell
{
  unsigned char type = 0;
  std::array<Index, 8> corners{};
};

/// Cells about points that may move, and beside them cells that only lend their centroids. Every cell about a
/// point that may move is judged, so what is outside the region does not change. Cells are any closed polyhedra.
struct Region
{
  /// Points of the judged cells, and their numbers in the mesh.
  std::vector<Vec3> points;
  std::vector<Index> pointIds;
  /// Faces of judged cells, once each; the normal points out of the owner, which is judged. `neighbour` is a cell of
  /// either kind, or noIndex on the mesh's boundary.
  std::vector<Index> faceOffsets{0};
  std::vector<Index> facePoints;
  std::vector<Index> owner;
  std::vector<Index> neighbour;
  /// Faces of each judged cell; the judged cells are the first, in the order of the mesh.
  std::vector<Index> cellOffsets{0};
  std::vector<Index> cellFaces;
  std::vector<Index> cellIds;
  /// Of each judged cell, its corners numbered as in `points`; empty unless they were asked for.
  std::vector<NativeCell> natives;
  /// Centroid and volume of the others, after the judged ones.
  std::vector<Vec3> ghostCentroids;
  std::vector<double> ghostVolumes;
  /// Points that may move, in sets that move as one: the leader of each set, its members, and the cells about them.
  std::vector<Index> movable;
  std::vector<Index> memberOffsets{0};
  std::vector<Index> members;
  std::vector<Index> aboutOffsets{0};
  std::vector<Index> about;

  std::size_t judgedCount() const { return cellOffsets.size() - 1; }
  std::size_t cellCount() const { return judgedCount() + ghostVolumes.size(); }
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
  std::span<const Index> cellsAbout(std::size_t movablePoint) const
  {
    return {about.data() + aboutOffsets[movablePoint], about.data() + aboutOffsets[movablePoint + 1]};
  }
};

/// A cell's face: its points with the normal outwards, and the cell across or noIndex.
struct CellFace
{
  std::span<const Index> points;
  Index across;
};

/// The cells of a mesh one at a time, whatever arrays it is kept in.
class CellSource
{
public:
  virtual ~CellSource() = default;
  virtual std::size_t cellCount() const = 0;
  virtual const std::vector<Vec3>& points() const = 0;
  /// The cells across a cell's faces.
  virtual void neighboursOf(Index cell, std::vector<Index>& out) const = 0;
  /// The points of a cell; some may be there more than once.
  virtual void cornersOf(Index cell, std::vector<Index>& out) const = 0;
  struct Scratch
  {
    std::vector<CellFace> faces;
    std::vector<Index> points;
    std::vector<Index> corners;
  };
  /// Fills `out`, whose spans are good until the next call with the same scratch. Points are called by `names`, as many
  /// as cornersOf gives and in their order.
  virtual void facesOf(Index cell, std::span<const Index> names, Scratch& out) const = 0;
  void facesOf(Index cell, Scratch& out) const
  {
    cornersOf(cell, out.corners);
    facesOf(cell, out.corners, out);
  }
  virtual NativeCell nativeOf(Index /*cell*/) const { return {}; }
  /// Whether the cell has one of the points marked.
  virtual bool hasMarked(Index cell, const std::vector<char>& marked) const = 0;
};

class DualSource : public CellSource
{
public:
  explicit DualSource(const DualMesh& mesh) : mesh_(mesh) {}
  std::size_t cellCount() const override { return mesh_.elementCount(); }
  const std::vector<Vec3>& points() const override { return mesh_.points; }
  using CellSource::facesOf;
  void neighboursOf(Index cell, std::vector<Index>& out) const override;
  void cornersOf(Index cell, std::vector<Index>& out) const override;
  void facesOf(Index cell, std::span<const Index> names, Scratch& out) const override;
  NativeCell nativeOf(Index cell) const override;
  bool hasMarked(Index cell, const std::vector<char>& marked) const override;

private:
  const DualMesh& mesh_;
};

/// `cells` are those the mesh was made of.
class FaceMeshSource : public CellSource
{
public:
  FaceMeshSource(const FaceMesh& mesh, const CellFaces& cellFaces, const CellArrays& cells)
      : mesh_(mesh), cellFaces_(cellFaces), cells_(cells)
  {
  }
  std::size_t cellCount() const override { return mesh_.cellCount; }
  const std::vector<Vec3>& points() const override { return mesh_.points; }
  using CellSource::facesOf;
  void neighboursOf(Index cell, std::vector<Index>& out) const override;
  void cornersOf(Index cell, std::vector<Index>& out) const override;
  void facesOf(Index cell, std::span<const Index> names, Scratch& out) const override;
  NativeCell nativeOf(Index cell) const override;
  bool hasMarked(Index cell, const std::vector<char>& marked) const override;

private:
  const FaceMesh& mesh_;
  const CellFaces& cellFaces_;
  const CellArrays& cells_;
};

/// Those that have one of the points marked, in order.
std::vector<Index> cellsWithMarked(const CellSource& source, const std::vector<char>& marked,
                                   const RunContext& context);

/// Cells in pieces of about the same number, each in order. Neighbours are in one piece mostly, also where their
/// numbers are far apart, as those of cells of a layer and of the cells they are on.
std::vector<std::vector<Index>> inPieces(const CellSource& source, const std::vector<Index>& cells);

/// Cells and those that share a face with one of them, in order.
std::vector<Index> withNeighbours(const CellSource& source, const std::vector<Index>& cells);

/// The region of some cells, in order, in which no point may move.
Region extractCells(const CellSource& source, std::vector<Index> cells, bool withNatives, const RunContext& context);

/// The region in which the points marked may move, each with all others that have the same leader; these are marked,
/// too, and their leader is one of them. O(cells) to find it, the rest in the region's size.
Region extractRegion(const CellSource& source, const std::vector<char>& marked, const VertexGuide& guide,
                     bool withNatives, const RunContext& context);

} // namespace atria
