// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/ModelOptions.h"

#include "Domain/DomainCheck.h"
#include "Octree/Sizing/SizeRules.h"

namespace atria {

namespace {

/// Gaps that are closed where nothing is said of them, against SizeMin.
constexpr double gapRatio = 0.05;

GridOptions sizesOf(const ModelOptions& options)
{
  GridOptions sizes = options.sizes;
  sizes.finestAsked = finestSizeOf(options.sizing);
  return sizes;
}

SizingOptions alongGrid(SizingOptions sizing, const Placement& grid)
{
  for (RefinementBox& box : sizing.boxes)
  {
    box.bounds = boundsAlong(grid, {Placement(), box.bounds});
  }
  return sizing;
}

} // namespace

SitePlan planSite(const TriangleSurface& surface, const ModelOptions& options)
{
  return planSite(surface, options.site, sizesOf(options));
}

std::vector<std::string> checkDomain(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options)
{
  return checkDomain(surface, plan, options.site.mode, options.sizes.sizeMin);
}

PlacedModel placeModel(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options)
{
  return placeModel(surface, plan, sizesOf(options));
}

PlacedModel placeModel(const TriangleSurface& surface, const ModelOptions& options)
{
  return placeModel(surface, planSite(surface, options), options);
}

SurfaceModel makeSurfaceModel(const PlacedModel& placed, const ModelOptions& options, const RunContext& context)
{
  const double size = placed.frame.sizeOf(placed.frame.featureLevel);
  FeatureOptions features;
  features.featureAngle = options.featureAngle;
  features.weldDistance = weldRatio * size;
  features.sideDistance = sideRatio * size;
  features.gapTolerance = options.gapTolerance.value_or(gapRatio * size);
  features.smallPartSize = options.smallPartSize;
  features.keptSurfaces = surfacesOfRules(placed.surface.names, options.sizing);
  features.finerPlaces = finerPlaces(placed.surface, placed.frame, alongGrid(options.sizing, placed.frame.placement));
  return makeSurfaceModel(placed.surface, placed.frame, features, context);
}

SizedOctants sizeOctants(const SurfaceModel& model, const GridFrame& frame, const ModelOptions& options,
                         const RunContext& context)
{
  return sizeOctants(model, frame, alongGrid(options.sizing, frame.placement), context);
}

MeshEstimate estimateElements(const SurfaceModel& model, const GridFrame& frame, const ModelOptions& options,
                              const RunContext& context)
{
  return estimateElements(model, frame, alongGrid(options.sizing, frame.placement), context);
}

} // namespace atria
