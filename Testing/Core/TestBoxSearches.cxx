// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests searches among boxes, clipping, and nearest points, each against a naive reference.
#include "Surface/Search/BoxTree.h"

#include "Support/QuietContext.h"
#include "Surface/Search/BoxPairs.h"
#include "Surface/Search/BoxRaster.h"
#include "Surface/Search/BoxTests.h"
#include "Surface/Search/Distance.h"
#include "Surface/Search/Slabs.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::quietContext;

/// Draws random numbers, points and boxes.
class Draw
{
public:
  explicit Draw(unsigned seed) : random_(seed) {}

  std::int64_t in(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 vector(double reach) { return {real(-reach, reach), real(-reach, reach), real(-reach, reach)}; }
  LatticePoint point(std::int64_t low, std::int64_t high) { return {in(low, high), in(low, high), in(low, high)}; }

  /// Returns a box with its low corner in [low, high] and sides of 0 to `longest`.
  LatticeBox box(std::int64_t low, std::int64_t high, std::int64_t longest)
  {
    LatticeBox made{point(low, high), {}};
    for (int axis = 0; axis < 3; ++axis)
    {
      made.high[axis] = made.low[axis] + in(0, longest);
    }
    return made;
  }

private:
  std::mt19937 random_;
};

bool areTouching(const LatticeBox& a, const LatticeBox& b)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis])
    {
      return false;
    }
  }
  return true;
}

bool isSame(const LatticeBox& a, const LatticeBox& b) { return a.low == b.low && a.high == b.high; }

LatticeBox moved(LatticeBox box, std::int64_t by)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] += by;
    box.high[axis] += by;
  }
  return box;
}

std::vector<NumberedBox> numbered(const std::vector<LatticeBox>& boxes)
{
  std::vector<NumberedBox> out;
  for (const LatticeBox& box : boxes)
  {
    out.push_back({box, static_cast<Index>(out.size())});
  }
  return out;
}

// Boxes of triangles.

TEST(BoxPairs, BoundsHoldTheLowestAndHighestOfEachAxis)
{
  const auto boxes = numbered({{{0, 5, 2}, {1, 6, 3}}, {{-4, 7, 2}, {-3, 9, 2}}, {{0, 6, -8}, {2, 6, 1}}});
  EXPECT_TRUE(isSame(boundsOf(boxes), {{-4, 5, -8}, {2, 9, 3}}));
  EXPECT_TRUE(isSame(boundsOf(std::vector<NumberedBox>{boxes[1]}), boxes[1]));
}

TEST(BoxPairs, BoxesOfTrianglesHaveTheMarginOnAllSides)
{
  TriangleSoup soup;
  soup.points = {{9, 9, 9}, {1, 20, 3}, {4, 2, 30}, {10, 5, 6}};
  soup.add({1, 2, 3}, 0, 0);
  soup.add({0, 1, 2}, 0, 1);
  const NumberedBox box = boxOf(soup, 0, 2);
  EXPECT_TRUE(isSame(box, {{-1, 0, 1}, {12, 22, 32}}));
  EXPECT_EQ(box.id, 0u);
  EXPECT_TRUE(isSame(boxOf(soup, 1, 0), {{1, 2, 3}, {9, 20, 30}}));
}

TEST(BoxPairs, BoxesAreInTheOrderOfTheTriangles)
{
  Draw draw(1);
  TriangleSoup soup;
  std::vector<Index> some;
  for (Index t = 0; t < 9000; ++t)
  {
    soup.points.insert(soup.points.end(), {draw.point(0, 99), draw.point(0, 99), draw.point(0, 99)});
    soup.add({3 * t, 3 * t + 1, 3 * t + 2}, 0, t);
    some.push_back(static_cast<Index>((t * 7001) % 9000));
  }
  const ThreadExecutor executor(2);
  const std::vector<NumberedBox> boxes = boxesOf(soup, some, 3, quietContext(executor));
  ASSERT_EQ(boxes.size(), some.size());
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    EXPECT_EQ(boxes[i].id, some[i]);
    EXPECT_TRUE(isSame(boxes[i], boxOf(soup, some[i], 3)));
  }
  EXPECT_TRUE(boxesOf(soup, {}, 3, quietContext()).empty());
}

// Searches in trees and rasters.

TEST(BoxPairs, AreThoseOfBoxesOfOtherIdsThatTouch)
{
  Draw draw(2);
  for (const std::size_t count : {0u, 1u, 2u, 30u, 90u})
  {
    std::vector<NumberedBox> first;
    std::vector<NumberedBox> second;
    for (std::size_t i = 0; i < count; ++i)
    {
      first.push_back({draw.box(0, 12, 2), static_cast<Index>(draw.in(0, 40))});
      second.push_back({draw.box(0, 12, 2), static_cast<Index>(draw.in(0, 40))});
    }
    std::multiset<std::pair<Index, Index>> expected;
    for (const NumberedBox& a : first)
    {
      for (const NumberedBox& b : second)
      {
        if (a.id != b.id && areTouching(a, b))
        {
          expected.emplace(a.id, b.id);
        }
      }
    }
    std::multiset<std::pair<Index, Index>> found;
    forBoxPairs(first, second, quietContext(), [&](Index a, Index b) { found.emplace(a, b); });
    EXPECT_EQ(found, expected) << count;
  }
}

/// Compares searches from each place on with a look at all boxes.
void expectFindsTouching(const BoxTree& tree, const LatticeBox& box, std::size_t first)
{
  std::multiset<std::size_t> expected;
  for (std::size_t place = first; place < tree.size(); ++place)
  {
    if (areTouching(tree.box(place), box))
    {
      expected.insert(place);
    }
  }
  std::multiset<std::size_t> found;
  tree.eachTouching(box, first, [&](std::size_t place) { found.insert(place); });
  EXPECT_EQ(found, expected) << tree.size() << " boxes, from place " << first;
}

TEST(BoxTree, FindsAllFromAPlaceOnForAnyNumberOfBoxes)
{
  Draw draw(3);
  for (std::size_t count = 0; count < 80; ++count)
  {
    const std::int64_t far = draw.in(0, 2) * ((std::int64_t{1} << 39) + 12345);
    std::vector<LatticeBox> boxes(count);
    std::ranges::generate(boxes, [&] { return moved(draw.box(0, 20, draw.in(0, 3) == 0 ? 18 : 3), far); });
    const BoxTree tree(numbered(boxes), quietContext());
    ASSERT_EQ(tree.size(), count);
    for (std::size_t first = 0; first <= count + 1; ++first)
    {
      expectFindsTouching(tree, moved(draw.box(-2, 22, 2), far), first);
    }
    expectFindsTouching(tree, moved({{-1, -1, -1}, {50, 50, 50}}, far), 0);
  }
}

TEST(BoxTree, HoldsEachBoxOnce)
{
  Draw draw(4);
  std::vector<LatticeBox> boxes(600);
  std::ranges::generate(boxes, [&] { return draw.box(-50, 50, std::int64_t{1} << draw.in(0, 20)); });
  const BoxTree tree(numbered(boxes), quietContext());
  std::vector<int> times(boxes.size(), 0);
  for (std::size_t place = 0; place < tree.size(); ++place)
  {
    const NumberedBox& box = tree.box(place);
    EXPECT_TRUE(isSame(box, boxes.at(box.id)));
    ++times[box.id];
  }
  EXPECT_EQ(times, std::vector<int>(boxes.size(), 1));
}

std::vector<Index> orderOf(const std::vector<LatticeBox>& boxes)
{
  const BoxTree tree(numbered(boxes), quietContext());
  std::vector<Index> ids;
  for (std::size_t place = 0; place < tree.size(); ++place)
  {
    ids.push_back(tree.box(place).id);
  }
  return ids;
}

TEST(BoxTree, SortsBySizeInStepsOfFour)
{
  std::vector<LatticeBox> boxes;
  for (const std::int64_t length : {64, 63, 16, 15, 4, 3, 1, 0})
  {
    boxes.push_back({{100, 7, 7}, {100 + length / 2, 7 + length, 7}});
  }
  // Boxes 1 and 2, 3 and 4, 5 and 6 are of one size; centers along y decide.
  EXPECT_EQ(orderOf(boxes), (std::vector<Index>{7, 6, 5, 4, 3, 2, 1, 0}));
}

TEST(BoxTree, SortsBoxesOfOneSizeAlongTheMortonCurveOfTheirCenters)
{
  std::vector<LatticeBox> boxes;
  for (int i = 7; i >= 0; --i)
  {
    const LatticePoint low{4 * (i % 2), 4 * (i / 2 % 2), 4 * (i / 4)};
    boxes.push_back({low, {low[0] + 2, low[1] + 2, low[2] + 2}});
  }
  EXPECT_EQ(orderOf(boxes), (std::vector<Index>{7, 6, 5, 4, 3, 2, 1, 0}));
}

/// The cells of a raster of 64 cells, found by division.
std::set<LatticePoint> cellsOf(const LatticeBox& box, const LatticeBox& bounds, std::int64_t size)
{
  std::set<LatticePoint> cells;
  const auto isIn = [&](int axis, std::int64_t cell) {
    const std::int64_t low = bounds.low[axis] + cell * size;
    const std::int64_t high = std::min(low + size - 1, bounds.high[axis]);
    return low <= bounds.high[axis] && box.low[axis] <= high && box.high[axis] >= low;
  };
  for (std::int64_t x = 0; x < 64; ++x)
  {
    for (std::int64_t y = 0; y < 64 && isIn(0, x); ++y)
    {
      for (std::int64_t z = 0; z < 64 && isIn(1, y); ++z)
      {
        if (isIn(2, z))
        {
          cells.insert({x, y, z});
        }
      }
    }
  }
  return cells;
}

/// The smallest power of two of which 64 hold the longest side.
std::int64_t cellSize(const LatticeBox& bounds)
{
  std::int64_t size = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    while ((bounds.high[axis] - bounds.low[axis]) / size > 63)
    {
      size *= 2;
    }
  }
  return size;
}

TEST(BoxRaster, FindsBoxesWithACommonCell)
{
  Draw draw(5);
  // The longest side is 62, 63, 64, 127 and 128 long: cells double between 63 and 64, and again after 127.
  for (const std::int64_t length : {0, 62, 63, 64, 127, 128, 1000})
  {
    std::vector<NumberedBox> boxes = numbered({{{-7, 3, 5}, {-7, 3, 5}}, {{-7, 3 + length, 5}, {-7, 3 + length, 5}}});
    for (Index i = 2; i < 12; ++i)
    {
      const LatticePoint p{draw.in(-7, -7 + length), draw.in(3, 3 + length), draw.in(5, 5 + length)};
      boxes.push_back({{p, p}, i});
    }
    const LatticeBox bounds = boundsOf(boxes);
    std::set<LatticePoint> taken;
    for (const NumberedBox& box : boxes)
    {
      taken.merge(cellsOf(box, bounds, cellSize(bounds)));
    }
    const BoxRaster raster(boxes);
    for (int i = 0; i < 200; ++i)
    {
      const LatticeBox box = draw.box(-10, 8 + length, i % 2 == 0 ? 1 : length / 8);
      const auto cells = cellsOf(box, bounds, cellSize(bounds));
      const bool isShared = std::ranges::any_of(cells, [&](const LatticePoint& cell) { return taken.contains(cell); });
      EXPECT_EQ(raster.mayTouch(box), isShared && areTouching(box, bounds)) << length;
    }
    for (const NumberedBox& box : boxes)
    {
      EXPECT_TRUE(raster.mayTouch(box)) << length;
    }
  }
}

TEST(BoxRaster, OfOnePointHoldsNoMore)
{
  const BoxRaster raster(numbered({{{5, 6, 7}, {5, 6, 7}}}));
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const std::int64_t offset : {-1, 0, 1})
    {
      LatticePoint p{5, 6, 7};
      p[axis] += offset;
      EXPECT_EQ(raster.mayTouch({p, p}), offset == 0);
    }
  }
}

// Clipping and box tests.

/// Both ends of the part in the box are among the start, the end, and the crossings of planes.
SegmentRange naiveClip(const Vec3& low, const Vec3& high, const Vec3& along, double farthest)
{
  std::vector<double> places{0.0, farthest};
  for (int axis = 0; axis < 3; ++axis)
  {
    if (along[axis] != 0.0)
    {
      places.insert(places.end(), {low[axis] / along[axis], high[axis] / along[axis]});
    }
  }
  SegmentRange range{1.0, 0.0};
  for (const double t : places)
  {
    const Vec3 p = t * along;
    if (t >= 0.0 && t <= farthest && (p.array() >= low.array()).all() && (p.array() <= high.array()).all())
    {
      range = range.empty() ? SegmentRange{t, t} : SegmentRange{std::min(range.begin, t), std::max(range.end, t)};
    }
  }
  return range;
}

void expectSame(const SegmentRange& found, const SegmentRange& expected)
{
  ASSERT_EQ(found.empty(), expected.empty());
  if (!expected.empty())
  {
    EXPECT_EQ(found.begin, expected.begin);
    EXPECT_EQ(found.end, expected.end);
  }
}

TEST(Slabs, ClipLinesAsPlaneByPlane)
{
  Draw draw(6);
  constexpr std::array<double, 9> steps{0.0, 1.0, 2.0, 4.0, 8.0, -1.0, -2.0, -4.0, -8.0}; // division is exact
  int empty = 0;
  for (int round = 0; round < 20000; ++round)
  {
    const LatticeBox box = draw.box(-8, 3, 9);
    Vec3 along;
    for (int axis = 0; axis < 3; ++axis)
    {
      along[axis] = steps.at(static_cast<std::size_t>(draw.in(0, 8)));
    }
    const double farthest = 0.5 * static_cast<double>(draw.in(1, 6));
    const SegmentRange expected = naiveClip(toVector(box.low), toVector(box.high), along, farthest);
    expectSame(clipLine(toVector(box.low), toVector(box.high), along, farthest), expected);
    empty += expected.empty() ? 1 : 0;
  }
  EXPECT_GT(empty, 2000) << "the test means nothing otherwise";
  EXPECT_LT(empty, 18000);
}

TEST(Slabs, ClipSegmentsAsLinesFromTheirStart)
{
  Draw draw(7);
  for (int round = 0; round < 20000; ++round)
  {
    const LatticeBox box = draw.box(-5, 5, 5);
    const LatticePoint a = draw.point(-8, 8);
    LatticePoint b = a;
    for (int axis = 0; axis < 3; ++axis)
    {
      b[axis] += draw.in(-1, 1) * (std::int64_t{1} << draw.in(0, 4));
    }
    expectSame(clipSegment(box, a, b), naiveClip(between(a, box.low), between(a, box.high), between(a, b), 1.0));
  }
}

/// Clips a polygon to a box, plane by plane (Sutherland and Hodgman 1974). Returns true if anything is left.
bool naiveTouches(std::vector<Vec3> polygon, const LatticeBox& box)
{
  for (int side = 0; side < 6; ++side)
  {
    const int axis = axisOf(side);
    const double sign = isUpper(side) ? 1.0 : -1.0;
    const double plane = sign * static_cast<double>(isUpper(side) ? box.high[axis] : box.low[axis]);
    std::vector<Vec3> left;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Vec3& p = polygon[i];
      const Vec3& q = polygon[(i + 1) % polygon.size()];
      const double ofP = plane - sign * p[axis];
      const double ofQ = plane - sign * q[axis];
      if (ofP >= 0.0)
      {
        left.push_back(p);
      }
      if (ofP * ofQ < 0.0)
      {
        left.push_back(p + ofP / (ofP - ofQ) * (q - p));
      }
    }
    polygon = std::move(left);
  }
  return !polygon.empty();
}

/// Checks that a test finds what lies in the box, and nothing that is farther than six units from it.
void expectWithinRounding(bool found, const std::vector<Vec3>& polygon, const LatticeBox& box)
{
  EXPECT_TRUE(found || !naiveTouches(polygon, box));
  EXPECT_TRUE(!found || naiveTouches(polygon, grown(box, 6)));
}

TEST(BoxTests, FindTrianglesThatTouchUpToRounding)
{
  Draw draw(8);
  int touching = 0;
  for (int round = 0; round < 4000; ++round)
  {
    const LatticePoint a = draw.point(-2000, 2000);
    const LatticePoint b = draw.point(-2000, 2000);
    const LatticePoint c = round % 20 == 0 ? a : draw.point(-2000, 2000);
    TriangleBoxTest test(a, b, c);
    const std::int64_t longest = draw.in(0, 1) * 900 + 300;
    LatticeBox box = draw.box(-1500, 1000, longest);
    for (int i = 0; i < 8; ++i)
    {
      // The same box elsewhere, and others.
      box = i % 2 == 0 ? moved(box, draw.in(-500, 500)) : draw.box(-1500, 1000, longest);
      const bool found = test.touches(box);
      expectWithinRounding(found, {toVector(a), toVector(b), toVector(c)}, box);
      EXPECT_EQ(found, touches(box, a, b, c));
      touching += found ? 1 : 0;
    }
  }
  EXPECT_GT(touching, 2000);
  EXPECT_LT(touching, 30000);
}

TEST(BoxTests, FindTrianglesThatTouchOnlyACorner)
{
  const LatticeBox box{{0, 0, 0}, {100, 100, 100}};
  for (const std::int64_t beyond : {0, 30})
  {
    const std::int64_t reach = 300 + beyond;
    EXPECT_EQ(touches(box, {reach, 0, 0}, {0, reach, 0}, {0, 0, reach}), beyond == 0);
    const std::int64_t across = 200 + beyond; // an edge passes the box's upright edge
    EXPECT_EQ(touches(box, {across, 0, 50}, {0, across, 50}, {2 * across, 2 * across, 60}), beyond == 0);
  }
  EXPECT_TRUE(touches(box, {100, 100, 100}, {200, 300, 200}, {300, 200, 200}));
  EXPECT_FALSE(touches(box, {101, 0, 0}, {101, 100, 0}, {101, 0, 100})) << "bounds are exact";
}

TEST(BoxTests, FindSegmentsThatTouchUpToRounding)
{
  Draw draw(9);
  int touching = 0;
  for (int round = 0; round < 20000; ++round)
  {
    const LatticeBox box = draw.box(-600, 300, 500);
    const LatticePoint a = draw.point(-1000, 1000);
    const LatticePoint b = round % 10 == 0 ? a : draw.point(-1000, 1000);
    const bool found = touches(box, a, b);
    expectWithinRounding(found, {toVector(a), toVector(b)}, box);
    touching += found ? 1 : 0;
  }
  EXPECT_GT(touching, 500);
  EXPECT_LT(touching, 19500);
}

// Nearest points.

/// True if x is the place nearest to p in the convex hull of some points, of which x is one: no way to a point leads
/// nearer.
bool isNearestIn(const std::vector<Vec3>& hull, const Vec3& p, const Vec3& x)
{
  return std::ranges::all_of(hull, [&](const Vec3& v) { return (p - x).dot(v - x) <= 1e-9; });
}

bool isOnSegment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  return std::abs((x - a).norm() + (x - b).norm() - (b - a).norm()) < 1e-7;
}

bool isOnTriangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const auto area = [](const Vec3& u, const Vec3& v) { return u.cross(v).norm(); };
  const bool isInside =
      std::abs(area(a - x, b - x) + area(b - x, c - x) + area(c - x, a - x) - area(b - a, c - a)) < 1e-7;
  const bool isFlat = area(b - a, c - a) < 1e-9;
  return isFlat ? isOnSegment(x, a, b) || isOnSegment(x, b, c) || isOnSegment(x, c, a) : isInside;
}

TEST(Distance, NearestOnASegmentIsNearerThanAllOthers)
{
  Draw draw(10);
  for (int round = 0; round < 5000; ++round)
  {
    const Vec3 p = draw.vector(2.0);
    const Vec3 a = draw.vector(1.0);
    const Vec3 b = round % 10 == 0 ? a : draw.vector(1.0);
    const Vec3 x = nearestOnSegment(p, a, b);
    EXPECT_TRUE(isOnSegment(x, a, b));
    EXPECT_TRUE(isNearestIn({a, b}, p, x));
  }
}

/// Some triangles are long, obtuse, or lines or points.
std::array<Vec3, 3> drawTriangle(Draw& draw, int round)
{
  std::array<Vec3, 3> t{draw.vector(1.0), draw.vector(1.0), draw.vector(1.0)};
  switch (round % 8)
  {
    case 0:
      t[2] = t[0] + 0.25 * (t[1] - t[0]) + 0.05 * draw.vector(1.0);
      break;
    case 1:
      t = {Vec3(0, 0, 0), Vec3(0.5, 0.25, -1), Vec3(1, 0.5, -2)};
      std::ranges::rotate(t, t.begin() + draw.in(0, 2));
      break;
    case 2:
      t[1] = t[2] = t[0];
      break;
    default:
      break;
  }
  return t;
}

TEST(Distance, NearestOnATriangleIsNearerThanAllOthers)
{
  Draw draw(11);
  for (int round = 0; round < 8000; ++round)
  {
    const auto [a, b, c] = drawTriangle(draw, round);
    const Vec3 p = draw.vector(round % 3 == 0 ? 0.5 : 2.0);
    const Vec3 x = nearestOnTriangle(p, a, b, c);
    EXPECT_TRUE(isOnTriangle(x, a, b, c)) << round;
    EXPECT_TRUE(isNearestIn({a, b, c}, p, x)) << round;
  }
}

TEST(Distance, NearestOnATriangleIsExactAtCornersEdgesAndInside)
{
  const Vec3 a(0, 0, 0);
  const Vec3 b(4, 0, 0);
  const Vec3 c(0, 4, 0);
  const std::vector<std::pair<Vec3, Vec3>> places{
      {{1, 1, 5}, {1, 1, 0}},  {{1, 1, -5}, {1, 1, 0}}, {{-1, -1, 2}, a},       {{6, -1, 0}, b},        {{-1, 7, 0}, c},
      {{2, -3, 1}, {2, 0, 0}}, {{-3, 2, 1}, {0, 2, 0}}, {{4, 4, 1}, {2, 2, 0}}, {{2, 0, 0}, {2, 0, 0}}, {b, b}};
  for (const auto& [p, expected] : places)
  {
    EXPECT_LT((nearestOnTriangle(p, a, b, c) - expected).norm(), 1e-12);
    EXPECT_LT((nearestOnTriangle(p, c, b, a) - expected).norm(), 1e-12);
  }
}

TEST(Distance, PlacesAreTakenIfTheyAreNearerThanAllBefore)
{
  NearestPlace nearest{Vec3(1, 0, 0)};
  EXPECT_FALSE(nearest.found());
  EXPECT_FALSE(nearest.place().has_value());
  EXPECT_TRUE(nearest.offer({4, 0, 0}));
  EXPECT_TRUE(nearest.found());
  EXPECT_FALSE(nearest.offer({-2, 0, 0})) << "it is as near as the first";
  EXPECT_EQ(nearest.place(), Vec3(4, 0, 0));
  EXPECT_TRUE(nearest.offer({1, 2, 0}));
  EXPECT_FALSE(nearest.offer({1, 0, 2.5}));
  EXPECT_EQ(nearest.at, Vec3(1, 2, 0));
  EXPECT_EQ(nearest.squaredDistance, 4.0);
}

/// Each of the two places is the nearest to the other. The squared distance is convex, so that no pair is nearer.
void expectNearest(const NearestPair& pair, const std::vector<Vec3>& segment, const std::vector<Vec3>& other)
{
  EXPECT_TRUE(isOnSegment(pair.first, segment[0], segment[1]));
  EXPECT_TRUE(other.size() == 2 ? isOnSegment(pair.second, other[0], other[1])
                                : isOnTriangle(pair.second, other[0], other[1], other[2]));
  EXPECT_TRUE(isNearestIn(segment, pair.second, pair.first));
  EXPECT_TRUE(isNearestIn(other, pair.first, pair.second));
  EXPECT_EQ(pair.distance(), (pair.first - pair.second).norm());
}

TEST(Distance, NearestOfSegmentsIsNearerThanAllOtherPairs)
{
  Draw draw(12);
  for (int round = 0; round < 8000; ++round)
  {
    const Vec3 p = draw.vector(1.0);
    const Vec3 q = round % 11 == 0 ? p : draw.vector(1.0);
    const Vec3 a = draw.vector(1.0);
    const Vec3 parallel = a + draw.real(-2.0, 2.0) * (q - p);
    const Vec3 b = round % 7 == 0 ? a : (round % 5 == 0 ? parallel : draw.vector(1.0));
    SCOPED_TRACE(round);
    expectNearest(nearestOfSegments(p, q, a, b), {p, q}, {a, b});
  }
}

bool passesThrough(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 normal = (b - a).cross(c - a);
  const double ofP = normal.dot(p - a);
  const double ofQ = normal.dot(q - a);
  return ofP * ofQ <= 0.0 && isOnTriangle(p + ofP / (ofP - ofQ) * (q - p), a, b, c);
}

TEST(Distance, NearestOfASegmentAndATriangleIsNearerThanAllOtherPairs)
{
  Draw draw(13);
  int passing = 0;
  for (int round = 0; round < 8000; ++round)
  {
    const Vec3 p = draw.vector(1.5);
    const Vec3 q = draw.vector(1.5);
    const auto [a, b, c] = drawTriangle(draw, round);
    if (passesThrough(p, q, a, b, c))
    {
      ++passing;
      continue;
    }
    SCOPED_TRACE(round);
    expectNearest(nearestOfSegmentAndTriangle(p, q, a, b, c), {p, q}, {a, b, c});
  }
  EXPECT_LT(passing, 4000);
}

} // namespace
