// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests boxes on the lattice.
#include "Grid/LatticeBox.h"
#include "LatticeSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <vector>

namespace {

using namespace atria;
using atria::testing::pointsOf;
using atria::testing::Random;

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

} // namespace
