// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds parts of a model that are too small for the mesh.
#pragma once

#include "Surface/Repair/ClusterCells.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <vector>

namespace atria {

struct SmallPartOptions
{
  /// Parts with a bounding box of a shorter diagonal are small, in edges of octants at features; 0 finds none.
  double size = 0.0;
  /// Distance up to which parts belong together, in lattice units.
  double gapTolerance = 0.0;
  /// One flag per surface: nonzero if none of its parts is small.
  std::vector<char> keptSurfaces;
  std::vector<FinerPlace> finerPlaces;
};

/// Marks the triangles of parts, connected by common points, that are smaller than `size` octants at their place.
///
/// Small parts whose boxes touch the same cell of a grid of a quarter of an octant count as one, so that the leaves of
/// a tree or the letters of a text stay, which together are large. Parts that touch a boundary edge of others that stay
/// also stay: they may close a hole. O(n log n).
std::vector<char> findSmallParts(const TriangleSoup& soup, const GridFrame& frame, const SmallPartOptions& options,
                                 const RunContext& context);

} // namespace atria
