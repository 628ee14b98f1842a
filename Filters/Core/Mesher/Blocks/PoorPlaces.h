// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds places where elements are poor because the blocks that meet there were improved one after the other.
#pragma once

#include "Mesher/Blocks/MeshBlocks.h"
#include "Mesher/Blocks/WindowTask.h"

#include <algorithm>
#include <span>
#include <utility>

namespace atria {

/// A part of a block's window, around some elements, that is improved again. Lists are in order.
struct OpenedPlace
{
  std::vector<Index> window;
  /// Vertices that may move, and all points at these vertices.
  std::vector<Index> vertices;
  std::vector<Index> points;

  bool hasVertex(Index vertex) const;
};

class PoorPlaces
{
public:
  PoorPlaces(const DualMesh& mesh, const std::vector<Index>& vertexOf, const MeshBlocks& blocks);

  /// Returns the blocks with poor elements, in order.
  std::vector<Index> blocksOf(const std::vector<PoorElement>& all) const;
  /// Returns the plain elements of a block that are poor, or have poor ones on them, if a vertex of another block is at
  /// most `reach` rows away. Elements near each other are in one list. `within` is the window of the block.
  std::vector<std::vector<Index>> find(Index block, const std::vector<PoorElement>& all, int reach,
                                       const std::vector<Index>& within);
  /// Returns the place of `reach` rows around elements in the window `within`. O(elements found · log of the window),
  /// plus a mark for each vertex.
  OpenedPlace open(const std::vector<Index>& elements, int reach, const std::vector<Index>& within);

  /// Returns the points of the plain mesh that an element has or stands on.
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
  /// Pairs of a vertex and a point that stands for it under another number, in order.
  std::vector<std::pair<Index, Index>> others_;
};

} // namespace atria
