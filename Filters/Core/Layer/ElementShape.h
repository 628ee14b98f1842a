// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Mesh/DualMesh.h"

namespace atria {

/// How sound one element is, by the definitions of Quality/Geometry.h and Quality/Metrics.h.
struct ElementShape
{
  double volume = 0.0;
  /// The smallest pyramid from a face to the centroid; negative where the element is not valid.
  double pyramid = 0.0;
  /// The least cosine between a face's normal and the way to it from the centroid: 1 minus the cell squish. It has the
  /// sign of `pyramid`; -1 where there is no volume.
  double cosine = -1.0;
};

ElementShape shapeOf(const std::vector<Vec3>& points, const std::array<Index, 8>& corners);

} // namespace atria
