// SPDX-License-Identifier: GPL-3.0-or-later
/// Cuts single edges of the grid with the triangles of the model.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Octree/Tree/Octree.h"
#include "Surface/Model/SurfaceModel.h"
#include "Surface/Model/TriangleTree.h"

#include <optional>
#include <span>

namespace atria {

/// Distance beyond an edge up to which the tip of a crease may reach for the edge to count as uncut, as a part of the
/// edge's length.
inline constexpr double nickDepth = 0.3;

/// Cut of an edge of the grid with a surface.
struct SurfaceCrossing
{
  Index triangle;
  /// +1 if the triangle's normal points along the edge, -1 if against it.
  std::int32_t orientation;
  /// From 0 at the edge's start to 1 at its end.
  double parameter;
};

/// An edge of the grid as a segment. Its ends may have been moved off the octants' corners.
struct EdgeSegment
{
  LatticePoint start;
  LatticePoint end;
  /// Axis along which it runs; -1 if an end was moved off it.
  int axis;
  /// Length of the octants' edge it stands for, in lattice units.
  std::int64_t size;
  /// Leaves around the edge, in order; a large one may be listed twice in a row.
  std::array<Index, 4> about;
};

/// Returns the cut of an edge with the triangle a, b, c, which stands for `triangle` of the model; nullopt if there is
/// none.
std::optional<SurfaceCrossing> crossingOf(const EdgeSegment& edge, const LatticePoint& a, const LatticePoint& b,
                                          const LatticePoint& c, Index triangle);

/// Return the side of a sheet that is seen from an edge's start, and from its end. The normal points out of the front.
inline SheetSide seenFromStart(const SurfaceCrossing& cut)
{
  return cut.orientation < 0 ? SheetSide::front : SheetSide::back;
}
inline SheetSide seenFromEnd(const SurfaceCrossing& cut)
{
  return cut.orientation > 0 ? SheetSide::front : SheetSide::back;
}

/// Finds crossings of grid edges with the model. Not for several threads at once, as it reuses its memory.
class EdgeProbe
{
public:
  /// If leaves hold very many triangles, `tree` is searched instead, if there is one.
  EdgeProbe(const Octree& leaves, const SurfaceModel& surfaces, const TriangleTreeOnDemand* tree = nullptr)
      : octree(leaves), model(surfaces), triangleTree(tree)
  {
  }

  /// Returns the crossings of an edge with the triangles of `leaves`, sorted from start to end. Triangles on domain
  /// sides are skipped. Pairs that only reach through the edge and back are left out, separately for walls and for
  /// permeable surfaces. The result is valid until the next call.
  std::span<const SurfaceCrossing> cut(const EdgeSegment& edge, std::span<const Index> leaves);
  /// The same with given triangles, which must include all that touch the bounds of the edge.
  std::span<const SurfaceCrossing> cutAmong(const EdgeSegment& edge, std::span<const Index> triangles);

  /// Lists the triangles of `leaves` whose bounds touch the box, each once, without those on domain sides. More may be
  /// listed for a box that reaches beyond these leaves.
  void gather(const LatticeBox& box, std::span<const Index> leaves, std::vector<Index>& triangles) const;

  /// Returns the triangle of a domain side that covers the point where the edge along `direction` through p leaves the
  /// domain; noIndex if there is none.
  Index sideTriangle(Index leaf, const LatticePoint& p, int direction) const;

private:
  bool isBulge(const EdgeSegment& edge, const SurfaceCrossing& l, const SurfaceCrossing& r) const;
  bool isNick(const EdgeSegment& edge, const SurfaceCrossing& l, const SurfaceCrossing& r) const;
  void dropBulges(const EdgeSegment& edge, std::size_t begin, std::size_t end);

  const Octree& octree;
  const SurfaceModel& model;
  const TriangleTreeOnDemand* triangleTree;
  std::vector<Index> candidates;
  std::vector<SurfaceCrossing> found;
};

LatticeBox boundsOf(const EdgeSegment& edge);

/// True if the bounds of a triangle touch a box.
bool touchesBounds(const LatticeBox& box, const SurfaceModel& model, Index triangle);

/// Returns the point of an edge at a parameter, in lattice units.
Vec3 pointOn(const EdgeSegment& edge, double parameter);

} // namespace atria
