// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sizes beside walls, the coverage of layers on blocks of cubes, and what is reported of them.
#include "Layer/BoundaryLayers.h"
#include "Layer/LayerCoverage.h"
#include "Layer/LayerReport.h"
#include "LayerBlock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::IsEmpty;

TEST(WallSizes, AreTheLongestEdgesThatLeaveTheWalls)
{
  Grown of({3, 3, 2}, {{"zMin", {1}}});
  of.place(1, 1, 1)[2] = 0.75;
  of.place(2, 2, 1)[2] = 1.25;
  const std::vector<double> sizes = of.sizes();
  EXPECT_NEAR(sizes[of.block.pointAt(0, 0, 0)], 1.0, 1e-12);
  EXPECT_NEAR(sizes[of.block.pointAt(1, 1, 0)], 0.75, 1e-12);
  EXPECT_NEAR(sizes[of.block.pointAt(2, 2, 0)], 1.25, 1e-12);
  EXPECT_EQ(sizes[of.block.pointAt(1, 1, 1)], std::numeric_limits<double>::infinity());
  const Grown between({3, 3, 1}, {{"zMin", {1}}, {"zMax", {1}}});
  EXPECT_NEAR(between.sizes()[between.block.pointAt(1, 1, 0)], 0.5, 1e-12) << "edges between walls count half";
  Grown corner({2, 2, 2}, {{"zMin", {1}}, {"xMin", {1}}, {"yMin", {1}}});
  corner.place(1, 0, 0)[0] = 0.8;
  EXPECT_NEAR(corner.sizes()[corner.block.pointAt(0, 0, 0)], 0.8, 1e-12) << "the shortest edge along the walls";
}

LayerReport reportOf(const Grown& of, const LayerMesh& layer, const OwnElements& part = {})
{
  return reportLayers(layer, of.walls, of.sizes(), of.options, {"Wall"}, part);
}

TEST(LayerReport, CoversWhatHasAllItsLayers)
{
  Grown of({3, 3, 2}, {{"zMin", {2, 0.1, 2.0}}});
  const LayerMesh one = of.grow();
  const LayerMesh divided = divideLayer(of.block.mesh, of.walls, one, of.options, layersWanted(of.walls, one));
  const LayerReport report = reportOf(of, divided);
  ASSERT_EQ(report.surfaces.size(), 1U);
  const LayerCoverage& all = report.surfaces[0];
  EXPECT_EQ(all.surface, "zMin");
  EXPECT_EQ(all.layers, 2);
  EXPECT_NEAR(all.area, 9.0, 1e-9);
  EXPECT_NEAR(all.layered, 9.0, 1e-9);
  EXPECT_NEAR(all.full, 9.0, 1e-9);
  EXPECT_NEAR(all.thickness, 1.0, 1e-9);
  EXPECT_NEAR(all.firstHeight, 0.1, 1e-9);
  ASSERT_EQ(report.counts.size(), divided.mesh.boundaryFaces.size());
  for (std::size_t f = 0; f < report.counts.size(); ++f)
  {
    const bool isWall = f < of.walls.roles.size() && of.walls.roles[f] == FaceRole::wall;
    EXPECT_EQ(report.counts[f], isWall ? 2 : 0);
    EXPECT_NEAR(report.thicknesses[f], isWall ? 0.3 : 0.0, 1e-9);
  }
}

TEST(LayerReport, TellsWhatHasFewerOrNone)
{
  Grown of({3, 3, 2}, {{"zMin", {2, 0.1, 2.0}}});
  std::vector<char> excluded(of.block.mesh.points.size(), 0);
  for (std::size_t p = 0; p < excluded.size(); ++p)
  {
    excluded[p] = of.block.mesh.points[p][0] <= 1.0 ? 1 : 0;
  }
  const LayerMesh one = of.grow(excluded);
  std::vector<Index> counts = layersWanted(of.walls, one);
  for (Index j = 0; j < 4; ++j)
  {
    counts[of.block.pointAt(2, j, 0)] = 1;
  }
  const LayerMesh divided = divideLayer(of.block.mesh, of.walls, one, of.options, counts);
  const LayerReport report = reportOf(of, divided);
  ASSERT_EQ(report.surfaces.size(), 1U);
  EXPECT_NEAR(report.surfaces[0].area, 9.0, 1e-9);
  EXPECT_NEAR(report.surfaces[0].layered, 6.0, 1e-9);
  EXPECT_NEAR(report.surfaces[0].full, 3.0, 1e-9);
  EXPECT_NEAR(report.surfaces[0].thickness, 0.75, 1e-9) << "half of the corners of half of the faces";
  EXPECT_NEAR(report.surfaces[0].firstHeight, 0.45, 1e-9) << "cubes, what is beside them, and two layers";
  for (Index f = 0; f < of.walls.roles.size(); ++f)
  {
    const Index cell = of.block.mesh.boundaryFaces[f].element % 3;
    const bool isWall = of.walls.roles[f] == FaceRole::wall;
    EXPECT_EQ(report.counts[f], isWall ? static_cast<int>(cell) : 0);
    EXPECT_NEAR(report.thicknesses[f], isWall ? 0.15 * cell : 0.0, 1e-9);
  }
}

TEST(LayerReport, CountsOwnElementsAndRoundsAreas)
{
  Grown of({3, 3, 2}, {{"zMin", {1, 0.1}}});
  const LayerMesh one = of.grow();
  OwnElements part;
  part.isOwn = [](Index element) { return element % 3 != 0 || element >= 9; };
  double own = 0.0;
  for (Index f = 0; f < of.walls.roles.size(); ++f)
  {
    own += of.walls.roles[f] == FaceRole::wall && part.owns(one.mesh.boundaryFaces[f].element) ? 1.0 : 0.0;
  }
  const LayerReport report = reportOf(of, one, part);
  EXPECT_NEAR(report.surfaces.at(0).area, own, 1e-9);
  EXPECT_NEAR(report.surfaces.at(0).thickness, 1.0, 1e-9);
  EXPECT_EQ(std::ranges::count(report.counts, 1), 9) << "faces are all reported";
  of.options.areaUnit = 2.0;
  EXPECT_EQ(reportOf(of, one).surfaces.at(0).area, 18.0) << "faces of 1 are rounded to 2";
  of.options.areaUnit = 4.0;
  EXPECT_THAT(reportOf(of, one).surfaces, IsEmpty()) << "and to nothing";
}

TEST(LayerReport, TellsOfLayersThatNobodyAskedForIfThereAreAny)
{
  Grown of({3, 3, 2}, {{"zMin", {1, 0.1}}, {"zMax", {1, 0.1}}});
  of.options.supporting.assign(of.options.ofTag.size(), SupportingLayer::none);
  of.options.supporting[sideTag(zMin)] = SupportingLayer::whereNeeded;
  EXPECT_TRUE(of.options.isAsked());
  const LayerReport report = reportOf(of, of.grow());
  ASSERT_EQ(report.surfaces.size(), 2U);
  EXPECT_EQ(report.surfaces[0].surface, "zMin");
  EXPECT_EQ(report.surfaces[0].layers, 0);
  EXPECT_EQ(report.surfaces[1].surface, "zMax");
  EXPECT_EQ(report.surfaces[1].layers, 1);
  std::vector<char> excluded(of.block.mesh.points.size(), 0);
  std::fill_n(excluded.begin(), 16, 1);
  const LayerReport without = reportOf(of, of.grow(excluded));
  ASSERT_EQ(without.surfaces.size(), 1U);
  EXPECT_EQ(without.surfaces[0].surface, "zMax");
  of.options.supporting[sideTag(zMax)] = SupportingLayer::everywhere;
  EXPECT_FALSE(of.options.isAsked());
}

} // namespace
