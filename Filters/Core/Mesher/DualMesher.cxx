// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/DualMesher.h"

#include "Dual/Vertices/TurnedDomain.h"
#include "Dual/Zones/Cracks.h"
#include "Dual/Zones/Leaks.h"
#include "Dual/Zones/ZoneEnclosures.h"
#include "Mesher/MeshPort.h"
#include "Mesher/RoomMeasures.h"
#include "Mesher/StageOptions.h"
#include "Mesher/Transitions.h"

#include <algorithm>

namespace atria {

namespace {

Labels findLabels(const GridPlaces& grid, const Crossings& crossings, const Zones& zones, const ZoneOptions& options,
                  const GridPart& part, DualMeshResult& result, const MeshingContext& context)
{
  const SurfaceModel& model = context.model;
  Labels labels;
  labels.zoneFaces = findZoneFaces(crossings, model);
  labels.rooms = findRooms(zones, result.zones, crossings, labels.zoneFaces, part, model, options.rooms, context);
  labels.cellZones = findCellZones(crossings, grid, part, model, context);
  result.rooms = reportOf(labels.rooms, model);
  return labels;
}

Diagnostic lineOf(Diagnostic::Kind kind, const std::vector<Vec3>& path, Index element, double width)
{
  return {kind, path.front(), path.back(), element, width, {path.begin() + 1, path.end() - 1}};
}

/// Reports ways through which zones leak, and gaps through which they do not.
/// \param isKept  One entry per zone, and one more for the points that this process does not know.
void inspectZones(const CrossedGrid& crossed, const Zones& zones, const std::vector<char>& isKept,
                  const std::vector<Index>& elements, const ZoneOptions& options, const GridPart& part,
                  DualMeshResult& result, const MeshingContext& context)
{
  const auto& [grid, crossings] = crossed.displaced;
  result.leaks = findLeaks(options.sealedSeeds, zones, crossings, grid, part, context.model, context);
  for (const Leak& leak : result.leaks)
  {
    result.diagnostics.push_back(lineOf(Diagnostic::leakPath, leak.path, elements[leak.point], leak.width));
  }
  const std::vector<Crack> cracks = findCracks(crossed.gaps, zones, isKept, crossings, grid, part, context);
  for (std::size_t i = 0; i < cracks.size(); ++i)
  {
    const Crack& crack = cracks[i];
    if (crack.point != noIndex)
    {
      const Diagnostic::Kind kind = crack.open ? Diagnostic::openCrack : Diagnostic::closedCrack;
      result.diagnostics.push_back(lineOf(kind, crack.path, elements[crack.point], crack.width));
      result.diagnostics.back().order = i;
    }
  }
}

/// Decides which zones are kept, and summarizes them. Returns where solids are.
SolidPlaces chooseZones(const Zones& zones, const GridPlaces& grid, const Crossings& crossings,
                        const ZoneOptions& options, const DrawnModel* drawn, const GridPart& part,
                        DualMeshResult& result, const MeshingContext& context)
{
  const GridFrame& frame = context.octree.frame();
  const SurfaceModel& model = context.model;
  const std::vector<char> isGround = drawn ? drawn->isGround : std::vector<char>();
  const ZoneFacts facts = findZoneFacts(zones, crossings, grid, model.names.size(), part, context, isGround);
  const ZoneEnclosures enclosures = drawn ? ZoneEnclosures(drawn->bodies, facts, frame, context) : ZoneEnclosures();
  result.keptZones = chooseZones(zones, options.zoneRule, zonesOfSeeds(zones, seedsOf(options), grid, part, model),
                                 farthestFromSides(zones, grid, part), facts, enclosures, frame);
  result.zones = summarizeZones(zones, result.keptZones, facts, enclosures.kinds(result.keptZones), isGround, frame);
  return drawn ? SolidPlaces(drawn->bodies, enclosures.holdsAir(result.keptZones), frame.placement) : SolidPlaces();
}

void seeModel(const CrossedGrid& crossed, const Zones& zones, const DualMeshResult& result, const GridPart& part,
              SeenModel& seen, const MeshingContext& context)
{
  const auto& [grid, crossings] = crossed.displaced;
  const std::vector<View> ofZone = viewsOfZones(result.zones);
  seen.views = findModelViews(crossings, grid, zones, ofZone, context.model, part, context);
  seen.airParts = findAirParts(crossings, zones, ofZone, context.model, part, context);
  seen.samples = sampleSurfaces(crossings, zones, ofZone, part, context);
}

/// Finds by the zones of the octree's own grid which parts of the model air may reach. If these are not all, the
/// crossings become those of the reached model.
ReachedStage findReached(OctreeGrid& own, const ZoneOptions& options, const DrawnModel* drawn, const GridPart& part,
                         const MeshingContext& context)
{
  const GridPlaces grid(context.octree, own.points);
  const Zones zones = findZones(own.crossings, context.model.names.size(), part, context);
  DualMeshResult found;
  const SolidPlaces solids = chooseZones(zones, grid, own.crossings, options, drawn, part, found, context);
  ReachedStage out;
  out.parts = findUnreachedParts(own.crossings, grid, zones, viewsOfZones(found.zones), solids, part, context);
  if (out.parts.any())
  {
    out.model = std::make_unique<ReachedModel>(out.parts, context);
    out.zones = {zones.ofPoint, std::move(found.keptZones), std::move(found.zones)};
    own.findAnew(out.in(context));
  }
  return out;
}

/// Finds zones, and makes elements and vertices from them.
ClassifiedMesh fillMesh(DualMeshResult& result, SeenModel& seen, CrossedGrid& grid, bool keepGrid,
                        const ElementOptions& options, const DrawnModel* drawn, const ReachedStage& reached,
                        MeshPort& port, StageClock& clock, const MeshingContext& context)
{
  const auto& [places, crossings] = grid.displaced;
  const GridPart& part = port.divide(context.octree, grid.points, context);
  context.progress.report(0.6, "Finding zones");
  const Zones zones = findZones(crossings, context.model.names.size(), part, context);
  chooseZones(zones, places, crossings, options, drawn, part, result, context);
  std::vector<std::int32_t> ofWhole;
  if (reached.model)
  {
    ofWhole = keepAs(reached.zones, zones, places, part, result.keptZones, result.zones);
  }
  std::vector<char> isKept = result.keptZones;
  isKept.push_back(1); // points that this process does not know have elements until the mesh is completed
  const std::vector<Index> elements = numberElements(zones, isKept, context);
  inspectZones(grid, zones, isKept, elements, options, part, result, context);
  Labels labels = findLabels(places, crossings, zones, options, part, result, context);
  clock.lap("zones");
  seeModel(grid, zones, result, part, seen, context);
  clock.lap("audit");
  if (!keepGrid)
  {
    release(grid.points.atCorner); // only crossings and zones depend on these
  }
  ClassifiedMesh made = makeElements(grid, keepGrid, options.hexahedra, zones, elements, std::move(labels),
                                     result.diagnostics, clock, context);
  if (reached.model)
  {
    listAs(reached.zones, ofWhole, made.mesh.zones, result.keptZones, result.zones);
  }
  port.takeElements(elements);
  return made;
}

/// Adds the elements that were left out, in the order of elements, those of layers after all others.
void appendLeftOut(const ImprovedMesh& improved, const OwnElements& part, std::vector<Diagnostic>& diagnostics)
{
  for (const LeftOutElement& element : improved.leftOut)
  {
    if (part.owns(element.number))
    {
      const Index beside = element.beside == noIndex ? noIndex : element.besideBefore;
      diagnostics.push_back({Diagnostic::leftOutElement, element.middle, element.middle, beside, element.size});
      diagnostics.back().order = element.number;
    }
  }
}

/// Counts the elements of the zones that are kept.
void countElements(const DualMesh& mesh, const std::vector<char>& keptZones, const OwnElements& part,
                   std::vector<ZoneSummary>& zones)
{
  std::vector<std::size_t> counts(zones.size(), 0);
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    counts[static_cast<std::size_t>(mesh.zones[e])] += part.owns(e) ? 1 : 0;
  }
  counts = sumAll(part.exchange, std::move(counts));
  for (std::size_t zone = 0; zone < zones.size(); ++zone)
  {
    zones[zone].elements = keptZones[zone] ? counts[zone] : zones[zone].elements;
  }
}

void placeAll(std::vector<Vec3>& points, const Placement& placement)
{
  std::transform(points.begin(), points.end(), points.begin(), [&](const Vec3& p) { return placement.toModel(p); });
}

/// Finds the model that air may reach. Returns the octree's own grid if it had to be made for that.
std::optional<OctreeGrid> makeReached(DualStages& stages, const ZoneOptions& options, const DrawnModel* drawn,
                                      MeshPort& port, StageClock& clock, const MeshingContext& context)
{
  if (stages.reached.isOf(options))
  {
    return std::nullopt;
  }
  OctreeGrid grid(clock, context.part(0.0, 0.3));
  const GridPart& part = port.divide(context.octree, grid.points, context);
  ReachedStage found = findReached(grid, options, drawn, part, context.part(0.3, 0.45));
  clock.lap("crossings");
  stages.plain = {};
  stages.reached.options = options;
  if (stages.reached.result && stages.reached.result->parts.isUnreached == found.parts.isUnreached)
  {
    stages.reached.result->parts = std::move(found.parts); // the stages made for this model stay valid
    stages.reached.result->zones = std::move(found.zones);
  }
  else
  {
    stages.grid = {};
    stages.reached.result = std::make_unique<ReachedStage>(std::move(found));
  }
  return grid;
}

/// Makes the missing stages up to the plain mesh. Unless `keep`, frees the grid after use: it is larger than the mesh.
void makePlain(DualStages& stages, bool keep, const DualMeshOptions& options, const DrawnModel* drawn, MeshPort& port,
               StageClock& clock, const MeshingContext& whole)
{
  std::optional<OctreeGrid> octreeGrid = makeReached(stages, options, drawn, port, clock, whole);
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
    stages.grid.result = std::make_unique<CrossedGrid>(std::move(*octreeGrid), options, port, clock, context);
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
      fillMesh(plain->found, plain->seen, *stages.grid.result, keep, options, drawn, reached, port, clock, context);
  if (!keep)
  {
    stages.grid = {};
  }
  if (options.hexahedra)
  {
    improveTransitions(mesh, context);
  }
  plain->mesh = splitPoints(unfoldWalls(std::move(mesh), context), context);
  stages.plain.result = std::move(plain);
  stages.plain.options = options;
  clock.lap("elements");
}

/// Rotates mesh and diagnostics to the model's axes.
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

} // namespace

DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& run, DualStages* kept, const DrawnModel* drawn,
                            MeshPort& port)
{
  DualStages own;
  DualStages& stages = kept ? *kept : own;
  if (!stages.tree)
  {
    stages.tree.emplace(model);
  }
  const MeshingContext whole{run, octree, model, *stages.tree};
  makePlain(stages, kept != nullptr, options, drawn, port, clock, whole.part(0.0, 0.55));
  ReachedStage& reached = *stages.reached.result;
  const MeshingContext context = reached.in(whole);
  PlainDual plain = kept ? *kept->plain.result : std::move(*own.plain.result);
  DualMeshResult result = std::move(plain.found);
  port.complete(plain.mesh, result.diagnostics, reached.model.get(), clock, context);
  context.progress.report(0.55, "Growing layers");
  ImprovedMesh improved = growLayers(std::move(plain.mesh), options, port, context.part(0.55, 0.98));
  appendLeftOut(improved, port.part({}), result.diagnostics);
  const OwnElements part = port.part(improved.numbers);
  countElements(improved.mesh, result.keptZones, part, result.zones);
  orderZoneFaces(improved.mesh);
  measureRooms(improved.mesh, context.model, octree.frame().domain, part, result.rooms);
  clock.lap("layers");
  result.audit = auditMesh(improved.mesh, plain.seen, part, context);
  clock.lap("audit");
  port.finish(std::move(improved), result, clock, context);
  context.progress.report(0.98, "Placing the mesh in the model");
  placeInModel(result, octree.frame().placement, context);
  clock.lap("layers");
  context.progress.report(1.0, "Meshed");
  return result;
}

DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context, DualStages* kept, const DrawnModel* drawn)
{
  MeshPort alone;
  return makeDualMesh(octree, model, options, clock, context, kept, drawn, alone);
}

} // namespace atria
