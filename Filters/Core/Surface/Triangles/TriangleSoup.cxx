// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/TriangleSoup.h"

#include <tuple>

namespace atria {

std::vector<SoupEdgeUse> sortedEdgeUses(std::span<const std::array<Index, 3>> triangles, std::size_t pointCount,
                                        const Executor& executor)
{
  constexpr std::size_t grain = 4096;
  // Sides of triangles, by the first points of their edges.
  const Buckets sides = fillBuckets(pointCount, executor, [&](auto&& use) {
    executor.forEach(triangles.size(), grain, [&](std::size_t t) {
      for (Index i = 0; i < 3; ++i)
      {
        use(edgeKey(triangles[t], static_cast<int>(i)).first, 3 * static_cast<Index>(t) + i);
      }
    });
  });
  std::vector<SoupEdgeUse> uses(3 * triangles.size());
  executor.forEach(pointCount, grain, [&](std::size_t p) {
    const auto begin = uses.begin() + sides.offsets[p];
    const auto end = std::ranges::transform(sides.of(p), begin, [&](Index side) {
                       const auto& triangle = triangles[side / 3];
                       const EdgeKey edge = edgeKey(triangle, static_cast<int>(side % 3));
                       return SoupEdgeUse{edge, side / 3, edge.first == triangle[side % 3]};
                     }).out;
    std::sort(begin, end, [](const SoupEdgeUse& l, const SoupEdgeUse& r) {
      return std::tie(l.edge.second, l.triangle, l.forward) < std::tie(r.edge.second, r.triangle, r.forward);
    });
  });
  return uses;
}

Buckets trianglesAtPoints(const TriangleSoup& soup)
{
  return fillBuckets(soup.points.size(), SerialExecutor(), [&](auto&& use) {
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      for (const Index p : soup.triangles[t])
      {
        use(p, t);
      }
    }
  });
}

std::vector<SoupEdgeUse> sortedEdgeUses(const TriangleSoup& soup, const Executor& executor)
{
  return sortedEdgeUses(soup.triangles, soup.points.size(), executor);
}

} // namespace atria
