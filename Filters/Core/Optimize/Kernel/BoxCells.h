// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds cells that are good without measuring them: boxes among boxes, as there are many at walls along the grid.
#pragma once

#include "Optimize/Kernel/CellSource.h"
#include "Optimize/Kernel/QualityTargets.h"

namespace atria {

/// Returns those of `cells` that are not seen to be good, in the same order. It compares lengths of boxes only, which
/// costs a small part of judging cells. Throws Aborted when asked to.
std::vector<Index> cellsToEvaluate(const CellSource& source, const std::vector<Index>& cells,
                                   const QualityTargets& targets, const RunContext& context);

} // namespace atria
