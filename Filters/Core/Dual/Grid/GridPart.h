// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the points of a grid among the processes that make one mesh of it.
#pragma once

#include "Dual/Grid/GridPoints.h"
#include "Support/RankExchange.h"

#include <functional>
#include <numeric>

namespace atria {

/// Consecutive numbers, from `begin` up to `end`.
struct IndexRange
{
  Index begin = 0;
  Index end = 0;

  std::size_t size() const { return end - begin; }
  bool contains(Index i) const { return i >= begin && i < end; }
};

/// Sets of the points that a process owns, in the order of their first points.
struct PointSets
{
  /// One entry per own point.
  std::vector<Index> ofOwn;
  Index count = 0;
};

/// The sets of all processes, joined, in the order of their first points.
struct JoinedSets
{
  Index count = 0;
  /// One list per process: the joined set of each of its own sets.
  std::vector<std::vector<Index>> ofSet;
};

/// A value at a grid point.
template <typename T> struct AtPoint
{
  Index point;
  T value;
};

/// The grid points and leaves that a process owns. Each point of the grid has one owner. A process may know points of
/// others beside its own. This base class serves a process that owns all.
///
/// Stages that depend on the whole grid count what each process owns, and add that up. All processes must call the
/// functions that exchange data at the same time.
class GridPart
{
public:
  /// Owns all of a grid.
  explicit GridPart(const GridPoints& points)
      : GridPart({0, static_cast<Index>(points.size())}, {0, static_cast<Index>(points.atCorner.size())}, alone())
  {
  }
  virtual ~GridPart() = default;

  /// Return the points and leaves that this process owns.
  const IndexRange& points() const { return points_; }
  const IndexRange& leaves() const { return leaves_; }
  bool owns(Index point) const { return points_.contains(point); }
  bool isWhole() const { return exchange_.ranks() == 1; }
  RankExchange& exchange() const { return exchange_; }

  /// Joins sets of own points with those of other processes. `nextTo(point, direction)` returns the point in one of six
  /// directions if it is in one set with the own point, else noIndex.
  virtual JoinedSets join(const PointSets& own, const std::function<Index(Index point, int direction)>& nextTo) const;
  /// Sets the values of points that others own to theirs, or to `elsewhere` if these are not known.
  virtual void refresh(std::vector<std::int32_t>& /*values*/, std::int32_t /*elsewhere*/) const {}
  /// Sends values to the owners of their points. Returns those that were sent to this process.
  template <typename T> std::vector<AtPoint<T>> send(const std::vector<AtPoint<T>>& values) const;
  /// Adds up values per set of all processes by `add(more, sum)`, from those of own sets.
  template <typename T, typename Add> std::vector<T> sum(const JoinedSets& sets, std::vector<T> ofOwn, Add&& add) const;

protected:
  GridPart(const IndexRange& points, const IndexRange& leaves, RankExchange& exchange)
      : points_(points), leaves_(leaves), exchange_(exchange)
  {
  }
  GridPart(const GridPart&) = default;

  /// The rank that owns a point, and a key that stands for the point there.
  struct Address
  {
    int rank;
    std::uint64_t key;
  };
  virtual Address addressOf(Index point) const { return {0, point}; }
  /// Returns the own point with a key.
  virtual Index pointAt(std::uint64_t key) const { return static_cast<Index>(key); }

private:
  IndexRange points_;
  IndexRange leaves_;
  RankExchange& exchange_;
};

inline JoinedSets GridPart::join(const PointSets& own, const std::function<Index(Index, int)>& /*nextTo*/) const
{
  JoinedSets joined{own.count, {std::vector<Index>(own.count)}};
  std::iota(joined.ofSet[0].begin(), joined.ofSet[0].end(), Index{0});
  return joined;
}

template <typename T> std::vector<AtPoint<T>> GridPart::send(const std::vector<AtPoint<T>>& values) const
{
  struct Sent
  {
    std::uint64_t key;
    T value;
  };
  std::vector<std::vector<Sent>> toRanks(static_cast<std::size_t>(exchange_.ranks()));
  for (const AtPoint<T>& at : values)
  {
    const Address address = addressOf(at.point);
    toRanks[static_cast<std::size_t>(address.rank)].push_back({address.key, at.value});
  }
  std::vector<AtPoint<T>> received;
  for (const std::vector<Sent>& some : exchangeLists(exchange_, toRanks))
  {
    for (const Sent& sent : some)
    {
      received.push_back({pointAt(sent.key), sent.value});
    }
  }
  return received;
}

template <typename T, typename Add>
std::vector<T> GridPart::sum(const JoinedSets& sets, std::vector<T> ofOwn, Add&& add) const
{
  if (isWhole())
  {
    return ofOwn;
  }
  std::vector<T> sums(sets.count);
  const std::vector<std::vector<T>> all = gatherAll(exchange_, ofOwn);
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    for (std::size_t set = 0; set < all[rank].size(); ++set)
    {
      add(all[rank][set], sums[sets.ofSet[rank][set]]);
    }
  }
  return sums;
}

} // namespace atria
