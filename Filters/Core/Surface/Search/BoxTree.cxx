// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Search/BoxTree.h"

#include "Grid/Morton.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace atria {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Relative margin for rounding to a float, never less than the error.
constexpr float rounding = std::numeric_limits<float>::epsilon();

float below(std::int64_t value)
{
  const auto rounded = static_cast<float>(value);
  return rounded - rounding * std::abs(rounded);
}

float above(std::int64_t value)
{
  const auto rounded = static_cast<float>(value);
  return rounded + rounding * std::abs(rounded);
}

/// Sorts boxes by size and then by place; no two keys are the same.
struct SortKey
{
  std::uint64_t key;
  Index box;
  friend auto operator<=>(const SortKey&, const SortKey&) = default;
};

/// Returns the size class of a box. Sizes are powers of four.
unsigned sizeClassOf(const LatticeBox& box)
{
  std::uint64_t length = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    length = std::max(length, static_cast<std::uint64_t>(box.high[axis] - box.low[axis]));
  }
  return static_cast<unsigned>(std::bit_width(length) + 1) / 2;
}

} // namespace

BoxTree::Query::Query(const BoxTree& tree, const LatticeBox& of) : box(of)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = below(of.low[axis] - tree.origin_[axis]);
    high[axis] = above(of.high[axis] - tree.origin_[axis]);
  }
}

BoxTree::BoxTree(std::vector<NumberedBox> boxes, const RunContext& context)
{
  if (boxes.empty())
  {
    return;
  }
  sortBoxes(std::move(boxes), context);
  for (std::size_t begin = 0, end = 0; begin < boxes_.size(); begin = end)
  {
    const unsigned size = sizeClassOf(boxes_[begin]);
    end =
        static_cast<std::size_t>(std::partition_point(boxes_.begin() + static_cast<std::ptrdiff_t>(begin), boxes_.end(),
                                                      [&](const LatticeBox& box) { return sizeClassOf(box) == size; }) -
                                 boxes_.begin());
    addHierarchy(begin, end, context);
  }
}

void BoxTree::sortBoxes(std::vector<NumberedBox> boxes, const RunContext& context)
{
  constexpr int keyBits = 19;
  constexpr std::size_t grain = 16384;
  const LatticeBox all = boundsOf(boxes);
  origin_ = all.low;
  std::uint64_t length = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    length = std::max(length, static_cast<std::uint64_t>(all.high[axis] - all.low[axis]));
  }
  const int shift = std::max(0, static_cast<int>(std::bit_width(length)) - keyBits);
  std::vector<SortKey> keys(boxes.size());
  context.executor.forEach(boxes.size(), grain, [&](std::size_t i) {
    GridCell cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t center = boxes[i].low[axis] + (boxes[i].high[axis] - boxes[i].low[axis]) / 2;
      cell[axis] = static_cast<std::uint32_t>((center - origin_[axis]) >> shift);
    }
    keys[i] = {std::uint64_t{sizeClassOf(boxes[i])} << (3 * keyBits) | mortonKey(cell), static_cast<Index>(i)};
  });
  sortOnThreads(keys, context);
  boxes_.resize(boxes.size());
  context.executor.forEach(boxes.size(), grain, [&](std::size_t i) { boxes_[i] = boxes[keys[i].box]; });
}

void BoxTree::addHierarchy(std::size_t begin, std::size_t end, const RunContext& context)
{
  constexpr std::size_t grain = 2048;
  Hierarchy hierarchy{begin, end, {}};
  for (std::size_t children = end - begin; hierarchy.levels.empty() || children > 1;)
  {
    const std::size_t lower = hierarchy.levels.empty() ? 0 : hierarchy.levels.back();
    const bool first = hierarchy.levels.empty();
    const std::size_t count = (children + width - 1) / width;
    hierarchy.levels.push_back(groups_.size());
    groups_.resize(groups_.size() + count);
    Group* const groups = groups_.data() + hierarchy.levels.back();
    context.executor.forEach(count, grain, [&](std::size_t g) {
      for (std::size_t i = 0; i < width; ++i)
      {
        const std::size_t child = g * width + i;
        for (int axis = 0; axis < 3; ++axis)
        {
          float& low = groups[g].low[axis][i];
          float& high = groups[g].high[axis][i];
          if (child >= children)
          {
            low = infinite;
            high = -infinite;
          }
          else if (first)
          {
            low = below(boxes_[begin + child].low[axis] - origin_[axis]);
            high = above(boxes_[begin + child].high[axis] - origin_[axis]);
          }
          else
          {
            low = *std::ranges::min_element(groups_[lower + child].low[axis]);
            high = *std::ranges::max_element(groups_[lower + child].high[axis]);
          }
        }
      }
    });
    children = count;
  }
  hierarchies_.push_back(std::move(hierarchy));
}

} // namespace atria
