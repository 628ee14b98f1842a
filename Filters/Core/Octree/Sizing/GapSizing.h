// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures gaps between surfaces, so that enough octants fit across them.
#pragma once

#include "Octree/Sizing/SizeSources.h"
#include "Surface/Model/TriangleTree.h"

namespace atria {

/// Finds surfaces that face each other, from the triangles in an octant.
///
/// Rays start at points of a triangle's part in the octant and go along its normal to both sides. The first triangle
/// that a ray meets faces it if their normals, whatever their sense, are within 30 degrees. The space between is a gap.
/// This includes the inside of a wall or pipe, since it is not known yet which side is fluid.
class GapSizer
{
public:
  GapSizer(const SurfaceModel& model, const GridFrame& frame, const ModelLevels& levels, int cellsAcross);

  /// Appends the gaps that request a level below the top level; returns the finest level requested, 0 without gaps.
  int find(const LatticeBox& box, std::span<const ModelItem> pieces, std::vector<GapLine>& lines) const;

private:
  void findFrom(const LatticeBox& box, Index triangle, double sense, std::vector<GapLine>& lines) const;
  int levelFor(double width, Index triangle, Index other) const;

  const SurfaceModel& model_;
  const GridFrame& frame_;
  const ModelLevels& levels_;
  int cellsAcross_;
  TriangleTree tree_;
  /// Widths of gaps that matter, in lattice units. Surfaces closer than the least coincide.
  double least_;
  double most_;
};

} // namespace atria
