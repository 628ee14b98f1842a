// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts that place a leaf's vertex: corners of the model, curves near the leaf, and positions on them.
#include "Dual/Leaf/FeatureCorners.h"
#include "Dual/Leaf/LeafCurves.h"
#include "Dual/Leaf/LeafGeometry.h"
#include "SizedOctree.h"
#include "Surface/Search/BoxTests.h"
#include "Surface/Search/Distance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Ending = std::vector<Index>;
using Endings = std::vector<Ending>;

/// Octants of 2 m from -0.5 to 7.5 m on each axis.
Octree coarseOctree()
{
  GridFrame frame;
  frame.depth = 3;
  frame.origin = Vec3::Constant(-0.5);
  frame.domain = {Vec3::Zero(), Vec3::Constant(7.0)};
  fitLattice(frame, {});
  return {frame, {{0}, {0, 1, 2, 3, 4, 5, 6, 7}}};
}

/// A corner of a model, and the curves that meet there by the charts that end.
struct CornerAt
{
  Vec3 place;
  Endings endings;
};

/// Corners with an edge for each of their curves; none is the point of its own number.
SurfaceModel modelWith(const GridFrame& frame, const std::vector<CornerAt>& corners)
{
  SurfaceModel model;
  model.points.push_back(frame.toLattice(Vec3::Zero()));
  for (const CornerAt& corner : corners)
  {
    const auto point = static_cast<Index>(model.points.size());
    model.corners.push_back(point);
    model.points.push_back(frame.toLattice(corner.place));
    for (const Ending& ending : corner.endings)
    {
      const auto curve = static_cast<Index>(model.curves.size());
      model.featureEdges.push_back(curve % 2 == 0 ? FeatureEdge{point, 0, curve} : FeatureEdge{0, point, curve});
      model.curves.push_back({CurveKind::crease, ending, ending});
    }
  }
  return model;
}

/// A vertex of a kind, in the leaf that holds a place.
struct VertexAt
{
  Vec3 place;
  ChainVertex::Kind kind;
  Endings curves;
};

/// The corner, counted in order, that each vertex takes; -1 for none. Vertices are in order of their leaves.
std::vector<int> takenCorners(const std::vector<CornerAt>& corners, const std::vector<VertexAt>& vertices)
{
  const Octree octree = coarseOctree();
  const SurfaceModel model = modelWith(octree.frame(), corners);
  std::vector<ChainVertex> chain;
  for (const VertexAt& vertex : vertices)
  {
    ChainVertex one;
    one.vertex = static_cast<Index>(chain.size());
    one.leaf = octree.leafAt(octree.frame().toLattice(vertex.place));
    one.kind = vertex.kind;
    one.curves = vertex.curves;
    EXPECT_TRUE(chain.empty() || chain.back().leaf < one.leaf);
    chain.push_back(one);
  }
  std::vector<int> taken;
  for (const Index point : assignCorners(octree, model, chain))
  {
    const auto found = std::ranges::find(model.corners, point);
    taken.push_back(found == model.corners.end() ? -1 : static_cast<int>(found - model.corners.begin()));
  }
  return taken;
}

const Endings three{{0, 1}, {0, 2}, {1, 2}};
const Endings single{{0, 1}};
/// Centers of two octants side by side, with a common face at x = 3.5.
const Vec3 lower(2.5, 2.5, 2.5);
const Vec3 upper(4.5, 2.5, 2.5);

TEST(FeatureCorners, HaveTheCurvesOfTheirEdges)
{
  const GridFrame frame = coarseOctree().frame();
  SurfaceModel model =
      modelWith(frame, {{lower, {{2, 3}, {0, 1}, {2, 3}}}, {upper, {}}, {Vec3(1, 1, 1), {{5}, {1, 9}, {1}}}});
  const Endings none;
  EXPECT_THAT(curvesAtCorners(model), ElementsAre(Endings{{0, 1}, {2, 3}}, none, Endings{{1}, {1, 9}, {5}}));
  model.featureEdges.push_back({model.corners[1], model.corners[0], 4});
  EXPECT_THAT(curvesAtCorners(model),
              ElementsAre(Endings{{0, 1}, {1, 9}, {2, 3}}, Endings{{1, 9}}, Endings{{1}, {1, 9}, {5}}));
}

TEST(FeatureCorners, AreTakenByAVertexWithOneOfTheirCurves)
{
  for (const auto kind : {ChainVertex::along, ChainVertex::sideEnd, ChainVertex::knot})
  {
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {{0, 2}}}}), ElementsAre(0));
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {{0, 2}, {7}}}}), ElementsAre(0));
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {{7}}}}), ElementsAre(-1));
    EXPECT_THAT(takenCorners({{lower, three}}, {{lower, kind, {}}}), ElementsAre(-1));
  }
  EXPECT_THAT(takenCorners({}, {{lower, ChainVertex::knot, three}}), ElementsAre(-1));
  EXPECT_THAT(takenCorners({{lower, three}}, {}), IsEmpty());
}

TEST(FeatureCorners, AreTakenUpToATenthMoreThanHalfAnOctantAway)
{
  const VertexAt vertex{lower, ChainVertex::knot, three};
  for (const auto& [place, expected] : std::vector<std::pair<Vec3, int>>{{Vec3(4.69, 2.5, 2.5), 0},
                                                                         {Vec3(4.71, 2.5, 2.5), -1},
                                                                         {Vec3(2.5, 0.31, 2.5), 0},
                                                                         {Vec3(2.5, 0.29, 2.5), -1},
                                                                         {Vec3(2.5, 2.5, 4.69), 0},
                                                                         {Vec3(2.5, 2.5, 4.71), -1},
                                                                         {Vec3(4.3, 4.3, 2.5), 0},
                                                                         {Vec3(4.4, 4.4, 2.5), -1},
                                                                         {Vec3(4.1, 4.1, 4.1), 0},
                                                                         {Vec3(4.3, 4.3, 4.3), -1}})
  {
    EXPECT_THAT(takenCorners({{place, three}}, {vertex}), ElementsAre(expected)) << place.transpose();
  }
}

TEST(FeatureCorners, OnABorderBelongToTheLowerOctant)
{
  const Vec3 border(3.5, 2.5, 2.5);
  const VertexAt below{lower, ChainVertex::knot, three};
  const VertexAt above{upper, ChainVertex::knot, three};
  EXPECT_THAT(takenCorners({{border, three}}, {below, above}), ElementsAre(0, -1));
  EXPECT_THAT(takenCorners({{border, three}}, {above}), ElementsAre(0)) << "the upper one touches it";
}

TEST(FeatureCorners, OutsideOfTheOctreeAreNobodys)
{
  const VertexAt first{Vec3(0, 0, 0), ChainVertex::knot, three};
  const VertexAt last{Vec3(7, 7, 7), ChainVertex::knot, three};
  EXPECT_THAT(takenCorners({{Vec3(-0.6, 0, 0), three}, {Vec3(7, 7, 7.6), three}}, {first, last}), ElementsAre(-1, -1));
  EXPECT_THAT(takenCorners({{Vec3(-0.4, 0, 0), three}, {Vec3(7, 7, 7.5), three}}, {first, last}), ElementsAre(0, 1));
}

/// A vertex in the corner's octant against one that suits better at a distance: the distance at which both do as well.
struct Misfit
{
  ChainVertex::Kind kind;
  Endings curves;
  double distance;
};

TEST(FeatureCorners, PreferVerticesWhoseCurvesAgree)
{
  for (const Misfit& own : {Misfit{ChainVertex::knot, {{0, 1}, {0, 2}}, 0.2},
                            {ChainVertex::knot, {{0, 1}, {0, 2}, {7}}, 0.4},
                            {ChainVertex::sideEnd, single, 0.1},
                            {ChainVertex::along, single, 0.6}})
  {
    for (const double off : {-0.02, 0.02})
    {
      const double distance = own.distance + off;
      const Vec3 place(3.5 - 2.0 * distance, 2.5, 2.5);
      const bool isOther = off < 0.0;
      EXPECT_THAT(takenCorners({{place, three}}, {{lower, own.kind, own.curves}, {upper, ChainVertex::knot, three}}),
                  ElementsAre(isOther ? -1 : 0, isOther ? 0 : -1))
          << own.distance << " " << off;
    }
  }
  for (const auto kind : {ChainVertex::along, ChainVertex::sideEnd, ChainVertex::knot})
  {
    const Vec3 place(3.49, 2.5, 2.5); // a corner where one curve turns suits all alike
    EXPECT_THAT(takenCorners({{place, single}}, {{lower, kind, single}, {upper, ChainVertex::knot, single}}),
                ElementsAre(0, -1));
  }
}

TEST(FeatureCorners, GoToOneVertexEachTheNearestFirst)
{
  const VertexAt below{lower, ChainVertex::knot, three};
  const VertexAt above{upper, ChainVertex::knot, three};
  const CornerAt near{Vec3(3.7, 2.5, 2.5), three};
  const CornerAt far{Vec3(4.0, 2.5, 2.5), three};
  EXPECT_THAT(takenCorners({far, near}, {below}), ElementsAre(1));
  EXPECT_THAT(takenCorners({near, far}, {below}), ElementsAre(0));
  EXPECT_THAT(takenCorners({near}, {below, above}), ElementsAre(-1, 0));
  EXPECT_THAT(takenCorners({far, near}, {below, above}), ElementsAre(1, 0)) << "the second takes the other vertex";
  const CornerAt within{Vec3(2.2, 2.2, 2.2), three};
  EXPECT_THAT(takenCorners({within, {lower, three}}, {below}), ElementsAre(0)) << "the first of equal ones";
}

/// True if two leaves share a face or an edge.
bool areBeside(const Octree& octree, Index one, Index other)
{
  const LatticeBox shared =
      common({octree.lowCorner(one), octree.highCorner(one)}, {octree.lowCorner(other), octree.highCorner(other)});
  int extents = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    extents += shared.high.at(axis) > shared.low.at(axis) ? 1 : 0;
  }
  return !shared.empty() && (extents == 1 || extents == 2);
}

using CurveEntries = std::set<std::pair<Index, Index>>;

void addEntries(const SurfaceModel& model, const FeatureEdge& edge, CurveEntries& entries)
{
  for (const Index chart : model.curves[edge.curve].charts)
  {
    entries.emplace(chart, edge.curve);
  }
}

/// The curves of a leaf, and those in leaves beside it that pass within `nickDepth` if it has several charts.
CurveEntries entriesOf(const Octree& octree, const SurfaceModel& model, Index leaf)
{
  CurveEntries entries;
  for (const ModelItem piece : octree.items(leaf, ModelItem::featureEdge))
  {
    addEntries(model, model.featureEdges[piece.index], entries);
  }
  std::set<Index> charts;
  for (const ModelItem piece : octree.items(leaf, ModelItem::triangle))
  {
    charts.insert(model.charts[piece.index]);
  }
  const LatticeBox own{octree.lowCorner(leaf), octree.highCorner(leaf)};
  const LatticeBox box =
      grown(own, static_cast<std::int64_t>(nickDepth * static_cast<double>(own.high[0] - own.low[0])));
  for (Index other = 0; other < octree.leafCount() && charts.size() > 1; ++other)
  {
    for (const ModelItem piece : octree.items(other, ModelItem::featureEdge))
    {
      const FeatureEdge& edge = model.featureEdges[piece.index];
      const SegmentRange range = clipSegment(box, model.points[edge.a], model.points[edge.b]);
      if (range.begin < range.end && areBeside(octree, leaf, other))
      {
        addEntries(model, edge, entries);
      }
    }
  }
  return entries;
}

void expectCurves(const TriangleSurface& surface, const GridOptions& grid)
{
  const Sized of = sized(surface, grid, {});
  const ThreadExecutor threads(2);
  const LeafCurves curves(of.octree, of.model, quietContext(threads));
  std::size_t listed = 0;
  for (Index leaf = 0; leaf < of.octree.leafCount(); ++leaf)
  {
    CurveEntries found;
    for (const LeafCurves::Entry& entry : curves.of(leaf))
    {
      found.emplace(entry.chart, entry.curve);
    }
    EXPECT_EQ(found, entriesOf(of.octree, of.model, leaf)) << leaf;
    EXPECT_EQ(found.size(), curves.of(leaf).size()) << "no entry is there twice";
    EXPECT_TRUE(std::ranges::is_sorted(curves.of(leaf)));
    listed += found.empty() ? 0 : 1;
  }
  EXPECT_GT(listed, 0U);
}

TEST(LeafCurves, AreThoseInALeafAndCloseBesideIt)
{
  for (const double degrees : {0.0, 17.0, 45.0})
  {
    TriangleSurface surface;
    addBox(surface, "House", {Vec3(-2.4, -1.6, -1.1), Vec3(2.3, 1.2, 1.4)});
    addPrism(surface, "Tent", {{2.9, -1}, {4.4, -1.2}, {4.2, 0.1}}, -0.6, 0.9);
    turn(surface, degrees);
    expectCurves(surface, gridOf(10.0, 1.0, 1.0, 1.0));
    expectCurves(surface, gridOf(10.0, 0.5, 1.0, 2.0));
  }
}

TEST(LeafCurves, AreFoundByChart)
{
  const std::vector<LeafCurves::Entry> entries{{1, 4}, {1, 7}, {2, 4}, {5, 0}, {5, 9}};
  const auto curvesAt = [&](Index chart) {
    std::vector<Index> curves;
    std::ranges::transform(LeafCurves::atChart(entries, chart), std::back_inserter(curves), &LeafCurves::Entry::curve);
    return curves;
  };
  EXPECT_THAT(curvesAt(0), IsEmpty());
  EXPECT_THAT(curvesAt(1), ElementsAre(4, 7));
  EXPECT_THAT(curvesAt(2), ElementsAre(4));
  EXPECT_THAT(curvesAt(3), IsEmpty());
  EXPECT_THAT(curvesAt(5), ElementsAre(0, 9));
  EXPECT_THAT(curvesAt(6), IsEmpty());
}

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
