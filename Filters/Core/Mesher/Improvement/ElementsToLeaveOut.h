// SPDX-License-Identifier: GPL-3.0-or-later
/// The last resort: elements that no place of their points makes valid.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Support/RunContext.h"

namespace atria {

/// Of elements that fail, in order, and of those with several faces on one side of a surface, those at walls that
/// checkMesh objects to as they are written, too (see uniteAndJudge), and what else has to go with them for less to
/// fail, in order; what is beside them is at the wall then. Such are the tips of wedges between two walls: whatever is
/// in them has neighbors on two axes only, or is concave. Where that does not help and `sidesToo`, also those at sides
/// of the domain, which have notches then. O(boundary faces + elements looked at).
std::vector<Index> findElementsToLeaveOut(const DualMesh& mesh, const std::vector<Index>& failing, bool sidesToo,
                                          const RunContext& context);

} // namespace atria
