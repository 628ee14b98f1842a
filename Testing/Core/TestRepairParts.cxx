// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts of the repair one by one: sides of planes, contacts, cuts, slivers, small parts, gaps and clusters.
#include "Grid/GridFrame.h"
#include "Grid/Predicates.h"
#include "Support/QuietContext.h"
#include "Surface/Repair/Clusters.h"
#include "Surface/Repair/ContactFinder.h"
#include "Surface/Repair/Contacts.h"
#include "Surface/Repair/GapClosing.h"
#include "Surface/Repair/PlaneSides.h"
#include "Surface/Repair/Slivers.h"
#include "Surface/Repair/SmallParts.h"
#include "Surface/Repair/TriangleCuts.h"
#include "Surface/Triangles/SoupParts.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::quietContext;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Triangle = std::array<Index, 3>;

class Draw
{
public:
  explicit Draw(unsigned seed) : random_(seed) {}

  std::int64_t in(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  Index below(std::size_t count) { return static_cast<Index>(in(0, static_cast<std::int64_t>(count) - 1)); }
  LatticePoint point(std::int64_t reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  Triangle triangle(std::size_t points) { return {below(points), below(points), below(points)}; }

private:
  std::mt19937 random_;
};

/// Adds a triangle with points and a source of its own.
Index addTriangle(TriangleSoup& soup, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
{
  const auto first = static_cast<Index>(soup.points.size());
  soup.points.insert(soup.points.end(), {a, b, c});
  const auto t = static_cast<Index>(soup.triangles.size());
  soup.add({first, first + 1, first + 2}, 0, t);
  return t;
}

Vec3 areaOf(const TriangleSoup& soup, Index t)
{
  return between(soup.corner(t, 0), soup.corner(t, 1)).cross(between(soup.corner(t, 0), soup.corner(t, 2)));
}

// Sides of planes.

/// The volume that p spans with a triangle; positive on its front.
Wide volumeOf(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& p)
{
  const auto minus = [&](const LatticePoint& q) { return std::array<Wide, 3>{q[0] - a[0], q[1] - a[1], q[2] - a[2]}; };
  const std::array<Wide, 3> u = minus(b);
  const std::array<Wide, 3> v = minus(c);
  const std::array<Wide, 3> w = minus(p);
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
}

Wide volumeOf(const TriangleSoup& soup, Index t, const LatticePoint& p)
{
  return volumeOf(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2), p);
}

/// Compares the sides of triangle 1 as seen from triangle 0 with exact ones.
void expectSides(const TriangleSoup& soup, double reach)
{
  const PlaneSides sides(soup, 1, 0, reach);
  const double length = areaOf(soup, 0).norm();
  int above = 0;
  int below = 0;
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    const Wide exact = volumeOf(soup, 0, soup.corner(1, i));
    EXPECT_TRUE(sides.exact(i) == exact);
    EXPECT_EQ(sides.sign(i), signOf(exact));
    const double distance = length > 0.0 ? static_cast<double>(exact) / length : 0.0;
    EXPECT_NEAR(sides.distance(i), distance, 0.0101);
    const bool isShared = contains(soup.triangles[0], soup.triangles[1].at(static_cast<std::size_t>(i)));
    shared += isShared ? 1 : 0;
    above += !isShared && distance > reach ? 1 : 0;
    below += !isShared && distance < -reach ? 1 : 0;
  }
  EXPECT_EQ(sides.apart(), shared < 3 && (above + shared == 3 || below + shared == 3));
}

TEST(PlaneSides, AreExactInSmallSoups)
{
  Draw draw(1);
  for (int round = 0; round < 5000; ++round)
  {
    TriangleSoup soup;
    for (int i = 0; i < 6; ++i)
    {
      soup.points.push_back(draw.point(4));
    }
    soup.add(draw.triangle(6), 0, 0);
    soup.add(draw.triangle(6), 0, 1);
    if (!hasRepeatedPoint(soup.triangles[0]) && !hasRepeatedPoint(soup.triangles[1]))
    {
      expectSides(soup, 0.9071); // no distance is the limit
    }
  }
}

TEST(PlaneSides, AreExactOneUnitOffALargePlane)
{
  Draw draw(2);
  const std::int64_t far = std::int64_t{1} << 34;
  for (int round = 0; round < 3000; ++round)
  {
    const LatticePoint a = draw.point(far);
    const LatticePoint u = draw.point(far);
    LatticePoint v = draw.point(round % 2 == 0 ? far : 3);
    std::ranges::transform(u, v, v.begin(), [&](auto l, auto r) { return round % 2 == 0 ? r : l / 2 + r; });
    const auto at = [&](std::int64_t i, std::int64_t j) {
      return LatticePoint{a[0] + i * u[0] + j * v[0], a[1] + i * u[1] + j * v[1], a[2] + i * u[2] + j * v[2]};
    };
    TriangleSoup soup;
    addTriangle(soup, at(0, 0), at(8, 0), at(0, 8));
    addTriangle(soup, at(1, 2), at(5, 1), at(2, 9));
    for (int i = 3; i < 6; ++i)
    {
      soup.points[static_cast<std::size_t>(i)][i % 3] += draw.in(-1, 1);
    }
    const PlaneSides sides(soup, 1, 0, 4.0);
    for (int i = 0; i < 3; ++i)
    {
      const Wide exact = volumeOf(soup, 0, soup.corner(1, i));
      EXPECT_EQ(sides.sign(i), signOf(exact));
      EXPECT_TRUE(sides.exact(i) == exact);
      EXPECT_LT(std::abs(sides.distance(i)), 1.02);
    }
    EXPECT_FALSE(sides.apart());
  }
}

TEST(PlaneSides, OfATriangleWithoutAreaAreZero)
{
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {10, 20, 30}, {20, 40, 60});
  addTriangle(soup, {5, 900, 0}, {7, 800, 1}, {-9, 500, 3});
  const PlaneSides sides(soup, 1, 0, 4.0);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(sides.distance(i), 0.0);
    EXPECT_EQ(sides.sign(i), 0);
  }
  EXPECT_FALSE(sides.apart());
}

TEST(PlaneSides, AreApartBeyondTheReach)
{
  for (const std::int64_t height : {-11, -10, -9, 0, 9, 10, 11})
  {
    TriangleSoup soup;
    addTriangle(soup, {0, 0, 0}, {100, 0, 0}, {0, 100, 0});
    addTriangle(soup, {10, 10, height}, {20, 10, 20 * height}, {10, 20, 30 * height});
    EXPECT_EQ(PlaneSides(soup, 1, 0, 10.0).apart(), std::abs(height) > 10) << height;
    soup.triangles[1][0] = 0; // a common corner
    EXPECT_EQ(PlaneSides(soup, 1, 0, 10.0).apart(), height != 0) << height;
    soup.points[4] = {20, 10, -20 * height};
    EXPECT_FALSE(PlaneSides(soup, 1, 0, 10.0).apart()) << height;
  }
}

TEST(PlaneSides, PassageIsWhereTheEdgeMeetsThePlane)
{
  Draw draw(3);
  int passing = 0;
  for (int round = 0; round < 3000; ++round)
  {
    TriangleSoup soup;
    addTriangle(soup, draw.point(5000), draw.point(5000), draw.point(5000));
    addTriangle(soup, draw.point(5000), draw.point(5000), draw.point(5000));
    const PlaneSides sides(soup, 1, 0, 4.0);
    for (int i = 0; i < 3; ++i)
    {
      const int next = (i + 1) % 3;
      if (sides.sign(i) * sides.sign(next) >= 0)
      {
        continue;
      }
      const PlaneSides::Passage passage = sides.passage(i, next);
      const auto begin = static_cast<double>(sides.exact(i));
      const auto end = static_cast<double>(sides.exact(next));
      const Vec3 expected =
          toVector(soup.corner(1, i)) + begin / (begin - end) * between(soup.corner(1, i), soup.corner(1, next));
      EXPECT_LT((passage.at - expected).norm(), passage.error);
      EXPECT_LT((passage.at - expected).norm(), 1e-3) << "these planes meet the edges in definite points";
      const double rise = std::abs(sides.distance(i) - sides.distance(next));
      EXPECT_NEAR(passage.error * rise, 0.02 * between(soup.corner(1, i), soup.corner(1, next)).norm(), 1e-6);
      ++passing;
    }
  }
  EXPECT_GT(passing, 1000);
}

// Contacts. The reference works on a grid of 3 x 3 x 3 points, in integers.

constexpr std::int64_t step = 1000000;
constexpr std::int64_t reach = 4;

/// An edge and a place on it, or a triangle and a place on it (and then noIndex).
using Contact = std::tuple<Index, Index, Vec3>;

bool isNear(const Contact& l, const Contact& r)
{
  return std::get<0>(l) == std::get<0>(r) && std::get<1>(l) == std::get<1>(r) &&
         (std::get<2>(l) - std::get<2>(r)).lpNorm<Eigen::Infinity>() <= 2.0;
}

bool hasNear(const std::vector<Contact>& list, const Contact& contact)
{
  return std::ranges::any_of(list, [&](const Contact& other) { return isNear(other, contact); });
}

LatticePoint gridPoint(Index p) { return {p % 3, p / 3 % 3, p / 9}; }

LatticePoint minus(const LatticePoint& l, const LatticePoint& r) { return {l[0] - r[0], l[1] - r[1], l[2] - r[2]}; }
LatticePoint cross(const LatticePoint& l, const LatticePoint& r)
{
  return {l[1] * r[2] - l[2] * r[1], l[2] * r[0] - l[0] * r[2], l[0] * r[1] - l[1] * r[0]};
}
std::int64_t dot(const LatticePoint& l, const LatticePoint& r) { return l[0] * r[0] + l[1] * r[1] + l[2] * r[2]; }
LatticePoint times(std::int64_t factor, const LatticePoint& p) { return {factor * p[0], factor * p[1], factor * p[2]}; }

/// True if p is on the way from a to b, and neither of them.
bool isOnEdge(const LatticePoint& p, const LatticePoint& a, const LatticePoint& b)
{
  const std::int64_t along = dot(minus(b, a), minus(p, a));
  return cross(minus(b, a), minus(p, a)) == LatticePoint{} && along > 0 && along < dot(minus(b, a), minus(b, a));
}

/// True if p is within the triangle, off its edges.
bool isWithin(const LatticePoint& p, const std::array<LatticePoint, 3>& t)
{
  const LatticePoint normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const auto isLeft = [&](const LatticePoint& a, const LatticePoint& b) {
    return dot(cross(minus(b, a), minus(p, a)), normal) > 0;
  };
  return dot(normal, minus(p, t[0])) == 0 && isLeft(t[0], t[1]) && isLeft(t[1], t[2]) && isLeft(t[2], t[0]);
}

/// Collects the contacts of two triangles whose points are on the grid.
class NaiveContacts
{
public:
  NaiveContacts(const std::vector<Triangle>& triangles, Index a, Index b) : triangles_(triangles)
  {
    addCorners(a, b);
    addCorners(b, a);
    addPassages(a, b);
    addPassages(b, a);
    addCrossings(a, b);
  }

  std::vector<Contact> list;

private:
  std::array<LatticePoint, 3> placesOf(Index t, std::int64_t scale) const
  {
    const Triangle& corners = triangles_[t];
    return {times(scale, gridPoint(corners[0])), times(scale, gridPoint(corners[1])),
            times(scale, gridPoint(corners[2]))};
  }

  void add(const EdgeKey& edge, const Vec3& place) { list.emplace_back(edge.first, edge.second, place * step); }
  void add(Index t, const Vec3& place) { list.emplace_back(t, noIndex, place * step); }

  void addCorners(Index of, Index on)
  {
    for (const Index p : triangles_[of])
    {
      if (!contains(triangles_[on], p))
      {
        addPlace(gridPoint(p), 1, on);
      }
    }
  }

  /// Adds the place p / scale if it lies on an edge of the triangle or within. Returns true if it does.
  bool addPlace(const LatticePoint& p, std::int64_t scale, Index on)
  {
    const std::array<LatticePoint, 3> corners = placesOf(on, scale);
    const Vec3 place = toVector(p) / static_cast<double>(scale);
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (isOnEdge(p, corners.at(i), corners.at((i + 1) % 3)))
      {
        add(edgeKey(triangles_[on], static_cast<int>(i)), place);
        return true;
      }
    }
    if (isWithin(p, corners))
    {
      add(on, place);
      return true;
    }
    return false;
  }

  /// Adds the edges of a triangle that pass through the plane of the other within it.
  void addPassages(Index of, Index through)
  {
    const std::array<LatticePoint, 3> t = placesOf(through, 1);
    for (int i = 0; i < 3; ++i)
    {
      const EdgeKey edge = edgeKey(triangles_[of], i);
      const LatticePoint a = gridPoint(edge.first);
      const LatticePoint b = gridPoint(edge.second);
      const LatticePoint normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
      std::int64_t begin = dot(normal, minus(a, t[0]));
      std::int64_t end = dot(normal, minus(b, t[0]));
      if (begin * end >= 0)
      {
        continue;
      }
      const std::int64_t sign = begin > 0 ? 1 : -1;
      const std::int64_t scale = sign * (begin - end);
      LatticePoint p = times(sign * begin, minus(b, a));
      const LatticePoint from = times(scale, a);
      std::ranges::transform(p, from, p.begin(), std::plus<>());
      if (addPlace(p, scale, through))
      {
        add(edge, toVector(p) / static_cast<double>(scale));
      }
    }
  }

  /// Adds the places where edges cross.
  void addCrossings(Index first, Index second)
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        addCrossing(edgeKey(triangles_[first], i), edgeKey(triangles_[second], j));
      }
    }
  }

  void addCrossing(const EdgeKey& e, const EdgeKey& f)
  {
    const LatticePoint a = gridPoint(e.first);
    const LatticePoint b = gridPoint(e.second);
    const LatticePoint c = gridPoint(f.first);
    const LatticePoint d = gridPoint(f.second);
    const LatticePoint normal = cross(minus(b, a), minus(d, c));
    if (normal == LatticePoint{} || dot(normal, minus(c, a)) != 0)
    {
      return;
    }
    const auto side = [&](const LatticePoint& from, const LatticePoint& to, const LatticePoint& p) {
      return dot(cross(minus(to, from), minus(p, from)), normal);
    };
    const std::int64_t ofA = side(c, d, a);
    const std::int64_t ofB = side(c, d, b);
    if (ofA * ofB < 0 && side(a, b, c) * side(a, b, d) < 0)
    {
      const Vec3 place = toVector(a) + static_cast<double>(ofA) / static_cast<double>(ofA - ofB) * between(a, b);
      add(e, place);
      add(f, place);
    }
  }

  const std::vector<Triangle>& triangles_;
};

TriangleSoup gridSoup(Draw& draw, std::size_t count)
{
  TriangleSoup soup;
  for (Index p = 0; p < 27; ++p)
  {
    soup.points.push_back(times(step, gridPoint(p)));
  }
  while (soup.triangles.size() < count)
  {
    const Triangle t = draw.triangle(27);
    soup.add(t, 0, static_cast<Index>(soup.triangles.size()));
    if (!(areaOf(soup, static_cast<Index>(soup.triangles.size() - 1)).norm() > 0.0))
    {
      soup.triangles.pop_back();
      soup.surfaceIds.pop_back();
      soup.sources.pop_back();
    }
  }
  return soup;
}

/// Returns contacts by place, but those at ends of their edge, and those on a triangle that are on its edge or corner.
template <typename Found> std::vector<Contact> byPlace(const TriangleSoup& soup, const Found& found)
{
  const auto placeOf = [&](Index p) {
    return toVector(p < soup.points.size() ? soup.points[p] : found.newPoints[p - soup.points.size()]);
  };
  std::vector<Contact> list;
  for (const EdgeContact& c : found.edges)
  {
    const Contact contact(c.edge.first, c.edge.second, placeOf(c.point));
    if (!isNear(contact, {c.edge.first, c.edge.second, placeOf(c.edge.first)}) &&
        !isNear(contact, {c.edge.first, c.edge.second, placeOf(c.edge.second)}))
    {
      list.push_back(contact);
    }
  }
  const std::vector<Contact> onEdges = list;
  for (const FaceContact& c : found.faces)
  {
    const Contact contact(c.triangle, noIndex, placeOf(c.point));
    bool isOutline = false;
    for (int i = 0; i < 3; ++i)
    {
      const EdgeKey edge = edgeKey(soup.triangles[c.triangle], i);
      isOutline = isOutline || isNear(contact, {c.triangle, noIndex, placeOf(edge.first)}) ||
                  isNear(contact, {c.triangle, noIndex, placeOf(edge.second)}) ||
                  hasNear(onEdges, {edge.first, edge.second, placeOf(c.point)});
    }
    if (!isOutline)
    {
      list.push_back(contact);
    }
  }
  return list;
}

void expectSame(const std::vector<Contact>& found, const std::vector<Contact>& expected)
{
  EXPECT_TRUE(std::ranges::all_of(expected, [&](const Contact& c) { return hasNear(found, c); })) << "one is missing";
  EXPECT_TRUE(std::ranges::all_of(found, [&](const Contact& c) { return hasNear(expected, c); })) << "one is too many";
}

TEST(ContactFinder, FindsCornersCrossingsAndPassagesOfTriangles)
{
  Draw draw(4);
  std::size_t contacts = 0;
  for (int round = 0; round < 6000; ++round)
  {
    const TriangleSoup soup = gridSoup(draw, 2);
    ContactFinder finder(soup, static_cast<double>(reach));
    finder.look(0, 1);
    const FoundContacts found = finder.take();
    const NaiveContacts expected(soup.triangles, 0, 1);
    expectSame(byPlace(soup, found), expected.list);
    contacts += expected.list.size();
    ASSERT_EQ(found.pairs.size(), found.edges.empty() && found.faces.empty() ? 0u : 1u);
    if (!found.pairs.empty())
    {
      EXPECT_EQ(found.pairs[0].first, 0u);
      EXPECT_EQ(found.pairs[0].second, 1u);
      EXPECT_EQ(found.pairs[0].edgesBegin, 0u);
      EXPECT_EQ(found.pairs[0].edgesEnd, found.edges.size());
      EXPECT_EQ(found.pairs[0].facesBegin, 0u);
      EXPECT_EQ(found.pairs[0].facesEnd, found.faces.size());
    }
  }
  EXPECT_GT(contacts, 3000u);
}

TEST(ContactFinder, FindsTheSameWhicheverTriangleComesFirst)
{
  Draw draw(5);
  for (int round = 0; round < 500; ++round)
  {
    const TriangleSoup soup = gridSoup(draw, 2);
    ContactFinder finder(soup, static_cast<double>(reach));
    ContactFinder other(soup, static_cast<double>(reach));
    finder.look(0, 1);
    other.look(1, 0);
    const Contacts found = finder.take().sorted(soup);
    const Contacts turned = other.take().sorted(soup);
    EXPECT_EQ(found.edges, turned.edges);
    EXPECT_EQ(found.faces, turned.faces);
    EXPECT_EQ(found.newPoints, turned.newPoints);
    EXPECT_EQ(found.pairs, turned.pairs);
  }
}

TEST(ContactFinder, FindsACornerWithinTheReachOfAFaceOrEdge)
{
  for (const std::int64_t height : {-5, -4, 4, 5})
  {
    TriangleSoup soup;
    addTriangle(soup, {0, 0, 0}, {90000, 0, 0}, {0, 90000, 0});
    const bool isUp = height > 0;
    addTriangle(soup, {20000, 20000, height}, {21000, 20000, isUp ? 9000 : -9000}, {20000, 21000, isUp ? 9000 : -9000});
    const auto look = [&] {
      ContactFinder finder(soup, static_cast<double>(reach));
      finder.look(0, 1);
      return finder.take();
    };
    const FoundContacts onFace = look();
    EXPECT_EQ(onFace.faces, std::abs(height) <= 4 ? (std::vector<FaceContact>{{0, 3}}) : std::vector<FaceContact>{});
    EXPECT_THAT(onFace.edges, IsEmpty());
    soup.points[3] = {20000, 0, height};
    const FoundContacts onEdge = look();
    EXPECT_EQ(onEdge.edges,
              std::abs(height) <= 4 ? (std::vector<EdgeContact>{{{0, 1}, 3}}) : std::vector<EdgeContact>{});
    EXPECT_THAT(onEdge.faces, IsEmpty());
  }
}

TEST(ContactFinder, FindsTheCornerOnTheLongEdgeOfASliver)
{
  for (const std::int64_t width : {0, 4, 5})
  {
    for (int turn = 0; turn < 3; ++turn)
    {
      TriangleSoup soup;
      addTriangle(soup, {0, 0, 0}, {1000, 0, 0}, {400, 0, width});
      std::rotate(soup.triangles[0].begin(), soup.triangles[0].begin() + turn, soup.triangles[0].end());
      ContactFinder finder(soup, static_cast<double>(reach));
      finder.look(0);
      const FoundContacts found = finder.take();
      EXPECT_EQ(found.edges, width <= 4 ? (std::vector<EdgeContact>{{{0, 1}, 2}}) : std::vector<EdgeContact>{});
      EXPECT_THAT(found.faces, IsEmpty());
      EXPECT_THAT(found.pairs, IsEmpty());
    }
  }
}

TEST(ContactFinder, AppendsTheResultsOfOthers)
{
  Draw draw(6);
  const TriangleSoup soup = gridSoup(draw, 30);
  ContactFinder all(soup, static_cast<double>(reach));
  ContactFinder joined(soup, static_cast<double>(reach));
  for (Index a = 0; a < 30; ++a)
  {
    ContactFinder some(soup, static_cast<double>(reach));
    for (Index b = 0; b < a; ++b)
    {
      all.look(a, b);
      some.look(a, b);
    }
    joined.append(some);
  }
  const FoundContacts expected = all.take();
  const FoundContacts found = joined.take();
  EXPECT_EQ(found.newPoints, expected.newPoints);
  EXPECT_EQ(found.edges, expected.edges);
  EXPECT_EQ(found.faces, expected.faces);
  const auto isSame = [](const FoundContacts::Pair& l, const FoundContacts::Pair& r) {
    return std::tie(l.first, l.second, l.edgesBegin, l.edgesEnd, l.facesBegin, l.facesEnd) ==
           std::tie(r.first, r.second, r.edgesBegin, r.edgesEnd, r.facesBegin, r.facesEnd);
  };
  EXPECT_TRUE(std::ranges::equal(found.pairs, expected.pairs, isSame));
  EXPECT_GT(found.newPoints.size(), 10u);
}

TEST(Contacts, MarkTheBeginsOfEdgesWithPoints)
{
  const std::vector<EdgeContact> contacts{{{0, 3}, 9}, {{0, 4}, 9}, {{2, 4}, 1}};
  EXPECT_THAT(beginsOfEdges(contacts, 5), ElementsAre(1, 0, 1, 0, 0));
  EXPECT_THAT(beginsOfEdges({}, 2), ElementsAre(0, 0));
}

/// Contacts of the pairs (0, 1), (1, 2) and (0, 3) of a soup of ten points. One contact belongs to no pair.
FoundContacts someContacts()
{
  FoundContacts found;
  found.newPoints = {{9, 0, 0}, {1, 0, 0}, {9, 0, 0}};
  found.edges = {{{7, 8}, 2}, {{1, 2}, 10}, {{3, 4}, 11}, {{1, 2}, 12}, {{5, 6}, 0}};
  found.faces = {{1, 10}, {0, 12}, {3, 5}};
  found.pairs = {{0, 1, 1, 3, 0, 1}, {1, 2, 3, 4, 1, 2}, {0, 3, 4, 5, 2, 3}};
  return found;
}

TriangleSoup soupOfTenPoints()
{
  TriangleSoup soup;
  soup.points.resize(10);
  soup.triangles.resize(4, {0, 1, 2});
  soup.sources = {0, 1, 1, 4};
  return soup;
}

TEST(Contacts, AreSortedWithoutRepeatsAndNumberPointsByPlace)
{
  const Contacts contacts = someContacts().sorted(soupOfTenPoints());
  EXPECT_THAT(contacts.newPoints, ElementsAre(LatticePoint{1, 0, 0}, LatticePoint{9, 0, 0}));
  EXPECT_EQ(contacts.edges, (std::vector<EdgeContact>{{{1, 2}, 11}, {{3, 4}, 10}, {{5, 6}, 0}, {{7, 8}, 2}}));
  EXPECT_EQ(contacts.faces, (std::vector<FaceContact>{{0, 11}, {1, 11}, {3, 5}}));
  EXPECT_THAT(contacts.pairs, ElementsAre(std::pair(0, 1), std::pair(0, 3), std::pair(1, 2)));
  EXPECT_FALSE(contacts.empty());
  EXPECT_TRUE(Contacts{}.empty());
}

TEST(Contacts, LeaveOutPairsOfSourcesThatAreLeft)
{
  const TriangleSoup soup = soupOfTenPoints();
  const FoundContacts found = someContacts();
  const Contacts contacts = found.sorted(soup, {0, 1, 0, 0, 0}); // pair (1, 2) is of source 1 alone
  EXPECT_THAT(contacts.newPoints, ElementsAre(LatticePoint{1, 0, 0}, LatticePoint{9, 0, 0}));
  EXPECT_EQ(contacts.edges, (std::vector<EdgeContact>{{{1, 2}, 11}, {{3, 4}, 10}, {{5, 6}, 0}, {{7, 8}, 2}}));
  EXPECT_EQ(contacts.faces, (std::vector<FaceContact>{{1, 11}, {3, 5}}));
  EXPECT_THAT(contacts.pairs, ElementsAre(std::pair(0, 1), std::pair(0, 3)));
  const Contacts few = found.sorted(soup, {1, 1, 0, 0, 0});
  EXPECT_EQ(few.edges, (std::vector<EdgeContact>{{{5, 6}, 0}, {{7, 8}, 2}}));
  EXPECT_EQ(few.faces, (std::vector<FaceContact>{{3, 5}}));
  EXPECT_THAT(few.newPoints, IsEmpty());
}

TEST(Contacts, CountThoseThatAreLeftWithoutRepeats)
{
  const TriangleSoup soup = soupOfTenPoints();
  const FoundContacts found = someContacts();
  EXPECT_EQ(found.countLeft(soup, {}), 0u);
  EXPECT_EQ(found.countLeft(soup, {0, 1, 0, 0, 1}), 2u) << "an edge and a face of pair (1, 2)";
  EXPECT_EQ(found.countLeft(soup, {1, 1, 0, 0, 0}), 4u) << "two edges and two faces: one edge is repeated";
  EXPECT_EQ(found.countLeft(soup, {1, 1, 0, 0, 1}), 6u);
}

TEST(MetSources, HoldPairsWhicheverComesFirst)
{
  Draw draw(7);
  TriangleSoup soup;
  for (Index t = 0; t < 40; ++t)
  {
    soup.add({0, 1, 2}, 0, t / 2);
  }
  MetSources met;
  EXPECT_FALSE(met.contains(0, 1));
  std::set<std::pair<Index, Index>> expected;
  for (const std::size_t count : {0u, 1u, 5u, 60u})
  {
    std::vector<FoundContacts::Pair> pairs;
    for (std::size_t i = 0; i < count; ++i)
    {
      pairs.push_back({draw.below(40), draw.below(40), 0, 0, 0, 0});
      const Index first = pairs.back().first / 2;
      const Index second = pairs.back().second / 2;
      expected.emplace(std::min(first, second), std::max(first, second));
    }
    met.add(soup, pairs);
    for (Index a = 0; a < 22; ++a)
    {
      for (Index b = 0; b < 22; ++b)
      {
        EXPECT_EQ(met.contains(a, b), expected.contains({std::min(a, b), std::max(a, b)})) << a << ' ' << b;
      }
    }
  }
}

TEST(AskedPairs, AreThoseThatMovedOrWereCutAndHaveMet)
{
  TriangleSoup soup;
  for (Index t = 0; t < 6; ++t)
  {
    soup.add({0, 1, 2}, 0, t / 2);
  }
  const std::vector<Change> changes{Change::moved, Change::none, Change::cut, Change::cut, Change::cut, Change::none};
  MetSources met;
  met.add(soup, {{2, 4, 0, 0, 0, 0}}); // sources 1 and 2
  const std::vector<char> none;
  const AskedPairs asked{changes, met, none};
  const std::vector<std::tuple<Index, Index, bool>> cases{{0, 1, false}, {0, 2, true},  {2, 0, true},
                                                          {0, 5, true},  {1, 2, false}, {2, 4, true},
                                                          {4, 3, true},  {2, 3, false}, {1, 5, false}};
  for (const auto& [a, b, expected] : cases)
  {
    EXPECT_EQ(asked.contains(soup, a, b), expected) << a << ' ' << b;
  }
  const std::vector<char> isLeft{0, 1, 1};
  const AskedPairs fewer{changes, met, isLeft};
  EXPECT_FALSE(fewer.contains(soup, 2, 4));
  EXPECT_TRUE(fewer.contains(soup, 0, 2)) << "only one is left";
}

/// Looks at all pairs.
Contacts naiveContacts(const TriangleSoup& soup, const AskedPairs& asked)
{
  ContactFinder finder(soup, static_cast<double>(reach));
  for (Index a = 0; a < soup.triangles.size(); ++a)
  {
    if (asked.changes[a] != Change::none)
    {
      finder.look(a);
    }
    for (Index b = 0; b < a; ++b)
    {
      if (asked.contains(soup, a, b) && (asked.changes[a] != Change::none || asked.changes[b] != Change::none))
      {
        finder.look(b, a);
      }
    }
  }
  return finder.take().sorted(soup);
}

TEST(Contacts, AreFoundAmongAllAskedPairs)
{
  Draw draw(8);
  const ThreadExecutor executor(2);
  const ClusterCells clusters;
  for (int round = 0; round < 30; ++round)
  {
    TriangleSoup soup = gridSoup(draw, 40);
    std::vector<Change> changes;
    for (std::size_t t = 0; t < 40; ++t)
    {
      soup.sources[t] = static_cast<Index>(t * 2 / 3);
      changes.push_back(round % 3 == 0 ? Change::moved : static_cast<Change>(draw.in(0, 2)));
    }
    MetSources met;
    met.add(soup, {{1, 30, 0, 0, 0, 0}, {4, 5, 0, 0, 0, 0}, {2, 18, 0, 0, 0, 0}, {9, 27, 0, 0, 0, 0}});
    std::vector<char> isLeft(27, 0);
    std::ranges::generate(isLeft, [&] { return static_cast<char>(draw.in(0, 5) == 0); });
    const AskedPairs asked{changes, met, isLeft};
    const Contacts expected = naiveContacts(soup, asked);
    const Contacts found = findContacts(soup, asked, reach, clusters, quietContext(executor)).sorted(soup);
    EXPECT_EQ(found.newPoints, expected.newPoints);
    EXPECT_EQ(found.edges, expected.edges);
    EXPECT_EQ(found.faces, expected.faces);
    EXPECT_EQ(found.pairs, expected.pairs);
  }
}

TEST(Contacts, OfUnchangedTrianglesAreNone)
{
  Draw draw(9);
  const TriangleSoup soup = gridSoup(draw, 20);
  const std::vector<Change> changes(20, Change::none);
  const MetSources met;
  const FoundContacts found = findContacts(soup, {changes, met, {}}, reach, {}, quietContext());
  EXPECT_TRUE(found.edges.empty() && found.faces.empty() && found.pairs.empty());
}

TEST(Contacts, OfHiddenTrianglesAreNone)
{
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {9000, 0, 0}, {0, 9000, 0});
  addTriangle(soup, {1000, 1000, -500}, {1200, 1000, 500}, {1000, 1200, 500});
  const std::vector<Change> changes(2, Change::moved);
  const MetSources met;
  ClusterCells clusters;
  EXPECT_FALSE(findContacts(soup, {changes, met, {}}, reach, clusters, quietContext()).edges.empty());
  clusters.hide(1);
  EXPECT_TRUE(findContacts(soup, {changes, met, {}}, reach, clusters, quietContext()).edges.empty());
}

// Slivers.

/// Adds points to the edges of the slivers until nothing changes.
std::set<EdgeContact> naiveAligned(const TriangleSoup& soup, const std::vector<EdgeContact>& contacts)
{
  const std::set<EdgeContact> given(contacts.begin(), contacts.end());
  std::set<EdgeContact> all = given;
  for (std::size_t before = 0; before != all.size();)
  {
    before = all.size();
    for (const Triangle& t : soup.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        const EdgeKey edge = edgeKey(t, i);
        const Index apex = t.at(static_cast<std::size_t>((i + 2) % 3));
        if (!all.contains({edge, apex}) || !given.contains({edge, apex}))
        {
          continue;
        }
        for (const EdgeContact& c : std::set<EdgeContact>(all))
        {
          const bool isBefore = std::abs(soup.points[c.point][0] - soup.points[edge.first][0]) <
                                std::abs(soup.points[apex][0] - soup.points[edge.first][0]);
          const EdgeKey part = isBefore ? edgeKey(edge.first, apex) : edgeKey(edge.second, apex);
          if (c.edge == edge && c.point != apex)
          {
            all.insert({part, c.point});
          }
          if (c.edge == edgeKey(edge.first, apex) || c.edge == edgeKey(edge.second, apex))
          {
            all.insert({edge, c.point});
          }
        }
      }
    }
  }
  return all;
}

/// Points in a row, in a random order, and triangles between them. Some have a corner on their long edge as a contact.
void drawSlivers(Draw& draw, TriangleSoup& soup, std::vector<EdgeContact>& contacts)
{
  std::vector<std::int64_t> places(12);
  std::iota(places.begin(), places.end(), 0);
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
  {
    std::swap(places[i], places[i + draw.below(places.size() - i)]);
  }
  std::ranges::for_each(places, [&](std::int64_t x) { soup.points.push_back({100 * x, 50 * x, 0}); });
  std::set<EdgeContact> drawn;
  for (Index i = 0; i < 4; ++i)
  {
    Triangle t = draw.triangle(12);
    if (hasRepeatedPoint(t))
    {
      continue;
    }
    soup.add(t, 0, i);
    std::ranges::sort(t, {}, [&](Index p) { return places[p]; });
    if (draw.in(0, 3) > 0)
    {
      drawn.insert({edgeKey(t[0], t[2]), t[1]});
    }
    for (Index p = 0; p < 12; ++p)
    {
      const std::size_t side = draw.below(2);
      if (draw.in(0, 3) == 0 && places[p] > places[t.at(side)] && places[p] < places[t.at(side + 1)])
      {
        drawn.insert({edgeKey(t.at(side), t.at(side + 1)), p});
      }
    }
  }
  contacts.assign(drawn.begin(), drawn.end());
}

TEST(Slivers, HaveTheSamePointsOnTheLongEdgeAsOnTheOthers)
{
  Draw draw(10);
  std::size_t added = 0;
  for (int round = 0; round < 1000; ++round)
  {
    TriangleSoup soup;
    std::vector<EdgeContact> contacts;
    drawSlivers(draw, soup, contacts);
    const std::set<EdgeContact> expected = naiveAligned(soup, contacts);
    added += expected.size() - contacts.size();
    alignSlivers(soup, contacts);
    EXPECT_TRUE(std::ranges::equal(contacts, expected));
  }
  EXPECT_GT(added, 500u);
}

TEST(Slivers, TakePointsFromTheLongEdgeAndGivePointsToIt)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {100, 0, 0}, {50, 0, 0}, {20, 0, 0}, {70, 0, 0}, {80, 0, 0}};
  soup.add({0, 1, 2}, 0, 0);
  std::vector<EdgeContact> contacts{{{0, 1}, 2}, {{0, 1}, 3}, {{0, 1}, 4}, {{1, 2}, 5}};
  alignSlivers(soup, contacts);
  EXPECT_EQ(contacts, (std::vector<EdgeContact>{
                          {{0, 1}, 2}, {{0, 1}, 3}, {{0, 1}, 4}, {{0, 1}, 5}, {{0, 2}, 3}, {{1, 2}, 4}, {{1, 2}, 5}}));
}

TEST(Slivers, LeaveOtherTrianglesAlone)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {100, 0, 0}, {50, 80, 0}, {20, 0, 0}};
  soup.add({0, 1, 2}, 0, 0);
  const std::vector<EdgeContact> before{{{0, 1}, 3}};
  std::vector<EdgeContact> contacts = before;
  alignSlivers(soup, contacts);
  EXPECT_EQ(contacts, before);
}

// Cuts.

struct Cut
{
  std::vector<Change> changes;
  std::vector<char> isSplit;
  std::set<EdgeKey> meetings;
};

void cut(TriangleSoup& soup, const Contacts& contacts, Cut& out)
{
  out.isSplit.resize(soup.sources.back() + 1, 0);
  cutTriangles(soup, contacts, static_cast<double>(reach), out.changes, out.isSplit, out.meetings, quietContext());
}

TEST(TriangleCuts, DivideATriangleAtPointsOnAnEdge)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {90000, 0, 0}, {0, 90000, 0}, {60000, 0, 0}, {30000, 0, 0}, {90000, 90000, 0}};
  soup.add({2, 1, 0}, 3, 2);
  soup.add({1, 5, 2}, 4, 5);
  Contacts contacts;
  contacts.edges = {{{0, 1}, 3}, {{0, 1}, 4}};
  Cut result;
  result.meetings = {{0, 1}, {1, 2}};
  cut(soup, contacts, result);
  ASSERT_EQ(soup.triangles.size(), 4u);
  EXPECT_THAT(soup.sources, ElementsAre(2, 2, 2, 5));
  EXPECT_THAT(soup.surfaceIds, ElementsAre(3, 3, 3, 4));
  EXPECT_THAT(result.changes, ElementsAre(Change::cut, Change::cut, Change::cut, Change::none));
  EXPECT_THAT(result.isSplit, ElementsAre(0, 0, 1, 0, 0, 0));
  EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(0, 4), EdgeKey(1, 2), EdgeKey(1, 3), EdgeKey(3, 4)));
  EXPECT_EQ(soup.triangles[3], (Triangle{1, 5, 2}));
  for (Index t = 0; t < 3; ++t)
  {
    EXPECT_TRUE(contains(soup.triangles[t], 2)) << "all pieces reach the opposite corner";
    EXPECT_LT(areaOf(soup, t)[2], 0.0) << "they are wound as before";
  }
}

TEST(TriangleCuts, DivideATriangleAtAPointInIt)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {90000, 0, 0}, {0, 90000, 0}, {20000, 20000, 0}};
  soup.add({0, 1, 2}, 0, 0);
  soup.add({2, 1, 0}, 0, 1);
  Contacts contacts;
  contacts.faces = {{1, 3}};
  Cut result;
  result.meetings = {{0, 1}};
  cut(soup, contacts, result);
  EXPECT_EQ(soup.triangles.size(), 4u);
  EXPECT_THAT(result.changes, ElementsAre(Change::none, Change::cut, Change::cut, Change::cut));
  EXPECT_THAT(result.isSplit, ElementsAre(0, 1));
  EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(0, 1)));
  for (Index t = 1; t < 4; ++t)
  {
    EXPECT_TRUE(contains(soup.triangles[t], 3));
  }
}

TEST(TriangleCuts, WithoutContactsChangeNothing)
{
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {90, 0, 0}, {0, 90, 0});
  const TriangleSoup before = soup;
  Cut result;
  result.changes = {Change::moved};
  cut(soup, {}, result);
  EXPECT_EQ(soup.triangles, before.triangles);
  EXPECT_EQ(soup.points, before.points);
  EXPECT_THAT(result.changes, ElementsAre(Change::none));
  EXPECT_THAT(result.isSplit, ElementsAre(0));
}

/// Returns the edges of the pieces of a source.
std::set<EdgeKey> edgesOf(const TriangleSoup& soup, Index source)
{
  std::set<EdgeKey> edges;
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    for (int i = 0; i < 3 && soup.sources[t] == source; ++i)
    {
      edges.insert(edgeKey(soup.triangles[t], i));
    }
  }
  return edges;
}

TEST(TriangleCuts, TrianglesThatCrossShareTheirLineAndKeepTheirAreas)
{
  Draw draw(11);
  const std::vector<Change> changes(2, Change::moved);
  const MetSources met;
  int crossing = 0;
  for (int round = 0; round < 300; ++round)
  {
    TriangleSoup soup;
    addTriangle(soup, draw.point(100000), draw.point(100000), draw.point(100000));
    addTriangle(soup, draw.point(100000), draw.point(100000), draw.point(100000));
    const std::array<Vec3, 2> areas{areaOf(soup, 0), areaOf(soup, 1)};
    const Contacts contacts = findContacts(soup, {changes, met, {}}, reach, {}, quietContext()).sorted(soup);
    if (contacts.newPoints.size() != 2 || contacts.pairs.size() != 1 ||
        between(contacts.newPoints[0], contacts.newPoints[1]).norm() < 5000.0)
    {
      continue;
    }
    ++crossing;
    soup.points.insert(soup.points.end(), contacts.newPoints.begin(), contacts.newPoints.end());
    Cut result;
    cut(soup, contacts, result);
    EXPECT_THAT(result.changes, Each(Change::cut));
    EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(6, 7)));
    std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      sums.at(soup.sources[t]) += areaOf(soup, t);
      EXPECT_GT(areaOf(soup, t).dot(areas.at(soup.sources[t])), 0.0);
    }
    for (const Index source : {0u, 1u})
    {
      EXPECT_LT((sums.at(source) - areas.at(source)).norm(), 1e-3 * areas.at(source).norm());
      EXPECT_TRUE(edgesOf(soup, source).contains(EdgeKey(6, 7))) << round;
    }
  }
  EXPECT_GT(crossing, 30);
}

TEST(TriangleCuts, JoinACornerWithAPointOnTheOppositeEdge)
{
  // Triangle 1 cuts triangle 0 from their common corner to the middle of its opposite edge. Another point near the cut
  // would keep the two apart if the cut were no segment.
  for (int turn = 0; turn < 3; ++turn)
  {
    TriangleSoup soup;
    soup.points = {{0, 0, 0},         {90000, 0, 0},    {0, 90000, 0}, {90000, 90000, -50000}, {90000, 90000, 50000},
                   {45000, 45000, 0}, {24000, 21000, 0}};
    soup.add({0, 1, 2}, 0, 0);
    soup.add({0, 3, 4}, 0, 1);
    std::rotate(soup.triangles[0].begin(), soup.triangles[0].begin() + turn, soup.triangles[0].end());
    Contacts contacts;
    contacts.edges = {{{1, 2}, 5}};
    contacts.faces = {{0, 6}, {1, 5}};
    contacts.pairs = {{0, 1}};
    Cut result;
    cut(soup, contacts, result);
    EXPECT_THAT(result.meetings, ElementsAre(EdgeKey(0, 5)));
    EXPECT_TRUE(edgesOf(soup, 0).contains(EdgeKey(0, 5))) << turn;
    EXPECT_TRUE(edgesOf(soup, 1).contains(EdgeKey(0, 5))) << turn;
  }
}

TEST(TriangleCuts, MakeEdgesOfTheOutlineOfAnOverlap)
{
  // Two triangles in one plane overlap in a hexagon.
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {90000, 0, 0}, {45000, 90000, 0});
  addTriangle(soup, {0, 60000, 0}, {45000, -30000, 0}, {90000, 60000, 0});
  const std::vector<Change> changes(2, Change::moved);
  const MetSources met;
  const Contacts contacts = findContacts(soup, {changes, met, {}}, reach, {}, quietContext()).sorted(soup);
  ASSERT_EQ(contacts.newPoints.size(), 6u);
  soup.points.insert(soup.points.end(), contacts.newPoints.begin(), contacts.newPoints.end());
  Cut result;
  cut(soup, contacts, result);
  // Points 6 to 11 are sorted by x: left, two upper and lower left ones, and so on.
  std::set<EdgeKey> common;
  std::ranges::set_intersection(edgesOf(soup, 0), edgesOf(soup, 1), std::inserter(common, common.end()));
  double length = 0.0;
  for (const EdgeKey& edge : result.meetings)
  {
    EXPECT_TRUE(common.contains(edge));
    length += between(soup.points[edge.first], soup.points[edge.second]).norm();
  }
  EXPECT_EQ(result.meetings.size(), 6u);
  double expected = 0.0;
  for (const auto& [a, b] : {std::pair<LatticePoint, LatticePoint>{{15000, 30000, 0}, {30000, 0, 0}},
                             {{30000, 0, 0}, {60000, 0, 0}},
                             {{60000, 0, 0}, {75000, 30000, 0}},
                             {{75000, 30000, 0}, {60000, 60000, 0}},
                             {{60000, 60000, 0}, {30000, 60000, 0}},
                             {{30000, 60000, 0}, {15000, 30000, 0}}})
  {
    expected += between(a, b).norm();
  }
  EXPECT_NEAR(length, expected, 10.0);
}

// Small parts. Octants at features are 64 lattice units long.

GridFrame smallFrame()
{
  GridFrame frame;
  frame.depth = 4;
  frame.featureLevel = 4;
  frame.subBits = 6;
  frame.domainLow = {-100000, -100000, -100000};
  frame.domainHigh = {100000, 100000, 100000};
  return frame;
}

/// Parts below 50 lattice units are small.
SmallPartOptions belowFifty()
{
  SmallPartOptions options;
  options.size = 50.0 / 64.0;
  return options;
}

std::vector<char> smallOf(const TriangleSoup& soup, const SmallPartOptions& options)
{
  return findSmallParts(soup, smallFrame(), options, quietContext());
}

/// Adds a triangle that fills a box without depth.
void addFlat(TriangleSoup& soup, const LatticePoint& low, std::int64_t x, std::int64_t y)
{
  addTriangle(soup, low, {low[0] + x, low[1], low[2]}, {low[0], low[1] + y, low[2]});
}

TEST(SmallParts, HaveADiagonalBelowTheLimit)
{
  TriangleSoup soup;
  addFlat(soup, {0, 0, 0}, 30, 40); // 50
  addFlat(soup, {1000, 0, 0}, 30, 39);
  addFlat(soup, {2000, 0, 0}, 31, 40);
  addTriangle(soup, {0, 3000, 0}, {0, 3030, 0}, {0, 3000, 39});
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(0, 1, 0, 1));
}

TEST(SmallParts, AreNoneWithoutASize)
{
  TriangleSoup soup;
  addFlat(soup, {0, 0, 0}, 3, 4);
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
  {
    SmallPartOptions options;
    options.size = size;
    EXPECT_THAT(smallOf(soup, options), ElementsAre(0));
  }
  EXPECT_THAT(smallOf({}, belowFifty()), IsEmpty());
}

TEST(SmallParts, CountAllTrianglesOfAPart)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {20, 0, 0}, {0, 20, 0}, {45, 20, 0}, {500, 0, 0}, {520, 0, 0}, {500, 20, 0}};
  soup.add({0, 1, 2}, 0, 3);
  soup.add({1, 3, 2}, 0, 4); // with this, 45 * 20
  soup.add({4, 5, 6}, 0, 7);
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(1, 1, 1));
  soup.points[3][0] = 46; // 46 * 20 is beyond 50
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(0, 0, 1));
}

TEST(SmallParts, AreNoneOfKeptSurfaces)
{
  TriangleSoup soup;
  for (std::int64_t i = 0; i < 3; ++i)
  {
    addFlat(soup, {1000 * i, 0, 0}, 20, 20);
    soup.surfaceIds.back() = static_cast<Index>(i);
  }
  SmallPartOptions options = belowFifty();
  options.keptSurfaces = {0, 1};
  EXPECT_THAT(smallOf(soup, options), ElementsAre(1, 0, 1));
}

TEST(SmallParts, AreMeasuredByTheFinestOctantsAtTheirPlace)
{
  TriangleSoup soup;
  addFlat(soup, {0, 0, 0}, 18, 24);                                                         // 30
  addFlat(soup, {1000, 0, 0}, 12, 16);                                                      // 20
  for (const auto& [level, low, expected] : {std::tuple<int, std::int64_t, char>{5, 18, 0}, // below 25 here
                                             {5, 19, 1},
                                             {4, 18, 1},
                                             {3, 18, 1}}) // no coarser ones
  {
    SmallPartOptions options = belowFifty();
    options.finerPlaces = {{{{low, 0, 0}, {2000, 100, 100}}, level}, {{{-900, 0, 0}, {-800, 9, 9}}, 9}};
    EXPECT_THAT(smallOf(soup, options), ElementsAre(expected, 1)) << level << ' ' << low;
  }
}

TEST(SmallParts, ThatAreNearEachOtherCountAsOne)
{
  // Cells are 16 long. Together the two parts are longer than 50.
  struct Case
  {
    std::int64_t first;
    std::int64_t second;
    double gapTolerance;
    bool isOne;
  };
  for (const Case& test : {Case{0, 47, 0.0, true},
                           {0, 80, 0.0, false},
                           {0, 57, 0.0, false},
                           {0, 57, 7.5, true},
                           {-40, -88, 0.0, true},
                           {-40, -87, 0.0, true},
                           {-40, -120, 0.0, false}})
  {
    TriangleSoup soup;
    addFlat(soup, {test.first, 3, 3}, 40, 9);
    addFlat(soup, {test.second, 3, 3}, 40, 9);
    SmallPartOptions options = belowFifty();
    options.gapTolerance = test.gapTolerance;
    EXPECT_THAT(smallOf(soup, options), Each(test.isOne ? 0 : 1)) << test.first << ' ' << test.second;
  }
}

TEST(SmallParts, ThatTogetherAreSmallAreStillSmall)
{
  TriangleSoup soup;
  addFlat(soup, {0, 3, 3}, 20, 5);
  addFlat(soup, {25, 3, 3}, 20, 5);
  EXPECT_THAT(smallOf(soup, belowFifty()), Each(1));
}

TEST(SmallParts, StayAtABoundaryEdgeOfOthers)
{
  for (const std::int64_t gap : {0, 3, 4})
  {
    TriangleSoup soup;
    addFlat(soup, {0, 0, 0}, 1000, 1000);
    addFlat(soup, {500, -20 - gap, 0}, 20, 20);
    addFlat(soup, {530, -30 - gap, 0}, 9, 5); // in a cell with the last one
    addFlat(soup, {500, -90, 0}, 20, 20);     // alone
    SmallPartOptions options = belowFifty();
    options.gapTolerance = 3.0;
    const char expected = gap <= 3 ? 0 : 1;
    EXPECT_THAT(smallOf(soup, options), ElementsAre(0, expected, expected, 1)) << gap;
  }
}

TEST(SmallParts, DoNotStayAtAClosedPartOrAtAnotherSmallOne)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}, {0, 0, 1000}};
  for (const Triangle& t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
  {
    soup.add(t, 0, static_cast<Index>(soup.triangles.size()));
  }
  addFlat(soup, {500, 0, 0}, 20, 20);
  addFlat(soup, {-500, 0, 0}, 20, 20);
  addFlat(soup, {-500, 0, 0}, 20, 20);
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(0, 0, 0, 0, 1, 1, 1));
}

// Gaps.

TEST(SoupAsDrawn, HasPartsAndShortestEdgesOfSources)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {30, 0, 0}, {0, 40, 0}, {30, 40, 12}, {500, 0, 0}, {560, 0, 0}, {500, 80, 0}};
  soup.add({0, 1, 2}, 0, 1); // 30, 50, 40
  soup.add({1, 3, 2}, 0, 1);
  soup.add({4, 5, 6}, 0, 3); // 60, 100, 80
  const SoupAsDrawn drawn(soup);
  EXPECT_EQ(drawn.parts, partsOf(soup));
  ASSERT_EQ(drawn.shortestEdges.size(), 4u);
  EXPECT_EQ(drawn.shortestEdges[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(drawn.shortestEdges[1], 30.0);
  EXPECT_EQ(drawn.shortestEdges[3], 60.0);
}

/// A triangle on the ground, and one that stands above it on two feet.
TriangleSoup standing(const LatticePoint& foot, const LatticePoint& other)
{
  TriangleSoup soup;
  addTriangle(soup, {-5000, -5000, 0}, {5000, -5000, 0}, {0, 8000, 0});
  addTriangle(soup, foot, other, {(foot[0] + other[0]) / 2, (foot[1] + other[1]) / 2, foot[2] + 2000});
  return soup;
}

/// Closes gaps and returns the flags of the points.
std::vector<char> closed(TriangleSoup& soup, double tolerance, const GridFrame& frame = smallFrame())
{
  const SoupAsDrawn drawn(soup);
  ClusterCells clusters;
  return closeGaps(soup, frame, {tolerance, drawn, clusters}, quietContext());
}

TEST(GapClosing, MovesPointsWithinTheToleranceOntoAFace)
{
  for (const std::int64_t height : {-41, -40, 0, 2, 3, 39, 40, 41})
  {
    TriangleSoup soup = standing({-500, 0, height}, {500, 0, height});
    const TriangleSoup before = soup;
    const bool moves = std::abs(height) >= 3 && std::abs(height) <= 40;
    const char flag = moves ? 1 : 0;
    EXPECT_THAT(closed(soup, 40.0), ElementsAre(0, 0, 0, flag, flag, 0)) << height;
    EXPECT_EQ(soup.points[3], (LatticePoint{-500, 0, moves ? 0 : height}));
    EXPECT_EQ(soup.points[4], (LatticePoint{500, 0, moves ? 0 : height}));
    EXPECT_EQ(soup.points[5], before.points[5]);
    EXPECT_EQ(soup.triangles, before.triangles);
  }
}

TEST(GapClosing, MovesNothingBelowAToleranceOfOne)
{
  TriangleSoup soup = standing({-500, 0, 30}, {500, 0, 30});
  const std::vector<LatticePoint> before = soup.points;
  EXPECT_THAT(closed(soup, 0.99), Each(0));
  EXPECT_THAT(closed(soup, 0.0), Each(0));
  EXPECT_EQ(soup.points, before);
  TriangleSoup empty;
  EXPECT_THAT(closed(empty, 40.0), IsEmpty());
}

TEST(GapClosing, PrefersCornersAndEdgesUpToTwiceAsFarAsTheFace)
{
  struct Case
  {
    LatticePoint foot;
    double tolerance;
    LatticePoint expected;
  };
  const std::vector<Case> cases{
      {{-500, -4985, 20}, 40.0, {-500, -5000, 0}},   // 25 to the edge, 20 to the face
      {{-500, -4960, 20}, 40.0, {-500, -4960, 0}},   // 45 is beyond the tolerance
      {{-500, -4960, 20}, 200.0, {-500, -4960, 0}},  // and more than twice as far
      {{-500, -4966, 20}, 200.0, {-500, -5000, 0}},  // 39.4 is not
      {{-500, -5012, 16}, 40.0, {-500, -5000, 0}},   // beside the triangle
      {{-4990, -4995, 20}, 40.0, {-5000, -5000, 0}}, // 23 to the corner
  };
  for (const Case& test : cases)
  {
    TriangleSoup soup = standing(test.foot, {test.foot[0] + 1000, test.foot[1], 500});
    const std::vector<char> isMoved = closed(soup, test.tolerance);
    EXPECT_EQ(soup.points[3], test.expected) << test.foot[1] << ' ' << test.tolerance;
    EXPECT_THAT(isMoved, ElementsAre(0, 0, 0, 1, 0, 0));
  }
}

TEST(GapClosing, LeavesPointsOfPartsFinerThanTwoTolerances)
{
  for (const std::int64_t width : {79, 80})
  {
    TriangleSoup soup = standing({0, 0, 30}, {width, 0, 30});
    EXPECT_THAT(closed(soup, 40.0), ElementsAre(0, 0, 0, width == 80, width == 80, 0)) << width;
  }
}

TEST(GapClosing, LeavesTrianglesThatWouldTurnBy45Degrees)
{
  for (const std::int64_t height : {10, 200})
  {
    TriangleSoup soup;
    addTriangle(soup, {-5000, -5000, 0}, {5000, -5000, 0}, {0, 8000, 0});
    addTriangle(soup, {-500, 0, 30}, {500, 0, 30}, {0, height, 30});
    const char flag = height == 200 ? 1 : 0;
    EXPECT_THAT(closed(soup, 40.0), ElementsAre(0, 0, 0, flag, flag, flag)) << height;
  }
}

TEST(GapClosing, MovesTheSmallerPart)
{
  // Each has a corner close to the face of the other.
  for (const bool isFirst : {false, true})
  {
    TriangleSoup soup;
    const auto large = [&] { addTriangle(soup, {-5000, -5000, 0}, {5000, -5000, 0}, {0, 8000, 0}); };
    const auto small = [&] { addTriangle(soup, {-500, 0, 20}, {500, 0, 20}, {0, 900, 20}); };
    isFirst ? large() : small();
    isFirst ? small() : large();
    const std::size_t moved = isFirst ? 3 : 0;
    const std::vector<char> isMoved = closed(soup, 40.0);
    for (std::size_t p = 0; p < 6; ++p)
    {
      EXPECT_EQ(isMoved[p], p >= moved && p < moved + 3 ? 1 : 0);
      EXPECT_EQ(soup.points[p][2], 0);
    }
  }
}

TEST(GapClosing, KeepsPointsOnSidesOfTheDomain)
{
  // A wall that is not quite upright, and a foot at its side: the way to the wall is mostly across.
  for (const std::int64_t side : {-500, -501})
  {
    GridFrame frame = smallFrame();
    frame.domainLow[0] = side;
    TriangleSoup level = standing({-500, 0, 30}, {500, 0, 30});
    EXPECT_THAT(closed(level, 40.0, frame), ElementsAre(0, 0, 0, 1, 1, 0)) << "it slides down the side";
    EXPECT_EQ(level.points[3], (LatticePoint{-500, 0, 0}));
    TriangleSoup across;
    addTriangle(across, {-530, -5000, -5000}, {-530, 5000, -5000}, {-530, 0, 8000});
    addTriangle(across, {-500, -500, 0}, {-500, 500, 0}, {1500, 0, 0});
    const char flag = side == -500 ? 0 : 1;
    EXPECT_THAT(closed(across, 40.0, frame), ElementsAre(0, 0, 0, flag, flag, 0)) << side;
  }
}

TEST(GapClosing, SlidesPointsAlongTheirSideOfTheDomain)
{
  // The ground rises by 1 in 4 along x, so that its nearest point is off the side.
  GridFrame frame = smallFrame();
  frame.domainLow[0] = -4000;
  TriangleSoup soup;
  addTriangle(soup, {-8000, -5000, -2000}, {8000, -5000, 2000}, {-8000, 9000, -2000});
  addTriangle(soup, {-4000, -500, -980}, {-4000, 500, -980}, {-4000, 0, 900});
  EXPECT_THAT(closed(soup, 40.0, frame), ElementsAre(0, 0, 0, 1, 1, 0));
  EXPECT_EQ(soup.points[3][0], -4000);
  EXPECT_LT(soup.points[3][2], -995);
}

TEST(GapClosing, LooksAtNoHiddenTriangles)
{
  TriangleSoup soup = standing({-500, 0, 30}, {500, 0, 30});
  const SoupAsDrawn drawn(soup);
  ClusterCells clusters;
  clusters.hide(0);
  EXPECT_THAT(closeGaps(soup, smallFrame(), {40.0, drawn, clusters}, quietContext()), Each(0));
}

TEST(GapClosing, MovesEdgesOntoTheirOwnPartAheadOfThem)
{
  // A sheet bent to a box without its front: the last wall ends short of the first one.
  for (const std::int64_t gap : {30, 41})
  {
    TriangleSoup soup;
    soup.points = {{0, 0, 0},          {0, 0, 3000},   {4000, 0, 0},      {4000, 0, 3000}, {4000, 4000, 0},
                   {4000, 4000, 3000}, {gap, 4000, 0}, {gap, 4000, 3000}, {0, 6000, 0},    {0, 6000, 3000}};
    for (const Triangle& t :
         {Triangle{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}, {4, 6, 7}, {4, 7, 5}, {8, 0, 1}, {8, 1, 9}})
    {
      soup.add(t, 0, static_cast<Index>(soup.triangles.size()));
    }
    const std::vector<char> isMoved = closed(soup, 40.0);
    for (std::size_t p = 0; p < soup.points.size(); ++p)
    {
      EXPECT_EQ(isMoved[p], gap == 30 && (p == 6 || p == 7) ? 1 : 0) << p;
    }
    EXPECT_EQ(soup.points[6], (LatticePoint{gap == 30 ? 0 : gap, 4000, 0}));
  }
}

// Clusters.

TEST(Clusters, BoundOfTriplesIsTheSumOfLowerDegrees)
{
  Draw draw(12);
  for (int round = 0; round < 100; ++round)
  {
    std::set<std::pair<Index, Index>> drawn;
    for (std::int64_t i = draw.in(0, 60); i > 0; --i)
    {
      const Index a = draw.below(14);
      const Index b = draw.below(14);
      if (a != b)
      {
        drawn.emplace(std::min(a, b), std::max(a, b));
      }
    }
    const TrianglePairs pairs(drawn.begin(), drawn.end());
    const auto degree = [&](Index t) {
      return std::ranges::count_if(pairs, [&](const auto& pair) { return pair.first == t || pair.second == t; });
    };
    std::ptrdiff_t expected = 0;
    for (const auto& [a, b] : pairs)
    {
      expected += std::min(degree(a), degree(b));
    }
    EXPECT_EQ(boundOfTriples(14, pairs), static_cast<std::size_t>(expected));
  }
}

TrianglePairs allPairs(Index count)
{
  TrianglePairs pairs;
  for (Index a = 0; a < count; ++a)
  {
    for (Index b = a + 1; b < count; ++b)
    {
      pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

TrianglePairs pairsOfOthers(const TrianglePairs& pairs, const std::vector<char>& isOut)
{
  TrianglePairs left;
  std::ranges::copy_if(pairs, std::back_inserter(left),
                       [&](const auto& pair) { return !isOut[pair.first] && !isOut[pair.second]; });
  return left;
}

TEST(Clusters, TanglesAreMarkedIfTheBoundIsBeyondTheLimit)
{
  const TrianglePairs pairs = allPairs(10); // 45 pairs of degree 9
  EXPECT_EQ(boundOfTriples(10, pairs), 405u);
  EXPECT_THAT(findTangles(10, pairs, 405), Each(0));
  for (const std::size_t limit : {404u, 200u, 81u, 80u, 1u})
  {
    const std::vector<char> isOut = findTangles(10, pairs, limit);
    EXPECT_EQ(isOut.size(), 10u);
    EXPECT_TRUE(std::ranges::is_sorted(isOut)) << "among equals the last ones";
    EXPECT_EQ(isOut.back(), 1);
    EXPECT_EQ(isOut.front(), 0) << "one alone makes no pairs";
    EXPECT_LE(boundOfTriples(10, pairsOfOthers(pairs, isOut)), limit);
  }
}

TEST(Clusters, TanglesAreMarkedFromTheDearestOn)
{
  // Triangle 3 meets all others; 6 and 7 also meet each other.
  TrianglePairs pairs{{6, 7}};
  for (Index t = 0; t < 9; ++t)
  {
    if (t != 3)
    {
      pairs.emplace_back(std::min<Index>(t, 3), std::max<Index>(t, 3));
    }
  }
  ASSERT_EQ(boundOfTriples(10, pairs), 2u + 6u + 4u);
  EXPECT_THAT(findTangles(10, pairs, 12), Each(0));
  // Costs are 1 six times, 4 twice, and 10. Triangle 9 costs nothing.
  EXPECT_THAT(findTangles(10, pairs, 10), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0));
  EXPECT_THAT(findTangles(10, pairs, 9), ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0, 0));
  EXPECT_THAT(findTangles(10, pairs, 5), ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 1, 0));
}

TEST(Clusters, SearchesEndBeyondTheMostPairs)
{
  EXPECT_NO_THROW(checkPairs(0));
  EXPECT_NO_THROW(checkPairs(mostPairs));
  EXPECT_THROW(checkPairs(mostPairs + 1), TooManyPairs);
}

/// Triangles in a few places, some of them repeated many times.
TriangleSoup crowd(Draw& draw, std::size_t count)
{
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i)
  {
    const LatticePoint p = draw.point(30);
    addTriangle(soup, p, {p[0] + draw.in(1, 20), p[1], p[2]}, {p[0], p[1] + draw.in(1, 20), p[2] + draw.in(0, 20)});
  }
  return soup;
}

/// Counts the pairs of triangles that are not marked whose boxes touch.
std::size_t countPairs(const TriangleSoup& soup, std::int64_t margin, const std::vector<char>& isOut)
{
  std::size_t pairs = 0;
  for (Index a = 0; a < soup.triangles.size(); ++a)
  {
    for (Index b = 0; b < a; ++b)
    {
      const auto boxOfTriangle = [&](Index t) {
        return grown(boundsOf(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2)), margin);
      };
      pairs += !isOut[a] && !isOut[b] && overlap(boxOfTriangle(a), boxOfTriangle(b)) ? 1 : 0;
    }
  }
  return pairs;
}

TEST(Clusters, AreMarkedForAnyLimit)
{
  Draw draw(14);
  const TriangleSoup soup = crowd(draw, 60);
  for (const std::size_t limit : {0, 1, 5, 20})
  {
    EXPECT_LE(countPairs(soup, 4, findClusters(soup, 4, limit, quietContext())), limit);
  }
}

TEST(Clusters, AreMarkedUntilPairsAreWithinTheLimit)
{
  Draw draw(13);
  for (int round = 0; round < 60; ++round)
  {
    const TriangleSoup soup = crowd(draw, 60);
    const std::int64_t margin = draw.in(2, 8);
    const std::size_t pairs = countPairs(soup, margin, std::vector<char>(60, 0));
    ASSERT_GT(pairs, 90u);
    EXPECT_THAT(findClusters(soup, margin, pairs, quietContext()), Each(0));
    for (const std::size_t limit : {pairs - 1, pairs / 2, std::size_t{60}})
    {
      const std::vector<char> isOut = findClusters(soup, margin, limit, quietContext());
      EXPECT_LE(countPairs(soup, margin, isOut), limit);
      EXPECT_GT(std::ranges::count(isOut, 1), 0);
      EXPECT_LT(std::ranges::count(isOut, 1), 60);
    }
  }
}

TEST(Clusters, KeepMarksAndDoNotCountThem)
{
  Draw draw(14);
  const TriangleSoup soup = crowd(draw, 60);
  std::vector<char> isOut(60, 0);
  std::fill_n(isOut.begin(), 30, 1);
  const std::size_t pairs = countPairs(soup, 3, isOut);
  EXPECT_EQ(findClusters(soup, 3, pairs, quietContext(), isOut), isOut);
  const std::vector<char> more = findClusters(soup, 3, pairs - 1, quietContext(), isOut);
  EXPECT_GT(std::ranges::count(more, 1), 30);
  EXPECT_EQ(std::count(more.begin(), more.begin() + 30, 1), 30);
  EXPECT_THAT(findClusters({}, 3, 0, quietContext()), IsEmpty());
}

TEST(Clusters, MarkTheTriangleThatTouchesAllOthers)
{
  TriangleSoup soup;
  for (std::int64_t i = 0; i < 64; ++i)
  {
    addTriangle(soup, {100 * i, 0, 0}, {100 * i + 9, 0, 0}, {100 * i, 9, 0});
  }
  addTriangle(soup, {0, 0, 0}, {6400, 0, 0}, {0, 9, 0});
  EXPECT_THAT(findClusters(soup, 0, 64, quietContext()), Each(0));
  EXPECT_EQ(findClusters(soup, 0, 63, quietContext()).back(), 1);
}

std::vector<char> hiddenIn(const ClusterCells& clusters, Index sources)
{
  std::vector<char> isHidden;
  for (Index s = 0; s < sources; ++s)
  {
    isHidden.push_back(clusters.isHidden(s) ? 1 : 0);
  }
  return isHidden;
}

/// Copies of one triangle, two to a source.
TriangleSoup copies(Index count)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {90, 0, 0}, {0, 90, 0}};
  for (Index t = 0; t < count; ++t)
  {
    soup.add({0, 1, 2}, 0, t / 2);
  }
  return soup;
}

TEST(Clusters, HideSourcesAsAWhole)
{
  const TriangleSoup soup = copies(12); // 66 pairs
  ClusterCells clusters;
  hideClusters(soup, 1, 66, clusters, quietContext());
  EXPECT_THAT(hiddenIn(clusters, 6), Each(0));
  clusters.hide(0);
  hideClusters(soup, 1, 45, clusters, quietContext()); // those of ten others
  EXPECT_THAT(hiddenIn(clusters, 6), ElementsAre(1, 0, 0, 0, 0, 0));
  hideClusters(soup, 1, 44, clusters, quietContext());
  const std::size_t seen = seenTriangles(soup, clusters, quietContext()).size();
  EXPECT_LE(seen * (seen - 1) / 2, 44u);
  EXPECT_LT(seen, 10u);
}

TEST(Clusters, SearchesAreRepeatedUntilTheyEnd)
{
  const TriangleSoup soup = copies(12);
  ClusterCells clusters;
  int runs = 0;
  const std::size_t found = searchSeen(soup, 1, clusters, quietContext(), [&] {
    ++runs;
    const std::size_t seen = seenTriangles(soup, clusters, quietContext()).size();
    if (seen * (seen - 1) / 2 > 20)
    {
      throw TooManyPairs{};
    }
    return seen;
  });
  EXPECT_LT(found, 8u);
  EXPECT_GT(runs, 2);
  EXPECT_EQ(searchSeen(soup, 1, clusters, quietContext(), [] { return 5; }), 5);
}

TEST(Clusters, HideTanglesOfTooManyPieces)
{
  // The bound is n (n - 1)^2 / 2: below five million for 216 triangles, and beyond for 217.
  for (const Index count : {216u, 217u})
  {
    const TriangleSoup soup = copies(count);
    ClusterCells clusters;
    const TrianglePairs pairs = allPairs(count);
    EXPECT_EQ(hideTangles(soup, pairs, clusters), count == 217);
    EXPECT_EQ(clusters.isHidden((count - 1) / 2), count == 217);
    EXPECT_FALSE(clusters.isHidden(0));
  }
}

} // namespace
