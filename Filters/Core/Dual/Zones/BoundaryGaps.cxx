// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/BoundaryGaps.h"

#include "Grid/Predicates.h"
#include "Surface/Model/FeatureGraph.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <cmath>

namespace atria {

namespace {

/// Steps along a boundary edge, in finest octants: no grid edge passes a bridge's chord unseen.
constexpr double stepLength = 0.25;

LatticePoint moved(const LatticePoint& p, const Vec3& by)
{
  return {p[0] + std::llround(by[0]), p[1] + std::llround(by[1]), p[2] + std::llround(by[2])};
}

/// Accepts places that are ahead of a place of a boundary edge, or touch it, if nothing connected to them is nearer.
struct AheadRule : TriangleTree::AnyPlace
{
  const SurfaceModel& model;
  const TriangleTree& tree;
  Index own; ///< the boundary edge's triangle
  Vec3 p;
  Vec3 outward;
  double touching;

  AheadRule(const SurfaceModel& m, const TriangleTree& t, Index triangle, const Vec3& place, const Vec3& direction,
            double near)
      : model(m), tree(t), own(triangle), p(place), outward(direction), touching(near)
  {
  }

  bool reaches(const Box3& box) const
  {
    return reachesAhead(outward, p, box) || box.squaredDistance(p) <= touching * touching;
  }
  bool wants(Index triangle) const { return triangle != own && !model.isPermeable(triangle); }
  bool takes(const TriangleTree::Place& place) const
  {
    const bool touches = place.squaredDistance <= touching * touching;
    return (touches || isAhead(outward, place.at - p)) && !isConnectedWithNearer(place);
  }

private:
  /// True if the place is also on the boundary edge's own triangle, or on a triangle with a place nearer to p.
  bool isConnectedWithNearer(const TriangleTree::Place& place) const
  {
    const auto isNearer = [&](Index t) {
      return t == own || TriangleTree::Place{(tree.nearestOn(t, p) - p).squaredNorm(), t, p}.isNearerThan(place);
    };
    const LatticePoint there = moved({}, place.at);
    const auto margin = static_cast<std::int64_t>(latticeRounding) + 1;
    return std::ranges::any_of(tree.touching(grown({there, there}, margin)), [&](Index t) {
      return (tree.nearestOn(t, place.at) - place.at).norm() <= latticeRounding && isNearer(t);
    });
  }
};

/// Looks ahead from boundary edges.
class GapProbe
{
public:
  explicit GapProbe(const MeshingContext& context)
      : octree(context.octree), frame(octree.frame()), model(context.model), tree(context.tree.get())
  {
  }

  /// Returns the stations along an edge; empty if nothing is ahead of it.
  std::vector<BoundaryStation> walk(const BoundaryEdge& edge) const
  {
    const LatticePoint& a = model.points[edge.a];
    const LatticePoint& b = model.points[edge.b];
    const Vec3 along = between(a, b);
    const Vec3 outward = outwardOf(edge, model.points);
    const double wanted = along.norm() / (stepLength * static_cast<double>(frame.latticeSize(frame.depth)));
    const auto count = static_cast<std::uint32_t>(std::clamp(std::ceil(wanted), 1.0, 1e6));
    std::vector<BoundaryStation> stations;
    bool any = false;
    for (std::uint32_t i = 0; i <= count; ++i)
    {
      // Looks from a little inside, as other edges begin at the ends.
      const double inside = std::clamp(static_cast<double>(i), coincidentRatio, count - coincidentRatio) / count;
      BoundaryStation station = look(moved(a, along * inside), edge.triangle, outward);
      station.at = i == count ? b : moved(a, along * (static_cast<double>(i) / count));
      any |= station.across.has_value();
      stations.push_back(station);
    }
    return any ? stations : std::vector<BoundaryStation>{};
  }

private:
  BoundaryStation look(const LatticePoint& p, Index triangle, const Vec3& outward) const
  {
    const Index leaf = frame.inDomain(p) ? octree.leafAt(p) : noIndex;
    if (leaf == noIndex || octree.featureType(leaf) == FeatureType::cluster)
    {
      return {p, std::nullopt, 0.0};
    }
    const auto size = static_cast<double>(frame.latticeSize(octree.level(leaf)));
    // Gaps are narrower than an octant by more than rounding.
    const double narrow = size - latticeRounding;
    const std::optional<Vec3> side = sideAhead(p, narrow, outward);
    const double reach = side ? side->norm() : narrow;
    const Vec3 from = toVector(p);
    const auto place =
        tree.nearest(from, reach, AheadRule(model, tree, triangle, from, outward, coincidentRatio * size));
    if (!place)
    {
      return {p, side, size};
    }
    const bool touches = place->squaredDistance <= std::pow(coincidentRatio * size, 2);
    return {p, touches ? Vec3(Vec3::Zero()) : Vec3(place->at - from), size};
  }

  /// Returns the way to the nearest domain side ahead within `reach`; nullopt if there is none.
  std::optional<Vec3> sideAhead(const LatticePoint& p, double reach, const Vec3& outward) const
  {
    std::optional<Vec3> best;
    for (int direction = 0; direction < 6; ++direction)
    {
      const int axis = axisOf(direction);
      Vec3 across = Vec3::Zero();
      across[axis] = static_cast<double>((isUpper(direction) ? frame.domainHigh : frame.domainLow)[axis] - p[axis]);
      if (across.norm() <= reach && isAhead(outward, across))
      {
        best = across;
        reach = across.norm();
      }
    }
    return best;
  }

  const Octree& octree;
  const GridFrame& frame;
  const SurfaceModel& model;
  const TriangleTree& tree;
};

void addTriangle(std::vector<BridgeTriangle>& out, const BridgeTriangle& corners)
{
  const LatticeNormal normal(corners[0], corners[1], corners[2]);
  if (normal.n[0] != 0 || normal.n[1] != 0 || normal.n[2] != 0)
  {
    out.push_back(corners);
  }
}

} // namespace

std::vector<BridgeTriangle> BoundaryGaps::bridge(Index edge, std::size_t step, double widest) const
{
  std::vector<BridgeTriangle> out;
  const BoundaryStation& from = stations[edge][step];
  const BoundaryStation& to = stations[edge][step + 1];
  if (from.isBridged(widest) && to.isBridged(widest))
  {
    const LatticePoint overFrom = moved(from.at, *from.across);
    addTriangle(out, {to.at, from.at, overFrom});
    addTriangle(out, {to.at, overFrom, moved(to.at, *to.across)});
  }
  return out;
}

std::vector<BridgeTriangle> BoundaryGaps::cornerBridge(const BoundaryEdges::End& one, const BoundaryEdges::End& other,
                                                       double widest, const SurfaceModel& model) const
{
  std::vector<BridgeTriangle> out;
  if (stations[one.edge].empty() || stations[other.edge].empty())
  {
    return out;
  }
  const auto station = [&](const BoundaryEdges::End& end) {
    return end.which == 0 ? stations[end.edge].front() : stations[end.edge].back();
  };
  // The corner is wound like the bridges: the edge that begins here continues the one that ends here.
  const BoundaryStation u = station(one.which == 1 ? one : other);
  const BoundaryStation v = station(one.which == 1 ? other : one);
  if (!u.isBridged(widest) || !v.isBridged(widest))
  {
    return out;
  }
  const LatticePoint pu = moved(u.at, *u.across);
  const LatticePoint pv = moved(u.at, *v.across);
  addTriangle(out, {u.at, pu, pv});
  // The corner between the bridges, as far off the edge's plane as these are.
  const Vec3 both = *u.across + *v.across;
  const Vec3 normal = model.normal(boundary.edges()[one.edge].triangle).normalized();
  addTriangle(out, {pv, pu, moved(u.at, both - 0.5 * normal.dot(both) * normal)});
  return out;
}

BoundaryGaps findBoundaryGaps(const MeshingContext& context)
{
  BoundaryGaps gaps{boundaryOf(context.model, context.executor), {}};
  const std::vector<BoundaryEdge>& edges = gaps.boundary.edges();
  gaps.stations.resize(edges.size());
  if (!edges.empty())
  {
    const GapProbe probe(context);
    context.executor.forEach(edges.size(), 16, [&](std::size_t e) {
      context.progress.check();
      gaps.stations[e] = probe.walk(edges[e]);
    });
  }
  return gaps;
}

} // namespace atria
