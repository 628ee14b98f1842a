// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the octants in which a model is too fine for the mesh to show.
#pragma once

#include "Grid/Morton.h"
#include "Support/RunContext.h"
#include "Surface/Search/BoxTests.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <unordered_set>
#include <vector>

namespace atria {

/// Largest number of smooth pieces in an octant that is not a cluster. The edges between its eight corners tell apart
/// eight regions at most. With more pieces it can show neither sheets nor curves one by one, only which of its edges
/// they cut.
inline constexpr std::size_t mostPiecesOfOctant = 8;

/// A place where octants are finer than those at features.
struct FinerPlace
{
  LatticeBox box;
  int level;
};

struct ClusterOptions
{
  /// Degrees between normals up to which triangles are one smooth piece.
  double featureAngle = 30.0;
  std::vector<FinerPlace> finerPlaces;
};

/// Octants of the size at features in which a model is a cluster before it is repaired: foliage, railings, books.
/// Triangles in them are neither cut nor moved, as the mesh would not show it. O(n log n).
class ClusterCells
{
public:
  /// No clusters.
  ClusterCells() = default;
  /// `pieces` has one entry per triangle: the smooth piece it belongs to.
  ClusterCells(const TriangleSoup& soup, const std::vector<Index>& pieces, const GridFrame& frame,
               const ClusterOptions& options, const RunContext& context);

  /// Level of the smallest octants at features.
  int finestLevel() const { return finestLevel_; }
  /// True if a triangle of the input was hidden, or if all of it lies in clusters or outside of the root octant.
  bool isHidden(Index source) const { return source < isSeen_.size() && !isSeen_[source]; }
  /// Hides another triangle of the input.
  void hide(Index source);
  /// True if a box lies in clusters; false for boxes longer than an octant.
  bool hold(const LatticeBox& box) const;
  bool hold(const LatticePoint& p) const { return hold(LatticeBox{p, p}); }

private:
  GridFrame frame_;
  int finestLevel_ = 0;
  /// Keys of the clusters, by level from that of features on.
  std::vector<std::unordered_set<MortonKey>> keys_;
  /// One flag per triangle of the input: nonzero if some of it lies outside of clusters and it was not hidden since.
  std::vector<char> isSeen_;
};

/// Returns the triangles of a soup that are not hidden in clusters. The soup may have been cut since the clusters were
/// found.
std::vector<Index> seenTriangles(const TriangleSoup& soup, const ClusterCells& clusters, const RunContext& context);

} // namespace atria
