// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the frames that are made for the options of a grid.
#include "Grid/GridFrame.h"
#include "LatticeSamples.h"
#include "Support/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Random;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();

GridOptions someOptions(Random& random)
{
  GridOptions options;
  options.sizeMin = std::exp2(random.in(-3.0, 3.0));
  options.sizeMid = options.sizeMin * random.in(1.0, 9.0);
  options.sizeMax = options.sizeMid * random.in(1.0, 50.0);
  options.startLevel = static_cast<int>(random.whole(-1, 9));
  options.finestAsked = random.in(0.0, 1.0) < 0.4 ? infinity : options.sizeMin * random.in(0.05, 1.5);
  options.domain.min = random.vector(100.0);
  const Vec3 octants(std::exp2(random.in(1.01, 7.0)), std::exp2(random.in(1.01, 7.0)), std::exp2(random.in(1.01, 7.0)));
  options.domain.max = options.domain.min + options.sizeMin * octants;
  return options;
}

/// Runs a check on the frames of many options.
void onSomeFrames(const std::function<void(const GridOptions&, const GridFrame&)>& check)
{
  Random random(12);
  for (int round = 0; round < 400; ++round)
  {
    const GridOptions options = someOptions(random);
    SCOPED_TRACE(round);
    check(options, makeGridFrame(options, options.domain));
  }
}

TEST(MadeFrame, HoldsTheDomainInTheSmallestRoot)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    const Vec3 below = (options.domain.min - frame.origin) / frame.finestSize;
    const Vec3 above = (frame.origin + Vec3::Constant(frame.rootSize()) - options.domain.max) / frame.finestSize;
    EXPECT_GE(below.minCoeff(), 0.5 - 1e-6) << "half an octant sticks out";
    EXPECT_GE(above.minCoeff(), 0.5 - 1e-6);
    EXPECT_GT(options.domain.size().maxCoeff() + frame.finestSize, 0.5 * frame.rootSize() * (1.0 - 1e-6));
    EXPECT_EQ(frame.domain.min, options.domain.min);
    EXPECT_EQ(frame.domain.max, options.domain.max);
  });
}

TEST(MadeFrame, HasItsLowerPlanesThroughCentersOfTheFinestOctants)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = (options.domain.min[axis] - frame.origin[axis]) / frame.finestSize;
      EXPECT_NEAR(at - std::floor(at), 0.5, 1e-6);
    }
  });
}

TEST(MadeFrame, HasTheFinestSizeThatIsRequested)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    EXPECT_LE(frame.finestSize, options.finestAsked);
    EXPECT_LE(frame.finestSize, options.sizeMin);
    EXPECT_GT(2.0 * frame.finestSize, std::min(options.finestAsked, options.sizeMin)) << "and none finer";
    EXPECT_EQ(frame.sizeOf(frame.featureLevel), options.sizeMin);
  });
}

TEST(MadeFrame, HasNoFinerLevelWhereRoundingIsAllThatAsksForIt)
{
  GridOptions options;
  options.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
  for (const double finest : {0.25, 0.25 * (1.0 - 1e-11)})
  {
    options.finestAsked = finest;
    EXPECT_EQ(makeGridFrame(options, {}).finestSize, 0.25);
  }
  options.finestAsked = 0.25 * (1.0 - 1e-6);
  EXPECT_EQ(makeGridFrame(options, {}).finestSize, 0.125);
}

/// Expects the size of `level` to be nearest to `size`, of all levels from `first` on.
void expectNearest(const GridFrame& frame, int level, double size, int first)
{
  ASSERT_GE(level, first);
  ASSERT_LE(level, frame.depth);
  for (int other = first; other <= frame.depth; ++other)
  {
    EXPECT_LE(std::abs(frame.sizeOf(level) - size), std::abs(frame.sizeOf(other) - size)) << other;
  }
}

TEST(MadeFrame, HasTheLevelsWhoseSizesAreNearest)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    expectNearest(frame, frame.midLevel, options.sizeMid, frame.startLevel);
    expectNearest(frame, frame.topLevel, options.sizeMax, frame.startLevel);
  });
}

TEST(MadeFrame, StartsWhereTwoOctantsFitInTheDomain)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    const double thinnest = options.domain.size().minCoeff();
    const int coarsest = coarsestLevelFor(frame);
    EXPECT_TRUE(coarsest == frame.depth || 2.0 * frame.sizeOf(coarsest) <= thinnest);
    EXPECT_TRUE(coarsest == 0 || 2.0 * frame.sizeOf(coarsest - 1) > thinnest);
    EXPECT_EQ(frame.startLevel, std::min(std::max(options.startLevel, coarsest), frame.depth));
  });
}

TEST(MadeFrame, MayHaveOctantsAsLargeAsTheRootAndNoLargestSize)
{
  GridOptions options;
  options.domain = {Vec3(0, 0, 0), Vec3(7, 7, 7)};
  options.sizeMax = infinity;
  options.startLevel = 0;
  const GridFrame frame = makeGridFrame(options, {});
  EXPECT_EQ(frame.depth, 3);
  EXPECT_EQ(frame.topLevel, frame.startLevel);
  EXPECT_EQ(frame.sizeOf(frame.startLevel), 2.0);
  options.domain.max = {8, 8, 8};
  const GridFrame larger = makeGridFrame(options, {});
  EXPECT_EQ(larger.sizeOf(larger.startLevel), 4.0) << "two of them are as long as the domain";
}

TEST(MadeFrame, HasTheDomainInTheMiddleOfTheSmallestOctantThatHoldsIt)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    for (int axis = 0; axis < 3 && frame.finestSize == options.sizeMin; ++axis)
    {
      const double octants = options.domain.size()[axis] / frame.finestSize;
      const double room = std::exp2(std::ceil(std::log2(octants + 1.0)));
      const double below = (options.domain.min[axis] - frame.origin[axis]) / frame.finestSize;
      const double above = room - below - octants;
      EXPECT_GE(above, 0.5 - 1e-6);
      EXPECT_GE(above - below, -1e-6);
      EXPECT_LT(above - below, 2.0 + 1e-6);
    }
  });
}

TEST(MadeFrame, WithLevelsBelowSizeMinHasItsPlanesNextToCentersOfItsOctantsWhereThereIsRoom)
{
  onSomeFrames([](const GridOptions& options, const GridFrame& frame) {
    const double period = options.sizeMin / frame.finestSize;
    for (int axis = 0; axis < 3 && period > 1.0; ++axis)
    {
      const double spare = (frame.rootSize() - options.domain.size()[axis]) / frame.finestSize - 1.0;
      const double at = (options.domain.min[axis] - frame.origin[axis]) / frame.finestSize;
      if (spare >= 0.5 * period + 1e-6)
      {
        EXPECT_NEAR(std::fmod(at, period), 0.5 * period + 0.5, 1e-6);
      }
      else
      {
        EXPECT_NEAR(at, std::floor(0.5 * spare) + 0.5, 1e-6) << "half of what is to spare";
      }
    }
  });
}

TEST(MadeFrame, WithLevelsBelowSizeMinHasTheDomainInTheMiddleWithoutThatRoom)
{
  // Octants of SizeMin are 16 of the finest; the root is 256 of these, of which one sticks out.
  for (const int spare : {0, 5, 7, 8, 9, 23})
  {
    GridOptions options;
    options.finestAsked = 0.0625;
    options.domain = {Vec3(0, 0, 0), Vec3::Constant(0.0625 * (255 - spare))};
    const GridFrame frame = makeGridFrame(options, {});
    EXPECT_EQ(frame.rootSize(), 16.0);
    const double below = spare < 8 ? std::floor(0.5 * spare) + 0.5 : 8.5; // finest octants
    EXPECT_EQ(frame.origin, Vec3::Constant(-0.0625 * below)) << spare;
  }
}

TEST(MadeFrame, HasUpperPlanesThroughCentersWhereTheDomainIsAMultiple)
{
  Random random(13);
  for (int round = 0; round < 60; ++round)
  {
    GridOptions options;
    options.sizeMin = 0.1 * static_cast<double>(random.whole(1, 9));
    options.sizeMid = options.sizeMax = 2.0 * options.sizeMin;
    options.domain.min = random.vector(100.0);
    LatticePoint octants = random.point(3, 70);
    octants[0] = round % 2 == 0 ? 127 : octants[0]; // one more is a power of two
    options.domain.max = options.domain.min + options.sizeMin * toVector(octants);
    const GridFrame frame = makeGridFrame(options, options.domain);
    const std::int64_t longest = *std::ranges::max_element(octants);
    EXPECT_GE(std::int64_t{1} << frame.depth, longest + 1);
    EXPECT_LT(std::int64_t{1} << (frame.depth - 1), longest + 1) << "rounding adds no level";
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t finest = frame.latticeSize(frame.depth);
      EXPECT_EQ(frame.domainLow[axis] % finest, finest / 2);
      EXPECT_EQ(frame.domainHigh[axis] - frame.domainLow[axis], octants[axis] * finest);
    }
  }
}

TEST(MadeFrame, MayBeTwentyLevelsDeep)
{
  GridOptions options;
  const double most = static_cast<double>((1 << GridFrame::maximumDepth) - 1);
  options.domain = {Vec3(0, 0, 0), Vec3(4, most, 4)};
  EXPECT_EQ(makeGridFrame(options, {}).depth, GridFrame::maximumDepth);
  options.domain.max[1] += 1.0;
  EXPECT_THAT([&] { makeGridFrame(options, {}); }, ThrowsMessage<Error>(HasSubstr("at most 1048576 is possible")));
  options.domain.max[1] = 40.0;
  options.finestAsked = 1e-30;
  EXPECT_THROW(makeGridFrame(options, {}), Error);
}

TEST(MadeFrameError, SizesAreNotPositiveOrNotOrdered)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> sizes{{0, 2, 8}, {-1, 2, 8}, {nan, 2, 8}, {2, 1, 8}, {1, nan, 8}, {1, 3, 2}, {1, 2, nan}};
  for (const Vec3& size : sizes)
  {
    GridOptions options;
    options.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
    options.sizeMin = size[0];
    options.sizeMid = size[1];
    options.sizeMax = size[2];
    EXPECT_THAT([&] { makeGridFrame(options, {}); }, ThrowsMessage<Error>(HasSubstr("sizes must be positive")));
  }
  GridOptions equal;
  equal.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
  equal.sizeMid = equal.sizeMax = equal.sizeMin;
  EXPECT_NO_THROW(makeGridFrame(equal, {}));
  equal.sizeMid = equal.sizeMax = infinity;
  EXPECT_THROW(makeGridFrame(equal, {}), Error);
}

TEST(MadeFrameError, TheDomainIsEmptyOrThin)
{
  GridOptions options;
  EXPECT_THAT([&] { makeGridFrame(options, {}); }, ThrowsMessage<Error>(HasSubstr("the domain is empty")));
  for (int axis = 0; axis < 3; ++axis)
  {
    options.domain = {Vec3(0, 0, 0), Vec3(40, 40, 40)};
    options.domain.max[axis] = 2.0;
    EXPECT_NO_THROW(makeGridFrame(options, {})) << "two octants";
    options.domain.max[axis] = 1.999;
    EXPECT_THAT([&] { makeGridFrame(options, {}); },
                ThrowsMessage<Error>(HasSubstr("the domain is 1.999 long in " + std::string(1, "xyz"[axis]))));
    options.domain.max[axis] = infinity;
    EXPECT_THROW(makeGridFrame(options, {}), Error);
  }
}

} // namespace
