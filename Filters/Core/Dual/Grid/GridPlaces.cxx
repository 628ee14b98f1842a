// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Grid/GridPlaces.h"

#include <algorithm>

namespace atria {

std::vector<Index> GridPlaces::displacedPoints() const
{
  std::vector<Index> points;
  for (const auto& [point, place] : moved_)
  {
    points.push_back(point);
  }
  std::sort(points.begin(), points.end());
  return points;
}

GridPlaces::Edge GridPlaces::edge(Index point, int direction) const
{
  Edge edge;
  edge.at = edgeFrom(octree_, points_.leaves[point], direction);
  if (edge.exists())
  {
    edge.other = points_.atCorner[edge.at.leaf][edge.at.corner ^ (1u << axisOf(direction))];
  }
  return edge;
}

std::array<GridPlaces::Edge, 6> GridPlaces::edges(Index point) const
{
  std::array<Edge, 6> edges;
  const std::array<Index, 8>& leaves = points_.leaves[point];
  if (!areOfOneLevel(octree_, leaves))
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      edges[direction] = edge(point, direction);
    }
    return edges;
  }
  for (int direction = 0; direction < 6; ++direction)
  {
    const unsigned bit = 1u << axisOf(direction);
    const unsigned slot = isUpper(direction) ? bit : 0;
    edges[direction].at = {leaves[slot], 7 - slot};
    edges[direction].other = points_.atCorner[leaves[slot]][(7 - slot) ^ bit];
  }
  return edges;
}

EdgeSegment GridPlaces::segment(Index point, int direction, const Edge& edge, const GridTrial& trial) const
{
  const int axis = axisOf(direction);
  const unsigned bit = 1u << axis;
  EdgeSegment segment;
  segment.start = octree_.cornerOf(edge.at.leaf, edge.at.corner);
  segment.end = octree_.cornerOf(edge.at.leaf, edge.at.corner ^ bit);
  segment.axis = axis;
  segment.size = octree_.frame().latticeSize(octree_.level(edge.at.leaf));
  if (edge.other == noIndex)
  {
    segment.end[axis] = isUpper(direction) ? octree_.frame().domainHigh[axis] : octree_.frame().domainLow[axis];
  }
  if (isDisplaced(point, edge, trial))
  {
    segment.start = place(point, trial);
    segment.end = edge.other == noIndex ? segment.end : place(edge.other, trial);
    segment.axis = -1;
  }
  // Order around the edge of the four slots, counted in bits of the other two axes.
  constexpr std::array<unsigned, 4> round{0, 1, 3, 2};
  const unsigned u = 1u << ((axis + 1) % 3);
  const unsigned v = 1u << ((axis + 2) % 3);
  for (unsigned i = 0; i < 4; ++i)
  {
    const unsigned slot = (isUpper(direction) ? bit : 0u) | (round[i] & 1 ? u : 0u) | (round[i] & 2 ? v : 0u);
    segment.about[i] = points_.leaves[point][slot];
  }
  return segment;
}

std::vector<Index> GridPlaces::leavesNear(Index point, const Edge& edge) const
{
  const auto& here = points_.leaves[point];
  std::vector<Index> leaves(here.begin(), here.end());
  if (edge.other != noIndex)
  {
    const auto& there = points_.leaves[edge.other];
    leaves.insert(leaves.end(), there.begin(), there.end());
  }
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

} // namespace atria
