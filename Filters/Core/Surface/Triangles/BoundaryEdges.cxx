// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/BoundaryEdges.h"

#include "Surface/Triangles/EachEdge.h"

#include <tuple>

namespace atria {

BoundaryEdges::BoundaryEdges(std::span<const std::array<Index, 3>> triangles, std::size_t pointCount,
                             const Executor& executor, const std::function<bool(Index)>& wants)
{
  eachEdge(sortedEdgeUses(triangles, pointCount, executor), [&](std::span<const SoupEdgeUse> uses) {
    const auto& [edge, triangle, forward] = uses.front();
    if (uses.size() > 1 || (wants && !wants(triangle)))
    {
      return;
    }
    const auto [a, b] = forward ? edge : EdgeKey(edge.second, edge.first);
    for (const Index p : triangles[triangle])
    {
      if (p != a && p != b)
      {
        edges_.push_back({a, b, p, triangle});
      }
    }
  });
  std::sort(edges_.begin(), edges_.end(), [](const BoundaryEdge& l, const BoundaryEdge& r) {
    return std::tie(l.triangle, l.a) < std::tie(r.triangle, r.a);
  });
  ends_ = fillInOrder(pointCount, executor, [&](auto&& use) {
    executor.forEach(edges_.size(), 4096, [&](std::size_t e) {
      use(edges_[e].a, 2 * static_cast<Index>(e));
      use(edges_[e].b, 2 * static_cast<Index>(e) + 1);
    });
  });
}

std::span<const BoundaryEdge> BoundaryEdges::of(Index triangle) const
{
  // Clang 14 cannot compile std::ranges::equal_range of this library.
  return {std::ranges::lower_bound(edges_, triangle, {}, &BoundaryEdge::triangle),
          std::ranges::upper_bound(edges_, triangle, {}, &BoundaryEdge::triangle)};
}

std::vector<BoundaryEdges::Run> BoundaryEdges::runs() const
{
  std::vector<Run> runs;
  std::vector<char> isUsed(edges_.size(), 0);
  // Follows edges from the first one, which starts at its end `from`.
  const auto follow = [&](Index first, unsigned from) {
    Run& run = runs.emplace_back();
    End begin{first, from};
    while (!isUsed[begin.edge])
    {
      isUsed[begin.edge] = 1;
      run.links.push_back({begin.edge, begin.which == 0});
      const unsigned last = 1 - begin.which;
      const auto ends = at(edges_[begin.edge].end(last));
      if (ends.size() != 2)
      {
        return;
      }
      begin = endOf(ends[ends[0] == codeOf({begin.edge, last}) ? 1 : 0]);
    }
    run.isRing = true;
  };
  for (Index e = 0; e < edges_.size(); ++e)
  {
    for (const unsigned from : {0u, 1u})
    {
      if (!isUsed[e] && at(edges_[e].end(from)).size() != 2)
      {
        follow(e, from);
      }
    }
  }
  for (Index e = 0; e < edges_.size(); ++e)
  {
    if (!isUsed[e])
    {
      follow(e, 0);
    }
  }
  return runs;
}

} // namespace atria
