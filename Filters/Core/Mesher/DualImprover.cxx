// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/DualImprover.h"

#include "Dual/Mesh/Sheets.h"
#include "Dual/Vertices/TurnedDomain.h"
#include "Layer/EdgeTubes.h"
#include "Layer/LayerHeights.h"
#include "Layer/WallFans.h"
#include "Mesher/Blocks/BlockImprover.h"
#include "Mesher/Improvement/CurveJogs.h"
#include "Mesher/Improvement/ElementsToLeaveOut.h"
#include "Mesher/Improvement/UnfoldFaces.h"
#include "Mesher/LeaveOut.h"
#include "Mesher/MeshPort.h"
#include "Mesher/ThinLayers.h"
#include "Optimize/Constraints/ModelConstraints.h"
#include "Support/Numbering.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace atria {

namespace {

/// Returns the mean of the corners of the faces around a point.
Vec3 meanAbout(const DualMesh& mesh, const BoundaryGraph& graph, Index point)
{
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const Index f : graph.facesAt(point))
  {
    for (const Index corner : cornersOf(mesh, mesh.boundaryFaces[f]))
    {
      sum += mesh.points[corner];
      ++count;
    }
  }
  return sum / count;
}

/// Removes jogs; see removeJogs. Puts points that left a curve between their neighbors. Returns true if anything
/// changed.
bool straightenCurves(ClassifiedMesh& plain, const BoundaryGraph& graph, const MeshingContext& context)
{
  DualMesh& mesh = plain.mesh;
  const std::vector<Index>& vertexOf = plain.vertexOf;
  const auto [faces, freed] = removeJogs(mesh, graph, vertexOf, plain.classification);
  ModelConstraints constraints(context, plain.classification, mesh.points, vertexOf);
  constraints.prepare(freed, context);
  Index last = noIndex;
  for (const Index p : freed)
  {
    const bool isOther = last != noIndex && vertexOf[p] == vertexOf[last]; // the other point of a sheet
    mesh.points[p] = isOther ? mesh.points[last] : constraints.place(p, meanAbout(mesh, graph, p));
    last = p;
  }
  return faces > 0;
}

/// Returns the longest diagonal of the box of each chart, in lattice units.
std::vector<double> extentsOfCharts(const SurfaceModel& model)
{
  std::vector<Box3> boxes(model.charts.empty() ? 0 : *std::ranges::max_element(model.charts) + 1);
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    const Box3 own = model.bounds(t);
    boxes[model.charts[t]].extend(own.min);
    boxes[model.charts[t]].extend(own.max);
  }
  std::vector<double> extents(boxes.size());
  std::ranges::transform(boxes, extents.begin(), [](const Box3& box) { return box.size().norm(); });
  return extents;
}

/// Limits points to one layer if all their walls are smaller than their octants. The mesh shows only an outline there,
/// and several layers on the leaves of trees would cost more than all else.
void keepOneOnDetails(const ClassifiedMesh& given, const MeshingContext& context, LayerWalls& walls)
{
  const std::vector<double> extents = extentsOfCharts(context.model);
  const GridFrame& frame = context.octree.frame();
  for (Index p = 0; p < walls.counts.size(); ++p)
  {
    const Index leaf = given.classification.leaves[given.vertexOf[p]];
    const auto size = static_cast<double>(frame.latticeSize(context.octree.level(leaf)));
    const auto isDetail = [&](Index f) {
      const Index chart = given.mesh.boundaryFaces[f].chart;
      return chart != noIndex && extents[chart] < size;
    };
    if (walls.counts[p] > 1 && std::ranges::all_of(walls.graph.facesAt(p), isDetail))
    {
      walls.counts[p] = 1;
    }
  }
}

/// Adds layers that support elements. Surfaces without layers may have one where elements cannot be valid without. So
/// may the bottom beside a site: elements may have only two neighbors where sizes change at the domain's edges. The
/// sides of a turned domain have one everywhere, as they cut the grid like walls.
void support(bool onGround, bool isTurned, LayerOptions& options)
{
  const Index bottom = onGround ? options.surfaceCount() + zMin : noIndex;
  options.supporting.assign(options.ofTag.size(), SupportingLayer::none);
  for (Index tag = 0; tag < options.ofTag.size(); ++tag)
  {
    const bool isSurface = tag < options.surfaceCount();
    const bool isTurnedSide = isTurned && !isSurface && isUprightSide(tag - options.surfaceCount());
    if (options.ofTag[tag].layers == 0 && (isSurface || isTurnedSide || tag == bottom))
    {
      options.supporting[tag] = isTurnedSide ? SupportingLayer::everywhere : SupportingLayer::whereNeeded;
      options.ofTag[tag] = {.layers = 1};
    }
  }
}

/// Gives all walls and sides as many layers as the wall with most, one at least. So layers end nowhere, and prisms are
/// hexahedra. Sides need a layer where sizes change: they cut octants so that elements would be flat. As many as fit
/// are those beside the finest elements.
void layerAll(LayerOptions& options, double finestSize)
{
  const int most = std::max(1, mostLayersOf(options.ofTag, finestSize));
  options.wraps = true;
  options.supporting.assign(options.ofTag.size(), SupportingLayer::none);
  for (Index tag = 0; tag < options.ofTag.size(); ++tag)
  {
    options.supporting[tag] = options.ofTag[tag].layers == 0 ? SupportingLayer::everywhere : SupportingLayer::none;
    options.ofTag[tag].layers = most;
  }
}

/// Returns a unit for areas, so fine that sums of some hundred times the square of the domain's longest side are exact.
double areaUnitOf(const Vec3& domain) { return std::exp2(std::ceil(2.0 * std::log2(domain.maxCoeff())) - 44.0); }

/// True if a surface lies on the domain's bottom anywhere in this process.
bool hasGround(const DualMesh& mesh, Index surfaceCount)
{
  return std::ranges::any_of(mesh.boundaryFaces, [&](const BoundaryFace& face) {
    return face.onDomainSide && face.tag < surfaceCount && face.direction == zMin;
  });
}

/// True if the mesh was made of hexahedra only (makeHexahedral).
bool isOfHexahedra(const ClassifiedMesh& given) { return !given.classification.planes.empty(); }

/// Returns the layers of walls, by rule and where elements need one. `onGround` is true if a surface lies on the
/// domain's bottom.
LayerOptions layerOptionsOf(const WallOptions& wallOptions, bool onGround, bool hexahedra,
                            const MeshingContext& context)
{
  LayerOptions options;
  options.ofTag = resolveLayerRules(wallOptions.layers, context.model.names);
  if (hexahedra)
  {
    layerAll(options, context.octree.frame().sizeOf(context.octree.maximumLevel()));
  }
  else if (wallOptions.supportElements)
  {
    support(onGround, context.octree.frame().turnedDomain.has_value(), options);
  }
  options.sideNormals = sideNormalsOf(context.octree.frame());
  options.areaUnit = areaUnitOf(context.octree.frame().domain.size());
  return options;
}

/// Removes jogs, and then finds the walls of the mesh.
LayerWalls prepareWalls(ClassifiedMesh& plain, const EdgeTubes& tubes, const LayerOptions& options,
                        const MeshingContext& context)
{
  LayerWalls walls = findLayerWalls(plain.mesh, options, context);
  if (straightenCurves(plain, walls.graph, context))
  {
    walls = findLayerWalls(plain.mesh, options, context);
  }
  if (options.isDivided())
  {
    keepOneOnDetails(plain, context, walls);
  }
  keepTubes(plain.mesh, tubes, walls);
  context.progress.check();
  return walls;
}

/// Cuts tubes out in front of the boundary edges of sheets.
EdgeTubes cutTubes(ClassifiedMesh& given, const MeshingContext& context)
{
  EdgeTubes tubes = findEdgeTubes(given.mesh, context);
  if (!tubes.isEmpty())
  {
    cutTubes(given.mesh, static_cast<Index>(context.model.names.size()), tubes);
    given = splitPoints(std::move(given), context);
  }
  return tubes;
}

/// Joins tubes to the layers around them.
void joinTubes(const EdgeTubes& tubes, const std::vector<Index>& vertexOf, Index surfaceCount, ImprovedMesh& improved)
{
  const JoinedTubes joined = joinTubes(improved.mesh, tubes, vertexOf, surfaceCount);
  compact(improved.layers.counts, joined.faces);
  compact(improved.layers.thicknesses, joined.faces);
  for (DetachedVertex& vertex : improved.detached)
  {
    vertex.point = joined.points[vertex.point];
  }
}

/// Sorts the boundary faces of a mesh in the order that they have in any part of it.
void orderFaces(ImprovedMesh& improved)
{
  const std::vector<Index> order = orderBoundaryFaces(improved.mesh);
  const auto reorder = [&](auto& list) {
    auto ordered = list;
    for (std::size_t f = 0; f < list.size(); ++f)
    {
      ordered[f] = list[order[f]];
    }
    list = std::move(ordered);
  };
  reorder(improved.layers.counts);
  reorder(improved.layers.thicknesses);
}

/// Improves the mesh as a whole or in blocks.
ImprovedLayer improve(ClassifiedMesh& given, const LayerWalls& walls, const LayerOptions& options,
                      const FlatLayers& flat, const CurvedWallTargets& curvedWalls,
                      const std::optional<OctreeBlocks>& blocks, MeshPort& port, const MeshingContext& context)
{
  if (!blocks)
  {
    return improveLayer(context, given.classification, given.vertexOf, given.mesh, walls, options, curvedWalls);
  }
  MeshTraits traits = traitsOf(given.mesh, options, flat); // not by faces: other processes have others
  traits.hexahedral = false;                               // no crease sheets
  const ImprovedBlocks improved = [&] {
    const BlockPlan plan = port.plan(given, *blocks, context);
    return improveBlocks(context, given.classification, given.vertexOf, given.mesh, walls, options, curvedWalls, traits,
                         plan.blocks, *plan.exchange);
  }();
  port.endImprovement();
  given.classification = {};
  release(given.vertexOf);
  return layersOfBlocks(improved, given.mesh, walls, traits, context);
}

} // namespace

ClassifiedMesh classified(DualMesh mesh, VertexClassification classification)
{
  std::vector<Index> vertexOf(mesh.points.size());
  std::iota(vertexOf.begin(), vertexOf.end(), Index{0});
  return {std::move(mesh), std::move(classification), std::move(vertexOf)};
}

ClassifiedMesh unfoldWalls(ClassifiedMesh given, const MeshingContext& context)
{
  ModelConstraints constraints(context, given.classification, given.mesh.points, given.vertexOf);
  unfoldFaces(given.mesh, constraints, context);
  return given;
}

ClassifiedMesh splitPoints(ClassifiedMesh given, const MeshingContext& context)
{
  const std::vector<Index> sources = splitSheets(given.mesh, context);
  given.vertexOf.reserve(given.vertexOf.size() + sources.size());
  for (const Index source : sources)
  {
    given.vertexOf.push_back(given.vertexOf[source]);
  }
  return given;
}

ImprovedMesh growLayers(ClassifiedMesh given, const WallOptions& wallOptions, MeshPort& port,
                        const MeshingContext& context)
{
  ImprovedMesh out;
  const std::optional<OctreeBlocks> blocks = port.blocks(wallOptions.blockSize, context.octree);
  if (blocks)
  {
    orderBoundaryFaces(given.mesh);
  }
  if (wallOptions.layers.empty())
  {
    LayerMesh plain = withoutLayer(std::move(given.mesh));
    out.mesh = std::move(plain.mesh);
    port.takeLayer({}, std::move(plain));
    return out;
  }
  const auto surfaceCount = static_cast<Index>(context.model.names.size());
  const bool onGround = isAnywhere(hasGround(given.mesh, surfaceCount), port.exchange());
  LayerOptions whole = layerOptionsOf(wallOptions, onGround, isOfHexahedra(given), context);
  const FittedLayers fit = fitLayers(whole, port, context);
  const EdgeTubes tubes = isOfHexahedra(given) ? cutTubes(given, context) : EdgeTubes();
  if (isOfHexahedra(given))
  {
    separateFans(given.mesh, tubes, given.classification, given.vertexOf);
  }
  const std::vector<Index> vertexOf = tubes.isEmpty() ? std::vector<Index>() : given.vertexOf;
  if (!tubes.isEmpty())
  {
    addTubes(whole);
  }
  const LayerOptions options = port.withBorder(std::move(whole));
  const LayerWalls walls = prepareWalls(given, tubes, options, context);
  auto [layer, detached, failing, sizes] =
      improve(given, walls, options, fit.flat, wallOptions.curvedWalls, blocks, port, context);
  out.layers = reportLayers(layer, walls, sizes, options, context.model.names, port.part(given.mesh, layer));
  out.layers.thin = fit.thin;
  out.mesh = std::move(layer.mesh);
  out.detached = std::move(detached);
  if (!tubes.isEmpty())
  {
    joinTubes(tubes, vertexOf, surfaceCount, out);
  }
  port.takeLayer(std::move(given.mesh), std::move(layer));
  if (options.isAsked() || wallOptions.supportElements)
  {
    // The sides of turned domains have layers, which hold vertices of bad elements away from them.
    const bool sidesToo = !context.octree.frame().turnedDomain;
    const std::unique_ptr<LeaveOutExchange> exchange = port.leaveOutExchange(out.mesh);
    leaveOut(findElementsToLeaveOut(out.mesh, failing, sidesToo, *exchange, context), out);
  }
  if (blocks)
  {
    orderFaces(out); // faces beside elements left out were appended
  }
  return out;
}

} // namespace atria
