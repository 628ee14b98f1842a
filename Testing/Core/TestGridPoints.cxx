// SPDX-License-Identifier: GPL-3.0-or-later
/// Grid points against their definition: every corner of a leaf that lies inside the domain, with the leaves about it.
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace atria;
using atria::testing::Meshed;

GridPoints pointsOf(const Octree& octree, int threads)
{
  const ThreadExecutor executor(threads);
  return findGridPoints(octree, atria::testing::quietContext(executor));
}

std::array<Index, 8> leavesAbout(const Octree& octree, const LatticePoint& p)
{
  std::array<Index, 8> leaves;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    LatticePoint beside = p;
    for (int axis = 0; axis < 3; ++axis)
    {
      beside[axis] -= (slot >> axis & 1) != 0 ? 0 : 1;
    }
    leaves[slot] = octree.leafAt(beside);
  }
  return leaves;
}

void expectPointsOf(const Octree& octree, const GridPoints& points)
{
  std::set<LatticePoint> expected;
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      const LatticePoint p = octree.cornerOf(leaf, corner);
      const bool inside = octree.frame().inDomain(p);
      const Index point = points.atCorner[leaf][corner];
      ASSERT_EQ(point != noIndex, inside);
      if (inside)
      {
        expected.insert(p);
        ASSERT_EQ(positionOf(octree, points.leaves[point]), p);
      }
    }
  }
  ASSERT_EQ(points.size(), expected.size());
  for (const auto& leaves : points.leaves)
  {
    ASSERT_EQ(leaves, leavesAbout(octree, positionOf(octree, leaves)));
  }
}

void expectSameFromThreads(const Octree& octree, const GridPoints& points)
{
  const GridPoints other = pointsOf(octree, 3);
  EXPECT_EQ(points.leaves, other.leaves);
  EXPECT_EQ(points.atCorner, other.atCorner);
}

TEST(GridPoints, AreTheCornersOfLeavesInUniformGridsWhereverTheDomainEnds)
{
  TriangleSurface surface;
  atria::testing::addSphere(surface, "Ball", Vec3::Zero(), 1.0, 2);
  for (const double high : {2.0, 3.1, 4.3})
  {
    SCOPED_TRACE(high);
    GridOptions options;
    options.domain = {Vec3(-4.3, -2.2, -3.0), Vec3(high, 2.7, 1.9)};
    options.sizeMin = options.sizeMid = options.sizeMax = 0.25;
    const Meshed meshed = atria::testing::meshIt(surface, options);
    const GridPoints points = pointsOf(meshed.octree, 1);
    expectPointsOf(meshed.octree, points);
    expectSameFromThreads(meshed.octree, points);
  }
}

TEST(GridPoints, AreTheCornersOfLeavesWhereLevelsMeet)
{
  GridOptions options;
  options.domain = {Vec3::Constant(-4.3), Vec3::Constant(4.1)};
  options.sizeMin = 0.1;
  options.sizeMid = 0.4;
  options.sizeMax = 1.6;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    const Meshed meshed = atria::testing::meshIt(atria::testing::randomSoup(seed), options);
    const GridPoints points = pointsOf(meshed.octree, 1);
    expectPointsOf(meshed.octree, points);
    expectSameFromThreads(meshed.octree, points);
  }
}

} // namespace
