// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/CandidatePlaces.h"

#include "Support/Sorting.h"
#include "Surface/Search/Distance.h"

namespace atria {

namespace {

/// Most curves of an octant between which places are searched. With more there are too many pairs to try.
constexpr std::size_t mostCurves = 6;
/// Distance beyond a single cut at which a point is put if nothing else limits it, as a part of the edge.
constexpr double stepBeyond = 0.1;

/// True if two curves bound a common chart, so that a strip of it lies between them. Other curves have a gap between
/// them, and a grid edge put through it would join what the octants keep apart.
bool haveCommon(const std::vector<Index>& a, const std::vector<Index>& b)
{
  return std::any_of(a.begin(), a.end(), [&](Index chart) { return std::binary_search(b.begin(), b.end(), chart); });
}

class Candidates
{
public:
  Candidates(const MovingGrid& moving, Index of, bool sheets, MovingGrid::Look& by)
      : grid(moving), point(of), across(sheets), look(by),
        about(moving.points().leaves[of].begin(), moving.points().leaves[of].end()),
        found{moving.places().undisplaced(of), farthestReach(moving, of), {moving.places().undisplaced(of)}}
  {
  }

  std::vector<LatticePoint> places()
  {
    sortUnique(about);
    for (int direction = 0; direction < 6; ++direction)
    {
      addBetweenCuts(direction);
      addPastCurves(direction);
    }
    for (const Index leaf : about)
    {
      if (grid.isCalm(leaf) || grid.surplus(leaf, look) == 0)
      {
        continue;
      }
      addBetweenCurves();
      if (across)
      {
        addAcrossSheets();
      }
    }
    return std::move(found.places);
  }

private:
  /// Adds places between the cuts of an edge of the point, and a step beyond them.
  void addBetweenCuts(int direction)
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

  /// Adds places from which an edge that two sheets cut passes on the other side of the curve in which they meet.
  void addPastCurves(int direction)
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
    for (const Index leaf : about)
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
        if (way.distance() > 1.0 && way.distance() < part * static_cast<double>(found.reach))
        {
          found.add(p + (1.0 + step / way.distance()) / part * (way.second - way.first));
        }
      }
    }
  }

  /// True if two neighboring cuts are of different sheets that meet in the curve of the edge.
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

  /// Adds places in the middle between curves that the vertex of the leaf of `look` cannot both be on.
  void addBetweenCurves()
  {
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
          found.addBetween(p, nearestOnCurve(p, curves[i]), nearestOnCurve(p, curves[k]));
        }
      }
    }
  }

  /// Adds places between and across sheets that do not meet in the leaf of `look`, by the shortest way, as its edges
  /// may run along them or cut them far off. A sheet has no other side beyond its boundary edge.
  void addAcrossSheets()
  {
    const Vec3 p = toVector(grid.places().place(point));
    const auto size = static_cast<double>(grid.shortestEdge(point));
    for (const auto& [a, b] : look.topology().apart())
    {
      const auto onA = footOn(p, a);
      const auto onB = footOn(p, b);
      if (onA && onB && (*onA - *onB).norm() < thinnestGap * size)
      {
        continue;
      }
      found.addBetween(p, onA, onB);
      for (const auto& on : {onA, onB})
      {
        if (on && (*on - p).norm() > 1.0)
        {
          found.add(*on + stepBeyond * size * (*on - p).normalized());
        }
      }
    }
  }

  /// Returns the point of a chart nearest to p; nullopt if the way there is not along the normal, as at boundary edges.
  std::optional<Vec3> footOn(const Vec3& p, Index chart) const
  {
    // Without this limit, more stays unresolved in most models of others, and the search takes longer.
    constexpr double acrossCosine = 0.99;
    const SurfaceModel& model = grid.model();
    NearestPlace best{p};
    Vec3 normal = Vec3::Zero();
    for (const Index leaf : look.leavesAbout())
    {
      for (const ModelItem piece : grid.octree().items(leaf, ModelItem::triangle))
      {
        if (model.charts[piece.index] != chart)
        {
          continue;
        }
        const Vec3 q =
            nearestOnTriangle(p, toVector(model.corner(piece.index, 0)), toVector(model.corner(piece.index, 1)),
                              toVector(model.corner(piece.index, 2)));
        if (best.offer(q))
        {
          normal = model.normal(piece.index).normalized();
        }
      }
    }
    const bool isFoot = std::abs(normal.dot(best.at - p)) >= acrossCosine * (best.at - p).norm();
    return isFoot ? best.place() : std::nullopt;
  }

  std::optional<Vec3> nearestOnCurve(const Vec3& p, const std::vector<Index>& ending) const
  {
    const SurfaceModel& model = grid.model();
    NearestPlace best{p};
    for (const Index leaf : look.leavesAbout())
    {
      for (const ModelItem piece : grid.octree().items(leaf, ModelItem::featureEdge))
      {
        const FeatureEdge& edge = model.featureEdges[piece.index];
        if (model.curves[edge.curve].ending == ending)
        {
          best.offer(nearestOnSegment(p, toVector(model.points[edge.a]), toVector(model.points[edge.b])));
        }
      }
    }
    return best.place();
  }

  const MovingGrid& grid;
  Index point;
  bool across;
  MovingGrid::Look& look;
  /// The leaves at the point, in order.
  std::vector<Index> about;
  CandidatePlaces found;
};

} // namespace

std::int64_t farthestReach(const MovingGrid& grid, Index point)
{
  constexpr double farthestMove = 0.95;
  return static_cast<std::int64_t>(farthestMove * static_cast<double>(grid.shortestEdge(point)));
}

std::vector<LatticePoint> candidatePlaces(const MovingGrid& grid, Index point, MovingGrid::Look& look, bool across)
{
  return Candidates(grid, point, across, look).places();
}

} // namespace atria
