// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/DualImprover.h"

#include "Dual/Mesh/Sheets.h"
#include "Dual/Vertices/TurnedDomain.h"
#include "Mesher/Improvement/CurveJogs.h"
#include "Mesher/Improvement/ElementsToLeaveOut.h"
#include "Mesher/Improvement/UnfoldFaces.h"
#include "Mesher/LeaveOut.h"
#include "Optimize/Constraints/ModelConstraints.h"

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

/// The mean of the corners of the faces about a point.
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

/// See removeJogs. Points that left a curve go between those beside them. Returns whether anything changed.
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
    const bool isOther = last != noIndex && vertexOf[p] == vertexOf[last]; // of a sheet's two
    mesh.points[p] = isOther ? mesh.points[last] : constraints.place(p, meanAbout(mesh, graph, p));
    last = p;
  }
  return faces > 0;
}

/// Whether a surface, as a site, lies on the domain's bottom.
bool hasGround(const DualMesh& mesh, const LayerOptions& options)
{
  return std::ranges::any_of(mesh.boundaryFaces, [&](const BoundaryFace& face) {
    return face.onDomainSide && face.tag < options.surfaceCount() && face.direction == zMin;
  });
}

/// How far charts reach, in lattice units: the longest diagonal of their boxes.
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

/// Where all walls of a point are smaller than its octant, the mesh shows an outline of what is there: it gets one
/// layer, as several on leaves of trees would cost more than all else.
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

/// Surfaces without layers may have one where elements cannot be valid without, and so may the bottom beside a site:
/// where sizes change at the domain's edges, elements may have two neighbors only. The sides of a turned domain have
/// one everywhere: they cut the grid as walls do.
void support(const DualMesh& mesh, bool isTurned, LayerOptions& options)
{
  const Index bottom = hasGround(mesh, options) ? options.surfaceCount() + zMin : noIndex;
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
  for (const Index source : splitSheets(given.mesh, context))
  {
    given.vertexOf.push_back(given.vertexOf[source]);
  }
  return given;
}

ImprovedMesh growLayers(ClassifiedMesh given, const WallOptions& wallOptions, const MeshingContext& context)
{
  ImprovedMesh out;
  if (wallOptions.layers.empty())
  {
    out.mesh = std::move(given.mesh);
    return out;
  }
  LayerOptions options;
  options.ofTag = resolveLayerRules(wallOptions.layers, context.model.names);
  if (wallOptions.supportElements)
  {
    support(given.mesh, context.octree.frame().turnedDomain.has_value(), options);
  }
  options.sideNormals = sideNormalsOf(context.octree.frame());
  LayerWalls walls = findLayerWalls(given.mesh, options, context);
  if (straightenCurves(given, walls.graph, context))
  {
    walls = findLayerWalls(given.mesh, options, context);
  }
  if (options.isDivided())
  {
    keepOneOnDetails(given, context, walls);
  }
  context.progress.check();
  auto [layer, detached, failing] =
      improveLayer(context, given.classification, given.vertexOf, given.mesh, walls, options, wallOptions.curvedWalls);
  out.layers = reportLayers(given.mesh, walls, layer, options, context.model.names, context);
  out.mesh = std::move(layer.mesh);
  out.detached = std::move(detached);
  if (options.isAsked() || wallOptions.supportElements)
  {
    // Those of turned domains have layers that hold vertices of bad elements away from them.
    const bool sidesToo = !context.octree.frame().turnedDomain;
    leaveOut(findElementsToLeaveOut(out.mesh, failing, sidesToo, context), out);
  }
  return out;
}

} // namespace atria
