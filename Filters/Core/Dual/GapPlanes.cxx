// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/GapPlanes.h"

#include "Surface/Distance.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace atria {

namespace {

/// Sheets closer than this part of an edge are left to merge.
constexpr double thinnestGap = 0.02;
constexpr double rounding = 1e-6;

class GapPlanes
{
public:
  GapPlanes(MovingGrid& moving, double reachRatio) : grid(moving), reach(reachRatio) {}

  bool enter()
  {
    for (const Index leaf : grid.leavesInQuestion())
    {
      grid.surplus(leaf);
      const auto pairs = sheetsSideBySide();
      for (const Index point : grid.points().atCorner[leaf])
      {
        if (point != noIndex && !grid.places().isMoved(point) && !grid.isBesideTurnedSide(point))
        {
          noteGaps(point, pairs);
        }
      }
    }
    for (const auto& [point, place] : nearest)
    {
      grid.moveTo(point, place.at);
    }
    return !nearest.empty();
  }

private:
  struct Place
  {
    double step;
    LatticePoint at;
  };

  const SurfaceModel& model() const { return grid.model(); }

  /// Charts of the leaf that do not meet in it, or follow each other on one of its edges.
  std::vector<std::pair<Index, Index>> sheetsSideBySide() const
  {
    std::vector<std::pair<Index, Index>> pairs = grid.topology().apart();
    for (const CutEdge& edge : grid.cutEdges())
    {
      for (std::size_t i = 1; i < edge.cuts.size(); ++i)
      {
        pairs.push_back(std::minmax(model().charts[edge.cuts[i - 1].triangle], model().charts[edge.cuts[i].triangle]));
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  void noteGaps(Index point, const std::vector<std::pair<Index, Index>>& pairs)
  {
    const Vec3 p = toVector(grid.places().place(point));
    for (const auto& [a, b] : pairs)
    {
      noteGap(point, nearestOnChart(p, a), nearestOnChart(p, b));
    }
    noteSideGaps(point);
  }

  /// Notes the place of a point between a chart that cuts an edge out of the domain, and the side it leads to.
  void noteSideGaps(Index point)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const auto edge = grid.cutEdge(point, direction);
      if (edge && edge->leavesDomain && !edge->cuts.empty())
      {
        const Vec3 p = toVector(grid.places().place(point));
        Vec3 onSide = p;
        onSide[axisOf(direction)] = static_cast<double>(edge->segment.end[axisOf(direction)]);
        noteGap(point, nearestOnChart(p, model().charts[edge->cuts.back().triangle]), onSide);
      }
    }
  }

  /// Notes the place of a point between its nearest points on two sheets, if they lie to the same side of it.
  void noteGap(Index point, const std::optional<Vec3>& onA, const std::optional<Vec3>& onB)
  {
    const Vec3 p = toVector(grid.places().place(point));
    const auto size = static_cast<double>(grid.shortestEdge(point));
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
    const Vec3 q = p + step * normal;
    const Place place{std::abs(step), {std::llround(q[0]), std::llround(q[1]), std::llround(q[2])}};
    const auto [found, isNew] = nearest.try_emplace(point, place);
    if (!isNew && place.step < found->second.step)
    {
      found->second = place;
    }
  }

  std::optional<Vec3> nearestOnChart(const Vec3& p, Index chart) const
  {
    std::optional<Vec3> best;
    for (const Index leaf : grid.leavesAbout())
    {
      for (const ModelItem piece : grid.octree().items(leaf))
      {
        if (piece.kind == ModelItem::triangle && model().charts[piece.index] == chart)
        {
          const Vec3 q =
              nearestOnTriangle(p, toVector(model().corner(piece.index, 0)), toVector(model().corner(piece.index, 1)),
                                toVector(model().corner(piece.index, 2)));
          best = !best || (q - p).squaredNorm() < (*best - p).squaredNorm() ? q : *best;
        }
      }
    }
    return best;
  }

  MovingGrid& grid;
  double reach;
  std::map<Index, Place> nearest;
};

} // namespace

bool enterGaps(MovingGrid& grid, double reach) { return GapPlanes(grid, reach).enter(); }

} // namespace atria
