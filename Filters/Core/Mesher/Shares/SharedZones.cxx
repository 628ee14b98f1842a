// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Shares/SharedZones.h"

#include "Dual/Vertices/TurnedDomain.h"
#include "Dual/Zones/Leaks.h"
#include "Support/Error.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// Points of a rank that its edges join.
struct PointSet
{
  PointKey first;
  std::size_t size;
  SideBits sides;
  SideBits openSides;
};

/// An own set, and a point of another rank beside it.
struct Joint
{
  PointKey key;
  Index set;

  auto operator<=>(const Joint&) const = default;
};

class SharedZoneFinder
{
public:
  SharedZoneFinder(const Crossings& found, const SharedPoints& shared, std::size_t surfaces, const RankShare& rankShare)
      : crossings(found), points(shared), surfaceCount(surfaces), share(rankShare)
  {
  }

  Zones run()
  {
    numberSets();
    const std::vector<std::pair<Index, Index>> joints = answerJoints(jointsByRank());
    joinSets(joints);
    fillPoints();
    return std::move(zones);
  }

private:
  /// Sets of own points alone, by their first points.
  void numberSets()
  {
    const Index begin = points.firstOwn();
    const Index count = points.endOwn() - begin;
    UnionFind joined(count);
    for (Index i = 0; i < count; ++i)
    {
      for (const std::int32_t neighbor : crossings.neighbors[begin + i])
      {
        if (neighbor >= 0 && points.isOwn(static_cast<Index>(neighbor)))
        {
          joined.join(i, static_cast<Index>(neighbor) - begin);
        }
      }
    }
    setOf.resize(count);
    for (Index i = 0; i < count; ++i)
    {
      const Index root = joined.find(i);
      if (root == i)
      {
        setOf[i] = static_cast<Index>(sets.size());
        sets.push_back({points.key(begin + i), 0, 0, 0});
      }
      setOf[i] = setOf[root];
      ++sets[setOf[i]].size;
    }
    for (const BoundaryFace& face : crossings.boundaryFaces)
    {
      if (face.onDomainSide && points.isOwn(face.element))
      {
        const bool isOpen = face.tag >= surfaceCount;
        const SideBits bit = SideBits{1} << (isOpen ? face.tag - surfaceCount : face.direction);
        PointSet& set = sets[setOf[face.element - begin]];
        set.sides |= bit;
        set.openSides |= isOpen ? bit : 0;
      }
    }
  }

  std::vector<std::vector<Joint>> jointsByRank() const
  {
    std::vector<std::vector<Joint>> joints(static_cast<std::size_t>(share.ranks()));
    for (Index point = points.firstOwn(); point < points.endOwn(); ++point)
    {
      for (const std::int32_t neighbor : crossings.neighbors[point])
      {
        if (neighbor >= 0 && !points.isOwn(static_cast<Index>(neighbor)))
        {
          const auto other = static_cast<Index>(neighbor);
          joints[static_cast<std::size_t>(points.rankOf(other))].push_back(
              {points.key(other), setOf[point - points.firstOwn()]});
        }
      }
    }
    std::ranges::for_each(joints, [](std::vector<Joint>& some) { sortUnique(some); });
    return joints;
  }

  Index setOfKey(PointKey key) const
  {
    const Index point = points.find(key);
    if (point == noIndex)
    {
      throw RanksDisagree("ranks do not have the same octree where their shares meet");
    }
    return setOf[point - points.firstOwn()];
  }

  /// Pairs of sets that belong together, by their numbers among those of all ranks.
  std::vector<std::pair<Index, Index>> answerJoints(const std::vector<std::vector<Joint>>& toRanks)
  {
    const std::vector<std::vector<Joint>> asked = exchangeLists(share.exchange(), toRanks);
    allSets = gatherAll(share.exchange(), sets);
    firsts.assign(1, 0);
    for (const std::vector<PointSet>& some : allSets)
    {
      firsts.push_back(firsts.back() + static_cast<Index>(some.size()));
    }
    std::vector<std::pair<Index, Index>> pairs;
    for (std::size_t rank = 0; rank < asked.size(); ++rank)
    {
      for (const Joint& joint : asked[rank])
      {
        pairs.emplace_back(firsts[rank] + joint.set,
                           firsts[static_cast<std::size_t>(share.rank())] + setOfKey(joint.key));
      }
    }
    sortUnique(pairs);
    std::vector<std::pair<Index, Index>> all;
    for (const auto& some : gatherAll(share.exchange(), pairs))
    {
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  void joinSets(const std::vector<std::pair<Index, Index>>& joints)
  {
    UnionFind joined(firsts.back());
    for (const auto& [a, b] : joints)
    {
      joined.join(a, b);
    }
    std::vector<PointSet> all;
    for (const std::vector<PointSet>& some : allSets)
    {
      all.insert(all.end(), some.begin(), some.end());
    }
    std::vector<Index> roots;
    for (Index set = 0; set < all.size(); ++set)
    {
      const Index root = joined.find(set);
      if (root == set)
      {
        roots.push_back(set);
        continue;
      }
      all[root].size += all[set].size;
      all[root].sides |= all[set].sides;
      all[root].openSides |= all[set].openSides;
    }
    std::ranges::sort(roots, [&](Index l, Index r) {
      return all[l].size != all[r].size ? all[l].size > all[r].size : all[l].first < all[r].first;
    });
    std::vector<Index> zoneOfRoot(all.size());
    for (Index zone = 0; zone < roots.size(); ++zone)
    {
      const PointSet& set = all[roots[zone]];
      zoneOfRoot[roots[zone]] = zone;
      zones.sizes.push_back(set.size);
      zones.sides.push_back(set.sides);
      zones.openSides.push_back(set.openSides);
    }
    zoneOfSet.resize(sets.size());
    const Index first = firsts[static_cast<std::size_t>(share.rank())];
    for (Index set = 0; set < sets.size(); ++set)
    {
      zoneOfSet[set] = static_cast<std::int32_t>(zoneOfRoot[joined.find(first + set)]);
    }
  }

  /// Those of other ranks are asked for.
  void fillPoints()
  {
    const auto ranks = static_cast<std::size_t>(share.ranks());
    std::vector<std::vector<PointKey>> wanted(ranks);
    std::vector<std::vector<Index>> wantedPoints(ranks);
    zones.ofPoint.assign(crossings.neighbors.size(), static_cast<std::int32_t>(zones.count()));
    for (Index point = 0; point < zones.ofPoint.size(); ++point)
    {
      if (points.isOwn(point))
      {
        zones.ofPoint[point] = zoneOfSet[setOf[point - points.firstOwn()]];
      }
      else if (points.isShared(point))
      {
        const auto rank = static_cast<std::size_t>(points.rankOf(point));
        wanted[rank].push_back(points.key(point));
        wantedPoints[rank].push_back(point);
      }
    }
    std::vector<std::vector<std::int32_t>> answers;
    for (const std::vector<PointKey>& keys : exchangeLists(share.exchange(), wanted))
    {
      std::ranges::transform(keys, std::back_inserter(answers.emplace_back()),
                             [&](PointKey key) { return zoneOfSet[setOfKey(key)]; });
    }
    const auto received = exchangeLists(share.exchange(), answers);
    for (std::size_t rank = 0; rank < ranks; ++rank)
    {
      for (std::size_t i = 0; i < wantedPoints[rank].size(); ++i)
      {
        zones.ofPoint[wantedPoints[rank][i]] = received[rank][i];
      }
    }
  }

  const Crossings& crossings;
  const SharedPoints& points;
  std::size_t surfaceCount;
  const RankShare& share;
  std::vector<Index> setOf; ///< by own point
  std::vector<PointSet> sets;
  std::vector<std::vector<PointSet>> allSets; ///< by rank
  std::vector<Index> firsts;                  ///< the number of each rank's first set among all
  std::vector<std::int32_t> zoneOfSet;
  Zones zones;
};

/// Each rank knows the zones of seeds in its share.
std::vector<std::int32_t> zonesOfSharedSeeds(const Zones& zones, const std::vector<Vec3>& seeds, const GridPlaces& grid,
                                             const RankShare& share, const SurfaceModel& model, const char* kind)
{
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  std::vector<Vec3> own;
  std::ranges::copy_if(seeds, std::back_inserter(own), [&](const Vec3& seed) {
    const LatticePoint at = frame.toLattice(frame.placement.fromModel(seed));
    // All ranks say so of those outside.
    return !seed.allFinite() || !frame.inDomain(at) || share.isOwn(octree.finestKey(octree.leafAt(at)));
  });
  std::vector<std::int32_t> all;
  for (const auto& some : gatherAll(share.exchange(), zonesOfSeeds(zones, own, grid, model, kind)))
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

} // namespace

Zones findSharedZones(const Crossings& crossings, const SharedPoints& points, std::size_t surfaceCount,
                      const RankShare& share, const RunContext& context)
{
  context.progress.check();
  return SharedZoneFinder(crossings, points, surfaceCount, share).run();
}

std::vector<Index> sharedWideZones(const GridPoints& grid, const Crossings& crossings, const SharedPoints& points,
                                   std::size_t surfaceCount, const RankShare& share, const RunContext& context)
{
  const Zones zones = findSharedZones(crossings, points, surfaceCount, share, context);
  const std::vector<char> isOpen = pointsInTheOpen(grid, crossings, context);
  std::vector<char> isWide(zones.count(), 0);
  for (Index point = points.firstOwn(); point < points.endOwn(); ++point)
  {
    isWide[static_cast<std::size_t>(zones.ofPoint[point])] |= isOpen[point];
  }
  for (const std::vector<char>& some : gatherAll(share.exchange(), isWide))
  {
    std::ranges::transform(some, isWide, isWide.begin(), [](char a, char b) { return a | b; });
  }
  std::vector<Index> out(zones.ofPoint.size());
  std::ranges::transform(zones.ofPoint, out.begin(), [&](std::int32_t zone) {
    const auto number = static_cast<std::size_t>(zone);
    return number >= isWide.size() ? zoneElsewhere : isWide[number] ? static_cast<Index>(number) : noIndex;
  });
  return out;
}

std::vector<char> keptSharedZones(const Zones& zones, ZoneRule rule, const std::vector<Vec3>& seeds,
                                  const GridPlaces& grid, const SharedPoints& points, const RankShare& share,
                                  const SurfaceModel& model)
{
  std::vector<char> kept = keptZones(zones, rule, zonesOfSharedSeeds(zones, seeds, grid, share, model, "seed"));
  if (!grid.octree().frame().turnedDomain)
  {
    return kept;
  }
  std::vector<double> farthest(zones.count(), 0.0);
  for (const std::vector<double>& some :
       gatherAll(share.exchange(), farthestFromSides(zones, grid, points.firstOwn(), points.endOwn())))
  {
    std::ranges::transform(some, farthest, farthest.begin(),
                           [](double a, double b) { return std::abs(a) > std::abs(b) ? a : b; });
  }
  return zonesWithinSides(kept, farthest);
}

bool isAnyLeaking(const std::vector<Vec3>& sealedSeeds, const Zones& zones, const GridPlaces& grid,
                  const RankShare& share, const SurfaceModel& model)
{
  return std::ranges::any_of(zonesOfSharedSeeds(zones, sealedSeeds, grid, share, model, "sealed seed"),
                             [&](std::int32_t zone) { return isLeaking(zone, zones); });
}

} // namespace atria
