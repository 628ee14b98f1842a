// SPDX-License-Identifier: GPL-3.0-or-later
/// From the model as read to the model in the grid: domain, terrain, alignment.
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

/// What the grid stands along.
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
  /// Corners of the domain seen from above, in the model's x and y; see PlacedPrism. Where there are some the mode says
  /// only where bottom and top are, and the domain has neither other sides nor an angle.
  std::vector<Vec2> polygon;
  /// Degrees by which the domain stands turned (see Placement): given bounds about their middle; from surfaces and site
  /// it is the smallest box along the turned axes. Not in mode `automatic`.
  double domainAngle = 0.0;
  /// Direction in which the wind blows, in mode `automatic`; see Placement.
  double windAngle = 0.0;
  std::string site = "Site";
  /// Pattern; see terrainSurfaces.
  std::string terrain;
  GridAlignment alignment = GridAlignment::axes;
  /// Names of more surfaces that are ground, as the model's file says; see groundOf.
  std::vector<std::string> grounds;
  /// Part of its height that a body may be above the ground to be let down to it; see groundModel. 0 lets down none.
  double groundSnapRatio = 0.25;
  /// Height of the ground; that of the lowest ground surface, or of the lowest point, where nothing is given.
  std::optional<double> floor;
};

/// How exactly points are taken for one, against the finest octant.
inline constexpr double weldRatio = 1e-5;

/// Domain and ground of a model.
struct SitePlan
{
  PlacedPrism domain;
  Placement grid;
  SurfaceFlags isTerrain;
  /// Terrain, or the site: what is no building.
  SurfaceFlags isGround;
  bool hasTerrain = false;
  /// As WindDomain; 1 in other modes.
  double widened = 1.0;
  /// As in SiteOptions.
  std::optional<double> floor;

  /// Whether the domain's upright sides are surfaces, not planes of the grid.
  bool hasSheetSides() const { return !domain.isBox() || grid.angle() != domain.axes.angle(); }
};

/// The domain, as the options say, and how the grid stands. Where there is a terrain, the domain's bottom is lowered to
/// two of the largest octants below it, so that the bottom cuts nothing. Throws Error where the options cannot be met.
SitePlan planSite(const TriangleSurface& surface, const SiteOptions& options, const GridOptions& sizes);

/// A model in the grid's coordinates: terrain extended, and where the domain is no box along the grid, cut to it and
/// closed by sides (see TurnedSides.h).
struct PlacedModel
{
  TriangleSurface surface;
  GridFrame frame;
  TerrainOutline terrain;
  /// What surfaces share on sides of the domain that are no planes of the grid.
  std::vector<SharedArea> sharedOnSides;
};

/// `sizes.domain` is not used.
PlacedModel placeModel(const TriangleSurface& surface, const SitePlan& plan, const GridOptions& sizes);

/// For a frame that is given, such as that of an octree made before: its lattice is fitted to the surface.
PlacedModel placeModel(const TriangleSurface& surface, const SiteOptions& options, const GridFrame& frame);

/// Ground surfaces by the options; those that fit no name are none. Those of `grounds` are terrain where they are not
/// level and cover half of the model's rectangle.
SitePlan groundOf(const TriangleSurface& surface, const SiteOptions& options, double sizeMin);

} // namespace atria
