// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/LatticeSegments.h"

#include "Surface/Triangulation/FaceTriangulation.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdlib>

namespace atria {

namespace {

/// Cuts the segments of one face.
class SegmentCutter
{
public:
  SegmentCutter(std::vector<LatticePoint>& points_, DividedFace& face_, int axis_, double reach_)
      : points(points_), face(face_), axis(axis_), sweep((axis_ + 1) % 3), reach(reach_)
  {
    const auto note = [&](const auto& list) { known.insert(known.end(), list.begin(), list.end()); };
    note(face.corners);
    std::for_each(face.alongEdges.begin(), face.alongEdges.end(), note);
    note(face.inside);
  }

  void run()
  {
    std::sort(face.segments.begin(), face.segments.end(),
              [&](const EdgeKey& l, const EdgeKey& r) { return std::pair(low(l), l) < std::pair(low(r), r); });
    addCrossings();
    cut();
  }

private:
  std::int64_t low(const EdgeKey& s) const { return std::min(points[s.first][sweep], points[s.second][sweep]); }
  std::int64_t high(const EdgeKey& s) const { return std::max(points[s.first][sweep], points[s.second][sweep]); }

  void addCrossings()
  {
    for (std::size_t i = 0; i < face.segments.size(); ++i)
    {
      const std::int64_t end = high(face.segments[i]);
      for (std::size_t j = i + 1; j < face.segments.size() && low(face.segments[j]) <= end; ++j)
      {
        addCrossing(face.segments[i], face.segments[j]);
      }
    }
  }

  void addCrossing(const EdgeKey& e, const EdgeKey& f)
  {
    const LatticePoint &a = points[e.first], &b = points[e.second], &c = points[f.first], &d = points[f.second];
    const Wide ofA = projectedArea(c, d, a, axis), ofB = projectedArea(c, d, b, axis);
    if (signOf(ofA) * signOf(ofB) >= 0 ||
        signOf(projectedArea(a, b, c, axis)) * signOf(projectedArea(a, b, d, axis)) >= 0)
    {
      return;
    }
    const LatticePoint x = partWay(a, b, ofA, ofA - ofB);
    const auto near = [&](Index p) { return isOne(points[p], x); };
    if (std::none_of(known.begin(), known.end(), near))
    {
      known.push_back(static_cast<Index>(points.size()));
      face.inside.push_back(known.back());
      points.push_back(x);
    }
  }

  bool isOne(const LatticePoint& p, const LatticePoint& q) const
  {
    const auto close = [&](int i) { return static_cast<double>(std::abs(p[i] - q[i])) <= weldReaches * reach; };
    return close(0) && close(1) && close(2);
  }

  void cut()
  {
    std::sort(known.begin(), known.end(),
              [&](Index l, Index r) { return std::pair(points[l][sweep], l) < std::pair(points[r][sweep], r); });
    std::vector<EdgeKey> pieces;
    for (const EdgeKey& segment : face.segments)
    {
      cut(segment, pieces);
    }
    face.segments = std::move(pieces);
  }

  void cut(const EdgeKey& segment, std::vector<EdgeKey>& pieces) const
  {
    const LatticePoint& a = points[segment.first];
    const LatticePoint& b = points[segment.second];
    const auto margin = static_cast<std::int64_t>(reach) + 1;
    const auto begin = std::partition_point(known.begin(), known.end(),
                                            [&](Index p) { return points[p][sweep] < low(segment) - margin; });
    std::vector<std::pair<double, Index>> on;
    for (auto p = begin; p != known.end() && points[*p][sweep] <= high(segment) + margin; ++p)
    {
      // A crossing that was merged with a point of the face is as far from the segment as the two may be apart.
      if (*p != segment.first && *p != segment.second && liesOnSegment(points[*p], a, b, 2.0 * weldReaches * reach))
      {
        on.emplace_back(between(a, b).dot(between(a, points[*p])), *p);
      }
    }
    std::sort(on.begin(), on.end());
    Index from = segment.first;
    for (const auto& [t, p] : on)
    {
      pieces.push_back(edgeKey(from, p));
      from = p;
    }
    pieces.push_back(edgeKey(from, segment.second));
  }

  std::vector<LatticePoint>& points;
  DividedFace& face;
  int axis;
  int sweep;
  double reach;
  std::vector<Index> known;
};

} // namespace

LatticePoint partWay(const LatticePoint& p, const LatticePoint& q, Wide part, Wide whole)
{
  const long double t = static_cast<long double>(part) / static_cast<long double>(whole);
  LatticePoint out;
  for (int axis = 0; axis < 3; ++axis)
  {
    out[axis] = p[axis] + std::llroundl(t * static_cast<long double>(q[axis] - p[axis]));
  }
  return out;
}

bool liesOnSegment(const LatticePoint& p, const LatticePoint& a, const LatticePoint& b, double reach)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (static_cast<double>(p[axis] - std::max(a[axis], b[axis])) > reach ||
        static_cast<double>(std::min(a[axis], b[axis]) - p[axis]) > reach)
    {
      return false;
    }
  }
  const Vec3 along = between(a, b);
  const Vec3 to = between(a, p);
  const double t = along.dot(to);
  const double squared = along.squaredNorm();
  return t > 0.0 && t < squared && along.cross(to).squaredNorm() <= reach * reach * squared;
}

void cutSegments(std::vector<LatticePoint>& points, DividedFace& face, int axis, double reach)
{
  if (!face.segments.empty())
  {
    SegmentCutter(points, face, axis, reach).run();
  }
}

} // namespace atria
