// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/Contacts.h"

#include "Grid/Predicates.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"
#include "Surface/Repair/Clusters.h"
#include "Surface/Repair/PlaneSides.h"
#include "Surface/Search/BoxRaster.h"
#include "Surface/Search/BoxTree.h"
#include "Surface/Search/Distance.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <Eigen/Geometry>

#include <atomic>
#include <cmath>
#include <numeric>

namespace atria {

namespace {

/// One object a search.
class ContactFinder
{
public:
  ContactFinder(const TriangleSoup& soup_, double reach_) : soup(soup_), reach(reach_) {}

  /// Points on the long edge of a triangle without width.
  void look(Index t)
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

  void look(Index first, Index second)
  {
    const PlaneSides a(soup, first, second, reach);
    if (a.apart())
    {
      return;
    }
    const PlaneSides b(soup, second, first, reach);
    if (b.apart())
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

  /// Adds what another search has found.
  void append(const ContactFinder& other)
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

  FoundContacts take() { return std::move(out); }

private:
  const LatticePoint& point(Index p) const { return soup.points[p]; }

  bool liesOn(const LatticePoint& p, const EdgeKey& edge) const
  {
    return liesOnSegment(p, point(edge.first), point(edge.second), reach);
  }

  /// Whether p, which lies on the triangle's plane but for rounding, lies inside of it.
  bool isInside(const LatticePoint& p, Index t, const LatticeNormal& normal) const
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

  /// Corners of `of` on edges or the face of `on`.
  std::array<bool, 3> touchCorners(Index of, Index on, const PlaneSides& side)
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

  /// Whether the boxes of two edges are as near as these must be to cut each other. Most are not.
  bool areNear(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) const
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

  Index addPoint(const LatticePoint& p)
  {
    out.newPoints.push_back(p);
    return static_cast<Index>(soup.points.size() + out.newPoints.size() - 1);
  }

  /// Whether edge i of a triangle passes through the plane of another in a definite point.
  bool isSteep(Index t, int i, const PlaneSides& side) const
  {
    constexpr double slope = 0.02;
    const double rise = side.distance(i) - side.distance((i + 1) % 3);
    return std::abs(rise) > slope * between(soup.corner(t, i), soup.corner(t, (i + 1) % 3)).norm();
  }

  /// Where triangles lie in one plane edges cut each other within the reach. Elsewhere cutFace tells where they meet:
  /// near the line in which two planes meet at a small angle all edges are close to each other that do not.
  void cutEdges(Index first, Index second, const PlaneSides& a, const PlaneSides& b)
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        // The same two edges cut each other in the same point, whichever triangles are looked at.
        const EdgeKey e = edgeKey(soup.triangles[first], i);
        const EdgeKey f = edgeKey(soup.triangles[second], j);
        const bool isFlat = !isSteep(first, i, a) && !isSteep(second, j, b);
        cutEdge(std::min(e, f), std::max(e, f), isFlat ? 2.0 * reach : latticeRounding);
      }
    }
  }

  void cutEdge(const EdgeKey& e, const EdgeKey& f, double apart)
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

  /// Edges of `of` that pass through the face of `through`.
  void cutFace(Index of, Index through, const PlaneSides& side, const std::array<bool, 3>& touches)
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

  /// Whether a place is too far from the box of a triangle to lie on it.
  bool isBeside(const PlaneSides::Passage& passage, Index t) const
  {
    const double apart = passage.error + 2.0 * (reach + latticeRounding);
    const Vec3 a = toVector(soup.corner(t, 0));
    const Vec3 b = toVector(soup.corner(t, 1));
    const Vec3 c = toVector(soup.corner(t, 2));
    return ((a.cwiseMin(b).cwiseMin(c) - passage.at).array() > apart).any() ||
           ((passage.at - a.cwiseMax(b).cwiseMax(c)).array() > apart).any();
  }

  void cutAt(const LatticePoint& p, const EdgeKey& edge, Index through, const PlaneSides& side)
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

  const TriangleSoup& soup;
  double reach;
  FoundContacts out;
};

/// The search among some of the triangles.
struct Search
{
  ContactFinder finder;
  /// Pairs to look at once it is known that there are not too many.
  std::vector<std::pair<Index, Index>> later;
};

LatticeBox common(const NumberedBox& a, const NumberedBox& b)
{
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::max(a.low[axis], b.low[axis]);
    box.high[axis] = std::min(a.high[axis], b.high[axis]);
  }
  return box;
}

/// Looks at pairs as they are met: of those in the tree, and of the others with them. Where boxes cluster pairs are
/// counted first, as looking at them takes far longer.
std::vector<Search> searchContacts(const TriangleSoup& soup, const BoxTree& tree,
                                   const std::vector<NumberedBox>& others, const std::vector<char>& isLeft,
                                   double reach, const ClusterCells& clusters, const RunContext& context)
{
  const std::size_t count = tree.size() + others.size();
  // Of few triangles many are near each other: pieces are small then, so that there are some for all threads.
  const std::size_t grain = std::clamp<std::size_t>(count / 128, 8, 1024);
  constexpr std::size_t manyEach = 200;
  std::vector<Search> searches((count + grain - 1) / grain, Search{ContactFinder(soup, reach), {}});
  std::atomic<std::size_t> seen{0};
  context.executor.forEach(searches.size(), 1, [&](std::size_t piece) {
    context.progress.check();
    auto& [finder, later] = searches[piece];
    std::vector<std::pair<Index, Index>> pairs;
    for (std::size_t i = piece * grain; i < std::min((piece + 1) * grain, count); ++i)
    {
      const bool isInTree = i < tree.size();
      const NumberedBox& box = isInTree ? tree.box(i) : others[i - tree.size()];
      const Index a = box.id;
      if (isInTree)
      {
        finder.look(a);
      }
      std::size_t touching = 0;
      tree.eachTouching(box, isInTree ? i + 1 : 0, [&](std::size_t j) {
        const Index b = tree.box(j).id;
        const bool isOther = soup.sources[a] != soup.sources[b] && !areLeft(soup, a, b, isLeft);
        if (isOther && !clusters.hold(common(box, tree.box(j))))
        {
          touching += isInTree ? 2 : 1; // seen from both sides
          pairs.emplace_back(std::min(a, b), std::max(a, b));
        }
      });
      checkPairs(seen += touching);
      if (touching > manyEach)
      {
        later.insert(later.end(), pairs.begin(), pairs.end());
      }
      else
      {
        for (const auto& [first, second] : pairs)
        {
          finder.look(first, second);
        }
      }
      pairs.clear();
    }
  });
  context.executor.forEach(searches.size(), 1, [&](std::size_t piece) {
    auto& [finder, later] = searches[piece];
    for (std::size_t i = 0; i < later.size(); ++i)
    {
      if (i % 4096 == 0)
      {
        context.progress.check();
      }
      finder.look(later[i].first, later[i].second);
    }
    later = {};
  });
  return searches;
}

/// The boxes of those triangles that may touch what a raster is of.
std::vector<NumberedBox> boxesAt(const BoxRaster& raster, const TriangleSoup& soup, const std::vector<Index>& triangles,
                                 std::int64_t reach, const RunContext& context)
{
  std::vector<Index> near = chosenNumbers(triangles.size(), context.executor, [&](std::size_t i) {
    return raster.mayTouch(boxOf(soup, triangles[i], reach));
  });
  std::ranges::transform(near, near.begin(), [&](Index i) { return triangles[i]; });
  return boxesOf(soup, near, reach, context);
}

/// Equal points become one, numbered by their coordinates: the order in which they were found does not matter.
void numberNewPoints(Contacts& contacts, const std::vector<LatticePoint>& found, Index base)
{
  std::vector<LatticePoint>& points = contacts.newPoints;
  const auto collect = [&](const auto& contact) {
    if (contact.point >= base)
    {
      points.push_back(found[contact.point - base]);
    }
  };
  std::ranges::for_each(contacts.edges, collect);
  std::ranges::for_each(contacts.faces, collect);
  sortUnique(points);
  const auto renumber = [&](auto& contact) {
    if (contact.point >= base)
    {
      const auto at = std::ranges::lower_bound(points, found[contact.point - base]);
      contact.point = base + static_cast<Index>(at - points.begin());
    }
  };
  std::ranges::for_each(contacts.edges, renumber);
  std::ranges::for_each(contacts.faces, renumber);
}

} // namespace

std::vector<char> beginsOfEdges(std::span<const EdgeContact> contacts, std::size_t pointCount)
{
  std::vector<char> begins(pointCount, 0);
  for (const EdgeContact& c : contacts)
  {
    begins[c.edge.first] = 1;
  }
  return begins;
}

Contacts FoundContacts::sorted(const TriangleSoup& soup, const std::vector<char>& isLeft) const
{
  Contacts contacts;
  std::size_t edge = 0;
  std::size_t face = 0;
  const auto takeUpTo = [&](std::size_t edgeEnd, std::size_t faceEnd) {
    contacts.edges.insert(contacts.edges.end(), edges.begin() + static_cast<std::ptrdiff_t>(edge),
                          edges.begin() + static_cast<std::ptrdiff_t>(edgeEnd));
    contacts.faces.insert(contacts.faces.end(), faces.begin() + static_cast<std::ptrdiff_t>(face),
                          faces.begin() + static_cast<std::ptrdiff_t>(faceEnd));
  };
  for (const Pair& pair : pairs)
  {
    if (areLeft(soup, pair.first, pair.second, isLeft))
    {
      takeUpTo(pair.edgesBegin, pair.facesBegin);
      edge = pair.edgesEnd;
      face = pair.facesEnd;
    }
    else
    {
      contacts.pairs.emplace_back(pair.first, pair.second);
    }
  }
  takeUpTo(edges.size(), faces.size());
  numberNewPoints(contacts, newPoints, static_cast<Index>(soup.points.size()));
  sortUnique(contacts.edges);
  sortUnique(contacts.faces);
  sortUnique(contacts.pairs);
  return contacts;
}

FoundContacts findContacts(const TriangleSoup& soup, const std::vector<char>& changed, const std::vector<char>& isLeft,
                           std::int64_t reach, const ClusterCells& clusters, const RunContext& context)
{
  std::vector<Index> inTree = seenTriangles(soup, clusters, context);
  // Clang 14 cannot compile std::ranges::stable_partition of this library.
  const auto others = std::stable_partition(inTree.begin(), inTree.end(), [&](Index t) { return changed[t] != 0; });
  const std::vector<Index> rest(others, inTree.end());
  inTree.erase(others, inTree.end());
  std::vector<NumberedBox> treeBoxes = boxesOf(soup, inTree, reach, context);
  if (treeBoxes.empty())
  {
    return {};
  }
  const std::vector<NumberedBox> otherBoxes = boxesAt(BoxRaster(treeBoxes), soup, rest, reach, context);
  const BoxTree tree(std::move(treeBoxes), context);
  ContactFinder finder(soup, static_cast<double>(reach));
  for (const Search& search :
       searchContacts(soup, tree, otherBoxes, isLeft, static_cast<double>(reach), clusters, context))
  {
    finder.append(search.finder);
  }
  return finder.take();
}

} // namespace atria
