// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/RankMesh.h"

#include "Mesher/Blocks/MeshWindow.h"
#include "Mesher/DualMesher.h"
#include "Ranks/RankDiagnostics.h"
#include "Ranks/SharedBlocks.h"
#include "Support/FreedMemory.h"

#include <algorithm>
#include <utility>

namespace atria {

namespace {

/// Selects the values of the piece's faces from those of all faces of the rank's mesh.
template <typename List> void takeByFace(const List& ofMesh, const std::vector<Index>& facesBefore, List& ofPiece)
{
  for (std::size_t f = 0; f < facesBefore.size() && !ofMesh.empty(); ++f)
  {
    ofPiece.push_back(ofMesh[facesBefore[f]]);
  }
}

} // namespace

RankMesh::RankMesh(const RankShare& share, Octree octree, int ghostLevels)
    : share_(share), octree_(std::move(octree)), ghostLevels_(ghostLevels)
{
}

std::function<bool(Index leaf)> RankMesh::ownLeaves(const Octree& octree) const
{
  return [&](Index leaf) { return share_.isOwn(octree.finestKey(leaf)); };
}

const GridPart& RankMesh::divide(const Octree& octree, const GridPoints& points, const RunContext& context)
{
  // The points are the same in all stages, also for the model that air reaches.
  return points_ ? *points_ : points_.emplace(share_, octree, points, context);
}

void RankMesh::takeElements(const std::vector<Index>& ofPoint)
{
  keys_.reserve(ofPoint.size());
  for (Index point = 0; point < ofPoint.size(); ++point)
  {
    if (ofPoint[point] != noIndex)
    {
      keys_.push_back(points_->key(point));
    }
  }
  points_.reset();
}

void RankMesh::complete(ClassifiedMesh& plain, std::vector<Diagnostic>& diagnostics, ReachedModel* reached,
                        StageClock& clock, const MeshingContext& context)
{
  std::erase_if(diagnostics, [&](const Diagnostic& found) { return !isOwn(keys_[found.element], share_); });
  std::vector<PointKey> keys;
  std::ranges::transform(diagnostics, std::back_inserter(keys),
                         [&](const Diagnostic& found) { return keys_[found.element]; });
  if (reached)
  {
    octree_ = Octree(octree_.frame(), {});
    current_ = &reached->octree();
  }
  borderTag_ = static_cast<Index>(context.model.names.size());
  window_ = makeWindow(shareOf(std::move(plain), std::exchange(keys_, {}), *current_, share_), borderTag_, share_,
                       context.model, *current_, context);
  plain = std::move(window_.plain);
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    diagnostics[i].element = findOwn(window_.elementKeys, window_.firstOwn, window_.endOwn, keys[i]);
  }
  clock.lap("elements");
}

std::optional<OctreeBlocks> RankMesh::blocks(std::size_t /*blockSize*/, const Octree& /*octree*/) const
{
  return share_.blocks();
}

LayerOptions RankMesh::withBorder(LayerOptions options) const { return optionsOfWindows(std::move(options)); }

BlockPlan RankMesh::plan(ClassifiedMesh& plain, const OctreeBlocks& blocks, const MeshingContext& context)
{
  MeshBlocks own = blocksOf(context.octree, plain.classification.leaves, blocks, share_.firstBlock(), share_.endBlock(),
                            std::move(window_.near));
  auto exchange = std::make_unique<SharedBlocks>(window_, plain.mesh, share_);
  exchange->takePlaces(plain.mesh.points, plain.classification.displacementLimits);
  return {std::move(own), std::move(exchange)};
}

void RankMesh::endImprovement()
{
  *current_ = Octree(current_->frame(), {});
  giveBackFreedMemory();
}

OwnElements RankMesh::part(const DualMesh& plain, const LayerMesh& layer) const
{
  const auto isOwn = [&](Index element) {
    const bool isPlain = element < layer.plainElements;
    return window_.isOwn(isPlain ? element
                                 : plain.boundaryFaces[layer.wallFaces[element - layer.plainElements]].element);
  };
  return {isOwn, exchange()};
}

void RankMesh::takeLayer(DualMesh&& plain, LayerMesh&& layer)
{
  below_.neighbors = std::move(plain.neighbors);
  below_.boundaryFaces = std::move(plain.boundaryFaces);
  layer_ = std::move(layer);
  layers_.emplace(window_, below_, layer_);
}

std::unique_ptr<LeaveOutExchange> RankMesh::leaveOutExchange(const DualMesh& mesh) const
{
  return std::make_unique<SharedLeaveOut>(mesh, *layers_, borderTag_, exchange());
}

OwnElements RankMesh::part(const std::vector<Index>& numbers) const
{
  std::vector<Index> before;
  for (Index e = 0; e < numbers.size(); ++e)
  {
    if (numbers[e] != noIndex)
    {
      before.push_back(e);
    }
  }
  return {[this, before = std::move(before)](Index e) { return layers_->isOwn(before.empty() ? e : before[e]); },
          exchange()};
}

void RankMesh::finish(ImprovedMesh improved, DualMeshResult& result, StageClock& clock, const MeshingContext& context)
{
  if (improved.mesh.zoneFaces.empty())
  {
    release(improved.mesh.neighbors);
  }
  giveBackFreedMemory();
  std::vector<SharedElement> asked;
  for (const Diagnostic& found : result.diagnostics)
  {
    if (found.element != noIndex)
    {
      asked.push_back(layers_->elementOf(found.element));
    }
  }
  piece_ = atria::takePiece(improved.mesh, {improved.numbers, improved.pointNumbers}, *layers_, layer_, share_,
                            ghostLevels_, asked);
  RankDiagnostics diagnostics(result.diagnostics, piece_, layer_);
  diagnostics.addDetached(improved.detached, piece_, share_.rank());
  result.diagnostics = diagnostics.gather(exchange());
  takeByFace(improved.layers.counts, piece_.facesBefore, result.layers.counts);
  takeByFace(improved.layers.thicknesses, piece_.facesBefore, result.layers.thicknesses);
  result.layers.surfaces = std::move(improved.layers.surfaces);
  result.layers.thin = std::move(improved.layers.thin);
  result.mesh = std::move(piece_.mesh);
  for (BoundaryFace& face : result.mesh.boundaryFaces)
  {
    face.tag -= face.tag > borderTag_ ? 1 : 0; // own elements have no faces on the border
  }
  result.metSides = addAll(exchange(), findMetSides(result.mesh, context.model.names.size(), piece_.hasOpposite),
                           [](const MetSides& more, MetSides& sum) { sum.add(more); });
  clock.lap("numbers");
}

} // namespace atria
