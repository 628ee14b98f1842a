// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how lines are clipped, and which triangles and segments touch a box, against naive references.
#include "BoxSamples.h"
#include "Draw.h"
#include "Surface/Search/BoxTests.h"
#include "Surface/Search/Slabs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Draw;
using atria::testing::moved;

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

} // namespace
