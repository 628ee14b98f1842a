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

/// Agrees with the processes that have other parts of the mesh. Parts overlap. This class is that of a process that has
/// the whole mesh.
class LeaveOutExchange
{
public:
  virtual ~LeaveOutExchange() = default;
  /// True if an element is so near to own ones that it is considered.
  virtual bool isSeen(Index /*element*/) const { return true; }
  virtual bool isOwn(Index /*element*/) const { return true; }
  /// Returns the sum over all processes.
  virtual std::size_t sum(std::size_t own) { return own; }
  /// Returns own elements, sorted, with those of other processes that are here, too.
  virtual std::vector<Index> all(const std::vector<Index>& own) { return own; }
};
std::vector<Index> findElementsToLeaveOut(const DualMesh& mesh, const std::vector<Index>& failing, bool sidesToo,
                                          LeaveOutExchange& exchange, const RunContext& context);

} // namespace atria
