// SPDX-License-Identifier: GPL-3.0-or-later
/// What users say of a model and of the octree it is meshed in, and the first stages that follow from it.
#pragma once

#include "Domain/GroundedModel.h"
#include "Octree/Sizing/Estimate.h"
#include "Octree/Sizing/Refinement.h"

#include <optional>

namespace atria {

/// Lengths are in model units; boxes and points are along the model's axes.
struct ModelOptions
{
  SiteOptions site;
  /// The domain and the finest size asked for follow from the other options.
  GridOptions sizes;
  SizingOptions sizing;
  /// Degrees between normals (creases) or tangents (corners) above which they are kept.
  double featureAngle = 30.0;
  /// Gaps narrower than this are closed; a twentieth of `sizes.sizeMin` where nothing is given.
  std::optional<double> gapTolerance;
  /// Connected parts of the model with a bounding box of a shorter diagonal than this many octants of sizeMin are left
  /// out, but for those of surfaces that rules of sizes name; 0 leaves out none. See findSmallParts.
  double smallPartSize = 1.0;
  /// Patterns of the names of surfaces one can look through, SurfaceKind::faceZone.
  std::vector<std::string> faceZones;
  /// Of closed surfaces that enclose a zone, without being walls: SurfaceKind::cellZone.
  std::vector<std::string> cellZones;
  /// Whether openings are found by rule; see withOpenings in Mesher/ModelOpenings.h.
  bool findOpenings = false;
  /// Patterns of the names of surfaces in which none are.
  std::vector<std::string> withoutOpenings;
};

/// A model on its ground: what all that follows takes in place of the model and the options.
struct GroundedInput
{
  TriangleSurface surface;
  ModelOptions options;
  GroundReport report;
};

/// See groundModel in Domain/GroundedModel.h. Zones stay as drawn. `bottom` is that of octants that are given.
GroundedInput groundModel(const TriangleSurface& surface, const ModelOptions& options,
                          std::optional<double> bottom = {});

/// Domain and ground; see planSite.
SitePlan planSite(const TriangleSurface& surface, const ModelOptions& options);

/// What a user should know of the domain; see checkDomain in Domain/DomainCheck.h. Throws Error where it holds nothing
/// of the model.
std::vector<std::string> checkDomain(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options);

/// The model in the grid that a plan says. Throws Error where sizes and domain do not fit.
PlacedModel placeModel(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options);

/// The model, on its ground, in its grid. Throws Error where the options cannot be met.
PlacedModel placeModel(const TriangleSurface& surface, const ModelOptions& options);

/// The model on the lattice, repaired, with its features; see makeSurfaceModel. Throws Error for patterns that match no
/// surface, and for surfaces that are to be zones of both kinds.
SurfaceModel makeSurfaceModel(const PlacedModel& placed, const ModelOptions& options, const RunContext& context);

/// See sizeOctants. In a turned grid a refinement box is the box along the grid's axes that holds the one given.
SizedOctants sizeOctants(const SurfaceModel& model, const GridFrame& frame, const ModelOptions& options,
                         const RunContext& context);

/// See estimateElements.
MeshEstimate estimateElements(const SurfaceModel& model, const GridFrame& frame, const ModelOptions& options,
                              const RunContext& context);

} // namespace atria
