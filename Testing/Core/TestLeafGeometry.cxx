// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the positions of the vertices of leaves: on sides, surfaces, curves and corners.
#include "Dual/Leaf/LeafGeometry.h"
#include "SizedOctree.h"
#include "Surface/Search/Distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using Ending = std::vector<Index>;

/// Octants of 1 m with their centers at whole numbers, in a domain from -8 to 8 m.
class Positions
{
public:
  explicit Positions(const TriangleSurface& surface, double length = 16.0)
      : of(sized(surface, gridOf(length, 1.0, 1.0, 1.0), {})), geometry(of.octree, of.model)
  {
  }

  Index leafAt(const Vec3& place) const { return of.octree.leafAt(of.frame.toLattice(place)); }
  void enter(const Vec3& place) { geometry.enter(leafAt(place)); }

  /// Adds the cuts at these heights of an upright edge at the border of octants, from `bottom` up for 1 m.
  void addCuts(double x, double y, double bottom, const std::vector<double>& heights)
  {
    EdgeSegment edge;
    edge.start = of.frame.toLattice(Vec3(x, y, bottom));
    edge.end = of.frame.toLattice(Vec3(x, y, bottom + 1.0));
    edge.axis = 2;
    edge.size = of.frame.latticeSize(of.frame.depth);
    edge.about = {leafAt(Vec3(x - 0.5, y - 0.5, bottom + 0.5)), leafAt(Vec3(x + 0.5, y - 0.5, bottom + 0.5)),
                  leafAt(Vec3(x + 0.5, y + 0.5, bottom + 0.5)), leafAt(Vec3(x - 0.5, y + 0.5, bottom + 0.5))};
    std::vector<SurfaceCrossing> cuts;
    std::ranges::transform(heights, std::back_inserter(cuts), [&](double z) {
      return SurfaceCrossing{0, 1, z - bottom};
    });
    geometry.addCut(edge, cuts);
  }

  /// The chart of the triangle in whose plane a place lies.
  Index chartAt(const Vec3& place) const
  {
    const Vec3 p = toVector(of.frame.toLattice(place));
    for (Index t = 0; t < of.model.triangles.size(); ++t)
    {
      const Vec3 corner = toVector(of.model.corner(t, 0));
      if (std::abs(of.model.normal(t).normalized().dot(p - corner)) < 4.0 &&
          of.model.bounds(t).squaredDistance(p) < 16.0)
      {
        return of.model.charts[t];
      }
    }
    ADD_FAILURE() << "no chart at " << place.transpose();
    return noIndex;
  }

  std::vector<Index> chartsAt(const std::vector<Vec3>& places) const
  {
    std::vector<Index> charts;
    std::ranges::transform(places, std::back_inserter(charts), [&](const Vec3& p) { return chartAt(p); });
    std::ranges::sort(charts);
    return charts;
  }

  Sized of;
  LeafGeometry geometry;
};

void expectNear(const std::optional<Vec3>& found, const Vec3& expected)
{
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found - expected).norm(), 0.0, 1e-6) << found->transpose() << " instead of " << expected.transpose();
}

TriangleSurface houseSurface()
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3::Constant(-2.4), Vec3::Constant(2.4)});
  return surface;
}

TEST(LeafGeometry, PutsCentersOnTheSidesOfTheDomain)
{
  for (const double length : {16.0, 15.6})
  {
    Positions at(houseSurface(), length);
    const double end = 0.5 * length;
    const Octree& octree = at.of.octree;
    for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
    {
      const Vec3 low = at.of.frame.toModel(octree.lowCorner(leaf));
      const Vec3 high = at.of.frame.toModel(octree.highCorner(leaf));
      Vec3 expected = 0.5 * (low + high);
      bool isOnSide = false;
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const double plane : {-end, end})
        {
          const bool passes = low[axis] < plane && plane < high[axis];
          expected[axis] = passes ? plane : expected[axis];
          isOnSide = isOnSide || passes;
        }
      }
      expected = expected.cwiseMax(-end).cwiseMin(end);
      at.geometry.enter(leaf);
      EXPECT_EQ(at.geometry.isOnSide(), isOnSide);
      EXPECT_NEAR((at.geometry.center() - expected).norm(), 0.0, 1e-9);
      const std::optional<Vec3> off = at.geometry.centerOffSides(leaf);
      EXPECT_EQ(off.has_value(), !isOnSide);
      EXPECT_TRUE(!off || (*off - expected).norm() < 1e-9);
    }
  }
}

TriangleSurface slopeSurface()
{
  TriangleSurface surface;
  addSheet(surface, "Slope", Vec3(-5, -5, 0.2 - 2.0), Vec3(10, 0, 4), Vec3(0, 10, 0));
  return surface;
}

/// The point of the slope above or below a place.
Vec3 onSlope(double x, double y) { return {x, y, 0.2 + 0.4 * x}; }

TEST(LeafGeometry, PutsSurfaceVerticesAtTheMeanOfTheCuts)
{
  Positions at(slopeSurface());
  at.enter(Vec3(0, 0, 0));
  at.geometry.setCharts({at.of.model.charts[0]});
  at.addCuts(-0.5, -0.5, -0.5, {0.0});
  at.addCuts(0.5, -0.5, -0.5, {0.4});
  at.addCuts(0.5, 0.5, -0.5, {0.4});
  expectNear(at.geometry.surfacePosition(), onSlope(0.5 / 3.0, -0.5 / 3.0));
  at.addCuts(-0.5, 0.5, -0.5, {-0.3, 0.4, 0.3}); // the first and the last of three count
  expectNear(at.geometry.surfacePosition(), onSlope(0, 0));
  at.enter(Vec3(0, 0, 0));
  at.geometry.setCharts({at.of.model.charts[0]});
  const Vec3 across = Vec3(-0.4, 0, 1).normalized();
  expectNear(at.geometry.surfacePosition(), Vec3(across.dot(Vec3(0, 0, 0.2)) * across)); // no cuts of an earlier leaf
}

TEST(LeafGeometry, PutsSurfaceVerticesOnTheirChartsOnly)
{
  TriangleSurface surface;
  addSheet(surface, "Lower", Vec3(-5, -5, -0.2), Vec3(10, 0, 0), Vec3(0, 10, 0));
  addSheet(surface, "Upper", Vec3(-5, -5, 0.3), Vec3(10, 0, 0), Vec3(0, 10, 0));
  Positions at(surface);
  for (const double z : {-0.2, 0.3})
  {
    at.enter(Vec3(0, 0, 0));
    at.geometry.setCharts({at.chartAt(Vec3(0, 0, z))});
    at.addCuts(-0.5, -0.5, -0.5, {0.0});
    at.addCuts(0.5, -0.5, -0.5, {0.1});
    expectNear(at.geometry.surfacePosition(), Vec3(0, -0.5, z));
  }
  at.enter(Vec3(0, 0, 0));
  at.geometry.setCharts({99});
  at.addCuts(-0.5, -0.5, -0.5, {0.0});
  at.addCuts(0.5, -0.5, -0.5, {0.1});
  expectNear(at.geometry.surfacePosition(), Vec3(0, -0.5, 0.05));
}

TEST(LeafGeometry, PutsTheVertexOfATipHalfWayToTheCenter)
{
  Positions at(slopeSurface());
  at.enter(Vec3(0, 0, 0));
  at.addCuts(0.5, 0.5, -0.5, {0.4});
  expectNear(at.geometry.surfacePosition(), Vec3(0.25, 0.25, 0.2));
  at.addCuts(0.5, 0.5, -0.5, {0.4009});
  expectNear(at.geometry.surfacePosition(), 0.5 * Vec3(0.5, 0.5, (0.4 + 0.4 + 0.4009 + 0.4009) / 4.0));
  at.addCuts(0.5, 0.5, -0.5, {0.402});
  expectNear(at.geometry.surfacePosition(), Vec3(0.5, 0.5, (0.4 + 0.4009 + 0.402) / 3.0));
}

TEST(LeafGeometry, PutsSurfaceVerticesOnSideAndSurfaceAtOnce)
{
  Positions at([] {
    TriangleSurface surface;
    addSheet(surface, "Slope", Vec3(3, -5, 0.2 - 2.0), Vec3(10, 0, 4), Vec3(0, 10, 0));
    return surface;
  }());
  at.enter(Vec3(8, 0, 0));
  at.geometry.setCharts({at.of.model.charts[0]});
  at.addCuts(7.5, 0.5, -0.5, {0.1});
  at.addCuts(7.5, -0.5, -0.5, {0.1});
  expectNear(at.geometry.surfacePosition(), Vec3(8, 0, 0.2));
}

/// The endings of the curve along which two faces of the house meet.
Ending endingAt(const Positions& at, const Vec3& one, const Vec3& other) { return at.chartsAt({one, other}); }

const Vec3 east(2.4, 0, 0);
const Vec3 north(0, 2.4, 0);
const Vec3 top(0, 0, 2.4);

TEST(LeafGeometry, PutsCurveVerticesInTheMiddleOfTheCurveInTheLeaf)
{
  Positions at(houseSurface());
  for (const auto& [leaf, middle] : std::vector<std::pair<Vec3, Vec3>>{{Vec3(2, 0, 2), Vec3(2.4, 0, 2.4)},
                                                                       {Vec3(2, -1, 2), Vec3(2.4, -1, 2.4)},
                                                                       {Vec3(2, 2, 2), Vec3(2.4, 1.95, 2.4)},
                                                                       {Vec3(2, -2, 2), Vec3(2.4, -1.95, 2.4)}})
  {
    at.enter(leaf);
    expectNear(at.geometry.curvePosition({endingAt(at, east, top)}), middle);
    EXPECT_FALSE(at.geometry.isDiverted());
  }
}

TEST(LeafGeometry, WeighsThePartsOfACurveByTheirLengths)
{
  TriangleSurface surface; // its outline has a point between the ends at the upper x
  addSurface(surface, "Sheet", {{-2.4, -2.4, 2}, {2.4, -2.4, 2}, {2.4, -0.2, 2}, {2.4, 2.4, 2}, {-2.4, 2.4, 2}},
             {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  Positions at(surface);
  at.enter(Vec3(2, 0, 2));
  expectNear(at.geometry.curvePosition({{at.of.model.charts[0]}}), Vec3(2.4, 0, 2));
}

TEST(LeafGeometry, PutsCurveVerticesOnTheNearestPointOfCurvesBesideTheLeaf)
{
  Positions at(houseSurface());
  at.enter(Vec3(2, 1, 2));
  expectNear(at.geometry.curvePosition({endingAt(at, north, top)}), Vec3(2, 2.4, 2.4));
  EXPECT_TRUE(at.geometry.isDiverted());
  at.enter(Vec3(2, 1, 2));
  EXPECT_FALSE(at.geometry.isDiverted()) << "that was of the leaf before";
  at.addCuts(1.5, 0.5, 1.5, {2.0});
  expectNear(at.geometry.curvePosition({endingAt(at, north, top)}), Vec3(1.5, 2.4, 2.4)); // nearest to the cuts
  expectNear(at.geometry.nearestCurvePosition({endingAt(at, north, top)}, Vec3(-1, 0, 0)), Vec3(-1, 2.4, 2.4));
  expectNear(at.geometry.nearestCurvePosition({endingAt(at, east, top)}, Vec3(9, 0.7, 9)), Vec3(2.4, 0.7, 2.4));
  at.enter(Vec3(2, -1, 2));
  EXPECT_FALSE(at.geometry.curvePosition({endingAt(at, north, top)}).value_or(Vec3::Zero()).isApprox(Vec3(2, 2.4, 2.4)))
      << "two octants away";
}

TEST(LeafGeometry, TakesCurvesThatShareAChartWhereNoneHasTheSame)
{
  Positions at(houseSurface());
  at.enter(Vec3(2, 0, 2));
  expectNear(at.geometry.curvePosition({{at.chartAt(top)}}), Vec3(2.4, 0, 2.4));
  EXPECT_TRUE(at.geometry.isDiverted());
  EXPECT_FALSE(at.geometry.curvePosition({{99}}));
  EXPECT_FALSE(at.geometry.curvePosition({}));
}

TEST(LeafGeometry, PutsCurveVerticesOnSidesWhereTheCurveMeetsThem)
{
  TriangleSurface surface;
  addSheet(surface, "Road", Vec3(-9, -2.4, 1.1), Vec3(18, 0, 1.8), Vec3(0, 4.8, 0));
  Positions at(surface);
  for (const double x : {-8.0, 8.0})
  {
    const double z = 2.0 + 0.1 * x;
    at.enter(Vec3(x, 2, z));
    expectNear(at.geometry.curvePosition({{at.of.model.charts[0]}}), Vec3(x, 2.4, z));
    EXPECT_TRUE(at.geometry.isDiverted());
  }
}

TEST(LeafGeometry, PutsVerticesOfFoldsOnTheFold)
{
  Positions at(houseSurface());
  const Ending both = endingAt(at, east, top);
  for (FeatureCurve& curve : at.of.model.curves)
  {
    curve.ending = curve.ending == both ? Ending() : curve.ending;
  }
  at.enter(Vec3(2, 0, 2));
  at.geometry.setCharts(both);
  expectNear(at.geometry.surfacePosition(), Vec3(2.4, 0, 2.4));
  expectNear(at.geometry.curvePosition({Ending()}), Vec3(2.4, 0, 2.4));
  at.enter(Vec3(2, 0, 2));
  at.geometry.setCharts({at.chartAt(top)});
  expectNear(at.geometry.surfacePosition(), Vec3(2, 0, 2.4)); // not all of the fold's charts are the vertex's
  EXPECT_FALSE(at.geometry.nearestCurvePosition({Ending()}, Vec3(2, 0, 2)));
}

TEST(LeafGeometry, PutsCornersWhereTheyAreAndOnSides)
{
  TriangleSurface surface = houseSurface();
  addBox(surface, "Beyond", {Vec3(7.9, 3, 3), Vec3(8.2, 4.2, 4.2)});
  Positions at(surface);
  at.enter(Vec3(2, 2, 2));
  const auto pointAt = [&](const Vec3& place) {
    return static_cast<Index>(std::ranges::find(at.of.model.points, at.of.frame.toLattice(place)) -
                              at.of.model.points.begin());
  };
  expectNear(at.geometry.cornerPosition(pointAt(Vec3::Constant(2.4))), Vec3::Constant(2.4));
  expectNear(at.geometry.cornerPosition(pointAt(Vec3(8.2, 3, 3))), Vec3(8, 3, 3)); // never outside of the domain
  at.enter(Vec3(8, 3, 3));
  expectNear(at.geometry.cornerPosition(pointAt(Vec3(7.9, 3, 3))), Vec3(8, 3, 3));
}

TEST(LeafGeometry, PutsVerticesOnTheOutlineOfWhatLiesOnASide)
{
  TriangleSurface surface;
  addSheet(surface, "Patch", Vec3(-2.4, -2.4, -8), Vec3(4.8, 0, 0), Vec3(0, 4.8, 0));
  addSheet(surface, "Roof", Vec3(-2.4, -2.4, 2), Vec3(4.8, 0, 0), Vec3(0, 4.8, 0));
  Positions at(surface);
  const auto sideAt = [&](const Vec3& place) {
    at.enter(place);
    return at.geometry.sidePosition();
  };
  expectNear(sideAt(Vec3(2, 0, -8)), Vec3(2.4, 0, -8));
  expectNear(sideAt(Vec3(-1, -2, -8)), Vec3(-1, -2.4, -8));
  expectNear(sideAt(Vec3(2, 2, -8)), Vec3(2.4, 2.4, -8));
  expectNear(sideAt(Vec3(-2, 2, -8)), Vec3(-2.4, 2.4, -8));
  EXPECT_FALSE(sideAt(Vec3(0, 0, -8))) << "its inside";
  EXPECT_FALSE(sideAt(Vec3(4, 0, -8))) << "beside it";
  EXPECT_FALSE(sideAt(Vec3(2, 0, 2))) << "on no side of the domain";
}

TEST(LeafGeometry, KnowsWhereAPointMissesSomeChart)
{
  Positions at(houseSurface());
  at.enter(Vec3(2, 0, 2));
  at.geometry.setCharts(endingAt(at, east, top));
  const Vec3 onBoth(2.4, 0.1, 2.4);
  EXPECT_FALSE(at.geometry.misses(onBoth));
  for (const Vec3& way : {Vec3(-1, 0, 0), Vec3(0, 0, -1)})
  {
    EXPECT_FALSE(at.geometry.misses(onBoth + 0.9 * coincidentRatio * way));
    EXPECT_TRUE(at.geometry.misses(onBoth + 1.1 * coincidentRatio * way)) << way.transpose();
  }
  at.geometry.setCharts({at.chartAt(top)});
  EXPECT_FALSE(at.geometry.misses(Vec3(2, 0, 2))) << "of one chart there is no other";
  at.geometry.setCharts({at.chartAt(top), 99});
  EXPECT_FALSE(at.geometry.misses(Vec3(2, 0, 2.4))) << "of a chart far away nothing is known";
}

} // namespace
