// SPDX-License-Identifier: GPL-3.0-or-later
/// Octants to refine, collected from several sources under a limit on elements.
#pragma once

#include "Octree/Sizing/OctantSink.h"

namespace atria {

class ElementBudget;

/// Grows by what sources add, level by level from the root; every source adds an octant only if it has added its
/// parent.
///
/// Octants that are refined add elements only. So where what has been added makes too many already, the rest would too,
/// and the finest octants are left out at once: of the finest level first those that are not refined for features, then
/// those that are, then the next level. What is left out does not depend on the order in which sources add.
class OctantSets final : public OctantSink
{
public:
  /// `maxElements` 0 is no limit. `budget` is asked whatever is added.
  OctantSets(const GridFrame& frame, std::size_t maxElements, ElementBudget& budget);

  const GridFrame& frame() const override { return frame_; }
  bool takes(int level) const override { return 2 * level < kept_; }
  bool wantsFeatures() const override { return limit > 0; }
  void add(int level, const std::vector<MortonKey>& keys, const std::vector<char>& forFeatures,
           const RunContext& context) override;
  bool goesOn(int /*level*/, MortonKey /*key*/) const override { return true; }

  /// Balances what is there, and leaves out more until the balanced sets keep to the limit. Throws Error if not even
  /// the start level does, or the budget is exceeded. Returns the balanced sets.
  RefinedSets balanced(int cellsPerLevel, const RunContext& context);

  /// What was left out, in words; empty if nothing.
  std::string warning() const;

private:
  struct Level
  {
    std::vector<MortonKey> keys;
    std::vector<char> forFeatures;
    std::size_t newPoints = 0;
  };

  void leaveOutMore(const RunContext& context);
  void prune(int level, const RunContext& context);
  std::size_t pointsSoFar() const;

  void checkBudget(const RunContext& context);

  GridFrame frame_;
  std::size_t limit;
  ElementBudget& budget_;
  std::vector<Level> levels;
  /// Octants of level l refined for features have rank 2l, others 2l + 1; those of a rank below this one are kept.
  int kept_;
  /// The rank above all that was asked for.
  int asked_ = 0;
  /// Of the balanced sets; counted only where they are limited.
  std::size_t elements_ = 0;
};

} // namespace atria
