// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSoup.h"

#include <numeric>
#include <span>
#include <vector>

namespace atria {

/// The triangles of a soup at each of its points, in order.
class Fans
{
public:
  explicit Fans(const TriangleSoup& soup) : offsets(soup.points.size() + 1, 0)
  {
    for (const auto& t : soup.triangles)
    {
      for (const Index p : t)
      {
        ++offsets[p + 1];
      }
    }
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    triangles.resize(offsets.back());
    std::vector<Index> next(offsets.begin(), offsets.end() - 1);
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      for (const Index p : soup.triangles[t])
      {
        triangles[next[p]++] = t;
      }
    }
  }

  std::span<const Index> at(Index p) const { return {triangles.data() + offsets[p], offsets[p + 1] - offsets[p]}; }

private:
  std::vector<Index> offsets;
  std::vector<Index> triangles;
};

} // namespace atria
