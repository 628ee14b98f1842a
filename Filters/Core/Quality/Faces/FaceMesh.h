// SPDX-License-Identifier: GPL-3.0-or-later
/// A polyhedral mesh by its faces: what solvers' formats and metrics are made of.
#pragma once

#include "Quality/Faces/CellArrays.h"
#include "Support/Buffer.h"
#include "Support/Executor.h"
#include "Support/Types.h"

#include <compare>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace atria {

/// Every face once, owner before neighbor, in the order OpenFOAM asks for: internal faces first, sorted by
/// (owner, neighbor), then boundary faces sorted by owner. A face's normal (right-hand rule) points out of
/// its owner.
struct FaceMesh
{
  std::vector<Vec3> points;
  /// Face f has the points facePoints[faceOffsets[f] .. faceOffsets[f + 1]).
  Buffer<Index> faceOffsets{0};
  Buffer<Index> facePoints;
  Buffer<Index> owner;
  /// One entry per internal face; internal faces are the first neighbor.size() faces.
  Buffer<Index> neighbor;
  std::size_t cellCount = 0;

  std::size_t faceCount() const { return owner.size(); }
  std::size_t internalFaceCount() const { return neighbor.size(); }
  std::span<const Index> face(std::size_t f) const
  {
    return {facePoints.data() + faceOffsets[f], facePoints.data() + faceOffsets[f + 1]};
  }
};

/// A boundary face named by its cell and points: such a face stays on the boundary even where another cell
/// has the same points (a zero-thickness sheet that is one face wide shares all of them).
struct BoundaryFaceKey
{
  Index cell;
  std::span<const std::int64_t> points;
};

/// Derives the faces of a mesh. Throws Error for an unknown cell type, for a point that does not exist, for a
/// face that more than two cells share and for one that a cell has twice; names the cells. O(n log n) in the
/// number of faces; the same bits, and the same error, for any number of threads. A key that is no face of its cell has
/// no effect here; findBoundaryFaces() finds such keys. `whenRead` is called when `cells` are not looked at any more,
/// so that their memory may be given up for what comes then.
FaceMesh makeFaceMesh(std::vector<Vec3> points, const CellArrays& cells,
                      std::span<const BoundaryFaceKey> boundaryFaces = {}, const Executor& executor = SerialExecutor(),
                      const std::function<void()>& whenRead = {});

/// Per key the boundary face of its cell that has its points, or noIndex.
std::vector<Index> findBoundaryFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys,
                                     const Executor& executor = SerialExecutor());

/// Per key the internal face between its cell and the one of `neighbors`, whichever owns it, that has its points; or
/// noIndex.
std::vector<Index> findInternalFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys,
                                     std::span<const Index> neighbors, const Executor& executor = SerialExecutor());

/// A face of a mesh whose cells have other numbers now. They sort in the order FaceMesh asks for.
struct OrderedFace
{
  bool onBoundary;
  Index owner;
  Index neighbor; ///< noIndex on the boundary
  Index face;     ///< its number before
  bool turned;    ///< whether what was its neighbor is its owner

  auto operator<=>(const OrderedFace&) const = default;
};

/// Of the cells that the face's owner and neighbor are now, one of them noIndex on the boundary; not equal.
OrderedFace orderFace(Index face, Index owner, Index neighbor);
/// Appends a face to a mesh that lists them in order. `loop` are its points, in the order they had.
void appendFace(FaceMesh& mesh, const OrderedFace& face, std::span<const Index> loop);

} // namespace atria
