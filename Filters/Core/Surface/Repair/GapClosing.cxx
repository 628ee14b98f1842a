// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/GapClosing.h"

#include "Support/Angles.h"
#include "Support/Sorting.h"
#include "Surface/Repair/Clusters.h"
#include "Surface/Search/BoxTree.h"
#include "Surface/Search/Distance.h"
#include "Surface/Triangles/BoundaryEdges.h"
#include "Surface/Triangles/SoupParts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_set>

namespace atria {

namespace {

/// A point or edge is preferred to the face up to this many times its distance. If any in reach were preferred, the
/// contacts left would grow by a third in one model, and by nine tenths in another.
constexpr double sideways = 2.0;
/// Details within this many tolerances are connected and are no gap.
constexpr double detailReach = 3.0;
/// Points of parts drawn with edges shorter than this many tolerances stay, as the parts could fold.
constexpr double finestEdge = 2.0;

/// Makes one pass over a soup.
class GapCloser
{
public:
  GapCloser(TriangleSoup& soup_, const GridFrame& frame_, const GapOptions& options, const RunContext& runContext)
      : soup(soup_), frame(frame_), tolerance(options.tolerance), parts(options.drawn.parts),
        clusters(options.clusters), context(runContext), fans(trianglesAtPoints(soup)),
        boundary(soup.triangles, soup.points.size(), context.executor), fixed(soup.points.size(), 0),
        partOf(soup.points.size(), noIndex), hasSeveralParts(soup.points.size(), 0), isFine(soup.points.size(), 0)
  {
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      for (const Index p : soup.triangles[t])
      {
        const Index part = partOfTriangle(t);
        hasSeveralParts[p] |= partOf[p] != noIndex && partOf[p] != part;
        partOf[p] = std::min(partOf[p], part);
        isFine[p] |= options.drawn.shortestEdges[soup.sources[t]] < finestEdge * tolerance ? 1 : 0;
      }
    }
  }

  /// Returns the points that were moved.
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
  /// A point and the triangle it could be moved onto; sorts by the order of moves.
  struct Gap
  {
    bool toLighter;
    int kind; ///< 0 onto a point, 1 onto an edge, 2 onto the face
    double distance;
    Index point;
    Index triangle;
    bool operator<(const Gap& o) const
    {
      return std::tie(toLighter, kind, distance, point, triangle) <
             std::tie(o.toLighter, o.kind, o.distance, o.point, o.triangle);
    }
  };

  struct Target
  {
    int kind;
    double distance;
    LatticePoint place;
  };

  bool used(Index p) const { return !fans.of(p).empty(); }
  Index partOfTriangle(Index t) const { return parts[soup.sources[t]]; }
  /// True if no triangle at the point belongs to the triangle's part. Thousands of them may meet in a point.
  bool isForeign(Index p, Index t) const
  {
    const Index part = partOfTriangle(t);
    const auto around = fans.of(p);
    return partOf[p] != part && (!hasSeveralParts[p] || std::none_of(around.begin(), around.end(), [&](Index other) {
             return partOfTriangle(other) == part;
           }));
  }
  bool isOnBoundary(Index p) const { return !boundary.at(p).empty(); }

  /// Result of a search among some of the points.
  struct Found
  {
    std::vector<Gap> gaps;
    std::vector<Gap> foreignGaps;
    /// Points with the parts they lie on without having a corner there.
    std::vector<std::pair<Index, Index>> touches;
    /// The last point for which connected triangles were searched, and these triangles.
    Index hangingAt = noIndex;
    std::vector<Index> hanging;
  };

  void findPairs()
  {
    const std::vector<Index> places = movablePoints();
    if (places.empty())
    {
      return;
    }
    constexpr std::size_t grain = 1024;
    const auto margin = static_cast<std::int64_t>(std::ceil(tolerance));
    const BoxTree tree(boxesOf(soup, seenTriangles(soup, clusters, context), margin, context), context);
    std::vector<Found> searches((places.size() + grain - 1) / grain);
    std::atomic<std::size_t> pairs{0};
    context.executor.forEach(searches.size(), 1, [&](std::size_t part) {
      context.progress.check();
      for (std::size_t i = part * grain; i < std::min((part + 1) * grain, places.size()); ++i)
      {
        const Index p = places[i];
        std::size_t touching = 0;
        tree.eachTouching({soup.points[p], soup.points[p]}, 0, [&](std::size_t place) {
          const Index t = tree.box(place).id;
          if (isOnBoundary(p) || isForeign(p, t))
          {
            ++touching;
            consider(p, t, searches[part]);
          }
        });
        checkPairs(pairs += touching);
      }
    });
    Found all;
    for (const Found& part : searches)
    {
      gaps.insert(gaps.end(), part.gaps.begin(), part.gaps.end());
      all.foreignGaps.insert(all.foreignGaps.end(), part.foreignGaps.begin(), part.foreignGaps.end());
      all.touches.insert(all.touches.end(), part.touches.begin(), part.touches.end());
    }
    addForeignGaps(all);
  }

  /// Returns the points at boundary edges, or all points if there are several parts. Points of too fine parts or in
  /// clusters are left out.
  std::vector<Index> movablePoints() const
  {
    const Index first = soup.triangles.empty() ? noIndex : partOfTriangle(0);
    bool several = false;
    for (Index t = 0; t < soup.triangles.size() && !several; ++t)
    {
      several = partOfTriangle(t) != first;
    }
    std::vector<Index> points;
    for (Index p = 0; p < soup.points.size(); ++p)
    {
      if (used(p) && (several || isOnBoundary(p)) && !isFine[p] && !clusters.hold(soup.points[p]))
      {
        points.push_back(p);
      }
    }
    return points;
  }

  void consider(Index p, Index t, Found& found) const
  {
    if (contains(soup.triangles[t], p))
    {
      return;
    }
    if (offsetTo(p, t).norm() <= latticeRounding)
    {
      found.touches.emplace_back(p, partOfTriangle(t));
      return;
    }
    const std::optional<Target> target = targetOf(p, t);
    if (!target)
    {
      return;
    }
    const bool foreign = isForeign(p, t);
    if (leadsOn(p, between(soup.points[p], target->place)) || (isOnBoundary(p) && !isConnected(p, t, found)))
    {
      found.gaps.push_back({!(foreign && partOf[p] < partOfTriangle(t)), target->kind, target->distance, p, t});
    }
    else if (foreign)
    {
      found.foreignGaps.push_back({partOf[p] > partOfTriangle(t), target->kind, target->distance, p, t});
    }
  }

  /// Adds the gaps to other parts. A point that touches the other part already needs no move, unless it is at a
  /// boundary edge.
  void addForeignGaps(Found& found)
  {
    std::sort(found.touches.begin(), found.touches.end());
    std::copy_if(found.foreignGaps.begin(), found.foreignGaps.end(), std::back_inserter(gaps), [&](const Gap& gap) {
      return !std::binary_search(found.touches.begin(), found.touches.end(),
                                 std::pair(gap.point, partOfTriangle(gap.triangle)));
    });
  }

  bool isBoundaryEdge(Index p, Index q) const
  {
    const auto leadsThere = [&](const BoundaryEdges::End& end) {
      return boundary.edges()[end.edge].end(1 - end.which) == q;
    };
    return std::ranges::any_of(boundary.at(p), leadsThere, BoundaryEdges::endOf);
  }

  /// True if a sheet that ends at the point would go on in this direction.
  bool leadsOn(Index p, const Vec3& offset) const
  {
    const auto isOut = [&](const BoundaryEdges::End& end) {
      return isAhead(outwardOf(boundary.edges()[end.edge], soup.points), offset);
    };
    return std::ranges::any_of(boundary.at(p), isOut, BoundaryEdges::endOf);
  }

  std::array<Vec3, 3> cornersFrom(Index p, Index t) const
  {
    return {between(soup.points[p], soup.corner(t, 0)), between(soup.points[p], soup.corner(t, 1)),
            between(soup.points[p], soup.corner(t, 2))};
  }
  /// Returns the offset from the point to the nearest point of the triangle.
  Vec3 offsetTo(Index p, Index t) const
  {
    const auto [a, b, c] = cornersFrom(p, t);
    return nearestOnTriangle(Vec3::Zero(), a, b, c);
  }

  /// Returns the place on the triangle where the point belongs; nullopt if it is too far away or there already.
  std::optional<Target> targetOf(Index p, Index t) const
  {
    const Vec3 origin = Vec3::Zero();
    const std::array<Vec3, 3> corners = cornersFrom(p, t);
    const Vec3 nearest = offsetTo(p, t);
    if (nearest.norm() > tolerance || nearest.norm() <= latticeRounding)
    {
      return std::nullopt;
    }
    std::optional<Target> best;
    const auto offer = [&](int kind, const Vec3& place) {
      const bool better = !best || (kind == best->kind && place.norm() < best->distance);
      if (place.norm() <= std::min(tolerance, sideways * nearest.norm()) && better)
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

  /// Returns the triangles that can be reached from the point along edges that stay close to it, in order.
  std::vector<Index> hangingTogether(Index p) const
  {
    const double reachSquared = detailReach * detailReach * tolerance * tolerance;
    std::unordered_set<Index> seen{p};
    std::vector<Index> triangles;
    for (std::vector<Index> open{p}; !open.empty();)
    {
      const auto around = fans.of(open.back());
      open.pop_back();
      for (const Index t : around)
      {
        triangles.push_back(t);
        for (const Index q : soup.triangles[t])
        {
          if (seen.insert(q).second && between(soup.points[p], soup.points[q]).squaredNorm() <= reachSquared)
          {
            open.push_back(q);
          }
        }
      }
    }
    sortUnique(triangles);
    return triangles;
  }

  bool isConnected(Index p, Index t, Found& found) const
  {
    if (found.hangingAt != p)
    {
      found.hangingAt = p;
      found.hanging = hangingTogether(p);
    }
    return std::binary_search(found.hanging.begin(), found.hanging.end(), t);
  }

  bool close(const Gap& gap)
  {
    // Earlier moves may have changed the place.
    const std::optional<Target> target = targetOf(gap.point, gap.triangle);
    if (!target)
    {
      return false;
    }
    const std::optional<LatticePoint> place = keptOnSides(gap.point, *target);
    if (!place || !mayMove(gap.point, *place, gap.triangle))
    {
      return false;
    }
    soup.points[gap.point] = *place;
    fixed[gap.point] = 1;
    for (const Index corner : soup.triangles[gap.triangle])
    {
      fixed[corner] = 1;
    }
    return true;
  }

  /// Returns the place for a point that stays on its sides of the domain. The foot on a wall that is not quite upright
  /// is a little off the side: the point slides along its side instead. Returns nullopt if it would leave the side, or
  /// if it is at a corner of the domain and cannot slide.
  std::optional<LatticePoint> keptOnSides(Index p, const Target& target) const
  {
    const LatticePoint& from = soup.points[p];
    LatticePoint place = target.place;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (from[axis] != frame.domainLow[axis] && from[axis] != frame.domainHigh[axis])
      {
        continue;
      }
      if (static_cast<double>(std::abs(place[axis] - from[axis])) > alongCosine * target.distance)
      {
        return std::nullopt;
      }
      place[axis] = from[axis];
    }
    return place != from ? std::optional(place) : std::nullopt;
  }

  bool mayMove(Index p, const LatticePoint& to, Index onto) const
  {
    const auto around = fans.of(p);
    return std::all_of(around.begin(), around.end(), [&](Index t) { return keepsItsShape(t, p, to, onto); });
  }

  /// True if the move leaves a triangle in shape. It may turn over in its plane, as its neighbors then cover more. It
  /// may vanish in its own edge or point that the point moves onto.
  bool keepsItsShape(Index t, Index p, const LatticePoint& to, Index onto) const
  {
    const auto& corners = soup.triangles[t];
    const int i = corners[0] == p ? 0 : (corners[1] == p ? 1 : 2);
    const Index a = corners[(i + 1) % 3];
    const Index b = corners[(i + 2) % 3];
    const Vec3 before = between(soup.points[p], soup.points[a]).cross(between(soup.points[p], soup.points[b]));
    const Vec3 after = between(to, soup.points[a]).cross(between(to, soup.points[b]));
    const bool hasA = contains(soup.triangles[onto], a);
    const bool hasB = contains(soup.triangles[onto], b);
    if (after.norm() <= latticeRounding * between(soup.points[a], soup.points[b]).norm())
    {
      return (hasA && hasB) || (hasA && to == soup.points[a]) || (hasB && to == soup.points[b]) ||
             !(isBoundaryEdge(p, a) || isBoundaryEdge(p, b) || isBoundaryEdge(a, b));
    }
    // If turned farther, the triangle would fold.
    return std::abs(after.dot(before)) >= alongCosine * after.norm() * before.norm();
  }

  TriangleSoup& soup;
  const GridFrame& frame;
  double tolerance;
  const std::vector<Index>& parts;
  const ClusterCells& clusters;
  const RunContext& context;
  Buckets fans; ///< triangles at each point
  BoundaryEdges boundary;
  std::vector<char> fixed;
  /// Per point, the smallest of the parts it belongs to.
  std::vector<Index> partOf;
  std::vector<char> hasSeveralParts;
  /// One flag per point: nonzero if it belongs to a part finer than the tolerance.
  std::vector<char> isFine;
  std::vector<Gap> gaps;
};

} // namespace

SoupAsDrawn::SoupAsDrawn(const TriangleSoup& soup)
    : parts(partsOf(soup)), shortestEdges(parts.size(), std::numeric_limits<double>::infinity())
{
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      double& shortest = shortestEdges[soup.sources[t]];
      shortest = std::min(shortest, between(soup.corner(t, i), soup.corner(t, (i + 1) % 3)).norm());
    }
  }
}

std::vector<char> closeGaps(TriangleSoup& soup, const GridFrame& frame, const GapOptions& options,
                            const RunContext& context)
{
  std::vector<char> isMoved(soup.points.size(), 0);
  if (options.tolerance >= 1.0)
  {
    const auto margin = static_cast<std::int64_t>(std::ceil(options.tolerance));
    const std::vector<Index> moved = searchSeen(soup, margin, options.clusters, context,
                                                [&] { return GapCloser(soup, frame, options, context).run(); });
    for (const Index p : moved)
    {
      isMoved[p] = 1;
    }
  }
  return isMoved;
}

} // namespace atria
