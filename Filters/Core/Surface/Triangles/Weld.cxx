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

} // namespace

PointWelder::PointWelder(const std::vector<LatticePoint>& points_, std::int64_t reach)
    : points(points_), distance(reach), shift(std::bit_width(static_cast<std::uint64_t>(16 * reach)))
{
  reserve(points.size());
}

Index PointWelder::addNext()
{
  const auto id = static_cast<Index>(added++);
  reserve(added);
  const LatticePoint& p = points[id];
  const LatticePoint bin = binOf(p);
  const std::size_t slot = slotOf(bin);
  const Index found = std::min(findFrom(heads[slot], p), findBeside(bin, p));
  if (found != noIndex)
  {
    return found;
  }
  Index& head = heads[slot];
  if (head == noIndex)
  {
    head = id;
  }
  else
  {
    next[id] = next[head];
    next[head] = id;
  }
  return id;
}

std::vector<Index> PointWelder::addRest()
{
  std::vector<Index> representatives;
  representatives.reserve(points.size() - added);
  reserve(points.size());
  while (added < points.size())
  {
    representatives.push_back(addNext());
  }
  return representatives;
}

/// Returns the slot of the bin, or a free one.
std::size_t PointWelder::slotOf(const LatticePoint& bin) const
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

Index PointWelder::findFrom(Index head, const LatticePoint& p) const
{
  Index best = noIndex;
  for (Index i = head; i != noIndex; i = next[i])
  {
    if (within(points[i], p, distance))
    {
      best = std::min(best, i);
    }
  }
  return best;
}

/// Searches the bins around that of the point.
Index PointWelder::findBeside(const LatticePoint& bin, const LatticePoint& p) const
{
  const LatticePoint low = binOf({p[0] - distance, p[1] - distance, p[2] - distance});
  const LatticePoint high = binOf({p[0] + distance, p[1] + distance, p[2] + distance});
  if (low == high)
  {
    return noIndex;
  }
  Index best = noIndex;
  for (std::int64_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::int64_t x = low[0]; x <= high[0]; ++x)
      {
        const LatticePoint beside{x, y, z};
        best = beside == bin ? best : std::min(best, findFrom(heads[slotOf(beside)], p));
      }
    }
  }
  return best;
}

/// Makes room for `count` points. One point of each bin stands for its chain.
void PointWelder::reserve(std::size_t count)
{
  next.resize(std::max(next.size(), count), noIndex);
  if (2 * count < heads.size())
  {
    return;
  }
  std::vector<Index> before(std::bit_ceil(2 * count + 1), noIndex);
  before.swap(heads);
  for (const Index head : before)
  {
    if (head != noIndex)
    {
      heads[slotOf(binOf(points[head]))] = head;
    }
  }
}

std::vector<Index> weldPoints(const std::vector<LatticePoint>& points, std::int64_t distance)
{
  return PointWelder(points, distance).addRest();
}

} // namespace atria
