// SPDX-License-Identifier: GPL-3.0-or-later
/// What holds of every mesh, on random octrees and random soups of triangles.
#include "Octree/Sizing/Refinement.h"
#include "Octree/Tree/Balance.h"
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/RandomOctrees.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;

/// Levels of leaves that touch, found by their boxes.
void expectBalanced(const Octree& octree)
{
  // Every point next to a corner of a leaf lies in a leaf at most one level away.
  const GridFrame& frame = octree.frame();
  const std::int64_t end = frame.latticeSize(0);
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    ASSERT_EQ(octree.leafAt(octree.lowCorner(leaf)), leaf);
    if (!octree.inDomain(leaf))
    {
      continue;
    }
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      for (unsigned way = 0; way < 8; ++way)
      {
        LatticePoint p = octree.cornerOf(leaf, corner);
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
        {
          p[axis] -= way >> axis & 1 ? 1 : 0;
          inside = inside && p[axis] >= 0 && p[axis] < end;
        }
        const Index other = inside ? octree.leafAt(p) : leaf;
        ASSERT_TRUE(!octree.inDomain(other) || std::abs(octree.level(leaf) - octree.level(other)) <= 1)
            << "leaves " << leaf << " and " << other;
      }
    }
  }
}

TEST(RandomOctrees, DualsAreConformalClosedAndFillTheDomain)
{
  const int count = campaign(40, 400);
  for (int seed = 0; seed < count; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    const GridFrame frame = frameOfDepth(5, {31.0, 20.0 + 0.37 * (seed % 7), 17.0});
    RefinedSets sets = randomSets(frame, random);
    const RunContext context = quietContext();
    balance(sets, frame, context);
    RefinedSets again = sets;
    balance(again, frame, context);
    EXPECT_EQ(sets, again) << "balancing twice changes nothing";
    const Octree octree(frame, sets);
    EXPECT_EQ(octree.refinedSets(), sets);
    expectBalanced(octree);
    StageClock clock;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    const DualMesh mesh = makeDualMesh(octree, {}, options, clock, context).mesh;
    EXPECT_TRUE(isSound(mesh));
    const double volume = frame.domain.size().prod();
    EXPECT_NEAR(totalVolume(mesh) / volume, 1.0, 1e-9);
    const std::vector<double> all = volumes(mesh);
    EXPECT_GT(*std::min_element(all.begin(), all.end()), 0.0);
  }
}

/// V - E + F - C of the whole mesh: 1 for a ball.
long eulerCharacteristic(const DualMesh& mesh)
{
  std::set<std::pair<Index, Index>> edges;
  std::set<Index> points;
  long faces = 0;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    points.insert(mesh.corners[e].begin(), mesh.corners[e].end());
    for (int d = 0; d < 6; ++d)
    {
      const ReducedFace face = faceOf(mesh.corners[e], d);
      const std::int32_t neighbor = mesh.neighbors[e][d];
      faces += face.count >= 3 && (neighbor < 0 || neighbor > static_cast<std::int32_t>(e)) ? 1 : 0;
      for (int i = 0; i < face.count && face.count >= 3; ++i)
      {
        edges.insert(std::minmax(face.points[i], face.points[(i + 1) % face.count]));
      }
    }
  }
  return static_cast<long>(points.size()) - static_cast<long>(edges.size()) + faces -
         static_cast<long>(mesh.elementCount());
}

TEST(RandomOctrees, DualIsABall)
{
  const GridFrame frame = frameOfDepth(5, {31.0, 20.0, 17.0});
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    RefinedSets sets = randomSets(frame, random);
    const RunContext context = quietContext();
    balance(sets, frame, context);
    StageClock clock;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    EXPECT_EQ(eulerCharacteristic(makeDualMesh(Octree(frame, sets), {}, options, clock, context).mesh), 1);
  }
}

GridOptions soupGrid(unsigned seed)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-4.0), Vec3::Constant(4.0)};
  grid.sizeMin = seed % 2 == 0 ? 0.25 : 0.21;
  grid.sizeMid = 2.0 * grid.sizeMin;
  grid.sizeMax = 4.0 * grid.sizeMin;
  return grid;
}

TEST(RandomSoups, MeshesAreConformalClosedAndFillTheDomain)
{
  const unsigned count = static_cast<unsigned>(campaign(60, 1000));
  for (unsigned seed = 0; seed < count; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    const Meshed meshed = meshIt(randomSoup(seed), soupGrid(seed), options);
    const DualMesh& mesh = meshed.mesh();
    EXPECT_TRUE(isSound(mesh));
    EXPECT_NEAR(totalVolume(mesh) / 512.0, 1.0, 1e-9)
        << "what elements gain their neighbors lose, inverted ones included";
    // Tags partition the faces: each boundary face has one tag, and both faces of a sheet name each other.
    for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
    {
      const BoundaryFace& face = mesh.boundaryFaces[f];
      ASSERT_LT(face.tag, meshed.model.names.size() + 6);
      ASSERT_EQ(mesh.neighbors[face.element][face.direction], ~static_cast<std::int32_t>(f));
      ASSERT_EQ(face.onDomainSide || face.tag < meshed.model.names.size(), true);
      if (face.opposite != noIndex)
      {
        const std::int32_t back = mesh.neighbors[face.opposite][opposite(face.direction)];
        ASSERT_TRUE(DualMesh::isBoundary(back));
        ASSERT_EQ(mesh.boundaryFaces[DualMesh::boundaryFaceOf(back)].opposite, face.element);
      }
    }
  }
}

TEST(RandomSoups, GiveTheSameBitsForAnyNumberOfThreads)
{
  for (unsigned seed = 0; seed < static_cast<unsigned>(campaign(10, 100)); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TriangleSurface soup = randomSoup(seed);
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    const Meshed one = meshIt(soup, soupGrid(seed), options, 1);
    EXPECT_TRUE(identical(one.mesh(), meshIt(soup, soupGrid(seed), options, 2).mesh()));
    EXPECT_TRUE(identical(one.mesh(), meshIt(soup, soupGrid(seed), options, 7).mesh()));
  }
}

/// Faces of one tag, edges counted: those of a closed solid meet two by two.
TEST(RandomSoups, PatchesOfClosedSolidsAreWatertight)
{
  for (unsigned seed = 0; seed < static_cast<unsigned>(campaign(40, 400)); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const auto at = [&] { return Vec3(place(random), place(random), place(random)); };
    TriangleSurface surface;
    if (seed % 2 == 0)
    {
      // On round coordinates: every wall lies on planes of the grid.
      const Vec3 low = (4.0 * at()).array().round() / 4.0;
      addBox(surface, "Solid", {low - Vec3::Constant(1.0), low + Vec3::Constant(0.75)});
    }
    else
    {
      addSphere(surface, "Solid", at(), 1.3, 2);
    }
    turn(surface, seed % 3 == 0 ? 0.0 : (seed % 3 == 1 ? 90.0 : 29.0));
    const Meshed meshed = meshIt(surface, soupGrid(seed));
    ASSERT_EQ(meshed.result.keptZones.size(), 2u) << "inside and outside";
    std::map<std::pair<Index, Index>, int> edges;
    for (const BoundaryFace& face : meshed.mesh().boundaryFaces)
    {
      if (!face.onDomainSide)
      {
        ASSERT_EQ(face.tag, 0u);
        ASSERT_EQ(face.side, SheetSide::front);
        const ReducedFace corners = faceOf(meshed.mesh().corners[face.element], face.direction);
        for (int i = 0; i < corners.count; ++i)
        {
          const Index a = corners.points[i];
          const Index b = corners.points[(i + 1) % corners.count];
          edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
      }
    }
    EXPECT_FALSE(edges.empty());
    for (const auto& [edge, sum] : edges)
    {
      ASSERT_EQ(sum, 0);
    }
  }
}

} // namespace
