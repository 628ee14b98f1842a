// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/PlaceSearch.h"

#include "Dual/Displacement/CandidatePlaces.h"
#include "Dual/Displacement/MoveChains.h"
#include "Support/Angles.h"
#include "Support/Sorting.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

namespace atria {

namespace {

/// With ten, 2.5 % more features are unresolved in models of others; with forty, no fewer are.
constexpr int mostSweeps = 20;

/// Divides the points into rounds. Points of one round have no leaf in common; of two with a common leaf, the first in
/// order is in the earlier round. A move changes nothing beyond the leaves around the point. So all points of a round
/// may be evaluated at once, with the same result as one after the other.
std::vector<std::vector<Index>> roundsOf(const std::vector<std::pair<double, Index>>& order, const GridPoints& points)
{
  std::vector<Index> leaves;
  for (const auto& [rank, point] : order)
  {
    leaves.insert(leaves.end(), points.leaves[point].begin(), points.leaves[point].end());
  }
  sortUnique(leaves);
  std::vector<std::size_t> roundsThere(leaves.size(), 0);
  std::vector<std::vector<Index>> rounds;
  for (const auto& [rank, point] : order)
  {
    std::array<std::size_t, 8> places;
    std::ranges::transform(points.leaves[point], places.begin(), [&](Index leaf) {
      return static_cast<std::size_t>(std::ranges::lower_bound(leaves, leaf) - leaves.begin());
    });
    std::size_t round = 0;
    for (const std::size_t place : places)
    {
      round = std::max(round, roundsThere[place]);
    }
    for (const std::size_t place : places)
    {
      roundsThere[place] = round + 1;
    }
    rounds.resize(std::max(rounds.size(), round + 1));
    rounds[round].push_back(point);
  }
  return rounds;
}

class PlaceSearch
{
public:
  PlaceSearch(MovingGrid& moving, const RunContext& run)
      : grid(moving), moves(moving, run), chains(moving, moves), context(run)
  {
  }

  void run()
  {
    // After the first round, only points around which something changed are tried.
    for (std::vector<Index> asked = grid.places().displacedPoints(); !asked.empty();
         asked = undisplaceWhereBetter(asked))
    {
      context.progress.check();
    }
    std::set<Index> dirty;
    for (const Index leaf : grid.unresolvedLeaves(context))
    {
      grid.addCorners(leaf, dirty);
    }
    std::erase_if(dirty, [&](Index point) { return grid.isFixed(point); });
    sweep(std::move(dirty));
    sweep(turnAboutCurves());
    const std::vector<Index> all = grid.unresolvedLeaves(context);
    std::set<Index> unresolved(all.begin(), all.end());
    while (!unresolved.empty())
    {
      const std::set<Index> changed = chains.run(unresolved, context);
      sweep(changed);
      unresolved = chains.unresolvedAbout(changed);
    }
  }

private:
  using Places = PlaceMoves::Places;

  /// Moves points one by one until nothing is gained. Starts without moves left over from earlier sweeps, so that the
  /// result at a place depends only on what is around it.
  void sweep(std::set<Index> dirty)
  {
    open.clear();
    for (int round = 0; round < mostSweeps && !(dirty.empty() && open.empty()); ++round)
    {
      context.progress.check();
      std::erase_if(dirty, [&](Index point) { return isHopeless(point); });
      for (const PlaceMove& move : moves.best({dirty.begin(), dirty.end()}))
      {
        if (move.gain > 0.0)
        {
          open[move.point] = move;
        }
        else
        {
          open.erase(move.point);
        }
      }
      dirty = makeMoves();
    }
  }

  /// True if no leaf around a point is hopeful. Drops the point's open move then.
  bool isHopeless(Index point)
  {
    const auto& leaves = grid.points().leaves[point];
    const bool hopeless = std::ranges::none_of(leaves, [&](Index leaf) { return grid.isHopeful(leaf); });
    if (hopeless)
    {
      open.erase(point);
    }
    return hopeless;
  }

  /// Centers the octants around a curve on it by moving all of their corners together, and turns them. If sheets cross
  /// along the octants' diagonals, these corners lie on the sheets and none finds a place alone. Returns the points
  /// whose costs change.
  std::set<Index> turnAboutCurves()
  {
    std::map<Index, std::set<Index>> leavesOf; // keys are feature edges
    for (const Index leaf : grid.unresolvedLeaves(context))
    {
      std::set<Index> curves; // one edge of each stands for all
      for (const ModelItem piece : grid.octree().items(leaf, ModelItem::featureEdge))
      {
        const FeatureEdge& edge = grid.model().featureEdges[piece.index];
        if (isCrossing(edge) && curves.insert(edge.curve).second)
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
    std::erase_if(changed, [&](Index point) { return grid.isFixed(point); });
    return changed;
  }

  bool isCrossing(const FeatureEdge& edge) const { return grid.model().curves[edge.curve].charts.size() > 3; }

  bool turnAbout(const FeatureEdge& edge, const std::set<Index>& leaves)
  {
    Places best;
    double bestAngle = 0.0;
    double leastCost = std::numeric_limits<double>::infinity();
    const auto tryTurn = [&](double angle, double scale) {
      Places turned = placesAbout(edge, leaves, angle, scale);
      MovingGrid::Trail trail;
      const double cost = moves.make(turned, trail);
      grid.takeBack(trail);
      if (cost < leastCost)
      {
        leastCost = cost;
        bestAngle = angle;
        best = std::move(turned);
      }
    };
    for (const double angle : {0.0, 22.5, -22.5, 45.0, -45.0})
    {
      tryTurn(angle, 1.0);
    }
    tryTurn(bestAngle, 0.7);
    if (leastCost >= -smallestGain)
    {
      return false;
    }
    grid.moveTogether(best);
    return true;
  }

  /// Returns places for the corners of the leaves: with the curve in the middle, and turned by `angle` degrees.
  Places placesAbout(const FeatureEdge& edge, const std::set<Index>& leaves, double angle, double scale) const
  {
    const Vec3 a = toVector(grid.model().points[edge.a]);
    const Vec3 axis = (toVector(grid.model().points[edge.b]) - a).normalized();
    const Eigen::AngleAxisd turn(radians(angle), axis);
    std::set<Index> seen;
    Places places;
    for (const Index leaf : leaves)
    {
      std::set<Index> corners;
      grid.addCorners(leaf, corners);
      Vec3 center = Vec3::Zero();
      for (const Index point : corners)
      {
        center += toVector(grid.places().undisplaced(point)) / static_cast<double>(corners.size());
      }
      for (const Index point : corners)
      {
        if (grid.isFixed(point) || !seen.insert(point).second)
        {
          continue;
        }
        const Vec3 undisplaced = toVector(grid.places().undisplaced(point));
        const Vec3 offset = undisplaced - center;
        const Vec3 across = offset - axis.dot(offset) * axis;
        CandidatePlaces one{grid.places().undisplaced(point), farthestReach(grid, point), {}};
        one.add(a + axis.dot(undisplaced - a) * axis + scale * (turn * across));
        if (!one.places.empty())
        {
          places.emplace_back(point, one.places.front());
        }
      }
    }
    return places;
  }

  /// Moves points back to their undisplaced places if that leaves less unresolved, the farthest first. Returns the
  /// displaced points around which that changes anything.
  std::vector<Index> undisplaceWhereBetter(const std::vector<Index>& points)
  {
    std::vector<std::pair<double, Index>> order;
    order.reserve(points.size());
    for (const Index point : points)
    {
      order.emplace_back(-moves.displacementOf(point, grid.places().place(point)), point);
    }
    std::sort(order.begin(), order.end());
    std::set<Index> changed;
    for (const std::vector<Index>& round : roundsOf(order, grid.points()))
    {
      const std::vector<char> isBetter = areBetterUndisplaced(round);
      for (std::size_t i = 0; i < round.size(); ++i)
      {
        if (isBetter[i])
        {
          movePoint(round[i], grid.places().undisplaced(round[i]), changed);
        }
      }
    }
    std::erase_if(changed, [&](Index point) { return !grid.places().isDisplaced(point); });
    return {changed.begin(), changed.end()};
  }

  std::vector<char> areBetterUndisplaced(const std::vector<Index>& points)
  {
    constexpr std::size_t grain = 1;
    std::vector<char> found(points.size());
    grid.forEach(points.size(), grain, context, [&](std::size_t i, MovingGrid::Look& look) {
      const double before = grid.surplusAbout(points[i], look).cost();
      const LatticePoint undisplaced = grid.places().undisplaced(points[i]);
      found[i] = before > 0.0 && grid.surplusAbout(points[i], undisplaced, look, before).cost() < before ? 1 : 0;
    });
    return found;
  }

  /// Makes open moves that do not touch the same leaves, best first. Returns the points whose costs they change.
  std::set<Index> makeMoves()
  {
    std::vector<PlaceMove> sorted;
    for (const auto& [point, move] : open)
    {
      sorted.push_back(move);
    }
    std::sort(sorted.begin(), sorted.end(), [](const PlaceMove& l, const PlaceMove& r) {
      return l.gain != r.gain ? l.gain > r.gain : l.point < r.point;
    });
    std::unordered_set<Index> touched;
    std::set<Index> changed;
    for (const PlaceMove& move : sorted)
    {
      const auto& leaves = grid.points().leaves[move.point];
      if (std::any_of(leaves.begin(), leaves.end(), [&](Index leaf) { return touched.contains(leaf); }))
      {
        continue;
      }
      touched.insert(leaves.begin(), leaves.end());
      movePoint(move.point, move.place, changed);
    }
    std::erase_if(changed, [&](Index point) { return grid.isFixed(point); });
    return changed;
  }

  /// Moves a point, and adds the points for which other places may be best now: it, the ends of its edges, and the
  /// corners of leaves whose edges other charts cut. The surplus of a leaf depends on these charts alone.
  void movePoint(Index point, const LatticePoint& place, std::set<Index>& changed)
  {
    MovingGrid::Trail trail;
    grid.moveTogether({{point, place}}, &trail);
    changed.insert(point);
    for (int direction = 0; direction < 6; ++direction)
    {
      if (const GridPlaces::Edge edge = grid.places().edge(point, direction); edge.exists() && edge.other != noIndex)
      {
        changed.insert(edge.other);
      }
    }
    for (const auto& [leaf, finding] : trail.leaves)
    {
      grid.addCorners(leaf, changed);
    }
  }

  MovingGrid& grid;
  PlaceMoves moves;
  MoveChains chains;
  const RunContext& context;
  /// The best move of each point that has one.
  std::map<Index, PlaceMove> open;
};

} // namespace

void searchPlaces(MovingGrid& grid, const RunContext& context) { PlaceSearch(grid, context).run(); }

} // namespace atria
