// SPDX-License-Identifier: GPL-3.0-or-later
/// Leaves out triangles that lie in one place in such numbers that searching all their pairs would not end: thousands
/// of copies that are nearly the same, or faces that all overlap each other.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace atria {

/// Marks triangles to leave out, so that at most `limit` pairs of the others have boxes, `margin` wider on every side,
/// that touch. Triangles that touch most are marked first, and among equals the last ones. If there are fewer pairs,
/// none are marked besides those in `isOut`. The limit should be well above ten times the number of triangles. O(n log
/// n + limit).
std::vector<char> findClusters(const TriangleSoup& soup, std::int64_t margin, std::size_t limit,
                               const RunContext& context, std::vector<char> isOut = {});

using TrianglePairs = std::vector<std::pair<Index, Index>>;

/// Returns a bound on how often three of `count` triangles meet, given the pairs that do: the sum, over all pairs, of
/// the lower number of pairs that either triangle has (Chiba and Nishizeki 1985). Cutting triangles along each other
/// makes pieces in this order.
std::size_t boundOfTriples(std::size_t count, const TrianglePairs& pairs);

/// Marks triangles to leave out, so that the bound is within `limit` for the others. The order is the same as above.
std::vector<char> findTangles(std::size_t count, const TrianglePairs& pairs, std::size_t limit);

/// Thrown by a search that meets more pairs of boxes than can be tested in reasonable time and memory.
struct TooManyPairs
{
};
inline constexpr std::size_t mostPairs = 200'000'000;

/// Throws TooManyPairs if `pairs` exceeds mostPairs.
void checkPairs(std::size_t pairs);

/// Hides triangles so that at most `limit` pairs of the others have boxes, `margin` wider on every side, that touch.
/// Sources are hidden as a whole.
void hideClusters(const TriangleSoup& soup, std::int64_t margin, std::size_t limit, ClusterCells& clusters,
                  const RunContext& context);

/// Returns the result of search(). If it throws TooManyPairs, hides triangles and calls it again.
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

/// Hides triangles that would be cut into too many pieces along others if these pairs meet, according to the bound.
/// Returns true if there were any.
bool hideTangles(const TriangleSoup& soup, const TrianglePairs& pairs, ClusterCells& clusters);

} // namespace atria
