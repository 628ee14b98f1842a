// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the frame of the grid: sizes, the lattice, and the planes of the domain.
#include "Grid/GridFrame.h"
#include "LatticeSamples.h"
#include "Support/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace atria;
using atria::testing::pointsOf;
using atria::testing::Random;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Units of 1/16, octants of 1/2, a root of 8.
GridFrame smallFrame()
{
  GridFrame frame;
  frame.origin = {1, 2, 3};
  frame.finestSize = 0.5;
  frame.depth = 4;
  frame.subBits = 3;
  frame.domain = {Vec3(1.25, 2.75, 4.25), Vec3(8.75, 7.25, 5.75)};
  frame.domainLow = frame.toLattice(frame.domain.min);
  frame.domainHigh = frame.toLattice(frame.domain.max);
  return frame;
}

TEST(GridFrame, HasSizesByLevel)
{
  const GridFrame frame = smallFrame();
  EXPECT_EQ(frame.latticeUnit(), 0.0625);
  EXPECT_EQ(frame.rootSize(), 8.0);
  EXPECT_EQ(frame.sizeOf(0), 8.0);
  EXPECT_EQ(frame.sizeOf(4), 0.5);
  EXPECT_EQ(frame.latticeSize(4), 8);
  for (int level = 0; level <= frame.depth; ++level)
  {
    EXPECT_EQ(static_cast<double>(frame.latticeSize(level)) * frame.latticeUnit(), frame.sizeOf(level));
  }
}

TEST(GridFrame, ConvertsToTheLatticeAndBack)
{
  const GridFrame frame = smallFrame();
  EXPECT_EQ(frame.toLattice({1, 2, 3}), (LatticePoint{0, 0, 0}));
  EXPECT_EQ(frame.toLattice({1.0625, 2.125, 3.1875}), (LatticePoint{1, 2, 3}));
  EXPECT_EQ(frame.toLattice({0.97, 2.03, 3.04}), (LatticePoint{0, 0, 1})) << "the nearest one";
  EXPECT_EQ(frame.toLattice({0.96, 0.0, 3.09}), (LatticePoint{-1, -32, 1}));
  EXPECT_EQ(toVector({-1, 2, 5}), Vec3(-1, 2, 5));
  Random random(11);
  for (int round = 0; round < 100; ++round)
  {
    const LatticePoint p = random.point(-1000, 1000);
    const Vec3 model = frame.toModel(p);
    EXPECT_EQ(model, Vec3(1, 2, 3) + 0.0625 * toVector(p));
    EXPECT_EQ(frame.toLattice(model), p);
    EXPECT_EQ(frame.toModel(toVector(p)), model);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(frame.toModel(axis, static_cast<double>(p[axis])), model[axis]);
    }
  }
  EXPECT_EQ(frame.toModel(Vec3(0.5, 0, -0.5)), Vec3(1.03125, 2, 2.96875));
  EXPECT_EQ(frame.toModel(1, 0.5), 2.03125);
}

TEST(GridFrame, HasTheDomainStrictlyInside)
{
  const GridFrame frame = smallFrame();
  const LatticePoint middle{50, 50, 30};
  EXPECT_TRUE(frame.inDomain(middle));
  for (int axis = 0; axis < 3; ++axis)
  {
    LatticePoint p = middle;
    p[axis] = frame.domainLow[axis];
    EXPECT_FALSE(frame.inDomain(p)) << axis;
    ++p[axis];
    EXPECT_TRUE(frame.inDomain(p)) << axis;
    p[axis] = frame.domainHigh[axis];
    EXPECT_FALSE(frame.inDomain(p)) << axis;
    --p[axis];
    EXPECT_TRUE(frame.inDomain(p)) << axis;
  }
}

/// The planes that have a place just inside the domain within the octant.
unsigned planesSlowly(const GridFrame& frame, const LatticePoint& low, const LatticePoint& high)
{
  unsigned planes = 0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const int axis = axisOf(direction);
    const double inside = isUpper(direction) ? static_cast<double>(frame.domainHigh[axis]) - 0.5
                                             : static_cast<double>(frame.domainLow[axis]) + 0.5;
    const bool isWithin = static_cast<double>(low[axis]) < inside && inside < static_cast<double>(high[axis]);
    planes |= isWithin ? 1u << direction : 0u;
  }
  return planes;
}

TEST(GridFrame, HasPlanesInTheOctantOnTheirInnerSide)
{
  GridFrame frame;
  frame.domainLow = {1, 2, 3};
  frame.domainHigh = {5, 4, 6};
  for (const LatticePoint& low : pointsOf(0, 6))
  {
    for (std::int64_t size = 1; size <= 6; ++size)
    {
      const LatticePoint high{low[0] + size, low[1] + size, low[2] + size};
      ASSERT_EQ(frame.domainPlanes(low, high), planesSlowly(frame, low, high));
    }
  }
}

TEST(GridFrame, KnowsThePlanesAndTheBoxOfItsDomain)
{
  GridFrame frame = smallFrame();
  const std::vector<double> planes{1.25, 8.75, 2.75, 7.25, 4.25, 5.75};
  for (int direction = 0; direction < 6; ++direction)
  {
    EXPECT_EQ(frame.planeOf(direction), planes.at(static_cast<std::size_t>(direction)));
  }
  EXPECT_TRUE(frame.prism().isBox());
  EXPECT_EQ(frame.prism().bounds.min, frame.domain.min);
  EXPECT_EQ(frame.prism().bounds.max, frame.domain.max);
  frame.turnedDomain = PlacedPrism(PlacedBox{Placement(20.0), frame.domain}, 5);
  EXPECT_EQ(frame.prism().sides().size(), 5u);
}

/// Sets the lattice for an extent that reaches from the root's lower corner along an axis, by so many finest octants.
void fitAlong(GridFrame& frame, int axis, double octants)
{
  Box3 extent{frame.origin, frame.origin};
  extent.extend(frame.origin + octants * frame.finestSize * Vec3::Unit(axis));
  fitLattice(frame, extent);
}

TEST(FittedLattice, LosesOneBitWithEachDoublingOfTheExtent)
{
  GridFrame frame = smallFrame();
  fitLattice(frame, {});
  EXPECT_EQ(frame.subBits, 30) << "and has no more than that";
  for (int doubling = 5; doubling <= 30; ++doubling)
  {
    const int before = frame.subBits;
    const double octants = 0.99 * std::exp2(doubling);
    fitAlong(frame, doubling % 3, octants);
    EXPECT_LT(octants * static_cast<double>(frame.latticeSize(frame.depth)), std::exp2(40.0));
    EXPECT_TRUE(frame.subBits == before - 1 || (before == 30 && frame.subBits == 30)) << doubling;
    EXPECT_EQ(frame.domainLow, frame.toLattice(frame.domain.min));
    EXPECT_EQ(frame.domainHigh, frame.toLattice(frame.domain.max));
  }
  EXPECT_EQ(frame.subBits, 8) << "the fewest";
}

TEST(FittedLattice, HoldsExtentsOfABillionOctantsOnAnyAxis)
{
  const double most = std::exp2(30.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    GridFrame frame = smallFrame();
    EXPECT_NO_THROW(fitAlong(frame, axis, 0.999 * most));
    EXPECT_THAT([&] { fitAlong(frame, axis, 1.001 * most); }, ThrowsMessage<Error>(HasSubstr("remove stray geometry")));
    EXPECT_NO_THROW(fitAlong(frame, axis, -0.999 * most));
    EXPECT_THROW(fitAlong(frame, axis, -1.001 * most), Error);
    const Vec3 half = 0.5 * most * frame.finestSize * Vec3::Unit(axis);
    EXPECT_NO_THROW(fitLattice(frame, {-0.999 * half, 0.999 * half}));
    EXPECT_THROW(fitLattice(frame, {-1.001 * half, 1.001 * half}), Error);
  }
}

TEST(FittedLattice, HoldsTheRootIfTheExtentIsSmaller)
{
  GridFrame frame = smallFrame();
  frame.depth = 31;
  EXPECT_THROW(fitLattice(frame, {Vec3(1, 2, 3), Vec3(1, 2, 3)}), Error);
  frame.depth = 20;
  fitLattice(frame, {});
  const int bits = frame.subBits;
  EXPECT_LT(bits, 30);
  fitLattice(frame, frame.domain);
  EXPECT_EQ(frame.subBits, bits);
}

} // namespace
