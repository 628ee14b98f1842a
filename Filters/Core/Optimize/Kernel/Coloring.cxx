// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/Coloring.h"

#include <algorithm>
#include <bitset>

namespace atria {

Colors colorPoints(const Region& region)
{
  constexpr std::size_t most = 192;
  using Set = std::bitset<most>;
  // One entry per cell: the colors of the points that read it. Cells that a point reads need no check: if another point
  // writes one, that point also reads a cell that this one writes.
  std::vector<Set> read(region.judgedCount());
  std::vector<std::vector<Index>> classes(most + 1);
  for (Index m = 0; m < region.movable.size(); ++m)
  {
    const auto about = region.cellsAbout(m);
    Set taken;
    for (const Index cell : about)
    {
      taken |= read[cell];
    }
    std::size_t color = 0;
    while (color < most && taken[color])
    {
      ++color;
    }
    classes[color].push_back(m);
    if (color == most)
    {
      continue;
    }
    for (const Index cell : about)
    {
      read[cell].set(color);
      for (const Index f : region.facesOf(cell))
      {
        const Index across = region.owner[f] == cell ? region.neighbor[f] : region.owner[f];
        if (across < region.judgedCount())
        {
          read[across].set(color);
        }
      }
    }
  }
  Colors colors;
  colors.lastIsSerial = !classes.back().empty();
  for (const std::vector<Index>& members : classes)
  {
    if (!members.empty())
    {
      colors.order.insert(colors.order.end(), members.begin(), members.end());
      colors.offsets.push_back(colors.order.size());
    }
  }
  return colors;
}

} // namespace atria
