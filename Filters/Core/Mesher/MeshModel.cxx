// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/MeshModel.h"

#include "Domain/DomainCheck.h"
#include "Dual/Zones/CellZones.h"
#include "Layer/LayerBudget.h"
#include "Octree/Tree/Balance.h"

namespace atria {

namespace {

/// The part of the run that is over when there is an octree.
constexpr double octreeShare = 0.4;

MeshedModel meshOctree(std::unique_ptr<MeshSources> sources, const MesherOptions& options, StageClock& clock,
                       const RunContext& context)
{
  checkLayerBudget(sources->octree, sources->model, options.mesh.layers, options.sizing.memoryLimit, context);
  MeshedModel out;
  DualMeshOptions mesh = options.mesh;
  mesh.rooms.sidesAreWalls = options.site.mode == DomainMode::surfaces;
  static_cast<DualMeshResult&>(out) = makeDualMesh(sources->octree, sources->model, mesh, clock, context);
  out.inputWarnings = warningsOfEmptyCellZones(out.mesh.cellZones, sources->model);
  out.names = sources->model.names;
  out.kinds = sources->model.kinds;
  out.repair = sources->model.repair;
  out.maximumLevel = sources->octree.maximumLevel();
  out.stages = clock.stages();
  out.sources = std::move(sources);
  return out;
}

/// Throws Error where the domain of a frame holds nothing of the model. What else there is to say of it whoever made
/// the octants has been told.
void checkHoldsModel(const TriangleSurface& surface, const SiteOptions& options, const GridFrame& frame)
{
  const double sizeMin = frame.sizeOf(frame.featureLevel);
  SitePlan plan = groundOf(surface, options, sizeMin);
  plan.domain = frame.turnedDomain.value_or(PlacedBox{frame.placement, frame.domain});
  checkDomain(surface, plan, DomainMode::bounds, sizeMin);
}

} // namespace

MeshedModel meshModel(const TriangleSurface& surface, const MesherOptions& options, const RunContext& context,
                      bool keepSources)
{
  StageClock clock;
  auto sources = std::make_unique<MeshSources>();
  const SitePlan plan = planSite(surface, options);
  const std::vector<std::string> inputWarnings = checkDomain(surface, plan, options);
  std::string warning;
  {
    context.progress.report(0.0, "Repairing surfaces");
    const PlacedModel placed = placeModel(surface, plan, options);
    sources->model = makeSurfaceModel(placed, options, context.part(0.0, 0.05));
    clock.lap("surface");
    const SizedOctants sized = sizeOctants(sources->model, placed.frame, options, context.part(0.05, 0.25));
    warning = sized.warning;
    sources->octree = buildOctree(sources->model, placed.frame, sized, context.part(0.25, octreeShare));
    clock.lap("octree");
  }
  MeshedModel out = meshOctree(std::move(sources), options, clock, context.part(octreeShare, 1.0));
  out.inputWarnings.insert(out.inputWarnings.begin(), inputWarnings.begin(), inputWarnings.end());
  out.sizingWarning = std::move(warning);
  if (!keepSources)
  {
    out.sources.reset();
  }
  return out;
}

MeshedModel meshModel(const TriangleSurface& surface, OctreeSets octants, const MesherOptions& options,
                      const RunContext& context)
{
  StageClock clock;
  auto sources = std::make_unique<MeshSources>();
  {
    context.progress.report(0.0, "Repairing surfaces");
    checkHoldsModel(surface, options.site, octants.frame);
    const PlacedModel placed = placeModel(surface, options.site, octants.frame);
    sources->model = makeSurfaceModel(placed, options, context.part(0.0, 0.1));
    clock.lap("surface");
    context.progress.report(0.1, "Balancing");
    balance(octants.refined, placed.frame, context.part(0.1, 0.2));
    sources->octree = Octree(placed.frame, octants.refined);
    locateModel(sources->octree, sources->model, context.part(0.2, octreeShare));
    clock.lap("octree");
  }
  MeshedModel out = meshOctree(std::move(sources), options, clock, context.part(octreeShare, 1.0));
  out.sources.reset();
  return out;
}

std::size_t estimateLayerElements(const TriangleSurface& surface, const MesherOptions& options,
                                  const RunContext& context)
{
  const PlacedModel placed = placeModel(surface, options);
  const SurfaceModel model = makeSurfaceModel(placed, options, context.part(0.0, 0.2));
  const SizedOctants sized = sizeOctants(model, placed.frame, options, context.part(0.2, 0.6));
  const Octree octree = buildOctree(model, placed.frame, sized, context.part(0.6, 1.0));
  return elementsWithLayers(octree, model, options.mesh.layers, context) -
         elementsWithLayers(octree, model, {}, context);
}

} // namespace atria
