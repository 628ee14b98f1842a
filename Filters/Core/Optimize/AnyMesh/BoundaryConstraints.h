// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Optimize/AnyMesh/BoundaryFeatures.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Keeps the boundary of a mesh as it was: its corners stay, points on an edge that is kept slide along it, the others
/// along the smooth piece of the boundary they are on, all within two faces or edges of where they were.
class BoundaryConstraints : public VertexConstraints
{
public:
  /// Both must outlive the constraints, and the points must stay as they are as long as places are asked for. If
  /// `fixed`, no point of the boundary moves.
  BoundaryConstraints(const FaceMesh& mesh, const BoundaryFeatures& features, bool fixed);

  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override;
  Index leaderOf(Index point) const override { return features_.leaders[point]; }
  Vec3 place(Index point, const Vec3& p) const override;

private:
  /// Faces or edges by their numbers in the features, and the coordinates that are the same all over them.
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
