// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/Weld.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace atria {

namespace {

bool within(const LatticePoint& a, const LatticePoint& b, std::int64_t distance)
{
  return std::abs(a[0] - b[0]) <= distance && std::abs(a[1] - b[1]) <= distance && std::abs(a[2] - b[2]) <= distance;
}

/// Kept points by bin, in a hash table with linear probing. Bins are wide against the distance, so that nearly always
/// one has to be searched.
class Bins
{
public:
  Bins(std::span<const LatticePoint> points_, std::int64_t reach)
      : points(points_), distance(reach), shift(std::bit_width(static_cast<std::uint64_t>(16 * reach))),
        heads(std::bit_ceil(2 * points_.size() + 1), noIndex), next(points_.size(), noIndex)
  {
  }

  Index find(const LatticePoint& p) const
  {
    const LatticePoint low = binOf({p[0] - distance, p[1] - distance, p[2] - distance});
    const LatticePoint high = binOf({p[0] + distance, p[1] + distance, p[2] + distance});
    Index best = noIndex;
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
        {
          best = std::min(best, findInBin({x, y, z}, p));
        }
      }
    }
    return best;
  }

  void add(Index id)
  {
    Index& head = heads[slotOf(binOf(points[id]))];
    if (head == noIndex)
    {
      head = id;
      return;
    }
    next[id] = next[head];
    next[head] = id;
  }

private:
  LatticePoint binOf(const LatticePoint& p) const { return {p[0] >> shift, p[1] >> shift, p[2] >> shift}; }

  /// Of the bin, or a free one.
  std::size_t slotOf(const LatticePoint& bin) const
  {
    std::uint64_t hash = 0;
    for (const std::int64_t c : bin)
    {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
    const std::size_t mask = heads.size() - 1;
    std::size_t slot = hash & mask;
    while (heads[slot] != noIndex && binOf(points[heads[slot]]) != bin)
    {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  Index findInBin(const LatticePoint& bin, const LatticePoint& p) const
  {
    Index best = noIndex;
    for (Index i = heads[slotOf(bin)]; i != noIndex; i = next[i])
    {
      if (within(points[i], p, distance))
      {
        best = std::min(best, i);
      }
    }
    return best;
  }

  std::span<const LatticePoint> points;
  std::int64_t distance;
  int shift;
  std::vector<Index> heads;
  std::vector<Index> next;
};

} // namespace

std::vector<Index> weldPoints(std::span<const LatticePoint> points, std::int64_t distance)
{
  std::vector<Index> representative(points.size());
  Bins bins(points, distance);
  for (Index i = 0; i < points.size(); ++i)
  {
    const Index found = bins.find(points[i]);
    representative[i] = found == noIndex ? i : found;
    if (found == noIndex)
    {
      bins.add(i);
    }
  }
  return representative;
}

} // namespace atria
