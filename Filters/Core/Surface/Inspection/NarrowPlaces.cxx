// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Inspection/NarrowPlaces.h"

#include "Support/UnionFind.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace atria {

namespace {

const double cos15 = std::cos(std::numbers::pi / 12.0);
const double cos30 = std::cos(std::numbers::pi / 6.0);
const double cos45 = std::cos(std::numbers::pi / 4.0);

bool overlaps(const Box3& a, const Box3& b, double reach)
{
  return (a.min.array() - reach <= b.max.array()).all() && (b.min.array() - reach <= a.max.array()).all();
}

/// Calls `measure(i, j)` for pairs of things whose boxes are closer than the shortest way known, which it may shorten.
template <typename Thing, typename Measure>
void forClosePairs(std::vector<Thing>& things, const Narrow& best, Measure&& measure)
{
  std::stable_sort(things.begin(), things.end(),
                   [](const Thing& l, const Thing& r) { return l.box.min[0] < r.box.min[0]; });
  std::vector<Index> active;
  for (Index i = 0; i < things.size(); ++i)
  {
    std::erase_if(active, [&](Index j) { return things[j].box.max[0] + best.width < things[i].box.min[0]; });
    // The latest are the closest, and shorten the search for the others.
    for (auto j = active.rbegin(); j != active.rend(); ++j)
    {
      if (overlaps(things[i].box, things[*j].box, best.width))
      {
        measure(things[i], things[*j]);
      }
    }
    active.push_back(i);
  }
}

struct BoundaryEdge
{
  Box3 box;
  std::array<Index, 2> ids;
  std::array<Vec3, 2> ends;
  Vec3 outward; ///< in the plane of its triangle, away from it
  Index loop;   ///< the same for boundary edges that are joined end to end
  double length;
  Index surface;
};

struct Face
{
  Box3 box;
  std::array<Index, 3> ids;
  std::array<Vec3, 3> points;
  Vec3 normal;
  Index surface;
};

template <std::size_t N, std::size_t M> bool sharePoint(const std::array<Index, N>& a, const std::array<Index, M>& b)
{
  return std::any_of(a.begin(), a.end(), [&](Index p) { return std::find(b.begin(), b.end(), p) != b.end(); });
}

void shorten(Narrow& best, const Vec3& from, const Vec3& to, Index first, Index second)
{
  const double width = (to - from).norm();
  if (width < best.width)
  {
    best = {width, from, to, {first, second}};
  }
}

std::vector<Face> facesOf(const SurfaceModel& model, const GridFrame& frame)
{
  std::vector<Face> faces;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    Face face{{}, model.triangles[t], {}, model.normal(t).normalized(), model.surfaceIds[t]};
    for (int i = 0; i < 3; ++i)
    {
      face.points[i] = frame.toModel(model.corner(t, i));
      face.box.extend(face.points[i]);
    }
    if (!model.isTurnedSide(t) && overlaps(face.box, frame.domain, 0.0))
    {
      faces.push_back(face);
    }
  }
  return faces;
}

std::vector<BoundaryEdge> boundaryEdgesOf(const SurfaceModel& model, const GridFrame& frame,
                                          const std::vector<Face>& faces)
{
  std::set<std::array<Index, 2>> isBoundaryEdge;
  UnionFind loops(model.points.size());
  for (const FeatureEdge& edge : model.featureEdges)
  {
    if (model.kindOf(edge) == CurveKind::boundary)
    {
      isBoundaryEdge.insert({std::min(edge.a, edge.b), std::max(edge.a, edge.b)});
      loops.join(edge.a, edge.b);
    }
  }
  std::vector<BoundaryEdge> boundaryEdges;
  for (const Face& face : faces)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Index a = face.ids[i];
      const Index b = face.ids[(i + 1) % 3];
      if (isBoundaryEdge.count({std::min(a, b), std::max(a, b)}) == 0)
      {
        continue;
      }
      BoundaryEdge boundaryEdge{{},  {a, b},      {face.points[i], face.points[(i + 1) % 3]}, {}, loops.find(a),
                                0.0, face.surface};
      boundaryEdge.length = (boundaryEdge.ends[1] - boundaryEdge.ends[0]).norm();
      const Vec3 along = (boundaryEdge.ends[1] - boundaryEdge.ends[0]).normalized();
      const Vec3 inward = face.points[(i + 2) % 3] - boundaryEdge.ends[0];
      boundaryEdge.outward = -(inward - inward.dot(along) * along).normalized();
      boundaryEdge.box.extend(boundaryEdge.ends[0]);
      boundaryEdge.box.extend(boundaryEdge.ends[1]);
      if (overlaps(boundaryEdge.box, frame.domain, 0.0))
      {
        boundaryEdges.push_back(boundaryEdge);
      }
    }
  }
  return boundaryEdges;
}

/// Ways from the ends and the middle of either boundary edge to the other.
void measureBoundaryEdges(const BoundaryEdge& a, const BoundaryEdge& b, double least, Narrow& best)
{
  if (sharePoint(a.ids, b.ids))
  {
    return;
  }
  const auto test = [&](const Vec3& p, const BoundaryEdge& own, const BoundaryEdge& other) {
    const Vec3 q = nearestOnSegment(p, other.ends[0], other.ends[1]);
    const Vec3 way = q - p;
    const double width = way.norm();
    const bool belongs = own.loop == other.loop || width <= std::max(own.length, other.length);
    if (width >= least && belongs && way.dot(own.outward) >= cos45 * width && -way.dot(other.outward) >= cos45 * width)
    {
      shorten(best, p, q, own.surface, other.surface);
    }
  };
  for (const double t : {0.0, 0.5, 1.0})
  {
    test(a.ends[0] + t * (a.ends[1] - a.ends[0]), a, b);
    test(b.ends[0] + t * (b.ends[1] - b.ends[0]), b, a);
  }
}

void measureFaces(const Face& a, const Face& b, double least, Narrow& best)
{
  if (std::abs(a.normal.dot(b.normal)) < cos15 || sharePoint(a.ids, b.ids))
  {
    return;
  }
  const auto test = [&](const Vec3& p, const Face& own, const Face& other) {
    const Vec3 q = nearestOnTriangle(p, other.points[0], other.points[1], other.points[2]);
    const Vec3 way = q - p;
    const double width = way.norm();
    if (width >= least && std::abs(way.dot(own.normal)) >= cos30 * width &&
        std::abs(way.dot(other.normal)) >= cos30 * width)
    {
      shorten(best, p, q, own.surface, other.surface);
    }
  };
  for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)})
  {
    const auto& p = own->points;
    for (int i = 0; i < 3; ++i)
    {
      test(p[i], *own, *other);
      test(0.5 * (p[i] + p[(i + 1) % 3]), *own, *other);
    }
    test((p[0] + p[1] + p[2]) / 3.0, *own, *other);
  }
}

} // namespace

NarrowPlaces findNarrowPlaces(const SurfaceModel& model, const GridFrame& frame, double least)
{
  std::vector<Face> faces = facesOf(model, frame);
  std::vector<BoundaryEdge> boundaryEdges = boundaryEdgesOf(model, frame, faces);
  NarrowPlaces out;
  forClosePairs(boundaryEdges, out.opening,
                [&](const BoundaryEdge& a, const BoundaryEdge& b) { measureBoundaryEdges(a, b, least, out.opening); });
  forClosePairs(faces, out.gap, [&](const Face& a, const Face& b) { measureFaces(a, b, least, out.gap); });
  return out;
}

} // namespace atria
