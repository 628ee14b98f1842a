// SPDX-License-Identifier: GPL-3.0-or-later
/// Decides in a few steps that most boxes touch none of a set of boxes.
#pragma once

#include "Surface/Search/BoxPairs.h"

#include <cstdint>

namespace atria {

/// A raster of the cells that some boxes touch.
class BoxRaster
{
public:
  explicit BoxRaster(const std::vector<NumberedBox>& boxes);

  /// Returns false for most boxes that touch none, and true for all others.
  bool mayTouch(const LatticeBox& box) const;

private:
  /// Number of cells along each axis. A row along x is the bits of a word.
  static constexpr std::int64_t width = 64;

  struct Cells
  {
    LatticePoint low;
    LatticePoint high;
    std::uint64_t row;
  };
  Cells cellsOf(const LatticeBox& box) const;
  std::uint64_t& rowAt(std::int64_t y, std::int64_t z) { return rows[static_cast<std::size_t>(z * width + y)]; }

  LatticeBox bounds;
  int shift = 0;
  std::vector<std::uint64_t> rows;
};

} // namespace atria
