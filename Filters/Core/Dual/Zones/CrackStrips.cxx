// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CrackStrips.h"

#include "Grid/Predicates.h"
#include "Surface/Search/Distance.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace atria {

namespace {

/// Steps along a boundary edge, against the finest octants.
constexpr double stepRatio = 0.25;
/// A place stands for the end of a boundary edge if it is this part of a step before it: at the end itself, others
/// begin.
constexpr double beforeEnd = 0.01;
/// What is this near, against the leaf's edge, touches.
constexpr double touchRatio = 1e-4;
/// Of 45 degrees.
constexpr double aheadCosine = 0.70710678;
/// In lattice units: a place on a triangle, but for rounding.
constexpr double onTriangle = 2.0;
/// Of 15 degrees: the strips of two boundary edges that turn by more leave a corner between them.
constexpr double straightCosine = 0.966;

/// A free edge with its triangle, whose third point it is wound before: a to b.
struct BoundaryEdge
{
  Index a;
  Index b;
  Index third;
  Index triangle;
};

std::vector<BoundaryEdge> boundaryEdgesOf(const SurfaceModel& model)
{
  std::vector<EdgeKey> keys;
  for (const FeatureEdge& edge : model.featureEdges)
  {
    if (model.kindOf(edge) == CurveKind::boundary)
    {
      keys.push_back(edgeKey(edge.a, edge.b));
    }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<BoundaryEdge> boundaryEdges;
  for (Index t = 0; t < model.triangles.size() && !keys.empty(); ++t)
  {
    for (int i = 0; i < 3 && model.domainSides[t] == SurfaceModel::noSide && !model.isPermeable(t); ++i)
    {
      const auto& corners = model.triangles[t];
      if (std::binary_search(keys.begin(), keys.end(), edgeKey(corners, i)))
      {
        boundaryEdges.push_back({corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3], t});
      }
    }
  }
  return boundaryEdges;
}

/// What was found along one boundary edge.
struct Bridge
{
  std::vector<StripTriangle> strip;
  /// From its two ends to what is across; nothing where that is too far.
  std::array<std::optional<Vec3>, 2> atEnd;
};

LatticePoint moved(const LatticePoint& p, const Vec3& by)
{
  return {p[0] + std::llround(by[0]), p[1] + std::llround(by[1]), p[2] + std::llround(by[2])};
}

class Bridger
{
public:
  Bridger(const Octree& leaves, const SurfaceModel& surfaces, const TriangleTree& pieces, double ratio)
      : octree(leaves), frame(leaves.frame()), model(surfaces), tree(pieces), tolerance(ratio)
  {
  }

  Bridge bridge(const BoundaryEdge& boundaryEdge)
  {
    Bridge out;
    const LatticePoint& a = model.points[boundaryEdge.a];
    const Vec3 along = between(a, model.points[boundaryEdge.b]);
    const double wanted = along.norm() / (stepRatio * static_cast<double>(frame.latticeSize(frame.depth)));
    const auto count = static_cast<std::uint32_t>(std::clamp(std::ceil(wanted), 1.0, 1e6));
    const Vec3 inward = between(a, model.points[boundaryEdge.third]);
    const Vec3 outward = (inward.dot(along) / along.squaredNorm() * along - inward).normalized();
    LatticePoint from = a;
    bool isBridged = false;
    Vec3 across = Vec3::Zero();
    for (std::uint32_t i = 0; i <= count; ++i)
    {
      const LatticePoint to =
          i == count ? model.points[boundaryEdge.b] : moved(a, along * (static_cast<double>(i) / count));
      const double inside = std::clamp(static_cast<double>(i), beforeEnd, count - beforeEnd) / count;
      const std::optional<Vec3> next = acrossFrom(moved(a, along * inside), boundaryEdge.triangle, outward);
      if (isBridged && next)
      {
        add(out.strip, boundaryEdge.triangle, {to, from, moved(from, across)});
        add(out.strip, boundaryEdge.triangle, {to, moved(from, across), moved(to, *next)});
      }
      if (i == 0 || i == count)
      {
        out.atEnd[i == 0 ? 0 : 1] = next;
      }
      from = to;
      isBridged = next.has_value();
      across = next.value_or(Vec3::Zero());
    }
    return out;
  }

  /// Between the strips of two boundary edges at the point in which they meet.
  void addCorner(std::vector<StripTriangle>& out, Index point, Index triangle, const Vec3& u, const Vec3& v) const
  {
    const LatticePoint& p = model.points[point];
    const LatticePoint pu = moved(p, u);
    const LatticePoint pv = moved(p, v);
    add(out, triangle, {p, pu, pv});
    if (u.dot(v) < straightCosine * u.norm() * v.norm())
    {
      // As far off the boundary edge's plane as the two strips are.
      const Vec3 normal = model.normal(triangle).normalized();
      add(out, triangle, {pv, pu, moved(p, u + v - 0.5 * normal.dot(u + v) * normal)});
    }
  }

private:
  static void add(std::vector<StripTriangle>& out, Index boundaryEdge, const std::array<LatticePoint, 3>& corners)
  {
    const LatticeNormal normal(corners[0], corners[1], corners[2]);
    if (normal.n[0] != 0 || normal.n[1] != 0 || normal.n[2] != 0)
    {
      out.push_back({corners, boundaryEdge});
    }
  }

  struct Place
  {
    double distance;
    Index triangle;
    Vec3 offset;
  };

  Vec3 nearestOn(Index t, const LatticePoint& p, const Vec3& offset) const
  {
    return nearestOnTriangle(offset, between(p, model.corner(t, 0)), between(p, model.corner(t, 1)),
                             between(p, model.corner(t, 2)));
  }

  /// Whether a place is also on a triangle that has one nearer to p, or is the boundary edge's own.
  bool hangsOnNearer(const Place& place, const LatticePoint& p, Index boundaryEdge) const
  {
    const LatticePoint there = moved(p, place.offset);
    const auto margin = static_cast<std::int64_t>(2.0 * onTriangle);
    LatticeBox box{there, there};
    for (int axis = 0; axis < 3; ++axis)
    {
      box.low[axis] -= margin;
      box.high[axis] += margin;
    }
    return std::ranges::any_of(tree.touching(box), [&](Index t) {
      if ((nearestOn(t, p, place.offset) - place.offset).norm() > onTriangle)
      {
        return false;
      }
      const double distance = nearestOn(t, p, Vec3::Zero()).norm();
      return t == boundaryEdge || std::tie(distance, t) < std::tie(place.distance, place.triangle);
    });
  }

  /// From a place of the boundary edge to the nearest thing ahead; zero where something touches; nothing beyond the
  /// tolerance.
  std::optional<Vec3> acrossFrom(const LatticePoint& p, Index boundaryEdge, const Vec3& outward)
  {
    if (!frame.inDomain(p))
    {
      return std::nullopt;
    }
    const Index leaf = octree.leafAt(p);
    if (octree.featureType(leaf) == FeatureType::cluster)
    {
      return std::nullopt;
    }
    const double size = static_cast<double>(frame.latticeSize(octree.level(leaf)));
    const double reach = tolerance * size;
    std::optional<Vec3> best = sideAhead(p, reach, outward);
    gather(p, boundaryEdge, reach);
    for (const Place& place : places)
    {
      const bool touches = place.distance <= touchRatio * size;
      const bool isAhead = place.offset.dot(outward) >= aheadCosine * place.distance;
      if (!(touches || isAhead) || hangsOnNearer(place, p, boundaryEdge))
      {
        continue; // what is connected with this is nearer
      }
      if (touches)
      {
        return Vec3(Vec3::Zero());
      }
      best = best && best->norm() <= place.distance ? *best : place.offset;
      break;
    }
    return best;
  }

  /// The triangles within the reach but for the boundary edge's own, nearest first.
  void gather(const LatticePoint& p, Index boundaryEdge, double reach)
  {
    const auto margin = static_cast<std::int64_t>(std::ceil(reach));
    LatticeBox box{p, p};
    for (int axis = 0; axis < 3; ++axis)
    {
      box.low[axis] -= margin;
      box.high[axis] += margin;
    }
    places.clear();
    for (const Index t : tree.touching(box))
    {
      const Vec3 offset = nearestOn(t, p, Vec3::Zero());
      if (t != boundaryEdge && !model.isPermeable(t) && offset.norm() <= reach)
      {
        places.push_back({offset.norm(), t, offset});
      }
    }
    std::sort(places.begin(), places.end(), [](const Place& l, const Place& r) {
      return std::tie(l.distance, l.triangle) < std::tie(r.distance, r.triangle);
    });
  }

  std::optional<Vec3> sideAhead(const LatticePoint& p, double reach, const Vec3& outward) const
  {
    std::optional<Vec3> best;
    for (int direction = 0; direction < 6; ++direction)
    {
      const int axis = axisOf(direction);
      Vec3 across = Vec3::Zero();
      across[axis] = static_cast<double>((isUpper(direction) ? frame.domainHigh : frame.domainLow)[axis] - p[axis]);
      const double distance = across.norm();
      if (distance <= reach && across.dot(outward) >= aheadCosine * distance && (!best || distance < best->norm()))
      {
        best = across;
      }
    }
    return best;
  }

  const Octree& octree;
  const GridFrame& frame;
  const SurfaceModel& model;
  const TriangleTree& tree;
  double tolerance;
  std::vector<Place> places;
};

/// The ends of boundary edges at their points, with what is across there.
struct BoundaryEdgeEnd
{
  Index point;
  Index boundaryEdge;
  int end;
  bool operator<(const BoundaryEdgeEnd& other) const
  {
    return std::tie(point, boundaryEdge, end) < std::tie(other.point, other.boundaryEdge, other.end);
  }
};

} // namespace

std::vector<StripTriangle> crackStrips(double tolerance, const MeshingContext& context)
{
  const std::vector<BoundaryEdge> boundaryEdges = boundaryEdgesOf(context.model);
  if (boundaryEdges.empty())
  {
    return {};
  }
  const TriangleTree& tree = context.tree.get();
  std::vector<Bridge> bridges(boundaryEdges.size());
  context.executor.forRanges(boundaryEdges.size(), 16, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    Bridger bridger(context.octree, context.model, tree, tolerance);
    for (std::size_t i = begin; i < end; ++i)
    {
      bridges[i] = bridger.bridge(boundaryEdges[i]);
    }
  });
  std::vector<StripTriangle> strips;
  std::vector<BoundaryEdgeEnd> ends;
  for (Index i = 0; i < boundaryEdges.size(); ++i)
  {
    strips.insert(strips.end(), bridges[i].strip.begin(), bridges[i].strip.end());
    ends.push_back({boundaryEdges[i].a, i, 0});
    ends.push_back({boundaryEdges[i].b, i, 1});
  }
  std::sort(ends.begin(), ends.end());
  const Bridger bridger(context.octree, context.model, tree, tolerance);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const BoundaryEdgeEnd& l = ends[i];
    const BoundaryEdgeEnd& r = ends[i + 1];
    const auto& u = bridges[l.boundaryEdge].atEnd[l.end];
    const auto& v = bridges[r.boundaryEdge].atEnd[r.end];
    if (l.point == r.point && u && v)
    {
      // Wound as the strip of the boundary edge that begins here goes on from that of the one that ends here.
      bridger.addCorner(strips, l.point, boundaryEdges[l.boundaryEdge].triangle, l.end == 1 ? *u : *v,
                        l.end == 1 ? *v : *u);
    }
  }
  return strips;
}

} // namespace atria
