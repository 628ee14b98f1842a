// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Balance.h"

#include "Octree/GeometryLists.h"

#include <algorithm>

namespace atria {

namespace {

/// Keys of the octants of level - 1 that must be refined because octant `key` of `level` is: its own parent, and the
/// parents of its 26 neighbours, which are the seven other octants about the parent's corner nearest to it.
void appendRequired(MortonKey key, int level, const GridFrame& frame, const std::vector<MortonKey>& present,
                    std::vector<MortonKey>& out)
{
  const GridCell parent = gridCell(key >> 3);
  const std::int64_t end = std::int64_t{1} << (level - 1);
  for (unsigned which = 0; which < 8; ++which)
  {
    GridCell cell = parent;
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (which >> axis & 1)
      {
        const std::int64_t c = std::int64_t{parent[axis]} + ((key >> axis & 1) ? 1 : -1);
        inside = inside && c >= 0 && c < end;
        cell[axis] = static_cast<std::uint32_t>(c);
      }
    }
    if (!inside)
    {
      continue;
    }
    const MortonKey wanted = mortonKey(cell);
    if (!std::binary_search(present.begin(), present.end(), wanted) && !domainBoxOf(frame, level - 1, wanted).empty())
    {
      out.push_back(wanted);
    }
  }
}

} // namespace

void balance(RefinedSets& refined, const GridFrame& frame, const RunContext& context)
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
        appendRequired(keys[i], level, frame, above, parts[part]);
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
