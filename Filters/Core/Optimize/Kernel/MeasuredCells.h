// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds cells that fall short of targets, and keeps their measures.
#pragma once

#include "Optimize/Kernel/QualityEvaluator.h"

namespace atria {

/// A cell that falls short of a target, and its smallest relative measure: 0 at the limit of what is valid, below 1.
struct ShortCell
{
  Index cell;
  float worst;
};

/// Returns the cells of a region that fall short, in the region's order. The evaluator aims beyond the targets by
/// `margin`, as in OptimizerOptions; measures are relative to the targets themselves.
std::vector<ShortCell> shortCellsOf(const QualityEvaluator& evaluator, double margin, const RunContext& context);

/// Returns the cells with a marked point that fall short, in order. Throws Aborted when asked to.
std::vector<ShortCell> findShortCells(const CellSource& source, const std::vector<char>& marked,
                                      const QualityTargets& targets, const RunContext& context);

/// Keeps the measures of cells that fall short, so that cells are measured only if their points have moved. Takes 48
/// bytes for each cell that falls short.
class MeasuredCells
{
public:
  /// `strictest` must be at least as strict as all targets that are passed to shortOf().
  explicit MeasuredCells(const QualityTargets& strictest) : targets_(strictest) {}

  /// Notes cells, given in order, that have changed.
  void outdate(const std::vector<Index>& cells);
  /// Measures the cells that have changed. Linear in their number, plus marks for all cells of the mesh. Throws Aborted
  /// when asked to.
  void update(const CellSource& source, const RunContext& context);
  /// Returns the measured cells whose smallest relative measure by `targets` is below `below`, in order. `below` is at
  /// most 1.
  std::vector<ShortCell> shortOf(const QualityTargets& targets, float below = 1.0F) const;
  /// Gives the cells other numbers. `numbers` has one entry per cell: its number in another mesh, or noIndex if it is
  /// not there.
  void renumber(const std::vector<Index>& numbers);

private:
  struct Record
  {
    Index cell;
    /// Worst value of each kind of measure; infinite if it does not fall short.
    std::array<float, Measure::kinds> least;
  };
  std::vector<Record> recordsOf(const QualityEvaluator& evaluator, const RunContext& context) const;

  QualityTargets targets_;
  std::vector<Record> records_; ///< in the order of cells
  std::vector<Index> outdated_;
};

} // namespace atria
