// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Kernel/Coloring.h"

#include <algorithm>
#include <bitset>

namespace atria {

Colours colourPoints(const Region& region)
{
  constexpr std::size_t most = 192;
  using Set = std::bitset<most>;
  // By cell, the colours of points that read it. A point that writes a cell beside it reads it, too.
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
    std::size_t colour = 0;
    while (colour < most && taken[colour])
    {
      ++colour;
    }
    classes[colour].push_back(m);
    if (colour == most)
    {
      continue;
    }
    for (const Index cell : about)
    {
      read[cell].set(colour);
      for (const Index f : region.facesOf(cell))
      {
        const Index across = region.owner[f] == cell ? region.neighbour[f] : region.owner[f];
        if (across < region.judgedCount())
        {
          read[across].set(colour);
        }
      }
    }
  }
  Colours colours;
  colours.lastIsSerial = !classes.back().empty();
  for (const std::vector<Index>& members : classes)
  {
    if (!members.empty())
    {
      colours.order.insert(colours.order.end(), members.begin(), members.end());
      colours.offsets.push_back(colours.order.size());
    }
  }
  return colours;
}

} // namespace atria
