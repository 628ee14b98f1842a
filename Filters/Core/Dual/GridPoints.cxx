// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/GridPoints.h"

#include "Support/Error.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace atria {

namespace {

/// A cell, face, edge or point between octants, as the octants in its eight directions. Along axes in `extent` (bits)
/// it has an extent of its own, and the octants below and above are the same.
struct Region
{
  std::array<Octree::Node, 8> nodes;
  unsigned extent;

  bool onlyLeaves() const
  {
    Octree::Node all = Octree::leafBit;
    for (const Octree::Node node : nodes)
    {
      all &= node;
    }
    return all != 0;
  }
};

/// Calls `visit(part)` for each of the 3^d parts into which the children of a region's octants divide it, where d axes
/// have an extent: along each of those a part lies in the lower half, in the upper, or in the plane between.
template <typename Visit> void divide(const Octree& octree, const Region& region, Visit&& visit)
{
  const unsigned fixed = ~region.extent & 7u;
  for (unsigned middle = region.extent;; middle = (middle - 1) & region.extent)
  {
    const unsigned halves = region.extent & ~middle;
    for (unsigned upper = halves;; upper = (upper - 1) & halves)
    {
      Region part;
      part.extent = halves;
      for (unsigned slot = 0; slot < 8; ++slot)
      {
        const Octree::Node node = region.nodes[slot];
        part.nodes[slot] =
            Octree::isLeaf(node) ? node : octree.children(node)[(slot & middle) | upper | (~slot & fixed)];
      }
      visit(part);
      if (upper == 0)
      {
        break;
      }
    }
    if (middle == 0)
    {
      break;
    }
  }
}

/// For each refined octant, whether all of its children are leaves.
std::vector<char> findParentsOfLeaves(const Octree& octree, const RunContext& context)
{
  std::vector<char> found(octree.refinedCount());
  context.executor.forEach(found.size(), 16384, [&](std::size_t node) {
    const auto& children = octree.children(static_cast<Octree::Node>(node));
    found[node] = std::all_of(children.begin(), children.end(), Octree::isLeaf);
  });
  return found;
}

/// Finds the points between octants.
class Walker
{
public:
  Walker(const Octree& tree, const std::vector<char>& parentsOfLeaves) : octree(tree), lowest(parentsOfLeaves) {}

  template <typename Visit> void walk(const Region& region, Visit&& visit) const
  {
    if (region.onlyLeaves())
    {
      if (region.extent == 0)
      {
        visit(region);
      }
    }
    else if (hasOnePoint(region))
    {
      visit(middleOf(region));
    }
    else
    {
      divide(octree, region, [&](const Region& part) { walk(part, visit); });
    }
  }

private:
  /// Whether all parts but the one in the middle are between leaves, and have an extent.
  bool hasOnePoint(const Region& region) const
  {
    return std::all_of(region.nodes.begin(), region.nodes.end(),
                       [&](Octree::Node node) { return Octree::isLeaf(node) || lowest[node] != 0; });
  }

  Region middleOf(const Region& region) const
  {
    Region part;
    part.extent = 0;
    for (unsigned slot = 0; slot < 8; ++slot)
    {
      const Octree::Node node = region.nodes[slot];
      part.nodes[slot] =
          Octree::isLeaf(node) ? node : octree.children(node)[(slot & region.extent) | (~slot & ~region.extent & 7u)];
    }
    return part;
  }

  const Octree& octree;
  const std::vector<char>& lowest;
};

/// Parts of the octree to walk independently.
std::vector<Region> tasksOf(const Octree& octree, int level)
{
  Region whole;
  whole.nodes.fill(octree.root());
  whole.extent = 7;
  std::vector<Region> tasks{whole};
  for (int l = 0; l < level; ++l)
  {
    std::vector<Region> next;
    for (const Region& task : tasks)
    {
      if (!task.onlyLeaves())
      {
        divide(octree, task, [&](const Region& part) { next.push_back(part); });
      }
      else if (task.extent == 0)
      {
        next.push_back(task);
      }
    }
    tasks = std::move(next);
  }
  return tasks;
}

/// Bits of the directions whose leaf fills no other direction: such a leaf has the grid point as a corner.
unsigned singleDirections(const std::array<Octree::Node, 8>& nodes)
{
  unsigned shared = 0;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    for (unsigned other = slot + 1; other < 8; ++other)
    {
      shared |= nodes[slot] == nodes[other] ? 1u << slot | 1u << other : 0u;
    }
  }
  return ~shared & 0xffu;
}

/// The first leaf that has the grid point as a corner.
struct Owner
{
  Index leaf = noIndex;
  unsigned corner = 0;
};

Owner ownerOf(const std::array<Octree::Node, 8>& nodes, unsigned singles)
{
  Owner owner;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    const Index leaf = Octree::leafOf(nodes[slot]);
    if ((singles >> slot & 1) != 0 && leaf < owner.leaf)
    {
      owner = {leaf, 7 - slot};
    }
  }
  return owner;
}

/// The directions on one side of a point, in order.
constexpr std::array<unsigned, 4> slotsAbout(int direction)
{
  const unsigned bit = 1u << axisOf(direction);
  std::array<unsigned, 4> slots{};
  for (unsigned slot = 0, i = 0; slot < 8; ++slot)
  {
    if (((slot & bit) != 0) == isUpper(direction))
    {
      slots[i++] = slot;
    }
  }
  return slots;
}

bool allDistinct(const std::array<Index, 8>& leaves, const std::array<unsigned, 4>& slots)
{
  const Index a = leaves[slots[0]], b = leaves[slots[1]], c = leaves[slots[2]], d = leaves[slots[3]];
  return a != b && a != c && a != d && b != c && b != d && c != d;
}

} // namespace

GridPoints findGridPoints(const Octree& octree, const RunContext& context)
{
  const GridFrame& frame = octree.frame();
  const std::vector<Region> tasks = tasksOf(octree, std::min(frame.startLevel, 4));
  const std::vector<char> parentsOfLeaves = findParentsOfLeaves(octree, context);
  const Walker walker(octree, parentsOfLeaves);
  std::vector<std::uint8_t> owned(octree.leafCount(), 0);
  const auto eachPoint = [&](auto&& visit) {
    context.executor.forEach(tasks.size(), 16, [&](std::size_t i) {
      context.progress.check();
      walker.walk(tasks[i], [&](const Region& point) {
        const unsigned singles = singleDirections(point.nodes);
        const Owner owner = ownerOf(point.nodes, singles);
        if (owner.leaf != noIndex && frame.inDomain(octree.cornerOf(owner.leaf, owner.corner)))
        {
          visit(point, owner, singles);
        }
      });
    });
  };
  eachPoint([&](const Region&, const Owner& owner, unsigned) {
    std::atomic_ref(owned[owner.leaf])
        .fetch_or(static_cast<std::uint8_t>(1u << owner.corner), std::memory_order_relaxed);
  });

  std::vector<Index> first(octree.leafCount() + 1, 0);
  for (std::size_t leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    first[leaf + 1] = first[leaf] + static_cast<Index>(std::popcount(owned[leaf]));
  }
  if (first.back() >= Index{1} << 31)
  {
    throw Error("the mesh would have more than 2^31 elements: raise the sizes or shrink the domain");
  }
  GridPoints points;
  points.leaves.resize(first.back());
  points.atCorner.resize(octree.leafCount());
  context.executor.forEach(points.atCorner.size(), 65536, [&](std::size_t i) { points.atCorner[i].fill(noIndex); });
  eachPoint([&](const Region& point, const Owner& owner, unsigned singles) {
    const unsigned before = owned[owner.leaf] & ((1u << owner.corner) - 1);
    const Index id = first[owner.leaf] + static_cast<Index>(std::popcount(before));
    for (unsigned slot = 0; slot < 8; ++slot)
    {
      const Index leaf = Octree::leafOf(point.nodes[slot]);
      points.leaves[id][slot] = leaf;
      if ((singles >> slot & 1) != 0)
      {
        points.atCorner[leaf][7 - slot] = id;
      }
    }
  });
  return points;
}

LatticePoint positionOf(const Octree& octree, const std::array<Index, 8>& leaves)
{
  unsigned slot = 0;
  while (slot < 7 && std::count(leaves.begin(), leaves.end(), leaves[slot]) > 1)
  {
    ++slot;
  }
  return octree.cornerOf(leaves[slot], 7 - slot);
}

GridEdge edgeFrom(const Octree& octree, const std::array<Index, 8>& leaves, int direction)
{
  const unsigned bit = 1u << axisOf(direction);
  GridEdge edge;
  int finest = -1;
  static constexpr std::array<std::array<unsigned, 4>, 6> about{slotsAbout(0), slotsAbout(1), slotsAbout(2),
                                                                slotsAbout(3), slotsAbout(4), slotsAbout(5)};
  if (const std::array<unsigned, 4>& slots = about[direction]; allDistinct(leaves, slots))
  {
    for (const unsigned slot : slots)
    {
      if (octree.level(leaves[slot]) > finest)
      {
        finest = octree.level(leaves[slot]);
        edge = {leaves[slot], 7 - slot};
      }
    }
    return edge;
  }
  int distinct = 0;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    if (((slot & bit) != 0) != isUpper(direction))
    {
      continue;
    }
    int same = 0;
    bool first = true;
    for (unsigned other = 0; other < 8; ++other)
    {
      if (((other & bit) != 0) == isUpper(direction) && leaves[other] == leaves[slot])
      {
        ++same;
        first = first && other >= slot;
      }
    }
    distinct += first ? 1 : 0;
    if (same == 1 && octree.level(leaves[slot]) > finest)
    {
      finest = octree.level(leaves[slot]);
      edge = {leaves[slot], 7 - slot};
    }
  }
  return distinct >= 3 ? edge : GridEdge{};
}

} // namespace atria
