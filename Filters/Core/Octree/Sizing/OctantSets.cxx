// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/OctantSets.h"

#include "Octree/Sizing/ElementBudget.h"
#include "Octree/Sizing/Estimate.h"
#include "Support/Error.h"

#include <algorithm>
#include <sstream>

namespace atria {

OctantSets::OctantSets(const GridFrame& frame, const KeptSizes& requested, const SizingOptions& options,
                       ElementBudget& budget)
    : frame_(frame), options_(options), limit(options.maxElements), budget_(budget), steps_(frame, requested)
{
}

void OctantSets::add(int level, const std::vector<MortonKey>& keys, const std::vector<OctantNeed>& needs,
                     const RunContext& context)
{
  if (keys.empty())
  {
    return;
  }
  levels.resize(std::max(levels.size(), static_cast<std::size_t>(level) + 1));
  Level& target = levels[level];
  Level merged;
  merged.keys.reserve(std::max(keys.size(), target.keys.size()));
  merged.needs.reserve(merged.keys.capacity());
  for (std::size_t i = 0, j = 0; i < keys.size() || j < target.keys.size();)
  {
    const bool fromNew = j == target.keys.size() || (i < keys.size() && keys[i] <= target.keys[j]);
    const bool fromOld = i == keys.size() || (j < target.keys.size() && target.keys[j] <= keys[i]);
    merged.keys.push_back(fromNew ? keys[i] : target.keys[j]);
    merged.needs.push_back(
        std::max(fromNew ? needs[i] : OctantNeed::open, fromOld ? target.needs[j] : OctantNeed::open));
    i += fromNew ? 1 : 0;
    j += fromOld ? 1 : 0;
  }
  target = std::move(merged);
  if (limit > 0)
  {
    prune(level);
    countPoints(level, context);
    while (pointsSoFar() > limit)
    {
      leaveOutMore(false, context);
    }
  }
  checkBudget(context);
}

void OctantSets::checkBudget(const RunContext& context)
{
  std::vector<std::span<const MortonKey>> refined;
  std::ranges::transform(levels, std::back_inserter(refined), [](const Level& l) { return std::span(l.keys); });
  budget_.check(refined, context);
}

std::size_t OctantSets::pointsSoFar() const
{
  std::size_t points = 0;
  for (const Level& level : levels)
  {
    points += level.newPoints;
  }
  return points;
}

/// Leaves out octants that are not kept, or whose parents are not. Returns true if there were any.
bool OctantSets::prune(int level)
{
  Level& target = levels[level];
  static const std::vector<MortonKey> none;
  const std::vector<MortonKey>& parents = level > 0 ? levels[level - 1].keys : none;
  std::size_t count = 0;
  std::size_t parent = 0;
  for (std::size_t i = 0; i < target.keys.size(); ++i)
  {
    const MortonKey above = target.keys[i] >> 3;
    while (parent < parents.size() && parents[parent] < above)
    {
      ++parent;
    }
    const bool hasParent = level == 0 || (parent < parents.size() && parents[parent] == above);
    if (hasParent && steps_.kept().keeps(level, target.needs[i]))
    {
      target.keys[count] = target.keys[i];
      target.needs[count] = target.needs[i];
      ++count;
    }
  }
  const bool isChanged = count < target.keys.size();
  target.keys.resize(count);
  target.needs.resize(count);
  return isChanged;
}

void OctantSets::countPoints(int level, const RunContext& context)
{
  levels[level].newPoints = countNewPoints(levels[level].keys, level, frame_, context);
}

void OctantSets::leaveOutMore(bool withGrowth, const RunContext& context)
{
  std::array<int, needCount> ends{};
  for (std::size_t level = 0; level < levels.size(); ++level)
  {
    for (const OctantNeed need : levels[level].needs)
    {
      ends[static_cast<std::size_t>(need)] = static_cast<int>(level) + 1;
    }
  }
  if (!steps_.giveUpMore(ends, withGrowth))
  {
    refuse();
  }
  for (int level = 0; level < static_cast<int>(levels.size()); ++level)
  {
    if (prune(level))
    {
      countPoints(level, context);
    }
  }
  while (!levels.empty() && levels.back().keys.empty())
  {
    levels.pop_back();
  }
}

void OctantSets::refuse() const
{
  const bool isThin = coarsestLevelFor(frame_) == frame_.startLevel;
  std::ostringstream text;
  text << "octants of level " << frame_.startLevel << ", which "
       << (isThin ? "the domain's shortest side" : "StartLevel") << " asks for, make more than MaxElements " << limit
       << ": raise it, or ";
  if (isThin)
  {
    text << "make the domain larger where it is " << frame_.domain.size().minCoeff() << " wide";
  }
  else
  {
    text << "lower StartLevel";
  }
  throw Error(text.str());
}

RefinedSets OctantSets::balanced(const Balance& balanceSets, const RunContext& context)
{
  for (;;)
  {
    RefinedSets sets;
    for (const Level& level : levels)
    {
      sets.push_back(level.keys);
    }
    balanceSets(sets, steps_.kept().cellsPerLevel);
    elements_ = limit > 0 ? countElements(sets, options_.hexahedra, frame_, context) : 0;
    if (elements_ <= limit)
    {
      budget_.check(std::vector<std::span<const MortonKey>>(sets.begin(), sets.end()), context);
      return sets;
    }
    leaveOutMore(true, context);
  }
}

std::string OctantSets::warning() const
{
  if (!steps_.isReduced())
  {
    return {};
  }
  std::ostringstream text;
  text << "the sizes requested make more elements than MaxElements " << limit
       << ", so these were taken: " << steps_.text(frame_, options_) << "; there are up to " << elements_
       << " elements";
  return text.str();
}

} // namespace atria
