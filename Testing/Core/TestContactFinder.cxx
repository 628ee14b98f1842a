// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests contacts of two triangles against a reference that works on a grid of 3 x 3 x 3 points, in integers.
#include "Draw.h"
#include "RepairSamples.h"
#include "Surface/Repair/ContactFinder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addTriangle;
using atria::testing::Draw;
using atria::testing::gridPoint;
using atria::testing::gridSoup;
using atria::testing::reach;
using atria::testing::step;
using atria::testing::times;
using atria::testing::Triangle;
using ::testing::IsEmpty;

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

LatticePoint minus(const LatticePoint& l, const LatticePoint& r) { return {l[0] - r[0], l[1] - r[1], l[2] - r[2]}; }
LatticePoint cross(const LatticePoint& l, const LatticePoint& r)
{
  return {l[1] * r[2] - l[2] * r[1], l[2] * r[0] - l[0] * r[2], l[0] * r[1] - l[1] * r[0]};
}
std::int64_t dot(const LatticePoint& l, const LatticePoint& r) { return l[0] * r[0] + l[1] * r[1] + l[2] * r[2]; }

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

} // namespace
