// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/PlaceSearch.h"

#include "Dual/CandidatePlaces.h"
#include "Surface/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace atria {

namespace {

/// How far a point may move, against its shortest edge.
constexpr double farthestMove = 0.95;
/// How far beyond a single cut a point is put, against the edge, if nothing else limits it.
constexpr double stepBeyond = 0.1;
/// Where an edge passes a curve nearer to its other end than this part of it, its end is not moved for that.
constexpr double leastPart = 0.2;
constexpr double surplusCutCost = 2.0;
constexpr int mostSweeps = 100;
constexpr double smallestGain = 1e-9;
/// An octant with more surplus holds more than a moved corner can part; it is left as it is.
constexpr int mostSurplus = 8;
/// Curves of an octant between which places are looked for.
constexpr std::size_t mostCurves = 6;
/// What a move of a point by its shortest edge counts against one surplus.
constexpr double moveCost = 0.05;

/// A better place for a point.
struct Move
{
  double gain = 0.0;
  Index point = noIndex;
  LatticePoint place{};
};

/// Curves that bound a chart in common have a strip of it between them. Others have a gap between them, and a grid
/// edge put through it would let through what the octants keep apart.
bool haveCommon(const std::vector<Index>& a, const std::vector<Index>& b)
{
  return std::any_of(a.begin(), a.end(), [&](Index chart) { return std::binary_search(b.begin(), b.end(), chart); });
}

class PlaceSearch
{
public:
  PlaceSearch(MovingGrid& moving, const RunContext& run) : grid(moving), context(run), own(moving) {}

  void run()
  {
    while (sendHome())
    {
      context.progress.check();
    }
    std::set<Index> dirty;
    for (const Index leaf : grid.leavesInQuestion())
    {
      grid.addCorners(leaf, grid.surplus(leaf) > mostSurplus ? left : dirty);
    }
    std::erase_if(dirty, [&](Index point) { return left.contains(point); });
    sweep(std::move(dirty));
    sweep(turnAboutCurves());
  }

private:
  /// Moves points one by one until nothing is gained.
  void sweep(std::set<Index> dirty)
  {
    for (int round = 0; round < mostSweeps && !dirty.empty(); ++round)
    {
      for (const Move& move : bestMoves({dirty.begin(), dirty.end()}))
      {
        if (move.gain > 0.0)
        {
          moves[move.point] = move;
        }
        else
        {
          moves.erase(move.point);
        }
      }
      dirty = makeMoves();
    }
  }

  /// Where sheets cross each other along the octants' diagonals, the corners of the octants about the curve lie on
  /// them, and none finds a place alone: they are put about the curve together, and turned. Returns the points whose
  /// costs they change.
  std::set<Index> turnAboutCurves()
  {
    std::map<Index, std::set<Index>> leavesOf; // by feature edge
    for (const Index leaf : grid.leavesInQuestion())
    {
      for (const ModelItem piece : grid.octree().items(leaf, ModelItem::featureEdge))
      {
        if (isCrossing(grid.model().featureEdges[piece.index]) && grid.surplus(leaf) <= mostSurplus)
        {
          leavesOf[piece.index].insert(leaf);
        }
      }
    }
    std::set<Index> changed;
    for (const auto& [edge, leaves] : leavesOf)
    {
      context.progress.check();
      if (turnAbout(grid.model().featureEdges[edge], leaves))
      {
        for (const Index leaf : leaves)
        {
          grid.addCorners(leaf, changed);
        }
      }
    }
    std::erase_if(changed, [&](Index point) { return left.contains(point); });
    return changed;
  }

  bool isCrossing(const FeatureEdge& edge) const { return grid.model().curves[edge.curve].charts.size() > 3; }

  using Places = std::vector<std::pair<Index, LatticePoint>>;

  bool turnAbout(const FeatureEdge& edge, const std::set<Index>& leaves)
  {
    Places best;
    double leastCost = -smallestGain;
    for (const double angle : {0.0, 22.5, -22.5, 45.0, -45.0})
    {
      for (const double scale : {1.0, 0.7})
      {
        const Places turned = placesAbout(edge, leaves, angle, scale);
        Places before;
        double cost = 0.0;
        for (const auto& [point, place] : turned)
        {
          before.emplace_back(point, grid.places().place(point));
          cost += moved(point, place);
        }
        if (cost < leastCost)
        {
          leastCost = cost;
          best = turned;
        }
        for (auto back = before.rbegin(); back != before.rend(); ++back)
        {
          grid.moveTo(back->first, back->second);
        }
      }
    }
    for (const auto& [point, place] : best)
    {
      grid.moveTo(point, place);
    }
    return !best.empty();
  }

  /// Moves the point; what the costs change by.
  double moved(Index point, const LatticePoint& place)
  {
    const double before = costAt(point, own);
    grid.moveTo(point, place);
    return costAt(point, own) - before;
  }

  /// The corners of the leaves, moved such that the curve is in the middle, and turned about it.
  Places placesAbout(const FeatureEdge& edge, const std::set<Index>& leaves, double angle, double scale) const
  {
    const Vec3 a = toVector(grid.model().points[edge.a]);
    const Vec3 axis = (toVector(grid.model().points[edge.b]) - a).normalized();
    const Eigen::AngleAxisd turn(angle * std::numbers::pi / 180.0, axis);
    std::set<Index> seen;
    Places places;
    for (const Index leaf : leaves)
    {
      std::set<Index> corners;
      grid.addCorners(leaf, corners);
      Vec3 centre = Vec3::Zero();
      for (const Index point : corners)
      {
        centre += toVector(grid.places().home(point)) / static_cast<double>(corners.size());
      }
      for (const Index point : corners)
      {
        if (left.contains(point) || grid.isBesideTurnedSide(point) || !seen.insert(point).second)
        {
          continue;
        }
        const Vec3 home = toVector(grid.places().home(point));
        const Vec3 offset = home - centre;
        const Vec3 across = offset - axis.dot(offset) * axis;
        const auto reach = static_cast<std::int64_t>(farthestMove * static_cast<double>(grid.shortestEdge(point)));
        CandidatePlaces one{grid.places().home(point), reach, {}};
        one.add(a + axis.dot(home - a) * axis + scale * (turn * across));
        if (!one.places.empty())
        {
          places.emplace_back(point, one.places.front());
        }
      }
    }
    return places;
  }

  /// Moves points home with which less is in question there, the farthest first. Returns whether any was.
  bool sendHome()
  {
    std::vector<std::pair<double, Index>> order;
    for (const Index point : grid.places().movedPoints())
    {
      order.emplace_back(-distanceFromHome(point, grid.places().place(point)), point);
    }
    std::sort(order.begin(), order.end());
    bool wasAny = false;
    for (const auto& [distance, point] : order)
    {
      const double before = costOf(grid.surplusAbout(point, own));
      const LatticePoint home = grid.places().home(point);
      if (before > 0.0 && costOf(grid.surplusAbout(point, home, own)) < before)
      {
        grid.moveTo(point, home);
        wasAny = true;
      }
    }
    return wasAny;
  }

  /// Makes those moves that do not touch the same leaves, best first. Returns the points whose costs they change.
  std::set<Index> makeMoves()
  {
    std::vector<Move> open;
    for (const auto& [point, move] : moves)
    {
      open.push_back(move);
    }
    std::sort(open.begin(), open.end(),
              [](const Move& l, const Move& r) { return l.gain != r.gain ? l.gain > r.gain : l.point < r.point; });
    std::unordered_set<Index> touched;
    std::set<Index> changed;
    for (const Move& move : open)
    {
      const auto& leaves = grid.points().leaves[move.point];
      if (std::any_of(leaves.begin(), leaves.end(), [&](Index leaf) { return touched.contains(leaf); }))
      {
        continue;
      }
      touched.insert(leaves.begin(), leaves.end());
      grid.moveTo(move.point, move.place);
      for (const Index leaf : leaves)
      {
        grid.addCorners(leaf, changed);
      }
    }
    std::erase_if(changed, [&](Index point) { return left.contains(point); });
    return changed;
  }

  std::vector<Move> bestMoves(const std::vector<Index>& points) const
  {
    constexpr std::size_t grain = 16;
    std::vector<Move> best(points.size());
    context.executor.forRanges(points.size(), grain, [&](std::size_t begin, std::size_t end) {
      MovingGrid::Look look(grid);
      for (std::size_t i = begin; i < end; ++i)
      {
        best[i] = bestMove(points[i], look);
      }
    });
    return best;
  }

  /// The best place for a point, found by trying; it stays where it is.
  Move bestMove(Index point, MovingGrid::Look& look) const
  {
    Move best{0.0, point, {}};
    const double before = costAt(point, look);
    if ((before < 1.0 && !grid.places().isMoved(point)) || grid.isBesideTurnedSide(point))
    {
      return best;
    }
    const LatticePoint from = grid.places().place(point);
    for (const LatticePoint& place : candidates(point, look))
    {
      if (place != from)
      {
        const double gain = before - costOf(grid.surplusAbout(point, place, look), point, place);
        if (gain > best.gain + smallestGain)
        {
          best.gain = gain;
          best.place = place;
        }
      }
    }
    return best;
  }

  double distanceFromHome(Index point, const LatticePoint& place) const
  {
    return (toVector(place) - toVector(grid.places().home(point))).norm();
  }

  double costAt(Index point, MovingGrid::Look& look) const
  {
    return costOf(grid.surplusAbout(point, look), point, grid.places().place(point));
  }

  static double costOf(const MovingGrid::Surplus& surplus)
  {
    return surplusCutCost * static_cast<double>(surplus.cuts) + surplus.leaves;
  }

  double costOf(const MovingGrid::Surplus& surplus, Index point, const LatticePoint& place) const
  {
    return costOf(surplus) + moveCost * distanceFromHome(point, place) / static_cast<double>(grid.shortestEdge(point));
  }

  std::vector<LatticePoint> candidates(Index point, MovingGrid::Look& look) const
  {
    const LatticePoint home = grid.places().home(point);
    const auto reach = static_cast<std::int64_t>(farthestMove * static_cast<double>(grid.shortestEdge(point)));
    CandidatePlaces found{home, reach, {home}};
    for (int direction = 0; direction < 6; ++direction)
    {
      addBetweenCuts(point, direction, found);
      addPastCurves(point, direction, found);
    }
    const auto& leaves = grid.points().leaves[point];
    for (const Index leaf : std::set<Index>(leaves.begin(), leaves.end()))
    {
      addBetweenCurves(point, leaf, look, found);
    }
    return std::move(found.places);
  }

  /// Places between the cuts of an edge of the point, and a step beyond them.
  void addBetweenCuts(Index point, int direction, CandidatePlaces& found) const
  {
    const auto edge = grid.cutEdge(point, direction);
    if (!edge)
    {
      return;
    }
    const bool fromStart = grid.startsAt(point, direction);
    std::vector<double> cuts;
    for (const SurfaceCrossing& cut : edge->cuts)
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
        found.add(pointOn(edge->segment, fromStart ? t : 1.0 - t));
      }
    }
  }

  /// Places from which an edge that two sheets cut passes on the other side of the curve in which they meet.
  void addPastCurves(Index point, int direction, CandidatePlaces& found) const
  {
    const auto edge = grid.cutEdge(point, direction);
    if (!edge || edge->surplus() == 0)
    {
      return;
    }
    const SurfaceModel& model = grid.model();
    const Vec3 p = toVector(grid.places().place(point));
    const Vec3 q = toVector(grid.startsAt(point, direction) ? edge->segment.end : edge->segment.start);
    const double step = thinnestGap * static_cast<double>(grid.shortestEdge(point));
    const auto& about = grid.points().leaves[point];
    for (const Index leaf : std::set<Index>(about.begin(), about.end()))
    {
      for (const ModelItem piece : grid.octree().items(leaf, ModelItem::featureEdge))
      {
        if (!joinsCuts(edge->cuts, model.featureEdges[piece.index]))
        {
          continue;
        }
        const FeatureEdge& curve = model.featureEdges[piece.index];
        const NearestPair way =
            nearestOfSegments(p, q, toVector(model.points[curve.a]), toVector(model.points[curve.b]));
        const double part = (way.first - q).norm() / (p - q).norm();
        if (part > leastPart && way.distance() > 1.0)
        {
          found.add(p + (1.0 + step / way.distance()) / part * (way.second - way.first));
        }
      }
    }
  }

  /// Whether neighbouring cuts are of two sheets that meet there.
  bool joinsCuts(std::span<const SurfaceCrossing> cuts, const FeatureEdge& edge) const
  {
    const SurfaceModel& model = grid.model();
    const std::vector<Index>& charts = model.curves[edge.curve].charts;
    const auto isThere = [&](const SurfaceCrossing& cut) {
      return std::binary_search(charts.begin(), charts.end(), model.charts[cut.triangle]);
    };
    return std::adjacent_find(cuts.begin(), cuts.end(), [&](const SurfaceCrossing& l, const SurfaceCrossing& r) {
             return model.charts[l.triangle] != model.charts[r.triangle] && isThere(l) && isThere(r);
           }) != cuts.end();
  }

  /// Places in the middle between curves that the leaf's vertex cannot both be on.
  void addBetweenCurves(Index point, Index leaf, MovingGrid::Look& look, CandidatePlaces& found) const
  {
    if (grid.surplus(leaf, look) == 0)
    {
      return;
    }
    const auto curves = look.topology().curves();
    if (curves.size() > mostCurves)
    {
      return;
    }
    const Vec3 p = toVector(grid.places().place(point));
    for (std::size_t i = 1; i < curves.size(); ++i)
    {
      for (std::size_t k = 0; k < i; ++k)
      {
        if (haveCommon(curves[i], curves[k]))
        {
          found.addBetween(p, nearestOnCurve(p, curves[i], look), nearestOnCurve(p, curves[k], look));
        }
      }
    }
  }

  std::optional<Vec3> nearestOnCurve(const Vec3& p, const std::vector<Index>& ending,
                                     const MovingGrid::Look& look) const
  {
    const SurfaceModel& model = grid.model();
    std::optional<Vec3> best;
    for (const Index leaf : look.leavesAbout())
    {
      for (const ModelItem piece : grid.octree().items(leaf, ModelItem::featureEdge))
      {
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

  MovingGrid& grid;
  const RunContext& context;
  MovingGrid::Look own;
  std::map<Index, Move> moves;
  /// Corners of octants that hold too much.
  std::set<Index> left;
};

} // namespace

void searchPlaces(MovingGrid& grid, const RunContext& context) { PlaceSearch(grid, context).run(); }

} // namespace atria
