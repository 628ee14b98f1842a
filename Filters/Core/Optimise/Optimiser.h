// SPDX-License-Identifier: GPL-3.0-or-later
/// Moves points until the cells about them are valid and good.
#pragma once

#include "Optimise/Judge.h"
#include "Optimise/VertexGuide.h"

namespace atria {

struct OptimiserOptions
{
  QualityTargets targets;
  /// Passes over the points whose cells fall short of the targets.
  int sweeps = 20;
  /// Rings of points about a cell that falls short that may move with its own.
  int rings = 1;
};

/// A cell that falls short of some target: its least measure, and its least but for convexity. One that is sound
/// (above 0) is valid.
struct ShortCell
{
  Index cell;
  float worst;
  float sound;
};

/// The cells about marked points that fall short, in order.
std::vector<ShortCell> findShortCells(const CellSource& source, const std::vector<char>& marked,
                                      const VertexGuide& guide, const QualityTargets& targets,
                                      const RunContext& context);

/// Improves the cells that fall short of the targets by moving points, one after the other, each to where the penalty
/// of the cells about it is less and their worst, unless it is bad already, no worse. `points` are those of the source,
/// which must see changes to them; only cells about the points marked are looked at. The same bits for any number of
/// threads: points that depend on each other are moved in a fixed order.
void optimise(const CellSource& source, std::vector<Vec3>& points, const std::vector<char>& marked, VertexGuide& guide,
              const OptimiserOptions& options, const RunContext& context);

} // namespace atria
