// SPDX-License-Identifier: GPL-3.0-or-later
#include "Grid/MortonShares.h"

#include "Grid/Morton.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t grain = 65536;
constexpr double cellsAcross = 1 << 21; // a key has 21 bits per axis

Box3 boxOf(std::span<const Vec3> places)
{
  Box3 box;
  for (const Vec3& place : places)
  {
    box.extend(place);
  }
  return box;
}

/// Places in a cube as cells of a uniform grid.
class KeyOfPlace
{
public:
  explicit KeyOfPlace(const Box3& box) : low(box.min)
  {
    const double size = box.size().maxCoeff();
    scale = size > 0.0 ? cellsAcross / size : 0.0;
  }

  MortonKey operator()(const Vec3& place) const
  {
    GridCell cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = (place[axis] - low[axis]) * scale;
      cell[axis] = at > 0.0 ? static_cast<std::uint32_t>(std::min(at, cellsAcross - 1.0)) : 0;
    }
    return mortonKey(cell);
  }

private:
  Vec3 low;
  double scale;
};

} // namespace

std::vector<Index> divideAlongMorton(std::span<const Vec3> places, std::size_t shares, const RunContext& context)
{
  std::vector<Index> shareOf(places.size(), 0);
  if (shares < 2 || places.empty())
  {
    return shareOf;
  }
  std::vector<std::pair<MortonKey, Index>> order(places.size());
  const KeyOfPlace keyOf(boxOf(places));
  context.executor.forEach(order.size(), grain, [&](std::size_t i) {
    order[i] = {keyOf(places[i]), static_cast<Index>(i)};
  });
  sortOnThreads(order, context);
  const std::size_t least = order.size() / shares;
  const std::size_t longer = order.size() % shares;
  const std::size_t inLonger = longer * (least + 1);
  context.executor.forEach(order.size(), grain, [&](std::size_t i) {
    const std::size_t share = i < inLonger ? i / (least + 1) : longer + (i - inLonger) / least;
    shareOf[order[i].second] = static_cast<Index>(share);
  });
  return shareOf;
}

} // namespace atria
