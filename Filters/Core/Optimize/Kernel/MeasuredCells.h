// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds cells that fall short of targets.
#pragma once

#include "Optimize/Kernel/QualityEvaluator.h"

namespace atria {

/// A cell that falls short of some target, and its least measure: 0 at the limit of what is valid.
struct ShortCell
{
  Index cell;
  float worst;
};

/// The cells of a region that fall short, in its order; its evaluator aims beyond the targets by `margin`, as in
/// OptimizerOptions.
std::vector<ShortCell> shortCellsOf(const QualityEvaluator& evaluator, double margin, const RunContext& context);

/// The cells about marked points that fall short, in order.
std::vector<ShortCell> findShortCells(const CellSource& source, const std::vector<char>& marked,
                                      const QualityTargets& targets, const RunContext& context);

/// Keeps what cells fall short by, so that they are measured only where points have moved. 48 bytes for each cell that
/// falls short.
class MeasuredCells
{
public:
  /// Later targets ask for no more than `strictest`.
  explicit MeasuredCells(const QualityTargets& strictest) : targets_(strictest) {}

  /// Notes cells, in order, that have changed.
  void outdate(const std::vector<Index>& cells);
  /// Measures the cells that have changed, O(their number) but for a mark for each cell of the mesh.
  void update(const CellSource& source, const RunContext& context);
  /// Of the cells measured those whose least measure by some targets is below `below`, 1 at most, in order.
  std::vector<ShortCell> shortOf(const QualityTargets& targets, float below = 1.0F) const;
  /// `numbers` gives each cell its number in another mesh, or noIndex for those that are not there.
  void renumber(const std::vector<Index>& numbers);

private:
  struct Record
  {
    Index cell;
    /// The least of each kind of measure, infinite where it does not fall short.
    std::array<float, Measure::kinds> least;
  };
  std::vector<Record> recordsOf(const QualityEvaluator& evaluator, const RunContext& context) const;

  QualityTargets targets_;
  std::vector<Record> records_; ///< in the order of cells
  std::vector<Index> outdated_;
};

} // namespace atria
