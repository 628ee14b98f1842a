// SPDX-License-Identifier: GPL-3.0-or-later
/// Keeps vertices on the model and in the planes of the domain.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Octree/Tree/MeshingContext.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Keeps vertices on the surfaces and curves of the model that they belong to, and in the planes of the domain.
class ModelConstraints : public VertexConstraints
{
public:
  /// `vertexOf` has one entry per point of the mesh: the vertex it stands for. It must outlive the constraints.
  ModelConstraints(const MeshingContext& context, const VertexClassification& classification,
                   const std::vector<Vec3>& points, const std::vector<Index>& vertexOf);

  /// Stores where points are before they are moved. Pieces of the model near a point are searched when they are first
  /// needed, because most points never move.
  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override { return classOf(point) != VertexClass::fixed; }
  Vec3 place(Index point, const Vec3& p) const override;
  Ways waysFrom(Index point, const Vec3& p, double step) const override;
  /// Returns the position nearest to p on the point's pieces of the model and in the domain's planes; the one that
  /// prepare() stored if there are no pieces. prepare() must have been called for the point.
  Vec3 nearest(Index point, const Vec3& p) const;
  /// The same, faster. `known` is a position on these pieces, in most cases: charts are first searched no farther from
  /// p than that.
  Vec3 nearest(Index point, const Vec3& p, const Vec3& known) const;
  /// Returns the center of the point's octant, moved to the domain's planes through the octant.
  Vec3 centerOf(Index point) const;

private:
  /// Kind of a target's pieces.
  enum class Kind : std::uint8_t
  {
    unknown, ///< not searched yet
    triangles,
    featureEdges,
    charts ///< too many triangles to list; the tree is searched for those of these charts
  };
  struct Target
  {
    Vec3 start;
    Kind kind = Kind::unknown;
    Index last = 0; ///< place in `pieces` of the one that was nearest last time
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
    Index piece; ///< noIndex if the target has none
  };
  std::array<Vec3, 3> cornersOf(Index triangle) const;
  Vec3 nearestOn(const Target& target, Index piece, const Vec3& p) const;
  OnPiece nearestPiece(Target& target, const Vec3& p) const;
  Vec3 nearestOf(Target& target, const Vec3& p, const Vec3& known) const;
  bool isBeyond(const Target& target, Index piece, const Vec3& wanted, double reach) const;
  Vec3 onSides(Index point, const Vec3& p) const;
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
