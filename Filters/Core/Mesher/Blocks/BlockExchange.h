// SPDX-License-Identifier: GPL-3.0-or-later
/// Port through which processes that improve blocks of one mesh agree.
#pragma once

#include "Mesher/Blocks/WindowTask.h"

namespace atria {

/// Exchanges results with the processes that improve other blocks of the mesh. All must make the same calls. This base
/// class serves a process that improves all blocks.
class BlockExchange
{
public:
  virtual ~BlockExchange() = default;
  /// Returns the blocks that each block of the whole mesh touches. `own` has those that own blocks touch.
  virtual std::vector<std::vector<Index>> allTouching(const std::vector<std::vector<Index>>& own) { return own; }
  /// Returns the changes of points in all processes, as far as the points are here, too.
  virtual PointChanges allChanges(const PointChanges& own) { return own; }
  /// Returns the poor elements of all processes that are here, too.
  virtual std::vector<PoorElement> allPoor(const std::vector<PoorElement>& own) { return own; }
  /// True if `own` is true in any process.
  virtual bool isAny(bool own) { return own; }
};

} // namespace atria
