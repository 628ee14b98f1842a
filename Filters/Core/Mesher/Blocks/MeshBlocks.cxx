// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Blocks/MeshBlocks.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace atria {

namespace {

/// Rows beside the elements at the boundary whose points may move, and rows around all elements with such points that
/// count as near.
constexpr int movingRows = 2;
constexpr int seenRows = 1;
/// Rows of elements along the boundary that a window has around its block.
constexpr int rowsAlong = 8;

/// Returns the elements with points on the boundary or on faces of zones, in order. Rows continue around edges of walls
/// over elements that only touch the edge.
std::vector<Index> elementsAtBoundary(const DualMesh& mesh)
{
  std::vector<char> isAtBoundary(mesh.points.size(), 0);
  const auto mark = [&](const auto& face) {
    for (const std::uint8_t corner : hexahedronFace[face.direction])
    {
      isAtBoundary[mesh.corners[face.element][corner]] = 1;
    }
  };
  std::ranges::for_each(mesh.boundaryFaces, mark);
  std::ranges::for_each(mesh.zoneFaces, mark);
  std::vector<Index> elements;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (hasMarked(mesh.corners[e], isAtBoundary))
    {
      elements.push_back(e);
    }
  }
  return elements;
}

/// Finds what is near the boundary row by row, so that the parts of a mesh find the same as the whole would.
class NearFinder
{
public:
  NearFinder(const DualMesh& mesh, const std::vector<Index>& vertexOf, const NearExchange& exchange)
      : mesh_(mesh), vertexOf_(vertexOf), exchange_(exchange)
  {
  }

  NearBoundary find(std::size_t vertices) const
  {
    NearBoundary out{std::vector<char>(vertices, 0),
                     std::vector<std::uint8_t>(mesh_.elementCount(), NearBoundary::far)};
    const std::vector<Index> atBoundary = ownOf(elementsAtBoundary(mesh_));
    for (const Index e : grow(atBoundary, movingRows))
    {
      std::ranges::for_each(mesh_.corners[e], [&](Index p) { out.mayMove[vertexOf_[p]] = 1; });
    }
    exchange_.takeVertices(out.mayMove);
    std::vector<Index> seen;
    for (Index e = 0; e < mesh_.elementCount(); ++e)
    {
      if (exchange_.isOwn(e) &&
          std::ranges::any_of(mesh_.corners[e], [&](Index p) { return out.mayMove[vertexOf_[p]] != 0; }))
      {
        seen.push_back(e);
      }
    }
    std::vector<char> isNear(mesh_.elementCount(), 0);
    std::ranges::for_each(grow(seen, seenRows), [&](Index e) { isNear[e] = 1; });
    countRows(atBoundary, isNear, out);
    return out;
  }

private:
  std::vector<Index> ownOf(std::vector<Index> elements) const
  {
    std::erase_if(elements, [&](Index e) { return !exchange_.isOwn(e); });
    return elements;
  }

  /// Returns the own elements, and those beside them, up to `rows` rows from the elements that each part has as `own`.
  std::vector<Index> grow(const std::vector<Index>& own, int rows) const
  {
    std::vector<std::uint8_t> marks(mesh_.elementCount(), 0);
    std::ranges::for_each(own, [&](Index e) { marks[e] = 1; });
    std::vector<Index> all = own;
    for (std::size_t begin = 0, row = 0;; ++row)
    {
      const std::vector<Index> theirs = exchange_.takeElements(marks);
      all.insert(all.end(), theirs.begin(), theirs.end());
      if (row == static_cast<std::size_t>(rows))
      {
        return all;
      }
      for (const std::size_t end = all.size(); begin < end; ++begin)
      {
        for (const std::int32_t code : mesh_.neighbors[all[begin]])
        {
          const Index other = beyond(mesh_, code);
          if (other != noIndex && marks[other] == 0 && exchange_.isOwn(other))
          {
            marks[other] = 1;
            all.push_back(other);
          }
        }
      }
    }
  }

  void countRows(std::vector<Index> row, const std::vector<char>& isNear, NearBoundary& out) const
  {
    for (std::uint8_t number = 0; exchange_.isAny(!row.empty()); ++number)
    {
      std::ranges::for_each(row, [&](Index e) { out.rows[e] = number; });
      const std::vector<Index> theirs = exchange_.takeElements(out.rows);
      row.insert(row.end(), theirs.begin(), theirs.end());
      std::vector<Index> next;
      for (const Index e : row)
      {
        for (const std::int32_t code : mesh_.neighbors[e])
        {
          const auto other = static_cast<Index>(code);
          if (code >= 0 && isNear[code] && !out.isNear(other) && exchange_.isOwn(other))
          {
            next.push_back(other);
          }
        }
      }
      sortUnique(next);
      row = std::move(next);
    }
  }

  const DualMesh& mesh_;
  const std::vector<Index>& vertexOf_;
  const NearExchange& exchange_;
};

/// Returns the elements with movable vertices of each block, in order.
std::vector<std::vector<Index>> elementsOfBlocks(const DualMesh& mesh, const std::vector<Index>& vertexOf,
                                                 const MeshBlocks& blocks)
{
  std::vector<std::vector<Index>> out(blocks.count());
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (const Index p : mesh.corners[e])
    {
      const Index block = blocks.ofVertex[vertexOf[p]];
      if (blocks.near.mayMove[vertexOf[p]] && blocks.isOwn(block))
      {
        std::vector<Index>& own = out[block - blocks.first];
        if (own.empty() || own.back() != e)
        {
          own.push_back(e);
        }
      }
    }
  }
  return out;
}

std::vector<Index> blocksIn(const DualMesh& mesh, const std::vector<Index>& vertexOf, const MeshBlocks& blocks,
                            const std::vector<Index>& window)
{
  std::vector<Index> found;
  for (const Index e : window)
  {
    for (const Index p : mesh.corners[e])
    {
      const Index block = blocks.ofVertex[vertexOf[p]];
      if (std::ranges::find(found, block) == found.end())
      {
        found.push_back(block);
      }
    }
  }
  std::ranges::sort(found);
  return found;
}

} // namespace

MeshBlocks blocksOf(const Octree& octree, const std::vector<Index>& leaves, const OctreeBlocks& blocks, Index first,
                    Index end, NearBoundary near)
{
  MeshBlocks out{std::vector<Index>(leaves.size()), first, end, std::move(near)};
  std::ranges::transform(leaves, out.ofVertex.begin(),
                         [&](Index leaf) { return blocks.blockOf(octree.finestKey(leaf)); });
  return out;
}

NearBoundary findNearBoundary(const DualMesh& mesh, const std::vector<Index>& vertexOf, std::size_t vertices,
                              const NearExchange& exchange)
{
  return NearFinder(mesh, vertexOf, exchange).find(vertices);
}

/// Adds near neighbors of the elements from place `first` on, and of those added, if `isNext(row, neighbor's row)`.
template <typename IsNext> void WindowRows::add(std::size_t first, std::vector<Index>& elements, IsNext&& isNext)
{
  for (; first < elements.size(); ++first)
  {
    const Index e = elements[first];
    for (const std::int32_t code : mesh_.neighbors[e])
    {
      const auto other = static_cast<Index>(code);
      if (code >= 0 && marks_[other] != last_ && near_.isNear(other) && isNext(near_.rows[e], near_.rows[other]))
      {
        marks_[other] = last_;
        elements.push_back(other);
      }
    }
  }
}

std::vector<Index> WindowRows::grow(std::vector<Index> elements)
{
  ++last_;
  std::ranges::for_each(elements, [&](Index e) { marks_[e] = last_; });
  add(0, elements, [](int from, int to) { return to < from; });
  ++last_;
  std::ranges::for_each(elements, [&](Index e) { marks_[e] = last_; });
  std::vector<Index> row;
  std::ranges::copy_if(elements, std::back_inserter(row), [&](Index e) { return near_.rows[e] == 0; });
  for (int number = 0; number < rowsAlong; ++number)
  {
    std::vector<Index> next;
    for (const Index e : row)
    {
      for (const std::int32_t code : mesh_.neighbors[e])
      {
        const Index other = beyond(mesh_, code);
        if (other != noIndex && marks_[other] != last_ && near_.rows[other] == 0)
        {
          marks_[other] = last_;
          next.push_back(other);
        }
      }
    }
    elements.insert(elements.end(), next.begin(), next.end());
    row = std::move(next);
  }
  add(0, elements, [](int from, int to) { return to > from; });
  std::ranges::sort(elements);
  return elements;
}

std::vector<Index> orderBoundaryFaces(DualMesh& mesh)
{
  std::vector<Index> order(mesh.boundaryFaces.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, {},
                    [&](Index f) { return std::pair(mesh.boundaryFaces[f].element, mesh.boundaryFaces[f].direction); });
  std::vector<BoundaryFace> faces;
  faces.reserve(order.size());
  std::ranges::transform(order, std::back_inserter(faces), [&](Index f) { return mesh.boundaryFaces[f]; });
  mesh.boundaryFaces.assign(faces.begin(), faces.end());
  for (std::size_t f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    mesh.neighbors[face.element][face.direction] = ~static_cast<std::int32_t>(f);
  }
  return order;
}

BlockWindows findWindows(const DualMesh& mesh, const std::vector<Index>& vertexOf, const MeshBlocks& blocks,
                         const RunContext& context)
{
  BlockWindows out;
  out.elements = elementsOfBlocks(mesh, vertexOf, blocks);
  WindowRows rows(mesh, blocks.near);
  for (std::vector<Index>& window : out.elements)
  {
    context.progress.check();
    window = rows.grow(std::move(window));
    out.touching.push_back(blocksIn(mesh, vertexOf, blocks, window));
  }
  return out;
}

std::vector<std::vector<Index>> findClasses(const std::vector<std::vector<Index>>& touching)
{
  std::vector<std::vector<Index>> both = touching;
  for (Index block = 0; block < touching.size(); ++block)
  {
    std::ranges::for_each(touching[block], [&](Index other) { both[other].push_back(block); });
  }
  // Each block gets the first class in which no other one touches it.
  std::vector<std::vector<Index>> classes;
  std::vector<Index> classOf(touching.size(), noIndex);
  for (Index block = 0; block < touching.size(); ++block)
  {
    std::vector<Index> taken;
    std::ranges::transform(both[block], std::back_inserter(taken), [&](Index other) { return classOf[other]; });
    Index own = 0;
    while (std::ranges::find(taken, own) != taken.end())
    {
      ++own;
    }
    classOf[block] = own;
    classes.resize(std::max<std::size_t>(classes.size(), own + std::size_t{1}));
    classes[own].push_back(block);
  }
  return classes;
}

} // namespace atria
