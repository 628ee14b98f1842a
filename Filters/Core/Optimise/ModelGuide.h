// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/DualVertices.h"
#include "Octree/TriangleTree.h"
#include "Optimise/VertexGuide.h"

namespace atria {

/// Keeps vertices where the model wants them: on its surfaces and curves, in the planes of the domain.
class ModelGuide : public VertexGuide
{
public:
  /// `vertexOf` gives, for each point of the mesh, the vertex it stands for; it must outlive the guide.
  ModelGuide(const Octree& octree, const SurfaceModel& model, TriangleTreeOnDemand& tree, const VertexAnchors& anchors,
             const std::vector<Vec3>& points, const std::vector<Index>& vertexOf);

  /// Notes where points are, before these are moved. Pieces of the model near a point are looked up where it is first
  /// asked for, as most points that might be moved never are.
  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override { return freedomOf(point) != Freedom::fixed; }
  Vec3 place(Index point, const Vec3& p) const override;
  Ways waysFrom(Index point, const Vec3& p, double step) const override;
  /// The place nearest to p on the pieces of the model the point is for, on the domain's planes. After prepare.
  Vec3 nearest(Index point, const Vec3& p) const;
  /// The centre of the point's octant, on the domain's planes through it.
  Vec3 centreOf(Index point) const;

private:
  /// Triangles or, with c equal to b, segments.
  using Piece = std::array<Vec3, 3>;
  struct Target
  {
    Vec3 start;
    bool isFound = false;
    std::vector<Piece> pieces;
    /// Where triangles are many, they are not listed: these charts are looked for in the tree.
    std::vector<Index> charts;
  };

  bool hasPieces(Index point) const
  {
    return freedomOf(point) != Freedom::free && freedomOf(point) != Freedom::released;
  }
  Freedom freedomOf(Index point) const { return anchors_.freedom[vertexOf_[point]]; }
  std::vector<Index> wantedPieces(Index vertex) const;
  std::vector<ModelItem> findPieces(Index point, const std::vector<Index>& wanted) const;
  void find(Index point, Target& target) const;
  const Target& targetOf(Index point) const;
  struct OnPiece
  {
    Vec3 place;
    const Piece* piece;
  };
  static OnPiece nearestPiece(const Target& target, const Vec3& p);
  Vec3 nearestOf(const Target& target, const Vec3& p) const;
  Vec3 onPlanes(Vec3 p, unsigned planes) const;
  unsigned planesOf(Index leaf) const;

  const Octree& octree_;
  const SurfaceModel& model_;
  const VertexAnchors& anchors_;
  const std::vector<Vec3>& points_;
  const std::vector<Index>& vertexOf_;
  std::vector<Index> slotOf_;
  mutable std::vector<Target> targets_;
  TriangleTreeOnDemand& tree_;
};

} // namespace atria
