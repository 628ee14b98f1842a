// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the height of the floor below a model.
#include "Domain/Floor.h"
#include "TerrainSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

/// Faces 1 m wide at a height, with a model above.
LowestFace faceAt(double height, double area, double rise) { return {height, area, rise, noIndex}; }

/// The cost by the words of groundModel().
double costOf(const std::vector<LowestFace>& faces, double floor)
{
  double cost = 0.0;
  for (const LowestFace& face : faces)
  {
    const double gap = face.height - floor;
    const bool hovers = gap > 0.25 * face.rise;
    cost += face.area * (gap < 0.0 ? 3.0 * -gap : hovers ? face.rise : gap);
  }
  return cost;
}

TEST(Floor, IsTheLeastCostlyHeightOfAFace)
{
  Random random(5);
  for (int round = 0; round < 200; ++round)
  {
    std::vector<LowestFace> faces;
    const std::size_t count = 1 + random.below(12);
    for (std::size_t i = 0; i < count; ++i)
    {
      faces.push_back(faceAt(random.in(-2, 5), random.in(0.1, 3), random.below(4) == 0 ? 0.0 : random.in(0.1, 20)));
    }
    faces.front().rise = 1.0;
    double best = faces.front().height;
    for (const LowestFace& face : faces)
    {
      best = costOf(faces, face.height) < costOf(faces, best) ? face.height : best;
    }
    EXPECT_EQ(findFloor(faces, -99.0), best);
  }
}

TEST(Floor, IsTheLowestOfEqualOnesAndWeighsDepthThreefold)
{
  const auto floorOf = [](double area, double rise) {
    return findFloor({faceAt(1, area, rise), faceAt(0, 1, 10)}, -99.0);
  };
  EXPECT_EQ(floorOf(3.0, 4.0), 0.0) << "both cost three";
  EXPECT_EQ(floorOf(3.01, 4.0), 1.0);
  EXPECT_EQ(floorOf(2.99, 4.0), 0.0);
  EXPECT_EQ(floorOf(0.8, 3.99), 1.0) << "it would hover over the other";
  EXPECT_EQ(floorOf(0.8, 4.0), 0.0) << "a quarter of its height is no hovering";
}

TEST(Floor, IsTheLowestPointIfNoFaceHasAnythingAbove)
{
  EXPECT_EQ(findFloor({}, -7.0), -7.0);
  EXPECT_EQ(findFloor({faceAt(1, 5, 0), faceAt(2, 0, 5)}, -7.0), -7.0);
  EXPECT_EQ(findFloor({faceAt(1, 5, 0), faceAt(2, 1, 5)}, -7.0), 1.0) << "faces without cost as well";
}

TEST(Floor, OfManyFacesIsNextToTheBest)
{
  Random random(6);
  for (const std::size_t count : {511U, 512U, 513U, 1024U, 1025U, 3000U})
  {
    std::vector<LowestFace> faces;
    for (std::size_t i = 0; i < count; ++i)
    {
      faces.push_back(faceAt(random.in(0, 10), 1.0, 1e3));
    }
    std::vector<double> heights;
    std::ranges::transform(faces, std::back_inserter(heights), &LowestFace::height);
    std::ranges::sort(heights);
    const double floor = findFloor(faces, -99.0);
    // A quarter of the faces lies below the best floor, as depth costs three times as much as height.
    const auto below = std::ranges::lower_bound(heights, floor) - heights.begin();
    const double off = std::abs(static_cast<double>(below) - static_cast<double>(count) / 4.0);
    EXPECT_LE(off, 1.0 + std::ceil(static_cast<double>(count) / 512.0)) << count;
  }
}

} // namespace
