// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Search/BoxRaster.h"

#include <algorithm>

namespace atria {

BoxRaster::BoxRaster(const std::vector<NumberedBox>& boxes) : bounds(boundsOf(boxes)), rows(width * width, 0)
{
  std::int64_t length = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    length = std::max(length, bounds.high[axis] - bounds.low[axis]);
  }
  while (length >> shift >= width)
  {
    ++shift;
  }
  for (const LatticeBox& box : boxes)
  {
    const Cells cells = cellsOf(box);
    for (std::int64_t z = cells.low[2]; z <= cells.high[2]; ++z)
    {
      for (std::int64_t y = cells.low[1]; y <= cells.high[1]; ++y)
      {
        rowAt(y, z) |= cells.row;
      }
    }
  }
}

bool BoxRaster::mayTouch(const LatticeBox& box) const
{
  if (!overlap(box, bounds))
  {
    return false;
  }
  const Cells cells = cellsOf(box);
  std::uint64_t found = 0;
  for (std::int64_t z = cells.low[2]; z <= cells.high[2]; ++z)
  {
    for (std::int64_t y = cells.low[1]; y <= cells.high[1]; ++y)
    {
      found |= rows[static_cast<std::size_t>(z * width + y)] & cells.row;
    }
  }
  return found != 0;
}

/// Returns the cells of the part of a box within the bounds.
BoxRaster::Cells BoxRaster::cellsOf(const LatticeBox& box) const
{
  Cells cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    cells.low[axis] = (std::max(box.low[axis], bounds.low[axis]) - bounds.low[axis]) >> shift;
    cells.high[axis] = (std::min(box.high[axis], bounds.high[axis]) - bounds.low[axis]) >> shift;
  }
  const std::uint64_t upTo = ~std::uint64_t{0} >> (width - 1 - cells.high[0]);
  cells.row = upTo & ~std::uint64_t{0} << cells.low[0];
  return cells;
}

} // namespace atria
