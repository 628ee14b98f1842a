// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/Blocks/WindowTask.h"

namespace atria {

/// Where blocks of one mesh are on several ranks: what these tell each other. All make the same calls.
class BlockExchange
{
public:
  virtual ~BlockExchange() = default;
  /// The blocks touched by each of all blocks, from those of own ones.
  virtual std::vector<std::vector<Index>> allTouching(const std::vector<std::vector<Index>>& own) = 0;
  /// What became of points here, for what became of them on all ranks, as far as they are here, too.
  virtual PointChanges allChanges(const PointChanges& own) = 0;
  /// The same of poor elements.
  virtual std::vector<PoorElement> allPoor(const std::vector<PoorElement>& own) = 0;
  /// Whether something is so on any of them.
  virtual bool isAny(bool own) = 0;
};

/// Of a mesh that is on one.
class NoExchange : public BlockExchange
{
public:
  std::vector<std::vector<Index>> allTouching(const std::vector<std::vector<Index>>& own) override { return own; }
  PointChanges allChanges(const PointChanges& own) override { return own; }
  std::vector<PoorElement> allPoor(const std::vector<PoorElement>& own) override { return own; }
  bool isAny(bool own) override { return own; }
};

} // namespace atria
