// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds faces that a model has twice.
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Triangles that a model has twice.
struct CoincidentFaces
{
  /// One entry per triangle: the one that stands for it; itself if there is no other.
  std::vector<Index> kept;
  /// One flag per triangle that another one stands for: nonzero if only their order decides. Empty if there is none.
  std::vector<char> isByOrder;
  std::size_t faces = 0;    ///< number of polygons, or single triangles of them, that another one stands for
  std::size_t opposite = 0; ///< number of these with the opposite winding, such as the back of a sheet
};

/// Finds triangles that coincide with others, whichever side is their front: polygons of the same outline, however they
/// were cut into triangles, and triangles of the same corners. `faceIds` has one entry per triangle: the polygon it was
/// cut from, ascending. FacePrecedence chooses which of several surfaces keeps its triangle. Within one surface, or
/// without `surfaceIds`, the first stays. Faces of two solids that touch both stay, if the solids are closed and wound
/// alike: see WoundSolids. Points are merged as placesOf() with a step of placeStep() does. Triangles without area
/// stay. O(n) on average.
CoincidentFaces findCoincidentFaces(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                    std::span<const Index> faceIds, std::span<const Index> surfaceIds = {});

} // namespace atria
