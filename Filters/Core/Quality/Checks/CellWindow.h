// SPDX-License-Identifier: GPL-3.0-or-later
/// Cuts a mesh into windows: some cells, with all cells around them.
#pragma once

#include "Quality/Checks/BoxQuality.h"
#include "Support/Buckets.h"
#include "Support/Numbering.h"

namespace atria {

/// Some cells of a mesh, and other cells that share points with them, as a separate mesh. Faces of the window's own
/// cells are the same as in the whole mesh. Cells keep their order, points do not.
class CellWindow
{
public:
  const FaceMesh& mesh() const { return mesh_; }
  /// Numbers of its cells in the whole mesh, in rising order.
  std::span<const Index> cells() const { return cells_; }
  /// True if the cell is one of the window's own, not one around them.
  bool isOwn(std::size_t cell) const { return cells_[cell] >= firstOwn_ && cells_[cell] <= lastOwn_; }
  Index pointOf(Index point) const { return points_[point]; }
  CellArrays arrays() const
  {
    return {types_, offsets_, connectivity_, PolyhedronFaces::Stream(faceStream_, faceLocations_)};
  }
  /// True if all requested faces of its own cells exist, and no requested face exists twice.
  bool hasAskedFaces() const;

private:
  friend class CellWindows;

  /// Requested faces, with the window's numbers.
  struct Faces
  {
    std::vector<Index> cells;
    std::vector<Index> neighbors; ///< second cells of zone faces
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

/// The windows of a mesh, or of some of its cells; other cells are then left out. The arguments must outlive it.
class CellWindows
{
public:
  /// The offsets of `cells` must be valid. `chosen` is in rising order and is divided into windows of at least `length`
  /// cells (a single window if there are fewer).
  CellWindows(std::span<const Vec3> points, const CellArrays& cells, std::span<const Index> chosen,
              const AskedFaces& asked, std::size_t length, const Executor& executor);

  std::size_t count() const { return count_; }
  /// Makes a window; may be called on several threads. Throws Error as makeFaceMesh() does, but with the window's
  /// numbers of cells and points.
  CellWindow window(std::size_t number) const;

private:
  void gatherCells(std::size_t number, CellWindow& out) const;
  void copyCells(CellWindow& out, Numbering& numbers) const;
  void takeFaces(const Buckets& ofCell, std::span<const BoundaryFaceKey> faces, std::span<const Index> neighbors,
                 CellWindow::Faces& to, const CellWindow& window, const Numbering& numbers) const;

  std::span<const Vec3> points_;
  const CellArrays& cells_;
  std::span<const Index> chosen_;
  const AskedFaces& asked_;
  std::size_t count_;
  Buckets cellsAt_;   ///< one entry per point: the chosen cells that have it
  Buckets patchesOf_; ///< one entry per cell
  Buckets zonesOf_;   ///< one entry per cell
};

} // namespace atria
