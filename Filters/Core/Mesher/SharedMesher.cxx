// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/SharedMesher.h"

#include "Mesher/Blocks/BlockImprover.h"
#include "Mesher/LeaveOut.h"
#include "Mesher/SharedReport.h"
#include "Mesher/Shares/SharedBlocks.h"
#include "Mesher/Shares/SharedLabels.h"
#include "Mesher/Shares/SharedZones.h"
#include "Support/FreedMemory.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace atria {

namespace {

/// Of elements, those of the grid points they stand for.
std::vector<PointKey> keysOf(const std::vector<Index>& elements, const SharedPoints& points)
{
  std::vector<PointKey> keys;
  keys.reserve(elements.size());
  for (Index point = 0; point < elements.size(); ++point)
  {
    if (elements[point] != noIndex)
    {
      keys.push_back(points.key(point));
    }
  }
  return keys;
}

/// What of a plain mesh tells which elements stand on which.
DualMesh connectionsOf(ClassifiedMesh plain)
{
  DualMesh out;
  out.neighbors = std::move(plain.mesh.neighbors);
  out.boundaryFaces = std::move(plain.mesh.boundaryFaces);
  return out;
}

/// The octree's own grid of a rank, and what of the model air may reach.
struct SharedStart
{
  OctreeGrid grid;
  SharedPoints points;
  ReachedStage reached;
};

/// Decides which zones are kept, and sums them up; on all ranks. Returns where solids are.
SolidPlaces chooseZones(const Zones& zones, const GridPlaces& places, const Crossings& crossings,
                        const SharedPoints& points, const ZoneOptions& options, const DrawnModel* drawn,
                        const RankShare& share, DualMeshResult& found, const MeshingContext& context)
{
  const GridFrame& frame = context.octree.frame();
  const std::vector<char> isGround = drawn ? drawn->isGround : std::vector<char>();
  const ZoneFacts facts =
      SharedReport(share).findFacts(zones, places, crossings, points, context.model.names.size(), isGround, context);
  const ZoneEnclosures enclosures = drawn ? ZoneEnclosures(drawn->bodies, facts, frame, context) : ZoneEnclosures();
  found.keptZones = keptSharedZones(zones, options.zoneRule, seedsOf(options), places, points, share, context.model,
                                    facts, enclosures);
  found.zones = summarizeZones(zones, found.keptZones, facts, enclosures.kinds(found.keptZones), isGround, frame);
  return drawn ? SolidPlaces(drawn->bodies, enclosures.holdsAir(found.keptZones), frame.placement) : SolidPlaces();
}

SharedStart startOf(const DualMeshOptions& options, const DrawnModel* drawn, const RankShare& share, StageClock& clock,
                    const MeshingContext& context)
{
  OctreeGrid grid(clock, context);
  const SharedPoints points(share, context.octree, grid.points, context);
  const GridPlaces places(context.octree, grid.points);
  const Zones zones = findSharedZones(grid.crossings, points, context.model.names.size(), share, context);
  DualMeshResult found;
  const SolidPlaces solids = chooseZones(zones, places, grid.crossings, points, options, drawn, share, found, context);
  ReachedStage reached;
  reached.parts = findUnreachedParts(grid.crossings, places, zones, viewsOfZones(found.zones), solids,
                                     {points.firstOwn(), points.endOwn(), &share.exchange()}, context);
  if (reached.parts.any())
  {
    reached.model = std::make_unique<ReachedModel>(reached.parts, context);
    reached.zones = {zones.ofPoint, std::move(found.keptZones), std::move(found.zones)};
    grid.findAnew(reached.in(context));
  }
  clock.lap("crossings");
  return {std::move(grid), points, std::move(reached)};
}

class SharedMesher
{
public:
  /// `whole` is of all of the model; `octreeOfRank` is that of the start's model.
  SharedMesher(const MeshingContext& whole, SharedStart& startOfRank, Octree& octreeOfRank,
               const DualMeshOptions& meshOptions, const RankShare& rankShare, StageClock& stageClock,
               const DrawnModel* drawnModel)
      : context(startOfRank.reached.in(whole)), start(startOfRank), octree(octreeOfRank), options(meshOptions),
        share(rankShare), clock(stageClock), drawn(drawnModel),
        surfaceCount(static_cast<Index>(context.model.names.size())), report(share)
  {
    seen.unreached = areasOf(start.reached.parts, whole.model, whole.octree.frame());
  }

  std::optional<SharedDual> run(int ghostLevels)
  {
    std::optional<SharedDual> made(std::in_place);
    SharedDual& out = *made;
    std::optional<SharedWindow> ofRank = makePlain(out.found);
    if (!ofRank)
    {
      return std::nullopt;
    }
    SharedWindow& window = *ofRank;
    ClassifiedMesh plain = std::move(window.plain);
    ImprovedMesh improved;
    LayerMesh layer = options.layers.empty() ? withoutLayer(std::move(plain.mesh)) : grow(plain, window, improved);
    improved.mesh = std::move(layer.mesh);
    const DualMesh below = connectionsOf(std::move(plain));
    const SharedLayers layers(window, below, layer);
    leaveOutWhatFails(layers, improved);
    orderZoneFaces(improved.mesh);
    clock.lap("layers");
    measure(layers, improved, out.found);
    clock.lap("audit");
    if (improved.mesh.zoneFaces.empty())
    {
      release(improved.mesh.neighbors);
    }
    giveBackFreedMemory();
    out.piece = takePiece(improved.mesh, {improved.numbers, improved.pointNumbers}, layers, layer, share, ghostLevels,
                          report.elements());
    report.addDetached(improved, out.piece);
    out.found.diagnostics = report.finish(out.piece.askedNumbers);
    removeCutTag(out.piece.mesh);
    takeLayers(improved.layers, out);
    countElements(out);
    placeInModel(out);
    clock.lap("numbers");
    return made;
  }

private:
  /// The rank's window of the dual as it is; nothing where zones that should be sealed are not.
  std::optional<SharedWindow> makePlain(DualMeshResult& found)
  {
    std::optional<SharedPoints> points = std::move(start.points);
    const auto findWideZones = [&](const GridPoints& gridPoints, const Crossings& undisplaced) {
      return sharedWideZones(gridPoints, undisplaced, *points, surfaceCount, share, context);
    };
    std::optional<CrossedGrid> grid(std::in_place, std::move(start.grid), options, clock, context.part(0.0, 0.3),
                                    findWideZones);
    const auto& [places, crossings] = grid->displaced;
    context.progress.report(0.3, "Finding zones");
    Zones zones = findSharedZones(crossings, *points, surfaceCount, share, context);
    chooseZones(zones, places, crossings, *points, options, drawn, share, found, context);
    std::vector<std::int32_t> ofWhole;
    if (start.reached.model)
    {
      ofWhole = keepAs(start.reached.zones, zones, places, {points->firstOwn(), points->endOwn(), &share.exchange()},
                       found.keptZones, found.zones);
    }
    if (isAnyLeaking(options.sealedSeeds, zones, places, share, context.model))
    {
      return std::nullopt;
    }
    Labels labels = findSharedLabels(zones, found.zones, grid->displaced, *points, options.rooms, share, context);
    found.rooms = reportOf(labels.rooms, context.model);
    std::vector<char> kept = found.keptZones;
    kept.push_back(1); // what is elsewhere is cut off later
    report.addCracks(*grid, zones, kept, *points, context);
    std::vector<Index> elements = numberElements(zones, kept, context);
    clock.lap("zones");
    seeModel(grid->displaced, zones, found.zones, *points);
    clock.lap("audit");
    release(grid->points.atCorner); // only crossings and zones ask for these
    std::vector<Diagnostic> diagnostics;
    ClassifiedMesh plain =
        makeElements(*grid, false, zones, elements, std::move(labels), diagnostics, clock, context.part(0.3, 0.5));
    if (start.reached.model)
    {
      listAs(start.reached.zones, ofWhole, plain.mesh.zones, found.keptZones, found.zones);
    }
    grid.reset();
    zones = {};
    std::vector<PointKey> keys = keysOf(elements, *points);
    points.reset();
    report.addPlain(diagnostics, keys);
    release(elements);
    plain = splitPoints(unfoldWalls(std::move(plain), context), context);
    SharedWindow window = makeWindow(shareOf(std::move(plain), std::move(keys), octree, share), surfaceCount, share,
                                     context.model, octree, context);
    clock.lap("elements");
    return window;
  }

  void seeModel(const DisplacedGrid& displaced, const Zones& zones, const std::vector<ZoneSummary>& summaries,
                const SharedPoints& points)
  {
    const auto& [grid, crossings] = displaced;
    const std::vector<View> ofZone = viewsOfZones(summaries);
    const ViewShare own{points.firstOwn(), points.endOwn(), &share.exchange()};
    seen.views = findModelViews(crossings, grid, zones, ofZone, context.model, own, context);
    seen.airParts = findAirParts(crossings, zones, ofZone, context.model, own, context);
    seen.samples = sampleSurfaces(crossings, zones, ofZone, own, context);
  }

  LayerMesh grow(ClassifiedMesh& plain, const SharedWindow& window, ImprovedMesh& improved)
  {
    layerOptions = optionsOfWindows(
        layerOptionsOf(options, isAnywhere(hasGround(plain.mesh, surfaceCount), share.exchange()), context));
    const LayerWalls walls = prepareWalls(plain, layerOptions, context);
    MeshTraits traits = traitsOf(plain.mesh, layerOptions);
    traits.uniform = false; // there are several blocks, and no crease sheets
    const ImprovedBlocks blocks = improve(plain, walls, traits, window);
    // All but the frame, and what elements were improved by: nothing asks for these any more.
    octree = Octree(context.octree.frame(), {});
    plain.classification = {};
    release(plain.vertexOf);
    giveBackFreedMemory();
    auto [layer, detached, failing, sizes] = layersOfBlocks(blocks, plain.mesh, walls, traits, context);
    std::vector<std::string> names = context.model.names;
    names.emplace_back(); // of where the window is cut
    improved.layers =
        reportLayers(layer, walls, sizes, layerOptions, names,
                     {[&](Index face) { return window.isOwn(plain.mesh.boundaryFaces[face].element); },
                      [&](const std::vector<double>& own) { return sumOverRanks(share.exchange(), own); }});
    improved.detached = std::move(detached);
    failingElements = std::move(failing);
    return std::move(layer);
  }

  ImprovedBlocks improve(ClassifiedMesh& plain, const LayerWalls& walls, const MeshTraits& traits,
                         const SharedWindow& window) const
  {
    const MeshBlocks blocks = blocksOf(context.octree, plain.classification.leaves, share.blocks(), share.firstBlock(),
                                       share.endBlock(), window.near);
    SharedBlocks exchange(window, plain.mesh, share);
    exchange.takePlaces(plain.mesh.points, plain.classification.displacementLimits);
    return improveBlocks(context.part(0.5, 0.95), plain.classification, plain.vertexOf, plain.mesh, walls, layerOptions,
                         options.curvedWalls, traits, blocks, exchange);
  }

  void leaveOutWhatFails(const SharedLayers& layers, ImprovedMesh& improved)
  {
    if (!options.layers.empty() && (layerOptions.isAsked() || options.supportElements))
    {
      SharedLeaveOut exchange(improved.mesh, layers, surfaceCount, share.exchange());
      const bool sidesToo = !context.octree.frame().turnedDomain;
      leaveOut(findElementsToLeaveOut(improved.mesh, failingElements, sidesToo, exchange, context), improved);
      report.addLeftOut(improved, layers);
      orderFaces(improved);
    }
  }

  /// Rooms and audit, by own elements, which are not placed in the model yet.
  void measure(const SharedLayers& layers, const ImprovedMesh& improved, DualMeshResult& found) const
  {
    std::vector<Index> before;
    for (Index e = 0; e < improved.numbers.size(); ++e)
    {
      if (improved.numbers[e] != noIndex)
      {
        before.push_back(e);
      }
    }
    const auto isOwn = [&](Index e) { return layers.isOwn(before.empty() ? e : before[e]); };
    const MeshShare own{isOwn, &share.exchange()};
    measureRooms(improved.mesh, context.model, context.octree.frame().domain, own, found.rooms);
    found.audit = auditMesh(improved.mesh, seen, own, context);
  }

  /// Own elements have no faces where the window was cut; tags of sides were one higher.
  void removeCutTag(DualMesh& mesh) const
  {
    for (BoundaryFace& face : mesh.boundaryFaces)
    {
      face.tag -= face.tag > surfaceCount ? 1 : 0;
    }
  }

  /// By face of the piece what is by face of the rank's mesh.
  static void takeLayers(const LayerReport& improved, SharedDual& out)
  {
    const auto take = [&](const auto& all, auto& own) {
      for (std::size_t f = 0; f < out.piece.facesBefore.size() && !all.empty(); ++f)
      {
        own.push_back(all[out.piece.facesBefore[f]]);
      }
    };
    take(improved.counts, out.found.layers.counts);
    take(improved.thicknesses, out.found.layers.thicknesses);
    out.found.layers.surfaces = improved.surfaces;
  }

  void countElements(SharedDual& out) const
  {
    std::vector<std::size_t> counts(out.found.zones.size(), 0);
    for (Index e = 0; e < out.piece.mesh.elementCount(); ++e)
    {
      counts[static_cast<std::size_t>(out.piece.mesh.zones[e])] += out.piece.elementRanks[e] == share.rank() ? 1 : 0;
    }
    const std::vector<std::vector<std::size_t>> all = gatherAll(share.exchange(), counts);
    for (std::size_t zone = 0; zone < counts.size(); ++zone)
    {
      std::size_t sum = 0;
      std::ranges::for_each(all, [&](const auto& some) { sum += some[zone]; });
      out.found.zones[zone].elements = out.found.keptZones[zone] ? sum : out.found.zones[zone].elements;
    }
  }

  void placeInModel(SharedDual& out) const
  {
    std::swap(out.found.mesh.points, out.piece.mesh.points);
    atria::placeInModel(out.found, context.octree.frame().placement, context);
    std::swap(out.found.mesh.points, out.piece.mesh.points);
  }

  MeshingContext context;
  SharedStart& start;
  Octree& octree; ///< of the context
  const DualMeshOptions& options;
  const RankShare& share;
  StageClock& clock;
  const DrawnModel* drawn;
  Index surfaceCount;
  SeenModel seen;
  LayerOptions layerOptions;
  std::vector<Index> failingElements;
  SharedReport report;
};

} // namespace

std::optional<SharedDual> makeSharedMesh(Octree octree, const SurfaceModel& model, const DualMeshOptions& options,
                                         const RankShare& share, int ghostLevels, StageClock& clock,
                                         const RunContext& run, const DrawnModel* drawn)
{
  const TriangleTreeOnDemand tree(model);
  const MeshingContext whole{run, octree, model, tree};
  SharedStart start = startOf(options, drawn, share, clock, whole.part(0.0, 0.1));
  if (start.reached.model)
  {
    octree = Octree(octree.frame(), {});
  }
  return SharedMesher(whole, start, start.reached.model ? start.reached.model->octree() : octree, options, share, clock,
                      drawn)
      .run(ghostLevels);
}

} // namespace atria
