// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes of octants and the domain they fill.
#pragma once

#include "Support/Types.h"

#include <limits>

namespace atria {

/// The domain and the sizes for which an octree is made.
struct GridOptions
{
  Box3 domain;
  /// Edge length of octants at features, and the grid's unit: octants have sizes sizeMin * 2^j; positive.
  double sizeMin = 1.0;
  /// Size of octants that a surface passes through; at least sizeMin.
  double sizeMid = 2.0;
  /// Size of octants in the open; at least sizeMid.
  double sizeMax = 8.0;
  /// Every octant in the domain is refined at least to this level (the root is level 0).
  int startLevel = 4;
  /// The finest size requested anywhere (finestSizeOf in SizingOptions.h). Below sizeMin it adds levels to the grid.
  double finestAsked = std::numeric_limits<double>::infinity();
};

} // namespace atria
