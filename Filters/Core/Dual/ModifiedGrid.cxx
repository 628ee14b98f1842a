// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/ModifiedGrid.h"

#include "Dual/FeatureCorners.h"
#include "Dual/LeafTopology.h"
#include "Surface/Distance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>

namespace atria {

namespace {

/// How far a point may move, against its shortest edge.
constexpr double farthestMove = 0.95;
/// How far beyond a single cut a point is put, against the edge, if nothing else limits it.
constexpr double stepBeyond = 0.1;
/// Sheets closer than this part of an edge are left to merge.
constexpr double thinnestGap = 0.02;
constexpr double surplusCutCost = 2.0;
constexpr int mostSweeps = 100;
constexpr double smallestGain = 1e-9;
constexpr double rounding = 1e-6;
/// What a move of a point by its shortest edge counts against one surplus.
constexpr double moveCost = 0.05;

/// A cut edge, kept up to date while points move.
struct LiveEdge
{
  EdgeSegment segment;
  bool leavesDomain;
  std::vector<SurfaceCrossing> cuts;
};

class Search
{
public:
  /// A better place for a point.
  struct Move
  {
    double gain = 0.0;
    Index point = noIndex;
    LatticePoint place{};
  };

  Search(GridPlaces& places, const SurfaceModel& surfaces, const Crossings& crossings)
      : grid(places), octree(places.octree()), model(surfaces), probe(octree, surfaces), topology(octree, surfaces),
        atCorners(curvesAtCorners(surfaces))
  {
    for (const CrossedEdge& edge : crossings.crossedEdges)
    {
      const auto cuts = crossings.of(edge);
      const Index id = add(edge.point, edge.direction, edge.segment, edge.other == noIndex);
      edges[id].cuts.assign(cuts.begin(), cuts.end());
    }
  }

  /// Points of edges with surplus cuts and of leaves with surplus sheets.
  std::set<Index> pointsInQuestion()
  {
    std::set<Index> points;
    for (const Index leaf : leavesInQuestion())
    {
      addCorners(leaf, points);
    }
    return points;
  }

  /// Moves points onto the middle between two sheets that run side by side through their leaves. A plane of grid points
  /// is gap-free, no octant having points on both its sides, if it holds all that are within half the sum of its
  /// normal's components (a standard digital plane; Reveillès 1991); so these are moved. A gap beside another one,
  /// whose points are taken, needs those of the next plane: up to the whole sum.
  bool enterGaps(double reach)
  {
    std::map<Index, Move> moves;
    for (const Index leaf : leavesInQuestion())
    {
      surplus(leaf);
      std::vector<std::pair<Index, Index>> pairs = topology.apart();
      for (const CutEdge& edge : seen)
      {
        for (std::size_t i = 1; i < edge.cuts.size(); ++i)
        {
          pairs.push_back(std::minmax(model.charts[edge.cuts[i - 1].triangle], model.charts[edge.cuts[i].triangle]));
        }
      }
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      for (const Index point : grid.points().atCorner[leaf])
      {
        if (point != noIndex && !grid.isMoved(point) && !isBesideTurnedSide(point))
        {
          const Vec3 p = toVector(grid.place(point));
          for (const auto& [a, b] : pairs)
          {
            noteGap(point, nearestOnChart(leaf, p, a), nearestOnChart(leaf, p, b), reach, moves);
          }
          noteSideGaps(point, leaf, reach, moves);
        }
      }
    }
    for (const auto& [point, move] : moves)
    {
      moveTo(point, move.place);
    }
    return !moves.empty();
  }

  /// The best place for a point, found by trying; it stays where it is.
  Move bestMove(Index point)
  {
    Move best{0.0, point, {}};
    const double before = costAt(point);
    if ((before < 1.0 && !grid.isMoved(point)) || isBesideTurnedSide(point))
    {
      return best;
    }
    const LatticePoint from = grid.place(point);
    for (const LatticePoint& place : candidates(point))
    {
      if (place != from)
      {
        moveTo(point, place);
        const double gain = before - costAt(point);
        if (gain > best.gain + smallestGain)
        {
          best.gain = gain;
          best.place = place;
        }
      }
    }
    moveTo(point, from);
    return best;
  }

  void apply(const Move& move) { moveTo(move.point, move.place); }

  /// Points whose costs a move of this one changes.
  void addNeighbours(Index point, std::set<Index>& points) const
  {
    for (const Index leaf : grid.points().leaves[point])
    {
      addCorners(leaf, points);
    }
  }

private:
  /// Points there stay: what is beyond the sides of a turned domain is told by where the points stand.
  bool isBesideTurnedSide(Index point) const
  {
    const auto& leaves = grid.points().leaves[point];
    return octree.frame().turnedDomain && std::any_of(leaves.begin(), leaves.end(), [&](Index leaf) {
             const auto items = octree.items(leaf);
             return std::any_of(items.begin(), items.end(), [&](ModelItem piece) {
               return piece.kind == ModelItem::triangle && model.isTurnedSide(piece.index);
             });
           });
  }

  std::vector<Index> leavesInQuestion()
  {
    std::vector<Index> leaves;
    for (const auto& [leaf, ids] : edgesOfLeaf)
    {
      const bool cutTwice = std::any_of(ids.begin(), ids.end(), [&](Index id) { return surplusCuts(edges[id]) > 0; });
      if (cutTwice || surplus(leaf) > 0)
      {
        leaves.push_back(leaf);
      }
    }
    std::sort(leaves.begin(), leaves.end());
    return leaves;
  }

  /// Notes the place of a point between a chart that cuts an edge out of the domain, and the side it leads to.
  void noteSideGaps(Index point, Index leaf, double reach, std::map<Index, Move>& moves) const
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const GridPlaces::Edge edge = grid.edge(point, direction);
      const LiveEdge* live = edge.exists() && edge.other == noIndex ? find(point, direction, edge) : nullptr;
      if (live && !live->cuts.empty())
      {
        const Vec3 p = toVector(grid.place(point));
        Vec3 onSide = p;
        onSide[axisOf(direction)] = static_cast<double>(live->segment.end[axisOf(direction)]);
        noteGap(point, nearestOnChart(leaf, p, model.charts[live->cuts.back().triangle]), onSide, reach, moves);
      }
    }
  }

  /// Notes the place of a point between its nearest points on two sheets, if they lie to the same side of it.
  void noteGap(Index point, const std::optional<Vec3>& onA, const std::optional<Vec3>& onB, double reach,
               std::map<Index, Move>& moves) const
  {
    const Vec3 p = toVector(grid.place(point));
    const auto size = static_cast<double>(shortestEdge(point));
    if (!onA || !onB || (*onA - *onB).norm() < thinnestGap * size)
    {
      return;
    }
    const Vec3 normal = (*onB - *onA).normalized();
    const double toA = normal.dot(*onA - p);
    const double toB = normal.dot(*onB - p);
    const double step = 0.5 * (toA + toB);
    // Half-open, so that of two planes of points at the same distance one is taken.
    const double limit = reach * size * normal.lpNorm<1>();
    if (toA * toB <= 0.0 || step < -limit * (1.0 + rounding) || step >= limit * (1.0 - rounding))
    {
      return;
    }
    const Vec3 place = p + step * normal;
    const auto [found, isNew] = moves.try_emplace(point, Move{-std::abs(step), point, {}});
    if (isNew || found->second.gain < -std::abs(step))
    {
      found->second = {
          -std::abs(step), point, {std::llround(place[0]), std::llround(place[1]), std::llround(place[2])}};
    }
  }

  std::optional<Vec3> nearestOnChart(Index leaf, const Vec3& p, Index chart) const
  {
    std::optional<Vec3> best;
    std::vector<Index> leaves{leaf};
    for (const CutEdge& edge : seen)
    {
      leaves.insert(leaves.end(), edge.beside.begin(), edge.beside.end());
    }
    for (const Index near : leaves)
    {
      for (const ModelItem piece : octree.items(near))
      {
        if (piece.kind == ModelItem::triangle && model.charts[piece.index] == chart)
        {
          const Vec3 q =
              nearestOnTriangle(p, toVector(model.corner(piece.index, 0)), toVector(model.corner(piece.index, 1)),
                                toVector(model.corner(piece.index, 2)));
          best = !best || (q - p).squaredNorm() < (*best - p).squaredNorm() ? q : *best;
        }
      }
    }
    return best;
  }

  static std::uint64_t keyOf(Index point, int direction) { return std::uint64_t{point} << 3 | direction; }

  /// The edge as it is stored: from its lower point if it has two.
  std::pair<Index, int> stored(Index point, int direction, const GridPlaces::Edge& edge) const
  {
    return edge.other != noIndex && !isUpper(direction) ? std::pair(edge.other, opposite(direction))
                                                        : std::pair(point, direction);
  }

  Index add(Index point, int direction, const EdgeSegment& segment, bool leavesDomain)
  {
    const auto [found, isNew] = idOf.try_emplace(keyOf(point, direction), static_cast<Index>(edges.size()));
    if (isNew)
    {
      edges.push_back({segment, leavesDomain, {}});
      for (const Index leaf : std::set<Index>(segment.about.begin(), segment.about.end()))
      {
        edgesOfLeaf[leaf].push_back(found->second);
      }
    }
    return found->second;
  }

  void addCorners(Index leaf, std::set<Index>& points) const
  {
    for (const Index corner : grid.points().atCorner[leaf])
    {
      if (corner != noIndex)
      {
        points.insert(corner);
      }
    }
  }

  void moveTo(Index point, const LatticePoint& place)
  {
    if (place == grid.home(point))
    {
      grid.moveHome(point);
    }
    else
    {
      grid.move(point, place);
    }
    for (int direction = 0; direction < 6; ++direction)
    {
      const GridPlaces::Edge edge = grid.edge(point, direction);
      if (!edge.exists())
      {
        continue;
      }
      const auto [start, along] = stored(point, direction, edge);
      const GridPlaces::Edge same = start == point ? edge : grid.edge(start, along);
      const EdgeSegment segment = grid.segment(start, along, same);
      const auto cuts = cutEdge(grid, probe, start, same, segment);
      const auto found = idOf.find(keyOf(start, along));
      if (cuts.empty() && found == idOf.end())
      {
        continue;
      }
      const Index id = found == idOf.end() ? add(start, along, segment, same.other == noIndex) : found->second;
      edges[id].segment = segment;
      edges[id].cuts.assign(cuts.begin(), cuts.end());
    }
  }

  /// Sheets in the leaf that do not meet, and curves that do not, beyond the one it can hold.
  int surplus(Index leaf)
  {
    const auto found = edgesOfLeaf.find(leaf);
    if (found == edgesOfLeaf.end())
    {
      return 0;
    }
    seen.clear();
    for (const Index id : found->second)
    {
      if (!edges[id].cuts.empty())
      {
        seen.push_back(seenFrom(leaf, edges[id].segment, edges[id].cuts));
      }
    }
    topology.analyse(leaf, seen);
    return std::max(topology.sheets() - 1, 0) + (isTangle(leaf) ? 1 : 0);
  }

  /// Whether curves meet or end at the vertex of the leaf looked at last, but at no corner near it.
  bool isTangle(Index leaf) const
  {
    if (!topology.isKnot() || (topology.isEnd() && isOnSide(leaf)))
    {
      return false;
    }
    const auto curves = topology.curves();
    std::vector<Index> leaves{leaf};
    for (const CutEdge& edge : seen)
    {
      leaves.insert(leaves.end(), edge.beside.begin(), edge.beside.end());
    }
    return std::none_of(leaves.begin(), leaves.end(), [&](Index near) {
      const auto items = octree.items(near);
      return std::any_of(items.begin(), items.end(), [&](ModelItem piece) {
        return piece.kind == ModelItem::corner &&
               std::includes(atCorners[piece.index].begin(), atCorners[piece.index].end(), curves.begin(),
                             curves.end());
      });
    });
  }

  bool isOnSide(Index leaf) const
  {
    return octree.frame().domainPlanes(octree.lowCorner(leaf), octree.highCorner(leaf)) != 0;
  }

  double costAt(Index point)
  {
    double cost = 0.0;
    for (int direction = 0; direction < 6; ++direction)
    {
      const GridPlaces::Edge edge = grid.edge(point, direction);
      if (const LiveEdge* live = edge.exists() ? find(point, direction, edge) : nullptr)
      {
        cost += surplusCutCost * static_cast<double>(surplusCuts(*live));
      }
    }
    const auto& leaves = grid.points().leaves[point];
    for (std::size_t i = 0; i < leaves.size(); ++i)
    {
      if (std::find(leaves.begin(), leaves.begin() + static_cast<std::ptrdiff_t>(i), leaves[i]) ==
          leaves.begin() + static_cast<std::ptrdiff_t>(i))
      {
        cost += surplus(leaves[i]);
      }
    }
    const double moved = (toVector(grid.place(point)) - toVector(grid.home(point))).norm();
    return cost + moveCost * moved / static_cast<double>(shortestEdge(point));
  }

  const LiveEdge* find(Index point, int direction, const GridPlaces::Edge& edge) const
  {
    const auto [start, along] = stored(point, direction, edge);
    const auto found = idOf.find(keyOf(start, along));
    return found == idOf.end() ? nullptr : &edges[found->second];
  }

  /// Cuts beyond the one an edge can hold. A domain side is a sheet too.
  static std::size_t surplusCuts(const LiveEdge& edge)
  {
    return edge.cuts.empty() ? 0 : edge.cuts.size() - (edge.leavesDomain ? 0 : 1);
  }

  std::int64_t shortestEdge(Index point) const
  {
    int level = 0;
    for (const Index leaf : grid.points().leaves[point])
    {
      level = std::max(level, octree.level(leaf));
    }
    return octree.frame().latticeSize(level);
  }

  /// Collects places for a point that are not too far.
  struct Candidates
  {
    LatticePoint home;
    std::int64_t reach;
    std::vector<LatticePoint> places;

    void add(const Vec3& p)
    {
      const LatticePoint place{std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
      const bool near = std::abs(place[0] - home[0]) <= reach && std::abs(place[1] - home[1]) <= reach &&
                        std::abs(place[2] - home[2]) <= reach;
      if (near && std::find(places.begin(), places.end(), place) == places.end())
      {
        places.push_back(place);
      }
    }
  };

  std::vector<LatticePoint> candidates(Index point)
  {
    const LatticePoint home = grid.home(point);
    const auto reach = static_cast<std::int64_t>(farthestMove * static_cast<double>(shortestEdge(point)));
    Candidates found{home, reach, {home}};
    for (int direction = 0; direction < 6; ++direction)
    {
      addBetweenCuts(point, direction, found);
    }
    const auto& leaves = grid.points().leaves[point];
    for (const Index leaf : std::set<Index>(leaves.begin(), leaves.end()))
    {
      addBetweenCurves(point, leaf, found);
    }
    return std::move(found.places);
  }

  /// Places between the cuts of an edge of the point, and a step beyond them.
  void addBetweenCuts(Index point, int direction, Candidates& found) const
  {
    const GridPlaces::Edge edge = grid.edge(point, direction);
    const LiveEdge* live = edge.exists() ? find(point, direction, edge) : nullptr;
    if (!live)
    {
      return;
    }
    const bool fromStart = stored(point, direction, edge).first == point;
    std::vector<double> cuts;
    for (const SurfaceCrossing& cut : live->cuts)
    {
      cuts.push_back(fromStart ? cut.parameter : 1.0 - cut.parameter);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i < cuts.size(); ++i)
    {
      const double next = i + 1 < cuts.size() ? cuts[i + 1] : 1.0;
      const double middle = 0.5 * (cuts[i] + next);
      if (next - cuts[i] < thinnestGap)
      {
        continue;
      }
      for (const double t : {middle, std::min(middle, cuts[i] + stepBeyond)})
      {
        found.add(pointOn(live->segment, fromStart ? t : 1.0 - t));
      }
    }
  }

  /// Places in the middle between curves that the leaf's vertex cannot both be on.
  void addBetweenCurves(Index point, Index leaf, Candidates& found)
  {
    if (surplus(leaf) == 0)
    {
      return;
    }
    const auto curves = topology.curves();
    const Vec3 p = toVector(grid.place(point));
    for (std::size_t i = 1; i < curves.size(); ++i)
    {
      for (std::size_t k = 0; k < i; ++k)
      {
        if (haveCommon(curves[i], curves[k]))
        {
          addBetween(p, nearestOnCurve(leaf, p, curves[i]), nearestOnCurve(leaf, p, curves[k]), found);
        }
      }
    }
  }

  /// Curves that bound a chart in common have a strip of it between them. Others have a gap between them, and a grid
  /// edge put through it would let through what the octants keep apart.
  static bool haveCommon(const std::vector<Index>& a, const std::vector<Index>& b)
  {
    return std::any_of(a.begin(), a.end(), [&](Index chart) { return std::binary_search(b.begin(), b.end(), chart); });
  }

  static void addBetween(const Vec3& p, const std::optional<Vec3>& a, const std::optional<Vec3>& b, Candidates& found)
  {
    if (a && b && (*a - *b).squaredNorm() > 1.0)
    {
      const Vec3 along = (*a - *b).normalized();
      found.add(p - along * along.dot(p - 0.5 * (*a + *b)));
    }
  }

  std::optional<Vec3> nearestOnCurve(Index leaf, const Vec3& p, const std::vector<Index>& ending) const
  {
    std::optional<Vec3> best;
    std::vector<Index> leaves{leaf};
    for (const CutEdge& edge : seen)
    {
      leaves.insert(leaves.end(), edge.beside.begin(), edge.beside.end());
    }
    for (const Index near : leaves)
    {
      for (const ModelItem piece : octree.items(near))
      {
        if (piece.kind != ModelItem::featureEdge)
        {
          continue;
        }
        const FeatureEdge& edge = model.featureEdges[piece.index];
        if (model.curves[edge.curve].ending == ending)
        {
          const Vec3 q = nearestOnSegment(p, toVector(model.points[edge.a]), toVector(model.points[edge.b]));
          best = !best || (q - p).squaredNorm() < (*best - p).squaredNorm() ? q : *best;
        }
      }
    }
    return best;
  }

  GridPlaces& grid;
  const Octree& octree;
  const SurfaceModel& model;
  EdgeProbe probe;
  LeafTopology topology;
  std::vector<std::vector<std::vector<Index>>> atCorners;
  std::vector<LiveEdge> edges;
  std::unordered_map<std::uint64_t, Index> idOf;
  std::unordered_map<Index, std::vector<Index>> edgesOfLeaf;
  std::vector<CutEdge> seen;
};

/// Of all moves that gain something, in the order of gain, those that do not touch the same leaves.
std::vector<Search::Move> independent(std::vector<Search::Move> moves, const GridPoints& points)
{
  std::sort(moves.begin(), moves.end(), [](const Search::Move& l, const Search::Move& r) {
    return l.gain != r.gain ? l.gain > r.gain : l.point < r.point;
  });
  std::unordered_set<Index> touched;
  std::vector<Search::Move> chosen;
  for (const Search::Move& move : moves)
  {
    const auto& leaves = points.leaves[move.point];
    if (move.gain > 0.0 && std::none_of(leaves.begin(), leaves.end(), [&](Index l) { return touched.contains(l); }))
    {
      touched.insert(leaves.begin(), leaves.end());
      chosen.push_back(move);
    }
  }
  return chosen;
}

/// Per grid point, the first point of its zone; noIndex in zones so thin that surfaces cut the octants about all of
/// their points, as the pieces are in which the space between two walls is seen by a coarse grid.
std::vector<Index> wideZones(const GridPoints& points, const Crossings& crossings)
{
  const auto count = static_cast<Index>(crossings.neighbours.size());
  UnionFind sets(count);
  for (Index point = 0; point < count; ++point)
  {
    for (const std::int32_t neighbour : crossings.neighbours[point])
    {
      if (neighbour >= 0)
      {
        sets.join(point, static_cast<Index>(neighbour));
      }
    }
  }
  std::vector<char> isCut(points.atCorner.size(), 0);
  for (const CrossedEdge& edge : crossings.crossedEdges)
  {
    std::for_each(edge.segment.about.begin(), edge.segment.about.end(), [&](Index leaf) { isCut[leaf] = 1; });
  }
  std::vector<char> isWide(count, 0);
  for (Index point = 0; point < count; ++point)
  {
    const auto& leaves = points.leaves[point];
    if (std::none_of(leaves.begin(), leaves.end(), [&](Index leaf) { return isCut[leaf] != 0; }))
    {
      isWide[sets.find(point)] = 1;
    }
  }
  std::vector<Index> zones(count);
  for (Index point = 0; point < count; ++point)
  {
    const Index root = sets.find(point);
    zones[point] = isWide[root] ? root : noIndex;
  }
  return zones;
}

/// Moved points through which zones meet that are apart in the octree's own grid. Zones are followed, breadth first,
/// from points that keep theirs through those that were moved and those of no zone.
class JoiningPoints
{
public:
  JoiningPoints(const GridPlaces& places, const Crossings& found, const std::vector<Index>& zones)
      : grid(places), crossings(found), apart(zones)
  {
  }

  std::vector<Index> find()
  {
    for (const Index point : grid.movedPoints())
    {
      for (const std::int32_t neighbour : crossings.neighbours[point])
      {
        if (neighbour >= 0 && isFixed(static_cast<Index>(neighbour)))
        {
          visit(static_cast<Index>(neighbour), point);
        }
      }
    }
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      for (const std::int32_t neighbour : crossings.neighbours[front[i]])
      {
        if (neighbour >= 0)
        {
          visit(front[i], static_cast<Index>(neighbour));
        }
      }
    }
    return {joining.begin(), joining.end()};
  }

private:
  struct Reached
  {
    Index zone;
    Index from;
  };

  bool isFixed(Index point) const { return apart[point] != noIndex && !grid.isMoved(point); }

  void visit(Index from, Index point)
  {
    const Index zone = isFixed(from) ? apart[from] : reached.at(from).zone;
    if (!isFixed(point) && reached.try_emplace(point, Reached{zone, from}).second)
    {
      front.push_back(point);
      return;
    }
    const Index there = isFixed(point) ? apart[point] : reached.at(point).zone;
    if (there != zone)
    {
      addMoved(point);
      addMoved(from);
    }
  }

  /// The last moved point on the way to a point.
  void addMoved(Index point)
  {
    while (!isFixed(point) && !grid.isMoved(point))
    {
      point = reached.at(point).from;
    }
    if (grid.isMoved(point))
    {
      joining.insert(point);
    }
  }

  const GridPlaces& grid;
  const Crossings& crossings;
  const std::vector<Index>& apart;
  std::unordered_map<Index, Reached> reached;
  std::vector<Index> front;
  std::set<Index> joining;
};

} // namespace

Crossings modifyGrid(GridPlaces& grid, const SurfaceModel& model, Crossings home, const RunContext& context)
{
  Search search(grid, model, home);
  constexpr int gapRounds = 4;
  constexpr int mostRounds = 20;
  for (const double reach : {0.5, 1.0})
  {
    for (int round = 0; round < gapRounds && search.enterGaps(reach); ++round)
    {
      context.progress.check();
    }
  }
  std::set<Index> dirty = search.pointsInQuestion();
  std::map<Index, Search::Move> moves;
  for (int sweep = 0; sweep < mostSweeps && !dirty.empty(); ++sweep)
  {
    for (const Index point : dirty)
    {
      context.progress.check();
      const Search::Move move = search.bestMove(point);
      if (move.gain > 0.0)
      {
        moves[point] = move;
      }
      else
      {
        moves.erase(point);
      }
    }
    dirty.clear();
    std::vector<Search::Move> open;
    for (const auto& [point, move] : moves)
    {
      open.push_back(move);
    }
    for (const Search::Move& move : independent(std::move(open), grid.points()))
    {
      search.apply(move);
      search.addNeighbours(move.point, dirty);
    }
  }
  if (grid.movedCount() == 0)
  {
    return home;
  }
  const std::vector<Index> apart = wideZones(grid.points(), home);
  for (int round = 0; round < mostRounds; ++round)
  {
    Crossings crossings = findCrossings(grid, model, context);
    const std::vector<Index> joining = JoiningPoints(grid, crossings, apart).find();
    if (joining.empty())
    {
      return crossings;
    }
    std::for_each(joining.begin(), joining.end(), [&](Index point) { grid.moveHome(point); });
  }
  grid.moveAllHome();
  return home;
}

} // namespace atria
