// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/TriangleSoup.h"

#include <functional>

namespace atria {

struct LatticeBox
{
  LatticePoint low;
  LatticePoint high;
  /// What the caller knows the box by. Boxes of equal ids are taken for one box, and make no pair.
  Index id;
};

/// The box of a triangle, `margin` wider on every side.
LatticeBox boxOf(const TriangleSoup& soup, Index triangle, std::int64_t margin);

/// Calls `visit` once for every pair of a box of `first` and a box of `second` that touch, in no certain order.
/// Sequences change their order. O(n log^3 n + pairs), by segment trees (Zomorodian and Edelsbrunner 2002).
void forBoxPairs(std::vector<LatticeBox>& first, std::vector<LatticeBox>& second,
                 const std::function<void(Index, Index)>& visit);

} // namespace atria
