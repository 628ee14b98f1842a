// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/MeshModel.h"

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
  static_cast<DualMeshResult&>(out) = makeDualMesh(sources->octree, sources->model, options.mesh, clock, context);
  out.names = sources->model.names;
  out.repair = sources->model.repair;
  out.maximumLevel = sources->octree.maximumLevel();
  out.stages = clock.stages();
  out.sources = std::move(sources);
  return out;
}

} // namespace

MeshedModel meshModel(const TriangleSurface& surface, const MesherOptions& options, const RunContext& context,
                      bool keepSources)
{
  StageClock clock;
  auto sources = std::make_unique<MeshSources>();
  std::string warning;
  {
    context.progress.report(0.0, "Repairing surfaces");
    const PlacedModel placed = placeModel(surface, options);
    sources->model = makeSurfaceModel(placed, options, context.part(0.0, 0.05));
    clock.lap("surface");
    const SizedOctants sized = sizeOctants(sources->model, placed.frame, options, context.part(0.05, 0.25));
    warning = sized.warning;
    sources->octree = buildOctree(sources->model, placed.frame, sized, context.part(0.25, octreeShare));
    clock.lap("octree");
  }
  MeshedModel out = meshOctree(std::move(sources), options, clock, context.part(octreeShare, 1.0));
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

} // namespace atria
