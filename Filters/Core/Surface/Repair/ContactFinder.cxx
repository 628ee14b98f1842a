// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/ContactFinder.h"

#include "Grid/Predicates.h"
#include "Surface/Search/Distance.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <Eigen/Geometry>

#include <cmath>

namespace atria {

void ContactFinder::look(Index t)
{
  const auto& corners = soup.triangles[t];
  for (int i = 0; i < 3; ++i)
  {
    const EdgeKey edge = edgeKey(corners, i);
    if (liesOn(point(corners[(i + 2) % 3]), edge))
    {
      out.edges.push_back({edge, corners[(i + 2) % 3]});
    }
  }
}

void ContactFinder::look(Index first, Index second)
{
  const PlaneSides a(soup, first, second, reach);
  if (a.apart())
  {
    return;
  }
  const PlaneSides b(soup, second, first, reach);
  if (b.apart() || isBeyondAnEdge(first, second) || isBeyondAnEdge(second, first))
  {
    return;
  }
  const std::size_t edgesBefore = out.edges.size();
  const std::size_t facesBefore = out.faces.size();
  std::array<bool, 3> aTouches = touchCorners(first, second, a);
  std::array<bool, 3> bTouches = touchCorners(second, first, b);
  cutEdges(first, second, a, b);
  cutFace(first, second, a, aTouches);
  cutFace(second, first, b, bTouches);
  if (out.edges.size() != edgesBefore || out.faces.size() != facesBefore)
  {
    const auto [low, high] = std::minmax(first, second);
    out.pairs.push_back({low, high, edgesBefore, out.edges.size(), facesBefore, out.faces.size()});
  }
}

void ContactFinder::append(const ContactFinder& other)
{
  const auto base = static_cast<Index>(soup.points.size());
  const auto shift = static_cast<Index>(out.newPoints.size());
  const std::size_t edges = out.edges.size();
  const std::size_t faces = out.faces.size();
  const auto add = [&](auto& to, const auto& from) {
    for (auto contact : from)
    {
      contact.point += contact.point >= base ? shift : 0;
      to.push_back(contact);
    }
  };
  add(out.edges, other.out.edges);
  add(out.faces, other.out.faces);
  out.newPoints.insert(out.newPoints.end(), other.out.newPoints.begin(), other.out.newPoints.end());
  for (const FoundContacts::Pair& pair : other.out.pairs)
  {
    out.pairs.push_back({pair.first, pair.second, edges + pair.edgesBegin, edges + pair.edgesEnd,
                         faces + pair.facesBegin, faces + pair.facesEnd});
  }
}

bool ContactFinder::liesOn(const LatticePoint& p, const EdgeKey& edge) const
{
  return liesOnSegment(p, point(edge.first), point(edge.second), reach);
}

bool ContactFinder::isBeyondAnEdge(Index t, Index of) const
{
  const double apart = 2.0 * (reach + latticeRounding);
  const LatticePoint& origin = soup.corner(of, 0);
  const std::array<Vec3, 3> corners{Vec3::Zero(), between(origin, soup.corner(of, 1)),
                                    between(origin, soup.corner(of, 2))};
  const std::array<Vec3, 3> others{between(origin, soup.corner(t, 0)), between(origin, soup.corner(t, 1)),
                                   between(origin, soup.corner(t, 2))};
  const Vec3 normal = corners[1].cross(corners[2]);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Vec3 outward = (corners[(i + 1) % 3] - corners[i]).cross(normal);
    const auto along = [&](const Vec3& p) { return outward.dot(p); };
    const double gap = std::min({along(others[0]), along(others[1]), along(others[2])}) -
                       std::max({along(corners[0]), along(corners[1]), along(corners[2])});
    if (gap > 0.0 && gap * gap > apart * apart * outward.squaredNorm())
    {
      return true;
    }
  }
  return false;
}

bool ContactFinder::isInside(const LatticePoint& p, Index t, const LatticeNormal& normal) const
{
  const auto size = [&](int i) { return normal.n[i] < 0 ? -normal.n[i] : normal.n[i]; };
  const int axis = size(0) > size(1) ? (size(0) > size(2) ? 0 : 2) : (size(1) > size(2) ? 1 : 2);
  const int winding = signOf(normal.n[axis]);
  for (int i = 0; i < 3; ++i)
  {
    if (signOf(projectedArea(soup.corner(t, i), soup.corner(t, (i + 1) % 3), p, axis)) == -winding)
    {
      return false;
    }
  }
  return winding != 0;
}

std::array<bool, 3> ContactFinder::touchCorners(Index of, Index on, const PlaneSides& side)
{
  std::array<bool, 3> touches{};
  const auto& other = soup.triangles[on];
  for (int i = 0; i < 3; ++i)
  {
    const Index p = soup.triangles[of][i];
    if (contains(other, p))
    {
      touches[i] = true;
      continue;
    }
    if (std::abs(side.distance(i)) > reach)
    {
      continue;
    }
    for (int j = 0; j < 3; ++j)
    {
      if (liesOn(point(p), edgeKey(other, j)))
      {
        touches[i] = true;
        out.edges.push_back({edgeKey(other, j), p});
      }
    }
    if (!touches[i] && isInside(point(p), on, side.normal()))
    {
      touches[i] = true;
      out.faces.push_back({on, p});
    }
  }
  return touches;
}

bool ContactFinder::areNear(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                            const LatticePoint& d) const
{
  const auto apart = static_cast<std::int64_t>(2.0 * (reach + latticeRounding));
  bool near = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    near &= std::min(a[axis], b[axis]) - std::max(c[axis], d[axis]) <= apart &&
            std::min(c[axis], d[axis]) - std::max(a[axis], b[axis]) <= apart;
  }
  return near;
}

Index ContactFinder::addPoint(const LatticePoint& p)
{
  out.newPoints.push_back(p);
  return static_cast<Index>(soup.points.size() + out.newPoints.size() - 1);
}

bool ContactFinder::isSteep(Index t, int i, const PlaneSides& side) const
{
  // At a smaller angle all edges near the line in which the planes meet are close, and cuts would make ever more of
  // them.
  constexpr double slope = 0.02;
  const double rise = side.distance(i) - side.distance((i + 1) % 3);
  return std::abs(rise) > slope * between(soup.corner(t, i), soup.corner(t, (i + 1) % 3)).norm();
}

void ContactFinder::cutEdges(Index first, Index second, const PlaneSides& a, const PlaneSides& b)
{
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      // The same two edges cut each other in the same point, whichever triangles are tested.
      const EdgeKey e = edgeKey(soup.triangles[first], i);
      const EdgeKey f = edgeKey(soup.triangles[second], j);
      const bool isFlat = !isSteep(first, i, a) && !isSteep(second, j, b);
      cutEdge(std::min(e, f), std::max(e, f), isFlat ? 2.0 * reach : latticeRounding);
    }
  }
}

void ContactFinder::cutEdge(const EdgeKey& e, const EdgeKey& f, double apart)
{
  if (e.first == f.first || e.first == f.second || e.second == f.first || e.second == f.second)
  {
    return;
  }
  const LatticePoint &a = point(e.first), &b = point(e.second), &c = point(f.first), &d = point(f.second);
  if (!areNear(a, b, c, d))
  {
    return;
  }
  int axis = 0;
  if (!(between(a, b).cross(between(c, d)).cwiseAbs().maxCoeff(&axis) > 0.0))
  {
    return;
  }
  const Wide ofA = projectedArea(c, d, a, axis), ofB = projectedArea(c, d, b, axis);
  const Wide ofC = projectedArea(a, b, c, axis), ofD = projectedArea(a, b, d, axis);
  if (signOf(ofA) * signOf(ofB) >= 0 || signOf(ofC) * signOf(ofD) >= 0)
  {
    return;
  }
  const LatticePoint p = partWay(a, b, ofA, ofA - ofB);
  const LatticePoint q = partWay(c, d, ofC, ofC - ofD);
  if (between(p, q).squaredNorm() > apart * apart || liesOn(a, f) || liesOn(b, f) || liesOn(c, e) || liesOn(d, e))
  {
    return;
  }
  LatticePoint middle;
  for (int i = 0; i < 3; ++i)
  {
    middle[i] = p[i] + (q[i] - p[i]) / 2;
  }
  const Index id = addPoint(middle);
  out.edges.push_back({e, id});
  out.edges.push_back({f, id});
}

void ContactFinder::cutFace(Index of, Index through, const PlaneSides& side, const std::array<bool, 3>& touches)
{
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    if (touches[i] || touches[next] || side.sign(i) * side.sign(next) >= 0)
    {
      continue;
    }
    if (isBeside(side.passage(i, next), through))
    {
      continue;
    }
    const EdgeKey edge = edgeKey(soup.triangles[of], i);
    const bool forward = edge.first == soup.triangles[of][i];
    const Wide begin = side.exact(forward ? i : next);
    const Wide end = side.exact(forward ? next : i);
    const LatticePoint p = partWay(point(edge.first), point(edge.second), begin, begin - end);
    cutAt(p, edge, through, side);
  }
}

bool ContactFinder::isBeside(const PlaneSides::Passage& passage, Index t) const
{
  const double apart = passage.error + 2.0 * (reach + latticeRounding);
  const Vec3 a = toVector(soup.corner(t, 0));
  const Vec3 b = toVector(soup.corner(t, 1));
  const Vec3 c = toVector(soup.corner(t, 2));
  return ((a.cwiseMin(b).cwiseMin(c) - passage.at).array() > apart).any() ||
         ((passage.at - a.cwiseMax(b).cwiseMax(c)).array() > apart).any();
}

void ContactFinder::cutAt(const LatticePoint& p, const EdgeKey& edge, Index through, const PlaneSides& side)
{
  std::array<EdgeKey, 3> met;
  int count = 0;
  for (int j = 0; j < 3; ++j)
  {
    const EdgeKey other = edgeKey(soup.triangles[through], j);
    if (liesOn(p, other))
    {
      met[count++] = other;
    }
  }
  if (count == 0 && !isInside(p, through, side.normal()))
  {
    return;
  }
  const Index id = addPoint(p);
  out.edges.push_back({edge, id});
  for (int j = 0; j < count; ++j)
  {
    out.edges.push_back({met[j], id});
  }
  if (count == 0)
  {
    out.faces.push_back({through, id});
  }
}

} // namespace atria
