// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/TypicalSizes.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

/// Share of the octants of a surface that may be larger than is typical.
constexpr double largeShare = 0.1;

/// Counts the octants of each level at each surface and side.
class Counter
{
public:
  Counter(const Octree& o, const SurfaceModel& m)
      : octree(o), model(m), tags(m.names.size() + sideNumbers), levels(static_cast<std::size_t>(o.frame().depth) + 1)
  {
  }

  std::size_t size() const { return tags * levels; }
  std::size_t at(std::size_t tag, int level) const { return tag * levels + static_cast<std::size_t>(level); }

  void count(Index leaf, std::vector<std::size_t>& counts) const
  {
    const int level = octree.level(leaf);
    std::vector<Index> surfaces;
    for (const ModelItem item : octree.items(leaf, ModelItem::triangle))
    {
      surfaces.push_back(model.surfaceIds[item.index]);
    }
    sortUnique(surfaces);
    std::ranges::for_each(surfaces, [&](Index surface) { ++counts[at(surface, level)]; });
    const unsigned planes = octree.frame().domainPlanes(octree.lowCorner(leaf), octree.highCorner(leaf));
    for (std::size_t side = 0; side < 6; ++side)
    {
      counts[at(model.names.size() + side, level)] += planes >> side & 1U;
    }
  }

  std::vector<WallSize> sizes(const std::vector<std::size_t>& counts) const
  {
    std::vector<WallSize> out(tags);
    for (std::size_t tag = 0; tag < tags; ++tag)
    {
      const auto first = counts.begin() + static_cast<std::ptrdiff_t>(at(tag, 0));
      const auto all = std::accumulate(first, first + static_cast<std::ptrdiff_t>(levels), std::size_t{0});
      std::size_t larger = 0;
      for (std::size_t level = 0; level < levels && all > 0 && out[tag].typical == 0.0; ++level)
      {
        const double size = octree.frame().sizeOf(static_cast<int>(level));
        larger += *(first + static_cast<std::ptrdiff_t>(level));
        out[tag].largest = larger > 0 && out[tag].largest == 0.0 ? size : out[tag].largest;
        out[tag].typical = static_cast<double>(larger) > largeShare * static_cast<double>(all) ? size : 0.0;
      }
    }
    return out;
  }

private:
  const Octree& octree;
  const SurfaceModel& model;
  std::size_t tags;
  std::size_t levels;
};

} // namespace

std::vector<WallSize> typicalSizes(const Octree& octree, const SurfaceModel& model, const RunContext& context,
                                   const std::function<bool(Index leaf)>& isOwn, RankExchange& exchange)
{
  const Counter counter(octree, model);
  // One list per thread: there may be thousands of surfaces.
  const auto parts = static_cast<std::size_t>(context.executor.threads());
  std::vector<std::vector<std::size_t>> counts(parts, std::vector<std::size_t>(counter.size(), 0));
  context.executor.forEach(parts, 1, [&](std::size_t part) {
    const auto end = static_cast<Index>(octree.leafCount() * (part + 1) / parts);
    for (auto leaf = static_cast<Index>(octree.leafCount() * part / parts); leaf < end; ++leaf)
    {
      if (octree.inDomain(leaf) && (!isOwn || isOwn(leaf)))
      {
        counter.count(leaf, counts[part]);
      }
    }
  });
  std::vector<std::size_t> all(counter.size(), 0);
  for (const std::vector<std::size_t>& some : counts)
  {
    std::ranges::transform(all, some, all.begin(), std::plus());
  }
  return counter.sizes(sumAll(exchange, std::move(all)));
}

} // namespace atria
