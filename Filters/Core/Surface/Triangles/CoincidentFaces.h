// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Which triangles of a model are there twice.
struct CoincidentFaces
{
  /// Per triangle: the one that stands for it; itself where there is none.
  std::vector<Index> kept;
  /// Per triangle that another one stands for: whether only their order says which. Empty where there is none.
  std::vector<char> isByOrder;
  std::size_t faces = 0;    ///< polygons, or single triangles of them, that another one stands for
  std::size_t opposite = 0; ///< of these, those with the opposite winding, such as the back of a sheet
};

/// Finds triangles that coincide with others, whichever side is their front: polygons of the same outline, however they
/// were cut into triangles, and triangles of the same corners. `faceIds` says per triangle which polygon it was cut
/// from, ascending. One of a surface stays where FacePrecedence says so; of one surface, or without `surfaceIds`, the
/// first. Faces of two solids that touch both stay, if the solids are closed and wound alike: see WoundSolids. Points
/// are the same where placesOf() with a step of placeStep() says so. Triangles without area stay. O(n) on average.
CoincidentFaces findCoincidentFaces(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                    std::span<const Index> faceIds, std::span<const Index> surfaceIds = {});

} // namespace atria
