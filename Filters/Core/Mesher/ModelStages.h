// SPDX-License-Identifier: GPL-3.0-or-later
/// The stages from a model to sized octants: ground, domain, grid, repair, sizes.
#pragma once

#include "Domain/GroundedModel.h"
#include "Mesher/ModelOptions.h"
#include "Octree/Sizing/Estimate.h"
#include "Octree/Sizing/Refinement.h"

namespace atria {

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
