// SPDX-License-Identifier: GPL-3.0-or-later
/// Polyhedral mesh given by its faces, the basis of solvers' formats and of metrics.
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

/// Every face once, owner before neighbor, in the order that OpenFOAM requires: internal faces first, sorted by (owner,
/// neighbor), then boundary faces sorted by owner. A face's normal (right-hand rule) points out of its owner.
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

/// A boundary face given by its cell and points. Such a face stays on the boundary even if another cell has the same
/// points (a zero-thickness sheet that is one face wide shares all of them).
struct BoundaryFaceKey
{
  Index cell;
  std::span<const std::int64_t> points;
};

/// Derives the faces of a mesh. Throws Error for an unknown cell type, for a point that does not exist, for a face that
/// more than two cells share and for one that a cell has twice; the text names the cells. O(n log n) in the number of
/// faces. The result has the same bits, and an error the same text, for any number of threads. A key that is no face of
/// its cell has no effect here; findBoundaryFaces() finds such keys. `whenRead` is called once `cells` are not needed
/// any more, so that their memory can be reused.
FaceMesh makeFaceMesh(std::vector<Vec3> points, const CellArrays& cells,
                      std::span<const BoundaryFaceKey> boundaryFaces = {}, const Executor& executor = SerialExecutor(),
                      const std::function<void()>& whenRead = {});

/// Returns one entry per key: the boundary face of its cell that has its points, or noIndex.
std::vector<Index> findBoundaryFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys,
                                     const Executor& executor = SerialExecutor());

/// Returns one entry per key: the internal face between its cell and its entry of `neighbors` that has its points, or
/// noIndex. Either cell may own it.
std::vector<Index> findInternalFaces(const FaceMesh& mesh, std::span<const BoundaryFaceKey> keys,
                                     std::span<const Index> neighbors, const Executor& executor = SerialExecutor());

/// A face of a mesh whose cells got new numbers. Its comparison sorts faces in the order that FaceMesh requires.
struct OrderedFace
{
  bool onBoundary;
  Index owner;
  Index neighbor; ///< noIndex on the boundary
  Index face;     ///< its old number
  bool turned;    ///< true if its old neighbor is now its owner

  auto operator<=>(const OrderedFace&) const = default;
};

/// Returns the OrderedFace of a face. `owner` and `neighbor` are the new numbers of its old owner and neighbor, one of
/// them noIndex on the boundary; they must not be equal.
OrderedFace orderFace(Index face, Index owner, Index neighbor);
/// Appends a face to a mesh whose faces are added in order. `loop` has its points in their old order.
void appendFace(FaceMesh& mesh, const OrderedFace& face, std::span<const Index> loop);

} // namespace atria
