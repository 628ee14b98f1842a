// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds where surfaces and domain sides cut the edges of the grid.
#pragma once

#include "Dual/Grid/EdgeProbe.h"
#include "Dual/Grid/GridPlaces.h"
#include "Dual/Mesh/DualMesh.h"
#include "Support/Buckets.h"

namespace atria {

/// An octree edge that surfaces cut: between grid points, or from one to outside the domain. Permeable surfaces alone
/// separate nothing: the points remain neighbors, and the face of an edge out of the domain is on the side.
struct CrossedEdge
{
  /// The grid point the edge starts from, and the one at its end or noIndex. Edges between two points start from the
  /// lower one.
  Index point;
  Index other;
  std::uint8_t direction;
  EdgeSegment segment;
  /// Its crossings are [begin, begin + count) of Crossings::cuts. If there are several, sheets are merged.
  std::uint32_t begin;
  std::uint32_t count;
};

/// Neighbors of grid points, and the faces and cuts between them.
struct Crossings
{
  /// One entry per grid point and Direction, as in DualMesh::neighbors.
  Buffer<std::array<std::int32_t, 6>> neighbors;
  std::vector<BoundaryFace> boundaryFaces;
  std::vector<CrossedEdge> crossedEdges;
  std::vector<SurfaceCrossing> cuts;

  std::span<const SurfaceCrossing> of(const CrossedEdge& edge) const
  {
    return std::span(cuts).subspan(edge.begin, edge.count);
  }
};

/// Calls f(cut) for the cuts up to and including the first wall.
template <typename Cut, typename F> void eachSeen(Cut first, Cut last, const SurfaceModel& model, F&& f)
{
  for (Cut cut = first; cut != last; ++cut)
  {
    f(*cut);
    if (!model.isPermeable(cut->triangle))
    {
      break;
    }
  }
}

/// Calls f(leaf) once for each of the leaves around an edge or a point.
template <std::size_t n, typename F> void eachLeaf(const std::array<Index, n>& leaves, F&& f)
{
  for (auto leaf = leaves.begin(); leaf != leaves.end(); ++leaf)
  {
    if (std::find(leaves.begin(), leaf, *leaf) == leaf)
    {
      f(*leaf);
    }
  }
}

/// Returns the crossed edges of each leaf, in order.
Buckets edgesByLeaf(const Crossings& crossings, std::size_t leafCount, const RunContext& context);

/// Returns the crossings of one edge of the grid, whose segment was made with the same trial; see EdgeProbe::cut().
std::span<const SurfaceCrossing> cutEdge(const GridPlaces& grid, EdgeProbe& probe, Index point,
                                         const GridPlaces::Edge& edge, const EdgeSegment& segment,
                                         const GridTrial& trial = {});

/// Joins grid points across edges, and finds which edges are cut by surfaces or by the domain's sides. Decisions are
/// exact; see Predicates.h. A surface that reaches through an edge and back, by a bulge or the tip of a crease, does
/// not cut it. Faces are those of walls; a permeable surface has crossed edges only. Cost: O(1) an edge, plus the
/// triangles in the leaf beside it.
Crossings findCrossings(const GridPlaces& grid, const SurfaceModel& model, const RunContext& context);

/// Returns the crossings of findCrossings, from those found before the points `changed` moved or went back. Cost: O(1)
/// for each of their edges, and one pass over the faces and cuts.
Crossings updateCrossings(const GridPlaces& grid, const SurfaceModel& model, Crossings before,
                          const std::vector<Index>& changed, const RunContext& context);

} // namespace atria
