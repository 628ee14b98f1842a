// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/DualImprover.h"

#include "Dual/Mesh/Sheets.h"
#include "Dual/Vertices/TurnedDomain.h"
#include "Mesher/Improvement/CurveJogs.h"
#include "Mesher/Improvement/LayerImprover.h"
#include "Mesher/Improvement/UnfoldFaces.h"
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

} // namespace

DualImprover::DualImprover(const Octree& octree, const SurfaceModel& model, TriangleTreeOnDemand& tree,
                           VertexAnchors anchors, DualMeshResult& result, const RunContext& context)
    : octree_(octree), model_(model), tree_(tree), anchors_(std::move(anchors)), result_(result), mesh_(result.mesh),
      context_(context), vertexOf_(result.mesh.points.size())
{
  std::iota(vertexOf_.begin(), vertexOf_.end(), Index{0});
}

void DualImprover::unfoldWalls()
{
  ModelGuide guide(octree_, model_, tree_, anchors_, mesh_.points, vertexOf_);
  unfoldFaces(mesh_, guide, context_);
}

void DualImprover::splitPoints()
{
  for (const Index source : splitSheets(mesh_, context_))
  {
    vertexOf_.push_back(vertexOf_[source]);
  }
}

void DualImprover::growLayers(const std::vector<LayerRule>& rules, const CurvedWallTargets& curvedWalls)
{
  if (rules.empty())
  {
    return;
  }
  LayerOptions options;
  options.ofTag = resolveLayerRules(rules, model_.names);
  options.sideNormals = sideNormalsOf(octree_.frame());
  const int most = std::ranges::max_element(options.ofTag, {}, &WallLayers::layers)->layers;
  DualMesh plain = std::move(mesh_);
  LayerWalls walls = findLayerWalls(plain, options, context_);
  if (straightenCurves(plain, walls.graph))
  {
    walls = findLayerWalls(plain, options, context_);
  }
  context_.progress.check();
  LayerImprover improver(octree_, model_, tree_, anchors_, vertexOf_, plain, walls, options, curvedWalls, context_);
  LayerMesh layer = improver.run();
  if (most > 0)
  {
    result_.layers = reportLayers(plain, walls, layer, options, model_.names, context_);
  }
  mesh_ = std::move(layer.mesh);
  reportReleased(improver.released());
  for (std::size_t e = layer.plainElements; e < mesh_.elementCount(); ++e)
  {
    ++result_.zones[mesh_.zones[e]].elements;
  }
}

/// See removeJogs. Points that left a curve go between those beside them. Returns whether anything changed.
bool DualImprover::straightenCurves(DualMesh& plain, const BoundaryGraph& graph)
{
  const auto [faces, freed] = removeJogs(plain, graph, vertexOf_, anchors_);
  ModelGuide guide(octree_, model_, tree_, anchors_, plain.points, vertexOf_);
  guide.prepare(freed, context_);
  Index last = noIndex;
  for (const Index p : freed)
  {
    const bool isOther = last != noIndex && vertexOf_[p] == vertexOf_[last]; // of a sheet's two
    plain.points[p] = isOther ? plain.points[last] : guide.place(p, meanAbout(plain, graph, p));
    last = p;
  }
  return faces > 0;
}

/// Each with an element that has it.
void DualImprover::reportReleased(const std::vector<ReleasedVertex>& released)
{
  if (released.empty())
  {
    return;
  }
  std::vector<Index> slots(mesh_.points.size(), noIndex);
  for (Index i = 0; i < released.size(); ++i)
  {
    slots[released[i].point] = i;
  }
  std::vector<Index> elements(released.size(), noIndex);
  for (Index e = 0; e < mesh_.elementCount(); ++e)
  {
    for (const Index p : mesh_.corners[e])
    {
      if (slots[p] != noIndex && elements[slots[p]] == noIndex)
      {
        elements[slots[p]] = e;
      }
    }
  }
  for (std::size_t i = 0; i < released.size(); ++i)
  {
    result_.diagnostics.push_back(
        {Diagnostic::releasedVertex, mesh_.points[released[i].point], released[i].wanted, elements[i]});
  }
}

} // namespace atria
