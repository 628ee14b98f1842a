// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/KeptSizes.h"

#include <algorithm>
#include <numbers>
#include <sstream>

namespace atria {

namespace {

int& levelOf(KeptSizes& sizes, OctantNeed need) { return sizes.levels[static_cast<std::size_t>(need)]; }
int levelOf(const KeptSizes& sizes, OctantNeed need) { return sizes.levels[static_cast<std::size_t>(need)]; }

/// Returns the names of the properties that request sizes away from surfaces.
std::string regionRules(const SizingOptions& options)
{
  std::vector<std::string> names;
  if (!options.boxes.empty())
  {
    names.emplace_back("RefinementBoxes");
  }
  if (!options.distanceSizes.empty())
  {
    names.emplace_back("DistanceSizeRules");
  }
  if (options.cellsAcrossGap > 0)
  {
    names.emplace_back("CellsAcrossGap");
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

} // namespace

KeptSizes requestedSizes(const GridFrame& frame, const ModelLevels& levels, const SizingOptions& options)
{
  const int feature = std::ranges::max(levels.featureOfSurface);
  int region = options.cellsAcrossGap > 0 ? feature : 0;
  for (const RefinementBox& box : options.boxes)
  {
    region = std::max(region, levelNotAbove(box.size, frame));
  }
  for (const DistanceSize& rule : options.distanceSizes)
  {
    region = std::max(region, levelNotAbove(rule.size, frame));
  }
  const int surface = options.curvatureAngle > 0.0 ? feature : std::ranges::max(levels.ofSurface);
  KeptSizes sizes;
  sizes.startLevel = frame.startLevel;
  sizes.cellsPerLevel = options.cellsPerLevel;
  levelOf(sizes, OctantNeed::open) = std::max(frame.topLevel, frame.startLevel);
  levelOf(sizes, OctantNeed::region) = region;
  levelOf(sizes, OctantNeed::surface) = std::max(surface, region);
  levelOf(sizes, OctantNeed::feature) = feature;
  return sizes;
}

SizeSteps::SizeSteps(const GridFrame& frame, const KeptSizes& requested)
    : requested_(requested), kept_(requested), openFloor_(frame.startLevel)
{
  if (frame.turnedDomain)
  {
    const int ofSides = levelNotAbove(narrowestSide(*frame.turnedDomain) / std::numbers::sqrt2, frame);
    openFloor_ = std::clamp(ofSides, openFloor_, levelOf(requested, OctantNeed::open));
  }
}

bool SizeSteps::lower(OctantNeed need, int end, int floor)
{
  int& level = levelOf(kept_, need);
  const int next = std::min(level, end) - 1;
  if (next < floor)
  {
    level = std::min(level, floor); // later steps are taken, so octants added later are given up, too
    return false;
  }
  level = next;
  return true;
}

bool SizeSteps::giveUpMore(const std::array<int, needCount>& ends, bool withGrowth)
{
  const auto endOf = [&](OctantNeed need) { return ends[static_cast<std::size_t>(need)]; };
  if (lower(OctantNeed::open, endOf(OctantNeed::open), openFloor_))
  {
    return true;
  }
  if (withGrowth && kept_.cellsPerLevel > 1)
  {
    --kept_.cellsPerLevel;
    return true;
  }
  kept_.cellsPerLevel = 1;
  for (const OctantNeed need : {OctantNeed::region, OctantNeed::surface, OctantNeed::feature})
  {
    if (lower(need, endOf(need), kept_.startLevel))
    {
      return true;
    }
  }
  openFloor_ = kept_.startLevel;
  return lower(OctantNeed::open, endOf(OctantNeed::open), openFloor_);
}

std::string SizeSteps::text(const GridFrame& frame, const SizingOptions& options) const
{
  std::ostringstream out;
  out.precision(4);
  const char* separator = "";
  const auto isLess = [&](OctantNeed need) { return levelOf(kept_, need) < levelOf(requested_, need); };
  const auto add = [&](OctantNeed need, const std::string& where, const std::string& name) {
    if (isLess(need))
    {
      out << separator << where << frame.sizeOf(levelOf(kept_, need)) << " instead of "
          << frame.sizeOf(levelOf(requested_, need)) << name;
      separator = ", ";
    }
  };
  add(OctantNeed::open, "SizeMax ", "");
  if (kept_.cellsPerLevel < requested_.cellsPerLevel)
  {
    out << separator << "CellsPerLevel " << kept_.cellsPerLevel << " instead of " << requested_.cellsPerLevel;
    separator = ", ";
  }
  const std::string rules = regionRules(options);
  if (!rules.empty())
  {
    add(OctantNeed::region, rules + " no finer than ", " away from surfaces");
  }
  const bool isPlain = options.surfaceSizes.empty() && levelOf(requested_, OctantNeed::surface) == frame.midLevel;
  add(OctantNeed::surface,
      isPlain ? "SizeMid " : "surfaces away from feature curves, corners and close surfaces no finer than ", "");
  add(OctantNeed::feature, "feature curves, corners and close surfaces no finer than ",
      levelOf(requested_, OctantNeed::feature) == frame.featureLevel ? " (SizeMin)" : "");
  if (!isLess(OctantNeed::feature))
  {
    out << "; " << (isLess(OctantNeed::surface) ? "" : "surfaces, ")
        << "feature curves, corners and close surfaces have the sizes requested";
  }
  return out.str();
}

} // namespace atria
