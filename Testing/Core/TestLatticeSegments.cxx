// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests segments on the lattice, and how they are cut, against naive references.
#include "Draw.h"
#include "Grid/Predicates.h"
#include "LatticePlane.h"
#include "Surface/Triangles/TriangleSoup.h"
#include "Surface/Triangulation/FaceTriangulation.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Draw;
using atria::testing::placed;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LatticeSegments, PartWayIsTheNearestLatticePoint)
{
  Draw draw(4);
  for (int round = 0; round < 20000; ++round)
  {
    const std::int64_t reach = round % 2 == 0 ? 50 : std::int64_t{1} << 40;
    const LatticePoint p{draw.in(-reach, reach), draw.in(-reach, reach), draw.in(-reach, reach)};
    const LatticePoint q{draw.in(-reach, reach), draw.in(-reach, reach), draw.in(-reach, reach)};
    const std::int64_t sign = round % 3 == 0 ? -1 : 1;
    const Wide whole = Wide(draw.in(1, reach)) * (round % 2 == 0 ? 1 : reach);
    const Wide part = whole / 1000 * draw.in(0, 1000);
    const LatticePoint x = partWay(p, q, part * sign, whole * sign);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Wide error = whole * (x[axis] - p[axis]) - part * (q[axis] - p[axis]);
      EXPECT_LE((error < 0 ? -error : error) * 2, whole + whole / 1000) << round;
    }
  }
}

TEST(LatticeSegments, PartWayEndsAtTheEnds)
{
  const LatticePoint p{5, -7, 1000};
  const LatticePoint q{-95, 93, 1001};
  EXPECT_EQ(partWay(p, q, 0, 7), p);
  EXPECT_EQ(partWay(p, q, 7, 7), q);
  EXPECT_EQ(partWay(p, q, -7, -7), q);
  EXPECT_EQ(partWay(p, q, 1, 4), (LatticePoint{-20, 18, 1000}));
  EXPECT_EQ(partWay(p, q, 3, 4), (LatticePoint{-70, 68, 1001}));
}

/// The same in integers.
bool liesOnExactly(const LatticePoint& p, const LatticePoint& a, const LatticePoint& b, std::int64_t reach)
{
  const auto minus = [](const LatticePoint& l, const LatticePoint& r) {
    return LatticePoint{l[0] - r[0], l[1] - r[1], l[2] - r[2]};
  };
  const auto dot = [](const LatticePoint& l, const LatticePoint& r) { return l[0] * r[0] + l[1] * r[1] + l[2] * r[2]; };
  const LatticePoint u = minus(b, a);
  const LatticePoint v = minus(p, a);
  const LatticePoint cross{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return dot(u, v) > 0 && dot(u, v) < dot(u, u) && dot(cross, cross) <= reach * reach * dot(u, u);
}

TEST(LatticeSegments, PointsLieOnASegmentWithinTheReachAndBetweenItsEnds)
{
  Draw draw(5);
  int on = 0;
  const auto drawPoint = [&] { return LatticePoint{draw.in(-6, 6), draw.in(-6, 6), draw.in(-6, 6)}; };
  for (int round = 0; round < 40000; ++round)
  {
    const LatticePoint a = drawPoint();
    const LatticePoint b = round % 20 == 0 ? a : drawPoint();
    const LatticePoint p = drawPoint();
    const std::int64_t reach = draw.in(0, 5);
    EXPECT_EQ(liesOnSegment(p, a, b, static_cast<double>(reach)), liesOnExactly(p, a, b, reach));
    on += liesOnExactly(p, a, b, reach) ? 1 : 0;
  }
  EXPECT_GT(on, 1000);
}

TEST(LatticeSegments, PointsLieOnASegmentUpToTheLimit)
{
  const LatticePoint a{0, 0, 0};
  const LatticePoint b{100, 0, 0};
  const std::vector<std::pair<LatticePoint, bool>> places{
      {{50, 3, 4}, true},   {{50, 5, 0}, true}, {{50, 0, -5}, true}, {{50, 4, 4}, false}, {{50, 6, 0}, false},
      {{50, 0, -6}, false}, {{1, 5, 0}, true},  {{99, 5, 0}, true},  {{0, 1, 0}, false},  {{100, 0, 0}, false}};
  for (const auto& [p, expected] : places)
  {
    EXPECT_EQ(liesOnSegment(p, a, b, 5.0), expected) << p[0] << ' ' << p[1] << ' ' << p[2];
    EXPECT_EQ(liesOnSegment(p, b, a, 5.0), expected) << p[0] << ' ' << p[1] << ' ' << p[2];
  }
}

/// Crossings of segments between points of a grid of 4 x 4 have denominators up to 18. With this step all of them are
/// lattice points.
constexpr std::int64_t step = 12252240; // least common multiple of 1 to 18
constexpr double reach = 4.0;

LatticePoint crossingOf(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d,
                        int axis)
{
  const Wide ofA = projectedArea(c, d, a, axis);
  const Wide ofB = projectedArea(c, d, b, axis);
  LatticePoint x;
  for (int i = 0; i < 3; ++i)
  {
    x[i] = a[i] + static_cast<std::int64_t>(ofA * (b[i] - a[i]) / (ofA - ofB));
  }
  return x;
}

bool areCrossing(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d, int axis)
{
  return signOf(projectedArea(a, b, c, axis)) * signOf(projectedArea(a, b, d, axis)) < 0 &&
         signOf(projectedArea(c, d, a, axis)) * signOf(projectedArea(c, d, b, axis)) < 0;
}

/// Returns the places of all points of the face and of all crossings.
std::set<LatticePoint> naivePlaces(const std::vector<LatticePoint>& points, const std::vector<EdgeKey>& segments,
                                   int axis)
{
  std::set<LatticePoint> places(points.begin(), points.end());
  for (const auto& [a, b] : segments)
  {
    for (const auto& [c, d] : segments)
    {
      if (areCrossing(points[a], points[b], points[c], points[d], axis))
      {
        places.insert(crossingOf(points[a], points[b], points[c], points[d], axis));
      }
    }
  }
  return places;
}

/// Returns the pieces of each segment between all places on it, by place.
std::multiset<std::pair<LatticePoint, LatticePoint>> naivePieces(const std::vector<LatticePoint>& points,
                                                                 const std::vector<EdgeKey>& segments, int axis)
{
  const std::set<LatticePoint> places = naivePlaces(points, segments, axis);
  std::multiset<std::pair<LatticePoint, LatticePoint>> pieces;
  for (const auto& [a, b] : segments)
  {
    // Places on a segment are in order if their coordinates are.
    std::set<LatticePoint> on{points[a], points[b]};
    std::ranges::copy_if(places, std::inserter(on, on.end()),
                         [&](const LatticePoint& p) { return liesOnSegment(p, points[a], points[b], 0.5); });
    for (auto at = on.begin(), next = std::next(at); next != on.end(); at = next++)
    {
      pieces.emplace(*at, *next);
    }
  }
  return pieces;
}

/// A face with all points of a grid of 4 x 4, and some segments between them.
DividedFace gridFace(std::vector<LatticePoint>& points, Draw& draw, int axis)
{
  const std::int64_t slope = draw.in(-1, 1);
  for (int i = 0; i < 16; ++i)
  {
    points.push_back(placed(step * (i % 4), step * (i / 4), axis, slope));
  }
  DividedFace face{{0, 3, 12}, {{{1, 2}, {6, 9}, {8, 4}}}, {5, 7, 10, 11, 13, 14, 15}, {}};
  for (int i = 0; i < 9; ++i)
  {
    const Index a = draw.below(16);
    const Index b = draw.below(16);
    if (a != b)
    {
      face.segments.push_back(edgeKey(a, b));
    }
  }
  return face;
}

TEST(LatticeSegments, AreCutAtCrossingsAndAtPointsOnThem)
{
  Draw draw(6);
  for (int round = 0; round < 300; ++round)
  {
    const int axis = round % 3;
    std::vector<LatticePoint> points;
    DividedFace face = gridFace(points, draw, axis);
    const std::vector<EdgeKey> segments = face.segments;
    const auto expected = naivePieces(points, segments, axis);
    const std::set<LatticePoint> places = naivePlaces(points, segments, axis);
    cutSegments(points, face, axis, reach);
    EXPECT_EQ(std::set<LatticePoint>(points.begin(), points.end()), places);
    EXPECT_EQ(points.size(), places.size()) << "one point for each place";
    EXPECT_EQ(face.inside.size(), 7 + points.size() - 16);
    EXPECT_TRUE(std::ranges::equal(std::span(face.inside).subspan(7), std::span(points).subspan(16),
                                   [&](Index p, const LatticePoint& q) { return points[p] == q; }));
    std::multiset<std::pair<LatticePoint, LatticePoint>> found;
    for (const auto& [a, b] : face.segments)
    {
      EXPECT_LT(a, b);
      found.insert(std::minmax(points[a], points[b]));
    }
    EXPECT_EQ(found, expected) << round;
  }
}

TEST(LatticeSegments, OfNoneStayNone)
{
  std::vector<LatticePoint> points{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}};
  DividedFace face{{0, 1, 2}, {}, {}, {}};
  cutSegments(points, face, 2, reach);
  EXPECT_THAT(face.segments, IsEmpty());
  EXPECT_EQ(points.size(), 3u);
}

TEST(LatticeSegments, MergeACrossingWithAPointWithinFourReaches)
{
  // The reach is 4, so that points up to 16 apart are one.
  for (const std::int64_t offset : {0, 15, 16, 17, 40})
  {
    std::vector<LatticePoint> points{{0, 0, 0},     {1000, 0, 0},  {0, 1000, 0},  {100, 100, 0},
                                     {400, 400, 0}, {100, 400, 0}, {400, 100, 0}, {250 + offset, 250, 0}};
    DividedFace face{{0, 1, 2}, {}, {3, 4, 5, 6, 7}, {{3, 4}, {5, 6}}};
    cutSegments(points, face, 2, reach);
    const Index at = offset <= 16 ? 7 : 8;
    EXPECT_EQ(points.size(), at + 1u) << offset;
    EXPECT_THAT(face.segments, ::testing::IsSupersetOf({EdgeKey(3, at)})) << offset;
    if (offset <= 16)
    {
      EXPECT_THAT(face.segments,
                  ::testing::UnorderedElementsAre(EdgeKey(3, 7), EdgeKey(4, 7), EdgeKey(5, 7), EdgeKey(6, 7)));
    }
    else
    {
      EXPECT_EQ(points[8], (LatticePoint{250, 250, 0}));
      EXPECT_THAT(face.inside, ElementsAre(3, 4, 5, 6, 7, 8));
    }
  }
}

} // namespace
