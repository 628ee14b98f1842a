// SPDX-License-Identifier: GPL-3.0-or-later
/// Sets of grid points that reach over several ranks.
#pragma once

#include "Mesher/Shares/SharedNumbers.h"
#include "Support/UnionFind.h"

#include <utility>

namespace atria {

/// By point of a rank's octree what the rank knows whose it is: `valueOf(point)` of an own one, and `elsewhere` for
/// points that are not the whole's. All ranks call it at the same time.
template <typename T, typename ValueOf>
std::vector<T> fillFromRanks(std::size_t count, const SharedPoints& points, const RankShare& share, T elsewhere,
                             ValueOf&& valueOf)
{
  std::vector<T> values(count, elsewhere);
  std::vector<Index> asked;
  std::vector<PointKey> keys;
  for (Index point = 0; point < count; ++point)
  {
    if (points.isOwn(point))
    {
      values[point] = valueOf(point);
    }
    else if (points.isShared(point))
    {
      asked.push_back(point);
      keys.push_back(points.key(point));
    }
  }
  const auto rankOf = [&](PointKey key) { return share.rankOf(key >> 3); };
  const auto answer = [&](PointKey key) { return valueOf(points.ownOf(key)); };
  const auto answers = askRanks<PointKey, T>(share.exchange(), keys, rankOf, answer);
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    values[asked[i]] = answers[i];
  }
  return values;
}

/// Grid points that edges join, over all ranks. Every rank joins its own points, and all join the sets of all: points
/// at borders are sent once, and what is to be known of each set. Throws RanksDisagree where ranks do not have the same
/// points.
class SharedSets
{
public:
  /// `nextTo(point, direction)` is the point that an edge joins with an own one; noIndex where there is none. All ranks
  /// make theirs at the same time.
  template <typename NextTo>
  SharedSets(const SharedPoints& sharedPoints, const RankShare& rankShare, NextTo&& nextTo)
      : points(sharedPoints), share(rankShare)
  {
    numberOwn(nextTo);
    join(answer(jointsByRank(nextTo)));
  }

  /// The sets of own points alone, in the order of their first points: how many, and that of each own point.
  std::size_t ownCount() const { return ownCount_; }
  const std::vector<Index>& ofOwn() const { return ofOwn_; }

  /// The sets of the whole, in the order of their first points.
  Index count() const { return count_; }
  /// That of an own point.
  Index of(Index point) const { return number(share.rank(), ofOwn_[point - points.firstOwn()]); }

  /// By set of the whole what ranks know of the sets of their own points: `add(more, value)` adds that of one. All
  /// ranks call it at the same time.
  template <typename T, typename Add> std::vector<T> sum(const std::vector<T>& ofOwnSets, Add&& add) const
  {
    std::vector<T> sums(count_);
    const std::vector<std::vector<T>> all = gatherAll(share.exchange(), ofOwnSets);
    for (std::size_t rank = 0; rank < all.size(); ++rank)
    {
      for (Index set = 0; set < all[rank].size(); ++set)
      {
        add(all[rank][set], sums[number(static_cast<int>(rank), set)]);
      }
    }
    return sums;
  }

private:
  /// An own set, and a point of another rank beside it.
  struct Joint
  {
    PointKey key;
    Index set;

    auto operator<=>(const Joint&) const = default;
  };
  using Pairs = std::vector<std::pair<Index, Index>>;

  template <typename NextTo> void numberOwn(NextTo&& nextTo)
  {
    const Index begin = points.firstOwn();
    const Index count = points.endOwn() - begin;
    UnionFind joined(count);
    for (Index i = 0; i < count; ++i)
    {
      for (int direction = 0; direction < 6; ++direction)
      {
        if (const Index other = nextTo(begin + i, direction); other != noIndex && points.isOwn(other))
        {
          joined.join(i, other - begin);
        }
      }
    }
    ofOwn_.resize(count);
    for (Index i = 0; i < count; ++i)
    {
      const Index root = joined.find(i); // the first of its set
      ofOwn_[i] = root == i ? ownCount_++ : ofOwn_[root];
    }
  }

  template <typename NextTo> std::vector<std::vector<Joint>> jointsByRank(NextTo&& nextTo) const
  {
    std::vector<std::vector<Joint>> joints(static_cast<std::size_t>(share.ranks()));
    for (Index point = points.firstOwn(); point < points.endOwn(); ++point)
    {
      for (int direction = 0; direction < 6; ++direction)
      {
        if (const Index other = nextTo(point, direction); other != noIndex && !points.isOwn(other))
        {
          joints[static_cast<std::size_t>(points.rankOf(other))].push_back(
              {points.key(other), ofOwn_[point - points.firstOwn()]});
        }
      }
    }
    return joints;
  }

  Pairs answer(std::vector<std::vector<Joint>> toRanks);
  void join(const Pairs& own);
  Index number(int rank, Index set) const { return numbers[firsts[static_cast<std::size_t>(rank)] + set]; }

  const SharedPoints& points;
  const RankShare& share;
  std::vector<Index> ofOwn_; ///< by own point
  Index ownCount_ = 0;
  Index count_ = 0;
  std::vector<Index> firsts;  ///< by rank, where its sets begin among those of all
  std::vector<Index> numbers; ///< of these, that of the set of the whole
};

} // namespace atria
