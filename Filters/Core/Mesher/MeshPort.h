// SPDX-License-Identifier: GPL-3.0-or-later
/// Port through which the stages of a mesh agree with the other processes that make it.
#pragma once

#include "Dual/Grid/GridPart.h"
#include "Dual/Mesh/OwnElements.h"
#include "Layer/LayerTopology.h"
#include "Mesher/Blocks/BlockExchange.h"
#include "Mesher/Blocks/ClassifiedMesh.h"
#include "Mesher/Blocks/MeshBlocks.h"
#include "Mesher/Diagnostic.h"
#include "Mesher/Improvement/ElementsToLeaveOut.h"
#include "Octree/Tree/OctreeBlocks.h"
#include "Support/StageClock.h"

#include <memory>
#include <optional>

namespace atria {

class ReachedModel;
struct DualMeshResult;
struct ImprovedMesh;

/// Blocks of a mesh that this process improves, and its exchange with those that improve the others.
struct BlockPlan
{
  MeshBlocks blocks;
  std::unique_ptr<BlockExchange> exchange;
};

/// Answers the questions of stages, in the order of the stages. This class is for a process that makes the whole mesh:
/// it owns everything, so that it has nothing to ask. Ranks/RankMesh.h has the one for ranks.
class MeshPort
{
public:
  virtual ~MeshPort() = default;

  virtual RankExchange& exchange() const { return alone(); }
  /// Tells which leaves of an octree this process owns; empty if it owns all.
  virtual std::function<bool(Index leaf)> ownLeaves(const Octree& /*octree*/) const { return {}; }
  /// Divides the points of the octree's grid. The result stays valid until takeElements().
  virtual const GridPart& divide(const Octree& octree, const GridPoints& points, const RunContext& context);
  /// Learns the elements of grid points, noIndex for points that have none.
  virtual void takeElements(const std::vector<Index>& /*ofPoint*/) {}
  /// Completes the plain mesh by the elements of others that its improvement depends on, and renumbers diagnostics.
  /// `reached` has the octree of the context if that is not the one of the whole model; null otherwise.
  virtual void complete(ClassifiedMesh& /*plain*/, std::vector<Diagnostic>& /*diagnostics*/, ReachedModel* /*reached*/,
                        StageClock& /*clock*/, const MeshingContext& /*context*/)
  {
  }
  /// Returns the blocks of the whole octree, of about `blockSize` octants; nullopt if the mesh is improved as a whole.
  virtual std::optional<OctreeBlocks> blocks(std::size_t blockSize, const Octree& octree) const;
  /// Adds the border at which the plain mesh ends to the options of its surfaces.
  virtual LayerOptions withBorder(LayerOptions options) const { return options; }
  /// Plans the improvement of the plain mesh in `blocks`. Both must stay where they are until it ends.
  virtual BlockPlan plan(ClassifiedMesh& plain, const OctreeBlocks& blocks, const MeshingContext& context);
  /// Frees what no stage after the improvement needs.
  virtual void endImprovement() {}
  /// Divides the elements of a mesh with layers that was made of `plain`.
  virtual OwnElements part(const DualMesh& /*plain*/, const LayerMesh& /*layer*/) const { return {}; }
  /// Learns how layers stand on the plain mesh. The mesh of `layer` was moved away before.
  virtual void takeLayer(DualMesh&& /*plain*/, LayerMesh&& /*layer*/) {}
  virtual std::unique_ptr<LeaveOutExchange> leaveOutExchange(const DualMesh& mesh) const;
  /// Divides the elements of the mesh after elements were left out. `numbers` is as in ImprovedMesh; empty for the mesh
  /// before.
  virtual OwnElements part(const std::vector<Index>& /*numbers*/) const { return {}; }
  /// Moves the improved mesh to the result, with its layers and all diagnostics in their order. Before, the diagnostics
  /// of the result have the numbers of elements from before any were left out.
  virtual void finish(ImprovedMesh improved, DualMeshResult& result, StageClock& clock, const MeshingContext& context);

private:
  std::optional<GridPart> whole_;
};

} // namespace atria
