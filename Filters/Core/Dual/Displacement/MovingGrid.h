// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Leaf/LeafTopology.h"
#include "Octree/Tree/MeshingContext.h"

#include <limits>
#include <optional>
#include <set>
#include <unordered_map>

namespace atria {

/// Sheets closer than this part of an edge are left to merge.
inline constexpr double thinnestGap = 0.02;

/// The grid while its points move: the cuts of its edges kept up to date, and what they say about its leaves. Edges
/// that did not move are read from the octree's own crossings. Several threads may look, each with a Look of its own.
class MovingGrid
{
public:
  using PointPlaces = std::vector<std::pair<Index, LatticePoint>>;

  /// A cut edge.
  struct Edge
  {
    const EdgeSegment& segment;
    /// It ends on a domain side, which is a sheet too.
    bool leavesDomain;
    std::span<const SurfaceCrossing> cuts;

    /// Cuts beyond the one an edge can hold.
    std::size_t surplus() const { return cuts.empty() ? 0 : cuts.size() - (leavesDomain ? 0 : 1); }
  };

private:
  struct Live
  {
    EdgeSegment segment;
    bool leavesDomain;
    std::vector<SurfaceCrossing> cuts;
  };

public:
  /// What one thread sees of the leaf that it looked at last.
  class Look
  {
  public:
    explicit Look(const MovingGrid& grid);
    std::span<const CutEdge> cutEdges() const { return edges; }
    const LeafTopology& topology() const { return topology_; }
    /// The leaf and those beside its cut edges, without repetition.
    const std::vector<Index>& leavesAbout() const { return about; }

  private:
    friend class MovingGrid;
    /// An edge of a point that is looked at as if it were elsewhere; `id` is noIndex where it never was cut.
    struct Tried
    {
      Index id;
      Live edge;
    };

    EdgeProbe probe;
    LeafTopology topology_;
    std::vector<CutEdge> edges;
    std::vector<Index> about;
    std::vector<Tried> tried;
  };

  /// Of edges about a point and of the leaves there.
  struct Surplus
  {
    std::size_t cuts = 0;
    int leaves = 0;

    /// Cuts count twice.
    double cost() const { return 2.0 * static_cast<double>(cuts) + leaves; }
  };

  /// `home` are the crossings while no point is moved; they are referred to.
  MovingGrid(GridPlaces& places, const Crossings& crossings, const MeshingContext& context);

  const GridPlaces& places() const { return grid; }
  const GridPoints& points() const { return grid.points(); }
  const Octree& octree() const { return tree; }
  const SurfaceModel& model() const { return surfaces; }

  void moveTo(Index point, const LatticePoint& place);
  /// The same for many points, which are in rising order, each once.
  void moveAll(const PointPlaces& places, const RunContext& context);

  /// The edge that leaves a point in a direction, if it exists and was cut at some time.
  std::optional<Edge> cutEdge(Index point, int direction) const;
  /// Whether the segment of that edge starts at the point.
  bool startsAt(Index point, int direction) const;

  /// Looks at a leaf. Returns the sheets in it that do not meet, and the curves that do not, beyond the one it can
  /// hold.
  int surplus(Index leaf, Look& into) const;
  /// The same without a look of one's own.
  int surplus(Index leaf) { return surplus(leaf, view); }

  /// What there is about a point, and what there would be with it at another place.
  Surplus surplusAbout(Index point, Look& look) const;
  /// Where that costs more than the limit, not all is counted.
  Surplus surplusAbout(Index point, const LatticePoint& place, Look& look,
                       double limit = std::numeric_limits<double>::infinity()) const;

  /// Whether a leaf has surplus cuts, sheets or curves.
  bool isUnresolved(Index leaf);
  /// Leaves with surplus cuts, sheets or curves; sorted.
  const std::vector<Index>& unresolvedLeaves(const RunContext& context);
  /// Looks at leaves where cuts changed. What is about points is then told without looking at them once for each point.
  void lookAgain(const RunContext& context);
  /// The same of the leaves about one point.
  void lookAgain(Index point);
  void addCorners(Index leaf, std::set<Index>& points) const;

  std::int64_t shortestEdge(Index point) const;
  /// Points of clusters stay, as no place of theirs resolves them; so do those beside the sides of a turned domain,
  /// which tell by where they stand what is beyond.
  bool isFixed(Index point) const;

private:
  /// What was found at a leaf when it was looked at last.
  struct Finding
  {
    std::uint32_t surplus : 30 = 0;
    std::uint32_t unresolved : 1 = 0;
    /// Cuts of its edges changed since.
    std::uint32_t isStale : 1 = 0;
  };

  /// An edge as it is stored: from its lower point if it has two.
  struct Stored
  {
    Index start;
    int along;
    GridPlaces::Edge edge;
  };

  /// Cuts of edges of moved points, in the order of the points.
  struct NewCuts
  {
    struct Of
    {
      Stored edge;
      EdgeSegment segment;
      std::size_t begin;
      std::size_t end;
      /// It leads to a point that moves later, and was first cut before that. No cuts are kept.
      bool isHalfway;
    };
    std::vector<Of> edges;
    std::vector<SurfaceCrossing> cuts;
  };

  void findUnresolved(const RunContext& context);
  template <typename F> void eachEdge(Index leaf, F&& f) const;
  Edge at(Index id) const;
  Index idOf(Index point, int direction) const;
  Live& live(const Stored& edge, const EdgeSegment& segment);
  void setCuts(const Stored& edge, const EdgeSegment& segment, std::span<const SurfaceCrossing> cuts);
  static bool movesLater(const Stored& edge, Index point, const PointPlaces& places);
  std::uint8_t cutHalfway(const PointPlaces::value_type& move, const PointPlaces& places, Look& look) const;
  void cutAnew(Index point, std::uint8_t halfway, const PointPlaces& places, Look& look, NewCuts& out) const;
  void putAt(Index point, const LatticePoint& place);
  std::optional<Stored> stored(Index point, int direction) const;
  void tryEdges(Index point, const LatticePoint& place, Look& look) const;
  void look(Index leaf, Look& into) const;
  Finding find(Index leaf, Look& into) const;
  bool isTangle(Index leaf, const Look& of) const;

  GridPlaces& grid;
  const Octree& tree;
  const SurfaceModel& surfaces;
  const TriangleTreeOnDemand& triangles;
  const Crossings& undisplaced;
  std::vector<std::vector<std::vector<Index>>> atCorners;
  LeafCurves leafCurves;
  /// Edges are numbered as in `home`, and then as they come. Those of a leaf are in both.
  Buckets edgesOfLeaf;
  std::unordered_map<Index, std::vector<Index>> addedOfLeaf;
  std::unordered_map<std::uint64_t, Index> addedIds;
  /// Per edge its place in `moved`, or noIndex where it is as in `home`.
  std::vector<Index> movedOf;
  std::vector<Live> moved;
  std::vector<Finding> findings;
  /// Stale leaves, and those that were since unresolved was set up; leaves may be there twice.
  std::vector<Index> stale;
  std::vector<Index> looked;
  std::vector<Index> unresolved;
  Look view;
};

} // namespace atria
