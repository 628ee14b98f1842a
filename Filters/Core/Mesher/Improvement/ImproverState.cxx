// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/ImproverState.h"

#include "Mesher/Improvement/LayerCells.h"
#include "Optimize/Constraints/ChainConstraints.h"

#include <algorithm>
#include <functional>

namespace atria {

MeshTraits traitsOf(const DualMesh& plain, const LayerOptions& options, FlatLayers flat)
{
  flat.determinantRoot = options.failsDeterminants ? 0.0 : flat.determinantRoot;
  return {.layered = std::ranges::any_of(options.ofTag, [](const WallLayers& wall) { return wall.layers > 0; }),
          .asked = options.isAsked(),
          .supported = std::ranges::find(options.supporting, SupportingLayer::whereNeeded) != options.supporting.end(),
          .hasHeights = options.hasHeights(),
          .divided = options.isDivided(),
          .hexahedral = std::ranges::all_of(plain.corners, hasAllCorners),
          .wraps = options.wraps,
          .flat = flat};
}

ImproverState::ImproverState(const MeshingContext& meshingContext, const VertexClassification& given,
                             const std::vector<Index>& vertices, DualMesh& plainMesh, const LayerWalls& layerWalls,
                             const LayerOptions& layerOptions, const MeshTraits& meshTraits)
    : context(meshingContext), wanted(given), classification(given), vertexOf(vertices), plain(plainMesh),
      walls(layerWalls), options(layerOptions), traits(meshTraits), grower(walls, options),
      mayLeave(vertexOf.size(), 1), excluded(vertexOf.size(), 0), suspect(vertexOf.size(), 0),
      measured(baseTargets(traits))
{
  const auto setExcluded = [&](char value, auto&& ofTag) {
    for (const BoundaryFace& face : plain.boundaryFaces)
    {
      for (int i = 0; i < 4 && ofTag(face.tag); ++i)
      {
        excluded[cornerOf(plain, face, i)] = value;
      }
    }
  };
  setExcluded(1, [&](Index tag) { return options.supportOf(tag) == SupportingLayer::whereNeeded; });
  setExcluded(0, [&](Index tag) { return options.isAsked(tag); }); // layers run up to surfaces without
  for (Index p = 0; p < vertexOf.size() && !walls.settled.isEmpty(); ++p)
  {
    mayLeave[vertexOf[p]] = mayLeave[vertexOf[p]] && !walls.settled.stays(p);
    excluded[p] = walls.settled.has(p) ? walls.settled.counts[p] == 0 : excluded[p];
  }
  if (!context.octree.frame().turnedDomain)
  {
    return;
  }
  // Vertices of turned sides that are not on these, as at corners of the model beside them, do not return to them.
  for (const BoundaryFace& face : plain.boundaryFaces)
  {
    const bool isLateral = face.tag >= options.surfaceCount() && isUprightSide(face.tag - options.surfaceCount());
    for (int i = 0; i < 4 && isLateral; ++i)
    {
      const Index vertex = vertexOf[cornerOf(plain, face, i)];
      mayLeave[vertex] = mayLeave[vertex] && classification.turnedSides[vertex] != 0;
    }
  }
}

std::vector<ShortCell> ImproverState::findShort(const QualityTargets& targets, float below)
{
  context.progress.check();
  measured.update(DualSource(layer.mesh), context);
  std::vector<ShortCell> cells = measured.shortOf(targets, below);
  if (!walls.settled.isEmpty())
  {
    std::erase_if(cells, [&](const ShortCell& cell) { return isOutside(cell.cell); });
  }
  if (!focus.empty())
  {
    std::erase_if(cells, [&](const ShortCell& cell) {
      return std::ranges::none_of(layer.mesh.corners[cell.cell], [&](Index p) { return focus[layer.wallPointOf(p)]; });
    });
  }
  return cells;
}

std::vector<ShortCell> ImproverState::run(const ImproverStage& stage, const std::vector<ShortCell>& cells)
{
  LayerFreedom freedom(*this);
  if (!stage.byChains)
  {
    return run(stage.options, cells, freedom.layer);
  }
  ChainConstraints chains(layer, freedom.layer);
  return run(stage.options, cells, chains);
}

std::vector<ShortCell> ImproverState::run(const OptimizerOptions& optimizerOptions, const std::vector<ShortCell>& cells,
                                          VertexConstraints& constraints)
{
  std::vector<Index> changed;
  std::vector<ShortCell> left =
      optimize(DualSource(layer.mesh), layer.mesh.points, cells, constraints, optimizerOptions, context, &changed);
  outdate(changed);
  return left;
}

bool ImproverState::isOutside(Index cell) const
{
  const auto& corners = layer.mesh.corners[cell];
  return std::ranges::any_of(corners, [&](Index p) { return walls.settled.isAtCut(layer.wallPointOf(p)); }) ||
         std::ranges::all_of(corners, [&](Index p) { return walls.settled.stays(layer.wallPointOf(p)); });
}

void ImproverState::measureBy(const QualityTargets& strictest)
{
  measured = MeasuredCells(strictest);
  std::vector<char> marked = pointsToEvaluate(layer, context.executor);
  for (Index p = 0; p < layer.plainPoints; ++p)
  {
    marked[p] |= suspect[p];
  }
  measured.outdate(cellsWithMarked(DualSource(layer.mesh), marked, context));
}

void ImproverState::outdate(const std::vector<Index>& cells)
{
  const std::vector<Index> outdated = withNeighbors(DualSource(layer.mesh), cells, context);
  measured.outdate(outdated);
  for (std::size_t i = 0; i < outdated.size() && !focus.empty(); ++i)
  {
    std::ranges::for_each(layer.mesh.corners[outdated[i]], [&](Index p) { focus[layer.wallPointOf(p)] = 1; });
  }
}

void ImproverState::outdateAt(const std::vector<char>& points)
{
  std::vector<char> marked(layer.mesh.points.size());
  for (Index p = 0; p < marked.size(); ++p)
  {
    marked[p] = points[layer.wallPointOf(p)];
  }
  outdate(cellsWithMarked(DualSource(layer.mesh), marked, context));
}

void ImproverState::grow()
{
  context.progress.check();
  layer = traits.layered ? grower.grow(plain, excluded, context) : withoutLayer(std::move(plain));
  context.progress.check();
}

void ImproverState::growAgain(const std::vector<char>& fresh)
{
  if (!traits.layered)
  {
    return;
  }
  std::copy_n(layer.mesh.points.begin(), layer.plainPoints, plain.points.begin());
  replaceLayer(grower.growAgain(plain, excluded, layer, fresh, context));
}

void ImproverState::replaceLayer(LayerMesh other)
{
  const LayerMesh before = std::exchange(layer, std::move(other));
  measured.renumber(cellsIn(layer, before));
  outdateAt(pointsChanged(layer, before, context.executor));
}

} // namespace atria
