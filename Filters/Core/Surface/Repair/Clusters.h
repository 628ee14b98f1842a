// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles that lie in one place in such numbers that looking at all pairs of them would not end: thousands of copies
/// that are nearly the same, faces that overlap all of each other.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace atria {

/// Marks triangles to leave out, so that of the others no more than `limit` pairs have boxes, `margin` wider on every
/// side, that touch. Those that touch most go first, of equals the last. None are marked where there are fewer pairs,
/// but for those that are from the first. The limit should be well above ten times the number of triangles.
/// O(n log n + limit).
std::vector<char> findClusters(const TriangleSoup& soup, std::int64_t margin, std::size_t limit,
                               const RunContext& context, std::vector<char> isOut = {});

using TrianglePairs = std::vector<std::pair<Index, Index>>;

/// A bound on how often three of `count` triangles meet, of which these pairs do: the sum of the lower of both
/// triangles' pairs over all pairs (Chiba and Nishizeki 1985). Cutting triangles along each other makes pieces in this
/// order.
std::size_t boundOfTriples(std::size_t count, const TrianglePairs& pairs);

/// Marks triangles to leave out, so that the bound is within `limit` for the others; which go first is as above.
std::vector<char> findTangles(std::size_t count, const TrianglePairs& pairs, std::size_t limit);

/// What a search throws that meets more pairs of boxes than can be looked at in reasonable time and memory.
struct TooManyPairs
{
};
inline constexpr std::size_t mostPairs = 200'000'000;

/// Throws TooManyPairs where these are more.
void checkPairs(std::size_t pairs);

/// Hides triangles so that of the others no more than `limit` pairs have boxes, `margin` wider on every side, that
/// touch. Sources are hidden as a whole.
void hideClusters(const TriangleSoup& soup, std::int64_t margin, std::size_t limit, ClusterCells& clusters,
                  const RunContext& context);

/// Calls search() and returns what it does; where it throws TooManyPairs, hides triangles and calls it again.
template <typename Search>
auto searchSeen(const TriangleSoup& soup, std::int64_t margin, ClusterCells& clusters, const RunContext& context,
                Search&& search)
{
  // Pairs may be met from both sides.
  for (std::size_t limit = mostPairs / 2;; limit /= 2)
  {
    try
    {
      return search();
    }
    catch (const TooManyPairs&)
    {
      hideClusters(soup, margin, limit, clusters, context);
    }
  }
}

/// Hides triangles that would be cut into too many pieces along others, as the bound tells, where these pairs meet.
/// Whether there were any.
bool hideTangles(const TriangleSoup& soup, const TrianglePairs& pairs, ClusterCells& clusters);

} // namespace atria
