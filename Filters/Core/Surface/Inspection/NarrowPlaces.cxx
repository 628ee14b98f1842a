// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Inspection/NarrowPlaces.h"

#include "Support/Angles.h"
#include "Support/UnionFind.h"
#include "Surface/Model/FeatureGraph.h"
#include "Surface/Model/TriangleTree.h"
#include "Surface/Search/Distance.h"

#include <cmath>

namespace atria {

namespace {

/// Least cosine between the normals of surfaces that face each other.
const double parallelCosine = cosOfDegrees(14.99);
/// Least cosine between their normals and the way from one to the other.
const double acrossCosine = cosOfDegrees(30.01);

using Place = TriangleTree::Place;

/// Searches the shortest way between places of a model, on the lattice.
class NarrowSearch
{
public:
  NarrowSearch(const SurfaceModel& m, const GridFrame& f, double leastWidth, const RunContext& runContext)
      : model(m), frame(f), least(leastWidth / f.latticeUnit()), context(runContext),
        tree(m), domain{toVector(f.domainLow), toVector(f.domainHigh)}, inDomain(m.triangles.size())
  {
    for (Index t = 0; t < model.triangles.size(); ++t)
    {
      normals.push_back(model.normal(t).normalized());
      inDomain[t] = !model.isTurnedSide(t) && model.bounds(t).touches(domain) ? 1 : 0;
    }
  }

  Narrow gap() const
  {
    Narrow best;
    for (Index t = 0; t < model.triangles.size(); ++t)
    {
      context.progress.check();
      const Vec3 a = toVector(model.corner(t, 0));
      const Vec3 b = toVector(model.corner(t, 1));
      const Vec3 c = toVector(model.corner(t, 2));
      for (const Vec3& p :
           {a, b, c, Vec3(0.5 * (a + b)), Vec3(0.5 * (b + c)), Vec3(0.5 * (c + a)), Vec3((a + b + c) / 3.0)})
      {
        if (inDomain[t])
        {
          shorten(best, p, model.surfaceIds[t], AcrossFace(*this, t, p));
        }
      }
    }
    return inModel(best);
  }

  Narrow opening() const
  {
    const BoundaryEdges boundary = boundaryOf(model, context.executor);
    UnionFind loops(model.points.size());
    for (const BoundaryEdge& edge : boundary.edges())
    {
      loops.join(edge.a, edge.b);
    }
    Narrow best;
    for (const BoundaryEdge& edge : boundary.edges())
    {
      context.progress.check();
      const Vec3 a = toVector(model.points[edge.a]);
      const Vec3 b = toVector(model.points[edge.b]);
      for (const Vec3& p : {a, Vec3(0.5 * (a + b)), b})
      {
        if (inDomain[edge.triangle])
        {
          shorten(best, p, model.surfaceIds[edge.triangle], AcrossOpening(*this, boundary, loops, edge, p));
        }
      }
    }
    return inModel(best);
  }

private:
  /// Accepts triangles across a gap.
  struct AcrossFace : TriangleTree::AnyPlace
  {
    const NarrowSearch& search;
    Index own;
    Vec3 p;

    AcrossFace(const NarrowSearch& s, Index triangle, const Vec3& from) : search(s), own(triangle), p(from) {}

    bool isAcross(Index triangle, const Vec3& way) const
    {
      return std::abs(way.dot(search.normals[triangle])) >= acrossCosine * way.norm();
    }
    bool reaches(const Box3& box) const
    {
      const Vec3& normal = search.normals[own];
      return std::max(reachOf(box, p, normal), reachOf(box, p, -normal)) >=
             acrossCosine * std::sqrt(box.squaredDistance(p));
    }
    bool wants(Index t) const
    {
      return search.inDomain[t] && std::abs(search.normals[t].dot(search.normals[own])) >= parallelCosine &&
             std::ranges::none_of(search.model.triangles[t],
                                  [&](Index q) { return contains(search.model.triangles[own], q); });
    }
    bool takes(const Place& place) const
    {
      const Vec3 way = place.at - p;
      return way.norm() >= search.least && isAcross(own, way) && isAcross(place.triangle, way);
    }
  };

  /// Accepts boundary edges across an opening.
  struct AcrossOpening : TriangleTree::AnyPlace
  {
    const NarrowSearch& search;
    const BoundaryEdges& boundary;
    UnionFind& loops;
    const BoundaryEdge& own;
    Vec3 p;
    Vec3 outward;

    AcrossOpening(const NarrowSearch& s, const BoundaryEdges& b, UnionFind& l, const BoundaryEdge& edge,
                  const Vec3& from)
        : search(s), boundary(b), loops(l), own(edge), p(from), outward(outwardOf(edge, s.model.points))
    {
    }

    bool reaches(const Box3& box) const { return reachesAhead(outward, p, box); }
    bool wants(Index t) const { return search.inDomain[t] && !boundary.of(t).empty(); }
    bool takes(const Place& place) const
    {
      const Vec3 way = place.at - p;
      return way.norm() >= search.least && isAhead(outward, way) &&
             std::ranges::any_of(boundary.of(place.triangle),
                                 [&](const BoundaryEdge& edge) { return isAcross(edge, place.at); });
    }

  private:
    bool isAcross(const BoundaryEdge& edge, const Vec3& at) const
    {
      const Vec3 a = toVector(search.model.points[edge.a]);
      const Vec3 b = toVector(search.model.points[edge.b]);
      const bool sharesPoint = edge.a == own.a || edge.a == own.b || edge.b == own.a || edge.b == own.b;
      const double longer = std::max((b - a).norm(), search.lengthOf(own));
      return !sharesPoint && (nearestOnSegment(at, a, b) - at).norm() <= latticeRounding &&
             (loops.find(edge.a) == loops.find(own.a) || (at - p).norm() <= longer) &&
             isAhead(outwardOf(edge, search.model.points), p - at);
    }
  };

  double lengthOf(const BoundaryEdge& edge) const { return between(model.points[edge.a], model.points[edge.b]).norm(); }

  template <typename Rule> void shorten(Narrow& best, const Vec3& p, Index surface, const Rule& rule) const
  {
    const auto place = tree.nearest(p, best.width, rule);
    if (place && std::sqrt(place->squaredDistance) < best.width)
    {
      best = {std::sqrt(place->squaredDistance), p, place->at, {surface, model.surfaceIds[place->triangle]}};
    }
  }

  Narrow inModel(Narrow narrow) const
  {
    narrow.width *= frame.latticeUnit();
    narrow.from = frame.toModel(narrow.from);
    narrow.to = frame.toModel(narrow.to);
    return narrow;
  }

  const SurfaceModel& model;
  const GridFrame& frame;
  double least;
  const RunContext& context;
  TriangleTree tree;
  Box3 domain;
  std::vector<char> inDomain;
  std::vector<Vec3> normals;
};

} // namespace

NarrowPlaces findNarrowPlaces(const SurfaceModel& model, const GridFrame& frame, double least,
                              const RunContext& context)
{
  const NarrowSearch search(model, frame, least, context);
  return {search.opening(), search.gap()};
}

} // namespace atria
