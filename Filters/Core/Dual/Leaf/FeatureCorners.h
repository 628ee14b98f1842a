// SPDX-License-Identifier: GPL-3.0-or-later
/// Assigns the corners of the model to vertices of the mesh on feature curves.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// A vertex of the mesh on feature curves.
struct ChainVertex
{
  enum Kind : std::uint8_t
  {
    along,   ///< one curve passes
    sideEnd, ///< one curve ends on a domain side
    knot     ///< curves meet or end
  };
  /// Position among the leaves that have vertices, and the leaf.
  Index vertex;
  Index leaf;
  Kind kind;
  /// The charts that end along each different curve at the vertex (LeafTopology::Link::ending), sorted.
  std::vector<std::vector<Index>> curves;
  /// Leaves of the vertices it is linked with along them.
  std::vector<Index> links;
  /// Charts whose faces it has, sorted.
  std::vector<Index> charts;
  /// True if the octant holds no piece of the curves; set when the vertex is placed.
  bool isDiverted = false;
};

/// Returns the curves that meet at each corner of the model, by the charts that end there; sorted, without repeats.
std::vector<std::vector<std::vector<Index>>> curvesAtCorners(const SurfaceModel& model);

/// Returns the corner of the model (index into its points) that each chain vertex takes; noIndex for none. `vertices`
/// are in order of leaves. A corner goes to one vertex at most, and a vertex to one corner: the one whose curves agree
/// best and whose octant is nearest, up to 0.6 of the octant's size away.
std::vector<Index> assignCorners(const Octree& octree, const SurfaceModel& model,
                                 const std::vector<ChainVertex>& vertices);

} // namespace atria
