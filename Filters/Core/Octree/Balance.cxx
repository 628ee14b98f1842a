// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Balance.h"

#include "Octree/GeometryLists.h"

#include <algorithm>

namespace atria {

namespace {

/// Parents of the octants within `layers` of `cell` along an axis.
struct ParentRange
{
  std::int64_t first;
  std::int64_t last;
};

ParentRange parentsAbout(std::int64_t cell, int layers, std::int64_t end)
{
  return {std::max<std::int64_t>((cell - layers) >> 1, 0), std::min((cell + layers) >> 1, end - 1)};
}

/// Keys of the octants of level - 1 that must be refined because octant `key` of `level` is: its own parent, and the
/// parents of all octants up to `layers` away. For one layer these are the eight octants about the parent's corner
/// nearest to it.
void appendRequired(MortonKey key, int level, int layers, const GridFrame& frame, const std::vector<MortonKey>& present,
                    std::vector<MortonKey>& out)
{
  const GridCell cell = gridCell(key);
  const std::int64_t end = std::int64_t{1} << (level - 1);
  std::array<ParentRange, 3> range;
  for (int axis = 0; axis < 3; ++axis)
  {
    range[axis] = parentsAbout(cell[axis], layers, end);
  }
  for (std::int64_t z = range[2].first; z <= range[2].last; ++z)
  {
    for (std::int64_t y = range[1].first; y <= range[1].last; ++y)
    {
      for (std::int64_t x = range[0].first; x <= range[0].last; ++x)
      {
        const MortonKey wanted =
            mortonKey({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)});
        if (!std::binary_search(present.begin(), present.end(), wanted) &&
            !domainBoxOf(frame, level - 1, wanted).empty())
        {
          out.push_back(wanted);
        }
      }
    }
  }
}

} // namespace

void balance(RefinedSets& refined, const GridFrame& frame, const RunContext& context, int cellsPerLevel)
{
  constexpr std::size_t grain = 4096;
  for (int level = static_cast<int>(refined.size()) - 1; level > 0; --level)
  {
    const std::vector<MortonKey>& keys = refined[level];
    std::vector<MortonKey>& above = refined[level - 1];
    std::vector<std::vector<MortonKey>> parts((keys.size() + grain - 1) / grain);
    context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
      context.progress.check();
      for (std::size_t i = part * grain; i < std::min((part + 1) * grain, keys.size()); ++i)
      {
        appendRequired(keys[i], level, cellsPerLevel, frame, above, parts[part]);
      }
      std::sort(parts[part].begin(), parts[part].end());
      parts[part].erase(std::unique(parts[part].begin(), parts[part].end()), parts[part].end());
    });
    for (const auto& part : parts)
    {
      above.insert(above.end(), part.begin(), part.end());
    }
    std::sort(above.begin(), above.end());
    above.erase(std::unique(above.begin(), above.end()), above.end());
  }
}

} // namespace atria
