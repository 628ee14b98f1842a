// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/GapPlanes.h"

#include "Support/Angles.h"
#include "Support/Sorting.h"
#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace atria {

namespace {

constexpr double rounding = 1e-6;
/// A point in a gap stays where it is if it is farther than this part of the gap's width from both sheets.
constexpr double thinnestClearance = 0.1;

/// Most pairs of sheets side by side in a leaf: as many as four sheets have. The octants there have no planes of points
/// for more.
constexpr std::size_t mostPairs = 6;

/// Least cosine between the normal of a sheet in the stack of a gap and the way across the gap.
const double stackCosine = cosOfDegrees(35.01);

/// Finds places in gaps for the corners of leaves. Not for several threads at once.
class GapPlaceFinder
{
public:
  /// A place for a point, and how far away it is.
  struct Place
  {
    Index point;
    double step;
    LatticePoint at;
  };

  GapPlaceFinder(const MovingGrid& moving, double reachRatio, std::vector<Place>& found)
      : grid(moving), reach(reachRatio), look(moving), out(found)
  {
  }

  void find(Index leaf)
  {
    grid.surplus(leaf, look);
    const auto pairs = sheetsSideBySide();
    if (pairs.size() > mostPairs)
    {
      return;
    }
    const auto besideSides = sheetsBesideSides(leaf);
    std::vector<Index> points;
    std::ranges::copy_if(grid.points().atCorner[leaf], std::back_inserter(points), [&](Index point) {
      return point != noIndex && !grid.places().isDisplaced(point) && !grid.isFixed(point);
    });
    if (points.empty() || (pairs.empty() && besideSides.empty()))
    {
      return;
    }
    gatherTriangles(leaf);
    for (const Index point : points)
    {
      noteGaps(point, pairs);
      for (const auto& [chart, direction] : besideSides)
      {
        noteSideGap(point, chart, direction);
      }
    }
  }

private:
  /// The point of a chart nearest to a grid point, and the triangle it is on.
  struct Nearest
  {
    Vec3 at;
    Index triangle;
  };

  const SurfaceModel& model() const { return grid.model(); }

  /// Returns pairs of charts that do not meet in the leaf of `look`, or follow each other on one of its edges.
  std::vector<std::pair<Index, Index>> sheetsSideBySide() const
  {
    std::vector<std::pair<Index, Index>> pairs = look.topology().apart();
    for (const CutEdge& edge : look.cutEdges())
    {
      for (std::size_t i = 1; i < edge.cuts.size(); ++i)
      {
        pairs.push_back(std::minmax(model().charts[edge.cuts[i - 1].triangle], model().charts[edge.cuts[i].triangle]));
      }
    }
    sortUnique(pairs);
    return pairs;
  }

  /// Gathers the triangles in the leaves around the leaf's corners, sorted by chart.
  void gatherTriangles(Index leaf)
  {
    leaves.clear();
    for (const Index point : grid.points().atCorner[leaf])
    {
      if (point != noIndex)
      {
        leaves.insert(leaves.end(), grid.points().leaves[point].begin(), grid.points().leaves[point].end());
      }
    }
    sortUnique(leaves);
    near.clear();
    for (const Index one : leaves)
    {
      for (const ModelItem piece : grid.octree().items(one, ModelItem::triangle))
      {
        near.push_back(piece.index);
      }
    }
    sortUnique(near);
    triangles.clear();
    for (const Index triangle : near)
    {
      triangles.emplace_back(model().charts[triangle], triangle);
    }
    std::ranges::sort(triangles);
    boxes.clear();
    for (const auto& [chart, triangle] : triangles)
    {
      boxes.push_back(model().bounds(triangle));
    }
  }

  /// Returns the point of a chart nearest to p; the first of equally near triangles wins. The triangle of the nearest
  /// box goes first, as it rules out most.
  std::optional<Nearest> nearestOn(Index chart, const Vec3& p) const
  {
    const auto first = std::ranges::lower_bound(triangles, std::pair(chart, Index{0}));
    const auto begin = static_cast<std::size_t>(first - triangles.begin());
    reaches.clear();
    for (auto entry = first; entry != triangles.end() && entry->first == chart; ++entry)
    {
      reaches.push_back(boxes[begin + reaches.size()].squaredDistance(p));
    }
    if (reaches.empty())
    {
      return std::nullopt;
    }
    std::pair best(std::numeric_limits<double>::infinity(), std::size_t{0}); // squared distance, triangle
    Vec3 at = p;
    const auto offer = [&](std::size_t i) {
      const Index t = triangles[begin + i].second;
      const Vec3 q = nearestOnTriangle(p, toVector(model().corner(t, 0)), toVector(model().corner(t, 1)),
                                       toVector(model().corner(t, 2)));
      if (const std::pair found((q - p).squaredNorm(), i); found < best)
      {
        best = found;
        at = q;
      }
    };
    const auto nearest = static_cast<std::size_t>(std::ranges::min_element(reaches) - reaches.begin());
    offer(nearest);
    for (std::size_t i = 0; i < reaches.size(); ++i)
    {
      if (i != nearest && std::pair(reaches[i], i) < best)
      {
        offer(i);
      }
    }
    return Nearest{at, triangles[begin + best.second].second};
  }

  /// Returns the point nearest to p on each chart, with the chart.
  std::vector<std::pair<Index, Nearest>> nearestOnAll(const Vec3& p) const
  {
    std::vector<std::pair<Index, Nearest>> found;
    for (auto entry = triangles.begin(); entry != triangles.end();)
    {
      const Index chart = entry->first;
      found.emplace_back(chart, *nearestOn(chart, p));
      entry = std::find_if(entry, triangles.end(), [&](const auto& other) { return other.first != chart; });
    }
    return found;
  }

  /// Two sheets, the ends of a way across the gap between them, and its direction. A domain side has no chart.
  struct Gap
  {
    Vec3 onA;
    Vec3 onB;
    Index a;
    Index b;
    Vec3 normal;
  };

  /// Returns the gap between two sheets near p; nullopt if they do not run side by side. The way leads from the point
  /// of one sheet nearest to p to the other one and back. If one sheet ends, the way starts on it, as the other one's
  /// point nearest to p lies beyond the gap. In a wedge the normal is that of the plane in its middle.
  std::optional<Gap> gapNear(const Vec3& p, Index a, Index b) const
  {
    const auto onA = nearestOn(a, p);
    const auto onB = nearestOn(b, p);
    if (!onA || !onB)
    {
      return std::nullopt;
    }
    const Nearest acrossA = *nearestOn(b, onA->at);
    const Nearest acrossB = *nearestOn(a, onB->at);
    const bool fromA = (acrossA.at - onA->at).squaredNorm() <= (acrossB.at - onB->at).squaredNorm();
    const Nearest lastA = fromA ? *nearestOn(a, acrossA.at) : acrossB;
    const Nearest lastB = fromA ? acrossA : *nearestOn(b, acrossB.at);
    const Vec3 back = (lastB.at - lastA.at).normalized();
    const Vec3 there = fromA ? (acrossA.at - onA->at).normalized() : (onB->at - acrossB.at).normalized();
    if (std::min(cosineTo(lastA, back), cosineTo(lastB, back)) < alongCosine)
    {
      return std::nullopt;
    }
    return Gap{lastA.at, lastB.at, a, b, (back + there).normalized()};
  }

  void noteGaps(Index point, const std::vector<std::pair<Index, Index>>& pairs)
  {
    const Vec3 p = toVector(grid.places().place(point));
    for (const auto& [a, b] : pairs)
    {
      if (const auto gap = gapNear(p, a, b))
      {
        noteStack(point, *gap);
      }
    }
  }

  /// Returns charts that cut edges out of the domain at the leaf's corners, and the directions of these edges.
  std::vector<std::pair<Index, int>> sheetsBesideSides(Index leaf) const
  {
    std::vector<std::pair<Index, int>> sheets;
    for (const Index point : grid.points().atCorner[leaf])
    {
      for (int direction = 0; point != noIndex && direction < 6; ++direction)
      {
        const GridPlaces::Edge edge = grid.places().edge(point, direction);
        if (!edge.exists() || edge.other != noIndex)
        {
          continue;
        }
        if (const auto cut = grid.cutEdge(point, direction); cut && !cut->cuts.empty())
        {
          sheets.emplace_back(model().charts[cut->cuts.back().triangle], direction);
        }
      }
    }
    sortUnique(sheets);
    return sheets;
  }

  /// Notes the place of a point between a sheet and the domain side beyond it.
  void noteSideGap(Index point, Index chart, int direction)
  {
    const GridPlaces::Edge edge = grid.places().edge(point, direction);
    const auto sheet = nearestOn(chart, toVector(grid.places().place(point)));
    if (edge.exists() && edge.other == noIndex && sheet)
    {
      const LatticePoint end = grid.places().segment(point, direction, edge).end;
      Vec3 onSide = sheet->at;
      onSide[axisOf(direction)] = static_cast<double>(end[axisOf(direction)]);
      noteStack(point, {sheet->at, onSide, chart, noIndex, (onSide - sheet->at).normalized()});
    }
  }

  double cosineTo(const Nearest& sheet, const Vec3& direction) const
  {
    return std::abs(model().normal(sheet.triangle).normalized().dot(direction));
  }

  /// Position of a sheet in a stack, counted from the unresolved point along the normal.
  struct Level
  {
    double at;
    Index chart;
    bool operator<(const Level& other) const { return std::tie(at, chart) < std::tie(other.at, other.chart); }
  };

  /// The sheets of a gap, and those that run along it beside it; sorted. `toA` and `toB` are the positions of the gap's
  /// own two.
  struct Stack
  {
    double toA;
    double toB;
    std::vector<Level> levels;
  };

  /// Returns the stack of a gap. The position of a sheet is where the normal through p meets the plane of its nearest
  /// triangle, so that sheets that continue each other have one level.
  Stack stack(const Vec3& p, const Gap& gap, double size) const
  {
    const Vec3& normal = gap.normal;
    Stack found{normal.dot(gap.onA - p), normal.dot(gap.onB - p), {}};
    const Vec3 inGap = p + normal * 0.5 * (found.toA + found.toB);
    for (const auto& [chart, sheet] : nearestOnAll(inGap))
    {
      const double beside = (sheet.at - inGap - normal.dot(sheet.at - inGap) * normal).norm();
      if (beside < size && cosineTo(sheet, normal) > stackCosine)
      {
        const Vec3 facing = model().normal(sheet.triangle);
        const double at = facing.dot(sheet.at - p) / facing.dot(normal);
        found.toA = chart == gap.a ? at : found.toA;
        found.toB = chart == gap.b ? at : found.toB;
        found.levels.push_back({at, chart});
      }
    }
    std::erase_if(found.levels, [&](const Level& level) { return level.chart == gap.a || level.chart == gap.b; });
    found.levels.insert(found.levels.end(), {{found.toA, gap.a}, {found.toB, gap.b}});
    std::sort(found.levels.begin(), found.levels.end());
    found.levels.erase(std::unique(found.levels.begin(), found.levels.end(),
                                   [&](const Level& l, const Level& r) { return r.at - l.at < thinnestGap * size; }),
                       found.levels.end());
    return found;
  }

  /// Notes the place of a point in the gap between two sheets, or in one beside it. Beyond the line in which they meet
  /// there is none.
  void noteStack(Index point, const Gap& gap)
  {
    const auto size = static_cast<double>(grid.shortestEdge(point));
    if ((gap.onA - gap.onB).norm() < thinnestGap * size)
    {
      return;
    }
    const Vec3& normal = gap.normal;
    const double thickness = size * normal.lpNorm<1>();
    const Vec3 p = toVector(grid.places().place(point));
    const auto [toA, toB, levels] = stack(p, gap, size);
    if (toB - toA < thinnestGap * size)
    {
      return;
    }
    // Extends the run of gaps by those that are narrower than a plane of points is thick.
    auto low = std::upper_bound(levels.begin(), levels.end(), Level{toA, noIndex}) - 1;
    auto high = low + 1;
    while (low != levels.begin() && low->at - (low - 1)->at < thickness)
    {
      --low;
    }
    while (high + 1 != levels.end() && (high + 1)->at - high->at < thickness)
    {
      ++high;
    }
    const auto gaps = static_cast<int>(high - low);
    double middle = 0.0;
    for (auto sheet = low; sheet != high; ++sheet)
    {
      middle += 0.5 * (sheet->at + (sheet + 1)->at) / gaps;
    }
    // Rounding is half-open, so that one of two planes of points at the same distance is taken.
    const int plane = static_cast<int>(std::ceil(0.5 * gaps - middle / thickness - rounding)) - 1;
    if (plane < 0 || plane >= gaps)
    {
      if (reach > 0.5 && toA * toB > 0.0 && std::abs(toA + toB) < 2.0 * reach * thickness)
      {
        note(point, middleBetween(p, 0.5 * (toA + toB), normal, gap.a, gap.b), normal);
      }
      return;
    }
    const Level& before = *(low + plane);
    const Level& after = *(low + plane + 1);
    // A point on a sheet is on either side of it.
    const double inside = thinnestClearance * (after.at - before.at);
    if (before.at > -inside || after.at < inside)
    {
      note(point, middleBetween(p, 0.5 * (before.at + after.at), normal, before.chart, after.chart), normal);
    }
  }

  /// Returns how far along the normal the middle between two sheets is, near a first guess.
  double middleBetween(const Vec3& p, double guess, const Vec3& normal, Index a, Index b) const
  {
    constexpr int turns = 3;
    double step = guess;
    for (int i = 0; i < turns && a != noIndex && b != noIndex; ++i)
    {
      const Vec3 q = p + step * normal;
      step += 0.5 * normal.dot(nearestOn(a, q)->at + nearestOn(b, q)->at - 2.0 * q);
    }
    return step;
  }

  void note(Index point, double step, const Vec3& normal)
  {
    const auto way = wayAlong(normal, step, static_cast<double>(grid.shortestEdge(point)));
    if (!way)
    {
      return;
    }
    const Vec3 q = toVector(grid.places().place(point)) + *way;
    const LatticePoint at{std::llround(q[0]), std::llround(q[1]), std::llround(q[2])};
    // A point that is there already would be moved again and again.
    if (isInDomain(at) && at != grid.places().place(point))
    {
      out.push_back({point, std::abs(step), at});
    }
  }

  /// Returns the way nearest to the normal that leads `step` along it and has no component above `size`, that of the
  /// octants around the point, as only these are searched for cuts of its edges. Returns nullopt if there is none.
  static std::optional<Vec3> wayAlong(const Vec3& normal, double step, double size)
  {
    const double even = std::abs(step) / normal.lpNorm<1>();
    if (even > size)
    {
      return std::nullopt;
    }
    const double most = std::abs(step) * normal.lpNorm<Eigen::Infinity>();
    const double part = most > size ? (most - size) / (most - even) : 0.0;
    const Vec3 diagonal = step / normal.lpNorm<1>() * normal.cwiseSign();
    return (1.0 - part) * step * normal + part * diagonal;
  }

  bool isInDomain(const LatticePoint& p) const
  {
    const GridFrame& frame = grid.octree().frame();
    return frame.turnedDomain || std::ranges::all_of(std::array{0, 1, 2}, [&](int axis) {
             return p[axis] > frame.domainLow[axis] && p[axis] < frame.domainHigh[axis];
           });
  }

  const MovingGrid& grid;
  double reach;
  MovingGrid::Look look;
  std::vector<Place>& out;
  /// Leaves around the leaf, and what is in them: charts and triangles, and the triangles' bounds.
  std::vector<Index> leaves;
  std::vector<Index> near;
  std::vector<std::pair<Index, Index>> triangles;
  std::vector<Box3> boxes;
  mutable std::vector<double> reaches; ///< squared distances of a chart's boxes
};

/// Moves corners of these leaves into gaps. Returns the leaves around the moved points, sorted; nothing changed
/// elsewhere.
std::vector<Index> enterFrom(const std::vector<Index>& leaves, MovingGrid& grid, double reach,
                             const RunContext& context)
{
  constexpr std::size_t grain = 8;
  std::vector<std::vector<GapPlaceFinder::Place>> found((leaves.size() + grain - 1) / grain);
  context.executor.forEach(found.size(), 1, [&](std::size_t part) {
    GapPlaceFinder finder(grid, reach, found[part]);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, leaves.size()); ++i)
    {
      finder.find(leaves[i]);
    }
  });
  // Keeps the nearest place of each point; among equal ones, the one found at the first leaf.
  std::map<Index, GapPlaceFinder::Place> nearest;
  for (const std::vector<GapPlaceFinder::Place>& part : found)
  {
    for (const GapPlaceFinder::Place& place : part)
    {
      const auto [known, isNew] = nearest.try_emplace(place.point, place);
      if (!isNew && place.step < known->second.step)
      {
        known->second = place;
      }
    }
  }
  MovingGrid::PointPlaces moves;
  std::vector<Index> about;
  for (const auto& [point, place] : nearest)
  {
    moves.emplace_back(point, place.at);
    about.insert(about.end(), grid.points().leaves[point].begin(), grid.points().leaves[point].end());
  }
  grid.moveAll(moves, context);
  sortUnique(about);
  return about;
}

} // namespace

void enterGaps(MovingGrid& grid, const RunContext& context)
{
  for (const double reach : {0.5, 1.0})
  {
    // The loop ends, as points enter gaps once.
    for (std::vector<Index> leaves = grid.unresolvedLeaves(context); !leaves.empty();)
    {
      context.progress.check();
      const std::vector<Index> about = enterFrom(leaves, grid, reach, context);
      const std::vector<Index>& unresolved = grid.unresolvedLeaves(context);
      leaves.clear();
      std::ranges::set_intersection(about, unresolved, std::back_inserter(leaves));
    }
  }
}

} // namespace atria
