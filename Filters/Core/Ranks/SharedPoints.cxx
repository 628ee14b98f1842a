// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/SharedPoints.h"

#include "Ranks/SharedNumbers.h"
#include "Support/Sorting.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// Returns the key of a point: the first leaf that has it as a corner, and the corner's number.
PointKey keyOf(const Octree& octree, const std::array<Index, 8>& leaves)
{
  Index owner = noIndex;
  unsigned corner = 0;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    if (leaves[slot] < owner && std::ranges::count(leaves, leaves[slot]) == 1)
    {
      owner = leaves[slot];
      corner = 7 - slot;
    }
  }
  return octree.finestKey(owner) << 3 | corner;
}

Buffer<PointKey> keysOf(const RankShare& share, const Octree& octree, const GridPoints& points,
                        const RunContext& context)
{
  std::vector<char> isExact(octree.leafCount());
  context.executor.forEach(isExact.size(), 4096, [&](std::size_t leaf) {
    isExact[leaf] = share.isExact(octree, static_cast<Index>(leaf)) ? 1 : 0;
  });
  Buffer<PointKey> keys(points.size());
  context.executor.forEach(keys.size(), 4096, [&](std::size_t i) {
    const std::array<Index, 8>& leaves = points.leaves[i];
    const bool isOfWhole = std::ranges::all_of(leaves, [&](Index leaf) { return isExact[leaf] != 0; });
    keys[i] = isOfWhole ? keyOf(octree, leaves) : noKey;
  });
  return keys;
}

/// Returns the first leaf whose key in the finest grid is no less than `key`.
Index firstLeafFrom(MortonKey key, const Octree& octree)
{
  Index first = 0;
  for (auto end = static_cast<Index>(octree.leafCount()); first < end;)
  {
    const Index middle = first + (end - first) / 2;
    const bool isBefore = octree.finestKey(middle) < key;
    first = isBefore ? middle + 1 : first;
    end = isBefore ? end : middle;
  }
  return first;
}

IndexRange rangeOf(const std::pair<Index, Index>& range) { return {range.first, range.second}; }

} // namespace

SharedPoints::SharedPoints(const RankShare& share, const Octree& octree, const GridPoints& points,
                           const RunContext& context)
    : SharedPoints(share, octree, keysOf(share, octree, points, context))
{
  const auto isOfShare = [&](PointKey key) { return isOwn(key, share); };
  if (std::any_of(keys_.begin() + this->points().end, keys_.end(), isOfShare))
  {
    throw RanksDisagree("a rank's octree ends within its share");
  }
}

SharedPoints::SharedPoints(const RankShare& share, const Octree& octree, Buffer<PointKey> keys)
    : GridPart(rangeOf(ownRange(keys, share)),
               {firstLeafFrom(share.own().begin, octree), firstLeafFrom(share.own().end, octree)}, share.exchange()),
      share_(share), keys_(std::move(keys))
{
}

int SharedPoints::rankOf(Index point) const
{
  if (keys_[point] == noKey)
  {
    throw RanksDisagree("a rank's octree ends beside its share");
  }
  return share_.rankOf(keys_[point] >> 3);
}

JoinedSets SharedPoints::join(const PointSets& own,
                              const std::function<Index(Index point, int direction)>& nextTo) const
{
  std::vector<std::vector<Joint>> joints(static_cast<std::size_t>(share_.ranks()));
  for (Index point = points().begin; point < points().end; ++point)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      if (const Index other = nextTo(point, direction); other != noIndex && !owns(other))
      {
        joints[static_cast<std::size_t>(rankOf(other))].push_back({keys_[other], own.ofOwn[point - points().begin]});
      }
    }
  }
  std::ranges::for_each(joints, [](std::vector<Joint>& some) { sortUnique(some); });
  const std::vector<std::vector<Joint>> received = exchangeLists(exchange(), joints);
  // Sets are numbered one rank after the other.
  std::vector<Index> firsts(1, 0);
  for (const Index count : gatherAll(exchange(), own.count))
  {
    firsts.push_back(firsts.back() + count);
  }
  const Index firstOwn = firsts[static_cast<std::size_t>(share_.rank())];
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    for (const Joint& joint : received[rank])
    {
      pairs.emplace_back(firsts[rank] + joint.set, firstOwn + own.ofOwn[pointAt(joint.key) - points().begin]);
    }
  }
  sortUnique(pairs);
  UnionFind sets(firsts.back());
  for (const auto& [a, b] : joinAll(exchange(), std::move(pairs)))
  {
    sets.join(a, b);
  }
  JoinedSets joined;
  std::vector<Index> numbers(firsts.back());
  for (Index set = 0; set < numbers.size(); ++set)
  {
    const Index root = sets.find(set); // the first set, as ranks follow each other in the order of points
    numbers[set] = root == set ? joined.count++ : numbers[root];
  }
  for (std::size_t rank = 0; rank + 1 < firsts.size(); ++rank)
  {
    joined.ofSet.emplace_back(numbers.begin() + firsts[rank], numbers.begin() + firsts[rank + 1]);
  }
  return joined;
}

void SharedPoints::refresh(std::vector<std::int32_t>& values, std::int32_t elsewhere) const
{
  std::vector<Index> asked;
  std::vector<PointKey> keys;
  for (Index point = 0; point < values.size(); ++point)
  {
    if (keys_[point] == noKey)
    {
      values[point] = elsewhere;
    }
    else if (!owns(point))
    {
      asked.push_back(point);
      keys.push_back(keys_[point]);
    }
  }
  const auto rankOfKey = [&](PointKey key) { return share_.rankOf(key >> 3); };
  const auto answer = [&](PointKey key) { return values[pointAt(key)]; };
  const auto answers = askRanks<PointKey, std::int32_t>(exchange(), keys, rankOfKey, answer);
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    values[asked[i]] = answers[i];
  }
}

} // namespace atria
