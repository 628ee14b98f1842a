// SPDX-License-Identifier: GPL-3.0-or-later
/// Where elements are poor since blocks that meet there were improved one after the other.
#pragma once

#include "Mesher/Blocks/MeshBlocks.h"
#include "Mesher/Blocks/WindowTask.h"

#include <algorithm>
#include <span>
#include <utility>

namespace atria {

/// A part of a block's window that is improved again, about some elements. Lists are in order.
struct OpenedPlace
{
  std::vector<Index> window;
  /// Those that may move, and all points that are in one place with them.
  std::vector<Index> vertices;
  std::vector<Index> points;

  bool hasVertex(Index vertex) const;
};

class PoorPlaces
{
public:
  PoorPlaces(const DualMesh& mesh, const std::vector<Index>& vertexOf, const MeshBlocks& blocks);

  /// The blocks with poor elements, in order.
  std::vector<Index> blocksOf(const std::vector<PoorElement>& all) const;
  /// The elements of a block that are poor, or have such on them, less than so many rows away from another block:
  /// those that are near each other together. Rows are of the window of all elements that the block is improved among.
  std::vector<std::vector<Index>> find(Index block, const std::vector<PoorElement>& all, int reach,
                                       const std::vector<Index>& within);
  /// What is so many rows about elements in that window. O(elements found · log of the window) but for a mark for each
  /// vertex.
  OpenedPlace open(const std::vector<Index>& elements, int reach, const std::vector<Index>& within);

  /// The points of the plain mesh that an element has, or is above.
  std::vector<Index> wallPointsOf(const PoorElement& element) const;

private:
  std::vector<Index> grow(const std::vector<Index>& elements, int rows, const std::vector<Index>& within);
  Index plainElementOf(const PoorElement& element) const;
  Index blockAt(Index element) const;
  bool isWhereBlocksMeet(const std::vector<Index>& elements) const;
  std::vector<char> verticesThatStay(const std::vector<Index>& window) const;
  std::vector<char> verticesAtCut(const std::vector<Index>& window) const;
  std::span<const std::pair<Index, Index>> othersOf(Index vertex) const
  {
    const auto [begin, end] = std::equal_range(others_.begin(), others_.end(), std::pair(vertex, Index{0}),
                                               [](const auto& a, const auto& b) { return a.first < b.first; });
    return {begin, end};
  }

  const DualMesh& mesh_;
  const std::vector<Index>& vertexOf_;
  const MeshBlocks& blocks_;
  ElementRows rows_;
  /// Vertices with points that are not theirs by number, and these, in order.
  std::vector<std::pair<Index, Index>> others_;
};

} // namespace atria
