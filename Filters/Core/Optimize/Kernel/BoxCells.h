// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells seen to be good without measuring them: boxes among boxes, as there are many at walls along the grid.
#pragma once

#include "Optimize/Kernel/CellSource.h"
#include "Optimize/Kernel/QualityTargets.h"

namespace atria {

/// Of some cells those that are not seen to be good, in the same order. Looks at lengths of boxes only, so it costs a
/// small part of judging them.
std::vector<Index> cellsToEvaluate(const CellSource& source, const std::vector<Index>& cells,
                                   const QualityTargets& targets, const RunContext& context);

} // namespace atria
