// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests triangulations of points and segments in the plane, and of faces on the lattice, against naive references.
#include "Surface/Triangulation/PlanarTriangulation.h"

#include "Grid/Predicates.h"
#include "Surface/Triangles/TriangleSoup.h"
#include "Surface/Triangulation/FaceTriangulation.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Segments = std::vector<std::array<Index, 2>>;
using Triangles = std::vector<std::array<Index, 3>>;

class Draw
{
public:
  explicit Draw(unsigned seed) : random_(seed) {}

  std::int64_t in(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  Index below(std::size_t count) { return static_cast<Index>(in(0, static_cast<std::int64_t>(count) - 1)); }
  /// Returns points of a small grid. Some are repeated.
  std::vector<Vec2> points(std::size_t count, std::int64_t last)
  {
    std::vector<Vec2> drawn(count);
    std::ranges::generate(drawn,
                          [&] { return Vec2(static_cast<double>(in(0, last)), static_cast<double>(in(0, last))); });
    return drawn;
  }

private:
  std::mt19937 random_;
};

// In the plane. Points are on a small grid, where products of doubles are exact.

double turn(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Twice the area of the convex hull: the sum over the edges that have no point on their right.
double hullArea(const std::vector<Vec2>& points)
{
  double sum = 0.0;
  for (const Vec2& a : points)
  {
    for (const Vec2& b : points)
    {
      const bool isEdge = a != b && std::ranges::all_of(points, [&](const Vec2& p) {
                            const double side = turn(a, b, p);
                            return side > 0.0 || (side == 0.0 && (p - a).dot(p - b) <= 0.0);
                          });
      const auto repeats = static_cast<double>(std::ranges::count(points, a) * std::ranges::count(points, b));
      sum += isEdge ? turn(points[0], a, b) / repeats : 0.0;
    }
  }
  return sum;
}

double areaOf(const PlanarTriangulation& plane, const std::array<Index, 3>& t)
{
  return turn(plane.points[t[0]], plane.points[t[1]], plane.points[t[2]]);
}

Index firstAt(const std::vector<Vec2>& points, const Vec2& p)
{
  return static_cast<Index>(std::ranges::find(points, p) - points.begin());
}

void expectCoversHull(const std::vector<Vec2>& points, const PlanarTriangulation& plane)
{
  double area = 0.0;
  for (const auto& t : plane.triangles)
  {
    EXPECT_GT(areaOf(plane, t), 0.0);
    area += areaOf(plane, t);
    for (const Index p : t)
    {
      EXPECT_EQ(firstAt(plane.points, plane.points[p]), p);
    }
  }
  EXPECT_NEAR(area, hullArea(points), 1e-9);
  ASSERT_GE(plane.points.size(), points.size());
  EXPECT_TRUE(std::equal(points.begin(), points.end(), plane.points.begin()));
}

/// True if p is strictly within the circle through the corners of a counterclockwise triangle.
bool isInCircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p)
{
  Eigen::Matrix3d rows;
  rows << a[0] - p[0], a[1] - p[1], (a - p).squaredNorm(), b[0] - p[0], b[1] - p[1], (b - p).squaredNorm(), c[0] - p[0],
      c[1] - p[1], (c - p).squaredNorm();
  return rows.determinant() > 1e-6;
}

TEST(PlanarTriangulation, OfPointsIsDelaunay)
{
  Draw draw(1);
  for (int round = 0; round < 150; ++round)
  {
    const std::vector<Vec2> points = draw.points(static_cast<std::size_t>(draw.in(3, 25)), 12);
    const PlanarTriangulation plane = triangulatePlane(points, {});
    expectCoversHull(points, plane);
    EXPECT_EQ(plane.points.size(), points.size());
    EXPECT_TRUE(plane.simple);
    for (const auto& [a, b, c] : plane.triangles)
    {
      EXPECT_FALSE(
          std::ranges::any_of(points, [&](const Vec2& p) { return isInCircle(points[a], points[b], points[c], p); }));
    }
    EXPECT_EQ(plane.regions, std::vector<Index>(plane.triangles.size(), 0)) << "no segment divides it";
    EXPECT_EQ(plane.regionCount, plane.triangles.empty() ? 0u : 1u);
  }
}

TEST(PlanarTriangulation, OfFewPointsOrALineIsEmpty)
{
  const std::vector<std::vector<Vec2>> lists{
      {}, {{1, 2}}, {{1, 2}, {3, 4}}, {{0, 0}, {1, 2}, {2, 4}, {1, 2}}, {{1, 1}, {1, 1}, {1, 1}}};
  for (const std::vector<Vec2>& points : lists)
  {
    Segments segments;
    for (Index i = 0; i + 1 < points.size(); ++i)
    {
      segments.push_back({i, i + 1});
    }
    const PlanarTriangulation plane = triangulatePlane(points, segments);
    EXPECT_THAT(plane.triangles, IsEmpty());
    EXPECT_THAT(plane.regions, IsEmpty());
    EXPECT_EQ(plane.points, points);
    EXPECT_TRUE(plane.simple);
  }
}

TEST(PlanarTriangulation, HasSegmentsAsEdgesAgainstTheShorterDiagonal)
{
  const std::vector<Vec2> points{{0, 0}, {4, -1}, {8, 0}, {4, 1}};
  for (const Segments& segments : {Segments{{0, 2}}, Segments{{2, 0}}})
  {
    const PlanarTriangulation plane = triangulatePlane(points, segments);
    ASSERT_EQ(plane.triangles.size(), 2u);
    for (const auto& t : plane.triangles)
    {
      EXPECT_TRUE(contains(t, 0) && contains(t, 2));
    }
  }
  for (const auto& t : triangulatePlane(points, {}).triangles)
  {
    EXPECT_TRUE(contains(t, 1) && contains(t, 3));
  }
}

TEST(PlanarTriangulation, CutsSegmentsWhereTheyCross)
{
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  const Segments crossing{{0, 2}, {1, 3}};
  const PlanarTriangulation plane = triangulatePlane(points, crossing);
  ASSERT_EQ(plane.points.size(), 5u);
  EXPECT_LT((plane.points[4] - Vec2(2, 1)).norm(), 1e-12);
  EXPECT_EQ(plane.triangles.size(), 4u);
  EXPECT_TRUE(plane.simple);
  EXPECT_EQ(plane.regions, std::vector<Index>(4, 0)) << "each is reached from the hull";
  EXPECT_EQ(plane.regionCount, 1u);
}

TEST(PlanarTriangulation, LeavesOutLaterSegmentsIfCrossingsAreNotCut)
{
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  const std::array<std::pair<Segments, std::array<Index, 2>>, 2> cases{
      {{{{0, 2}, {1, 3}}, {0, 2}}, {{{1, 3}, {0, 2}}, {1, 3}}}};
  for (const auto& [segments, diagonal] : cases)
  {
    const PlanarTriangulation plane = triangulatePlane(points, segments, {0, 0, false});
    EXPECT_FALSE(plane.simple);
    EXPECT_THAT(plane.regions, IsEmpty());
    EXPECT_EQ(plane.points, points);
    ASSERT_EQ(plane.triangles.size(), 2u);
    for (const auto& t : plane.triangles)
    {
      EXPECT_TRUE(contains(t, diagonal[0]) && contains(t, diagonal[1]));
    }
  }
}

TEST(PlanarTriangulation, IsSimpleIfSegmentsOnlyOverlapOrPassThroughPoints)
{
  const std::vector<Vec2> points{{0, 0}, {2, 0}, {4, 0}, {6, 0}, {3, 3}};
  const PlanarTriangulation plane = triangulatePlane(points, Segments{{0, 2}, {1, 3}, {0, 3}}, {0, 0, false});
  EXPECT_TRUE(plane.simple);
  EXPECT_EQ(plane.triangles.size(), 3u);
  EXPECT_EQ(plane.regions, std::vector<Index>(3, 0));
}

/// Even-odd rule: number of outline edges right of p, which is on none of them.
bool isInside(const std::vector<Vec2>& points, const Segments& outline, const Vec2& p)
{
  bool isIn = false;
  for (const auto& [i, j] : outline)
  {
    const Vec2& a = points[i];
    const Vec2& b = points[j];
    if ((a[1] > p[1]) != (b[1] > p[1]))
    {
      isIn ^= a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > p[0];
    }
  }
  return isIn;
}

Vec2 centerOf(const PlanarTriangulation& plane, const std::array<Index, 3>& t)
{
  return (plane.points[t[0]] + plane.points[t[1]] + plane.points[t[2]]) / 3.0;
}

TEST(PlanarTriangulation, KnowsTheInsideOfAnOutlineByTheEvenOddRule)
{
  Draw draw(2);
  std::size_t inside = 0;
  for (int round = 0; round < 200; ++round)
  {
    // A random walk through some points, closed; then points and segments that are no outline.
    std::vector<Vec2> points = draw.points(static_cast<std::size_t>(draw.in(3, 9)), 9);
    const PlanarOutline outline{points.size(), points.size(), true};
    Segments segments;
    for (Index i = 0; i < points.size(); ++i)
    {
      segments.push_back({i, static_cast<Index>((i + 1) % points.size())});
    }
    const Segments walk = segments;
    const std::vector<Vec2> more = draw.points(5, 9);
    points.insert(points.end(), more.begin(), more.end());
    segments.push_back({draw.below(points.size()), draw.below(points.size())});
    segments.push_back({draw.below(points.size()), draw.below(points.size())});
    const PlanarTriangulation plane = triangulatePlane(points, segments, outline);
    EXPECT_TRUE(plane.simple);
    ASSERT_EQ(plane.regions.size(), plane.triangles.size());
    EXPECT_EQ(plane.regionCount, plane.triangles.empty() ? 0u : 2u);
    for (std::size_t t = 0; t < plane.triangles.size(); ++t)
    {
      if (areaOf(plane, plane.triangles[t]) > 1e-6) // crossings are rounded
      {
        const bool isIn = isInside(points, walk, centerOf(plane, plane.triangles[t]));
        EXPECT_EQ(plane.isOutside(t), !isIn) << round;
        EXPECT_EQ(plane.regions[t], isIn ? 1u : 0u);
        inside += isIn ? 1 : 0;
      }
    }
  }
  EXPECT_GT(inside, 500u);
}

TEST(PlanarTriangulation, WalksABridgeBothWaysWithoutABorder)
{
  const std::vector<Vec2> points{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {2, 2}, {2, 4}, {4, 4}, {4, 2}};
  const Segments segments{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {4, 0}};
  const PlanarTriangulation plane = triangulatePlane(points, segments, {8, 10, true});
  double area = 0.0;
  for (std::size_t t = 0; t < plane.triangles.size(); ++t)
  {
    area += plane.isOutside(t) ? 0.0 : areaOf(plane, plane.triangles[t]);
  }
  EXPECT_NEAR(area, 2.0 * (36.0 - 4.0), 1e-12);
}

/// True if a and b lie on one of the segments.
bool isOnSegments(const std::vector<Vec2>& points, const Segments& segments, const Vec2& a, const Vec2& b)
{
  return std::ranges::any_of(segments, [&](const auto& segment) {
    const Vec2& from = points[segment[0]];
    const Vec2& to = points[segment[1]];
    const auto lies = [&](const Vec2& p) {
      return std::abs(turn(from, to, p)) < 1e-9 && (p - from).dot(p - to) <= 1e-9;
    };
    return from != to && lies(a) && lies(b);
  });
}

/// Returns the pairs of triangles with a common edge on no segment, as numbers from 1 on; 0 is beyond the hull.
std::vector<std::pair<Index, Index>> naiveDoors(const PlanarTriangulation& plane, const std::vector<Vec2>& points,
                                                const Segments& segments)
{
  std::map<EdgeKey, std::vector<Index>> uses;
  for (Index t = 0; t < plane.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      uses[edgeKey(plane.triangles[t], i)].push_back(t + 1);
    }
  }
  std::vector<std::pair<Index, Index>> doors;
  for (const auto& [edge, triangles] : uses)
  {
    if (!isOnSegments(points, segments, plane.points[edge.first], plane.points[edge.second]))
    {
      doors.emplace_back(triangles.size() == 1 ? 0 : triangles[0], triangles.back());
    }
  }
  return doors;
}

/// The parts that segments divide the triangles into, 0 for those reached from the hull.
std::vector<Index> naiveRegions(const PlanarTriangulation& plane, const std::vector<Vec2>& points,
                                const Segments& segments)
{
  std::vector<Index> part(plane.triangles.size() + 1);
  std::iota(part.begin(), part.end(), Index{0});
  for (const auto& [from, to] : naiveDoors(plane, points, segments))
  {
    const std::pair<Index, Index> joined = std::minmax(part[from], part[to]);
    std::ranges::replace(part, Index{joined.second}, Index{joined.first});
  }
  part.erase(part.begin());
  return part;
}

TEST(PlanarTriangulation, HasARegionForEachPartThatSegmentsEnclose)
{
  Draw draw(3);
  Index most = 0;
  for (int round = 0; round < 60; ++round)
  {
    // Segments along the axes cross in points of the grid, so that rounding moves none.
    std::vector<Vec2> points;
    Segments segments;
    for (Index i = 0; i < 14; ++i)
    {
      const Vec2 from = draw.points(1, 5).front();
      Vec2 to = from;
      to[static_cast<int>(i % 2)] = static_cast<double>(draw.in(0, 5));
      points.insert(points.end(), {from, to});
      segments.push_back({2 * i, 2 * i + 1});
    }
    for (int i = 0; i < 36; ++i)
    {
      points.emplace_back(i % 6, i / 6);
    }
    const PlanarTriangulation plane = triangulatePlane(points, segments);
    expectCoversHull(points, plane);
    const std::vector<Index> expected = naiveRegions(plane, points, segments);
    std::map<Index, Index> numbers{{0, 0}};
    for (std::size_t t = 0; t < expected.size(); ++t)
    {
      EXPECT_EQ(numbers.try_emplace(expected[t], plane.regions[t]).first->second, plane.regions[t]);
    }
    std::set<Index> used;
    std::ranges::for_each(numbers, [&](const auto& number) { used.insert(number.second); });
    EXPECT_EQ(used.size(), numbers.size());
    EXPECT_EQ(plane.regionCount, numbers.size());
    EXPECT_EQ(*used.rbegin() + 1, plane.regionCount);
    most = std::max(most, plane.regionCount);
  }
  EXPECT_GT(most, 3u);
}

// Segments on the lattice.

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

/// Places points of a grid in a plane whose normal has its largest part along `axis`.
LatticePoint placed(std::int64_t x, std::int64_t y, int axis, std::int64_t slope)
{
  LatticePoint p;
  p[(axis + 1) % 3] = x;
  p[(axis + 2) % 3] = y;
  p[axis] = slope * (x - y) + 1000;
  return p;
}

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

// Faces.

/// Sum of directed edges: how often each is walked forward more than back, without those that cancel out.
std::map<EdgeKey, int> boundaryOf(const Triangles& triangles)
{
  std::map<EdgeKey, int> sum;
  for (const auto& t : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      sum[edgeKey(t, i)] += t[i] < t[(i + 1) % 3] ? 1 : -1;
    }
  }
  std::erase_if(sum, [](const auto& entry) { return entry.second == 0; });
  return sum;
}

std::map<EdgeKey, int> outlineOf(const DividedFace& face)
{
  std::vector<Index> outline;
  for (std::size_t i = 0; i < 3; ++i)
  {
    outline.push_back(face.corners.at(i));
    outline.insert(outline.end(), face.alongEdges.at(i).begin(), face.alongEdges.at(i).end());
  }
  std::map<EdgeKey, int> sum;
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const Index next = outline[(i + 1) % outline.size()];
    sum[edgeKey(outline[i], next)] += outline[i] < next ? 1 : -1;
  }
  std::erase_if(sum, [](const auto& entry) { return entry.second == 0; });
  return sum;
}

std::set<EdgeKey> edgesOf(const Triangles& triangles)
{
  std::set<EdgeKey> edges;
  for (const auto& t : triangles)
  {
    edges.insert({edgeKey(t, 0), edgeKey(t, 1), edgeKey(t, 2)});
  }
  return edges;
}

/// Checks that a segment is a row of edges.
void expectRow(const std::vector<LatticePoint>& points, const std::set<EdgeKey>& edges, const EdgeKey& segment)
{
  const LatticePoint& a = points[segment.first];
  const LatticePoint& b = points[segment.second];
  std::vector<std::pair<double, Index>> on{{0.0, segment.first}, {between(a, b).squaredNorm(), segment.second}};
  for (Index p = 0; p < points.size(); ++p)
  {
    if (liesOnSegment(points[p], a, b, 8.0))
    {
      on.emplace_back(between(a, b).dot(between(a, points[p])), p);
    }
  }
  std::ranges::sort(on);
  for (std::size_t i = 1; i < on.size(); ++i)
  {
    EXPECT_TRUE(edges.contains(edgeKey(on[i - 1].second, on[i].second)));
  }
}

/// A triangle, its points at eighths of its edges and of its inside, and some segments between them.
DividedFace drawFace(std::vector<LatticePoint>& points, Draw& draw)
{
  const auto corner = [&] {
    return LatticePoint{draw.in(-90, 90) * 80000, draw.in(-90, 90) * 80000, draw.in(-90, 90) * 80000};
  };
  const std::array<LatticePoint, 3> corners{corner(), corner(), corner()};
  const auto add = [&](std::int64_t i, std::int64_t j) {
    LatticePoint p;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = ((8 - i - j) * corners[0][axis] + i * corners[1][axis] + j * corners[2][axis]) / 8;
    }
    points.push_back(p);
    return static_cast<Index>(points.size() - 1);
  };
  DividedFace face;
  face.corners = {add(0, 0), add(8, 0), add(0, 8)};
  for (std::int64_t i = 1; i < 8; ++i)
  {
    const std::array<std::array<std::int64_t, 2>, 3> along{{{i, 0}, {8 - i, i}, {0, 8 - i}}};
    for (std::size_t side = 0; side < 3; ++side)
    {
      if (draw.in(0, 2) == 0)
      {
        face.alongEdges.at(side).push_back(add(along.at(side)[0], along.at(side)[1]));
      }
    }
    for (std::int64_t j = 1; i + j < 8; ++j)
    {
      if (draw.in(0, 3) == 0)
      {
        face.inside.push_back(add(i, j));
      }
    }
  }
  for (std::int64_t i = draw.in(0, 6); i > 0; --i)
  {
    const Index a = draw.below(points.size());
    const Index b = draw.below(points.size());
    if (a != b)
    {
      face.segments.push_back(edgeKey(a, b));
    }
  }
  return face;
}

TEST(FaceTriangulation, HasTheOutlineOfTheFaceAndItsSegments)
{
  Draw draw(7);
  for (int round = 0; round < 300; ++round)
  {
    std::vector<LatticePoint> points;
    DividedFace face = drawFace(points, draw);
    const DividedFace before = face;
    const Vec3 normal = between(points[0], points[1]).cross(between(points[0], points[2]));
    Triangles triangles{{9, 8, 7}};
    triangulateFace(points, face, reach, triangles);
    ASSERT_EQ(triangles.front(), (std::array<Index, 3>{9, 8, 7})) << "it appends";
    triangles.erase(triangles.begin());
    EXPECT_EQ(boundaryOf(triangles), outlineOf(before));
    double area = 0.0;
    std::set<Index> used;
    for (const auto& t : triangles)
    {
      const Vec3 ofPiece = between(points[t[0]], points[t[1]]).cross(between(points[t[0]], points[t[2]]));
      EXPECT_GT(ofPiece.dot(normal), 0.0) << round;
      area += ofPiece.norm();
      used.insert(t.begin(), t.end());
    }
    EXPECT_NEAR(area, normal.norm(), 1e-5 * normal.norm());
    EXPECT_EQ(used.size(), points.size()) << "each point is in the triangulation";
    const std::set<EdgeKey> edges = edgesOf(triangles);
    std::ranges::for_each(before.segments, [&](const EdgeKey& segment) { expectRow(points, edges, segment); });
  }
}

TEST(FaceTriangulation, KeepsATriangleWithoutPoints)
{
  for (const auto& corners : {std::array<Index, 3>{0, 1, 2}, std::array<Index, 3>{2, 1, 0}})
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::vector<LatticePoint> points{placed(0, 0, axis, 0), placed(500, 0, axis, 0), placed(0, 500, axis, 0)};
      DividedFace face{corners, {}, {}, {}};
      Triangles triangles;
      triangulateFace(points, face, reach, triangles);
      ASSERT_EQ(triangles.size(), 1u);
      EXPECT_EQ(boundaryOf(triangles), boundaryOf({corners}));
    }
  }
}

TEST(FaceTriangulation, JoinsNoPointsAlongAnEdgeThatRoundingTookBeyondIt)
{
  // The points of the longest edge lie up to two lattice units beyond it or within.
  for (const std::int64_t offset : {-2, -1, 0, 1, 2})
  {
    std::vector<LatticePoint> points{{0, 0, 0}, {9000, 0, 0}, {3000, 6000, 0}, {3000, offset, 0}, {6000, -offset, 0}};
    DividedFace face{{0, 1, 2}, {{{3, 4}, {}, {}}}, {}, {}};
    const DividedFace before = face;
    Triangles triangles;
    triangulateFace(points, face, reach, triangles);
    EXPECT_EQ(triangles.size(), 3u);
    EXPECT_EQ(boundaryOf(triangles), outlineOf(before));
    for (const auto& t : triangles)
    {
      EXPECT_TRUE(contains(t, 2)) << offset;
    }
  }
}

TEST(FaceTriangulation, CutsAFaceWithoutAreaIntoAFan)
{
  Draw draw(8);
  for (int round = 0; round < 300; ++round)
  {
    std::vector<LatticePoint> points;
    for (std::int64_t i = 0; i < 10; ++i)
    {
      points.push_back({100 * i, 200 * i, -300 * i});
    }
    DividedFace face{{0, 9, draw.below(8) + 1}, {}, {}, {}};
    for (Index p = 1; p < 9; ++p)
    {
      if (p != face.corners[2] && draw.in(0, 1) == 0)
      {
        face.alongEdges[0].push_back(p);
      }
      if (p > face.corners[2] && draw.in(0, 1) == 0)
      {
        face.alongEdges[1].insert(face.alongEdges[1].begin(), p);
      }
      if (p < face.corners[2] && draw.in(0, 1) == 0)
      {
        face.alongEdges[2].insert(face.alongEdges[2].begin(), p);
      }
    }
    Triangles triangles;
    triangulateFace(points, face, reach, triangles);
    EXPECT_EQ(boundaryOf(triangles), outlineOf(face));
    std::set<std::array<Index, 3>> seen;
    for (std::array<Index, 3> t : triangles)
    {
      std::ranges::sort(t);
      EXPECT_TRUE(seen.insert(t).second) << "no two triangles cover each other";
    }
  }
}

TEST(FaceTriangulation, OfALineWithAllPointsOnBothSidesIsEmpty)
{
  std::vector<LatticePoint> points{{0, 0, 0}, {40, 0, 0}, {20, 0, 0}, {10, 0, 0}, {30, 0, 0}};
  DividedFace face{{0, 1, 2}, {{{3, 2, 4}, {4}, {3}}}, {}, {}};
  Triangles triangles;
  triangulateFace(points, face, reach, triangles);
  EXPECT_THAT(triangles, IsEmpty());
}

} // namespace
