// SPDX-License-Identifier: GPL-3.0-or-later
/// Octants to refine, collected from several sources under a limit on elements.
#pragma once

#include "Octree/Sizing/KeptSizes.h"

#include <functional>

namespace atria {

class ElementBudget;

/// Collects the octants that sources add, level by level from the root. A source adds an octant only if it has added
/// its parent.
///
/// Refining only adds elements. So if the octants added so far already make too many, coarser sizes are taken at once,
/// by the steps of SizeSteps. The order in which sources add does not change which octants are left out.
class OctantSets final : public OctantSink
{
public:
  /// Balances sets, with the least number of octants of each level between other levels (see balance()).
  using Balance = std::function<void(RefinedSets& sets, int cellsPerLevel)>;

  /// A `maxElements` of 0 in the options is no limit. `budget` is checked each time octants are added. Keeps references
  /// to options and budget.
  OctantSets(const GridFrame& frame, const KeptSizes& requested, const SizingOptions& options, ElementBudget& budget);

  const GridFrame& frame() const override { return frame_; }
  bool takes(int level, OctantNeed need) const override { return steps_.kept().keeps(level, need); }
  bool isLimited() const override { return limit > 0; }
  void add(int level, const std::vector<MortonKey>& keys, const std::vector<OctantNeed>& needs,
           const RunContext& context) override;
  bool goesOn(int /*level*/, MortonKey /*key*/) const override { return true; }

  /// Balances the sets, leaves out octants until the balanced sets keep to the limit, and returns them. Throws Error if
  /// not even the start level keeps to it, or if the budget is exceeded.
  RefinedSets balanced(const Balance& balanceSets, const RunContext& context);

  /// Returns a text that names the sizes taken instead of those requested; empty if all requested sizes were kept.
  std::string warning() const;

private:
  struct Level
  {
    std::vector<MortonKey> keys;
    std::vector<OctantNeed> needs;
    std::size_t newPoints = 0;
  };

  void leaveOutMore(bool withGrowth, const RunContext& context);
  bool prune(int level);
  void countPoints(int level, const RunContext& context);
  std::size_t pointsSoFar() const;
  [[noreturn]] void refuse() const;

  void checkBudget(const RunContext& context);

  GridFrame frame_;
  const SizingOptions& options_;
  std::size_t limit;
  ElementBudget& budget_;
  std::vector<Level> levels;
  SizeSteps steps_;
  /// Elements of the balanced sets; counted only if they are limited.
  std::size_t elements_ = 0;
};

} // namespace atria
