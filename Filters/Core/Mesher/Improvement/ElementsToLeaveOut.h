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

/// Where the mesh is one of several parts that overlap: what those who have the others have to agree upon.
class LeaveOutExchange
{
public:
  virtual ~LeaveOutExchange() = default;
  /// Whether an element is so near to own ones that it is looked at; and is one.
  virtual bool isSeen(Index element) const = 0;
  virtual bool isOwn(Index element) const = 0;
  /// The sum of all parts.
  virtual std::size_t sum(std::size_t own) = 0;
  /// Of own elements in order, with what others say of theirs that are here, too.
  virtual std::vector<Index> all(const std::vector<Index>& own) = 0;
};
std::vector<Index> findElementsToLeaveOut(const DualMesh& mesh, const std::vector<Index>& failing, bool sidesToo,
                                          LeaveOutExchange& exchange, const RunContext& context);

} // namespace atria
