// SPDX-License-Identifier: GPL-3.0-or-later
/// Derives the charts, curves and sheets at a leaf's vertex from the leaf's cut edges.
#pragma once

#include "Dual/Grid/EdgeProbe.h"
#include "Dual/Leaf/LeafCurves.h"
#include "Support/UnionFind.h"

namespace atria {

/// A cut edge of the grid as a leaf beside it sees it.
struct CutEdge
{
  /// Leaves before and after this one round the edge.
  std::array<Index, 2> beside;
  std::span<const SurfaceCrossing> cuts;
};

/// Returns the edge as `leaf` sees it, which is one of the leaves around it.
CutEdge seenFrom(Index leaf, const EdgeSegment& edge, std::span<const SurfaceCrossing> cuts);

/// Lists a leaf and those beside its cut edges, in that order, without repetition.
void listLeavesAbout(Index leaf, std::span<const CutEdge> edges, std::vector<Index>& leaves);

/// Topology of the mesh around a leaf's vertex, as the leaf's cut edges imply it. Each cut edge is a mesh face on a
/// chart, each face of the leaf a mesh edge at the vertex. A chart ends along a mesh edge where an odd number of its
/// faces meet there. As every closed path that does not pass round the border of a chart cuts it an even number of
/// times, these mesh edges form chains without a break, one along each feature curve.
class LeafTopology
{
public:
  /// A mesh edge along a feature curve.
  struct Link
  {
    Index to;
    /// The charts that end there, sorted; empty where charts pass through each other.
    std::vector<Index> ending;
  };

  LeafTopology(const Octree& tree, const SurfaceModel& surfaces, const LeafCurves& curvesOfLeaves)
      : octree(tree), model(surfaces), leafCurves(curvesOfLeaves)
  {
  }

  /// Looks at a leaf with these cut edges.
  void analyze(Index leaf, std::span<const CutEdge> edges);

  /// Returns the charts whose faces the vertex has, sorted.
  const std::vector<Index>& charts() const { return charts_; }
  /// Links inside the domain, sorted by leaf. Mesh edges in a domain side, where all charts end, are none.
  const std::vector<Link>& links() const { return links_; }
  /// Returns the different curves among the links, by the charts that end there; sorted.
  std::vector<std::vector<Index>> curves() const;
  /// True if the links are more than one curve that passes by: curves meet or end at the vertex.
  bool isKnot() const;
  /// True if one curve ends at the vertex.
  bool isEnd() const { return links_.size() == 1; }
  /// Returns the number of sheets at the vertex that do not meet in a curve of the model near it. If there are several,
  /// the vertex cannot be on all of them.
  int sheets() const { return sheets_; }
  /// Returns pairs of charts that are on different sheets; the smaller first, sorted.
  const std::vector<std::pair<Index, Index>>& apart() const { return apart_; }

private:
  /// A face on a chart at a mesh edge.
  struct Use
  {
    Index to;
    Index chart;
    /// Faces of one edge and chart count as one.
    Index face;
    auto operator<=>(const Use&) const = default;
  };
  void gather(Index leaf, std::span<const CutEdge> edges);
  void gatherCurves(Index leaf, std::span<const CutEdge> edges);
  void countSheets();
  void look(Index leaf, std::size_t begin, std::size_t end);
  bool joinMeeting();
  bool onOneSide(Index a, Index b) const;

  const Octree& octree;
  const SurfaceModel& model;
  const LeafCurves& leafCurves;
  std::vector<Use> uses;
  UnionFind sets;
  /// One entry per face: its first use.
  std::vector<Index> firstOfFace;
  std::vector<Index> chartsOfFaces;
  /// At the mesh edge looked at, the first use of each chart, and the charts that end there.
  std::vector<Index> firstOfChart;
  std::vector<Index> ending;
  /// Charts and the sheets they are on.
  std::vector<std::pair<Index, Index>> parts;
  std::vector<Index> charts_;
  /// Pairs of a near curve and a chart of the vertex that meets there, and the curves with several such charts.
  std::vector<std::pair<Index, Index>> meeting;
  std::vector<Index> nearCurves;
  std::vector<Index> nearLeaves;
  std::vector<Link> links_;
  int sheets_ = 0;
  std::vector<std::pair<Index, Index>> apart_;
};

} // namespace atria
