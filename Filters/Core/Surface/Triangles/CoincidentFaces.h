// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Which triangles of a model are there twice.
struct CoincidentFaces
{
  /// Per triangle: the earlier one that stands for it; itself where there is none.
  std::vector<Index> kept;
  std::size_t faces = 0;    ///< polygons, or single triangles of them, that an earlier one stands for
  std::size_t opposite = 0; ///< of these, those with the opposite winding, such as the back of a sheet
};

/// Finds triangles that coincide with earlier ones, whichever side is their front: polygons of the same outline,
/// however they were cut into triangles, and triangles of the same corners. `faceIds` says per triangle which polygon
/// it was cut from, ascending. Points are the same where placesOf() with a step of placeStep() says so. Triangles
/// without area stay. O(n) on average.
CoincidentFaces findCoincidentFaces(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                    std::span<const Index> faceIds);

} // namespace atria
