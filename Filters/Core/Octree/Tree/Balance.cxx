// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/Balance.h"

#include "Octree/Tree/GeometryLists.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <array>
#include <span>

namespace atria {

namespace {

/// A sorted set of keys as runs of successive ones: a region that is refined throughout has few.
class KeyRuns
{
public:
  explicit KeyRuns(const std::vector<MortonKey>& keys)
  {
    for (const MortonKey key : keys)
    {
      if (!ends.empty() && ends.back() == key)
      {
        ++ends.back();
        continue;
      }
      firsts.push_back(key);
      ends.push_back(key + 1);
    }
  }

  /// True if the set has a key. `hint` is the run where the last key was found.
  bool contains(MortonKey key, std::size_t& hint) const
  {
    if (hint < firsts.size() && firsts[hint] <= key && key < ends[hint])
    {
      return true;
    }
    const auto after = std::upper_bound(firsts.begin(), firsts.end(), key);
    if (after == firsts.begin() || key >= ends[after - firsts.begin() - 1])
    {
      return false;
    }
    hint = static_cast<std::size_t>(after - firsts.begin() - 1);
    return true;
  }

private:
  std::vector<MortonKey> firsts;
  std::vector<MortonKey> ends;
};

/// Finds the octants of the level above that must be refined because octants of a level are: all that hold an octant up
/// to `layers` away.
class Requirements
{
public:
  Requirements(int level, int layers, const GridFrame& frame, const std::vector<MortonKey>& above)
      : level_(level), layers_(layers), frame_(frame), present(above), end(std::int64_t{1} << (level - 1))
  {
  }

  /// Appends what is not there yet, for octants that are all the refined ones of some families.
  void append(std::span<const MortonKey> keys, std::vector<MortonKey>& out) const
  {
    std::size_t hint = 0;
    for (std::size_t i = 0; i < keys.size();)
    {
      const MortonKey parent = keys[i] >> 3;
      unsigned children = 0;
      for (; i < keys.size() && keys[i] >> 3 == parent; ++i)
      {
        children |= 1u << (keys[i] & 7);
        if (layers_ > 1)
        {
          appendFor(keys[i], hint, out);
        }
      }
      if (layers_ == 1)
      {
        appendFor(parent, children, hint, out);
      }
    }
  }

private:
  /// Adds one layer: those of the 27 octants around a parent that touch one of these children.
  void appendFor(MortonKey parent, unsigned children, std::size_t& hint, std::vector<MortonKey>& out) const
  {
    // Children by axis and offset of the octants around their parent: those on that side, or all.
    constexpr std::array<std::array<unsigned, 3>, 3> touching{
        {{0x55, 0xff, 0xaa}, {0x33, 0xff, 0xcc}, {0x0f, 0xff, 0xf0}}};
    const GridCell cell = gridCell(parent);
    for (int z = 0; z < 3; ++z)
    {
      for (int y = 0; y < 3; ++y)
      {
        for (int x = 0; x < 3; ++x)
        {
          if ((children & touching[0][x] & touching[1][y] & touching[2][z]) != 0)
          {
            require({cell[0] + std::int64_t{x} - 1, cell[1] + std::int64_t{y} - 1, cell[2] + std::int64_t{z} - 1}, hint,
                    out);
          }
        }
      }
    }
  }

  void appendFor(MortonKey key, std::size_t& hint, std::vector<MortonKey>& out) const
  {
    const GridCell cell = gridCell(key);
    const auto low = [&](int axis) { return (std::int64_t{cell[axis]} - layers_) >> 1; };
    const auto high = [&](int axis) { return (std::int64_t{cell[axis]} + layers_) >> 1; };
    for (std::int64_t z = low(2); z <= high(2); ++z)
    {
      for (std::int64_t y = low(1); y <= high(1); ++y)
      {
        for (std::int64_t x = low(0); x <= high(0); ++x)
        {
          require({x, y, z}, hint, out);
        }
      }
    }
  }

  void require(const std::array<std::int64_t, 3>& at, std::size_t& hint, std::vector<MortonKey>& out) const
  {
    if (std::any_of(at.begin(), at.end(), [&](std::int64_t c) { return c < 0 || c >= end; }))
    {
      return;
    }
    const MortonKey wanted = mortonKey(
        {static_cast<std::uint32_t>(at[0]), static_cast<std::uint32_t>(at[1]), static_cast<std::uint32_t>(at[2])});
    if (!present.contains(wanted, hint) && !domainBoxOf(frame_, level_ - 1, wanted).empty())
    {
      out.push_back(wanted);
    }
  }

  int level_;
  int layers_;
  const GridFrame& frame_;
  KeyRuns present;
  std::int64_t end;
};

/// Returns where ranges of about `grain` keys begin, and the end of the last one. No range splits a family.
std::vector<std::size_t> rangesOfFamilies(const std::vector<MortonKey>& keys, std::size_t grain)
{
  std::vector<std::size_t> begins{0};
  while (begins.back() + grain < keys.size())
  {
    std::size_t next = begins.back() + grain;
    while (next < keys.size() && keys[next] >> 3 == keys[next - 1] >> 3)
    {
      ++next;
    }
    begins.push_back(next);
  }
  if (begins.back() < keys.size())
  {
    begins.push_back(keys.size());
  }
  return begins;
}

/// Adds the siblings of octants.
void completeFamilies(std::vector<MortonKey>& keys)
{
  std::vector<MortonKey> all;
  all.reserve(keys.size());
  for (const MortonKey key : keys)
  {
    if (all.empty() || all.back() >> 3 != key >> 3)
    {
      for (MortonKey child = 0; child < 8; ++child)
      {
        all.push_back((key >> 3) << 3 | child);
      }
    }
  }
  keys = std::move(all);
}

} // namespace

void balance(RefinedSets& refined, const GridFrame& frame, const RunContext& context, int cellsPerLevel, bool families)
{
  constexpr std::size_t grain = 4096;
  for (int level = static_cast<int>(refined.size()) - 1; level > 0; --level)
  {
    if (families)
    {
      completeFamilies(refined[level]);
    }
    const std::vector<MortonKey>& keys = refined[level];
    std::vector<MortonKey>& above = refined[level - 1];
    const Requirements requirements(level, cellsPerLevel, frame, above);
    const std::vector<std::size_t> begins = rangesOfFamilies(keys, grain);
    std::vector<std::vector<MortonKey>> parts(begins.size() - 1);
    context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
      context.progress.check();
      requirements.append(std::span(keys).subspan(begins[part], begins[part + 1] - begins[part]), parts[part]);
      sortUnique(parts[part]);
    });
    std::vector<MortonKey> missing;
    for (const auto& part : parts)
    {
      missing.insert(missing.end(), part.begin(), part.end());
    }
    sortUnique(missing);
    const auto before = static_cast<std::ptrdiff_t>(above.size());
    above.insert(above.end(), missing.begin(), missing.end());
    std::inplace_merge(above.begin(), above.begin() + before, above.end());
  }
}

} // namespace atria
