// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/LeafRows.h"

#include "Octree/Tree/GeometryLists.h"
#include "Support/Error.h"

#include <algorithm>

namespace atria {

namespace {

constexpr Index leafBit = 0x80000000u;
constexpr Index leafNode(Index parent, unsigned child) { return leafBit | parent << 3 | child; }
constexpr bool isLeaf(Index node) { return (node & leafBit) != 0; }
constexpr Index parentOf(Index leaf) { return (leaf & ~leafBit) >> 3; }
constexpr unsigned bitOf(Index leaf) { return 1u << (leaf & 7); }

constexpr int directions = 27;
constexpr int middle = 13;
/// Along an axis: -1, 0 or 1.
constexpr int stepAlong(int axis, int direction) { return direction / (axis == 0 ? 1 : axis == 1 ? 3 : 9) % 3 - 1; }
constexpr int placeAlong(int axis, unsigned child) { return static_cast<int>(child >> axis & 1); }

/// From a child of an octant to another one of the octant in a direction, or of itself: the direction in which that one
/// touches, or -1.
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

/// By direction and bits of an octant's children, bits of those of the octant there that touch one of them.
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

/// Where the octant beside a child is: in an octant beside the parent, and which child of it.
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

unsigned childrenInDomain(const GridFrame& frame, int level, MortonKey key)
{
  unsigned bits = 0;
  for (unsigned k = 0; k < 8; ++k)
  {
    bits |= domainBoxOf(frame, level + 1, key << 3 | k).empty() ? 0u : 1u << k;
  }
  return bits;
}

/// Marks leaves that hold pieces of the model or sides of the domain.
class SurfaceDescent
{
public:
  SurfaceDescent(const SurfaceModel& model, const GridFrame& frame, const std::vector<std::array<Index, 8>>& children)
      : frame_(frame), children_(children), dividers_(frame.depth, PieceDivider(model, frame)),
        marks_(children.size(), 0)
  {
  }

  void descend(Index octant, int level, MortonKey key, std::span<const ModelItem> pieces)
  {
    dividers_[level].divide(level, key, pieces, [&](unsigned k, const LatticeBox&, std::span<const ModelItem> some) {
      const Index child = children_[octant][k];
      if (some.empty() && !hasSide(level + 1, key << 3 | k))
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
    const std::int64_t size = frame_.latticeSize(level);
    LatticePoint low;
    LatticePoint high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = cell[axis] * size;
      high[axis] = low[axis] + size;
    }
    return frame_.domainPlanes(low, high) != 0;
  }

  const GridFrame& frame_;
  const std::vector<std::array<Index, 8>>& children_;
  std::vector<PieceDivider> dividers_; ///< by level
  LeafMasks marks_;
};

} // namespace

LeafRows::LeafRows(const RefinedSets& refined, const GridFrame& frame) : refined_(refined), frame_(frame)
{
  std::size_t count = 0;
  std::ranges::for_each(refined_, [&](const std::vector<MortonKey>& level) { count += level.size(); });
  if (count >= (leafBit >> 3))
  {
    throw Error("the octree has 2^28 refined octants or more: raise the sizes or shrink the domain");
  }
  link();
  findNeighbors();
}

void LeafRows::link()
{
  for (std::size_t level = 0; level < refined_.size(); ++level)
  {
    const bool isLast = level + 1 == refined_.size();
    const std::span<const MortonKey> next = isLast ? std::span<const MortonKey>() : std::span(refined_[level + 1]);
    const Index nextBegin = static_cast<Index>(children_.size() + refined_[level].size());
    Index j = 0;
    for (const MortonKey key : refined_[level])
    {
      const auto octant = static_cast<Index>(children_.size());
      std::array<Node, 8>& family = children_.emplace_back();
      unsigned leaves = 0;
      for (unsigned k = 0; k < 8; ++k)
      {
        const bool isRefined = j < next.size() && next[j] == (key << 3 | k);
        family[k] = isRefined ? nextBegin + j++ : leafNode(octant, k);
        leaves |= isRefined ? 0u : 1u << k;
      }
      all_.push_back(static_cast<std::uint8_t>(leaves));
      inDomain_.push_back(static_cast<std::uint8_t>(leaves & childrenInDomain(frame_, static_cast<int>(level), key)));
    }
  }
}

/// From the root down: what is beside a child is a child of what is beside its parent.
void LeafRows::findNeighbors()
{
  const auto table = makeBesideTable();
  neighbors_.resize(children_.size());
  neighbors_[0].fill(noIndex);
  neighbors_[0][middle] = 0;
  for (Index octant = 0; octant < children_.size(); ++octant)
  {
    for (unsigned k = 0; k < 8; ++k)
    {
      const Node child = children_[octant][k];
      for (int direction = 0; !isLeaf(child) && direction < directions; ++direction)
      {
        const Beside& beside = table[k][direction];
        const Node node = neighbors_[octant][beside.direction];
        neighbors_[child][direction] = isLeaf(node) ? node : children_[node][beside.child];
      }
    }
  }
}

LeafMasks LeafRows::in(const MortonRange& range) const
{
  LeafMasks leaves(all_.size(), 0);
  std::size_t octant = 0;
  for (std::size_t level = 0; level < refined_.size(); ++level)
  {
    const int shift = 3 * (frame_.depth - static_cast<int>(level) - 1);
    for (const MortonKey key : refined_[level])
    {
      for (unsigned k = 0; k < 8; ++k)
      {
        const MortonKey first = (key << 3 | k) << shift;
        leaves[octant] |= first >= range.begin && first < range.end ? 1u << k : 0u;
      }
      leaves[octant] &= all_[octant];
      ++octant;
    }
  }
  return leaves;
}

LeafMasks LeafRows::withSurfaces(const SurfaceModel& model, const RunContext& context) const
{
  context.progress.check();
  SurfaceDescent descent(model, frame_, children_);
  descent.descend(0, 0, 0, rootLists(model, frame_).items);
  return descent.take();
}

/// The smaller leaves within children of an octant in a direction.
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
      visit(children_[octant][k], bits);
    }
  }
}

/// Calls visit(octant, bits) for leaves that touch some children of an octant; among them may be octants that are no
/// leaves.
template <typename Visit> void LeafRows::eachTouching(Index octant, unsigned children, Visit&& visit) const
{
  for (int direction = 0; direction < directions; ++direction)
  {
    const unsigned touched = touching[direction][children];
    const Node node = neighbors_[octant][direction];
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
      eachTouching(octant, added[octant], add);
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
    const auto isKept = [&](Node child) { return !isLeaf(child) && kept[child] != 0; };
    kept[octant] = leaves[octant] != 0 || std::ranges::any_of(children_[octant], isKept) ? 1 : 0;
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
