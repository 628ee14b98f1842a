// SPDX-License-Identifier: GPL-3.0-or-later
/// Keeps the boundary of any mesh in shape while its points move.
#pragma once

#include "Optimize/AnyMesh/BoundaryFeatures.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Keeps the boundary of a mesh in shape. Corners stay, points on kept edges slide along these, other boundary points
/// slide on their smooth piece of the boundary. All stay within two faces or edges of where they were.
class BoundaryConstraints : public VertexConstraints
{
public:
  /// `mesh` and `features` must outlive the constraints. The points of the mesh must not change while place() is
  /// called. If `fixed`, no point of the boundary moves.
  BoundaryConstraints(const FaceMesh& mesh, const BoundaryFeatures& features, bool fixed);

  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override;
  Index leaderOf(Index point) const override { return features_.leaders[point]; }
  Vec3 place(Index point, const Vec3& p) const override;

private:
  /// Faces or edges, as indices into the lists of the features, and the axes on which they all have one coordinate.
  struct Reach
  {
    std::vector<Index> pieces;
    std::array<bool, 3> fixedAxes{};
  };

  BoundaryKind kindOf(Index point) const { return features_.kinds[features_.leaders[point]]; }
  Reach findReach(Index point) const;
  std::vector<Index> edgesNear(Index point) const;
  std::vector<Index> facesNear(Index point) const;
  Vec3 nearestOnFace(Index face, const Vec3& p) const;

  const FaceMesh& mesh_;
  const BoundaryFeatures& features_;
  bool fixed_;
  std::vector<Index> slotOf_;
  std::vector<Reach> reaches_;
};

} // namespace atria
