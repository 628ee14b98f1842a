// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// A triangle that bridges a crack.
struct StripTriangle
{
  /// Wound as the boundary edge's triangle is.
  std::array<LatticePoint, 3> corners;
  /// The triangle of the model whose free edge it goes on from.
  Index boundaryEdge;
};

/// Bridges gaps beside boundary edges that are no wider than `tolerance` times the edge of the leaf there, by strips
/// from the boundary edge to what is across.
///
/// Along the boundary edge, in steps of a quarter of an octant, the nearest place of the rest of the model is looked
/// for in the direction in which the boundary edge's triangle would go on, to 45 degrees; or of a domain side. It must
/// be nearest among all that is connected there, so that the two sides of an opening's corner, at 45 degrees or more,
/// are no crack. The strip goes from step to step where both are within the tolerance, without a break, and round the
/// points where two boundary edges meet. Both boundary edges of a crack have their strip. The result does not depend on
/// threads; nothing is done without boundary edges.
std::vector<StripTriangle> crackStrips(double tolerance, const MeshingContext& context);

} // namespace atria
