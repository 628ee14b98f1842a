// SPDX-License-Identifier: GPL-3.0-or-later
/// The cells of the meshes that are optimized, whatever arrays they are kept in.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Quality/Faces/Geometry.h"

#include <span>
#include <vector>

namespace atria {

/// A cell of a type that has a scaled Jacobian, with its corners in VTK's order; type 0 for any other.
struct NativeCell
{
  unsigned char type = 0;
  std::array<Index, 8> corners{};
};

/// A cell's face: its points with the normal outwards, and the cell across or noIndex.
struct CellFace
{
  std::span<const Index> points;
  Index across;
};

/// A cell that is a box along the axes, but for rounding.
struct CellBox
{
  Vec3 lengths;
  /// The cell across each of its faces, by Direction, or noIndex.
  std::array<Index, 6> across;
};

/// The cells of a mesh one at a time, whatever arrays it is kept in.
class CellSource
{
public:
  virtual ~CellSource() = default;
  virtual std::size_t cellCount() const = 0;
  virtual const std::vector<Vec3>& points() const = 0;
  /// The cells across a cell's faces, in the order of facesOf.
  virtual void neighborsOf(Index cell, std::vector<Index>& out) const = 0;
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
  /// Whether the cell is a box, and which; false where that cannot be told easily.
  virtual bool boxOf(Index /*cell*/, CellBox& /*out*/) const { return false; }
  /// Whether the cell has one of the points marked.
  virtual bool hasMarked(Index cell, const std::vector<char>& marked) const = 0;
  /// Appends those of the cells [begin, end) that have.
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

/// The numbers that are marked, in order.
std::vector<Index> numbersOf(const std::vector<char>& marked, const Executor& executor);

/// Those that have one of the points marked, in order.
std::vector<Index> cellsWithMarked(const CellSource& source, const std::vector<char>& marked,
                                   const RunContext& context);

/// Cells in pieces of about the same number, each in no order. Neighbors are in one piece mostly, also where their
/// numbers are far apart, as those of cells of a layer and of the cells they are on.
std::vector<std::vector<Index>> inPieces(const CellSource& source, const std::vector<Index>& cells);

/// Cells and those that share a face with one of them, in order.
std::vector<Index> withNeighbors(const CellSource& source, const std::vector<Index>& cells, const RunContext& context);

} // namespace atria
