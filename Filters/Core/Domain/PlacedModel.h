// SPDX-License-Identifier: GPL-3.0-or-later
/// Places a model as read in the grid: domain, terrain, alignment.
#pragma once

#include "Domain/SiteOptions.h"
#include "Domain/Terrain.h"
#include "Domain/WindDomain.h"
#include "Grid/GridFrame.h"
#include "Surface/Repair/SurfaceRepair.h"

#include <optional>

namespace atria {

/// Distance up to which points are merged, in sizes of the finest octant.
inline constexpr double weldRatio = 1e-5;

/// Domain and ground of a model.
struct SitePlan
{
  PlacedPrism domain;
  Placement grid;
  SurfaceFlags isTerrain;
  /// Terrain, or the site: the surfaces that are no building.
  SurfaceFlags isGround;
  bool hasTerrain = false;
  /// Same as WindDomain::widened; 1 in other modes.
  double widened = 1.0;
  /// Same as SiteOptions::floor.
  std::optional<double> floor;

  /// True if the domain's upright sides are surfaces, not planes of the grid.
  bool hasSheetSides() const { return !domain.isBox() || grid.angle() != domain.axes.angle(); }
};

/// Returns the domain that the options request and the placement of the grid. If there is a terrain, the domain's
/// bottom is lowered to two of the largest octants below it, so that the bottom cuts nothing. Throws Error if the
/// options cannot be met.
SitePlan planSite(const TriangleSurface& surface, const SiteOptions& options, const GridOptions& sizes);

/// A model in the grid's coordinates. Its terrain is extended. A domain that is no box along the grid cuts the model,
/// and sides close it (see TurnedSides.h).
struct PlacedModel
{
  TriangleSurface surface;
  GridFrame frame;
  TerrainOutline terrain;
  /// Areas that surfaces share on sides of the domain that are no planes of the grid.
  std::vector<SharedArea> sharedOnSides;
};

/// Returns the model in a new grid. `sizes.domain` is not used.
PlacedModel placeModel(const TriangleSurface& surface, const SitePlan& plan, const GridOptions& sizes);

/// Returns the model fitted to the lattice of a given frame, such as that of an octree made before.
PlacedModel placeModel(const TriangleSurface& surface, const SiteOptions& options, const GridFrame& frame);

/// Returns a plan with the ground surfaces of the options; names in `grounds` or `site` that fit no surface are
/// ignored. Surfaces of `grounds` are terrain if they are not level and cover half of the model's rectangle.
SitePlan groundOf(const TriangleSurface& surface, const SiteOptions& options, double sizeMin);

} // namespace atria
