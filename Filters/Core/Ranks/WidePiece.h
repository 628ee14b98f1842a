// SPDX-License-Identifier: GPL-3.0-or-later
/// Widens a rank's piece of a divided mesh by rings of cells of other ranks.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/RankExchange.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atria {

/// Piece of a mesh on a rank. Ghost cells are cells of other ranks that share a point with its own.
struct NarrowPiece
{
  std::span<const Vec3> points;
  CellArrays cells;
  /// Numbers in the whole.
  IdView cellIds;
  IdView pointIds;
  /// One entry per cell, 0 for ghosts.
  std::span<const char> isOwn;
  /// Faces of patches, and the patch number of each; only faces of own cells count.
  std::span<const BoundaryFaceKey> faces;
  std::span<const Index> patchOf;
  /// Lists of numbers of cells, such as zones, each with one entry per cell. All ranks must have the same number of
  /// lists.
  std::vector<IdView> labels = {};
};

/// Numbers of a wide piece's cells and points in the whole mesh; kept after its faces are made.
struct WideNumbers
{
  std::vector<std::int64_t> pointIds; ///< rising
  std::vector<std::int64_t> cellIds;  ///< rising
  std::vector<Index> ranks;           ///< one entry per cell: the rank that owns it
  Index ringCount = 0;                ///< number of rings requested; the mesh may end before
  std::vector<Index> rings;           ///< one entry per cell: 0 for own cells, 1 for cells that share a point with
                                      ///< these, and so on
  std::vector<std::vector<std::int64_t>> labels; ///< lists with one entry per cell

  /// Returns one entry per cell: 1 if it is the rank's own.
  std::vector<char> ownCells() const;
  /// Returns the cell with this number in the whole mesh; noIndex if the piece does not have it.
  Index findCell(std::int64_t id) const;
};

/// Cells and points are in the order of their numbers in the whole mesh. Faces of own cells, and of all cells that are
/// not in the last ring, are therefore in the order of the whole mesh, with the same geometry to the bit.
struct WidePiece : WideNumbers
{
  std::vector<Vec3> points;
  std::vector<unsigned char> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> faceStream;
  std::vector<std::int64_t> faceLocations; ///< one entry per cell, as in PolyhedronFaces

  /// Faces of patches.
  std::vector<Index> faceCells;
  std::vector<std::size_t> faceOffsets{0};
  std::vector<std::int64_t> facePoints;
  std::vector<Index> patchOf;

  CellArrays cells() const
  {
    return {types, offsets, connectivity, PolyhedronFaces::Stream(faceStream, faceLocations)};
  }
  std::vector<BoundaryFaceKey> faceKeys() const;
  /// Frees the arrays that cells() returns.
  void releaseCells();
};

/// Adds rings of cells that share a point with the cells before. All ranks call it at the same time, with the same
/// number of rings. Each rank sends the points of its outermost cells to all others, and gets their cells there.
WidePiece widen(const NarrowPiece& piece, int rings, RankExchange& exchange);

} // namespace atria
