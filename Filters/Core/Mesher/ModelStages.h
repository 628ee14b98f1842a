// SPDX-License-Identifier: GPL-3.0-or-later
/// The stages from a model to sized octants: ground, domain, grid, repair, sizes.
#pragma once

#include "Domain/GroundedModel.h"
#include "Mesher/ModelOptions.h"
#include "Octree/Sizing/Estimate.h"
#include "Octree/Sizing/Refinement.h"

namespace atria {

/// A model on its ground. All later stages take it in place of the model and the options.
struct GroundedInput
{
  TriangleSurface surface;
  ModelOptions options;
  GroundReport report;
};

/// Puts a model on its ground; see groundModel in Domain/GroundedModel.h. Face and cell zones stay as drawn. `bottom`
/// is the bottom of given octants.
GroundedInput groundModel(const TriangleSurface& surface, const ModelOptions& options,
                          std::optional<double> bottom = {});

/// Plans domain and ground; see planSite.
SitePlan planSite(const TriangleSurface& surface, const ModelOptions& options);

/// Returns warnings about the domain; see checkDomain in Domain/DomainCheck.h. Throws Error if it holds nothing of the
/// model.
std::vector<std::string> checkDomain(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options);

/// Places the model in the grid of a plan. Throws Error if sizes and domain do not fit.
PlacedModel placeModel(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options);

/// Places the model, on its ground, in its grid. Throws Error if the options cannot be met.
PlacedModel placeModel(const TriangleSurface& surface, const ModelOptions& options);

/// Returns the model on the lattice, repaired, with its features; see makeSurfaceModel. Throws Error for patterns that
/// match no surface, and for surfaces that are to be zones of both kinds.
SurfaceModel makeSurfaceModel(const PlacedModel& placed, const ModelOptions& options, const RunContext& context);

/// Sizes octants; see sizeOctants. In a turned grid a refinement box becomes the box along the grid's axes that holds
/// it.
SizedOctants sizeOctants(const SurfaceModel& model, const GridFrame& frame, const ModelOptions& options,
                         const RunContext& context);

/// Estimates the elements of the mesh; see estimateElements.
MeshEstimate estimateElements(const SurfaceModel& model, const GridFrame& frame, const ModelOptions& options,
                              const RunContext& context);

} // namespace atria
