// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/WholeZones.h"

#include <array>
#include <map>
#include <utility>

namespace atria {

namespace {

/// A zone, and a zone of the whole.
using ZonePair = std::array<std::int32_t, 2>;
using ZonePairs = std::map<ZonePair, std::size_t>;

/// Counts the points in each pair of zones, without those that were moved.
ZonePairs countPairs(const WholeZones& whole, const Zones& zones, const GridPlaces& grid, const GridPart& part)
{
  ZonePairs counts;
  ZonePair last{-1, -1};
  std::size_t run = 0; // neighbors mostly are in the same zones
  for (Index point = part.points().begin; point < part.points().end; ++point)
  {
    if (!grid.isDisplaced(point))
    {
      const ZonePair pair{zones.ofPoint[point], whole.ofPoint[point]};
      if (pair != last && run > 0)
      {
        counts[last] += std::exchange(run, 0);
      }
      last = pair;
      ++run;
    }
  }
  if (run > 0)
  {
    counts[last] += run;
  }
  return counts;
}

ZonePairs addPairs(const ZonePairs& own, RankExchange& exchange)
{
  struct Entry
  {
    ZonePair pair;
    std::size_t count;
  };
  std::vector<Entry> entries;
  for (const auto& [pair, count] : own)
  {
    entries.push_back({pair, count});
  }
  ZonePairs sums;
  for (const Entry& entry : joinAll(exchange, std::move(entries)))
  {
    sums[entry.pair] += entry.count;
  }
  return sums;
}

} // namespace

std::vector<std::int32_t> keepAs(const WholeZones& whole, const Zones& zones, const GridPlaces& grid,
                                 const GridPart& part, std::vector<char>& kept, std::vector<ZoneSummary>& summaries)
{
  const ZonePairs counts = addPairs(countPairs(whole, zones, grid, part), part.exchange());
  std::vector<std::int32_t> ofWhole(kept.size(), -1);
  std::vector<std::size_t> most(kept.size(), 0);
  std::vector<std::array<std::size_t, 2>> votes(kept.size(), {0, 0});
  for (const auto& [pair, count] : counts)
  {
    const auto zone = static_cast<std::size_t>(pair[0]);
    const auto before = static_cast<std::size_t>(pair[1]);
    if (zone < kept.size() && before < whole.kept.size())
    {
      votes[zone][whole.kept[before] ? 1 : 0] += count;
      if (count > most[zone])
      {
        most[zone] = count;
        ofWhole[zone] = pair[1];
      }
    }
  }
  for (std::size_t zone = 0; zone < votes.size(); ++zone)
  {
    const auto& [against, in] = votes[zone];
    kept[zone] = against == in ? kept[zone] : static_cast<char>(in > against ? 1 : 0);
    summaries[zone].kept = kept[zone] != 0;
  }
  return ofWhole;
}

void listAs(const WholeZones& whole, const std::vector<std::int32_t>& ofWhole, Buffer<std::int32_t>& ofElement,
            std::vector<char>& kept, std::vector<ZoneSummary>& summaries)
{
  std::vector<std::int32_t> numbers(kept.size(), 0);
  std::vector<ZoneSummary> list = whole.summaries;
  std::vector<char> isKept = whole.kept;
  std::vector<char> isMet(list.size(), 0);
  for (std::size_t zone = 0; zone < kept.size(); ++zone)
  {
    if (!kept[zone])
    {
      continue;
    }
    numbers[zone] = ofWhole[zone];
    if (numbers[zone] < 0 || !whole.kept[static_cast<std::size_t>(numbers[zone])])
    {
      numbers[zone] = static_cast<std::int32_t>(list.size());
      list.push_back(summaries[zone]);
      isKept.push_back(1);
    }
    else if (const auto number = static_cast<std::size_t>(numbers[zone]); !isMet[number])
    {
      isMet[number] = 1;
      list[number] = summaries[zone];
    }
  }
  for (std::size_t zone = 0; zone < isMet.size(); ++zone)
  {
    isKept[zone] = isKept[zone] && isMet[zone] ? 1 : 0;
    list[zone].kept = isKept[zone] != 0;
  }
  summaries = std::move(list);
  kept = std::move(isKept);
  for (std::int32_t& zone : ofElement)
  {
    // Elements of a zone that is unknown here are cut off later.
    const auto number = static_cast<std::size_t>(zone);
    zone = number < numbers.size() ? numbers[number] : static_cast<std::int32_t>(summaries.size());
  }
}

} // namespace atria
