// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of a mesh that are improved one by one.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Mesher/Blocks/ElementRows.h"
#include "Octree/Tree/MeshingContext.h"
#include "Octree/Tree/OctreeBlocks.h"

namespace atria {

/// What of a mesh is near its boundary.
struct NearBoundary
{
  static constexpr std::uint8_t far = 255;

  /// By vertex, whether it is so near that it may move. All others stay.
  std::vector<char> mayMove;
  /// By element, how many rows it is from the boundary, or from a face of a zone; `far` where it is not looked at.
  std::vector<std::uint8_t> rows;

  bool isNear(Index element) const { return rows[element] != far; }
};

/// What parts of a mesh tell each other of what is near its boundary; by itself, of a mesh that has no other parts.
class NearExchange
{
public:
  virtual ~NearExchange() = default;
  /// Whether an element is of this part, which finds what is so of it.
  virtual bool isOwn(Index) const { return true; }
  /// Sets values of elements beside own ones as their parts have them, and returns those that changed.
  virtual std::vector<Index> takeElements(std::vector<std::uint8_t>&) const { return {}; }
  /// The same of vertices of own elements.
  virtual void takeVertices(std::vector<char>&) const {}
  virtual bool isAny(bool own) const { return own; }
};

/// Of own elements and those beside them, and of vertices of own elements; all else is far and stays.
NearBoundary findNearBoundary(const DualMesh& mesh, const std::vector<Index>& vertexOf, std::size_t vertices,
                              const NearExchange& exchange = {});

/// Which block each vertex of a mesh is of, and which blocks are improved here.
struct MeshBlocks
{
  std::vector<Index> ofVertex;
  Index first;
  Index end;
  NearBoundary near;

  std::size_t count() const { return end - first; }
  bool isOwn(Index block) const { return block >= first && block < end; }
};

/// Blocks of an octree from `first` up to `end` are improved here; `leaves` has the leaf of each vertex.
MeshBlocks blocksOf(const Octree& octree, const std::vector<Index>& leaves, const OctreeBlocks& blocks, Index first,
                    Index end, NearBoundary near);

/// What is improved, and among what. Lists by block are of those improved here.
struct BlockWindows
{
  /// The elements that each block is improved among, in order.
  std::vector<std::vector<Index>> elements;
  /// The blocks whose vertices each one's window has, in order.
  std::vector<std::vector<Index>> touching;
};

/// Adds to elements near the boundary those among which their points are improved: what is below them at the boundary,
/// rows along it from there, and what is above all that. O(elements found). Of a mesh there have to be neighbors and
/// boundary faces.
class WindowRows
{
public:
  WindowRows(const DualMesh& mesh, const NearBoundary& near)
      : mesh_(mesh), near_(near), marks_(mesh.neighbors.size(), 0)
  {
  }
  /// In order.
  std::vector<Index> grow(std::vector<Index> elements);

private:
  template <typename IsNext> void add(std::size_t first, std::vector<Index>& elements, IsNext&& isNext);

  const DualMesh& mesh_;
  const NearBoundary& near_;
  std::vector<Index> marks_;
  Index last_ = 0;
};

/// `vertexOf` gives the vertex of each point.
BlockWindows findWindows(const DualMesh& mesh, const std::vector<Index>& vertexOf, const MeshBlocks& blocks,
                         const RunContext& context);

/// Blocks, by number, whose windows have no vertices of each other, so that they can be improved at the same time; one
/// class after the other. Of the blocks that each of all blocks touches.
std::vector<std::vector<Index>> findClasses(const std::vector<std::vector<Index>>& touching);

/// Puts boundary faces in the order of elements and directions, which is the same in any part of a mesh. Returns their
/// numbers before, by number.
std::vector<Index> orderBoundaryFaces(DualMesh& mesh);

} // namespace atria
