// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/TriangleSoup.h"

#include <tuple>

namespace atria {

std::vector<SoupEdgeUse> sortedEdgeUses(const TriangleSoup& soup)
{
  std::vector<SoupEdgeUse> uses;
  uses.reserve(3 * soup.triangles.size());
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const EdgeKey edge = edgeKey(soup.triangles[t], i);
      uses.push_back({edge, t, edge.first == soup.triangles[t][i]});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const SoupEdgeUse& l, const SoupEdgeUse& r) {
    return std::tie(l.edge, l.triangle, l.forward) < std::tie(r.edge, r.triangle, r.forward);
  });
  return uses;
}

} // namespace atria
