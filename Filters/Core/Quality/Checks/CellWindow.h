// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes in parts that fit together: some cells, with all about them.
#pragma once

#include "Quality/Checks/BoxQuality.h"
#include "Support/Buckets.h"

namespace atria {

/// Some cells of a mesh, and those others that have a point of them: as a mesh of its own, in which the faces of the
/// former are as in the whole mesh. Cells keep their order, points do not.
class CellWindow
{
public:
  const FaceMesh& mesh() const { return mesh_; }
  /// The numbers that its cells have in the whole mesh, in rising order.
  std::span<const Index> cells() const { return cells_; }
  /// Whether a cell is not one of those that are only about.
  bool isOwn(std::size_t cell) const { return cells_[cell] >= firstOwn_ && cells_[cell] <= lastOwn_; }
  Index pointOf(Index point) const { return points_[point]; }
  CellArrays arrays() const
  {
    return {types_, offsets_, connectivity_, PolyhedronFaces::Stream(faceStream_, faceLocations_)};
  }
  /// Whether the faces that were asked for of its own cells are there, and none twice.
  bool hasAskedFaces(const Executor& executor) const;

private:
  friend class CellWindows;

  /// Faces asked for, with the numbers of the window.
  struct Faces
  {
    std::vector<Index> cells;
    std::vector<Index> neighbors; ///< of faces of zones
    std::vector<std::size_t> offsets{0};
    std::vector<std::int64_t> points;

    std::vector<BoundaryFaceKey> keys() const;
  };

  FaceMesh mesh_;
  Index firstOwn_ = 0;
  Index lastOwn_ = 0;
  std::vector<Index> cells_;
  std::vector<Index> points_;
  std::vector<unsigned char> types_;
  std::vector<std::int64_t> offsets_{0};
  std::vector<std::int32_t> connectivity_;
  std::vector<std::int64_t> faceStream_;
  std::vector<std::int64_t> faceLocations_;
  Faces patches_;
  Faces zones_;
};

/// The windows of a mesh, or of some of its cells: others then are not there. What it is made from must outlive it.
class CellWindows
{
public:
  /// `cells` are sound as far as their offsets; `chosen` is in rising order, and is shared out on windows of at least
  /// `length` cells.
  CellWindows(std::span<const Vec3> points, const CellArrays& cells, std::span<const Index> chosen,
              const AskedFaces& asked, std::size_t length, const Executor& executor);

  std::size_t count() const { return count_; }
  /// Throws Error as makeFaceMesh() does, with other numbers of cells and points.
  CellWindow window(std::size_t number, const Executor& executor);

private:
  void gatherCells(std::size_t number, CellWindow& out);
  void renumberPoints(CellWindow& out);
  void takeFaces(const Buckets& ofCell, std::span<const BoundaryFaceKey> faces, std::span<const Index> neighbors,
                 CellWindow::Faces& to, const CellWindow& window) const;

  std::span<const Vec3> points_;
  const CellArrays& cells_;
  std::span<const Index> chosen_;
  const AskedFaces& asked_;
  std::size_t count_;
  Buckets cellsAt_;           ///< by point, those chosen
  Buckets patchesOf_;         ///< by cell
  Buckets zonesOf_;           ///< by cell
  Buffer<Index> newPoint_;    ///< in the window that is made; else noIndex
  std::vector<char> isTaken_; ///< by cell, while a window is made
};

} // namespace atria
