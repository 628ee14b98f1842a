// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the curves in a leaf and close beside it.
#include "Dual/Leaf/LeafCurves.h"
#include "SizedOctree.h"
#include "Surface/Search/BoxTests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

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

} // namespace
