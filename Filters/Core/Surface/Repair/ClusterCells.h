// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/Morton.h"
#include "Support/RunContext.h"
#include "Surface/Search/BoxTests.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <unordered_set>
#include <vector>

namespace atria {

/// An octant has eight corners, so its edges tell apart eight regions at most. Of more smooth pieces than this in it,
/// it can show neither sheets nor curves one by one, only which of its edges they cut: it is a cluster.
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

/// Octants of the size at features that a model is a cluster in, before it is repaired: foliage, railings, books. What
/// lies in them is neither cut nor moved, as the mesh would not show it. O(n log n).
class ClusterCells
{
public:
  /// None.
  ClusterCells() = default;
  /// `pieces` says per triangle which smooth piece it is of.
  ClusterCells(const TriangleSoup& soup, const std::vector<Index>& pieces, const GridFrame& frame,
               const ClusterOptions& options, const RunContext& context);

  /// Of the smallest octants at features.
  int finestLevel() const { return finestLevel_; }
  /// Whether a triangle of the input lies in clusters, or outside of the root octant, wherever it is.
  bool isHidden(Index source) const { return source < isSeen_.size() && !isSeen_[source]; }
  /// Hides another one.
  void hide(Index source);
  /// Whether a box lies in clusters; false for boxes longer than an octant.
  bool hold(const LatticeBox& box) const;
  bool hold(const LatticePoint& p) const { return hold(LatticeBox{p, p}); }

private:
  GridFrame frame_;
  int finestLevel_ = 0;
  /// Keys of the clusters, by level from that of features on.
  std::vector<std::unordered_set<MortonKey>> keys_;
  /// Per triangle of the input, whether some of it lies outside of clusters, and it was not hidden since.
  std::vector<char> isSeen_;
};

/// The triangles of a soup that are not hidden in clusters; it may have been cut since these were found.
std::vector<Index> seenTriangles(const TriangleSoup& soup, const ClusterCells& clusters, const RunContext& context);

} // namespace atria
