// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests directions and boxes in space.
#include "Support/Types.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using namespace atria;

TEST(Directions, ArePairsOfAxes)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const std::string name = sideNames.at(static_cast<std::size_t>(direction));
    EXPECT_EQ("xyz"[axisOf(direction)], name[0]);
    EXPECT_EQ(isUpper(direction), name.substr(1) == "Max");
    EXPECT_EQ(axisOf(opposite(direction)), axisOf(direction));
    EXPECT_NE(isUpper(opposite(direction)), isUpper(direction));
  }
}

TEST(Box3, GrowsFromEmptyToThePointsItHolds)
{
  Box3 box;
  EXPECT_TRUE(box.empty());
  box.extend({1, -2, 3});
  EXPECT_FALSE(box.empty()) << "a point";
  box.extend({0, 5, 3});
  EXPECT_EQ(box.min, Vec3(0, -2, 3));
  EXPECT_EQ(box.max, Vec3(1, 5, 3));
  EXPECT_EQ(box.size(), Vec3(1, 7, 0));
  EXPECT_EQ(box.center(), Vec3(0.5, 1.5, 3));
  for (int axis = 0; axis < 3; ++axis)
  {
    Box3 turned = box;
    turned.min[axis] = turned.max[axis] + 1e-9;
    EXPECT_TRUE(turned.empty()) << axis;
  }
}

TEST(Box3, TouchesWhatMeetsItOnEveryAxis)
{
  const Box3 box{Vec3(0, 0, 0), Vec3(2, 2, 2)};
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double shift : {-2.0, -1.0, 0.0, 2.0})
    {
      const Vec3 by = shift * Vec3::Unit(axis);
      EXPECT_TRUE(box.touches({box.min + by, box.max + by})) << axis << " " << shift;
    }
    for (const double shift : {-2.001, 2.001})
    {
      const Vec3 by = shift * Vec3::Unit(axis);
      EXPECT_FALSE(box.touches({box.min + by, box.max + by})) << axis << " " << shift;
    }
  }
  EXPECT_FALSE(box.touches(Box3())) << "an empty one";
}

TEST(Box3, IsAsFarAsItsNearestPoint)
{
  const Box3 box{Vec3(0, 0, 0), Vec3(2, 3, 4)};
  EXPECT_EQ(box.squaredDistance({1, 1, 1}), 0.0);
  EXPECT_EQ(box.squaredDistance({2, 3, 4}), 0.0);
  EXPECT_EQ(box.squaredDistance({-3, 1, 1}), 9.0);
  EXPECT_EQ(box.squaredDistance({1, 5, 1}), 4.0);
  EXPECT_EQ(box.squaredDistance({3, -1, 6}), 6.0);
}

} // namespace
