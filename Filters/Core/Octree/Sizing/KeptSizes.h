// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes that remain of the requested ones under a limit on elements.
#pragma once

#include "Octree/Sizing/OctantSink.h"
#include "Octree/Sizing/SizeRules.h"

#include <array>
#include <string>

namespace atria {

/// Octants are refined for each need down to a level of its own.
struct KeptSizes
{
  /// One entry per need: the level down to which octants are refined for it.
  std::array<int, needCount> levels{};
  int cellsPerLevel = 1;
  /// Octants are refined down to this level, whatever their need.
  int startLevel = 0;

  bool keeps(int level, OctantNeed need) const
  {
    return level < startLevel || level < levels[static_cast<std::size_t>(need)];
  }
  bool operator==(const KeptSizes&) const = default;
};

/// Returns the sizes that the frame and the options request.
KeptSizes requestedSizes(const GridFrame& frame, const ModelLevels& levels, const SizingOptions& options);

/// Steps from the requested sizes to coarser ones. Each gives up one level, or one layer of growth:
///
/// 1. in the open, as long as sides of the domain keep their faces (see narrowestSide);
/// 2. layers of octants of each size (`cellsPerLevel`);
/// 3. in boxes, distances and gaps away from surfaces;
/// 4. at surfaces away from features;
/// 5. at features;
/// 6. in the open, down to the start level.
///
/// A step keeps only octants that the step before it keeps. So a higher limit gives no coarser octant anywhere.
class SizeSteps
{
public:
  SizeSteps(const GridFrame& frame, const KeptSizes& requested);

  const KeptSizes& kept() const { return kept_; }
  bool isReduced() const { return kept_ != requested_; }

  /// Takes the next step that leaves out some of the existing octants, whose levels end at `ends` (one entry per need).
  /// Returns false if there is none. With `withGrowth`, a step to fewer layers of each size counts as such.
  bool giveUpMore(const std::array<int, needCount>& ends, bool withGrowth);

  /// Returns a text that names the sizes kept instead of the requested ones.
  std::string text(const GridFrame& frame, const SizingOptions& options) const;

private:
  bool lower(OctantNeed need, int end, int floor);

  KeptSizes requested_;
  KeptSizes kept_;
  int openFloor_;
};

} // namespace atria
