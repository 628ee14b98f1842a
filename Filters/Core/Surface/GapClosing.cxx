// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/GapClosing.h"

#include "Support/UnionFind.h"
#include "Surface/BoxPairs.h"
#include "Surface/Distance.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

namespace atria {

namespace {

constexpr int maximumPasses = 4;
/// Details within this many tolerances hang together and are no gap.
constexpr double detailReach = 3.0;
/// A point may move by this much in all, in tolerances.
constexpr double maximumDrift = 2.0;
/// Below this cosine a move turns a triangle too far.
constexpr double minimumCosine = 0.5;

/// Triangles at each point.
class Fans
{
public:
  explicit Fans(const TriangleSoup& soup) : offsets(soup.points.size() + 1, 0)
  {
    for (const auto& t : soup.triangles)
    {
      for (const Index p : t)
      {
        ++offsets[p + 1];
      }
    }
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    triangles.resize(offsets.back());
    std::vector<Index> next(offsets.begin(), offsets.end() - 1);
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      for (const Index p : soup.triangles[t])
      {
        triangles[next[p]++] = t;
      }
    }
  }

  std::span<const Index> at(Index p) const { return {triangles.data() + offsets[p], offsets[p + 1] - offsets[p]}; }

private:
  std::vector<Index> offsets;
  std::vector<Index> triangles;
};

/// The parts that hang together: for each point its part's lowest point, and the greatest face of each part's box.
struct Parts
{
  std::vector<Index> of;
  std::vector<double> size;

  explicit Parts(const TriangleSoup& soup) : of(soup.points.size()), size(soup.points.size(), 0.0)
  {
    UnionFind sets(soup.points.size());
    for (const auto& t : soup.triangles)
    {
      sets.join(t[0], t[1]);
      sets.join(t[0], t[2]);
    }
    std::vector<Box3> boxes(soup.points.size());
    for (Index p = 0; p < soup.points.size(); ++p)
    {
      of[p] = sets.find(p);
      boxes[of[p]].extend(toVector(soup.points[p]));
    }
    for (Index p = 0; p < soup.points.size(); ++p)
    {
      const Vec3 length = boxes[p].size();
      size[p] = of[p] == p ? std::max({length[0] * length[1], length[1] * length[2], length[2] * length[0]}) : 0.0;
    }
  }

  bool lighter(Index a, Index b) const { return std::tuple(size[of[a]], ~of[a]) < std::tuple(size[of[b]], ~of[b]); }
};

/// One pass over a soup.
class GapCloser
{
public:
  GapCloser(TriangleSoup& soup_, const GridFrame& frame_, double tolerance_, const std::vector<LatticePoint>& start_)
      : soup(soup_), frame(frame_), tolerance(tolerance_), start(start_), fans(soup), parts(soup),
        onRim(soup.points.size(), 0), fixed(soup.points.size(), 0)
  {
    const std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup);
    for (std::size_t i = 0; i < uses.size(); ++i)
    {
      const bool alone =
          (i == 0 || uses[i - 1].edge != uses[i].edge) && (i + 1 == uses.size() || uses[i + 1].edge != uses[i].edge);
      if (alone)
      {
        onRim[uses[i].edge.first] = onRim[uses[i].edge.second] = 1;
      }
    }
  }

  /// Points that were moved.
  std::vector<Index> run()
  {
    findPairs();
    std::sort(gaps.begin(), gaps.end());
    std::vector<Index> moved;
    for (const Gap& gap : gaps)
    {
      if (!fixed[gap.point] && close(gap))
      {
        moved.push_back(gap.point);
      }
    }
    return moved;
  }

private:
  /// A point and the triangle it could be moved onto; sorted by what is to be done first.
  struct Gap
  {
    bool toLighter;
    int kind; ///< 0 onto a point, 1 onto an edge, 2 onto the face
    double distance;
    Index point;
    Index triangle;
    friend auto operator<=>(const Gap&, const Gap&) = default;
  };

  struct Target
  {
    int kind;
    double distance;
    LatticePoint place;
  };

  bool used(Index p) const { return !fans.at(p).empty(); }

  void findPairs()
  {
    const auto margin = static_cast<std::int64_t>(std::ceil(tolerance));
    std::vector<LatticeBox> boxes;
    std::vector<LatticeBox> places;
    const auto base = static_cast<Index>(soup.triangles.size());
    for (Index t = 0; t < base; ++t)
    {
      boxes.push_back(boxOf(soup, t, margin));
    }
    for (Index p = 0; p < soup.points.size(); ++p)
    {
      if (used(p))
      {
        places.push_back({soup.points[p], soup.points[p], base + p});
      }
    }
    forBoxPairs(places, boxes, [&](Index place, Index t) { consider(place - base, t); });
  }

  void consider(Index p, Index t)
  {
    const auto& corners = soup.triangles[t];
    const bool foreign = parts.of[p] != parts.of[corners[0]];
    if (contains(corners, p) || (!foreign && !onRim[p]))
    {
      return;
    }
    const bool toLighter = !(foreign && parts.lighter(p, corners[0]));
    const std::optional<Target> target = targetOf(p, t);
    if (target && (foreign || !hangsTogether(p, t)))
    {
      gaps.push_back({toLighter, target->kind, target->distance, p, t});
    }
  }

  /// Where on the triangle the point belongs; nothing where it is too far or there already.
  std::optional<Target> targetOf(Index p, Index t) const
  {
    const Vec3 origin = Vec3::Zero();
    std::array<Vec3, 3> corners;
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = between(soup.points[p], soup.corner(t, i));
    }
    const Vec3 nearest = nearestOnTriangle(origin, corners[0], corners[1], corners[2]);
    constexpr double there = 2.0; // rounded to the lattice it is there
    if (nearest.norm() > tolerance || nearest.norm() <= there)
    {
      return std::nullopt;
    }
    std::optional<Target> best;
    const auto offer = [&](int kind, const Vec3& place) {
      const bool better = !best || (kind == best->kind && place.norm() < best->distance);
      if (place.norm() <= tolerance && better)
      {
        best = Target{kind, place.norm(), placeOf(p, place)};
      }
    };
    for (const Vec3& corner : corners)
    {
      offer(0, corner);
    }
    for (int i = 0; i < 3; ++i)
    {
      offer(1, nearestOnSegment(origin, corners[i], corners[(i + 1) % 3]));
    }
    offer(2, nearest);
    return best;
  }

  LatticePoint placeOf(Index p, const Vec3& offset) const
  {
    LatticePoint place = soup.points[p];
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] += std::llround(offset[axis]);
    }
    return place;
  }

  /// Whether the triangle can be reached from the point along edges that stay close to it.
  bool hangsTogether(Index p, Index t) const
  {
    const double reach = detailReach * tolerance;
    std::vector<Index> open{p};
    const auto isClose = [&](Index q) { return between(soup.points[p], soup.points[q]).norm() <= reach; };
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      for (const Index around : fans.at(open[i]))
      {
        if (around == t)
        {
          return true;
        }
        for (const Index q : soup.triangles[around])
        {
          if (isClose(q) && std::find(open.begin(), open.end(), q) == open.end())
          {
            open.push_back(q);
          }
        }
      }
    }
    return false;
  }

  bool close(const Gap& gap)
  {
    // Earlier moves may have changed the place.
    const std::optional<Target> target = targetOf(gap.point, gap.triangle);
    if (!target)
    {
      return false;
    }
    const LatticePoint place = keptOnSides(gap.point, *target);
    if (!mayMove(gap.point, place))
    {
      return false;
    }
    soup.points[gap.point] = place;
    fixed[gap.point] = 1;
    for (const Index corner : soup.triangles[gap.triangle])
    {
      fixed[corner] = 1;
    }
    return true;
  }

  /// The foot on a wall that is not quite upright is a little off the side: the point slides along its side instead.
  LatticePoint keptOnSides(Index p, const Target& target) const
  {
    constexpr double slope = 0.1;
    const LatticePoint& from = soup.points[p];
    LatticePoint place = target.place;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool onSide = from[axis] == frame.domainLow[axis] || from[axis] == frame.domainHigh[axis];
      if (onSide && static_cast<double>(std::abs(place[axis] - from[axis])) <= slope * target.distance)
      {
        place[axis] = from[axis];
      }
    }
    return place;
  }

  bool mayMove(Index p, const LatticePoint& to) const
  {
    const LatticePoint& from = soup.points[p];
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool onSide = from[axis] == frame.domainLow[axis] || from[axis] == frame.domainHigh[axis];
      if (onSide && to[axis] != from[axis])
      {
        return false;
      }
    }
    const auto around = fans.at(p);
    return between(start[p], to).norm() <= maximumDrift * tolerance &&
           std::all_of(around.begin(), around.end(), [&](Index t) { return keepsItsShape(t, p, to); });
  }

  bool keepsItsShape(Index t, Index p, const LatticePoint& to) const
  {
    const auto& corners = soup.triangles[t];
    const int i = corners[0] == p ? 0 : (corners[1] == p ? 1 : 2);
    const LatticePoint& a = soup.points[corners[(i + 1) % 3]];
    const LatticePoint& b = soup.points[corners[(i + 2) % 3]];
    const Vec3 before = between(soup.points[p], a).cross(between(soup.points[p], b));
    const Vec3 after = between(to, a).cross(between(to, b));
    return to != a && to != b && after.norm() > 0.0 &&
           after.dot(before) >= minimumCosine * after.norm() * before.norm();
  }

  TriangleSoup& soup;
  const GridFrame& frame;
  double tolerance;
  const std::vector<LatticePoint>& start;
  Fans fans;
  Parts parts;
  std::vector<char> onRim;
  std::vector<char> fixed;
  std::vector<Gap> gaps;
};

} // namespace

GapReport closeGaps(TriangleSoup& soup, const GridFrame& frame, double tolerance)
{
  GapReport report;
  if (!(tolerance >= 1.0))
  {
    return report;
  }
  const std::vector<LatticePoint> start = soup.points;
  for (int pass = 0; pass < maximumPasses; ++pass)
  {
    if (GapCloser(soup, frame, tolerance, start).run().empty())
    {
      break;
    }
  }
  for (Index p = 0; p < soup.points.size(); ++p)
  {
    const double move = between(start[p], soup.points[p]).norm();
    report.closedGaps += move > 0.0 ? 1 : 0;
    report.largestMove = std::max(report.largestMove, move);
  }
  return report;
}

} // namespace atria
