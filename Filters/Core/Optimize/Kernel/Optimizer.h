// SPDX-License-Identifier: GPL-3.0-or-later
/// Moves points until the cells about them are valid and good.
#pragma once

#include "Optimize/Kernel/MeasuredCells.h"
#include "Optimize/Kernel/PointSearch.h"

namespace atria {

struct OptimizerOptions : SearchRules
{
  QualityTargets targets;
  /// By which share of the way from limit to target to aim beyond the targets: points are not moved for what is within
  /// a hundredth of the aim.
  double margin = 0.03;
  /// Passes over the points whose cells fall short of the targets.
  int sweeps = 20;
  /// Whether the last few points that creep on are waited for, and points are tried again however often they found no
  /// better place.
  bool patient = false;
  /// Rings of cells about one that falls short whose points may move with its own.
  int rings = 0;
  /// Whether no metric of LeastMetrics may get worse than it was in the worst of the cells looked at.
  bool keepWorst = false;
  /// Whether progress from 0 to 1 is told.
  bool tellProgress = false;
  /// How far a point is moved at first, as a part of the cells' size.
  double firstReach = 0.1;
};

/// Improves cells that fall short of the targets by moving points, those of the cells and of `rings` of cells about
/// them, one after the other, each to where the penalty of the cells about it is less and their worst, unless it is bad
/// already, no worse. `points` are those of the source, which must see changes to them. Returns those of
/// `cells` and of all cells about moved points that fall short then, in order; other cells are as before. The same bits
/// for any number of threads: points that depend on each other are moved in a fixed order. `changed`, if it is given,
/// gets the cells about points that moved, in order.
std::vector<ShortCell> optimize(const CellSource& source, std::vector<Vec3>& points,
                                const std::vector<ShortCell>& cells, VertexConstraints& constraints,
                                const OptimizerOptions& options, const RunContext& context,
                                std::vector<Index>* changed = nullptr);

/// Where a point ought to be.
struct WantedPlace
{
  Index point;
  Vec3 place;
};

/// Moves points towards where they ought to be, one after the other, each as far as no cell about it falls below
/// `least` (see ShortCell) or, where one is below already, further. Points must be leaders, in rising order. Returns
/// the cells about those that moved that fall short then; `changed` gets all cells about them.
std::vector<ShortCell> approach(const CellSource& source, std::vector<Vec3>& points,
                                const std::vector<WantedPlace>& wanted, const VertexConstraints& constraints,
                                double least, const QualityTargets& targets, const RunContext& context,
                                std::vector<Index>& changed);

} // namespace atria
