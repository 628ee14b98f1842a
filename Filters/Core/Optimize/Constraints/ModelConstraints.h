// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Octree/Tree/MeshingContext.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Keeps vertices where the model wants them: on its surfaces and curves, in the planes of the domain.
class ModelConstraints : public VertexConstraints
{
public:
  /// `vertexOf` gives, for each point of the mesh, the vertex it stands for; it must outlive the constraints.
  ModelConstraints(const MeshingContext& context, const VertexClassification& classification,
                   const std::vector<Vec3>& points, const std::vector<Index>& vertexOf);

  /// Notes where points are, before these are moved. Pieces of the model near a point are looked up where it is first
  /// asked for, as most points that might be moved never are.
  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override { return classOf(point) != VertexClass::fixed; }
  Vec3 place(Index point, const Vec3& p) const override;
  Ways waysFrom(Index point, const Vec3& p, double step) const override;
  /// The place nearest to p on the pieces of the model the point is for, on the domain's planes. After prepare.
  Vec3 nearest(Index point, const Vec3& p) const;
  /// The same; `known` is a place on these pieces, mostly: what is farther away is not looked at.
  Vec3 nearest(Index point, const Vec3& p, const Vec3& known) const;
  /// The center of the point's octant, on the domain's planes through it.
  Vec3 centerOf(Index point) const;

private:
  /// What the pieces of a target are.
  enum class Kind : std::uint8_t
  {
    unknown, ///< not looked up yet
    triangles,
    featureEdges,
    charts ///< where triangles are many, they are not listed: those of these charts are looked for in the tree
  };
  struct Target
  {
    Vec3 start;
    Kind kind = Kind::unknown;
    Index last = 0; ///< the place in `pieces` of the one that was nearest when asked last
    std::vector<Index> pieces;
  };

  bool hasPieces(Index point) const
  {
    return classOf(point) != VertexClass::free && classOf(point) != VertexClass::detached;
  }
  VertexClass classOf(Index point) const { return classification_.classes[vertexOf_[point]]; }
  std::vector<Index> wantedPieces(Index vertex) const;
  std::vector<ModelItem> findPieces(Index point, const std::vector<Index>& wanted) const;
  void find(Index point, Target& target) const;
  Target& targetOf(Index point) const;
  struct OnPiece
  {
    Vec3 place;
    Index piece; ///< noIndex where the target has none
  };
  std::array<Vec3, 3> cornersOf(Index triangle) const;
  Vec3 nearestOn(const Target& target, Index piece, const Vec3& p) const;
  OnPiece nearestPiece(Target& target, const Vec3& p) const;
  Vec3 nearestOf(Target& target, const Vec3& p, const Vec3& known) const;
  bool isBeyond(const Target& target, Index piece, const Vec3& wanted, double reach) const;
  Vec3 onSides(Index point, Vec3 p) const;
  unsigned planesOf(Index point) const;
  SideBits turnedSidesOf(Index point) const;

  const Octree& octree_;
  const SurfaceModel& model_;
  const VertexClassification& classification_;
  const std::vector<Vec3>& points_;
  const std::vector<Index>& vertexOf_;
  std::vector<Index> slotOf_;
  mutable std::vector<Target> targets_;
  const TriangleTreeOnDemand& tree_;
};

} // namespace atria
