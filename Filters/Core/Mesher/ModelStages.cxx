// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/ModelStages.h"

#include "Domain/Domain.h"
#include "Domain/DomainCheck.h"
#include "Mesher/ModelOpenings.h"
#include "Mesher/ModelRepair.h"
#include "Octree/Sizing/SizeRules.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <utility>

namespace atria {

namespace {

/// Width of gaps that are closed if no tolerance is given, over SizeMin.
constexpr double gapRatio = 0.05;

GridOptions sizesOf(const ModelOptions& options)
{
  GridOptions sizes = options.sizes;
  sizes.finestAsked = finestSizeOf(options.sizing);
  return sizes;
}

/// Lowers the root cube, where there is room, so that the octants of SizeMin on the domain's bottom are the third in
/// blocks of four. Families of octants are refined in such blocks, and so they end one octant above those at the
/// ground.
void lowerRoot(PlacedModel& placed)
{
  GridFrame& frame = placed.frame;
  const double size = frame.sizeOf(frame.featureLevel);
  const auto place = static_cast<std::int64_t>(std::floor((frame.domain.min[2] - frame.origin[2]) / size));
  const double lower = static_cast<double>((6 - place % 4) % 4) * size;
  if (frame.origin[2] - lower + frame.rootSize() >= frame.domain.max[2] + 0.5 * frame.finestSize)
  {
    frame.origin[2] -= lower;
    fitLattice(frame, boundsOf(placed.surface));
  }
}

void setKind(SurfaceKind kind, const std::vector<std::string>& patterns, const std::vector<std::string>& names,
             std::vector<SurfaceKind>& kinds)
{
  const char* purpose = kind == SurfaceKind::faceZone ? "which is to be a face zone" : "which is to be a cell zone";
  for (const std::string& pattern : patterns)
  {
    kinds.resize(names.size(), SurfaceKind::wall);
    const std::vector<char> matching = matchingSurfaces(pattern, names, purpose);
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (matching[i] && kinds[i] != SurfaceKind::wall && kinds[i] != kind)
      {
        throw Error("surface '" + names[i] + "' is requested as both a face zone and a cell zone");
      }
      kinds[i] = matching[i] ? kind : kinds[i];
    }
  }
}

/// Returns the kind of each surface; empty if all are walls.
std::vector<SurfaceKind> kindsOf(const std::vector<std::string>& names, const ModelOptions& options)
{
  std::vector<SurfaceKind> kinds;
  setKind(SurfaceKind::faceZone, options.faceZones, names, kinds);
  setKind(SurfaceKind::cellZone, options.cellZones, names, kinds);
  return kinds;
}

/// Adds areas to the entries of the same two surfaces. Entries are sorted by `gives` and then by `keeps`.
void addShared(const std::vector<SharedArea>& some, std::vector<SharedArea>& to)
{
  const auto pairOf = [](const SharedArea& shared) { return std::pair(shared.gives, shared.keeps); };
  for (const SharedArea& shared : some)
  {
    const auto at = std::ranges::lower_bound(to, pairOf(shared), {}, pairOf);
    if (at == to.end() || pairOf(*at) != pairOf(shared))
    {
      to.insert(at, shared);
      continue;
    }
    at->area += shared.area;
    at->equalArea += shared.equalArea;
    at->openedArea += shared.openedArea;
  }
}

SizingOptions alongGrid(SizingOptions sizing, const Placement& grid)
{
  for (RefinementBox& box : sizing.boxes)
  {
    box.bounds = boundsAlong(grid, PlacedPrism(PlacedBox{{}, box.bounds}));
  }
  return sizing;
}

} // namespace

GroundedInput groundModel(const TriangleSurface& surface, const ModelOptions& options, std::optional<double> bottom)
{
  GroundRules rules{options.sizes.sizeMin, bottom, SurfaceFlags(surface.names.size(), 0)};
  for (const std::vector<std::string>* patterns : {&options.faceZones, &options.cellZones})
  {
    for (const std::string& pattern : *patterns)
    {
      const std::vector<char> matching = matchingNames(pattern, surface.names);
      std::ranges::transform(rules.asDrawn, matching, rules.asDrawn.begin(), std::bit_or<>());
    }
  }
  GroundedModel grounded = groundModel(surface, options.site, rules);
  GroundedInput out{std::move(grounded.surface), options, std::move(grounded.report)};
  out.options.site = std::move(grounded.site);
  return out;
}

SitePlan planSite(const TriangleSurface& surface, const ModelOptions& options)
{
  return planSite(surface, options.site, sizesOf(options));
}

std::vector<std::string> checkDomain(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options)
{
  // A polygon counts as a given domain, whatever its heights follow from.
  const DomainMode mode = options.site.polygon.empty() ? options.site.mode : DomainMode::bounds;
  std::vector<std::string> warnings = checkDomain(surface, plan, mode, options.sizes.sizeMin);
  if (const double width = narrowestSide(plan.domain); width < std::numbers::sqrt2 * options.sizes.sizeMax)
  {
    std::ostringstream text;
    text << "sides of the domain are as narrow as " << width
         << " m, so that some may lie between elements and have no face: give it fewer sides (DomainSides), or a "
            "SizeMax of less than 0.7 of that";
    warnings.push_back(text.str());
  }
  return warnings;
}

PlacedModel placeModel(const TriangleSurface& surface, const SitePlan& plan, const ModelOptions& options)
{
  PlacedModel placed = placeModel(surface, plan, sizesOf(options));
  if (options.sizing.hexahedra)
  {
    lowerRoot(placed);
  }
  return placed;
}

PlacedModel placeModel(const TriangleSurface& surface, const ModelOptions& options)
{
  const GroundedInput grounded = groundModel(surface, options);
  return placeModel(grounded.surface, planSite(grounded.surface, grounded.options), grounded.options);
}

SurfaceModel makeSurfaceModel(const PlacedModel& placed, const ModelOptions& options, const RunContext& context)
{
  const double size = placed.frame.sizeOf(placed.frame.featureLevel);
  FeatureOptions features;
  features.featureAngle = options.featureAngle;
  features.weldDistance = weldRatio * size;
  features.sideDistance = coincidentRatio * size;
  features.gapTolerance = options.gapTolerance.value_or(gapRatio * size);
  features.smallPartSize = options.smallPartSize;
  features.keptSurfaces = surfacesOfRules(placed.surface.names, options.sizing);
  features.kinds = kindsOf(placed.surface.names, options);
  features.finerPlaces = finerPlaces(placed.surface, placed.frame, alongGrid(options.sizing, placed.frame.placement));
  SurfaceModel model =
      makeSurfaceModel(placed.surface, placed.frame, features, options.findOpenings ? context.part(0.0, 0.5) : context);
  if (options.findOpenings)
  {
    model = withOpenings(std::move(model), placed, features, options, context.part(0.5, 1.0));
  }
  addShared(placed.sharedOnSides, model.repair.shared);
  return model;
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

SurfaceRepairReport reportRepair(const TriangleSurface& surface, const ModelOptions& options, const RunContext& context)
{
  return makeSurfaceModel(placeModel(surface, options), options, context).repair;
}

} // namespace atria
