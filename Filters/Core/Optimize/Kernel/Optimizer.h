// SPDX-License-Identifier: GPL-3.0-or-later
/// Moves points until the cells around them are valid and good.
#pragma once

#include "Optimize/Kernel/MeasuredCells.h"
#include "Optimize/Kernel/PointSearch.h"

namespace atria {

struct OptimizerOptions : SearchRules
{
  QualityTargets targets;
  /// Share of the distance from limit to target by which the optimizer aims beyond the targets. Points within a
  /// hundredth of the aim do not move, by the default of leastPenalty.
  double margin = 0.03;
  /// Largest number of passes over the points whose cells fall short of the targets.
  int sweeps = 20;
  /// True to make passes until no point is left to search, and to search points however often they found no better
  /// position. Otherwise passes end when few points still move.
  bool patient = false;
  /// Number of rings of cells around those that fall short whose points may move, too.
  int rings = 0;
  /// True if no metric of LeastMetrics may get worse than its worst value in the region before.
  bool keepWorst = false;
  /// True to report progress from 0 to 1.
  bool tellProgress = false;
  /// Largest length of a point's first step, as a share of the cells' size.
  double firstReach = 0.1;
};

/// Improves cells that fall short of the targets by moving points: those of `cells`, and of `options.rings` rings of
/// cells around them. Points move one after the other, each to where the penalty of the cells around it is smaller.
/// Their worst measure does not get worse, unless it is poor already; see SearchRules. `points` are those of the
/// source, which must see changes to them.
///
/// Returns the cells that fall short afterwards, in order: all of those around points that could move, and the rest of
/// `cells` as they were passed. All other cells keep their shape. `changed`, if given, is set to the cells around
/// points that moved, in order; it stays as it is if no point may move. Points that depend on each other are moved in a
/// fixed order, so that the result has the same bits for any number of threads. Throws Aborted when asked to.
std::vector<ShortCell> optimize(const CellSource& source, std::vector<Vec3>& points,
                                const std::vector<ShortCell>& cells, VertexConstraints& constraints,
                                const OptimizerOptions& options, const RunContext& context,
                                std::vector<Index>* changed = nullptr);

/// A point and the position that it should have.
struct WantedPlace
{
  Index point;
  Vec3 place;
};

/// Moves points toward the positions that they should have, one after the other, by all of the way, 1/2, 1/4 or 1/8.
/// The worst measure around a point does not fall below `least` (ShortCell::worst), or below its present value if that
/// is smaller. Points must be leaders, in rising order. Returns the cells around points that moved that fall short
/// afterwards; sets `changed` to all cells around these points. Throws Aborted when asked to.
std::vector<ShortCell> approach(const CellSource& source, std::vector<Vec3>& points,
                                const std::vector<WantedPlace>& wanted, const VertexConstraints& constraints,
                                double least, const QualityTargets& targets, const RunContext& context,
                                std::vector<Index>& changed);

} // namespace atria
