// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds positions for the vertices of leaves on the model.
#pragma once

#include "Dual/Grid/EdgeProbe.h"
#include "Surface/Search/BoxTests.h"

#include <optional>

namespace atria {

/// Finds places for the vertex of a leaf: on corners, curves and surfaces of the model in it, and on the domain's
/// planes through it. Takes one leaf after the other. Positions can be requested after enter(), addCut() for each of
/// its cut edges, and setCharts().
class LeafGeometry
{
public:
  LeafGeometry(const Octree& tree, const SurfaceModel& surfaces) : octree(tree), frame(tree.frame()), model(surfaces) {}

  /// Returns the octant's center; nullopt if a domain side passes through it. Does not enter the leaf.
  std::optional<Vec3> centerOffSides(Index leaf) const;

  void enter(Index leaf);
  void addCut(const EdgeSegment& edge, std::span<const SurfaceCrossing> cuts);
  /// Sets the charts that cut the edges; sorted.
  void setCharts(const std::vector<Index>& charts) { charts_ = charts; }

  bool isOnSide() const { return planes != 0; }
  /// Returns the octant's center, on the domain sides through it.
  Vec3 center() const { return onPlanes(center_); }

  /// Returns a corner or place on a curve of what lies on the leaf's domain sides; nullopt if there is none.
  std::optional<Vec3> sidePosition();
  /// Returns the mean of the cuts, put on the charts; or the middle of a fold within a chart.
  Vec3 surfacePosition();
  Vec3 cornerPosition(Index point) const { return onPlanes(modelPoint(point)); }
  /// Returns the middle of the curves at which exactly these charts end; or their nearest point, if they pass by.
  std::optional<Vec3> curvePosition(const std::vector<std::vector<Index>>& endings);
  /// Returns the point of these curves nearest to p, in the leaf or around it.
  std::optional<Vec3> nearestCurvePosition(const std::vector<std::vector<Index>>& endings, const Vec3& p);
  /// True if curvePosition found no piece of the curves in the leaf itself.
  bool isDiverted() const { return diverted; }

  /// True if p is farther from some of the charts than rounding explains.
  bool misses(const Vec3& p) const;

private:
  using Segment = std::pair<Vec3, Vec3>;

  Vec3 modelPoint(Index i) const { return frame.toModel(model.points[i]); }
  Vec3 onPlanes(const Vec3& p) const;
  Vec3 meanOfCuts() const;
  bool isOneOf(const FeatureEdge& edge, const std::vector<std::vector<Index>>& endings) const;
  void addNeighbors();
  Vec3 tipOrMean() const;
  bool hasChart(Index chart) const;
  bool owns(const LatticePoint& p) const;
  bool onOwnPlane(Index triangle) const;
  bool onOwnPlane(const FeatureEdge& edge) const;
  std::optional<Vec3> sideCorner() const;
  template <typename Wanted> std::optional<Vec3> middleOfPieces(Wanted&& wanted);
  template <typename Wanted> std::optional<Vec3> nearestOnCurves(const Vec3& p, Wanted&& wanted);
  template <typename Wanted> std::optional<Vec3> nearestOnPieces(const Vec3& p, Wanted&& wanted) const;
  std::optional<Vec3> nearestOfSegments(const Vec3& p) const;
  std::optional<Vec3> whereSegmentsMeetPlanes(const Vec3& p) const;

  const Octree& octree;
  const GridFrame& frame;
  const SurfaceModel& model;
  Index leaf_ = noIndex;
  LatticeBox box{};
  unsigned planes = 0;
  /// The leaf, then those around its cut edges, which are searched only if needed.
  std::vector<Index> leaves;
  bool isDisplaced = false;
  bool diverted = false;
  Vec3 center_;
  Vec3 sum;
  Box3 extent;
  double count = 0.0;
  std::vector<Index> charts_;
  std::vector<Segment> segments;
};

} // namespace atria
