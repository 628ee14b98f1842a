// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds pairs of boxes that touch, and makes boxes of triangles.
#pragma once

#include "Grid/LatticeBox.h"
#include "Support/RunContext.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <functional>

namespace atria {

struct NumberedBox : LatticeBox
{
  /// Number of the box for the caller. Boxes of equal ids count as one box, and make no pair.
  Index id;
};

/// Returns the bounds of boxes, of which there is at least one.
LatticeBox boundsOf(const std::vector<NumberedBox>& boxes);

/// Returns the box of a triangle, `margin` wider on every side.
NumberedBox boxOf(const TriangleSoup& soup, Index triangle, std::int64_t margin);

/// Returns the boxes of some triangles, in their order.
std::vector<NumberedBox> boxesOf(const TriangleSoup& soup, const std::vector<Index>& triangles, std::int64_t margin,
                                 const RunContext& context);

/// Calls `visit` once for every pair of a box of `first` and a box of `second` that touch, in no certain order. O(n log
/// n + pairs) if boxes of one size do not cluster (BoxTree).
void forBoxPairs(const std::vector<NumberedBox>& first, const std::vector<NumberedBox>& second,
                 const RunContext& context, const std::function<void(Index, Index)>& visit);

} // namespace atria
