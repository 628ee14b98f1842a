// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/LeafRows.h"

#include "Octree/Tree/GeometryLists.h"
#include "Support/Error.h"

#include <algorithm>
#include <bit>
#include <functional>

namespace atria {

namespace {

constexpr Index leafBit = 0x80000000u;
constexpr Index leafNode(Index parent, unsigned child) { return leafBit | parent << 3 | child; }
constexpr bool isLeaf(Index node) { return (node & leafBit) != 0; }
constexpr Index parentOf(Index leaf) { return (leaf & ~leafBit) >> 3; }
constexpr unsigned bitOf(Index leaf) { return 1u << (leaf & 7); }

constexpr int directions = 27;
constexpr int middle = 13;
/// Returns the step of a direction along an axis: -1, 0 or 1.
constexpr int stepAlong(int axis, int direction) { return direction / (axis == 0 ? 1 : axis == 1 ? 3 : 9) % 3 - 1; }
constexpr int placeAlong(int axis, unsigned child) { return static_cast<int>(child >> axis & 1); }

/// Returns the direction in which a child of an octant touches the child `other` of the octant in a direction (or of
/// itself); -1 if they do not touch.
constexpr int directionTo(unsigned child, int direction, unsigned other)
{
  int found = 0;
  for (int axis = 2; axis >= 0; --axis)
  {
    const int step = 2 * stepAlong(axis, direction) + placeAlong(axis, other) - placeAlong(axis, child);
    if (step < -1 || step > 1)
    {
      return -1;
    }
    found = 3 * found + step + 1;
  }
  return found;
}

/// Indexed by direction and by bits of an octant's children. An entry has the bits of the children of the octant in
/// that direction that touch one of these.
using TouchTable = std::array<std::array<std::uint8_t, 256>, directions>;

TouchTable makeTouchTable()
{
  TouchTable table{};
  for (int direction = 0; direction < directions; ++direction)
  {
    for (unsigned pair = 0; pair < 64; ++pair)
    {
      for (unsigned children = 0; directionTo(pair & 7, direction, pair >> 3) >= 0 && children < 256; ++children)
      {
        table[direction][children] |= (children >> (pair & 7) & 1) << (pair >> 3);
      }
    }
  }
  return table;
}

const TouchTable touching = makeTouchTable();

/// Position of the octant beside a child: direction from the parent to the octant that holds it, and its number among
/// that one's children.
struct Beside
{
  int direction;
  unsigned child;
};

constexpr Beside besideOf(unsigned child, int direction)
{
  Beside beside{0, 0};
  for (int axis = 2; axis >= 0; --axis)
  {
    const int place = placeAlong(axis, child) + stepAlong(axis, direction);
    beside.direction = 3 * beside.direction + (place < 0 ? 0 : place > 1 ? 2 : 1);
    beside.child = beside.child << 1 | (static_cast<unsigned>(place) & 1);
  }
  return beside;
}

std::array<std::array<Beside, directions>, 8> makeBesideTable()
{
  std::array<std::array<Beside, directions>, 8> table{};
  for (unsigned child = 0; child < 8; ++child)
  {
    for (int direction = 0; direction < directions; ++direction)
    {
      table[child][direction] = besideOf(child, direction);
    }
  }
  return table;
}

const std::array<std::array<Beside, directions>, 8> besides = makeBesideTable();

unsigned childrenInDomain(const GridFrame& frame, int level, MortonKey key)
{
  unsigned bits = 0;
  for (unsigned k = 0; k < 8; ++k)
  {
    bits |= domainBoxOf(frame, level + 1, key << 3 | k).empty() ? 0u : 1u << k;
  }
  return bits;
}

} // namespace

/// Marks leaves that hold pieces of the model, or sides of the domain if these count.
class LeafRows::SurfaceDescent
{
public:
  SurfaceDescent(const SurfaceModel& model, const LeafRows& rows, bool sides)
      : rows_(rows), dividers_(rows.frame_.depth, PieceDivider(model, rows.frame_)), sides_(sides),
        marks_(rows.octants_.size(), 0)
  {
  }

  void descend(Index octant, int level, MortonKey key, std::span<const ModelItem> pieces)
  {
    dividers_[level].divide(level, key, pieces, [&](unsigned k, const LatticeBox&, std::span<const ModelItem> some) {
      const Node child = rows_.childOf(octant, k);
      if (some.empty() && (!sides_ || !hasSide(level + 1, key << 3 | k)))
      {
        return;
      }
      if (isLeaf(child))
      {
        marks_[octant] |= 1u << k;
      }
      else
      {
        descend(child, level + 1, key << 3 | k, some);
      }
    });
  }

  LeafMasks take() { return std::move(marks_); }

private:
  bool hasSide(int level, MortonKey key) const
  {
    const GridCell cell = gridCell(key);
    const std::int64_t size = rows_.frame_.latticeSize(level);
    LatticePoint low;
    LatticePoint high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = cell[axis] * size;
      high[axis] = low[axis] + size;
    }
    return rows_.frame_.domainPlanes(low, high) != 0;
  }

  const LeafRows& rows_;
  std::vector<PieceDivider> dividers_; ///< one per level
  bool sides_;
  LeafMasks marks_;
};

/// Finds the octants around others from the root down: neighbors of a child are children of its parent's neighbors.
/// Keeps the neighbors of the last octant of each level, as consecutive octants are near each other.
class LeafRows::NeighborFinder
{
public:
  explicit NeighborFinder(const LeafRows& rows) : rows_(rows), last_(rows.levels_.size())
  {
    last_[0].octant = 0;
    last_[0].neighbors.fill(noIndex);
    last_[0].neighbors[middle] = 0;
  }

  const Neighbors& of(Index octant)
  {
    return of(octant,
              static_cast<std::size_t>(std::ranges::upper_bound(rows_.levels_, octant) - rows_.levels_.begin()) - 1);
  }

private:
  struct Known
  {
    Index octant = noIndex;
    Neighbors neighbors;
  };

  const Neighbors& of(Index octant, std::size_t level)
  {
    Known& known = last_[level];
    if (known.octant != octant)
    {
      const Index place = rows_.octants_[octant].place;
      const Neighbors& above = of(place >> 3, level - 1);
      for (int direction = 0; direction < directions; ++direction)
      {
        const Beside& beside = besides[place & 7][direction];
        const Node node = above[beside.direction];
        known.neighbors[direction] = isLeaf(node) ? node : rows_.childOf(node, beside.child);
      }
      known.octant = octant;
    }
    return known.neighbors;
  }

  const LeafRows& rows_;
  std::vector<Known> last_; ///< one per level
};

LeafRows::LeafRows(const RefinedSets& refined, const GridFrame& frame) : refined_(refined), frame_(frame)
{
  std::size_t count = 0;
  std::ranges::for_each(refined_, [&](const std::vector<MortonKey>& level) { count += level.size(); });
  if (count >= (leafBit >> 3))
  {
    throw Error("the octree has 2^28 refined octants or more: raise the sizes or shrink the domain");
  }
  octants_.reserve(count);
  all_.reserve(count);
  inDomain_.reserve(count);
  link();
}

void LeafRows::link()
{
  octants_.push_back({0, noIndex});
  for (std::size_t level = 0; level < refined_.size(); ++level)
  {
    const bool isLast = level + 1 == refined_.size();
    const std::span<const MortonKey> next = isLast ? std::span<const MortonKey>() : std::span(refined_[level + 1]);
    levels_.push_back(static_cast<Index>(all_.size()));
    std::size_t j = 0;
    for (const MortonKey key : refined_[level])
    {
      const auto octant = static_cast<Index>(all_.size());
      octants_[octant].firstRefined = static_cast<Index>(octants_.size());
      unsigned leaves = 0xff;
      for (; j < next.size() && next[j] >> 3 == key; ++j)
      {
        const auto child = static_cast<unsigned>(next[j] & 7);
        octants_.push_back({octant << 3 | child, noIndex});
        leaves &= ~(1u << child);
      }
      all_.push_back(static_cast<std::uint8_t>(leaves));
      inDomain_.push_back(static_cast<std::uint8_t>(leaves & childrenInDomain(frame_, static_cast<int>(level), key)));
    }
  }
}

LeafRows::Node LeafRows::childOf(Index octant, unsigned child) const
{
  const unsigned refined = ~unsigned{all_[octant]};
  const unsigned before = refined & ((1u << child) - 1);
  return (refined >> child & 1) != 0 ? octants_[octant].firstRefined + static_cast<Index>(std::popcount(before))
                                     : leafNode(octant, child);
}

/// Calls visit(octant, k, key) for the children of all octants, with their keys in the finest grid.
template <typename Visit> void LeafRows::eachChild(Visit&& visit) const
{
  std::size_t octant = 0;
  for (std::size_t level = 0; level < refined_.size(); ++level)
  {
    const int shift = 3 * (frame_.depth - static_cast<int>(level) - 1);
    for (const MortonKey key : refined_[level])
    {
      for (unsigned k = 0; k < 8; ++k)
      {
        visit(octant, k, (key << 3 | k) << shift);
      }
      ++octant;
    }
  }
}

LeafMasks LeafRows::in(const MortonRange& range) const
{
  LeafMasks leaves(all_.size(), 0);
  eachChild([&](std::size_t octant, unsigned k, MortonKey key) {
    leaves[octant] |= key >= range.begin && key < range.end ? all_[octant] & 1u << k : 0u;
  });
  return leaves;
}

LeafMasks LeafRows::of(const std::vector<MortonKey>& leaves) const
{
  LeafMasks masks(all_.size(), 0);
  for (const MortonKey key : leaves)
  {
    Node node = 0;
    for (int shift = 3 * (frame_.depth - 1); !isLeaf(node); shift -= 3)
    {
      node = childOf(node, static_cast<unsigned>(key >> shift & 7));
    }
    masks[parentOf(node)] |= bitOf(node);
  }
  return masks;
}

std::vector<std::size_t> LeafRows::countBetween(const std::vector<MortonKey>& begins, const LeafMasks& leaves) const
{
  std::vector<std::size_t> counts(begins.size() - 1, 0);
  eachChild([&](std::size_t octant, unsigned k, MortonKey key) {
    if ((leaves[octant] >> k & 1) != 0)
    {
      ++counts[static_cast<std::size_t>(std::ranges::upper_bound(begins, key) - begins.begin()) - 1];
    }
  });
  return counts;
}

LeafMasks LeafRows::marked(const SurfaceModel& model, bool sides, const RunContext& context) const
{
  context.progress.check();
  SurfaceDescent descent(model, *this, sides);
  descent.descend(0, 0, 0, rootLists(model, frame_).items);
  return descent.take();
}

/// Calls visit(octant, bits) for leaves within refined children of the octant in a direction.
template <typename Visit>
void LeafRows::eachFiner(unsigned children, int direction, Index octant, unsigned touched, Visit&& visit) const
{
  for (unsigned k = 0; k < 8; ++k)
  {
    unsigned bits = 0;
    for (unsigned child = 0; (touched >> k & 1) != 0 && child < 8; ++child)
    {
      const int to = directionTo(child, direction, k);
      bits |= (children >> child & 1) != 0 && to >= 0 ? touching[to][0xff] : 0u;
    }
    if (bits != 0)
    {
      visit(childOf(octant, k), bits);
    }
  }
}

/// Calls visit(octant, bits) for leaves that touch some children of an octant with these neighbors. Bits may also be of
/// octants that are no leaves.
template <typename Visit>
void LeafRows::eachTouching(unsigned children, const Neighbors& neighbors, Visit&& visit) const
{
  for (int direction = 0; direction < directions; ++direction)
  {
    const unsigned touched = touching[direction][children];
    const Node node = neighbors[direction];
    if (touched == 0 || node == noIndex)
    {
      continue;
    }
    if (isLeaf(node))
    {
      visit(parentOf(node), bitOf(node));
      continue;
    }
    visit(node, touched);
    if (const unsigned finer = touched & ~all_[node]; finer != 0)
    {
      eachFiner(children, direction, node, finer, visit);
    }
  }
}

LeafMasks LeafRows::grow(LeafMasks leaves, int rows, const LeafMasks& within) const
{
  std::vector<Index> front;
  LeafMasks added = leaves;
  for (Index octant = 0; octant < leaves.size(); ++octant)
  {
    if (leaves[octant] != 0)
    {
      front.push_back(octant);
    }
  }
  LeafMasks next(leaves.size(), 0);
  NeighborFinder finder(*this);
  for (int row = 0; row < rows; ++row)
  {
    std::vector<Index> nextFront;
    const auto add = [&](Index octant, unsigned bits) {
      if (const unsigned more = bits & within[octant] & ~leaves[octant]; more != 0)
      {
        if (next[octant] == 0)
        {
          nextFront.push_back(octant);
        }
        leaves[octant] |= more;
        next[octant] |= more;
      }
    };
    for (const Index octant : front)
    {
      eachTouching(added[octant], finder.of(octant), add);
      added[octant] = 0;
    }
    std::swap(added, next);
    front = std::move(nextFront);
  }
  return leaves;
}

RefinedSets LeafRows::setsOf(const LeafMasks& leaves) const
{
  std::vector<char> kept(leaves.size());
  for (std::size_t octant = leaves.size(); octant-- > 0;)
  {
    const auto refined = kept.begin() + octants_[octant].firstRefined;
    const bool hasKept = std::any_of(refined, refined + std::popcount(0xffu & ~all_[octant]), std::identity());
    kept[octant] = leaves[octant] != 0 || hasKept ? 1 : 0;
  }
  RefinedSets sets(refined_.size());
  std::size_t octant = 0;
  for (std::size_t level = 0; level < refined_.size(); ++level)
  {
    for (const MortonKey key : refined_[level])
    {
      if (kept[octant++] != 0 || static_cast<int>(level) < frame_.startLevel)
      {
        sets[level].push_back(key);
      }
    }
  }
  return sets;
}

} // namespace atria
