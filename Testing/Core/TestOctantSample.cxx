// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests counts of octants, and their estimate from a sample.
#include "Octree/Sizing/OctantSample.h"
#include "SizedOctree.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using namespace atria;
using namespace atria::testing;

TEST(OctantCounts, AddUpToLeaves)
{
  const OctantCounts counts{{1, 4, 2}, {8, 30, 16}};
  const std::array<double, 6> leaves{0, 4, 28, 16, 0, 0};
  double sum = 0.0;
  for (std::size_t level = 0; level < leaves.size(); ++level)
  {
    EXPECT_EQ(counts.leavesAt(level), leaves.at(level)) << level;
    sum += leaves.at(level);
  }
  EXPECT_EQ(counts.leaves(), sum);
  const std::array<double, 5> downTo{1, 8, 34, 48, 48};
  for (std::size_t depth = 0; depth < downTo.size(); ++depth)
  {
    EXPECT_EQ(counts.leavesDownTo(depth), downTo.at(depth)) << depth;
  }
  EXPECT_EQ(OctantCounts{}.leavesAt(0), 1.0);
  EXPECT_EQ(OctantCounts{}.leavesAt(1), 0.0);
  EXPECT_EQ(OctantCounts{}.leaves(), 1.0);
  EXPECT_EQ((OctantCounts{{1, 9}, {8, 0}}.leavesAt(1)), 0.0) << "never negative";
}

/// Octants of one size throughout, and a box that lies on none of their planes.
struct SampleCase
{
  explicit SampleCase(double length, double boxSize = 0.0)
  {
    TriangleSurface surface;
    addBox(surface, "Box", {Vec3(1, 1, 1), Vec3(2, 2, 2)});
    GridOptions grid = gridOf(length, 1.0, 1.0, 1.0);
    grid.domain.max[2] = 0.3 * length;
    if (boxSize > 0.0)
    {
      sizing.boxes = {{box, boxSize}};
    }
    of = sized(surface, grid, sizing);
    counts = sampleOctants(of.model, of.frame, sizing, quietContext());
  }

  const Box3 box{Vec3(-3.3, -5.2, -4.1), Vec3(2.7, 3.9, 0.3)};
  SizingOptions sizing;
  Sized of;
  OctantCounts counts;
};

TEST(OctantSample, IsExactForFewOctants)
{
  const SampleCase test(22.0);
  ASSERT_EQ(test.counts.refined.size(), test.of.octants.refined.size());
  std::size_t leaves = 0;
  eachLeaf(test.of.octree, [&](Index) { ++leaves; });
  EXPECT_EQ(test.counts.leaves(), static_cast<double>(leaves));
  for (std::size_t level = 0; level < test.counts.refined.size(); ++level)
  {
    EXPECT_EQ(test.counts.refined[level], static_cast<double>(test.of.octants.refined[level].size())) << level;
  }
}

TEST(OctantSample, TakesTheLargerOfTwoSources)
{
  const SampleCase test(22.0, 0.5);
  const GridFrame& frame = test.of.frame;
  std::size_t inBox = 0;
  const auto level = static_cast<int>(test.counts.refined.size()) - 1;
  EXPECT_EQ(frame.sizeOf(level), 1.0);
  for (MortonKey key = 0; key < MortonKey{1} << 3 * level; ++key)
  {
    const GridCell cell = gridCell(key);
    const Vec3 low = frame.origin + Vec3(cell[0], cell[1], cell[2]);
    const Vec3 high = low + Vec3::Constant(1.0);
    inBox += (low.array() < test.box.max.array()).all() && (high.array() > test.box.min.array()).all() ? 1 : 0;
  }
  EXPECT_EQ(test.counts.refined.back(), static_cast<double>(inBox));
  EXPECT_EQ(test.counts.children.back(), 8.0 * static_cast<double>(inBox)) << "all are in the domain";
  const SampleCase without(22.0);
  for (std::size_t l = 0; l < without.counts.refined.size(); ++l)
  {
    EXPECT_EQ(test.counts.refined[l], without.counts.refined[l]) << "the open is the larger one above";
  }
}

TEST(OctantSample, IsNearTheTruthForMany)
{
  const SampleCase test(110.0);
  ASSERT_GT(test.of.octants.refined.back().size(), 16384U) << "some are left out";
  double leaves = 0.0;
  eachLeaf(test.of.octree, [&](Index) { leaves += 1.0; });
  EXPECT_NEAR(test.counts.leaves() / leaves, 1.0, 0.03);
}

} // namespace
