// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/Region.h"

#include "Optimize/Kernel/Extraction.h"
#include "Support/Buckets.h"

#include <algorithm>

namespace atria {

namespace {

constexpr std::size_t grain = 4096;

/// Returns one entry per point of the region: its leader as a number of the region, noIndex if the point is not marked.
std::vector<Index> leadersIn(const Region& region, const std::vector<char>& marked,
                             const VertexConstraints& constraints, const RunContext& context)
{
  std::vector<Index> leaders(region.pointIds.size(), noIndex);
  context.executor.forEach(leaders.size(), grain, [&](std::size_t p) {
    const Index id = region.pointIds[p];
    if (marked[id])
    {
      const Index leader = constraints.leaderOf(id);
      const auto found = std::ranges::lower_bound(region.pointIds, leader);
      leaders[p] = static_cast<Index>(leader == id ? p : found - region.pointIds.begin());
    }
  });
  return leaders;
}

/// Calls use(leader) once for each leader of some corners.
template <typename Use> void eachLeaderOf(std::span<const Index> corners, const std::vector<Index>& leaders, Use&& use)
{
  for (auto corner = corners.begin(); corner != corners.end(); ++corner)
  {
    const Index leader = leaders[*corner];
    if (leader != noIndex &&
        std::none_of(corners.begin(), corner, [&](Index before) { return leaders[before] == leader; }))
    {
      use(leader);
    }
  }
}

/// Adds the sets of marked points in the order of their leaders: leaders, members, and the judged cells that have a
/// member.
void addStars(Region& region, const Extraction& extraction, const std::vector<Index>& leaders,
              const RunContext& context)
{
  Buckets cells = fillInOrder(leaders.size(), context.executor, [&](auto&& use) {
    extraction.forCells(context, [&](Index cell, std::span<const Index> corners) {
      eachLeaderOf(corners, leaders, [&](Index leader) { use(leader, cell); });
    });
  });
  Buckets members = fillBuckets(leaders.size(), SerialExecutor(), [&](auto&& use) {
    for (Index p = 0; p < leaders.size(); ++p)
    {
      if (leaders[p] != noIndex)
      {
        use(leaders[p], p);
      }
    }
  });
  for (Index p = 0; p < leaders.size(); ++p)
  {
    if (!cells.of(p).empty())
    {
      region.movable.push_back(p);
      region.aboutOffsets.push_back(cells.offsets[p + 1]);
      region.memberOffsets.push_back(members.offsets[p + 1]);
    }
  }
  region.about = std::move(cells.entries);
  region.members = std::move(members.entries);
}

} // namespace

Region extractCells(const CellSource& source, std::vector<Index> cells, bool withNatives, const RunContext& context)
{
  return Extraction(source, std::move(cells), withNatives, Extraction::Order::any).run(context);
}

Region extractRegion(const CellSource& source, const std::vector<char>& marked, const VertexConstraints& constraints,
                     bool withNatives, const RunContext& context)
{
  Extraction extraction(source, cellsWithMarked(source, marked, context), withNatives, Extraction::Order::ofMesh);
  Region region = extraction.run(context);
  addStars(region, extraction, leadersIn(region, marked, constraints, context), context);
  region.shares.resize(region.members.size());
  std::ranges::transform(region.members, region.shares.begin(),
                         [&](Index local) { return constraints.shareOf(region.pointIds[local]); });
  context.progress.check();
  return region;
}

} // namespace atria
