// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Weld.h"

#include <algorithm>
#include <cstdlib>
#include <unordered_map>

namespace atria {

namespace {

struct BinHash
{
  std::size_t operator()(const LatticePoint& bin) const
  {
    std::uint64_t hash = 0;
    for (const std::int64_t c : bin)
    {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

bool within(const LatticePoint& a, const LatticePoint& b, std::int64_t distance)
{
  return std::abs(a[0] - b[0]) <= distance && std::abs(a[1] - b[1]) <= distance && std::abs(a[2] - b[2]) <= distance;
}

std::int64_t floorDivide(std::int64_t value, std::int64_t by)
{
  return value >= 0 ? value / by : -((-value + by - 1) / by);
}

/// Kept points by bin. Bins are wide against the distance, so that nearly always one bin has to be searched.
class Bins
{
public:
  explicit Bins(std::int64_t reach) : distance(reach), width(std::max<std::int64_t>(16 * reach, 1)) {}

  Index find(std::span<const LatticePoint> points, const LatticePoint& p) const
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
          best = std::min(best, findInBin(points, {x, y, z}, p));
        }
      }
    }
    return best;
  }

  void add(const LatticePoint& p, Index id)
  {
    const auto [head, isNew] = heads.try_emplace(binOf(p), id);
    next.resize(std::max<std::size_t>(next.size(), id + 1), noIndex);
    if (!isNew)
    {
      next[id] = head->second;
      head->second = id;
    }
  }

private:
  LatticePoint binOf(const LatticePoint& p) const
  {
    return {floorDivide(p[0], width), floorDivide(p[1], width), floorDivide(p[2], width)};
  }

  Index findInBin(std::span<const LatticePoint> points, const LatticePoint& bin, const LatticePoint& p) const
  {
    Index best = noIndex;
    const auto head = heads.find(bin);
    for (Index i = head == heads.end() ? noIndex : head->second; i != noIndex; i = next[i])
    {
      if (within(points[i], p, distance))
      {
        best = std::min(best, i);
      }
    }
    return best;
  }

  std::int64_t distance;
  std::int64_t width;
  std::unordered_map<LatticePoint, Index, BinHash> heads;
  std::vector<Index> next;
};

} // namespace

std::vector<Index> weldPoints(std::span<const LatticePoint> points, std::int64_t distance)
{
  std::vector<Index> representative(points.size());
  Bins bins(distance);
  for (Index i = 0; i < points.size(); ++i)
  {
    const Index found = bins.find(points, points[i]);
    representative[i] = found == noIndex ? i : found;
    if (found == noIndex)
    {
      bins.add(points[i], i);
    }
  }
  return representative;
}

} // namespace atria
