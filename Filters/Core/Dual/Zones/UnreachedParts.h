// SPDX-License-Identifier: GPL-3.0-or-later
/// Leaves aside what no air that is meshed can reach, such as rafters in a roof.
#pragma once

#include "Dual/Zones/ModelViews.h"
#include "Dual/Zones/ZoneEnclosures.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// What of a model the mesh cannot touch.
struct UnreachedParts
{
  /// By triangle of the model; empty where air may reach all of them.
  std::vector<char> isUnreached;
  /// By triangle, if there are any.
  std::vector<TriangleViews> views;

  bool any() const { return !isUnreached.empty(); }
};

/// Finds the walls that see the inside of solids, or what is under the ground, on both of their sides. Sides that no
/// edge of the grid sees, as the insides of thin beams, are so inside of closed bodies; others are looked at by rays.
///
/// Walls of closed rooms are not among them: a room may be wanted by a seed. Nor is what lies on sides of the domain,
/// or what leaves an edge of other triangles open without it. \param crossings  Of the octree's own grid: moves of grid
/// points open no way into solids. \param ofZone     Views of zones, see viewsOfZones(). Parameters otherwise as of
/// findModelViews().
UnreachedParts findUnreachedParts(const Crossings& crossings, const GridPlaces& grid, const Zones& zones,
                                  const std::vector<View>& ofZone, const SolidPlaces& solids, const ViewShare& share,
                                  const MeshingContext& context);

/// A model without its unreached parts, the octree whose leaves hold it, and a tree to search it.
class ReachedModel
{
public:
  /// Finds features anew: where a beam met a slab from within, the slab is one chart.
  ReachedModel(const UnreachedParts& parts, const MeshingContext& context);

  MeshingContext in(const RunContext& run) const { return {run, octree_, model_, tree_}; }
  /// To be freed when only its frame is needed any more.
  Octree& octree() { return octree_; }

private:
  SurfaceModel model_;
  Octree octree_;
  TriangleTreeOnDemand tree_;
};

} // namespace atria
