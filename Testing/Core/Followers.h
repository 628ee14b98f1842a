// SPDX-License-Identifier: GPL-3.0-or-later
/// Points that follow others, for tests of regions of cells.
#pragma once

#include "Optimize/Kernel/VertexConstraints.h"
#include "UpTo.h"

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace atria::testing {

using Loop = std::vector<Index>;

inline Loop someOf(std::size_t count, std::mt19937& random, unsigned oneIn)
{
  Loop numbers = upTo(count);
  std::erase_if(numbers, [&](Index) { return random() % oneIn != 0; });
  return numbers;
}

/// Points of which some follow others, by a share of their way.
class Followers : public VertexConstraints
{
public:
  bool isMovable(Index) const override { return true; }
  Index leaderOf(Index point) const override
  {
    const auto found = leaders.find(point);
    return found == leaders.end() ? point : found->second;
  }
  double shareOf(Index point) const override { return leaders.contains(point) ? 1.0 / (2.0 + point) : 1.0; }
  Vec3 place(Index, const Vec3& p) const override { return p; }

  std::map<Index, Index> leaders;
};

/// Marks some points, and lets some of them follow another.
inline std::vector<char> markSome(std::size_t points, std::mt19937& random, Followers& followers)
{
  Loop some = someOf(points, random, 12);
  std::ranges::shuffle(some, random);
  std::vector<char> marked(points, 0);
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    marked[some[i]] = 1;
    if (i % 3 != 0)
    {
      followers.leaders[some[i]] = some[i - i % 3];
    }
  }
  return marked;
}

} // namespace atria::testing
