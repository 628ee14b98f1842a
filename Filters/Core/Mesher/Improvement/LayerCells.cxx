// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerCells.h"

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

struct Stack
{
  Index first = noIndex;
  Index height = 0;
};

/// The elements on each wall face, by boundary face of the plain mesh.
std::vector<Stack> stacksOf(const LayerMesh& layer, std::size_t faces)
{
  std::vector<Stack> stacks(faces);
  for (std::size_t i = 0; i < layer.wallFaces.size(); ++i)
  {
    Stack& stack = stacks[layer.wallFaces[i]];
    stack.first = std::min(stack.first, layer.plainElements + static_cast<Index>(i));
    ++stack.height;
  }
  return stacks;
}

} // namespace

std::vector<ShortCell> badOf(const std::vector<ShortCell>& cells)
{
  std::vector<ShortCell> bad;
  std::ranges::copy_if(cells, std::back_inserter(bad), [](const ShortCell& cell) { return cell.worst < badBelow; });
  return bad;
}

std::vector<char> pointsToEvaluate(const LayerMesh& layer, const Executor& executor)
{
  std::vector<char> marked = boundaryPoints(layer.mesh, executor);
  markZonePoints(layer.mesh, marked);
  std::fill(marked.begin() + layer.plainPoints, marked.end(), 1);
  return marked;
}

void takeCopies(const LayerMesh& from, const std::vector<char>& but, LayerMesh& to)
{
  for (Index p = 0; p < to.plainPoints; ++p)
  {
    if (to.copies[p] != noIndex && from.copies[p] != noIndex && !but[p])
    {
      to.mesh.points[to.copies[p]] = from.mesh.points[from.copies[p]];
    }
  }
}

void markPoints(const LayerMesh& layer, const std::vector<ShortCell>& cells, std::vector<char>& marked)
{
  for (const ShortCell& cell : cells)
  {
    for (const Index p : layer.mesh.corners[cell.cell])
    {
      marked[layer.wallPointOf(p)] = 1;
    }
  }
}

std::vector<Index> cellsIn(const LayerMesh& layer, const LayerMesh& before)
{
  // Boundary faces of the plain mesh keep their numbers.
  const std::size_t faces = std::max(layer.mesh.boundaryFaces.size(), before.mesh.boundaryFaces.size());
  const std::vector<Stack> stacks = stacksOf(layer, faces);
  const std::vector<Stack> stacksBefore = stacksOf(before, faces);
  std::vector<Index> numbers(before.mesh.elementCount(), noIndex);
  std::iota(numbers.begin(), numbers.begin() + before.plainElements, Index{0});
  for (std::size_t i = 0; i < before.wallFaces.size(); ++i)
  {
    const auto [first, height] = stacks[before.wallFaces[i]];
    if (height == stacksBefore[before.wallFaces[i]].height)
    {
      numbers[before.plainElements + i] = first + before.heights[i];
    }
  }
  return numbers;
}

std::vector<char> pointsChanged(const LayerMesh& layer, const LayerMesh& before, const Executor& executor)
{
  std::vector<char> changed(layer.plainPoints);
  executor.forEach(changed.size(), 8192, [&](std::size_t p) {
    const Index copy = layer.copies[p];
    const Index copyBefore = before.copies[p];
    const auto chainOf = [](const LayerMesh& of, Index last) {
      return last == noIndex ? 0 : of.places[last - of.plainPoints];
    };
    const Index chain = chainOf(layer, copy);
    bool same = layer.mesh.points[p] == before.mesh.points[p] && chain == chainOf(before, copyBefore);
    for (Index i = 0; same && i < chain; ++i)
    {
      same = layer.mesh.points[copy - i] == before.mesh.points[copyBefore - i];
    }
    changed[p] = same ? 0 : 1;
  });
  return changed;
}

} // namespace atria
