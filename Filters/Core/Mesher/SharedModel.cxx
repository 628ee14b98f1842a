// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/SharedModel.h"

#include "Dual/Zones/CellZones.h"
#include "Layer/LayerBudget.h"
#include "Mesher/MeshReport.h"
#include "Mesher/SharedMesher.h"
#include "Support/FreedMemory.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// The part of the run that is over when octants have their sizes.
constexpr double sizingShare = 0.25;

std::vector<char> cellZonesOnRanks(const SharedPiece& piece, const SurfaceModel& model, RankExchange& exchange)
{
  std::vector<char> isMet(model.names.size(), 0);
  for (const std::vector<char>& some : gatherAll(exchange, metCellZones(piece.mesh.cellZones, model)))
  {
    std::ranges::transform(some, isMet, isMet.begin(), [](char a, char b) { return a | b; });
  }
  return isMet;
}

std::vector<MetSides> metOnRanks(const SharedPiece& piece, std::size_t surfaceCount, RankExchange& exchange)
{
  std::vector<MetSides> met(surfaceCount + sideNumbers);
  for (const std::vector<MetSides>& some :
       gatherAll(exchange, findMetSides(piece.mesh, surfaceCount, piece.hasOpposite)))
  {
    for (std::size_t tag = 0; tag < met.size(); ++tag)
    {
      met[tag].add(some[tag]);
    }
  }
  return met;
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

std::size_t elementsOnRanks(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                            const RankShare& share, const RunContext& context)
{
  const auto isOwn = [&](Index leaf) { return share.isOwn(octree.finestKey(leaf)); };
  return countBefore(elementsWithLayers(octree, model, rules, context, isOwn), share.exchange()).all;
}

/// Makes the mesh of a share, with more and more rows about it until ranks agree.
class ShareMaker
{
public:
  ShareMaker(const SurfaceModel& surfaceModel, const DrawnModel& drawnModel, const MesherOptions& meshOptions,
             const RankShare& rankShare, int levels, const RunContext& within)
      : model(surfaceModel), drawn(drawnModel), options(meshOptions), share(rankShare), ghostLevels(levels),
        context(within)
  {
  }

  std::optional<SharedDual> make(ShareRows rows, StageClock& clock) const
  {
    std::optional<SharedDual> made;
    for (int tries = 1; tries < mostTries; ++tries)
    {
      StageClock tried = clock;
      if (share.exchange().agreeOn([&] { made = makeWith(rows, tried); }))
      {
        clock = std::move(tried);
        return made;
      }
      rows = rows.times(2);
    }
    return makeWith(rows, clock);
  }

private:
  static constexpr int mostTries = 3;

  std::optional<SharedDual> makeWith(const ShareRows& rows, StageClock& clock) const
  {
    Octree octree = share.makeOctree(model, rows, context.part(0.0, 0.25));
    clock.lap("octree");
    checkLayerBudget(elementsOnRanks(octree, model, options.mesh.layers, share, context), options.sizing.memoryLimit);
    DualMeshOptions dual = options.mesh;
    dual.rooms.sidesAreWalls = options.site.mode == DomainMode::surfaces;
    return makeSharedMesh(std::move(octree), model, dual, share, ghostLevels, clock, context.part(0.25, 1.0), &drawn);
  }

  const SurfaceModel& model;
  const DrawnModel& drawn;
  const MesherOptions& options;
  const RankShare& share;
  int ghostLevels;
  const RunContext& context;
};

} // namespace

std::optional<SharedModel> meshSharedModel(const TriangleSurface& asRead, const MesherOptions& asked, int ghostLevels,
                                           RankExchange& exchange, const RunContext& run, const ShareRows& rows)
{
  if (asked.mesh.blockSize == 0)
  {
    return std::nullopt;
  }
  StageClock clock;
  const RunContext context = run.part(0.0, sizingShare);
  context.progress.report(0.0, "Finding the ground");
  GroundedInput grounded = groundModel(asRead, asked);
  const TriangleSurface& surface = grounded.surface;
  MesherOptions options = asked;
  static_cast<ModelOptions&>(options) = grounded.options;
  const SitePlan plan = planSite(surface, options);
  std::optional<SharedModel> out(std::in_place);
  MeshedModel& meshed = out->meshed;
  meshed.inputWarnings = checkDomain(surface, plan, options);
  meshed.inputWarnings.insert(meshed.inputWarnings.end(), grounded.report.warnings.begin(),
                              grounded.report.warnings.end());
  context.progress.report(0.0, "Repairing surfaces");
  const PlacedModel placed = placeModel(surface, plan, options);
  const SurfaceModel model = makeSurfaceModel(placed, options, context.part(0.0, 0.2));
  clock.lap("surface");
  SizedOctants sized = sizeOctants(model, placed.frame, options, context.part(0.2, 1.0));
  const RankShare share(sized.refined, model, placed.frame, options.mesh.blockSize, exchange, context);
  if (share.blocks().count() < static_cast<std::size_t>(std::max(2, exchange.ranks())))
  {
    return std::nullopt;
  }
  const DrawnModel drawn = drawnModel(surface, options.site, model.kinds, placed.frame, context);
  std::optional<SharedDual> made =
      ShareMaker(model, drawn, options, share, ghostLevels, run.part(sizingShare, 1.0)).make(rows, clock);
  if (!made)
  {
    return std::nullopt;
  }
  giveBackFreedMemory();
  static_cast<DualMeshResult&>(meshed) = std::move(made->found);
  out->piece = std::move(made->piece);
  meshed.metSides = metOnRanks(out->piece, model.names.size(), exchange);
  meshed.sizingWarning = sized.warning;
  reportMesh({grounded, drawn, model, placed.frame}, cellZonesOnRanks(out->piece, model, exchange), meshed);
  meshed.maximumLevel = finestLevel(sized.refined);
  clock.lap("audit");
  meshed.stages = clock.stages();
  return out;
}

} // namespace atria
