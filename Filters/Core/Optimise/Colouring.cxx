// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/Colouring.h"

#include <algorithm>
#include <bitset>

namespace atria {

Colours colourPoints(const Region& region)
{
  constexpr std::size_t most = 192;
  using Set = std::bitset<most>;
  std::vector<Set> written(region.judgedCount());
  std::vector<Set> read(region.judgedCount());
  std::vector<std::vector<Index>> classes(most + 1);
  std::vector<Index> beside;
  for (Index m = 0; m < region.movable.size(); ++m)
  {
    const auto about = region.cellsAbout(m);
    beside.assign(about.begin(), about.end());
    for (const Index cell : about)
    {
      for (const Index f : region.facesOf(cell))
      {
        const Index across = region.owner[f] == cell ? region.neighbour[f] : region.owner[f];
        if (across < region.judgedCount())
        {
          beside.push_back(across);
        }
      }
    }
    Set taken;
    for (const Index cell : about)
    {
      taken |= read[cell];
    }
    for (const Index cell : beside)
    {
      taken |= written[cell];
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
      written[cell].set(colour);
    }
    for (const Index cell : beside)
    {
      read[cell].set(colour);
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
