// SPDX-License-Identifier: GPL-3.0-or-later
/// Gives access to the cells of a mesh, whatever arrays they are stored in.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Quality/Faces/Geometry.h"

#include <span>
#include <vector>

namespace atria {

/// A cell of a type that has a scaled Jacobian, with its corners in VTK's order; type 0 for any other cell.
struct NativeCell
{
  unsigned char type = 0;
  std::array<Index, 8> corners{};
};

/// A face of a cell: its points, normal outward, and the cell across it or noIndex.
struct CellFace
{
  std::span<const Index> points;
  Index across;
};

/// A cell that is a box along the axes, up to rounding.
struct CellBox
{
  /// Lengths along the axes, in model units.
  Vec3 lengths;
  /// The cell across each of its faces, by Direction; noIndex if there is none.
  std::array<Index, 6> across;
};

/// Reads the cells of a mesh one at a time, whatever arrays they are stored in.
class CellSource
{
public:
  virtual ~CellSource() = default;
  virtual std::size_t cellCount() const = 0;
  virtual const std::vector<Vec3>& points() const = 0;
  /// Lists the cells across a cell's faces, in the order of facesOf(). Boundary faces are omitted.
  virtual void neighborsOf(Index cell, std::vector<Index>& out) const = 0;
  /// Lists the points of a cell. A point may be listed more than once.
  virtual void cornersOf(Index cell, std::vector<Index>& out) const = 0;
  /// Buffers that facesOf() fills.
  struct Scratch
  {
    std::vector<CellFace> faces;
    std::vector<Index> points;
    std::vector<Index> corners;
  };
  /// Lists the faces of a cell in `out.faces`, whose spans are valid until the next call with the same scratch. Points
  /// get the numbers in `names`, which has one entry for each that cornersOf() lists, in the same order.
  virtual void facesOf(Index cell, std::span<const Index> names, Scratch& out) const = 0;
  /// The same, with the numbers that the points have in the mesh.
  void facesOf(Index cell, Scratch& out) const
  {
    cornersOf(cell, out.corners);
    facesOf(cell, out.corners, out);
  }
  /// Returns the cell with its corners in VTK's order; type 0 if it has no scaled Jacobian.
  virtual NativeCell nativeOf(Index /*cell*/) const { return {}; }
  /// Sets `out` and returns true if the cell is a box along the axes. Returns false if it is none, or if that is not
  /// easy to decide.
  virtual bool boxOf(Index /*cell*/, CellBox& /*out*/) const { return false; }
  /// Returns true if a point of the cell is marked.
  virtual bool hasMarked(Index cell, const std::vector<char>& marked) const = 0;
  /// Appends the cells of [begin, end) that have a marked point.
  virtual void appendMarked(std::size_t begin, std::size_t end, const std::vector<char>& marked,
                            std::vector<Index>& out) const
  {
    for (auto cell = static_cast<Index>(begin); cell < end; ++cell)
    {
      if (hasMarked(cell, marked))
      {
        out.push_back(cell);
      }
    }
  }
};

/// The elements of a dual mesh.
class DualSource : public CellSource
{
public:
  explicit DualSource(const DualMesh& mesh) : mesh_(mesh) {}
  std::size_t cellCount() const override { return mesh_.elementCount(); }
  const std::vector<Vec3>& points() const override { return mesh_.points; }
  using CellSource::facesOf;
  void neighborsOf(Index cell, std::vector<Index>& out) const override;
  void cornersOf(Index cell, std::vector<Index>& out) const override;
  void facesOf(Index cell, std::span<const Index> names, Scratch& out) const override;
  NativeCell nativeOf(Index cell) const override;
  bool boxOf(Index cell, CellBox& out) const override;
  bool hasMarked(Index cell, const std::vector<char>& marked) const override;
  void appendMarked(std::size_t begin, std::size_t end, const std::vector<char>& marked,
                    std::vector<Index>& out) const override;

private:
  const DualMesh& mesh_;
};

/// The cells of a mesh given by its faces; `cells` are those it was made of.
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
  void neighborsOf(Index cell, std::vector<Index>& out) const override;
  void cornersOf(Index cell, std::vector<Index>& out) const override;
  void facesOf(Index cell, std::span<const Index> names, Scratch& out) const override;
  NativeCell nativeOf(Index cell) const override;
  bool hasMarked(Index cell, const std::vector<char>& marked) const override;

private:
  const FaceMesh& mesh_;
  const CellFaces& cellFaces_;
  const CellArrays& cells_;
};

/// Returns the numbers that are marked, in order.
std::vector<Index> numbersOf(const std::vector<char>& marked, const Executor& executor);

/// Returns the cells that have a marked point, in order. Throws Aborted when asked to.
std::vector<Index> cellsWithMarked(const CellSource& source, const std::vector<char>& marked,
                                   const RunContext& context);

/// Divides cells into pieces of about Pieces::length, each in no order. Most neighbors are in one piece, even if their
/// numbers are far apart, as those of the cells of a layer and of the cells beside it are.
std::vector<std::vector<Index>> inPieces(const CellSource& source, const std::vector<Index>& cells);

/// Returns the cells and those that share a face with one of them, in order.
std::vector<Index> withNeighbors(const CellSource& source, const std::vector<Index>& cells, const RunContext& context);

} // namespace atria
