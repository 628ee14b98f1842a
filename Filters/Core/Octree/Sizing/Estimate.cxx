// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/Estimate.h"

#include "Octree/Sizing/ElementBudget.h"
#include "Octree/Tree/GeometryLists.h"
#include "Octree/Tree/SplitOctants.h"
#include "Support/Sums.h"

#include <algorithm>

namespace atria {

namespace {

/// Counts the new points of refined octants.
class PointCounter
{
public:
  PointCounter(const std::vector<MortonKey>& refined, int level, const GridFrame& frame)
      : keys(refined), cells(std::int64_t{1} << level), frame_(frame), half(frame.latticeSize(level + 1))
  {
  }

  /// Returns the number of new points that no refined octant before this one has. New points are its center, and the
  /// middles of its faces and edges. The refined octant with the lowest position (by z, y, x) counts a shared point.
  std::size_t pointsOf(MortonKey key) const
  {
    const GridCell cell = gridCell(key);
    std::size_t count = 0;
    for (int z = -1; z <= 1; ++z)
    {
      for (int y = -1; y <= 1; ++y)
      {
        for (int x = -1; x <= 1; ++x)
        {
          const std::array<int, 3> at{x, y, z};
          const bool isCorner = x != 0 && y != 0 && z != 0;
          count += !isCorner && inDomain(cell, at) && isFirst(cell, at) ? 1 : 0;
        }
      }
    }
    return count;
  }

private:
  bool inDomain(const GridCell& cell, const std::array<int, 3>& at) const
  {
    LatticePoint p;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = (2 * std::int64_t{cell[axis]} + 1 + at[axis]) * half;
    }
    return frame_.inDomain(p);
  }

  bool isRefined(const GridCell& cell, const std::array<int, 3>& by) const
  {
    GridCell other;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t c = std::int64_t{cell[axis]} + by[axis];
      if (c < 0 || c >= cells)
      {
        return false;
      }
      other[axis] = static_cast<std::uint32_t>(c);
    }
    return std::binary_search(keys.begin(), keys.end(), mortonKey(other));
  }

  /// True if this octant is the first refined one of those that have the point at `at`.
  bool isFirst(const GridCell& cell, const std::array<int, 3>& at) const
  {
    for (unsigned subset = 1; subset < 8; ++subset)
    {
      std::array<int, 3> by{};
      bool shares = true;
      for (int axis = 0; axis < 3; ++axis)
      {
        by[axis] = subset >> axis & 1 ? at[axis] : 0;
        shares = shares && ((subset >> axis & 1) == 0 || at[axis] != 0);
      }
      const bool before = std::tie(by[2], by[1], by[0]) < std::tuple(0, 0, 0);
      if (shares && before && isRefined(cell, by))
      {
        return false;
      }
    }
    return true;
  }

  const std::vector<MortonKey>& keys;
  std::int64_t cells;
  const GridFrame& frame_;
  std::int64_t half;
};

} // namespace

std::size_t countNewPoints(const std::vector<MortonKey>& refined, int level, const GridFrame& frame,
                           const RunContext& context)
{
  const PointCounter counter(refined, level, frame);
  return sumOver(refined.size(), context, [&](std::size_t i) { return counter.pointsOf(refined[i]); });
}

std::size_t childrenInDomain(std::span<const MortonKey> refined, int level, const GridFrame& frame,
                             const RunContext& context)
{
  return sumOver(refined.size(), context, [&](std::size_t i) {
    std::size_t count = 0;
    for (MortonKey k = 0; k < 8; ++k)
    {
      count += domainBoxOf(frame, level + 1, refined[i] << 3 | k).empty() ? 0 : 1;
    }
    return count;
  });
}

std::size_t countElements(const RefinedSets& refined, bool hexahedra, const GridFrame& frame, const RunContext& context)
{
  std::size_t elements = hexahedra ? countSplitPoints(refined, frame, context) : 0;
  for (std::size_t l = 0; l < refined.size(); ++l)
  {
    elements += countNewPoints(refined[l], static_cast<int>(l), frame, context);
  }
  return elements;
}

namespace {

MeshEstimate estimateOf(const SizedOctants& sized, bool hexahedra, const GridFrame& frame, const RunContext& context)
{
  MeshEstimate estimate;
  estimate.octants.assign(sized.refined.size() + 1, 0);
  estimate.octants[0] = sized.refined.empty() ? 1 : 0;
  for (std::size_t l = 0; l < sized.refined.size(); ++l)
  {
    const std::size_t below = l + 1 < sized.refined.size() ? sized.refined[l + 1].size() : 0;
    estimate.octants[l + 1] = childrenInDomain(sized.refined[l], static_cast<int>(l), frame, context) - below;
  }
  estimate.elements = countElements(sized.refined, hexahedra, frame, context);
  estimate.bytes = estimate.elements * bytesPerElement;
  estimate.warning = sized.warning;
  return estimate;
}

MeshEstimate estimateOf(const TooManyElements& refusal)
{
  MeshEstimate estimate;
  for (std::size_t l = 0; l <= refusal.octants.refined.size(); ++l)
  {
    estimate.octants.push_back(static_cast<std::size_t>(refusal.octants.leavesAt(l)));
  }
  constexpr double largest = 9e18; // any number of a file or a table holds that
  estimate.elements = static_cast<std::size_t>(std::min(refusal.elements, largest));
  estimate.bytes = static_cast<std::size_t>(std::min(refusal.elements * bytesPerElement, largest));
  estimate.isTooLarge = true;
  estimate.warning = refusal.what();
  return estimate;
}

} // namespace

MeshEstimate estimateElements(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                              const RunContext& context)
{
  try
  {
    return estimateOf(sizeOctants(model, frame, options, context), options.hexahedra, frame, context);
  }
  catch (const TooManyElements& refusal)
  {
    return estimateOf(refusal);
  }
}

} // namespace atria
