// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Blocks/PoorPlaces.h"

#include "Support/Sorting.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace atria {

namespace {

/// Rows around opened elements in which all points stay, so that elements at points that move do not reach the cut.
constexpr int rowsBesideOpened = 6;

} // namespace

bool OpenedPlace::hasVertex(Index vertex) const { return std::ranges::binary_search(vertices, vertex); }

PoorPlaces::PoorPlaces(const DualMesh& mesh, const std::vector<Index>& vertexOf, const MeshBlocks& blocks)
    : mesh_(mesh), vertexOf_(vertexOf), blocks_(blocks), rows_(mesh)
{
  for (Index p = 0; p < vertexOf.size(); ++p)
  {
    if (vertexOf[p] != p)
    {
      others_.emplace_back(vertexOf[p], p);
    }
  }
  std::ranges::sort(others_);
}

std::vector<Index> PoorPlaces::blocksOf(const std::vector<PoorElement>& all) const
{
  std::vector<Index> blocks;
  std::ranges::transform(all, std::back_inserter(blocks),
                         [&](const PoorElement& one) { return blockAt(plainElementOf(one)); });
  sortUnique(blocks);
  return blocks;
}

std::vector<std::vector<Index>> PoorPlaces::find(Index block, const std::vector<PoorElement>& all, int reach,
                                                 const std::vector<Index>& within)
{
  std::vector<Index> elements;
  std::ranges::transform(all, std::back_inserter(elements),
                         [&](const PoorElement& one) { return plainElementOf(one); });
  sortUnique(elements);
  std::erase_if(elements, [&](Index e) {
    return blockAt(e) != block || !std::ranges::binary_search(within, e) ||
           !isWhereBlocksMeet(grow({e}, reach, within));
  });
  UnionFind sets(elements.size());
  std::map<Index, Index> holders;
  for (Index i = 0; i < elements.size(); ++i)
  {
    for (const Index e : grow({elements[i]}, reach, within))
    {
      sets.join(holders.emplace(e, i).first->second, i);
    }
  }
  std::map<Index, std::vector<Index>> places;
  for (Index i = 0; i < elements.size(); ++i)
  {
    places[sets.find(i)].push_back(elements[i]);
  }
  std::vector<std::vector<Index>> out;
  std::ranges::transform(places, std::back_inserter(out), [](const auto& entry) { return entry.second; });
  return out;
}

OpenedPlace PoorPlaces::open(const std::vector<Index>& elements, int reach, const std::vector<Index>& within)
{
  const std::vector<Index> opened = grow(elements, reach, within);
  OpenedPlace out;
  out.window = grow(opened, rowsBesideOpened, within);
  const std::vector<char> stays = verticesThatStay(out.window);
  for (const Index e : opened)
  {
    std::ranges::transform(mesh_.corners[e], std::back_inserter(out.vertices), [&](Index p) { return vertexOf_[p]; });
  }
  sortUnique(out.vertices);
  std::erase_if(out.vertices, [&](Index vertex) { return stays[vertex] || !blocks_.near.mayMove[vertex]; });
  out.points = out.vertices;
  for (const Index vertex : out.vertices)
  {
    std::ranges::transform(othersOf(vertex), std::back_inserter(out.points),
                           [](const auto& pair) { return pair.second; });
  }
  std::ranges::sort(out.points);
  return out;
}

std::vector<Index> PoorPlaces::wallPointsOf(const PoorElement& element) const
{
  if (element.isPlain())
  {
    return {mesh_.corners[element.place].begin(), mesh_.corners[element.place].end()};
  }
  const std::array<Index, 4> corners = cornersOf(mesh_, mesh_.boundaryFaces[element.place]);
  return {corners.begin(), corners.end()};
}

std::vector<Index> PoorPlaces::grow(const std::vector<Index>& elements, int rows, const std::vector<Index>& within)
{
  return rows_.grow(elements, rows, [&](Index e) { return std::ranges::binary_search(within, e); });
}

Index PoorPlaces::plainElementOf(const PoorElement& element) const
{
  return element.isPlain() ? element.place : mesh_.boundaryFaces[element.place].element;
}

Index PoorPlaces::blockAt(Index element) const { return blocks_.ofVertex[vertexOf_[mesh_.corners[element][0]]]; }

bool PoorPlaces::isWhereBlocksMeet(const std::vector<Index>& elements) const
{
  const Index first = blockAt(elements.front());
  return std::ranges::any_of(elements, [&](Index e) {
    return std::ranges::any_of(mesh_.corners[e], [&](Index p) { return blocks_.ofVertex[vertexOf_[p]] != first; });
  });
}

/// Marks the vertices of elements that have a vertex at the cut. Such elements are neither improved nor judged.
std::vector<char> PoorPlaces::verticesThatStay(const std::vector<Index>& window) const
{
  const std::vector<char> isAtCut = verticesAtCut(window);
  std::vector<char> stays = isAtCut;
  for (const Index e : window)
  {
    const auto& corners = mesh_.corners[e];
    if (std::ranges::any_of(corners, [&](Index p) { return isAtCut[vertexOf_[p]] != 0; }))
    {
      std::ranges::for_each(corners, [&](Index p) { stays[vertexOf_[p]] = 1; });
    }
  }
  return stays;
}

/// Marks the vertices that have elements which are not in the window.
std::vector<char> PoorPlaces::verticesAtCut(const std::vector<Index>& window) const
{
  std::vector<char> isAtCut(blocks_.ofVertex.size(), 1);
  std::vector<Index> points;
  for (const Index e : window)
  {
    points.insert(points.end(), mesh_.corners[e].begin(), mesh_.corners[e].end());
  }
  sortUnique(points);
  const auto isHere = [&](Index p) { return std::ranges::binary_search(points, p); };
  for (const Index vertex : points)
  {
    if (vertexOf_[vertex] == vertex)
    {
      const auto others = othersOf(vertex);
      isAtCut[vertex] = std::ranges::all_of(others, [&](const auto& pair) { return isHere(pair.second); }) ? 0 : 1;
    }
  }
  for (const Index e : window)
  {
    for (std::uint8_t direction = 0; direction < 6; ++direction)
    {
      const Index across = beyond(mesh_, mesh_.neighbors[e][direction]);
      const bool isCut = across != noIndex && !std::ranges::binary_search(window, across);
      for (int i = 0; i < 4 && isCut; ++i)
      {
        isAtCut[vertexOf_[mesh_.corners[e][hexahedronFace[direction][i]]]] = 1;
      }
    }
  }
  return isAtCut;
}

} // namespace atria
