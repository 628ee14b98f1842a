// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Repair/ClusterCells.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <vector>

namespace atria {

struct SmallPartOptions
{
  /// Parts with a bounding box of a shorter diagonal are small, in edges of octants at features; 0 looks for none.
  double size = 0.0;
  /// In lattice units: what is this near belongs together.
  double gapTolerance = 0.0;
  /// Surfaces, by number, of which no part is small.
  std::vector<char> keptSurfaces;
  std::vector<FinerPlace> finerPlaces;
};

/// Marks the triangles of parts, connected by common points, that are too small to be seen at their place's size.
///
/// Small parts closer together than a quarter of an octant count as one, so that the leaves of a tree or the letters of
/// a text, which together are large, stay. So do those that touch a boundary edge of what stays: they may close a hole
/// in it. O(n log n).
std::vector<char> findSmallParts(const TriangleSoup& soup, const GridFrame& frame, const SmallPartOptions& options,
                                 const RunContext& context);

} // namespace atria
