// SPDX-License-Identifier: GPL-3.0-or-later
/// Octants to refine, collected from several sources under a limit on elements.
#pragma once

#include "Octree/Sizing/KeptSizes.h"

namespace atria {

class ElementBudget;

/// Grows by what sources add, level by level from the root; every source adds an octant only if it has added its
/// parent.
///
/// Octants that are refined add elements only. So where what has been added makes too many already, the rest would too,
/// and coarser sizes are taken at once, by the steps of SizeSteps. What is left out does not depend on the order in
/// which sources add.
class OctantSets final : public OctantSink
{
public:
  /// A `maxElements` of 0 in the options is no limit. `budget` is asked whatever is added. Keeps references to options
  /// and budget.
  OctantSets(const GridFrame& frame, const KeptSizes& requested, const SizingOptions& options, ElementBudget& budget);

  const GridFrame& frame() const override { return frame_; }
  bool takes(int level, OctantNeed need) const override { return steps_.kept().keeps(level, need); }
  bool isLimited() const override { return limit > 0; }
  void add(int level, const std::vector<MortonKey>& keys, const std::vector<OctantNeed>& needs,
           const RunContext& context) override;
  bool goesOn(int /*level*/, MortonKey /*key*/) const override { return true; }

  /// Balances what is there, and leaves out more until the balanced sets keep to the limit. Throws Error if not even
  /// the start level does, or the budget is exceeded. Returns the balanced sets.
  RefinedSets balanced(const RunContext& context);

  /// Which sizes were taken instead of those requested, in words; empty if these were.
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
  /// Of the balanced sets; counted only where they are limited.
  std::size_t elements_ = 0;
};

} // namespace atria
