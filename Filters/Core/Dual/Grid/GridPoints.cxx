// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Grid/GridPoints.h"

#include "Support/Error.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <atomic>

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

/// Returns for each refined octant by how many levels all leaves in it are finer; 0 if they are of several levels.
std::vector<std::uint8_t> findUniformDepths(const Octree& octree)
{
  std::vector<std::uint8_t> depths(octree.refinedCount());
  const auto depthOf = [&](Octree::Node node) { return Octree::isLeaf(node) ? 0 : depths[node]; };
  const auto isMixed = [&](Octree::Node node) { return !Octree::isLeaf(node) && depths[node] == 0; };
  // Children come after their parents.
  for (std::size_t node = depths.size(); node-- > 0;)
  {
    const auto& children = octree.children(static_cast<Octree::Node>(node));
    const int depth = depthOf(children[0]);
    const bool uniform =
        !isMixed(children[0]) && std::all_of(children.begin() + 1, children.end(),
                                             [&](Octree::Node c) { return depthOf(c) == depth && !isMixed(c); });
    depths[node] = static_cast<std::uint8_t>(uniform ? depth + 1 : 0);
  }
  return depths;
}

/// A grid point as the walk finds it.
struct FoundPoint
{
  std::array<Index, 8> leaves;
  /// Bits of the directions whose leaf fills no other direction: such a leaf has the point as a corner.
  unsigned singles;
  /// The first leaf that has it as a corner, and which corner it is.
  Index owner;
  unsigned ownersCorner;
};

/// Points, inside the domain, of a region all of whose leaves are of one level. Leaves then follow from their places in
/// the octants' grids: no search is needed.
class UniformBlock
{
public:
  /// Regions of deeper octants are divided first: what the points of a block share stays in the cache.
  static constexpr int maximumDepth = 4;

  UniformBlock(const Octree& octree, const Region& region, int depth) : size(1u << depth)
  {
    for (unsigned slot = 0; slot < 8; ++slot)
    {
      bases[slot] = firstLeafOf(octree, region.nodes[slot]);
    }
    const GridFrame& frame = octree.frame();
    const LatticePoint low = octree.lowCorner(bases[0]);
    const std::int64_t step = frame.latticeSize(octree.level(bases[0]));
    for (int axis = 0; axis < 3; ++axis)
    {
      // Along an axis without an extent the only point is at the upper end of the lower octant.
      begin[axis] = (region.extent >> axis & 1) != 0 ? 1 : size;
      end[axis] = (region.extent >> axis & 1) != 0 ? size : size + 1;
      const auto at = [&](unsigned i) { return low[axis] + step * static_cast<std::int64_t>(i); };
      for (; begin[axis] < end[axis] && at(begin[axis]) <= frame.domainLow[axis]; ++begin[axis])
      {
      }
      for (; begin[axis] < end[axis] && at(end[axis] - 1) >= frame.domainHigh[axis]; --end[axis])
      {
      }
    }
  }

  template <typename Visit> void eachPoint(Visit&& visit) const
  {
    FoundPoint point;
    point.singles = 0xffu;
    point.ownersCorner = 7;
    for (unsigned z = begin[2]; z < end[2]; ++z)
    {
      for (unsigned y = begin[1]; y < end[1]; ++y)
      {
        for (unsigned x = begin[0]; x < end[0]; ++x)
        {
          for (unsigned slot = 0; slot < 8; ++slot)
          {
            point.leaves[slot] =
                bases[slot] + place(x, slot & 1) + 2 * place(y, slot >> 1 & 1) + 4 * place(z, slot >> 2);
          }
          point.owner = point.leaves[0];
          visit(point);
        }
      }
    }
  }

private:
  static Index firstLeafOf(const Octree& octree, Octree::Node node)
  {
    while (!Octree::isLeaf(node))
    {
      node = octree.children(node)[0];
    }
    return Octree::leafOf(node);
  }

  /// Returns what the leaf below or above point i along an axis adds to a Morton key.
  Index place(unsigned i, unsigned above) const
  {
    static constexpr std::array<std::uint16_t, 1u << maximumDepth> spread{
        00, 01, 010, 011, 0100, 0101, 0110, 0111, 01000, 01001, 01010, 01011, 01100, 01101, 01110, 01111};
    return spread[(i - 1 + above) & (size - 1)];
  }

  unsigned size;
  std::array<Index, 8> bases;
  std::array<unsigned, 3> begin;
  std::array<unsigned, 3> end;
};

/// Returns the bits of the directions whose leaf fills no other direction.
unsigned singleDirections(const std::array<Index, 8>& leaves)
{
  unsigned shared = 0;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    for (unsigned other = slot + 1; other < 8; ++other)
    {
      shared |= leaves[slot] == leaves[other] ? 1u << slot | 1u << other : 0u;
    }
  }
  return ~shared & 0xffu;
}

FoundPoint pointBetween(const std::array<Octree::Node, 8>& nodes)
{
  FoundPoint point;
  std::transform(nodes.begin(), nodes.end(), point.leaves.begin(), Octree::leafOf);
  point.singles = singleDirections(point.leaves);
  point.owner = noIndex;
  point.ownersCorner = 0;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    if ((point.singles >> slot & 1) != 0 && point.leaves[slot] < point.owner)
    {
      point.owner = point.leaves[slot];
      point.ownersCorner = 7 - slot;
    }
  }
  return point;
}

/// Finds the points between octants.
class Walker
{
public:
  explicit Walker(const Octree& tree) : octree(tree), depths(findUniformDepths(tree)) {}

  /// Calls visit(FoundPoint) for the points of a region that are inside the domain.
  template <typename Visit> void walk(const Region& region, Visit&& visit) const
  {
    if (region.onlyLeaves())
    {
      if (region.extent == 0)
      {
        visitIfInside(region.nodes, visit);
      }
    }
    else if (const int depth = commonDepth(region); depth > 0)
    {
      UniformBlock(octree, region, depth).eachPoint(visit);
    }
    else if (hasOnePoint(region))
    {
      visitIfInside(middleOf(region), visit);
    }
    else
    {
      divide(octree, region, [&](const Region& part) { walk(part, visit); });
    }
  }

private:
  template <typename Visit> void visitIfInside(const std::array<Octree::Node, 8>& nodes, Visit&& visit) const
  {
    const FoundPoint point = pointBetween(nodes);
    if (point.owner != noIndex && octree.frame().inDomain(octree.cornerOf(point.owner, point.ownersCorner)))
    {
      visit(point);
    }
  }

  /// Returns the number of levels by which all leaves in a region are finer than its octants; 0 if it is no uniform
  /// block.
  int commonDepth(const Region& region) const
  {
    const int depth = Octree::isLeaf(region.nodes[0]) ? 0 : depths[region.nodes[0]];
    const bool common = depth <= UniformBlock::maximumDepth &&
                        std::all_of(region.nodes.begin() + 1, region.nodes.end(),
                                    [&](Octree::Node node) { return !Octree::isLeaf(node) && depths[node] == depth; });
    return common ? depth : 0;
  }

  /// True if only the middle of a region can be a point: its octants are leaves, or have only leaves as children.
  bool hasOnePoint(const Region& region) const
  {
    return std::all_of(region.nodes.begin(), region.nodes.end(),
                       [&](Octree::Node node) { return Octree::isLeaf(node) || depths[node] == 1; });
  }

  std::array<Octree::Node, 8> middleOf(const Region& region) const
  {
    std::array<Octree::Node, 8> middle;
    for (unsigned slot = 0; slot < 8; ++slot)
    {
      const Octree::Node node = region.nodes[slot];
      middle[slot] =
          Octree::isLeaf(node) ? node : octree.children(node)[(slot & region.extent) | (~slot & ~region.extent & 7u)];
    }
    return middle;
  }

  const Octree& octree;
  std::vector<std::uint8_t> depths;
};

/// Returns parts of the octree to walk independently.
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

/// Counts the bits set among the eight lowest. std::popcount is a function call if the processor need not have an
/// instruction for it.
Index bitsIn(unsigned bits)
{
  bits = (bits & 0x55u) + (bits >> 1 & 0x55u);
  bits = (bits & 0x33u) + (bits >> 2 & 0x33u);
  return (bits & 0xfu) + (bits >> 4);
}

/// Returns the first point of each leaf, from the bits of the points it owns. Makes room for all points.
Buffer<Index> firstPoints(const std::vector<std::uint8_t>& owned, GridPoints& points, const RunContext& context)
{
  const Pieces pieces(owned.size());
  std::vector<std::uint64_t> begins(pieces.count, 0);
  context.executor.forEach(pieces.count, 16, [&](std::size_t piece) {
    for (std::size_t leaf = pieces.begin(piece); leaf < pieces.end(piece); ++leaf)
    {
      begins[piece] += bitsIn(owned[leaf]);
    }
  });
  const std::uint64_t count = scan(begins);
  if (count >= std::uint64_t{1} << 31)
  {
    throw Error("the mesh would have more than 2^31 elements: raise the sizes or shrink the domain");
  }
  points.leaves.resize(count);
  Buffer<Index> first(owned.size());
  context.executor.forEach(pieces.count, 16, [&](std::size_t piece) {
    auto next = static_cast<Index>(begins[piece]);
    for (std::size_t leaf = pieces.begin(piece); leaf < pieces.end(piece); ++leaf)
    {
      first[leaf] = next;
      next += bitsIn(owned[leaf]);
    }
  });
  return first;
}

/// Returns the directions on one side of a point, in order.
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
  const std::vector<Region> tasks = tasksOf(octree, std::min(octree.frame().startLevel, 4));
  const Walker walker(octree);
  const auto eachPoint = [&](auto&& visit) {
    context.executor.forEach(tasks.size(), 16, [&](std::size_t i) {
      context.progress.check();
      walker.walk(tasks[i], visit);
    });
  };
  std::vector<std::uint8_t> owned(octree.leafCount(), 0);
  eachPoint([&](const FoundPoint& point) {
    std::atomic_ref(owned[point.owner])
        .fetch_or(static_cast<std::uint8_t>(1u << point.ownersCorner), std::memory_order_relaxed);
  });
  GridPoints points;
  const Buffer<Index> first = firstPoints(owned, points, context);
  points.atCorner.resize(octree.leafCount());
  context.executor.forEach(points.atCorner.size(), 65536, [&](std::size_t i) { points.atCorner[i].fill(noIndex); });
  eachPoint([&](const FoundPoint& point) {
    const unsigned before = owned[point.owner] & ((1u << point.ownersCorner) - 1);
    const Index id = first[point.owner] + bitsIn(before);
    points.leaves[id] = point.leaves;
    for (unsigned slot = 0; slot < 8; ++slot)
    {
      if ((point.singles >> slot & 1) != 0)
      {
        points.atCorner[point.leaves[slot]][7 - slot] = id;
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

bool areOfOneLevel(const Octree& octree, const std::array<Index, 8>& leaves)
{
  // A leaf that fills several directions fills two beside each other.
  bool repeated = false;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    for (unsigned bit = 1; bit < 8; bit <<= 1)
    {
      repeated |= (slot & bit) == 0 && leaves[slot] == leaves[slot | bit];
    }
  }
  const int level = octree.level(leaves[0]);
  bool same = !repeated;
  for (unsigned slot = 1; slot < 8 && same; ++slot)
  {
    same = octree.level(leaves[slot]) == level;
  }
  return same;
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
