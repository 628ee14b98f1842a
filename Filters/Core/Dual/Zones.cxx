// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones.h"

#include "Support/Error.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <sstream>

namespace atria {

namespace {

/// The leaf of the octree that holds a lattice point.
Index leafAt(const Octree& octree, const LatticePoint& p)
{
  const GridFrame& frame = octree.frame();
  Octree::Node node = octree.root();
  for (int level = 1; !Octree::isLeaf(node); ++level)
  {
    unsigned child = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      child |= (p[axis] >> (frame.depth - level + frame.subBits) & 1) != 0 ? 1u << axis : 0u;
    }
    node = octree.children(node)[child];
  }
  return Octree::leafOf(node);
}

std::int32_t zoneOfSeed(const Vec3& seed, const Zones& zones, const Octree& octree, const GridPoints& points)
{
  const GridFrame& frame = octree.frame();
  const LatticePoint p = frame.toLattice(seed);
  if (!frame.inDomain(p))
  {
    throw Error((std::ostringstream() << "the seed " << seed.transpose() << " is outside the domain").str());
  }
  const Index leaf = leafAt(octree, p);
  Index best = noIndex;
  double bestDistance = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    const Index point = points.atCorner[leaf][corner];
    const double distance = (frame.toModel(octree.cornerOf(leaf, corner)) - seed).squaredNorm();
    if (point != noIndex && (best == noIndex || distance < bestDistance))
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
  std::vector<std::size_t> sizes(count, 0);
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
    sizes[roots[i]] = i;
  }
  for (Index point = 0; point < count; ++point)
  {
    zones.ofPoint[point] = static_cast<std::int32_t>(sizes[sets.find(point)]);
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
    throw Error("no zone is left to mesh: no zone reaches a side of the domain; keep all zones, or give seeds");
  }
  return kept;
}

} // namespace atria
