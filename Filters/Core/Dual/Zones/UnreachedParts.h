// SPDX-License-Identifier: GPL-3.0-or-later
/// Removes the parts of a model that no meshed air can reach, such as rafters in a roof.
#pragma once

#include "Dual/Zones/ModelViews.h"
#include "Dual/Zones/ZoneEnclosures.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// Parts of a model that the mesh cannot touch.
struct UnreachedParts
{
  /// One entry per triangle of the model; empty if air may reach all of them.
  std::vector<char> isUnreached;
  /// Views of each triangle, if there are unreached ones.
  std::vector<TriangleViews> views;

  bool any() const { return !isUnreached.empty(); }
};

/// Finds the walls that see the inside of solids, or the space under the ground, on both of their sides. Sides that no
/// edge of the grid sees, such as the insides of thin beams, see a solid if they are inside of closed bodies; rays
/// decide about others.
///
/// Walls of closed rooms are not among them, as a seed may request a room. Neither are triangles on sides of the
/// domain, nor triangles whose removal leaves an edge of others open. Parameters are as in findModelViews(), except:
/// \param crossings  Those of the octree's own grid: moves of grid points open no way into solids.
/// \param ofZone     Views of zones, see viewsOfZones().
UnreachedParts findUnreachedParts(const Crossings& crossings, const GridPlaces& grid, const Zones& zones,
                                  const std::vector<View>& ofZone, const SolidPlaces& solids, const GridPart& part,
                                  const MeshingContext& context);

/// A model without its unreached parts, the octree whose leaves hold its pieces, and a tree to search it.
class ReachedModel
{
public:
  /// Finds features anew, so that a slab that a beam met from within is one chart.
  ReachedModel(const UnreachedParts& parts, const MeshingContext& context);

  MeshingContext in(const RunContext& run) const { return {run, octree_, model_, tree_}; }
  /// Returns the octree, which callers may free when they need only its frame.
  Octree& octree() { return octree_; }

private:
  SurfaceModel model_;
  Octree octree_;
  TriangleTreeOnDemand tree_;
};

} // namespace atria
