// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests targets of quality and their ranges.
#include "Optimize/Kernel/QualityTargets.h"
#include "QualityRanges.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace atria;
using atria::testing::allRanges;

const std::vector<QualityRange> someRanges{{0.0, 1.0}, {0.1, 0.5}, {3.8, 2.0}, {-1.0, 4.0}, {2.0, -2.0}};

TEST(QualityRange, IsZeroAtTheLimitAndOneAtTheTarget)
{
  for (const QualityRange& range : someRanges)
  {
    EXPECT_EQ(range.of(range.limit), 0.0);
    EXPECT_EQ(range.of(range.target), 1.0);
    EXPECT_EQ(range.at(0.0), range.limit);
    EXPECT_DOUBLE_EQ(range.at(1.0), range.target);
    for (const double share : {-0.5, 0.25, 1.5})
    {
      EXPECT_NEAR(range.of(range.at(share)), share, 1e-12);
    }
  }
  EXPECT_DOUBLE_EQ((QualityRange{1.0, 5.0}).of(2.0), 0.25);
  EXPECT_DOUBLE_EQ((QualityRange{4.0, 2.0}).of(3.5), 0.25);
}

TEST(QualityRange, MovesItsTargetAwayFromTheLimit)
{
  for (const QualityRange& range : someRanges)
  {
    for (const double share : {-1.0, -0.5, 0.0, 0.25})
    {
      EXPECT_EQ(range.beyond(share).limit, range.limit);
      EXPECT_NEAR(range.of(range.beyond(share).target), 1.0 + share, 1e-12);
    }
  }
}

TEST(QualityRange, EasesItsLimitWithAnEasierTarget)
{
  struct Case
  {
    QualityRange before;
    double wanted;
    double limit;
  };
  const std::vector<Case> cases{{{0.1, 0.5}, 0.25, 0.05}, {{0.1, 0.5}, 0.75, 0.1}, {{0.1, 0.5}, 0.5, 0.1},
                                {{0.0, 0.5}, 0.25, 0.0},  {{4.0, 2.0}, 3.0, 6.0},  {{4.0, 2.0}, 1.0, 4.0}};
  for (const Case& one : cases)
  {
    QualityRange range = one.before;
    range.aimAt(one.wanted);
    EXPECT_EQ(range.target, one.wanted);
    EXPECT_DOUBLE_EQ(range.limit, one.limit) << one.wanted;
  }
}

TEST(QualityTargets, MoveAllOfTheirRanges)
{
  QualityTargets targets;
  targets.scaledJacobian = 0.4;
  targets.jacobianLimit = 0.1;
  for (const double share : {-0.5, 0.0, 0.2})
  {
    const QualityTargets beyond = targets.beyond(share);
    const QualityTargets within = targets.within(1.0 + share);
    for (const auto range : allRanges)
    {
      EXPECT_EQ((beyond.*range).limit, (targets.*range).limit);
      EXPECT_NEAR((targets.*range).of((beyond.*range).target), 1.0 + share, 1e-12);
      EXPECT_NEAR((within.*range).target, (beyond.*range).target, 1e-12);
    }
    EXPECT_DOUBLE_EQ(beyond.scaledJacobian, 0.4 * (1.0 + share));
    EXPECT_EQ(beyond.jacobianLimit, 0.1);
    EXPECT_EQ(beyond.convex, targets.convex);
  }
}

TEST(QualityTargets, HaveLimitsThatAreValidAndTargetsThatAreBetter)
{
  const QualityTargets targets;
  for (const auto range : allRanges)
  {
    const bool isSkewness = range == &QualityTargets::skewness;
    EXPECT_EQ((targets.*range).target < (targets.*range).limit, isSkewness) << "less skewness is better";
  }
  EXPECT_FALSE(targets.looksAtJacobians());
  QualityTargets looking;
  looking.scaledJacobian = 0.01;
  EXPECT_TRUE(looking.looksAtJacobians());
}

} // namespace
