// SPDX-License-Identifier: GPL-3.0-or-later
/// Small triangle soups, and the uses of their edges found one by one.
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace atria::testing {

using Triangle = std::array<Index, 3>;
/// The use of an edge by a triangle: the lower point, the higher one, the triangle, and whether it runs forward.
using Use = std::tuple<Index, Index, Index, bool>;

/// Uses by edge, then by triangle.
inline std::vector<Use> naiveUses(const std::vector<Triangle>& triangles)
{
  std::vector<Use> uses;
  for (Index t = 0; t < triangles.size(); ++t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Index a = triangles[t].at(i);
      const Index b = triangles[t].at((i + 1) % 3);
      uses.emplace_back(std::min(a, b), std::max(a, b), t, a < b);
    }
  }
  std::ranges::sort(uses);
  return uses;
}

inline std::vector<Use> asTuples(const std::vector<SoupEdgeUse>& uses)
{
  std::vector<Use> out;
  std::ranges::transform(uses, std::back_inserter(out), [](const SoupEdgeUse& use) {
    return Use{use.edge.first, use.edge.second, use.triangle, use.forward};
  });
  return out;
}

/// Adds a closed box, wound outward.
inline void addBox(TriangleSoup& soup, const LatticePoint& low, std::int64_t size)
{
  const auto first = static_cast<Index>(soup.points.size());
  for (std::int64_t i = 0; i < 8; ++i)
  {
    soup.points.push_back({low[0] + size * (i % 2), low[1] + size * (i / 2 % 2), low[2] + size * (i / 4)});
  }
  for (const Triangle& t : {Triangle{0, 2, 3},
                            {0, 3, 1},
                            {4, 5, 7},
                            {4, 7, 6},
                            {0, 1, 5},
                            {0, 5, 4},
                            {2, 6, 7},
                            {2, 7, 3},
                            {0, 4, 6},
                            {0, 6, 2},
                            {1, 3, 7},
                            {1, 7, 5}})
  {
    soup.add({first + t[0], first + t[1], first + t[2]}, 0, static_cast<Index>(soup.triangles.size()));
  }
}

/// Adds a row of squares along x, wound upward.
inline void addStrip(TriangleSoup& soup, std::int64_t y, Index squares)
{
  const auto first = static_cast<Index>(soup.points.size());
  for (Index i = 0; i <= squares; ++i)
  {
    soup.points.insert(soup.points.end(), {{10 * std::int64_t{i}, y, 0}, {10 * std::int64_t{i}, y + 10, 0}});
  }
  for (Index p = first; p < first + 2 * squares; p += 2)
  {
    soup.add({p, p + 2, p + 3}, 0, static_cast<Index>(soup.triangles.size()));
    soup.add({p, p + 3, p + 1}, 0, static_cast<Index>(soup.triangles.size()));
  }
}

} // namespace atria::testing
