// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the blocks of a mesh, which are improved one by one, and the windows in which this is done.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Mesher/Blocks/ElementRows.h"
#include "Octree/Tree/MeshingContext.h"
#include "Octree/Tree/OctreeBlocks.h"

namespace atria {

/// Elements and vertices of a mesh that are near its boundary.
struct NearBoundary
{
  static constexpr std::uint8_t far = 255;

  /// One entry per vertex: 1 if it is so near that it may move.
  std::vector<char> mayMove;
  /// One entry per element: the rows between it and the boundary or a face of a zone; `far` if it is not near.
  std::vector<std::uint8_t> rows;

  bool isNear(Index element) const { return rows[element] != far; }
};

/// Exchanges what is near the boundary between the parts of a mesh. This base class serves a mesh in one part.
class NearExchange
{
public:
  virtual ~NearExchange() = default;
  /// True if an element belongs to this part, which then decides its values.
  virtual bool isOwn(Index) const { return true; }
  /// Sets the values of elements beside own ones to those of their parts. Returns the elements whose values changed.
  virtual std::vector<Index> takeElements(std::vector<std::uint8_t>&) const { return {}; }
  /// The same for vertices of own elements.
  virtual void takeVertices(std::vector<char>&) const {}
  virtual bool isAny(bool own) const { return own; }
};

/// Finds which own elements, elements beside them and vertices of own elements are near. All others count as far.
NearBoundary findNearBoundary(const DualMesh& mesh, const std::vector<Index>& vertexOf, std::size_t vertices,
                              const NearExchange& exchange = {});

/// The block of each vertex of a mesh, and the blocks [first, end) that are improved here.
struct MeshBlocks
{
  std::vector<Index> ofVertex;
  Index first;
  Index end;
  NearBoundary near;

  std::size_t count() const { return end - first; }
  bool isOwn(Index block) const { return block >= first && block < end; }
};

/// Returns the blocks of vertices, given their leaves. Blocks [first, end) of the octree are improved here.
MeshBlocks blocksOf(const Octree& octree, const std::vector<Index>& leaves, const OctreeBlocks& blocks, Index first,
                    Index end, NearBoundary near);

/// Windows of blocks, one for each block that is improved here.
struct BlockWindows
{
  /// Elements of each window, in order.
  std::vector<std::vector<Index>> elements;
  /// Blocks whose vertices each window has, in order.
  std::vector<std::vector<Index>> touching;
};

/// Extends elements near the boundary to the window in which their points are improved. Adds the elements between them
/// and the boundary, rows along it from there, and all near elements above these. O(elements found). The mesh must have
/// neighbors and boundary faces.
class WindowRows
{
public:
  WindowRows(const DualMesh& mesh, const NearBoundary& near)
      : mesh_(mesh), near_(near), marks_(mesh.neighbors.size(), 0)
  {
  }
  /// Returns the window of `elements`, in order.
  std::vector<Index> grow(std::vector<Index> elements);

private:
  template <typename IsNext> void add(std::size_t first, std::vector<Index>& elements, IsNext&& isNext);

  const DualMesh& mesh_;
  const NearBoundary& near_;
  std::vector<Index> marks_;
  Index last_ = 0;
};

/// Finds the windows of blocks improved here. `vertexOf` has the vertex of each point. Throws Aborted when asked to.
BlockWindows findWindows(const DualMesh& mesh, const std::vector<Index>& vertexOf, const MeshBlocks& blocks,
                         const RunContext& context);

/// Divides blocks into classes that are improved one after the other. Windows of blocks in one class have no vertices
/// of each other. `touching` has one entry per block of the mesh: the blocks whose vertices its window has.
std::vector<std::vector<Index>> findClasses(const std::vector<std::vector<Index>>& touching);

/// Sorts boundary faces by element and direction, an order that is the same in any part of a mesh. Returns one entry
/// per face: its number before.
std::vector<Index> orderBoundaryFaces(DualMesh& mesh);

} // namespace atria
