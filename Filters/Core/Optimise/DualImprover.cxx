// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/DualImprover.h"

#include "Dual/Sheets.h"
#include "Optimise/ModelGuide.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace atria {

namespace {

/// Elements below this share of a target are no better than not valid.
constexpr float soundEnough = 0.05F;
constexpr Flatness nearlyFlat{0.2, 0.25};

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

} // namespace

DualImprover::DualImprover(const Octree& octree, const SurfaceModel& model, VertexAnchors anchors,
                           DualMeshResult& result, const RunContext& context)
    : octree_(octree), model_(model), anchors_(std::move(anchors)), result_(result), mesh_(result.mesh),
      context_(context), vertexOf_(result.mesh.points.size())
{
  std::iota(vertexOf_.begin(), vertexOf_.end(), Index{0});
}

void DualImprover::removeFlat()
{
  constexpr int mostLayers = 8;
  for (int i = 0; i < mostLayers && removeFlat({}, nullptr); ++i)
  {
  }
}

bool DualImprover::removeFlat(const Flatness& flatness, const std::vector<char>* among)
{
  std::vector<char> flat = findFlatElements(mesh_, flatness, context_);
  for (std::size_t e = 0; among && e < flat.size(); ++e)
  {
    flat[e] = flat[e] && (*among)[e] ? 1 : 0;
  }
  const MeshRenumbering numbers = removeElements(mesh_, flat);
  if (numbers.isIdentity())
  {
    return false;
  }
  renumber(numbers);
  return true;
}

void DualImprover::renumber(const MeshRenumbering& numbers)
{
  std::vector<Index> vertices(mesh_.points.size());
  for (std::size_t p = 0; p < vertexOf_.size(); ++p)
  {
    if (numbers.points[p] != noIndex)
    {
      vertices[numbers.points[p]] = vertexOf_[p];
    }
  }
  vertexOf_ = std::move(vertices);
  for (Diagnostic& diagnostic : result_.diagnostics)
  {
    diagnostic.element = diagnostic.element == noIndex ? noIndex : numbers.elements[diagnostic.element];
  }
}

void DualImprover::splitPoints()
{
  for (const Index source : splitSheets(mesh_, context_))
  {
    vertexOf_.push_back(vertexOf_[source]);
  }
}

OptimiserReport DualImprover::optimiseOnce(int rings)
{
  ModelGuide guide(octree_, model_, anchors_, mesh_.points, vertexOf_);
  OptimiserOptions options;
  options.targets.faceTetrahedra = false;
  options.rings = rings;
  return optimise(DualSource(mesh_), mesh_.points, boundaryPoints(mesh_), guide, options, context_);
}

void DualImprover::improve()
{
  constexpr int rounds = 6;
  for (int round = 0; round < rounds; ++round)
  {
    const OptimiserReport report = optimiseOnce(round < 2 ? 1 : 2);
    std::vector<char> bad(mesh_.elementCount(), 0);
    for (const ShortCell& found : report.shortCells)
    {
      bad[found.cell] = found.sound < soundEnough ? 1 : 0;
    }
    if (std::find(bad.begin(), bad.end(), 1) == bad.end())
    {
      return;
    }
    if (removeFlat(nearlyFlat, &bad))
    {
      splitPoints();
    }
    else
    {
      release(bad, round > 2);
    }
  }
}

/// Lets the vertices of elements leave what they should be on: curves for the surfaces that meet there; or all.
void DualImprover::release(const std::vector<char>& bad, bool all)
{
  for (Index e = 0; e < bad.size(); ++e)
  {
    for (const Index p : bad[e] ? std::span<const Index>(mesh_.corners[e]) : std::span<const Index>())
    {
      Freedom& freedom = anchors_.freedom[vertexOf_[p]];
      if (freedom == Freedom::curve && !all)
      {
        freedom = Freedom::beside;
      }
      else if (freedom != Freedom::free && all)
      {
        freedom = Freedom::loose;
      }
    }
  }
}

} // namespace atria
