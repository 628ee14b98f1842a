// SPDX-License-Identifier: GPL-3.0-or-later
/// What a rank has of a mesh that is divided, with as many cells of other ranks about its own as a stage looks at.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/RankExchange.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atria {

/// What a rank has. Ghost cells are those of other ranks that share a point with its own.
struct NarrowPiece
{
  std::span<const Vec3> points;
  CellArrays cells;
  /// Numbers in the whole.
  IdView cellIds;
  IdView pointIds;
  /// By cell, 0 for ghosts.
  std::span<const char> isOwn;
  /// Faces of patches, and of each the number of its patch; those of own cells count.
  std::span<const BoundaryFaceKey> faces;
  std::span<const Index> patchOf;
  /// Numbers that cells bear, such as those of zones, list by list; each with one for each cell. As many lists on all
  /// ranks.
  std::vector<IdView> labels = {};
};

/// Which cells and points of the whole a wide piece has: what is left to be known of it once its faces are made.
struct WideNumbers
{
  std::vector<std::int64_t> pointIds; ///< rising
  std::vector<std::int64_t> cellIds;  ///< rising
  std::vector<Index> ranks;           ///< by cell, whose it is
  Index ringCount = 0;                ///< that were asked for; there may be fewer cells
  std::vector<Index> rings;           ///< by cell: 0 for own ones, 1 for those that share a point with these, and so on
  std::vector<std::vector<std::int64_t>> labels; ///< list by list, each by cell

  /// By cell, whether it is the rank's own.
  std::vector<char> ownCells() const;
  /// noIndex where it is not there.
  Index findCell(std::int64_t id) const;
};

/// Cells and points are in the order of their numbers in the whole, so that faces of the rank's own cells, and of all
/// that are not in the last ring, are in the order of the whole, with the same geometry to the bit.
struct WidePiece : WideNumbers
{
  std::vector<Vec3> points;
  std::vector<unsigned char> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> faceStream;
  std::vector<std::int64_t> faceLocations; ///< by cell, as in PolyhedronFaces

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
  /// Gives up what cells() shows.
  void releaseCells();
};

/// Adds rings of cells that share a point with those before. All ranks call it at the same time, with as many rings.
/// Each tells all others the points of its outermost cells, and gets their cells.
WidePiece widen(const NarrowPiece& piece, int rings, RankExchange& exchange);

} // namespace atria
