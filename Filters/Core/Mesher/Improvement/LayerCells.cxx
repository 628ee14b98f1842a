// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/LayerCells.h"

#include <algorithm>

namespace atria {

std::vector<ShortCell> badOf(const std::vector<ShortCell>& cells)
{
  std::vector<ShortCell> bad;
  std::ranges::copy_if(cells, std::back_inserter(bad), [](const ShortCell& cell) { return cell.worst < soundEnough; });
  return bad;
}

std::vector<Index> cellsOf(const std::vector<ShortCell>& cells)
{
  std::vector<Index> out;
  std::ranges::transform(cells, std::back_inserter(out), &ShortCell::cell);
  return out;
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

} // namespace atria
