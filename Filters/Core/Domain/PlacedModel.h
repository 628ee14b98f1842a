// SPDX-License-Identifier: GPL-3.0-or-later
/// Places a model as read in the grid: domain, terrain, alignment.
#pragma once

#include "Domain/Terrain.h"
#include "Domain/WindDomain.h"
#include "Grid/GridFrame.h"
#include "Surface/Repair/SurfaceRepair.h"

#include <optional>

namespace atria {

enum class DomainMode : std::uint8_t
{
  surfaces, ///< the bounds of the surfaces
  bounds,   ///< given
  site,     ///< above the site surface
  automatic ///< from the buildings' height; see WindDomain.h
};

/// Axes along which the grid stands.
enum class GridAlignment : std::uint8_t
{
  axes,  ///< the model's
  walls, ///< most walls
  domain
};

struct SiteOptions
{
  DomainMode mode = DomainMode::automatic;
  /// Used in mode `bounds`.
  Box3 bounds;
  /// Upright sides of the domain: 4 of a box, else of a polygon that fills the bounds (see PlacedPrism). In mode
  /// `automatic` of other than 4 it serves wind from all around (see WindDomain.h).
  int domainSides = 4;
  /// Corners of the domain seen from above, in the model's x and y; see PlacedPrism. If there are any, the mode says
  /// only where bottom and top are, and the domain has neither other sides nor an angle.
  std::vector<Vec2> polygon;
  /// Angle of the domain in degrees (see Placement). Given bounds are turned around their middle. A domain from
  /// surfaces or site is the smallest box along the turned axes. Not in mode `automatic`.
  double domainAngle = 0.0;
  /// Direction in which the wind blows, in mode `automatic`; see Placement.
  double windAngle = 0.0;
  std::string site = "Site";
  /// Pattern of the names of terrain surfaces; see terrainSurfaces.
  std::string terrain;
  GridAlignment alignment = GridAlignment::axes;
  /// Names of more surfaces that are ground, as the model's file says; see groundOf.
  std::vector<std::string> grounds;
  /// Largest gap below a body that is let down to the ground, as a part of its height; see groundModel. 0 lets down
  /// none.
  double groundSnapRatio = 0.25;
  /// Height of the ground; if not given, that of the lowest ground surface or of the lowest point.
  std::optional<double> floor;
};

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

/// Returns the domain that the options ask for and the placement of the grid. If there is a terrain, the domain's
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
