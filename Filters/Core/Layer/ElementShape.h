// SPDX-License-Identifier: GPL-3.0-or-later
/// Volume, pyramids and squish of one element.
#pragma once

#include "Dual/Mesh/DualMesh.h"

namespace atria {

/// Quality of one element, by the definitions of Quality/Faces/Geometry.h and Quality/Checks/Metrics.h.
struct ElementShape
{
  double volume = 0.0;
  /// Volume of the smallest pyramid from a face to the centroid; negative if the element is not valid.
  double pyramid = 0.0;
  /// Smallest cosine between a face's normal and the vector to it from the centroid: 1 minus the cell squish. It has
  /// the sign of `pyramid`; -1 if there is no volume.
  double cosine = -1.0;
};

ElementShape shapeOf(const std::vector<Vec3>& points, const std::array<Index, 8>& corners);

} // namespace atria
