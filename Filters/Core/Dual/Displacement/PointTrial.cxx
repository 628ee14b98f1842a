// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of MovingGrid that try a point in other places.
#include "Dual/Displacement/MovingGrid.h"

#include <algorithm>

namespace atria {

namespace {

void addUnique(std::vector<Index>& list, std::span<const Index> more)
{
  for (const Index one : more)
  {
    if (std::ranges::find(list, one) == list.end())
    {
      list.push_back(one);
    }
  }
}

} // namespace

void PointTrial::put(const LatticePoint& place, Spoke& spoke) const
{
  (spoke.startsHere ? spoke.segment.start : spoke.segment.end) = place;
  spoke.segment.axis = place == undisplaced ? spoke.axis : -1;
}

void PointTrial::listTouching(const Spoke& spoke)
{
  const LatticeBox box = boundsOf(spoke.segment);
  touching.clear();
  for (const BoundedTriangle& one : spoke.triangles)
  {
    if (overlap(box, one.bounds))
    {
      touching.push_back(one.triangle);
    }
  }
}

void PointTrial::setWay(std::span<const SurfaceCrossing> cuts, const SurfaceModel& model, Spoke& spoke)
{
  const auto chartOf = [&](const SurfaceCrossing& cut) { return model.charts[cut.triangle]; };
  const auto known = std::ranges::find_if(
      spoke.ways, [&](const std::vector<Index>& charts) { return std::ranges::equal(charts, cuts, {}, {}, chartOf); });
  spoke.way = static_cast<std::size_t>(known - spoke.ways.begin());
  if (known == spoke.ways.end())
  {
    std::ranges::transform(cuts, std::back_inserter(spoke.ways.emplace_back()), chartOf);
  }
}

/// Packs the ways of all spokes of a leaf into one number.
std::uint64_t PointTrial::waysOf(const Leaf& leaf) const
{
  std::uint64_t key = 0;
  for (std::size_t i = 0; i < spokeCount; ++i)
  {
    key = key << 10 | ((leaf.spokes >> i & 1) != 0 ? spokes[i].way : 0);
  }
  return key;
}

/// Gathers what is around a point, for trials at places up to its shortest edge from its undisplaced place.
void MovingGrid::beginTrial(Index point, const LatticePoint& place, Look& look) const
{
  PointTrial& trial = look.trial;
  trial.point = point;
  look.version = version;
  trial.undisplaced = grid.undisplaced(point);
  trial.reach = grown({trial.undisplaced, trial.undisplaced}, shortestEdge(point));
  trial.reach.extend({place, place});
  trial.near.clear();
  addUnique(trial.near, grid.points().leaves[point]);
  trial.leafCount = trial.near.size();
  LatticeBox all = trial.reach;
  trial.spokeCount = 0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto edge = stored(point, direction);
    if (!edge)
    {
      continue;
    }
    PointTrial::Spoke& spoke = trial.spokes[trial.spokeCount++];
    spoke.id = idOf(edge->start, edge->along);
    spoke.segment = grid.segment(edge->start, edge->along, edge->edge, {point, trial.undisplaced});
    spoke.axis = spoke.segment.axis;
    spoke.startsHere = edge->start == point;
    spoke.leavesDomain = edge->edge.other == noIndex;
    spoke.ways.clear();
    trial.setWay(spoke.id == noIndex ? std::span<const SurfaceCrossing>() : at(spoke.id).cuts, surfaces, spoke);
    all.extend(boundsOf(spoke.segment));
    if (!spoke.leavesDomain)
    {
      addUnique(trial.near, grid.points().leaves[spoke.startsHere ? edge->edge.other : edge->start]);
    }
  }
  look.probe.gather(all, trial.near, trial.triangles);
  std::vector<PointTrial::BoundedTriangle>& bounded = trial.bounded;
  bounded.clear();
  std::ranges::transform(trial.triangles, std::back_inserter(bounded), [&](Index triangle) {
    return PointTrial::BoundedTriangle{
        boundsOf(surfaces.corner(triangle, 0), surfaces.corner(triangle, 1), surfaces.corner(triangle, 2)), triangle};
  });
  for (PointTrial::Spoke& spoke : std::span(trial.spokes).first(trial.spokeCount))
  {
    LatticeBox box = trial.reach;
    box.extend(boundsOf(spoke.segment));
    spoke.triangles.clear();
    std::ranges::copy_if(bounded, std::back_inserter(spoke.triangles),
                         [&](const PointTrial::BoundedTriangle& one) { return overlap(box, one.bounds); });
  }
  for (std::size_t i = 0; i < trial.leafCount; ++i)
  {
    beginTrialOf(trial.near[i], trial.leaves[i], trial);
  }
}

void MovingGrid::beginTrialOf(Index id, PointTrial::Leaf& leaf, const PointTrial& trial) const
{
  leaf.id = id;
  leaf.spokes = 0;
  for (std::size_t i = 0; i < trial.spokeCount; ++i)
  {
    const bool isThere = std::ranges::find(trial.spokes[i].segment.about, id) != trial.spokes[i].segment.about.end();
    leaf.spokes |= isThere ? 1u << i : 0u;
  }
  leaf.hasOthers = false;
  leaf.others.clear();
  leaf.found.clear();
  if (!findings[id].isStale)
  {
    leaf.found.emplace_back(trial.waysOf(leaf), findings[id].surplus);
  }
}

/// Returns the surplus found in a leaf when its spokes went the same ways; nullopt if they never did.
std::optional<int> PointTrial::foundIn(const Leaf& leaf) const
{
  const auto known = std::ranges::find(leaf.found, waysOf(leaf), &std::pair<std::uint64_t, int>::first);
  return known == leaf.found.end() ? std::nullopt : std::optional(known->second);
}

/// Returns the surplus of a leaf with its spokes as they are tried.
int MovingGrid::surplusOfTrial(PointTrial::Leaf& leaf, Look& look) const
{
  PointTrial& trial = look.trial;
  const auto spokes = std::span(trial.spokes).first(trial.spokeCount);
  if (!leaf.hasOthers)
  {
    leaf.hasOthers = true;
    eachEdge(leaf.id, [&](Index id) {
      const Edge edge = at(id);
      if (!edge.cuts.empty() && std::ranges::find(spokes, id, &PointTrial::Spoke::id) == spokes.end())
      {
        leaf.others.push_back(seenFrom(leaf.id, edge.segment, edge.cuts));
      }
    });
  }
  look.edges = leaf.others;
  for (std::size_t i = 0; i < spokes.size(); ++i)
  {
    if ((leaf.spokes >> i & 1) != 0 && !spokes[i].cuts.empty())
    {
      look.edges.push_back(seenFrom(leaf.id, spokes[i].segment, spokes[i].cuts));
    }
  }
  leaf.found.emplace_back(trial.waysOf(leaf), analyze(leaf.id, look));
  return leaf.found.back().second;
}

MovingGrid::Surplus MovingGrid::surplusAbout(Index point, const LatticePoint& place, Look& look, double limit) const
{
  PointTrial& trial = look.trial;
  constexpr std::size_t mostWays = 1024; // fit the bits of a key
  const auto hasMany = [](const PointTrial::Spoke& spoke) { return spoke.ways.size() >= mostWays; };
  if (trial.point != point || look.version != version || !trial.reach.contains(place) ||
      std::ranges::any_of(trial.spokes, hasMany))
  {
    beginTrial(point, place, look);
  }
  Surplus sum;
  for (PointTrial::Spoke& spoke : std::span(trial.spokes).first(trial.spokeCount))
  {
    trial.put(place, spoke);
    trial.listTouching(spoke);
    const auto cuts = look.probe.cutAmong(spoke.segment, trial.touching);
    spoke.cuts.assign(cuts.begin(), cuts.end());
    PointTrial::setWay(cuts, surfaces, spoke);
    sum.cuts += Edge{spoke.segment, spoke.leavesDomain, spoke.cuts}.surplus();
    if (sum.cost() > limit)
    {
      return sum;
    }
  }
  // Known leaves go first, as they often cost too much already.
  unsigned open = 0;
  for (std::size_t i = 0; i < trial.leafCount; ++i)
  {
    const std::optional<int> known = trial.foundIn(trial.leaves[i]);
    sum.leaves += known.value_or(0);
    open |= known ? 0u : 1u << i;
  }
  for (std::size_t i = 0; i < trial.leafCount && sum.cost() <= limit; ++i)
  {
    sum.leaves += (open >> i & 1) != 0 ? surplusOfTrial(trial.leaves[i], look) : 0;
  }
  return sum;
}

} // namespace atria
