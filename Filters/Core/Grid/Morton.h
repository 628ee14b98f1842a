// SPDX-License-Identifier: GPL-3.0-or-later
/// Morton keys: the bits of x, y and z interleaved, x lowest (Morton 1966).
#pragma once

#include <array>
#include <cstdint>

namespace atria {

using MortonKey = std::uint64_t;

/// Spreads the low 21 bits of `x` to every third bit.
inline MortonKey spreadBits(std::uint64_t x)
{
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  x = (x | x << 2) & 0x1249249249249249ull;
  return x;
}

inline std::uint32_t gatherBits(MortonKey key)
{
  key &= 0x1249249249249249ull;
  key = (key | key >> 2) & 0x10c30c30c30c30c3ull;
  key = (key | key >> 4) & 0x100f00f00f00f00full;
  key = (key | key >> 8) & 0x1f0000ff0000ffull;
  key = (key | key >> 16) & 0x1f00000000ffffull;
  key = (key | key >> 32) & 0x1fffff;
  return static_cast<std::uint32_t>(key);
}

/// A cell of the uniform grid of some level.
using GridCell = std::array<std::uint32_t, 3>;

inline MortonKey mortonKey(const GridCell& cell)
{
  return spreadBits(cell[0]) | spreadBits(cell[1]) << 1 | spreadBits(cell[2]) << 2;
}

inline GridCell gridCell(MortonKey key) { return {gatherBits(key), gatherBits(key >> 1), gatherBits(key >> 2)}; }

} // namespace atria
