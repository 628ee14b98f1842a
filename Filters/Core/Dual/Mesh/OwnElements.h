// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides the elements of a mesh among the processes that make it, so that sums count each element once.
#pragma once

#include "Support/RankExchange.h"
#include "Support/Types.h"

#include <functional>

namespace atria {

/// The elements that a process owns of a mesh that it makes with others. The default owns all.
struct OwnElements
{
  /// Empty if all elements are own ones.
  std::function<bool(Index element)> isOwn;
  /// All processes add up at the same time.
  RankExchange& exchange = alone();

  bool owns(Index element) const { return !isOwn || isOwn(element); }
  bool isWhole() const { return exchange.ranks() == 1; }
};

} // namespace atria
