// SPDX-License-Identifier: GPL-3.0-or-later
/// Agreement of ranks on one mesh, from the grid to the numbers of elements.
#pragma once

#include "Mesher/MeshPort.h"
#include "Ranks/SharedPiece.h"
#include "Ranks/SharedPoints.h"

namespace atria {

/// A rank's part of a mesh while it is made. Functions throw RanksDisagree if ranks found different results where their
/// shares meet. Then they need octrees with more rows.
class RankMesh : public MeshPort
{
public:
  /// `octree` is that of the share, whose leaves know their pieces of the model. The piece gets `ghostLevels` rings of
  /// elements of others, at least one. The share must outlive this.
  RankMesh(const RankShare& share, Octree octree, int ghostLevels);

  const Octree& octree() const { return octree_; }
  /// Returns the piece, whose mesh is in the result of finish().
  SharedPiece takePiece() { return std::move(piece_); }

  RankExchange& exchange() const override { return share_.exchange(); }
  std::function<bool(Index leaf)> ownLeaves(const Octree& octree) const override;
  const GridPart& divide(const Octree& octree, const GridPoints& points, const RunContext& context) override;
  void takeElements(const std::vector<Index>& ofPoint) override;
  void complete(ClassifiedMesh& plain, std::vector<Diagnostic>& diagnostics, ReachedModel* reached, StageClock& clock,
                const MeshingContext& context) override;
  std::optional<OctreeBlocks> blocks(std::size_t blockSize, const Octree& octree) const override;
  LayerOptions withBorder(LayerOptions options) const override;
  BlockPlan plan(ClassifiedMesh& plain, const OctreeBlocks& blocks, const MeshingContext& context) override;
  void endImprovement() override;
  OwnElements part(const DualMesh& plain, const LayerMesh& layer) const override;
  void takeLayer(DualMesh&& plain, LayerMesh&& layer) override;
  std::unique_ptr<LeaveOutExchange> leaveOutExchange(const DualMesh& mesh) const override;
  OwnElements part(const std::vector<Index>& numbers) const override;
  void finish(ImprovedMesh improved, DualMeshResult& result, StageClock& clock, const MeshingContext& context) override;

private:
  const RankShare& share_;
  Octree octree_;
  int ghostLevels_;
  /// The octree that the mesh is made in: `octree_`, or that of the model that air reaches.
  Octree* current_ = &octree_;
  std::optional<SharedPoints> points_;
  std::vector<PointKey> keys_; ///< one per element of the plain mesh, before it is completed
  SharedWindow window_;        ///< its mesh was taken
  Index borderTag_ = noIndex;
  DualMesh below_; ///< connections of the plain mesh
  LayerMesh layer_;
  std::optional<SharedLayers> layers_;
  SharedPiece piece_;
};

} // namespace atria
