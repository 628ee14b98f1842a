// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/DualMesher.h"

#include "Dual/Vertices/TurnedDomain.h"
#include "Dual/Zones/Cracks.h"
#include "Dual/Zones/ZoneEnclosures.h"
#include "Mesher/StageOptions.h"

#include <algorithm>

namespace atria {

namespace {

Labels findLabels(const GridPlaces& grid, const Crossings& crossings, const Zones& zones, const ZoneOptions& options,
                  DualMeshResult& result, const MeshingContext& context)
{
  Labels labels;
  labels.zoneFaces = findZoneFaces(crossings, context.model);
  labels.rooms = findRooms(zones, result.zones, crossings, labels.zoneFaces, context.model, options.rooms, context);
  labels.cellZones = findCellZones(crossings, grid, context.model, context);
  result.rooms = reportOf(labels.rooms, context.model);
  return labels;
}

Diagnostic lineOf(Diagnostic::Kind kind, const std::vector<Vec3>& path, Index element, double width)
{
  return {kind, path.front(), path.back(), element, width, {path.begin() + 1, path.end() - 1}};
}

/// Looks for ways through which they leak, and for gaps through which they do not.
void inspectZones(const CrossedGrid& crossed, const Zones& zones, const std::vector<Index>& elements,
                  const ZoneOptions& options, DualMeshResult& result, const MeshingContext& context)
{
  const auto& [grid, crossings] = crossed.displaced;
  result.leaks = findLeaks(options.sealedSeeds, zones, crossings, grid, context.model, context);
  for (const Leak& leak : result.leaks)
  {
    result.diagnostics.push_back(lineOf(Diagnostic::leakPath, leak.path, elements[leak.point], leak.width));
  }
  for (const Crack& crack : findCracks(crossed.gaps, zones, result.keptZones, crossings, grid, context))
  {
    result.diagnostics.push_back(lineOf(crack.open ? Diagnostic::openCrack : Diagnostic::closedCrack, crack.path,
                                        elements[crack.point], crack.width));
  }
}

/// Decides which zones are kept, and sums them up. Returns where solids are.
SolidPlaces chooseZones(const Zones& zones, const GridPlaces& grid, const Crossings& crossings,
                        const ZoneOptions& options, const DrawnModel* drawn, DualMeshResult& result,
                        const MeshingContext& context)
{
  const GridFrame& frame = context.octree.frame();
  const SurfaceModel& model = context.model;
  const std::vector<char> isGround = drawn ? drawn->isGround : std::vector<char>();
  const ZoneFacts facts = findZoneFacts(zones, crossings, grid, model.names.size(), wholeOf(grid), context, isGround);
  const ZoneEnclosures enclosures = drawn ? ZoneEnclosures(drawn->bodies, facts, frame, context) : ZoneEnclosures();
  const auto farthest = frame.turnedDomain ? farthestFromSides(zones, grid, 0, static_cast<Index>(grid.points().size()))
                                           : std::vector<double>();
  result.keptZones = chooseZones(zones, options.zoneRule, zonesOfSeeds(zones, seedsOf(options), grid, model), farthest,
                                 facts, enclosures, frame);
  result.zones = summarizeZones(zones, result.keptZones, facts, enclosures.kinds(result.keptZones), isGround, frame);
  return drawn ? SolidPlaces(drawn->bodies, enclosures.holdsAir(result.keptZones), frame.placement) : SolidPlaces();
}

/// Of the whole grid.
ViewShare allOf(const GridPoints& points) { return {0, static_cast<Index>(points.size())}; }

void seeModel(const CrossedGrid& crossed, const Zones& zones, const DualMeshResult& result, SeenModel& seen,
              const MeshingContext& context)
{
  const auto& [grid, crossings] = crossed.displaced;
  const std::vector<View> ofZone = viewsOfZones(result.zones);
  const ViewShare all = allOf(grid.points());
  seen.views = findModelViews(crossings, grid, zones, ofZone, context.model, all, context);
  seen.airParts = findAirParts(crossings, zones, ofZone, context.model, all, context);
  seen.samples = sampleSurfaces(crossings, zones, ofZone, all, context);
}

/// The zones of the octree's own grid tell what of the model air may reach. If that is not all of it, the crossings
/// become those of the rest.
ReachedStage findReached(OctreeGrid& own, const ZoneOptions& options, const DrawnModel* drawn,
                         const MeshingContext& context)
{
  const GridPlaces grid(context.octree, own.points);
  const Zones zones = findZones(own.crossings, context.model.names.size(), context);
  DualMeshResult found;
  const SolidPlaces solids = chooseZones(zones, grid, own.crossings, options, drawn, found, context);
  ReachedStage out;
  out.parts =
      findUnreachedParts(own.crossings, grid, zones, viewsOfZones(found.zones), solids, allOf(own.points), context);
  if (out.parts.any())
  {
    out.model = std::make_unique<ReachedModel>(out.parts, context);
    out.zones = {zones.ofPoint, std::move(found.keptZones), std::move(found.zones)};
    own.findAnew(out.in(context));
  }
  return out;
}

/// Zones, and from them elements and vertices.
ClassifiedMesh fillMesh(DualMeshResult& result, SeenModel& seen, CrossedGrid& grid, bool keepGrid,
                        const ZoneOptions& options, const DrawnModel* drawn, const ReachedStage& reached,
                        StageClock& clock, const MeshingContext& context)
{
  const auto& [places, crossings] = grid.displaced;
  context.progress.report(0.6, "Finding zones");
  const Zones zones = findZones(crossings, context.model.names.size(), context);
  chooseZones(zones, places, crossings, options, drawn, result, context);
  std::vector<std::int32_t> ofWhole;
  if (reached.model)
  {
    ofWhole = keepAs(reached.zones, zones, places, allOf(places.points()), result.keptZones, result.zones);
  }
  const std::vector<Index> elements = numberElements(zones, result.keptZones, context);
  inspectZones(grid, zones, elements, options, result, context);
  Labels labels = findLabels(places, crossings, zones, options, result, context);
  clock.lap("zones");
  seeModel(grid, zones, result, seen, context);
  clock.lap("audit");
  ClassifiedMesh made =
      makeElements(grid, keepGrid, zones, elements, std::move(labels), result.diagnostics, clock, context);
  if (reached.model)
  {
    listAs(reached.zones, ofWhole, made.mesh.zones, result.keptZones, result.zones);
  }
  return made;
}

/// Each detached vertex with an element that has it.
void appendDetached(const DualMesh& mesh, const std::vector<DetachedVertex>& detached, std::vector<Diagnostic>& out)
{
  if (detached.empty())
  {
    return;
  }
  std::vector<Index> slots(mesh.points.size(), noIndex);
  for (Index i = 0; i < detached.size(); ++i)
  {
    slots[detached[i].point] = i;
  }
  std::vector<Index> elements(detached.size(), noIndex);
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (const Index p : mesh.corners[e])
    {
      if (slots[p] != noIndex && elements[slots[p]] == noIndex)
      {
        elements[slots[p]] = e;
      }
    }
  }
  for (std::size_t i = 0; i < detached.size(); ++i)
  {
    out.push_back({Diagnostic::detachedVertex, mesh.points[detached[i].point], detached[i].wanted, elements[i]});
  }
}

/// Diagnostics follow their elements.
void appendLeftOut(const ImprovedMesh& improved, std::vector<Diagnostic>& diagnostics)
{
  for (Diagnostic& diagnostic : diagnostics)
  {
    if (!improved.numbers.empty() && diagnostic.element != noIndex)
    {
      diagnostic.element = improved.numbers[diagnostic.element];
    }
  }
  for (const LeftOutElement& element : improved.leftOut)
  {
    diagnostics.push_back({Diagnostic::leftOutElement, element.middle, element.middle, element.beside, element.size});
  }
}

void countElements(const DualMesh& mesh, const std::vector<char>& keptZones, std::vector<ZoneSummary>& zones)
{
  for (std::size_t zone = 0; zone < zones.size(); ++zone)
  {
    zones[zone].elements = keptZones[zone] ? 0 : zones[zone].elements;
  }
  for (const std::int32_t zone : mesh.zones)
  {
    ++zones[zone].elements;
  }
}

void takeImproved(ImprovedMesh improved, DualMeshResult& result)
{
  appendLeftOut(improved, result.diagnostics);
  result.mesh = std::move(improved.mesh);
  result.layers = std::move(improved.layers);
  appendDetached(result.mesh, improved.detached, result.diagnostics);
  countElements(result.mesh, result.keptZones, result.zones);
}

void placeAll(std::vector<Vec3>& points, const Placement& placement)
{
  std::transform(points.begin(), points.end(), points.begin(), [&](const Vec3& p) { return placement.toModel(p); });
}

/// Returns the octree's own grid where it had to be made, for the model that air may reach.
std::optional<OctreeGrid> makeReached(DualStages& stages, const ZoneOptions& options, const DrawnModel* drawn,
                                      StageClock& clock, const MeshingContext& context)
{
  if (stages.reached.isOf(options))
  {
    return std::nullopt;
  }
  OctreeGrid grid(clock, context.part(0.0, 0.3));
  ReachedStage found = findReached(grid, options, drawn, context.part(0.3, 0.45));
  clock.lap("crossings");
  stages.plain = {};
  stages.reached.options = options;
  if (stages.reached.result && stages.reached.result->parts.isUnreached == found.parts.isUnreached)
  {
    stages.reached.result->parts = std::move(found.parts); // what was made for this model may stay
    stages.reached.result->zones = std::move(found.zones);
  }
  else
  {
    stages.grid = {};
    stages.reached.result = std::make_unique<ReachedStage>(std::move(found));
  }
  return grid;
}

/// The stages up to the plain mesh, as far as they are not there; what only they need is freed unless it is kept: it is
/// larger than the mesh.
void makePlain(DualStages& stages, bool keep, const DualMeshOptions& options, const DrawnModel* drawn,
               StageClock& clock, const MeshingContext& whole)
{
  std::optional<OctreeGrid> octreeGrid = makeReached(stages, options, drawn, clock, whole);
  const ReachedStage& reached = *stages.reached.result;
  const MeshingContext context = reached.in(whole);
  if (!stages.grid.isOf(options))
  {
    stages.plain = {};
    stages.grid = {};
    if (!octreeGrid)
    {
      octreeGrid.emplace(clock, context.part(0.0, 0.3));
    }
    stages.grid.result = std::make_unique<CrossedGrid>(std::move(*octreeGrid), options, clock, context);
    stages.grid.options = options;
  }
  if (stages.plain.isOf(options))
  {
    return;
  }
  stages.plain = {};
  auto plain = std::make_unique<PlainDual>();
  plain->seen.unreached = areasOf(reached.parts, whole.model, whole.octree.frame());
  ClassifiedMesh mesh =
      fillMesh(plain->found, plain->seen, *stages.grid.result, keep, options, drawn, reached, clock, context);
  if (!keep)
  {
    stages.grid = {};
  }
  plain->mesh = splitPoints(unfoldWalls(std::move(mesh), context), context);
  stages.plain.result = std::move(plain);
  stages.plain.options = options;
  clock.lap("elements");
}

} // namespace

void placeInModel(DualMeshResult& result, const Placement& placement, const RunContext& context)
{
  if (placement.angle() == 0.0)
  {
    return;
  }
  std::vector<Vec3>& points = result.mesh.points;
  context.executor.forEach(points.size(), 65536, [&](std::size_t i) { points[i] = placement.toModel(points[i]); });
  for (Diagnostic& diagnostic : result.diagnostics)
  {
    diagnostic.begin = placement.toModel(diagnostic.begin);
    diagnostic.end = placement.toModel(diagnostic.end);
    placeAll(diagnostic.between, placement);
  }
  for (ZoneSummary& zone : result.zones)
  {
    zone.inside = placement.toModel(zone.inside);
  }
  for (Leak& leak : result.leaks)
  {
    placeAll(leak.path, placement);
    leak.place = placement.toModel(leak.place);
  }
  placeInModel(result.audit, placement);
}

DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& run, DualStages* kept, const DrawnModel* drawn)
{
  DualStages own;
  DualStages& stages = kept ? *kept : own;
  if (!stages.tree)
  {
    stages.tree.emplace(model);
  }
  const MeshingContext whole{run, octree, model, *stages.tree};
  makePlain(stages, kept != nullptr, options, drawn, clock, whole.part(0.0, 0.55));
  const MeshingContext context = stages.reached.result->in(whole);
  PlainDual plain = kept ? *kept->plain.result : std::move(*own.plain.result);
  DualMeshResult result = std::move(plain.found);
  context.progress.report(0.55, "Growing layers");
  takeImproved(growLayers(std::move(plain.mesh), options, context.part(0.55, 0.98)), result);
  orderZoneFaces(result.mesh);
  measureRooms(result.mesh, context.model, octree.frame().domain, {}, result.rooms);
  clock.lap("layers");
  result.audit = auditMesh(result.mesh, plain.seen, {}, context);
  clock.lap("audit");
  context.progress.report(0.98, "Placing the mesh in the model");
  placeInModel(result, octree.frame().placement, context);
  result.metSides = findMetSides(result.mesh, model.names.size());
  clock.lap("layers");
  context.progress.report(1.0, "Meshed");
  return result;
}

} // namespace atria
