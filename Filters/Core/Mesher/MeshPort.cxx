// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/MeshPort.h"

#include "Mesher/DualMesher.h"

#include <algorithm>

namespace atria {

namespace {

/// Adds each detached vertex, with an element that has it.
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

} // namespace

const GridPart& MeshPort::divide(const Octree& /*octree*/, const GridPoints& points, const RunContext& /*context*/)
{
  return whole_.emplace(points);
}

std::optional<OctreeBlocks> MeshPort::blocks(std::size_t blockSize, const Octree& octree) const
{
  if (blockSize == 0)
  {
    return std::nullopt;
  }
  std::optional<OctreeBlocks> blocks = findBlocks(octree.refinedSets(), octree.frame(), blockSize);
  return blocks->count() > 1 ? std::move(blocks) : std::nullopt;
}

BlockPlan MeshPort::plan(ClassifiedMesh& plain, const OctreeBlocks& blocks, const MeshingContext& context)
{
  NearBoundary near = findNearBoundary(plain.mesh, plain.vertexOf, plain.classification.classes.size());
  return {blocksOf(context.octree, plain.classification.leaves, blocks, 0, static_cast<Index>(blocks.count()),
                   std::move(near)),
          std::make_unique<BlockExchange>()};
}

std::unique_ptr<LeaveOutExchange> MeshPort::leaveOutExchange(const DualMesh& /*mesh*/) const
{
  return std::make_unique<LeaveOutExchange>();
}

void MeshPort::finish(ImprovedMesh improved, DualMeshResult& result, StageClock& /*clock*/,
                      const MeshingContext& context)
{
  for (Diagnostic& diagnostic : result.diagnostics)
  {
    if (!improved.numbers.empty() && diagnostic.element != noIndex)
    {
      diagnostic.element = improved.numbers[diagnostic.element];
    }
  }
  result.mesh = std::move(improved.mesh);
  result.layers = std::move(improved.layers);
  appendDetached(result.mesh, improved.detached, result.diagnostics);
  result.metSides = findMetSides(result.mesh, context.model.names.size());
}

} // namespace atria
