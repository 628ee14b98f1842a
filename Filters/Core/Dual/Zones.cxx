// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones.h"

#include "Support/Error.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <sstream>

namespace atria {

namespace {

std::int32_t zoneOfSeed(const Vec3& seed, const Zones& zones, const Octree& octree, const GridPoints& points)
{
  const GridFrame& frame = octree.frame();
  const Vec3 placed = frame.placement.fromModel(seed);
  const LatticePoint p = frame.toLattice(placed);
  if (!frame.inDomain(p) || (frame.turnedDomain && !frame.turnedDomain->contains(seed)))
  {
    throw Error((std::ostringstream() << "the seed " << seed.transpose() << " is outside the domain").str());
  }
  const Index leaf = octree.leafAt(p);
  Index best = noIndex;
  double bestDistance = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    const Index point = points.atCorner[leaf][corner];
    const double distance = (frame.toModel(octree.cornerOf(leaf, corner)) - placed).squaredNorm();
    const bool inside =
        point != noIndex &&
        (!frame.turnedDomain ||
         frame.turnedDomain->contains(frame.placement.toModel(frame.toModel(octree.cornerOf(leaf, corner)))));
    if (inside && (best == noIndex || distance < bestDistance))
    {
      best = point;
      bestDistance = distance;
    }
  }
  if (best == noIndex)
  {
    throw Error((std::ostringstream() << "the seed " << seed.transpose() << " has no element about it").str());
  }
  return zones.ofPoint[best];
}

} // namespace

Zones findZones(const Crossings& crossings, const RunContext& context)
{
  const std::size_t count = crossings.neighbours.size();
  UnionFind sets(count);
  for (Index point = 0; point < count; ++point)
  {
    for (int direction = 1; direction < 6; direction += 2)
    {
      const std::int32_t neighbour = crossings.neighbours[point][direction];
      if (neighbour >= 0)
      {
        sets.join(point, static_cast<Index>(neighbour));
      }
    }
  }
  context.progress.check();
  std::vector<Index> roots;
  std::vector<Index> sizes(count, 0);
  for (Index point = 0; point < count; ++point)
  {
    const Index root = sets.find(point);
    if (root == point)
    {
      roots.push_back(root);
    }
    ++sizes[root];
  }
  std::stable_sort(roots.begin(), roots.end(), [&](Index l, Index r) { return sizes[l] > sizes[r]; });
  Zones zones;
  zones.sides.resize(roots.size(), 0);
  zones.ofPoint.resize(count);
  for (std::size_t i = 0; i < roots.size(); ++i)
  {
    zones.sizes.push_back(sizes[roots[i]]);
    zones.ofPoint[roots[i]] = static_cast<std::int32_t>(i);
  }
  for (Index point = 0; point < count; ++point)
  {
    zones.ofPoint[point] = zones.ofPoint[sets.find(point)];
  }
  for (const BoundaryFace& face : crossings.boundaryFaces)
  {
    if (face.onDomainSide)
    {
      zones.sides[zones.ofPoint[face.element]] |= static_cast<std::uint8_t>(1u << face.direction);
    }
  }
  return zones;
}

std::vector<char> keptZones(const Zones& zones, ZoneRule rule, const std::vector<Vec3>& seeds, const Octree& octree,
                            const GridPoints& points)
{
  std::vector<char> kept(zones.count(), rule == ZoneRule::all ? 1 : 0);
  if (rule == ZoneRule::outside)
  {
    constexpr unsigned bottom = 1u << zMin;
    const bool anyOpen =
        std::any_of(zones.sides.begin(), zones.sides.end(), [](unsigned s) { return (s & ~bottom) != 0; });
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
      kept[i] = (anyOpen ? zones.sides[i] & ~bottom : zones.sides[i]) != 0;
    }
  }
  else if (rule == ZoneRule::seeds)
  {
    if (seeds.empty())
    {
      throw Error("zones are to be kept by seeds, but there is no seed: give at least one point inside a zone");
    }
    for (const Vec3& seed : seeds)
    {
      kept[zoneOfSeed(seed, zones, octree, points)] = 1;
    }
  }
  if (std::find(kept.begin(), kept.end(), 1) == kept.end())
  {
    throw Error(rule == ZoneRule::all ? "there is nothing to mesh: no grid point is inside the domain"
                                      : "no zone is left to mesh: none reaches a side of the domain; keep all "
                                        "zones, or give seeds");
  }
  return kept;
}

} // namespace atria
