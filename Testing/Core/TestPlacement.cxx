// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests places and boxes: turned axes, boxes on the lattice, exact predicates, the frame of the grid, Morton keys.
#include "Grid/Placement.h"

#include "Grid/GridFrame.h"
#include "Grid/LatticeBox.h"
#include "Grid/Morton.h"
#include "Grid/MortonShares.h"
#include "Grid/Predicates.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>
#include <set>

namespace {

using namespace atria;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;

class Random
{
public:
  explicit Random(unsigned seed) : bits(seed) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); }
  std::int64_t in(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(bits);
  }
  Vec3 vector(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  LatticePoint point(std::int64_t low, std::int64_t high) { return {in(low, high), in(low, high), in(low, high)}; }

private:
  std::mt19937 bits;
};

TEST(Directions, ArePairsOfAxes)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::string name = sideNames.at(static_cast<std::size_t>(direction));
    EXPECT_EQ("xyz"[axisOf(direction)], name[0]);
    EXPECT_EQ(isUpper(direction), name.substr(1) == "Max");
    EXPECT_EQ(axisOf(opposite(direction)), axisOf(direction));
    EXPECT_NE(isUpper(opposite(direction)), isUpper(direction));
  }
}

TEST(Box3, GrowsFromEmptyToThePointsItHolds)
{
  Box3 box;
  EXPECT_TRUE(box.empty());
  box.extend({1, -2, 3});
  EXPECT_FALSE(box.empty()) << "a point";
  box.extend({0, 5, 3});
  EXPECT_EQ(box.min, Vec3(0, -2, 3));
  EXPECT_EQ(box.max, Vec3(1, 5, 3));
  EXPECT_EQ(box.size(), Vec3(1, 7, 0));
  EXPECT_EQ(box.center(), Vec3(0.5, 1.5, 3));
  for (int axis = 0; axis < 3; ++axis)
  {
    Box3 turned = box;
    turned.min[axis] = turned.max[axis] + 1e-9;
    EXPECT_TRUE(turned.empty()) << axis;
  }
}

TEST(Box3, TouchesWhatMeetsItOnEveryAxis)
{
  const Box3 box{Vec3(0, 0, 0), Vec3(2, 2, 2)};
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double shift : {-2.0, -1.0, 0.0, 2.0})
    {
      const Vec3 by = shift * Vec3::Unit(axis);
      EXPECT_TRUE(box.touches({box.min + by, box.max + by})) << axis << " " << shift;
    }
    for (const double shift : {-2.001, 2.001})
    {
      const Vec3 by = shift * Vec3::Unit(axis);
      EXPECT_FALSE(box.touches({box.min + by, box.max + by})) << axis << " " << shift;
    }
  }
  EXPECT_FALSE(box.touches(Box3())) << "an empty one";
}

TEST(Box3, IsAsFarAsItsNearestPoint)
{
  const Box3 box{Vec3(0, 0, 0), Vec3(2, 3, 4)};
  EXPECT_EQ(box.squaredDistance({1, 1, 1}), 0.0);
  EXPECT_EQ(box.squaredDistance({2, 3, 4}), 0.0);
  EXPECT_EQ(box.squaredDistance({-3, 1, 1}), 9.0);
  EXPECT_EQ(box.squaredDistance({1, 5, 1}), 4.0);
  EXPECT_EQ(box.squaredDistance({3, -1, 6}), 6.0);
}

TEST(Placement, TurnsCounterclockwise)
{
  Random random(1);
  for (int round = 0; round < 200; ++round)
  {
    const double degrees = random.in(-800.0, 800.0);
    const double angle = degrees * std::numbers::pi / 180.0;
    const Placement placement(degrees);
    const Vec3 p = random.vector(10.0);
    const Vec3 xAxis(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 yAxis(-std::sin(angle), std::cos(angle), 0.0);
    EXPECT_NEAR((placement.toModel(p) - (p[0] * xAxis + p[1] * yAxis + p[2] * Vec3::UnitZ())).norm(), 0.0, rounding);
    EXPECT_NEAR((placement.fromModel(p) - Vec3(xAxis.dot(p), yAxis.dot(p), p[2])).norm(), 0.0, rounding);
    EXPECT_NEAR(std::remainder(placement.angle() - degrees, 360.0), 0.0, 1e-9);
    EXPECT_LE(std::abs(placement.angle()), 180.0);
  }
}

TEST(Placement, MakesQuarterTurnsExactly)
{
  const Vec3 p(0.1, 1.0 / 3.0, 0.7);
  const std::array<Vec3, 4> turned{p, Vec3(-p[1], p[0], p[2]), Vec3(-p[0], -p[1], p[2]), Vec3(p[1], -p[0], p[2])};
  for (int quarters = -9; quarters <= 9; ++quarters)
  {
    const Placement placement(90.0 * quarters);
    const Vec3& wanted = turned.at(static_cast<std::size_t>(quarters + 12) % 4);
    EXPECT_EQ(placement.toModel(p), wanted) << quarters;
    EXPECT_EQ(placement.fromModel(wanted), p) << quarters;
  }
}

TEST(Placement, TurnsBeyondAQuarterToTheSameBits)
{
  const Vec3 p(0.1, 1.0 / 3.0, 0.7);
  for (const double degrees : {10.0, -25.0, 44.0})
  {
    const Vec3 turned = Placement(degrees).toModel(p);
    EXPECT_EQ(Placement(degrees + 90.0).toModel(p), Vec3(-turned[1], turned[0], turned[2]));
    EXPECT_EQ(Placement(degrees - 90.0).toModel(p), Vec3(turned[1], -turned[0], turned[2]));
    EXPECT_EQ(Placement(degrees + 180.0).toModel(p), Vec3(-turned[0], -turned[1], turned[2]));
  }
}

TEST(Placement, OfNoAngleChangesNoBit)
{
  const Vec3 p(-0.0, 1e-320, infinity);
  for (const Placement& placement : {Placement(), Placement(0.0), Placement(-720.0)})
  {
    EXPECT_EQ(placement.angle(), 0.0);
    EXPECT_EQ(placement.fromModel(p), p);
    EXPECT_EQ(placement.toModel(p), p);
    EXPECT_TRUE(std::signbit(placement.toModel(p)[0]));
    EXPECT_TRUE(std::signbit(placement.fromModel(p)[0]));
  }
}

TEST(PlacedBox, ContainsItsBoundary)
{
  const PlacedBox box{Placement(90.0), {Vec3(1, 2, 3), Vec3(4, 6, 8)}}; // x is the model's y, y its -x
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool upper : {false, true})
    {
      Vec3 p = box.bounds.center();
      p[axis] = upper ? box.bounds.max[axis] : box.bounds.min[axis];
      EXPECT_TRUE(box.contains(box.axes.toModel(p)));
      p[axis] += upper ? 1e-9 : -1e-9;
      EXPECT_FALSE(box.contains(box.axes.toModel(p)));
    }
  }
  EXPECT_TRUE(box.contains({-5.9, 1.1, 3.5}));
  EXPECT_FALSE(box.contains({1.1, 5.9, 3.5}));
}

TEST(PlacedBox, IsTurnedAboutItsMiddle)
{
  Random random(2);
  for (int round = 0; round < 50; ++round)
  {
    const Vec3 low = random.vector(20.0);
    const Box3 box{low, low + random.vector(5.0).cwiseAbs()};
    const PlacedBox turned = turnedAboutMiddle(box, random.in(-400.0, 400.0));
    EXPECT_NEAR((turned.axes.toModel(turned.bounds.center()) - box.center()).norm(), 0.0, 1e-10);
    EXPECT_NEAR((turned.bounds.size() - box.size()).norm(), 0.0, 1e-10);
  }
  EXPECT_NEAR(turnedAboutMiddle({Vec3(1, 0, 0), Vec3(3, 1, 1)}, 25.0).axes.angle(), 25.0, rounding);
}

TEST(PlacedBox, ThatIsNotTurnedOrEmptyStaysAsItIs)
{
  const Box3 box{Vec3(0.1, 0.2, 0.3), Vec3(0.7, 1.9, 2.3)};
  EXPECT_EQ(turnedAboutMiddle(box, 360.0).bounds.min, box.min);
  EXPECT_EQ(turnedAboutMiddle(box, 0.0).bounds.max, box.max);
  EXPECT_TRUE(turnedAboutMiddle(Box3(), 30.0).bounds.empty());
}

TEST(Prism, HasBoundsAlongOtherAxes)
{
  Random random(3);
  for (const int sides : {3, 4, 7})
  {
    const PlacedPrism prism(PlacedBox{Placement(random.in(0.0, 90.0)), {Vec3(1, -2, 3), Vec3(5, 9, 4)}}, sides);
    const Placement axes(random.in(-90.0, 90.0));
    Box3 wanted;
    for (const PrismSide& side : prism.sides())
    {
      for (const double height : {3.0, 4.0})
      {
        wanted.extend(axes.fromModel(prism.axes.toModel({side.end[0], side.end[1], height})));
      }
    }
    const Box3 bounds = boundsAlong(axes, prism);
    EXPECT_NEAR((bounds.min - wanted.min).norm() + (bounds.max - wanted.max).norm(), 0.0, rounding);
  }
}

TEST(Prism, HasUprightSidesButForBottomAndTop)
{
  for (Index number = 0; number < sideNumbers; ++number)
  {
    EXPECT_EQ(isUprightSide(number), number != 4 && number != 5) << number;
  }
}

/// All points of a small cube of the lattice.
std::vector<LatticePoint> pointsOf(std::int64_t low, std::int64_t high)
{
  std::vector<LatticePoint> points;
  for (std::int64_t x = low; x <= high; ++x)
  {
    for (std::int64_t y = low; y <= high; ++y)
    {
      for (std::int64_t z = low; z <= high; ++z)
      {
        points.push_back({x, y, z});
      }
    }
  }
  return points;
}

std::set<LatticePoint> heldBy(const LatticeBox& box)
{
  std::set<LatticePoint> held;
  for (const LatticePoint& p : pointsOf(-2, 5))
  {
    if (box.contains(p))
    {
      held.insert(p);
    }
  }
  return held;
}

/// Boxes in [0, 3]^3, none of them empty.
std::vector<LatticeBox> someBoxes()
{
  Random random(4);
  std::vector<LatticeBox> boxes;
  for (int i = 0; i < 40; ++i)
  {
    boxes.push_back(boundsOf(random.point(0, 3), random.point(0, 3)));
  }
  return boxes;
}

TEST(LatticeBox, ContainsThePointsBetweenItsCorners)
{
  const LatticeBox box{{0, 1, 2}, {1, 3, 2}};
  std::set<LatticePoint> wanted;
  for (std::int64_t x = 0; x <= 1; ++x)
  {
    for (std::int64_t y = 1; y <= 3; ++y)
    {
      wanted.insert({x, y, 2});
    }
  }
  EXPECT_EQ(heldBy(box), wanted);
}

TEST(LatticeBox, IsEmptyIfItHoldsNoPoint)
{
  for (const LatticePoint& high : pointsOf(0, 2))
  {
    const LatticeBox box{{1, 1, 1}, high};
    EXPECT_EQ(box.empty(), heldBy(box).empty());
  }
}

TEST(LatticeBox, OverlapsWhereTwoHoldTheSamePoints)
{
  for (const LatticeBox& a : someBoxes())
  {
    const std::set<LatticePoint> inA = heldBy(a);
    for (const LatticeBox& b : someBoxes())
    {
      std::set<LatticePoint> inBoth;
      std::ranges::copy_if(inA, std::inserter(inBoth, inBoth.end()), [&](const auto& p) { return b.contains(p); });
      ASSERT_EQ(overlap(a, b), !inBoth.empty());
      ASSERT_EQ(heldBy(common(a, b)), inBoth);
    }
  }
}

TEST(LatticeBox, OfPointsIsTheSmallestThatHoldsThem)
{
  Random random(5);
  for (int round = 0; round < 50; ++round)
  {
    const std::array<LatticePoint, 3> p{random.point(-9, 9), random.point(-9, 9), random.point(-9, 9)};
    const LatticeBox box = boundsOf(p[0], p[1], p[2]);
    LatticeBox joined = boundsOf(p[0]);
    joined.extend(boundsOf(p[1], p[2]));
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(box.low[axis], std::min({p[0][axis], p[1][axis], p[2][axis]}));
      EXPECT_EQ(box.high[axis], std::max({p[0][axis], p[1][axis], p[2][axis]}));
    }
    EXPECT_EQ(joined.low, box.low);
    EXPECT_EQ(joined.high, box.high);
  }
}

TEST(LatticeBox, GrowsOnAllSides)
{
  const LatticeBox box = grown({{1, 2, 3}, {4, 5, 6}}, 10);
  EXPECT_EQ(box.low, (LatticePoint{-9, -8, -7}));
  EXPECT_EQ(box.high, (LatticePoint{14, 15, 16}));
}

/// Determinant by the rule of Sarrus.
Wide determinant(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
{
  return Wide(a[0]) * b[1] * c[2] + Wide(a[1]) * b[2] * c[0] + Wide(a[2]) * b[0] * c[1] - Wide(a[2]) * b[1] * c[0] -
         Wide(a[0]) * b[2] * c[1] - Wide(a[1]) * b[0] * c[2];
}

LatticePoint minus(const LatticePoint& a, const LatticePoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

LatticePoint unit(int axis)
{
  LatticePoint p{0, 0, 0};
  p[axis] = 1;
  return p;
}

/// The real configuration that the symbolic shift stands for, for coordinates of a few units: all are scaled by 10^9,
/// and grid points are shifted by 10^6, 10^3 and 1.
LatticePoint scaled(const LatticePoint& p)
{
  constexpr std::int64_t scale = 1000000000;
  return {scale * p[0], scale * p[1], scale * p[2]};
}

LatticePoint shifted(const LatticePoint& p)
{
  const LatticePoint at = scaled(p);
  return {at[0] + 1000000, at[1] + 1000, at[2] + 1};
}

/// Side of a line, seen against `axis`, on which the shifted grid point is.
int realSideOfLine(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p, int axis)
{
  return signOf(determinant(minus(scaled(b), scaled(a)), minus(shifted(p), scaled(a)), unit(axis)));
}

int realSideOfSegment(const LatticePoint& p, const LatticePoint& q, const LatticePoint& a, const LatticePoint& b)
{
  const LatticePoint from = shifted(p);
  return signOf(determinant(minus(scaled(a), from), minus(scaled(b), from), minus(shifted(q), from)));
}

bool areEqualAndNotZero(const std::array<int, 3>& signs)
{
  return signs[0] != 0 && signs[0] == signs[1] && signs[1] == signs[2];
}

TEST(Predicates, KnowTheSignsOfNumbersBeyondSixtyFourBits)
{
  const Wide large = Wide(1) << 100;
  EXPECT_EQ(signOf(0), 0);
  EXPECT_EQ(signOf(large), 1);
  EXPECT_EQ(signOf(-large), -1);
  EXPECT_EQ(signOf(Wide(1) << 64), 1);
}

TEST(Predicates, ProjectAreasAlongAxes)
{
  const LatticePoint origin{0, 0, 0};
  EXPECT_EQ(signOf(projectedArea(origin, {1, 0, 5}, {0, 1, -5}, 2)), 1) << "x to y is counterclockwise from above";
  Random random(6);
  for (int round = 0; round < 300; ++round)
  {
    const LatticePoint a = random.point(-9, 9);
    const LatticePoint b = random.point(-9, 9);
    const LatticePoint c = random.point(-9, 9);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_TRUE(projectedArea(a, b, c, axis) == determinant(minus(b, a), minus(c, a), unit(axis)));
    }
  }
}

TEST(Predicates, FindTheSideOfALineOfShiftedPoints)
{
  const std::vector<LatticePoint> points = pointsOf(0, 2);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const LatticePoint& a : points)
    {
      for (const LatticePoint& b : points)
      {
        const bool isOnePoint = a[(axis + 1) % 3] == b[(axis + 1) % 3] && a[(axis + 2) % 3] == b[(axis + 2) % 3];
        for (const LatticePoint& p : points)
        {
          const int side = sideOfLine(a, b, p, axis);
          ASSERT_EQ(side, realSideOfLine(a, b, p, axis));
          ASSERT_EQ(side == 0, isOnePoint);
        }
      }
    }
  }
}

TEST(Predicates, FindTheSideOfAPlaneOfShiftedPoints)
{
  Random random(7);
  for (int round = 0; round < 30000; ++round)
  {
    const LatticePoint a = random.point(0, 2);
    const LatticePoint b = random.point(0, 2);
    const LatticePoint c = random.point(0, 2);
    const LatticePoint p = random.point(0, 2);
    const LatticeNormal normal(a, b, c);
    const Wide volume =
        determinant(minus(scaled(b), scaled(a)), minus(scaled(c), scaled(a)), minus(shifted(p), scaled(a)));
    const bool hasNoArea = normal.n == std::array<Wide, 3>{0, 0, 0};
    ASSERT_EQ(normal.sideOf(a, p), signOf(volume));
    ASSERT_EQ(normal.sideOf(a, p) == 0, hasNoArea);
  }
}

TEST(Predicates, FindTheSideOfALineOnWhichAShiftedLinePasses)
{
  Random random(8);
  for (int round = 0; round < 30000; ++round)
  {
    const LatticePoint p = random.point(0, 2);
    const LatticePoint q = random.point(0, 2);
    const LatticePoint a = random.point(0, 2);
    const LatticePoint b = random.point(0, 2);
    const int side = sideOfSegment(p, q, a, b);
    ASSERT_EQ(side, realSideOfSegment(p, q, a, b));
    const LatticeNormal parallel({0, 0, 0}, minus(q, p), minus(b, a));
    const bool isParallel = parallel.n == std::array<Wide, 3>{0, 0, 0};
    ASSERT_EQ(side == 0, isParallel);
  }
}

TEST(Predicates, FindTheTrianglesThatShiftedLinesMeet)
{
  Random random(9);
  for (int round = 0; round < 20000; ++round)
  {
    const LatticePoint a = random.point(0, 3);
    const LatticePoint b = random.point(0, 3);
    const LatticePoint c = random.point(0, 3);
    const LatticePoint p = random.point(0, 3);
    const LatticePoint q = random.point(0, 3);
    ASSERT_EQ(lineMeetsTriangle(a, b, c, p, q),
              areEqualAndNotZero(
                  {realSideOfSegment(p, q, a, b), realSideOfSegment(p, q, b, c), realSideOfSegment(p, q, c, a)}));
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool meets = lineMeetsTriangle(a, b, c, p, axis);
      ASSERT_EQ(meets, areEqualAndNotZero({realSideOfLine(a, b, p, axis), realSideOfLine(b, c, p, axis),
                                           realSideOfLine(c, a, p, axis)}));
      const LatticePoint along = minus(p, minus({0, 0, 0}, unit(axis)));
      ASSERT_EQ(meets, lineMeetsTriangle(a, b, c, p, along)) << "the line is the same";
    }
  }
}

TEST(Predicates, LetLinesCrossAClosedSurfaceTwiceOrNot)
{
  Random random(10);
  for (int round = 0; round < 300; ++round)
  {
    std::array<LatticePoint, 4> t;
    std::ranges::generate(t, [&] { return random.point(0, 2); });
    const auto crossings = [&](const LatticePoint& p, const auto& along) {
      return int(lineMeetsTriangle(t[0], t[1], t[2], p, along)) + int(lineMeetsTriangle(t[0], t[3], t[1], p, along)) +
             int(lineMeetsTriangle(t[1], t[3], t[2], p, along)) + int(lineMeetsTriangle(t[2], t[3], t[0], p, along));
    };
    for (const LatticePoint& p : pointsOf(0, 2))
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_EQ(crossings(p, axis) % 2, 0);
      }
      ASSERT_EQ(crossings(p, random.point(0, 2)) % 2, 0);
    }
  }
}

/// Axis i of the result is axis i - `turn` of the point.
LatticePoint turnedAxes(const LatticePoint& p, std::size_t turn)
{
  return {p[(3 - turn) % 3], p[(4 - turn) % 3], p[(5 - turn) % 3]};
}

TEST(Predicates, AreExactForTheLargestDifferences)
{
  // Rows of determinant -1: a product that is rounded or cut off changes the sign or the value.
  constexpr std::int64_t most = (std::int64_t{1} << 40) - 1;
  for (std::size_t turn = 0; turn < 3; ++turn)
  {
    const int axis = static_cast<int>(turn + 2) % 3;
    const LatticePoint a{-most / 2, -most / 2, -most / 2};
    const auto from = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      return turnedAxes({a[0] + x, a[1] + y, a[2] + z}, turn);
    };
    const LatticePoint b = from(most, most - 1, 0);
    const LatticePoint c = from(most - 1, most - 2, 0);
    const LatticePoint p = from(most, most - 1, 1);
    EXPECT_TRUE(projectedArea(a, b, c, axis) == -1);
    EXPECT_EQ(sideOfLine(a, b, c, axis), -1);
    for (const auto& [q, r, s] : {std::array{b, c, p}, std::array{c, p, b}, std::array{p, b, c}})
    {
      EXPECT_EQ(LatticeNormal(a, q, r).sideOf(a, s), -1);
      EXPECT_EQ(LatticeNormal(a, r, q).sideOf(a, s), 1);
      EXPECT_EQ(sideOfSegment(a, s, q, r), -1);
      EXPECT_EQ(sideOfSegment(a, s, r, q), 1);
    }
  }
}

/// Units of 1/16, octants of 1/2, a root of 8.
GridFrame smallFrame()
{
  GridFrame frame;
  frame.origin = {1, 2, 3};
  frame.finestSize = 0.5;
  frame.depth = 4;
  frame.subBits = 3;
  frame.domain = {Vec3(1.25, 2.75, 4.25), Vec3(8.75, 7.25, 5.75)};
  frame.domainLow = frame.toLattice(frame.domain.min);
  frame.domainHigh = frame.toLattice(frame.domain.max);
  return frame;
}

TEST(GridFrame, HasSizesByLevel)
{
  const GridFrame frame = smallFrame();
  EXPECT_EQ(frame.latticeUnit(), 0.0625);
  EXPECT_EQ(frame.rootSize(), 8.0);
  EXPECT_EQ(frame.sizeOf(0), 8.0);
  EXPECT_EQ(frame.sizeOf(4), 0.5);
  EXPECT_EQ(frame.latticeSize(4), 8);
  for (int level = 0; level <= frame.depth; ++level)
  {
    EXPECT_EQ(static_cast<double>(frame.latticeSize(level)) * frame.latticeUnit(), frame.sizeOf(level));
  }
}

TEST(GridFrame, ConvertsToTheLatticeAndBack)
{
  const GridFrame frame = smallFrame();
  EXPECT_EQ(frame.toLattice({1, 2, 3}), (LatticePoint{0, 0, 0}));
  EXPECT_EQ(frame.toLattice({1.0625, 2.125, 3.1875}), (LatticePoint{1, 2, 3}));
  EXPECT_EQ(frame.toLattice({0.97, 2.03, 3.04}), (LatticePoint{0, 0, 1})) << "the nearest one";
  EXPECT_EQ(frame.toLattice({0.96, 0.0, 3.09}), (LatticePoint{-1, -32, 1}));
  EXPECT_EQ(toVector({-1, 2, 5}), Vec3(-1, 2, 5));
  Random random(11);
  for (int round = 0; round < 100; ++round)
  {
    const LatticePoint p = random.point(-1000, 1000);
    const Vec3 model = frame.toModel(p);
    EXPECT_EQ(model, Vec3(1, 2, 3) + 0.0625 * toVector(p));
    EXPECT_EQ(frame.toLattice(model), p);
    EXPECT_EQ(frame.toModel(toVector(p)), model);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(frame.toModel(axis, static_cast<double>(p[axis])), model[axis]);
    }
  }
  EXPECT_EQ(frame.toModel(Vec3(0.5, 0, -0.5)), Vec3(1.03125, 2, 2.96875));
  EXPECT_EQ(frame.toModel(1, 0.5), 2.03125);
}

TEST(GridFrame, HasTheDomainStrictlyInside)
{
  const GridFrame frame = smallFrame();
  const LatticePoint middle{50, 50, 30};
  EXPECT_TRUE(frame.inDomain(middle));
  for (int axis = 0; axis < 3; ++axis)
  {
    LatticePoint p = middle;
    p[axis] = frame.domainLow[axis];
    EXPECT_FALSE(frame.inDomain(p)) << axis;
    ++p[axis];
    EXPECT_TRUE(frame.inDomain(p)) << axis;
    p[axis] = frame.domainHigh[axis];
    EXPECT_FALSE(frame.inDomain(p)) << axis;
    --p[axis];
    EXPECT_TRUE(frame.inDomain(p)) << axis;
  }
}

/// The planes that have a place just inside the domain within the octant.
unsigned planesSlowly(const GridFrame& frame, const LatticePoint& low, const LatticePoint& high)
{
  unsigned planes = 0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const int axis = axisOf(direction);
    const double inside = isUpper(direction) ? static_cast<double>(frame.domainHigh[axis]) - 0.5
                                             : static_cast<double>(frame.domainLow[axis]) + 0.5;
    const bool isWithin = static_cast<double>(low[axis]) < inside && inside < static_cast<double>(high[axis]);
    planes |= isWithin ? 1u << direction : 0u;
  }
  return planes;
}

TEST(GridFrame, HasPlanesInTheOctantOnTheirInnerSide)
{
  GridFrame frame;
  frame.domainLow = {1, 2, 3};
  frame.domainHigh = {5, 4, 6};
  for (const LatticePoint& low : pointsOf(0, 6))
  {
    for (std::int64_t size = 1; size <= 6; ++size)
    {
      const LatticePoint high{low[0] + size, low[1] + size, low[2] + size};
      ASSERT_EQ(frame.domainPlanes(low, high), planesSlowly(frame, low, high));
    }
  }
}

TEST(GridFrame, KnowsThePlanesAndTheBoxOfItsDomain)
{
  GridFrame frame = smallFrame();
  const std::vector<double> planes{1.25, 8.75, 2.75, 7.25, 4.25, 5.75};
  for (int direction = 0; direction < 6; ++direction)
  {
    EXPECT_EQ(frame.planeOf(direction), planes.at(static_cast<std::size_t>(direction)));
  }
  EXPECT_TRUE(frame.prism().isBox());
  EXPECT_EQ(frame.prism().bounds.min, frame.domain.min);
  EXPECT_EQ(frame.prism().bounds.max, frame.domain.max);
  frame.turnedDomain = PlacedPrism(PlacedBox{Placement(20.0), frame.domain}, 5);
  EXPECT_EQ(frame.prism().sides().size(), 5u);
}

GridOptions someOptions(Random& random)
{
  GridOptions options;
  options.sizeMin = std::exp2(random.in(-3.0, 3.0));
  options.sizeMid = options.sizeMin * random.in(1.0, 9.0);
  options.sizeMax = options.sizeMid * random.in(1.0, 50.0);
  options.startLevel = static_cast<int>(random.in(std::int64_t{-1}, std::int64_t{9}));
  options.finestAsked = random.in(0.0, 1.0) < 0.4 ? infinity : options.sizeMin * random.in(0.05, 1.5);
  options.domain.min = random.vector(100.0);
  const Vec3 octants(std::exp2(random.in(1.01, 7.0)), std::exp2(random.in(1.01, 7.0)), std::exp2(random.in(1.01, 7.0)));
  options.domain.max = options.domain.min + options.sizeMin * octants;
  return options;
}

/// Runs a check on the frames of many options.
void onSomeFrames(const std::function<void(const GridOptions&, const GridFrame&)>& check)
{
  Random random(12);
  for (int round = 0; round < 400; ++round)
  {
    const GridOptions options = someOptions(random);
    SCOPED_TRACE(round);
    check(options, makeGridFrame(options, options.domain));
  }
}

TEST(MadeFrame, HoldsTheDomainInTheSmallestRoot)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    const Vec3 below = (options.domain.min - frame.origin) / frame.finestSize;
    const Vec3 above = (frame.origin + Vec3::Constant(frame.rootSize()) - options.domain.max) / frame.finestSize;
    EXPECT_GE(below.minCoeff(), 0.5 - 1e-6) << "half an octant sticks out";
    EXPECT_GE(above.minCoeff(), 0.5 - 1e-6);
    EXPECT_GT(options.domain.size().maxCoeff() + frame.finestSize, 0.5 * frame.rootSize() * (1.0 - 1e-6));
    EXPECT_EQ(frame.domain.min, options.domain.min);
    EXPECT_EQ(frame.domain.max, options.domain.max);
  });
}

TEST(MadeFrame, HasItsLowerPlanesThroughCentersOfTheFinestOctants)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = (options.domain.min[axis] - frame.origin[axis]) / frame.finestSize;
      EXPECT_NEAR(at - std::floor(at), 0.5, 1e-6);
    }
  });
}

TEST(MadeFrame, HasTheFinestSizeThatIsRequested)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    EXPECT_LE(frame.finestSize, options.finestAsked);
    EXPECT_LE(frame.finestSize, options.sizeMin);
    EXPECT_GT(2.0 * frame.finestSize, std::min(options.finestAsked, options.sizeMin)) << "and none finer";
    EXPECT_EQ(frame.sizeOf(frame.featureLevel), options.sizeMin);
  });
}

TEST(MadeFrame, HasNoFinerLevelWhereRoundingIsAllThatAsksForIt)
{
  GridOptions options;
  options.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
  for (const double finest : {0.25, 0.25 * (1.0 - 1e-11)})
  {
    options.finestAsked = finest;
    EXPECT_EQ(makeGridFrame(options, {}).finestSize, 0.25);
  }
  options.finestAsked = 0.25 * (1.0 - 1e-6);
  EXPECT_EQ(makeGridFrame(options, {}).finestSize, 0.125);
}

/// Expects the size of `level` to be nearest to `size`, of all levels from `first` on.
void expectNearest(const GridFrame& frame, int level, double size, int first)
{
  ASSERT_GE(level, first);
  ASSERT_LE(level, frame.depth);
  for (int other = first; other <= frame.depth; ++other)
  {
    EXPECT_LE(std::abs(frame.sizeOf(level) - size), std::abs(frame.sizeOf(other) - size)) << other;
  }
}

TEST(MadeFrame, HasTheLevelsWhoseSizesAreNearest)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    expectNearest(frame, frame.midLevel, options.sizeMid, frame.startLevel);
    expectNearest(frame, frame.topLevel, options.sizeMax, frame.startLevel);
  });
}

TEST(MadeFrame, StartsWhereTwoOctantsFitInTheDomain)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    const double thinnest = options.domain.size().minCoeff();
    const int coarsest = coarsestLevelFor(frame);
    EXPECT_TRUE(coarsest == frame.depth || 2.0 * frame.sizeOf(coarsest) <= thinnest);
    EXPECT_TRUE(coarsest == 0 || 2.0 * frame.sizeOf(coarsest - 1) > thinnest);
    EXPECT_EQ(frame.startLevel, std::min(std::max(options.startLevel, coarsest), frame.depth));
  });
}

TEST(MadeFrame, MayHaveOctantsAsLargeAsTheRootAndNoLargestSize)
{
  GridOptions options;
  options.domain = {Vec3(0, 0, 0), Vec3(7, 7, 7)};
  options.sizeMax = infinity;
  options.startLevel = 0;
  const GridFrame frame = makeGridFrame(options, {});
  EXPECT_EQ(frame.depth, 3);
  EXPECT_EQ(frame.topLevel, frame.startLevel);
  EXPECT_EQ(frame.sizeOf(frame.startLevel), 2.0);
  options.domain.max = {8, 8, 8};
  const GridFrame larger = makeGridFrame(options, {});
  EXPECT_EQ(larger.sizeOf(larger.startLevel), 4.0) << "two of them are as long as the domain";
}

TEST(MadeFrame, HasTheDomainInTheMiddleOfTheSmallestOctantThatHoldsIt)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    for (int axis = 0; axis < 3 && frame.finestSize == options.sizeMin; ++axis)
    {
      const double octants = options.domain.size()[axis] / frame.finestSize;
      const double room = std::exp2(std::ceil(std::log2(octants + 1.0)));
      const double below = (options.domain.min[axis] - frame.origin[axis]) / frame.finestSize;
      const double above = room - below - octants;
      EXPECT_GE(above, 0.5 - 1e-6);
      EXPECT_GE(above - below, -1e-6);
      EXPECT_LT(above - below, 2.0 + 1e-6);
    }
  });
}

TEST(MadeFrame, WithLevelsBelowSizeMinHasItsPlanesNextToCentersOfItsOctantsWhereThereIsRoom)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    const double period = options.sizeMin / frame.finestSize;
    for (int axis = 0; axis < 3 && period > 1.0; ++axis)
    {
      const double spare = (frame.rootSize() - options.domain.size()[axis]) / frame.finestSize - 1.0;
      const double at = (options.domain.min[axis] - frame.origin[axis]) / frame.finestSize;
      if (spare >= 0.5 * period + 1e-6)
      {
        EXPECT_NEAR(std::fmod(at, period), 0.5 * period + 0.5, 1e-6);
      }
      else
      {
        EXPECT_NEAR(at, std::floor(0.5 * spare) + 0.5, 1e-6) << "half of what is to spare";
      }
    }
  });
}

TEST(MadeFrame, WithLevelsBelowSizeMinHasTheDomainInTheMiddleWithoutThatRoom)
{
  // Octants of SizeMin are 16 of the finest; the root is 256 of these, of which one sticks out.
  for (const int spare : {0, 5, 7, 8, 9, 23})
  {
    GridOptions options;
    options.finestAsked = 0.0625;
    options.domain = {Vec3(0, 0, 0), Vec3::Constant(0.0625 * (255 - spare))};
    const GridFrame frame = makeGridFrame(options, {});
    EXPECT_EQ(frame.rootSize(), 16.0);
    const double below = spare < 8 ? std::floor(0.5 * spare) + 0.5 : 8.5; // finest octants
    EXPECT_EQ(frame.origin, Vec3::Constant(-0.0625 * below)) << spare;
  }
}

TEST(MadeFrame, HasUpperPlanesThroughCentersWhereTheDomainIsAMultiple)
{
  Random random(13);
  for (int round = 0; round < 60; ++round)
  {
    GridOptions options;
    options.sizeMin = 0.1 * static_cast<double>(random.in(std::int64_t{1}, std::int64_t{9}));
    options.sizeMid = options.sizeMax = 2.0 * options.sizeMin;
    options.domain.min = random.vector(100.0);
    LatticePoint octants = random.point(3, 70);
    octants[0] = round % 2 == 0 ? 127 : octants[0]; // one more is a power of two
    options.domain.max = options.domain.min + options.sizeMin * toVector(octants);
    const GridFrame frame = makeGridFrame(options, options.domain);
    const std::int64_t longest = *std::ranges::max_element(octants);
    EXPECT_GE(std::int64_t{1} << frame.depth, longest + 1);
    EXPECT_LT(std::int64_t{1} << (frame.depth - 1), longest + 1) << "rounding adds no level";
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t finest = frame.latticeSize(frame.depth);
      EXPECT_EQ(frame.domainLow[axis] % finest, finest / 2);
      EXPECT_EQ(frame.domainHigh[axis] - frame.domainLow[axis], octants[axis] * finest);
    }
  }
}

TEST(MadeFrame, MayBeTwentyLevelsDeep)
{
  GridOptions options;
  const double most = static_cast<double>((1 << GridFrame::maximumDepth) - 1);
  options.domain = {Vec3(0, 0, 0), Vec3(4, most, 4)};
  EXPECT_EQ(makeGridFrame(options, {}).depth, GridFrame::maximumDepth);
  options.domain.max[1] += 1.0;
  EXPECT_THAT([&] { makeGridFrame(options, {}); }, ThrowsMessage<Error>(HasSubstr("at most 1048576 is possible")));
  options.domain.max[1] = 40.0;
  options.finestAsked = 1e-30;
  EXPECT_THROW(makeGridFrame(options, {}), Error);
}

TEST(MadeFrameError, SizesAreNotPositiveOrNotOrdered)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> sizes{{0, 2, 8}, {-1, 2, 8}, {nan, 2, 8}, {2, 1, 8}, {1, nan, 8}, {1, 3, 2}, {1, 2, nan}};
  for (const Vec3& size : sizes)
  {
    GridOptions options;
    options.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
    options.sizeMin = size[0];
    options.sizeMid = size[1];
    options.sizeMax = size[2];
    EXPECT_THAT([&] { makeGridFrame(options, {}); }, ThrowsMessage<Error>(HasSubstr("sizes must be positive")));
  }
  GridOptions equal;
  equal.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
  equal.sizeMid = equal.sizeMax = equal.sizeMin;
  EXPECT_NO_THROW(makeGridFrame(equal, {}));
  equal.sizeMid = equal.sizeMax = infinity;
  EXPECT_THROW(makeGridFrame(equal, {}), Error);
}

TEST(MadeFrameError, TheDomainIsEmptyOrThin)
{
  GridOptions options;
  EXPECT_THAT([&] { makeGridFrame(options, {}); }, ThrowsMessage<Error>(HasSubstr("the domain is empty")));
  for (int axis = 0; axis < 3; ++axis)
  {
    options.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
    options.domain.max[axis] = 2.0;
    EXPECT_NO_THROW(makeGridFrame(options, {})) << "two octants";
    options.domain.max[axis] = 1.999;
    EXPECT_THAT([&] { makeGridFrame(options, {}); },
                ThrowsMessage<Error>(HasSubstr("the domain is 1.999 long in " + std::string(1, "xyz"[axis]))));
    options.domain.max[axis] = infinity;
    EXPECT_THROW(makeGridFrame(options, {}), Error);
  }
}

/// Sets the lattice for an extent that reaches from the root's lower corner along an axis, by so many finest octants.
void fitAlong(GridFrame& frame, int axis, double octants)
{
  Box3 extent{frame.origin, frame.origin};
  extent.extend(frame.origin + octants * frame.finestSize * Vec3::Unit(axis));
  fitLattice(frame, extent);
}

TEST(FittedLattice, LosesOneBitWithEachDoublingOfTheExtent)
{
  GridFrame frame = smallFrame();
  fitLattice(frame, {});
  EXPECT_EQ(frame.subBits, 30) << "and has no more than that";
  for (int doubling = 5; doubling <= 30; ++doubling)
  {
    const int before = frame.subBits;
    const double octants = 0.99 * std::exp2(doubling);
    fitAlong(frame, doubling % 3, octants);
    EXPECT_LT(octants * static_cast<double>(frame.latticeSize(frame.depth)), std::exp2(40.0));
    EXPECT_TRUE(frame.subBits == before - 1 || (before == 30 && frame.subBits == 30)) << doubling;
    EXPECT_EQ(frame.domainLow, frame.toLattice(frame.domain.min));
    EXPECT_EQ(frame.domainHigh, frame.toLattice(frame.domain.max));
  }
  EXPECT_EQ(frame.subBits, 8) << "the fewest";
}

TEST(FittedLattice, HoldsExtentsOfABillionOctantsOnAnyAxis)
{
  const double most = std::exp2(30.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    GridFrame frame = smallFrame();
    EXPECT_NO_THROW(fitAlong(frame, axis, 0.999 * most));
    EXPECT_THAT([&] { fitAlong(frame, axis, 1.001 * most); }, ThrowsMessage<Error>(HasSubstr("remove stray geometry")));
    EXPECT_NO_THROW(fitAlong(frame, axis, -0.999 * most));
    EXPECT_THROW(fitAlong(frame, axis, -1.001 * most), Error);
    const Vec3 half = 0.5 * most * frame.finestSize * Vec3::Unit(axis);
    EXPECT_NO_THROW(fitLattice(frame, {-0.999 * half, 0.999 * half}));
    EXPECT_THROW(fitLattice(frame, {-1.001 * half, 1.001 * half}), Error);
  }
}

TEST(FittedLattice, HoldsTheRootIfTheExtentIsSmaller)
{
  GridFrame frame = smallFrame();
  frame.depth = 31;
  EXPECT_THROW(fitLattice(frame, {Vec3(1, 2, 3), Vec3(1, 2, 3)}), Error);
  frame.depth = 20;
  fitLattice(frame, {});
  const int bits = frame.subBits;
  EXPECT_LT(bits, 30);
  fitLattice(frame, frame.domain);
  EXPECT_EQ(frame.subBits, bits);
}

MortonKey spreadSlowly(std::uint32_t x)
{
  MortonKey key = 0;
  for (unsigned bit = 0; bit < 21; ++bit)
  {
    key |= static_cast<MortonKey>(x >> bit & 1u) << 3 * bit;
  }
  return key;
}

/// Cells of the finest grid: single bits, all bits, and others.
std::vector<GridCell> someCells()
{
  std::vector<GridCell> cells{{0, 0, 0}, {0x1fffff, 0, 0}, {0, 0x1fffff, 0}, {0, 0, 0x1fffff}};
  for (unsigned bit = 0; bit < 21; ++bit)
  {
    cells.push_back({1u << bit, 0, 0});
    cells.push_back({0, 1u << bit, 0});
    cells.push_back({0x1fffff, 0x1fffff, 1u << bit});
  }
  std::mt19937 random(14);
  for (int i = 0; i < 500; ++i)
  {
    const auto below = [&] { return static_cast<std::uint32_t>(random() & 0x1fffffu); };
    cells.push_back({below(), below(), below()});
  }
  return cells;
}

TEST(MortonKeys, InterleaveTheBitsOfACell)
{
  for (const GridCell& cell : someCells())
  {
    const MortonKey key = mortonKey(cell);
    EXPECT_EQ(spreadBits(cell[0]), spreadSlowly(cell[0]));
    EXPECT_EQ(key, spreadSlowly(cell[0]) | spreadSlowly(cell[1]) << 1 | spreadSlowly(cell[2]) << 2);
    EXPECT_EQ(gridCell(key), cell);
    EXPECT_EQ(gatherBits(key), cell[0]);
    EXPECT_EQ(mortonKey({cell[0] >> 1, cell[1] >> 1, cell[2] >> 1}), key >> 3) << "the parent's";
  }
}

TEST(MortonKeys, LeaveOutBitsBeyondTheTwentyFirst)
{
  EXPECT_EQ(spreadBits(0xffffffffffe00005ull), spreadBits(5));
  EXPECT_EQ(gatherBits(~MortonKey{0}), 0x1fffffu);
  EXPECT_EQ(gatherBits(MortonKey{6}), 0u) << "bits of y and z";
}

/// Sorts by keys in the bounding cube, then by number, and deals out what is left over to the first shares.
std::vector<Index> sharesSlowly(const std::vector<Vec3>& places, std::size_t shares)
{
  Box3 box;
  std::ranges::for_each(places, [&](const Vec3& place) { box.extend(place); });
  std::vector<std::pair<MortonKey, Index>> order;
  for (Index i = 0; i < places.size(); ++i)
  {
    const Vec3 at = (places[i] - box.min) * std::exp2(21.0) / box.size().maxCoeff();
    const auto cellAt = [&](int axis) { return static_cast<std::uint32_t>(std::min(at[axis], 2097151.0)); };
    order.emplace_back(mortonKey({cellAt(0), cellAt(1), cellAt(2)}), i);
  }
  std::ranges::sort(order);
  std::vector<Index> out(places.size());
  std::size_t next = 0;
  for (std::size_t share = 0; share < shares; ++share)
  {
    const std::size_t length = places.size() / shares + (share < places.size() % shares ? 1 : 0);
    for (const std::size_t end = next + length; next < end; ++next)
    {
      out[order[next].second] = static_cast<Index>(share);
    }
  }
  return out;
}

TEST(MortonShares, TellCellsOfTheFinestGridApart)
{
  const double cell = std::exp2(-21.0);
  const std::vector<Vec3> places{{0, 0, 0}, {1, 1, 1}, {0.5 + cell, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  EXPECT_EQ(divideAlongMorton(places, 4, atria::testing::quietContext()), (std::vector<Index>{0, 3, 2, 1}));
}

TEST(MortonShares, AreThoseOfASortByKeys)
{
  Random random(15);
  for (const Vec3& size : {Vec3(8, 8, 8), Vec3(8, 2, 1), Vec3(0, 1, 4), Vec3(1, 8, 0)})
  {
    for (const std::size_t count : {2u, 3u, 11u, 60u})
    {
      std::vector<Vec3> places{Vec3(-3, 5, 7), Vec3(-3, 5, 7) + size};
      while (places.size() < count)
      {
        places.push_back(places[0] + (0.125 * toVector(random.point(0, 8))).cwiseProduct(size));
      }
      for (const std::size_t shares : {1u, 2u, 3u, 7u, 100u})
      {
        EXPECT_EQ(divideAlongMorton(places, shares, atria::testing::quietContext()), sharesSlowly(places, shares));
      }
    }
  }
}

} // namespace
