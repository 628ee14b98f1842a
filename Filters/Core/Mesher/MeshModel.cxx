// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/MeshModel.h"

#include "Domain/DomainCheck.h"
#include "Dual/Zones/CellZones.h"
#include "Layer/LayerBudget.h"
#include "Mesher/MeshPort.h"
#include "Mesher/MeshReport.h"
#include "Mesher/MeshStages.h"
#include "Mesher/StageOptions.h"
#include "Octree/Sizing/Sizing.h"

#include <algorithm>
#include <sstream>

namespace atria {

namespace {

/// Share of the run's progress that is over when there is an octree.
constexpr double octreeShare = 0.4;

/// Throws Error if the domain of a frame holds nothing of the model. All other warnings were given when the octants
/// were made.
void checkHoldsModel(const TriangleSurface& surface, const SiteOptions& options, const GridFrame& frame)
{
  const double sizeMin = frame.sizeOf(frame.featureLevel);
  SitePlan plan = groundOf(surface, options, sizeMin);
  plan.domain = frame.prism();
  checkDomain(surface, plan, DomainMode::bounds, sizeMin);
}

void makeOctree(const TriangleSurface& surface, const ModelOptions& options, ModelOctree& out, StageClock& clock,
                const RunContext& context)
{
  SizedModel sized = sizeModel(surface, options, clock, context.part(0.0, 0.625));
  out.octree = buildOctree(sized.model, sized.frame, sized.octants, context.part(0.625, 1.0));
  static_cast<PreparedModel&>(out) = std::move(sized);
  clock.lap("octree");
}

void takeOctree(const TriangleSurface& model, const OctreeSets& octants, const ModelOptions& asked, ModelOctree& out,
                StageClock& clock, const RunContext& context)
{
  context.progress.report(0.0, "Finding the ground");
  ModelOptions sized = asked;
  sized.sizes.sizeMin = octants.frame.sizeOf(octants.frame.featureLevel);
  GroundedInput grounded = groundModel(model, sized, octants.frame.domain.min[2]);
  const auto& [surface, options, ground] = grounded;
  context.progress.report(0.0, "Repairing surfaces");
  checkHoldsModel(surface, options.site, octants.frame);
  const PlacedModel placed = placeModel(surface, options.site, octants.frame);
  out.model = makeSurfaceModel(placed, options, context.part(0.0, 0.25));
  clock.lap("surface");
  context.progress.report(0.25, "Balancing");
  RefinedSets refined = octants.refined;
  balanceFor(options.sizing.hexahedra, refined, out.model, placed.frame, 1, context.part(0.25, 0.5));
  out.octree = Octree(placed.frame, refined);
  locateModel(out.octree, out.model, context.part(0.5, 1.0));
  out.maximumLevel = out.octree.maximumLevel();
  out.grounded = std::move(grounded);
  clock.lap("octree");
}

} // namespace

/// Sources of the octree.
struct OctreeInput
{
  TriangleSurface surface;
  std::optional<OctreeSets> octants;
  ModelOptions options;
};

struct StageCache::Stages
{
  std::optional<OctreeInput> input;
  std::unique_ptr<ModelOctree> octree;
  DualStages dual;

  bool isOf(const TriangleSurface& surface, const OctreeSets* octants, const ModelOptions& options) const
  {
    return octree && input && isSame(input->options, options) && isSame(input->surface, surface) &&
           input->octants.has_value() == (octants != nullptr) && (!octants || isSame(*input->octants, *octants));
  }
};

StageCache::StageCache() : stages_(std::make_unique<Stages>()) {}
StageCache::~StageCache() = default;
void StageCache::clear() { stages_ = std::make_unique<Stages>(); }
const ModelOctree* StageCache::sources() const { return stages_->octree.get(); }

namespace {

void prepareOctree(const TriangleSurface& surface, const OctreeSets* octants, const ModelOptions& options,
                   StageCache& cache, StageClock& clock, const RunContext& context)
{
  cache.clear();
  auto made = std::make_unique<ModelOctree>();
  if (octants)
  {
    takeOctree(surface, *octants, options, *made, clock, context);
  }
  else
  {
    makeOctree(surface, options, *made, clock, context);
  }
  cache.stages().octree = std::move(made);
}

MeshedModel mesh(const TriangleSurface& surface, const OctreeSets* octants, const MesherOptions& options,
                 const RunContext& context, StageCache* kept)
{
  StageClock clock;
  StageCache own;
  StageCache& cache = kept ? *kept : own;
  if (!cache.stages().isOf(surface, octants, options))
  {
    prepareOctree(surface, octants, options, cache, clock, context.part(0.0, octreeShare));
    if (kept)
    {
      cache.stages().input = {surface, octants ? std::optional(*octants) : std::nullopt, options};
    }
  }
  const ModelOctree& sources = *cache.sources();
  MeshPort port;
  return meshOctree(sources, sources.octree, options, kept ? &cache.stages().dual : nullptr, port, clock,
                    context.part(octreeShare, 1.0));
}

/// Adds a warning if elements are no hexahedra, with the place of the first.
void addOthersThanHexahedra(MeshedModel& out)
{
  const auto& corners = out.mesh.corners;
  const auto first = std::ranges::find_if_not(corners, hasAllCorners);
  if (first == corners.end())
  {
    return;
  }
  const Vec3& at = out.mesh.points[(*first)[0]];
  std::ostringstream text;
  text << std::ranges::count_if(corners, [](const auto& of) { return !hasAllCorners(of); }) << " of " << corners.size()
       << " elements are no hexahedra, where layers end; the first is at (" << at[0] << ", " << at[1] << ", " << at[2]
       << "): ask for fewer layers there, or for smaller elements";
  out.inputWarnings.push_back(text.str());
}

int finestLevel(const RefinedSets& refined)
{
  int level = 0;
  for (std::size_t above = 0; above < refined.size(); ++above)
  {
    level = refined[above].empty() ? level : static_cast<int>(above) + 1;
  }
  return level;
}

} // namespace

MeshedModel meshModel(const TriangleSurface& surface, const MesherOptions& options, const RunContext& context,
                      StageCache* cache)
{
  return mesh(surface, nullptr, options, context, cache);
}

MeshedModel meshModel(const TriangleSurface& surface, const OctreeSets& octants, const MesherOptions& options,
                      const RunContext& context, StageCache* cache)
{
  return mesh(surface, &octants, options, context, cache);
}

SizedModel sizeModel(const TriangleSurface& asRead, const ModelOptions& asked, StageClock& clock,
                     const RunContext& context)
{
  context.progress.report(0.0, "Finding the ground");
  SizedModel out;
  out.grounded = groundModel(asRead, asked);
  const auto& [surface, options, ground] = out.grounded;
  const SitePlan plan = planSite(surface, options);
  out.inputWarnings = checkDomain(surface, plan, options);
  out.inputWarnings.insert(out.inputWarnings.end(), ground.warnings.begin(), ground.warnings.end());
  context.progress.report(0.0, "Repairing surfaces");
  const PlacedModel placed = placeModel(surface, plan, options);
  out.frame = placed.frame;
  out.model = makeSurfaceModel(placed, options, context.part(0.0, 0.2));
  clock.lap("surface");
  out.octants = sizeOctants(out.model, out.frame, options, context.part(0.2, 1.0));
  out.sizingWarning = out.octants.warning;
  out.maximumLevel = finestLevel(out.octants.refined);
  return out;
}

MeshedModel meshOctree(const PreparedModel& prepared, const Octree& octree, const MesherOptions& options,
                       DualStages* kept, MeshPort& port, StageClock& clock, const RunContext& context)
{
  const SurfaceModel& model = prepared.model;
  checkLayerBudget(octree, model, options.mesh.layers, options.sizing.hexahedra, options.sizing.memoryLimit, context,
                   port.ownLeaves(octree), port.exchange());
  MeshedModel out;
  DualMeshOptions dual = options.mesh;
  dual.hexahedra = options.sizing.hexahedra;
  dual.rooms.sidesAreWalls = options.site.mode == DomainMode::surfaces;
  const GridFrame& frame = octree.frame();
  const GroundedInput& grounded = prepared.grounded;
  const DrawnModel drawn = drawnModel(grounded.surface, grounded.options.site, model.kinds, frame, context);
  static_cast<DualMeshResult&>(out) = makeDualMesh(octree, model, dual, clock, context, kept, &drawn, port);
  out.inputWarnings = prepared.inputWarnings;
  if (dual.hexahedra)
  {
    addOthersThanHexahedra(out);
  }
  out.sizingWarning = prepared.sizingWarning;
  out.maximumLevel = prepared.maximumLevel;
  reportMesh({grounded, drawn, model, frame}, anyOfAll(port.exchange(), metCellZones(out.mesh.cellZones, model)), out);
  clock.lap("audit");
  out.stages = clock.stages();
  return out;
}

std::size_t estimateLayerElements(const TriangleSurface& surface, const MesherOptions& options,
                                  const RunContext& context)
{
  const PlacedModel placed = placeModel(surface, options);
  const SurfaceModel model = makeSurfaceModel(placed, options, context.part(0.0, 0.2));
  const SizedOctants sized = sizeOctants(model, placed.frame, options, context.part(0.2, 0.6));
  const Octree octree = buildOctree(model, placed.frame, sized, context.part(0.6, 1.0));
  return countLayerElements(octree, model, options.mesh.layers, options.sizing.hexahedra, context);
}

} // namespace atria
