// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/OctantSets.h"

#include "Octree/Sizing/ElementBudget.h"
#include "Octree/Sizing/Estimate.h"
#include "Octree/Tree/Balance.h"
#include "Support/Error.h"

#include <algorithm>
#include <sstream>

namespace atria {

OctantSets::OctantSets(const GridFrame& frame, std::size_t maxElements, ElementBudget& budget)
    : frame_(frame), limit(maxElements), budget_(budget), kept_(2 * frame.depth)
{
}

void OctantSets::add(int level, const std::vector<MortonKey>& keys, const std::vector<char>& forFeatures,
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
  merged.forFeatures.reserve(merged.keys.capacity());
  for (std::size_t i = 0, j = 0; i < keys.size() || j < target.keys.size();)
  {
    const bool fromNew = j == target.keys.size() || (i < keys.size() && keys[i] <= target.keys[j]);
    const bool fromOld = i == keys.size() || (j < target.keys.size() && target.keys[j] <= keys[i]);
    merged.keys.push_back(fromNew ? keys[i] : target.keys[j]);
    const bool feature = (fromNew && !forFeatures.empty() && forFeatures[i]) || (fromOld && target.forFeatures[j]);
    merged.forFeatures.push_back(feature);
    asked_ = std::max(asked_, 2 * level + (feature ? 1 : 2));
    i += fromNew ? 1 : 0;
    j += fromOld ? 1 : 0;
  }
  target = std::move(merged);
  if (limit > 0)
  {
    prune(level, context);
    while (pointsSoFar() > limit)
    {
      leaveOutMore(context);
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

void OctantSets::prune(int level, const RunContext& context)
{
  Level& target = levels[level];
  std::size_t count = 0;
  for (std::size_t i = 0; i < target.keys.size(); ++i)
  {
    if (2 * level + (target.forFeatures[i] ? 0 : 1) < kept_)
    {
      target.keys[count] = target.keys[i];
      target.forFeatures[count] = target.forFeatures[i];
      ++count;
    }
  }
  target.keys.resize(count);
  target.forFeatures.resize(count);
  target.newPoints = countNewPoints(target.keys, level, frame_, context);
}

void OctantSets::leaveOutMore(const RunContext& context)
{
  // Ranks at which nothing is there leave nothing out.
  kept_ = std::min(kept_, 2 * static_cast<int>(levels.size())) - 1;
  if (kept_ < 2 * frame_.startLevel)
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
  const int level = kept_ / 2;
  prune(level, context);
  while (!levels.empty() && levels.back().keys.empty())
  {
    levels.pop_back();
  }
}

RefinedSets OctantSets::balanced(int cellsPerLevel, const RunContext& context)
{
  for (;;)
  {
    RefinedSets sets;
    for (const Level& level : levels)
    {
      sets.push_back(level.keys);
    }
    balance(sets, frame_, context, cellsPerLevel);
    elements_ = limit > 0 ? countElements(sets, frame_, context) : 0;
    if (elements_ <= limit)
    {
      budget_.check(std::vector<std::span<const MortonKey>>(sets.begin(), sets.end()), context);
      return sets;
    }
    leaveOutMore(context);
  }
}

std::string OctantSets::warning() const
{
  if (kept_ >= asked_)
  {
    return {};
  }
  // Refined octants of this level are the finest that may be kept, if at all; their children are one level finer.
  const int level = kept_ / 2;
  const bool featuresOnly = kept_ % 2 != 0;
  const double finest = frame_.sizeOf(featuresOnly ? level + 1 : level);
  std::ostringstream text;
  text << "the sizes asked for make more elements than MaxElements " << limit << ": ";
  if (featuresOnly)
  {
    text << "octants of " << finest << " were made for feature curves, corners and close surfaces only, finer ones not "
         << "at all";
  }
  else
  {
    text << "octants finer than " << finest << " were left out";
  }
  text << "; there are up to " << elements_ << " elements";
  return text.str();
}

} // namespace atria
