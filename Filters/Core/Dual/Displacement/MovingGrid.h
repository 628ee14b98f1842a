// SPDX-License-Identifier: GPL-3.0-or-later
/// A grid whose points move, with the cuts of its edges and what its leaves do not resolve.
#pragma once

#include "Dual/Displacement/PointTrial.h"
#include "Octree/Tree/MeshingContext.h"

#include <limits>
#include <optional>
#include <set>
#include <unordered_map>

namespace atria {

/// Sheets closer than this part of an edge are left to merge.
inline constexpr double thinnestGap = 0.02;

/// Surplus sheets and curves of an octant up to which its points are searched for better places. With more, next to
/// nothing is won: of racks, tanks and furnished houses 1 to 2 % of all that is unresolved, for a tenth of the time.
inline constexpr unsigned mostHopeful = 3;

/// The grid while its points move: the cuts of its edges kept up to date, and what they imply for its leaves. Edges
/// that did not move are read from the octree's own crossings. Several threads may look, each with a Look of its own.
class MovingGrid
{
public:
  using PointPlaces = std::vector<std::pair<Index, LatticePoint>>;

  /// A cut edge.
  struct Edge
  {
    const EdgeSegment& segment;
    /// True if it ends on a domain side, which is a sheet too.
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

  /// Result of the last look at a leaf.
  struct Finding
  {
    std::uint32_t surplus : 30 = 0;
    std::uint32_t unresolved : 1 = 0;
    /// 1 if the charts that cut its edges have changed since.
    std::uint32_t isStale : 1 = 0;
  };

  /// An edge as it is stored: from its lower point if it has two.
  struct Stored
  {
    Index start;
    int along;
    GridPlaces::Edge edge;

    bool operator<(const Stored& other) const { return std::tie(start, along) < std::tie(other.start, other.along); }
    bool operator==(const Stored& other) const { return start == other.start && along == other.along; }
  };

public:
  /// Working memory of one thread: the leaf that it looked at last, and the point that it tried last.
  class Look
  {
  public:
    explicit Look(const MovingGrid& grid);
    std::span<const CutEdge> cutEdges() const { return edges; }
    const LeafTopology& topology() const { return topology_; }
    /// Returns the leaf and those beside its cut edges, without repetition.
    const std::vector<Index>& leavesAbout() const { return about; }

  private:
    friend class MovingGrid;

    EdgeProbe probe;
    LeafTopology topology_;
    std::vector<CutEdge> edges;
    std::vector<Index> about;
    PointTrial trial;
    /// Version of the grid for which the trial is valid.
    std::uint64_t version = 0;
  };

  /// Record of what moves changed, so that they can be taken back.
  struct Trail
  {
    PointPlaces places;
    std::vector<std::pair<Stored, Live>> edges;
    std::vector<std::pair<Index, Finding>> leaves;
  };

  /// Surplus cuts of the edges around a point, and surplus of the leaves there.
  struct Surplus
  {
    std::size_t cuts = 0;
    int leaves = 0;

    /// Cuts count twice.
    double cost() const { return 2.0 * static_cast<double>(cuts) + leaves; }
  };

  /// `crossings` are those of the grid without moved points. Keeps references to all that is passed.
  MovingGrid(GridPlaces& places, const Crossings& crossings, const MeshingContext& context);

  const GridPlaces& places() const { return grid; }
  const GridPoints& points() const { return grid.points(); }
  const Octree& octree() const { return tree; }
  const SurfaceModel& model() const { return surfaces; }

  void moveTo(Index point, const LatticePoint& place) { moveTogether({{point, place}}); }
  void moveTogether(const PointPlaces& places, Trail* trail = nullptr);
  /// The same on all threads, without a trail.
  void moveAll(const PointPlaces& places, const RunContext& context);
  /// Takes back all moves of a trail. Leaves must have been looked at when it began.
  void takeBack(const Trail& trail);

  /// Returns the edge that leaves a point in a direction; nullopt if it does not exist or was never cut.
  std::optional<Edge> cutEdge(Index point, int direction) const;
  /// True if the segment of that edge starts at the point.
  bool startsAt(Index point, int direction) const;

  /// Looks at a leaf. Returns the number of sheets that do not meet in it, less the one it can hold, plus one if its
  /// curves are more than the vertex can be on.
  int surplus(Index leaf, Look& into) const;
  /// The same with the grid's own look.
  int surplus(Index leaf) { return surplus(leaf, view); }

  /// Returns the surplus around a point where it is. The function with a place tries the point there instead.
  /// Successive places of one point share what they search.
  Surplus surplusAbout(Index point, Look& look) const;
  /// Returns the surplus around some points, with each edge and leaf counted once. Looks at changed leaves again.
  Surplus surplusAbout(const PointPlaces& places);
  /// Tries the point at `place`, and stops counting as soon as the cost exceeds the limit.
  Surplus surplusAbout(Index point, const LatticePoint& place, Look& look,
                       double limit = std::numeric_limits<double>::infinity()) const;

  /// True if a leaf is known to have neither surplus sheets nor curves.
  bool isCalm(Index leaf) const { return !findings[leaf].isStale && findings[leaf].surplus == 0; }
  /// True if moves of single points may resolve a leaf. If it holds much, each move mends one thing at the cost of
  /// another.
  bool isHopeful(Index leaf) const
  {
    const Finding& found = findings[leaf];
    return found.isStale || (found.unresolved && found.surplus <= mostHopeful);
  }
  /// True if a leaf has surplus cuts, sheets or curves.
  bool isUnresolved(Index leaf);
  /// Returns the leaves with surplus cuts, sheets or curves; sorted.
  const std::vector<Index>& unresolvedLeaves(const RunContext& context);
  /// Looks at leaves where cuts changed. The surplus around points is then known without a look per point.
  void lookAgain(const RunContext& context);
  /// Calls `f(i, look)` for the numbers below `count` on all threads, after lookAgain().
  template <typename F> void forEach(std::size_t count, std::size_t grain, const RunContext& context, F&& f)
  {
    lookAgain(context);
    context.executor.forRanges(count, grain, [&](std::size_t begin, std::size_t end) {
      Look look(*this);
      for (std::size_t i = begin; i < end; ++i)
      {
        f(i, look);
      }
    });
  }
  void addCorners(Index leaf, std::set<Index>& points) const;

  std::int64_t shortestEdge(Index point) const;
  /// True for points that stay: those of clusters, which no place resolves, and those beside the sides of a turned
  /// domain, whose positions show what is beyond.
  bool isFixed(Index point) const;

private:
  void findUnresolved(const RunContext& context);
  template <typename F> void eachEdge(Index leaf, F&& f) const;
  Edge at(Index id) const;
  Index idOf(Index point, int direction) const;
  Live& live(const Stored& edge, const EdgeSegment& segment);
  void setCuts(const Stored& edge, const EdgeSegment& segment, std::span<const SurfaceCrossing> cuts,
               Trail* trail = nullptr);
  void putAt(Index point, const LatticePoint& place);
  std::optional<Stored> stored(Index point, int direction) const;
  std::vector<Stored> edgesOf(const PointPlaces& places) const;
  void beginTrial(Index point, const LatticePoint& place, Look& look) const;
  void beginTrialOf(Index id, PointTrial::Leaf& leaf, const PointTrial& trial) const;
  int surplusOfTrial(PointTrial::Leaf& leaf, Look& look) const;
  int analyze(Index leaf, Look& into) const;
  Finding find(Index leaf, Look& into) const;
  bool isTangle(Index leaf, const Look& of) const;

  GridPlaces& grid;
  const Octree& tree;
  const SurfaceModel& surfaces;
  const TriangleTreeOnDemand& triangles;
  const Crossings& undisplaced;
  std::vector<std::vector<std::vector<Index>>> atCorners;
  LeafCurves leafCurves;
  /// Edges of each leaf. They are numbered as in `undisplaced`; edges cut later follow, and are listed in
  /// `addedOfLeaf`.
  Buckets edgesOfLeaf;
  /// One entry per point: its first edge in `undisplaced`, where edges are in the order of points.
  std::vector<Index> firstEdge;
  std::unordered_map<Index, std::vector<Index>> addedOfLeaf;
  std::unordered_map<std::uint64_t, Index> addedIds;
  std::vector<std::uint64_t> addedKeys;
  /// One entry per edge: its place in `moved`; noIndex if it is as in `undisplaced`.
  std::vector<Index> movedOf;
  std::vector<Live> moved;
  std::vector<Finding> findings;
  /// Stale leaves, and leaves looked at since `unresolved` was set. Leaves may be listed twice.
  std::vector<Index> stale;
  std::vector<Index> looked;
  std::vector<Index> unresolved;
  /// Rises with every change.
  std::uint64_t version = 1;
  Look view;
};

/// Calls f(id) for each edge of a leaf that was cut at some time.
template <typename F> void MovingGrid::eachEdge(Index leaf, F&& f) const
{
  for (const Index id : edgesOfLeaf.of(leaf))
  {
    f(id);
  }
  if (const auto found = addedOfLeaf.find(leaf); found != addedOfLeaf.end())
  {
    for (const Index id : found->second)
    {
      f(id);
    }
  }
}

} // namespace atria
