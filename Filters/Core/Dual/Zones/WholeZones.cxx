// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/WholeZones.h"

#include <array>

namespace atria {

void keepAs(const WholeZones& whole, const Zones& zones, const GridPlaces& grid, const ViewShare& share,
            std::vector<char>& kept, std::vector<ZoneSummary>& summaries)
{
  std::vector<std::array<std::size_t, 2>> votes(kept.size(), {0, 0});
  for (Index point = share.begin; point < share.end; ++point)
  {
    const auto zone = static_cast<std::size_t>(zones.ofPoint[point]);
    const auto before = static_cast<std::size_t>(whole.ofPoint[point]);
    if (zone < kept.size() && before < whole.kept.size() && !grid.isDisplaced(point))
    {
      ++votes[zone][whole.kept[before] ? 1 : 0];
    }
  }
  if (share.exchange)
  {
    const std::vector<std::vector<std::array<std::size_t, 2>>> all = gatherAll(*share.exchange, votes);
    std::ranges::fill(votes, std::array<std::size_t, 2>{0, 0});
    for (const auto& some : all)
    {
      for (std::size_t zone = 0; zone < votes.size(); ++zone)
      {
        votes[zone][0] += some[zone][0];
        votes[zone][1] += some[zone][1];
      }
    }
  }
  for (std::size_t zone = 0; zone < votes.size(); ++zone)
  {
    const auto& [against, in] = votes[zone];
    if (against != in)
    {
      kept[zone] = in > against ? 1 : 0;
      summaries[zone].kept = kept[zone] != 0;
    }
  }
}

void listAs(const WholeZones& whole, Buffer<std::int32_t>& ofElement, std::vector<char>& kept,
            std::vector<ZoneSummary>& summaries)
{
  std::vector<std::int32_t> numbers(kept.size(), 0);
  std::vector<ZoneSummary> list;
  for (std::size_t zone = 0; zone < kept.size(); ++zone)
  {
    if (kept[zone])
    {
      numbers[zone] = static_cast<std::int32_t>(list.size());
      list.push_back(std::move(summaries[zone]));
    }
  }
  kept.assign(list.size(), 1);
  for (std::size_t zone = 0; zone < whole.kept.size(); ++zone)
  {
    if (!whole.kept[zone])
    {
      list.push_back(whole.summaries[zone]);
      kept.push_back(0);
    }
  }
  summaries = std::move(list);
  for (std::int32_t& zone : ofElement)
  {
    // What is of no zone that is known here is cut off later.
    const auto number = static_cast<std::size_t>(zone);
    zone = number < numbers.size() ? numbers[number] : static_cast<std::int32_t>(summaries.size());
  }
}

} // namespace atria
