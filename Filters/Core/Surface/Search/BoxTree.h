// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds all boxes that touch a given one.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Search/BoxPairs.h"

#include <bit>
#include <limits>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace atria {

/// A tree of boxes. Boxes of about one size (each size is four times the one before) are sorted by the Morton keys of
/// their centers, and every eight in a row form one box of the level above. Long boxes thus do not spoil the hierarchy
/// of small ones. O(n log n) to build, on all threads.
class BoxTree
{
public:
  BoxTree(std::vector<NumberedBox> boxes, const RunContext& context);

  /// Number of boxes. Places number them in the tree's order.
  std::size_t size() const { return boxes_.size(); }
  const NumberedBox& box(std::size_t place) const { return boxes_[place]; }

  /// Calls visit(place) for each box from the place `first` on that touches this one.
  template <typename Visit> void eachTouching(const LatticeBox& box, std::size_t first, Visit&& visit) const
  {
    const Query query(*this, box);
    for (const Hierarchy& hierarchy : hierarchies_)
    {
      if (hierarchy.end > first)
      {
        search(hierarchy, query, first, visit);
      }
    }
  }

private:
  static constexpr std::size_t width = 8;

  /// The boxes of eight children, rounded outwards.
  struct Group
  {
    std::array<std::array<float, width>, 3> low;
    std::array<std::array<float, width>, 3> high;
  };

  /// The boxes of one size: places [begin, end). The groups of a level follow each other in `groups_`.
  struct Hierarchy
  {
    std::size_t begin;
    std::size_t end;
    std::vector<std::size_t> levels;
  };

  struct Query
  {
    Query(const BoxTree& tree, const LatticeBox& of);

    const LatticeBox& box;
    std::array<float, 3> low;
    std::array<float, 3> high;
  };

  struct Step
  {
    std::size_t level;
    std::size_t group;
  };

  /// Returns bits of the children that touch, or nearly do.
  static unsigned touching(const Group& group, const Query& query)
  {
    unsigned bits = 0;
#ifdef __SSE2__
    for (std::size_t first = 0; first < width; first += 4)
    {
      const auto test = [&](int axis) {
        const __m128 low = _mm_loadu_ps(group.low[axis].data() + first);
        const __m128 high = _mm_loadu_ps(group.high[axis].data() + first);
        return _mm_and_ps(_mm_cmple_ps(low, _mm_set1_ps(query.high[axis])),
                          _mm_cmpge_ps(high, _mm_set1_ps(query.low[axis])));
      };
      const __m128 hits = _mm_and_ps(_mm_and_ps(test(0), test(1)), test(2));
      bits |= static_cast<unsigned>(_mm_movemask_ps(hits)) << first;
    }
#else
    for (std::size_t i = 0; i < width; ++i)
    {
      bool hit = true;
      for (int axis = 0; axis < 3; ++axis)
      {
        hit &= group.low[axis][i] <= query.high[axis] && group.high[axis][i] >= query.low[axis];
      }
      bits |= static_cast<unsigned>(hit) << i;
    }
#endif
    return bits;
  }

  template <typename Visit>
  void search(const Hierarchy& hierarchy, const Query& query, std::size_t first, Visit&& visit) const
  {
    // At most seven groups of each level wait at a time, besides those of the level below.
    std::array<Step, width * 16> open;
    std::size_t count = 0;
    open[count++] = {hierarchy.levels.size() - 1, 0};
    while (count > 0)
    {
      const Step step = open[--count];
      unsigned bits = touching(groups_[hierarchy.levels[step.level] + step.group], query);
      while (bits != 0)
      {
        const auto i = static_cast<unsigned>(std::bit_width(bits) - 1); // the last one first
        bits ^= 1u << i;
        const std::size_t child = step.group * width + i;
        if (step.level > 0)
        {
          if (hierarchy.begin + ((child + 1) << (3 * step.level)) > first)
          {
            open[count++] = {step.level - 1, child};
          }
        }
        else if (hierarchy.begin + child >= first && overlap(boxes_[hierarchy.begin + child], query.box))
        {
          visit(hierarchy.begin + child);
        }
      }
    }
  }

  void sortBoxes(std::vector<NumberedBox> boxes, const RunContext& context);
  void addHierarchy(std::size_t begin, std::size_t end, const RunContext& context);

  LatticePoint origin_{};
  std::vector<NumberedBox> boxes_;
  std::vector<Hierarchy> hierarchies_;
  std::vector<Group> groups_;
};

} // namespace atria
