// SPDX-License-Identifier: GPL-3.0-or-later
/// What holds of every mesh of hexahedra, on random octrees, random soups and closed solids.
#include "Layer/LayerHeights.h"
#include "Layer/LayerWalls.h"
#include "Mesher/DualMesher.h"
#include "Octree/Sizing/Estimate.h"
#include "Octree/Tree/Balance.h"
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/RandomOctrees.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace atria;
using namespace atria::testing;

DualMesh dualOf(const GridFrame& frame, const RefinedSets& sets, bool hexahedra)
{
  StageClock clock;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.hexahedra = hexahedra;
  return makeDualMesh(Octree(frame, sets), {}, options, clock, quietContext()).mesh;
}

/// Returns the least scaled Jacobian at the corners of a hexahedron.
double scaledJacobian(const DualMesh& mesh, Index element)
{
  std::array<Vec3, 8> at;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    at[hexahedronCorner[corner]] = mesh.points[mesh.corners[element][corner]];
  }
  double least = 1.0;
  for (unsigned bits = 0; bits < 8; ++bits)
  {
    const auto edge = [&](unsigned bit) { return Vec3((at[bits | bit] - at[bits & ~bit]).normalized()); };
    least = std::min(least, edge(1).cross(edge(2)).dot(edge(4)));
  }
  return least;
}

std::ptrdiff_t countOthers(const DualMesh& mesh)
{
  return std::ranges::count_if(mesh.corners, [](const auto& corners) { return !hasAllCorners(corners); });
}

/// Returns the least scaled Jacobian of elements off the boundary.
double leastInside(const DualMesh& mesh)
{
  const std::vector<char> onBoundary = boundaryPoints(mesh, quietContext().executor);
  double least = 1.0;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    least = hasMarked(mesh.corners[e], onBoundary) ? least : std::min(least, scaledJacobian(mesh, e));
  }
  return least;
}

TEST(RandomHexahedra, FillTheDomain)
{
  const int count = campaign(40, 400);
  for (int seed = 0; seed < count; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    const GridFrame frame = frameOfDepth(5, {31.0, 20.0 + 0.37 * (seed % 7), 17.0});
    RefinedSets sets = randomSets(frame, random);
    balance(sets, frame, quietContext(), 1, true);
    RefinedSets again = sets;
    balance(again, frame, quietContext(), 1, true);
    EXPECT_EQ(sets, again) << "balancing twice changes nothing";
    const DualMesh mesh = dualOf(frame, sets, true);
    EXPECT_TRUE(isSound(mesh, 0));
    EXPECT_EQ(countOthers(mesh), 0);
    EXPECT_NEAR(totalVolume(mesh) / frame.domain.size().prod(), 1.0, 1e-9);
    EXPECT_GT(leastInside(mesh), 0.25);
    EXPECT_EQ(mesh.elementCount(), countElements(sets, true, frame, quietContext()));
    const std::size_t dominant = dualOf(frame, sets, false).elementCount();
    EXPECT_LT(mesh.elementCount(), dominant + dominant / 4) << "what splitting octants adds";
  }
}

/// All eight octants around a point may be refined or not; the others follow.
TEST(RandomHexahedra, FillTheDomainAroundEveryCornerOfRefinedOctants)
{
  const GridFrame frame = frameOfDepth(5, {31.0, 31.0, 31.0});
  for (unsigned refined = 0; refined < 256; ++refined)
  {
    SCOPED_TRACE("octants " + std::to_string(refined));
    RefinedSets sets{{0}, {}, {}, {}};
    for (MortonKey key = 0; key < 8; ++key)
    {
      sets[1].push_back(key);
    }
    for (MortonKey key = 0; key < 64; ++key)
    {
      sets[2].push_back(key);
    }
    // The families around the middle of the domain.
    for (unsigned family = 0; family < 8; ++family)
    {
      const GridCell cell{1 + (family & 1), 1 + (family >> 1 & 1), 1 + (family >> 2 & 1)};
      for (MortonKey child = 0; child < 8 && (refined >> family & 1) != 0; ++child)
      {
        sets[3].push_back(mortonKey(cell) << 3 | child);
      }
    }
    std::ranges::sort(sets[3]);
    balance(sets, frame, quietContext(), 1, true);
    const DualMesh mesh = dualOf(frame, sets, true);
    EXPECT_TRUE(isSound(mesh, 0));
    EXPECT_EQ(countOthers(mesh), 0);
    EXPECT_GT(leastInside(mesh), 0.25);
  }
}

GridOptions gridAround(unsigned seed)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-6.0), Vec3::Constant(6.0)};
  grid.sizeMin = seed % 2 == 0 ? 0.25 : 0.21;
  grid.sizeMid = 2.0 * grid.sizeMin;
  grid.sizeMax = 4.0 * grid.sizeMin;
  return grid;
}

/// Meshes a soup, and expects hexahedra only and the same bits for any number of threads.
Meshed meshSoupTwice(unsigned seed, const std::vector<LayerRule>& layers)
{
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.hexahedra = true;
  options.layers = layers;
  const TriangleSurface soup = randomSoup(seed);
  Meshed meshed = meshIt(soup, gridAround(seed), options);
  EXPECT_EQ(countOthers(meshed.mesh()), 0);
  EXPECT_TRUE(identical(meshed.mesh(), meshIt(soup, gridAround(seed), options, 3).mesh()));
  return meshed;
}

TEST(RandomHexahedra, MeshSoups)
{
  for (unsigned seed = 0; seed < static_cast<unsigned>(campaign(6, 100)); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Meshed meshed = meshSoupTwice(seed, {});
    EXPECT_TRUE(isSound(meshed.mesh(), 0));
    EXPECT_NEAR(totalVolume(meshed.mesh()) / gridAround(seed).domain.size().prod(), 1.0, 1e-9);
  }
}

TEST(Hexahedra, HaveAsManyLayersAsFitTheFinestElements)
{
  TriangleSurface sheet;
  addSheet(sheet, "Sheet", Vec3(-1.1, -0.9, 0.1), Vec3(2.0, 0.0, 0.0), Vec3(0.0, 1.8, 0.0));
  GridOptions grid;
  grid.domain = {Vec3::Constant(-4.0), Vec3::Constant(4.0)};
  grid.sizeMin = grid.sizeMid = 0.5;
  grid.sizeMax = 1.0;
  DualMeshOptions options;
  options.hexahedra = true;
  WallLayers layers{WallLayers::asManyAsFit, 0.05, 1.3};
  options.layers = {{"*", layers}};
  const Meshed fitting = meshIt(sheet, grid, options);
  layers.layers = fitted(layers, 0.5).layers;
  EXPECT_LT(layers.layers, 6);
  options.layers = {{"*", layers}};
  EXPECT_TRUE(identical(fitting.mesh(), meshIt(sheet, grid, options).mesh()));
}

/// Between a wall and a roof that ends an element beyond it there are elements with neighbors on two axes only. No
/// place of their points makes these better, so walls must not leave the model for them.
TEST(Hexahedra, KeepWallsUnderEavesInPlace)
{
  for (const double slope : {0.1, 0.2, 0.5})
  {
    SCOPED_TRACE(slope);
    constexpr double overhang = 0.5;
    TriangleSurface surface;
    addSheet(surface, "Wall", Vec3(0, 0, -2.5), Vec3(5, 0, 0), Vec3(0, 0, 3));
    addSheet(surface, "Roof", Vec3(0, -overhang, 0.5 - slope * overhang), Vec3(5, 0, 0),
             (2.0 + overhang) * Vec3(0, 1, slope));
    turn(surface, 29.0);
    GridOptions grid;
    grid.domain = {Vec3(-4.0, -4.0, -2.5), Vec3(8.0, 8.0, 3.5)};
    grid.sizeMin = grid.sizeMid = 0.5;
    grid.sizeMax = 2.0;
    DualMeshOptions options;
    options.hexahedra = true;
    options.layers = {{"*", {.layers = 1}}};
    const Meshed meshed = meshIt(surface, grid, options);
    EXPECT_TRUE(isValid(meshed.mesh(), 0));
    double area = 0.0;
    for (const BoundaryFace& face : meshed.mesh().boundaryFaces)
    {
      area += face.tag < 2 ? wallNormal(meshed.mesh(), face).norm() / 2.0 : 0.0; // sheets have two sides
    }
    EXPECT_NEAR(area / (15.0 + 5.0 * (2.0 + overhang) * std::hypot(1.0, slope)), 1.0, 0.01);
  }
}

/// Layers go round tubes in front of the edges of open triangles, which cross each other, too.
TEST(RandomHexahedra, MeshSoupsWithALayer)
{
  for (unsigned seed = 0; seed < static_cast<unsigned>(campaign(4, 100)); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Meshed meshed = meshSoupTwice(seed, {{"*", {.layers = 1}}});
    EXPECT_TRUE(isValid(meshed.mesh(), 0));
    const auto leftOut = std::ranges::count(meshed.result.diagnostics, Diagnostic::leftOutElement, &Diagnostic::kind);
    EXPECT_LE(static_cast<double>(leftOut), 1e-4 * static_cast<double>(meshed.mesh().elementCount()));
  }
}

TEST(RandomHexahedra, MeshClosedSolidsWithALayer)
{
  for (unsigned seed = 0; seed < static_cast<unsigned>(campaign(4, 40)); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-0.5, 0.5);
    TriangleSurface surface;
    const Vec3 center(place(random), place(random), place(random));
    if (seed % 2 == 0)
    {
      addSphere(surface, "Solid", center, 1.3, 3);
    }
    else
    {
      addBox(surface, "Solid", {center - Vec3::Constant(1.1), center + Vec3::Constant(0.9)});
    }
    turn(surface, 11.0 * seed);
    DualMeshOptions options;
    options.hexahedra = true;
    options.layers = {{"*", {.layers = 1}}};
    const Meshed meshed = meshIt(surface, gridAround(seed), options);
    EXPECT_TRUE(isValid(meshed.mesh(), 0));
    EXPECT_EQ(countOthers(meshed.mesh()), 0);
    double least = 1.0;
    for (Index e = 0; e < meshed.mesh().elementCount(); ++e)
    {
      least = std::min(least, scaledJacobian(meshed.mesh(), e));
    }
    EXPECT_GT(least, 0.2);
  }
}

} // namespace
