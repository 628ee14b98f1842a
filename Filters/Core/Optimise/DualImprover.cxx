// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/DualImprover.h"

#include "Dual/Sheets.h"
#include "Dual/TurnedDomain.h"
#include "Optimise/LayerGuide.h"
#include "Optimise/ModelGuide.h"
#include "Surface/FeatureGraph.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace atria {

namespace {

/// Elements below this share of a target are no better than not valid.
constexpr float soundEnough = 0.05F;

std::vector<char> boundaryPoints(const DualMesh& mesh)
{
  std::vector<char> marked(mesh.points.size(), 0);
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    for (const std::uint8_t c : hexahedronFace[face.direction])
    {
      marked[mesh.corners[face.element][c]] = 1;
    }
  }
  return marked;
}

/// Puts the points of a layer where they are in another one of the same mesh.
void takePlaces(const LayerMesh& from, LayerMesh& to)
{
  std::copy_n(from.mesh.points.begin(), from.plainPoints, to.mesh.points.begin());
  for (Index p = 0; p < to.plainPoints; ++p)
  {
    if (to.copies[p] != noIndex && from.copies[p] != noIndex)
    {
      to.mesh.points[to.copies[p]] = from.mesh.points[from.copies[p]];
    }
  }
}

/// Excludes the wall points of elements that have no room. Marks those elements that have no copies; empty where all
/// have room.
std::vector<char> excludeCrowded(const LayerMesh& layer, const std::vector<ShortCell>& shortCells,
                                 std::vector<char>& excluded)
{
  std::vector<char> stuck;
  for (const ShortCell& found : shortCells)
  {
    if (found.sound >= soundEnough)
    {
      continue;
    }
    stuck.resize(layer.mesh.elementCount(), 0);
    stuck[found.cell] = 1;
    for (const Index p : layer.mesh.corners[found.cell])
    {
      if (p >= layer.plainPoints)
      {
        excluded[layer.wallPoints[p - layer.plainPoints]] = 1;
        stuck[found.cell] = 0;
      }
    }
  }
  return stuck;
}

} // namespace

DualImprover::DualImprover(const Octree& octree, const SurfaceModel& model, VertexAnchors anchors,
                           DualMeshResult& result, const RunContext& context)
    : octree_(octree), model_(model), anchors_(std::move(anchors)), result_(result), mesh_(result.mesh),
      context_(context), vertexOf_(result.mesh.points.size())
{
  std::iota(vertexOf_.begin(), vertexOf_.end(), Index{0});
  if (octree.frame().turnedDomain)
  {
    // Sides have numbers above those of the names.
    for (const std::vector<Index>& surfaces : surfacesOfCurves(model))
    {
      onTurnedSide_.push_back(!surfaces.empty() && surfaces.back() >= model.names.size() ? 1 : 0);
    }
  }
}

void DualImprover::improve()
{
  ModelGuide guide(octree_, model_, anchors_, mesh_.points, vertexOf_);
  OptimiserOptions options;
  options.targets.faceTetrahedra = false;
  optimise(DualSource(mesh_), mesh_.points, boundaryPoints(mesh_), guide, options, context_);
}

/// Lets the vertices of elements leave curves for the surfaces that meet there.
void DualImprover::release(const DualMesh& mesh, const std::vector<char>& bad)
{
  for (Index e = 0; e < bad.size(); ++e)
  {
    for (const Index p : bad[e] ? std::span<const Index>(mesh.corners[e]) : std::span<const Index>())
    {
      if (p < vertexOf_.size() && anchors_.freedom[vertexOf_[p]] == Freedom::curve && !isOnTurnedSide(vertexOf_[p]))
      {
        anchors_.freedom[vertexOf_[p]] = Freedom::beside;
      }
    }
  }
}

/// Whether a curve the vertex is on lies on a side of a turned domain.
bool DualImprover::isOnTurnedSide(Index vertex) const
{
  return !onTurnedSide_.empty() &&
         std::ranges::any_of(anchors_.piecesOf(vertex), [&](Index curve) { return onTurnedSide_[curve] != 0; });
}

void DualImprover::splitPoints()
{
  for (const Index source : splitSheets(mesh_, context_))
  {
    vertexOf_.push_back(vertexOf_[source]);
  }
}

void DualImprover::growLayers(const std::vector<LayerRule>& rules)
{
  LayerOptions options;
  options.ofTag = resolveLayerRules(rules, model_.names);
  options.sideNormals = sideNormalsOf(octree_.frame());
  const auto most = std::ranges::max_element(options.ofTag, {}, &WallLayers::layers);
  if (most->layers == 0)
  {
    return;
  }
  const DualMesh plain = std::move(mesh_);
  const LayerWalls walls = findLayerWalls(plain, options, context_);
  LayerMesh layer = growOptimised(plain, walls, options);
  if (most->layers > 1)
  {
    layer = divideLayer(plain, walls, layer, options, context_);
  }
  result_.layers = reportLayers(plain, walls, layer, options, model_.names);
  mesh_ = std::move(layer.mesh);
  for (std::size_t e = layer.plainElements; e < mesh_.elementCount(); ++e)
  {
    ++result_.zones[mesh_.zones[e]].elements;
  }
}

LayerMesh DualImprover::growOptimised(const DualMesh& plain, const LayerWalls& walls, const LayerOptions& options)
{
  constexpr int rounds = 5;
  std::vector<char> excluded(plain.points.size(), 0);
  LayerMesh layer;
  for (int round = 0; round < rounds; ++round)
  {
    LayerMesh grown = growLayer(plain, walls, options, excluded, context_);
    if (round > 0)
    {
      takePlaces(layer, grown);
    }
    layer = std::move(grown);
    const std::vector<ShortCell> shortCells = optimiseLayer(layer, walls, options, round == 0 ? 1 : 2);
    const std::vector<char> stuck = excludeCrowded(layer, shortCells, excluded);
    if (stuck.empty())
    {
      break;
    }
    release(layer.mesh, stuck);
  }
  return layer;
}

/// Returns the elements that still fall short.
std::vector<ShortCell> DualImprover::optimiseLayer(LayerMesh& layer, const LayerWalls& walls,
                                                   const LayerOptions& options, int rings)
{
  std::vector<char> marked = boundaryPoints(layer.mesh);
  std::fill(marked.begin() + layer.plainPoints, marked.end(), 1);
  ModelGuide model(octree_, model_, anchors_, layer.mesh.points, vertexOf_);
  std::vector<Index> leaders(vertexOf_.size());
  std::vector<Index> first(anchors_.freedom.size(), noIndex);
  for (Index p = 0; p < leaders.size(); ++p)
  {
    Index& of = first[vertexOf_[p]];
    of = of == noIndex ? p : of;
    leaders[p] = of;
  }
  LayerGuide guide(layer, walls, options, leaders, model);
  OptimiserOptions optimiser;
  optimiser.rings = rings;
  const DualSource source(layer.mesh);
  optimise(source, layer.mesh.points, marked, guide, optimiser, context_);
  return findShortCells(source, marked, guide, optimiser.targets, context_);
}

} // namespace atria
