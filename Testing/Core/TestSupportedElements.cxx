// SPDX-License-Identifier: GPL-3.0-or-later
/// Layers at elements that cannot be valid without, where none is asked for.
#include "Mesher/Improvement/ConcaveElements.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <algorithm>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double half = 2.0;

Meshed meshOf(const TriangleSurface& surface, bool support, const std::vector<LayerRule>& rules = {{"*", {0}}})
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-half), Vec3::Constant(half)};
  grid.sizeMin = 0.2;
  grid.sizeMid = grid.sizeMax = 0.4;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::outside;
  options.layers = rules;
  options.supportElements = support;
  return meshIt(surface, grid, options);
}

TriangleSurface sphere()
{
  TriangleSurface surface;
  addSphere(surface, "Solid", Vec3(0.03, 0.02, 0.01), 1.1, 4);
  return surface;
}

TriangleSurface turnedBox()
{
  TriangleSurface surface;
  addBox(surface, "Solid", {Vec3(-0.9, -0.7, -0.8), Vec3(1.0, 0.8, 0.9)});
  turn(surface, 15.0);
  return surface;
}

/// Two rooms side by side, open to the top, of sheets.
TriangleSurface turnedSheets()
{
  TriangleSurface surface;
  addSheet(surface, "South", Vec3(-1.1, -0.8, -0.9), Vec3(2.2, 0, 0), Vec3(0, 0, 1.7));
  addSheet(surface, "North", Vec3(-1.1, 0.9, -0.9), Vec3(2.2, 0, 0), Vec3(0, 0, 1.7));
  addSheet(surface, "Between", Vec3(0.1, -0.8, -0.9), Vec3(0, 1.7, 0), Vec3(0, 0, 1.7));
  addSheet(surface, "Floor", Vec3(-1.1, -0.8, -0.9), Vec3(2.2, 0, 0), Vec3(0, 1.7, 0));
  turn(surface, 30.0);
  return surface;
}

TEST(SupportedElements, AreNotConcaveAtWalls)
{
  for (const TriangleSurface& surface : {sphere(), turnedBox(), turnedSheets()})
  {
    const Meshed bare = meshOf(surface, false);
    const Meshed supported = meshOf(surface, true);
    EXPECT_FALSE(findConcaveAtWalls(bare.mesh(), quietContext()).empty());
    EXPECT_TRUE(findConcaveAtWalls(supported.mesh(), quietContext()).empty());
    EXPECT_GT(supported.mesh().elementCount(), bare.mesh().elementCount());
    EXPECT_NEAR(totalVolume(supported.mesh()), totalVolume(bare.mesh()), 2e-3 * totalVolume(bare.mesh()));
    EXPECT_TRUE(isValid(supported.mesh(), 0));
    EXPECT_TRUE(facesAreUnique(supported.mesh()));
  }
}

TEST(SupportedElements, HaveALayerOnNoMoreThanTheyNeed)
{
  TriangleSurface box;
  addBox(box, "Solid", {Vec3(-0.9, -0.7, -0.8), Vec3(1.0, 0.8, 0.9)});
  const Meshed bare = meshOf(box, false);
  EXPECT_TRUE(findConcaveAtWalls(bare.mesh(), quietContext()).empty());
  const Meshed supported = meshOf(box, true);
  EXPECT_EQ(supported.mesh().elementCount(), bare.mesh().elementCount());
  EXPECT_TRUE(supported.result.layers.surfaces.empty());
}

TEST(SupportedElements, HaveALayerAroundThemAndOnNoOtherSurface)
{
  TriangleSurface boxes;
  addBox(boxes, "Turned", {Vec3(-1.5, -0.5, -0.8), Vec3(-0.4, 0.6, 0.9)});
  turn(boxes, 17.0);
  addBox(boxes, "Straight", {Vec3(0.6, -0.5, -0.8), Vec3(1.4, 0.6, 0.9)});
  const std::vector<LayerCoverage> surfaces = meshOf(boxes, true).result.layers.surfaces;
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0].surface, "Turned");
  EXPECT_GT(surfaces[0].layered, 0.0);
}

/// Returns the area with layers of a surface of two boxes, of which one is turned, and the other so long.
double layeredBeside(double length)
{
  TriangleSurface boxes;
  addBox(boxes, "All", {Vec3(-1.5, -0.5, -0.8), Vec3(-0.4, 0.6, 0.9)});
  turn(boxes, 17.0);
  addBox(boxes, "All", {Vec3(0.2, -0.5, -0.8), Vec3(0.2 + length, 0.6, 0.9)});
  const std::vector<LayerCoverage> surfaces = meshOf(boxes, true).result.layers.surfaces;
  EXPECT_EQ(surfaces.size(), 1u);
  EXPECT_GT(surfaces.at(0).layered, 0.0);
  EXPECT_LE(surfaces.at(0).layered, surfaces.at(0).area);
  return surfaces.at(0).layered;
}

TEST(SupportedElements, SpreadNoLayerOverTheirSurface)
{
  EXPECT_LE(layeredBeside(1.5), 1.001 * layeredBeside(0.6)) << "whatever the size of the surface is";
}

TEST(SupportedElements, AreToldBySurfaceWithNoLayersAskedFor)
{
  const Meshed supported = meshOf(sphere(), true);
  ASSERT_EQ(supported.result.layers.surfaces.size(), 1u);
  const LayerCoverage& coverage = supported.result.layers.surfaces[0];
  EXPECT_EQ(coverage.layers, 0);
  EXPECT_GT(coverage.layered, 0.0);
  EXPECT_LE(coverage.layered, coverage.area);
  EXPECT_TRUE(meshOf(sphere(), false).result.layers.surfaces.empty());
}

TEST(SupportedElements, StandBesideLayersThatAreAskedFor)
{
  for (const int layers : {1, 3})
  {
    const Meshed mixed = meshOf(turnedSheets(), true, {{"*", {layers}}, {"Floor", {0}}, {"Between", {0}}});
    EXPECT_TRUE(findConcaveAtWalls(mixed.mesh(), quietContext()).empty()) << layers;
    EXPECT_TRUE(isValid(mixed.mesh(), 0));
    EXPECT_TRUE(facesAreUnique(mixed.mesh()));
  }
}

} // namespace
