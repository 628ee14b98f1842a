// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the axes of prisms in layers.
#include "Layer/PrismAxes.h"

#include <gtest/gtest.h>

namespace {

using namespace atria;

Vec3 placeOf(std::uint8_t corner)
{
  const unsigned bits = hexahedronCorner.at(corner);
  return {bits & 1 ? 1.0 : 0.0, bits & 2 ? 1.0 : 0.0, bits & 4 ? 1.0 : 0.0};
}

TEST(PrismAxes, LeadAcrossAnElement)
{
  for (std::uint8_t corner = 0; corner < 8; ++corner)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Vec3 across = placeOf(corner);
      across[axis] = 1.0 - across[axis];
      EXPECT_EQ(placeOf(acrossAxis(corner, axis)), across);
    }
    for (int direction = 0; direction < 6; ++direction)
    {
      EXPECT_EQ(hasCorner(direction, corner), placeOf(corner)[axisOf(direction)] == (isUpper(direction) ? 1.0 : 0.0));
    }
  }
}

TEST(PrismAxes, FindTheFaceBesideAnEdge)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto& face = hexahedronFace.at(static_cast<std::size_t>(direction));
    for (int edge = 0; edge < 4; ++edge)
    {
      const auto i = static_cast<std::size_t>(edge);
      const Vec3 middle = 0.5 * (placeOf(face.at(i)) + placeOf(face.at((i + 1) % 4)));
      const int beside = besideEdge(direction, edge);
      ASSERT_GE(beside, 0);
      EXPECT_NE(axisOf(beside), axisOf(direction));
      EXPECT_EQ(middle[axisOf(beside)], isUpper(beside) ? 1.0 : 0.0) << "the edge is in its plane";
    }
  }
}

} // namespace
