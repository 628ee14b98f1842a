// SPDX-License-Identifier: GPL-3.0-or-later
#include "Audit/BodyAudit.h"

#include "Audit/ClippedTriangles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace atria {

namespace {

/// Number of sample lines for all overlaps together, and the least and greatest number along each axis of one overlap.
constexpr double samples = 50'000.0;
constexpr double fewestSamples = 4.0;
constexpr double mostSamples = 24.0;
/// The part of the directions, level and up, in which an open body is met from its middle.
constexpr double enclosing = 0.7;
/// The part of an open body's box that is left out of the mesh where its inside is.
constexpr double leastLeftOut = 0.25;

std::vector<Vec3> levelAndUp()
{
  std::vector<Vec3> directions{Vec3::UnitZ()};
  for (int i = 0; i < 8; ++i)
  {
    // The directions run neither along walls nor through the edges between them.
    const double angle = 0.1 + i * std::atan(1.0);
    directions.emplace_back(std::cos(angle), std::sin(angle), 0.013);
    directions.emplace_back(std::cos(angle), std::sin(angle), 1.02);
  }
  return directions;
}

bool isMet(const Vec3& from, const Vec3& direction, const std::array<Vec3, 3>& triangle)
{
  const Vec3 u = triangle[1] - triangle[0];
  const Vec3 v = triangle[2] - triangle[0];
  const Vec3 across = direction.cross(v);
  const double determinant = u.dot(across);
  if (determinant == 0.0)
  {
    return false;
  }
  const Vec3 to = from - triangle[0];
  const double alongU = to.dot(across) / determinant;
  const Vec3 other = to.cross(u);
  const double alongV = direction.dot(other) / determinant;
  return alongU >= 0.0 && alongV >= 0.0 && alongU + alongV <= 1.0 && (v.dot(other) > 0.0) == (determinant > 0.0);
}

bool isWithin(const Vec3& p, const Box3& box)
{
  return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
}

class BodyAuditor
{
public:
  BodyAuditor(const DrawnModel& drawnModel, const PlacedPrism& prism, const std::vector<ZoneSummary>& zoneSummaries,
              double finest)
      : drawn(drawnModel), bodies(drawnModel.bodies), domain(prism), region(prism, tolerance(prism)),
        above(spaceAbove(prism)), zones(zoneSummaries), sizeMin(finest)
  {
  }

  BodyAudit run()
  {
    out.isOnFlatGround = isOnFlatGround();
    measureClosed();
    measureOverlaps();
    findHollow();
    findOpen();
    return std::move(out);
  }

private:
  static double tolerance(const PlacedPrism& prism) { return 1e-9 * prism.bounds.size().maxCoeff(); }

  /// Returns the space above a domain, which shares no faces with it.
  static ConvexRegion spaceAbove(PlacedPrism prism)
  {
    prism.bounds.min[2] = prism.bounds.max[2] + 2.0 * tolerance(prism);
    prism.bounds.max[2] = std::numeric_limits<double>::max();
    return {prism, 0.0};
  }

  double bottom() const { return domain.bounds.min[2]; }
  double top() const { return domain.bounds.max[2]; }

  bool isOnFlatGround() const
  {
    for (std::size_t t = 0; t < drawn.surface.triangles.size(); ++t)
    {
      if (drawn.isGround[drawn.surface.surfaceIds[t]])
      {
        for (const Index p : drawn.surface.triangles[t])
        {
          if (drawn.surface.points[p][2] > bottom() + 0.5 * sizeMin)
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  bool isLarge(const DrawnBody& body) const
  {
    return !drawn.isGround[body.surface] && bodies.bounds(body).size().norm() >= sizeMin;
  }

  void measureClosed()
  {
    within.assign(bodies.bodies().size(), 0.0);
    for (std::size_t i = 0; i < within.size(); ++i)
    {
      if (const DrawnBody& body = bodies.bodies()[i]; isLarge(body))
      {
        within[i] = std::abs(volumeWithin(body));
        out.closed += within[i] > 0.0 ? 1 : 0;
        out.volume += within[i];
      }
    }
  }

  /// Returns the volume of a body in the domain, as an integral of heights above the bottom and up to the top.
  double volumeWithin(const DrawnBody& body) const
  {
    double volume = 0.0;
    for (const Index t : body.triangles)
    {
      std::array<Vec3, 3> at = bodies.corners(t);
      std::ranges::transform(at, at.begin(), [&](const Vec3& p) { return domain.axes.fromModel(p); });
      const auto& [a, b, c] = at;
      const Vec3 normal = (b - a).cross(c - a);
      if (const double length = normal.norm(); length > 0.0)
      {
        volume += normal[2] / length *
                  (region.within(a, b, c, bottom()).heightTimesArea +
                   above.within(a, b, c, bottom()).area * (top() - bottom()));
      }
    }
    return volume;
  }

  /// Two bodies, the larger one first, and a box along the model's axes around what they share in the domain.
  struct Pair
  {
    Index larger;
    Index smaller;
    Box3 box;
  };

  /// Numbers the bodies in the domain from the largest on. Others have no number.
  void rankBodies()
  {
    const std::vector<DrawnBody>& all = bodies.bodies();
    std::vector<Index> order;
    for (Index i = 0; i < within.size(); ++i)
    {
      if (within[i] > 0.0)
      {
        order.push_back(i);
      }
    }
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](Index i) { return std::abs(all[i].volume); });
    ranks.assign(all.size(), noIndex);
    for (Index rank = 0; rank < order.size(); ++rank)
    {
      ranks[order[rank]] = rank;
    }
  }

  /// Returns the pairs of bodies whose boxes meet within the domain.
  std::vector<Pair> pairs() const
  {
    std::vector<Index> order;
    for (Index i = 0; i < ranks.size(); ++i)
    {
      if (ranks[i] != noIndex)
      {
        order.push_back(i);
      }
    }
    const std::vector<DrawnBody>& all = bodies.bodies();
    std::ranges::stable_sort(order, {}, [&](Index i) { return all[i].bounds.low[0]; });
    const Box3 around = boundsAlong(Placement(), domain);
    std::vector<Pair> found;
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      const Box3 a = bodies.bounds(all[order[i]]);
      for (std::size_t k = i + 1; k < order.size() && all[order[k]].bounds.low[0] < all[order[i]].bounds.high[0]; ++k)
      {
        const Box3 b = bodies.bounds(all[order[k]]);
        const Box3 box{a.min.cwiseMax(b.min).cwiseMax(around.min), a.max.cwiseMin(b.max).cwiseMin(around.max)};
        if ((box.min.array() < box.max.array()).all())
        {
          const bool isLarger = ranks[order[i]] < ranks[order[k]];
          found.push_back({order[isLarger ? i : k], order[isLarger ? k : i], box});
        }
      }
    }
    return found;
  }

  /// Adds up what each body shares with the union of all larger ones.
  void measureOverlaps()
  {
    rankBodies();
    std::vector<Pair> all = pairs();
    std::vector<char> isInside(within.size(), 0);
    for (const auto& [larger, smaller, box] : all)
    {
      if (!isInside[smaller] && bodies.isInside(smaller, larger))
      {
        isInside[smaller] = 1;
        out.overlap += within[smaller];
      }
    }
    std::erase_if(all, [&](const Pair& pair) { return isInside[pair.smaller]; });
    const double perPair = std::sqrt(samples / std::max<double>(1.0, static_cast<double>(all.size())));
    const auto side = static_cast<int>(std::clamp(perPair, fewestSamples, mostSamples));
    for (const Pair& pair : all)
    {
      out.overlap += commonVolume(pair, side);
    }
    out.volume -= out.overlap;
  }

  /// Returns the volume that two bodies share in the domain, without what a body larger than both shares, too.
  double commonVolume(const Pair& pair, int side) const
  {
    const Vec3 size = pair.box.size();
    double length = 0.0;
    for (int i = 0; i < side; ++i)
    {
      for (int k = 0; k < side; ++k)
      {
        const double x = pair.box.min[0] + (i + 0.5) / side * size[0];
        const double y = pair.box.min[1] + (k + 0.5) / side * size[1];
        if (domain.beyond(domain.axes.fromModel({x, y, 0.0}).head<2>()) <= 0.0)
        {
          length += commonLength(pair, bodies.crossings(x, y, pair.box.max[2]));
        }
      }
    }
    return length * size[0] * size[1] / (side * side);
  }

  double commonLength(const Pair& pair, const std::vector<ClosedBodies::Crossing>& crossings) const
  {
    const double low = pair.box.min[2];
    const double high = pair.box.max[2];
    std::vector<Index> around; // ranks of the bodies around the place that is reached, in order
    const auto counts = [&] {
      return around.size() > 1 && around[0] == ranks[pair.larger] &&
             std::ranges::binary_search(around, ranks[pair.smaller]);
    };
    double length = 0.0;
    double reached = low;
    for (const auto& [height, body] : crossings)
    {
      const double next = std::clamp(height, low, high);
      length += counts() ? next - reached : 0.0;
      reached = next;
      if (const Index rank = ranks[body]; rank != noIndex)
      {
        const auto at = std::ranges::lower_bound(around, rank);
        const bool leaves = at != around.end() && *at == rank;
        leaves ? around.erase(at) : around.insert(at, rank);
      }
    }
    return length + (counts() ? high - reached : 0.0);
  }

  void findHollow()
  {
    for (const ZoneSummary& zone : zones)
    {
      if (zone.kept)
      {
        const std::vector<Index> around = bodies.around(zone.inside);
        if (!around.empty() && isLarge(bodies.bodies()[around.back()]))
        {
          out.hollow.push_back({bodies.bodies()[around.back()].surface, zone.volume, zone.inside});
        }
      }
    }
  }

  void findOpen()
  {
    for (const DrawnBody& body : bodies.open())
    {
      const Box3 box = bodies.bounds(body);
      if (!drawn.isGround[body.surface] && box.size().minCoeff() > 2.0 * sizeMin && !holdsLeftOut(box) &&
          encloses(body, box.center()))
      {
        out.open.push_back({body.surface, box.size().prod(), box.center()});
      }
    }
  }

  bool holdsLeftOut(const Box3& box) const
  {
    double leftOut = 0.0;
    for (const ZoneSummary& zone : zones)
    {
      leftOut += !zone.kept && isWithin(zone.inside, box) ? zone.volume : 0.0;
    }
    return leftOut > leastLeftOut * box.size().prod();
  }

  bool encloses(const DrawnBody& body, const Vec3& middle) const
  {
    const std::vector<Vec3> directions = levelAndUp();
    const auto met = std::ranges::count_if(directions, [&](const Vec3& direction) {
      return std::ranges::any_of(body.triangles, [&](Index t) { return isMet(middle, direction, bodies.corners(t)); });
    });
    return static_cast<double>(met) >= enclosing * static_cast<double>(directions.size());
  }

  const DrawnModel& drawn;
  const ClosedBodies& bodies;
  const PlacedPrism& domain;
  const ConvexRegion region;
  const ConvexRegion above;
  const std::vector<ZoneSummary>& zones;
  double sizeMin;
  std::vector<double> within; ///< one entry per closed body: its volume in the domain
  std::vector<Index> ranks;   ///< one entry per closed body: its place by volume among those in the domain, or noIndex
  BodyAudit out;
};

} // namespace

BodyAudit auditBodies(const DrawnModel& drawn, const PlacedPrism& domain, const std::vector<ZoneSummary>& zones,
                      double sizeMin)
{
  return BodyAuditor(drawn, domain, zones, sizeMin).run();
}

} // namespace atria
