// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Octree/Sizing/SizeSources.h"
#include "Surface/Model/TriangleTree.h"

namespace atria {

/// Finds surfaces that face each other, from the triangles in an octant.
///
/// From points of a triangle's part in the octant rays go along its normal to both sides. The first triangle that one
/// meets faces it if their normals, whatever their sense, are within 30 degrees. The way between is a gap: the space
/// between two walls, and the inside of a wall or pipe as well, as which of them is fluid is not known yet.
class GapSizer
{
public:
  GapSizer(const SurfaceModel& model, const GridFrame& frame, const ModelLevels& levels, int cellsAcross);

  /// Appends the gaps that ask for a level below the top level; returns the finest level asked for, 0 without gaps.
  int find(const LatticeBox& box, std::span<const ModelItem> pieces, std::vector<GapLine>& lines) const;

private:
  void findFrom(const LatticeBox& box, Index triangle, double sense, std::vector<GapLine>& lines) const;
  int levelFor(double width, Index triangle, Index other) const;

  const SurfaceModel& model_;
  const GridFrame& frame_;
  const ModelLevels& levels_;
  int cellsAcross_;
  TriangleTree tree_;
  /// Widths of gaps that matter, in lattice units: beneath the least, surfaces coincide.
  double least_;
  double most_;
};

} // namespace atria
