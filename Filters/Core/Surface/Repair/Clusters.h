// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles that lie in one place in such numbers that looking at all pairs of them would not end: thousands of copies
/// that are nearly the same, faces that overlap all of each other.
#pragma once

#include "Support/Error.h"
#include "Support/RunContext.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace atria {

/// Marks triangles to leave out, so that of the others no more than `limit` pairs have boxes, `margin` wider on every
/// side, that touch. Those that touch most go first, of equals the last. None are marked where there are fewer pairs.
/// The limit should be well above ten times the number of triangles. O(n log n + limit).
std::vector<char> findClusters(const TriangleSoup& soup, std::int64_t margin, std::size_t limit,
                               const RunContext& context);

using TrianglePairs = std::vector<std::pair<Index, Index>>;

/// A bound on how often three of `count` triangles meet, of which these pairs do: the sum of the lower of both
/// triangles' pairs over all pairs (Chiba and Nishizeki 1985). Cutting triangles along each other makes pieces in this
/// order.
std::size_t boundOfTriples(std::size_t count, const TrianglePairs& pairs);

/// Marks triangles to leave out, so that the bound is within `limit` for the others; which go first is as above.
std::vector<char> findTangles(std::size_t count, const TrianglePairs& pairs, std::size_t limit);

/// Too many pairs of triangles to look at, or too many pieces that they would be cut into.
struct TooManyContacts : Error
{
  using Error::Error;
};

/// Throws TooManyContacts for more pairs of boxes than can be looked at in reasonable time and memory.
void checkPairs(std::size_t pairs);

/// Throws TooManyContacts where cutting triangles along each other would make too many pieces, as the bound tells.
void checkTriples(std::size_t count, const TrianglePairs& pairs);

} // namespace atria
