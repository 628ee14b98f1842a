// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Shares/SharedSets.h"

#include "Support/Sorting.h"

#include <algorithm>

namespace atria {

/// Pairs of own sets and those of others, by their numbers among those of all ranks.
SharedSets::Pairs SharedSets::answer(std::vector<std::vector<Joint>> toRanks)
{
  std::ranges::for_each(toRanks, [](std::vector<Joint>& some) { sortUnique(some); });
  const std::vector<std::vector<Joint>> asked = exchangeLists(share.exchange(), toRanks);
  firsts.assign(1, 0);
  for (const Index count : gatherAll(share.exchange(), ownCount_))
  {
    firsts.push_back(firsts.back() + count);
  }
  Pairs pairs;
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
  {
    for (const Joint& joint : asked[rank])
    {
      pairs.emplace_back(firsts[rank] + joint.set, firsts[static_cast<std::size_t>(share.rank())] +
                                                       ofOwn_[points.ownOf(joint.key) - points.firstOwn()]);
    }
  }
  sortUnique(pairs);
  return pairs;
}

void SharedSets::join(const Pairs& own)
{
  UnionFind joined(firsts.back());
  for (const Pairs& some : gatherAll(share.exchange(), own))
  {
    for (const auto& [a, b] : some)
    {
      joined.join(a, b);
    }
  }
  numbers.resize(firsts.back());
  for (Index set = 0; set < numbers.size(); ++set)
  {
    const Index root = joined.find(set); // the first: ranks have their points in a row
    numbers[set] = root == set ? count_++ : numbers[root];
  }
}

} // namespace atria
