// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <cmath>
#include <unordered_map>
#include <vector>

namespace atria::testing {

/// Things by the boxes they lie in: which of them can be at a point.
class BoxIndex
{
public:
  explicit BoxIndex(double cellSize) : cellSize_(cellSize) {}

  void add(Index id, const Box3& box, double margin)
  {
    const Cell low = cellOf(box.min.array() - margin);
    const Cell high = cellOf(box.max.array() + margin);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
    {
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
        {
          cells_[keyOf({x, y, z})].push_back(id);
        }
      }
    }
  }

  /// Everything whose box, with its margin, holds p; and some more.
  const std::vector<Index>& at(const Vec3& p) const
  {
    static const std::vector<Index> none;
    const auto found = cells_.find(keyOf(cellOf(p)));
    return found == cells_.end() ? none : found->second;
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cellOf(const Vec3& p) const
  {
    return {std::llround(std::floor(p[0] / cellSize_)), std::llround(std::floor(p[1] / cellSize_)),
            std::llround(std::floor(p[2] / cellSize_))};
  }
  // Cells whose keys are equal by chance only add candidates.
  static std::uint64_t keyOf(const Cell& cell)
  {
    return static_cast<std::uint64_t>(cell[0]) * 0x9E3779B97F4A7C15u ^
           static_cast<std::uint64_t>(cell[1]) * 0xC2B2AE3D27D4EB4Fu ^ static_cast<std::uint64_t>(cell[2]) << 21;
  }

  double cellSize_;
  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

} // namespace atria::testing
