// SPDX-License-Identifier: GPL-3.0-or-later
/// Heights of elements in viscous lengths.
#include "Layer/WallUnits.h"

#include <gtest/gtest.h>

namespace atria {

namespace {

TEST(WallUnits, AreThoseOfTheGuidelines)
{
  EXPECT_NEAR(heightAtYPlus(100.0, 5.0), 0.012, 1e-12) << "0.06 m/s over the speed";
  EXPECT_NEAR(heightAtYPlus(1.0, 10.0), 6e-5, 1e-12);
}

TEST(WallUnits, GoBothWays)
{
  for (const double speed : {0.1, 3.0, 40.0})
  {
    for (const double yPlus : {0.5, 30.0, 300.0})
    {
      EXPECT_NEAR(yPlusOf(heightAtYPlus(yPlus, speed), speed), yPlus, 1e-12 * yPlus);
    }
  }
}

} // namespace

} // namespace atria
