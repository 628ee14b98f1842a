// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/TriangleSoup.h"

#include <numeric>
#include <tuple>

namespace atria {

std::vector<SoupEdgeUse> sortedEdgeUses(std::span<const std::array<Index, 3>> triangles, std::size_t pointCount)
{
  // Counted two places up and summed one place up, an offset serves as its point's cursor, and ends as its begin.
  std::vector<Index> offsets(pointCount + 2, 0);
  for (const auto& triangle : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      ++offsets[edgeKey(triangle, i).first + 2];
    }
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<SoupEdgeUse> uses(3 * triangles.size());
  for (Index t = 0; t < triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const EdgeKey edge = edgeKey(triangles[t], i);
      uses[offsets[edge.first + 1]++] = {edge, t, edge.first == triangles[t][i]};
    }
  }
  for (std::size_t p = 0; p < pointCount; ++p)
  {
    std::sort(uses.begin() + offsets[p], uses.begin() + offsets[p + 1], [](const SoupEdgeUse& l, const SoupEdgeUse& r) {
      return std::tie(l.edge.second, l.triangle, l.forward) < std::tie(r.edge.second, r.triangle, r.forward);
    });
  }
  return uses;
}

std::vector<SoupEdgeUse> sortedEdgeUses(const TriangleSoup& soup)
{
  return sortedEdgeUses(soup.triangles, soup.points.size());
}

} // namespace atria
