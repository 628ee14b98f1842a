// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/SoupParts.h"

#include "Support/UnionFind.h"

#include <algorithm>
#include <utility>

namespace atria {

std::vector<Index> partsOf(const TriangleSoup& soup)
{
  UnionFind sets(soup.points.size());
  for (const auto& t : soup.triangles)
  {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  std::vector<Box3> boxes(soup.points.size());
  for (const auto& t : soup.triangles)
  {
    for (const Index p : t)
    {
      boxes[sets.find(p)].extend(toVector(soup.points[p]));
    }
  }
  std::vector<std::pair<double, Index>> sizes; // sizes of parts, equal ones by their lowest point from high to low
  for (Index p = 0; p < soup.points.size(); ++p)
  {
    const Vec3 length = boxes[p].empty() ? Vec3::Zero() : boxes[p].size();
    if (!boxes[p].empty())
    {
      sizes.emplace_back(std::max({length[0] * length[1], length[1] * length[2], length[2] * length[0]}), ~p);
    }
  }
  std::sort(sizes.begin(), sizes.end());
  std::vector<Index> rank(soup.points.size(), 0);
  for (Index i = 0; i < sizes.size(); ++i)
  {
    rank[~sizes[i].second] = i;
  }
  std::vector<Index> parts(soup.sources.empty() ? 0 : soup.sources.back() + 1, 0);
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    parts[soup.sources[t]] = rank[sets.find(soup.triangles[t][0])];
  }
  return parts;
}

} // namespace atria
