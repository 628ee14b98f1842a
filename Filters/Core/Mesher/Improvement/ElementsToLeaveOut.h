// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds elements that no place of their points makes valid. They are left out of the mesh.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Support/RunContext.h"

namespace atria {

/// Returns the elements to leave out, sorted. Candidates are wall elements that fail checkMesh also after the writer
/// has merged faces and cells (uniteAndJudge): those of `failing`, which must be sorted, and those with several faces
/// on one side of a surface. Neighbors are added while that lowers the number of failures. An example is the tip of a
/// wedge between two walls, where elements have neighbors on two axes only, or are concave. Faces behind elements left
/// out become the wall's. If nothing else helps and `sidesToo` is true, elements at sides of the domain are candidates,
/// too; the sides then have notches. O(boundary faces + elements visited).
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
