// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers and growths of layers that follow from the elements beside a wall.
#include "Layer/FlatLayers.h"
#include "Layer/LayerHeights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace atria {

namespace {

double heightOf(const WallLayers& layers) { return thicknessAsked(layers, 0.0, {}); }

double nextHeight(const WallLayers& layers) { return layers.firstHeight * std::pow(layers.growth, layers.layers); }

TEST(FittedLayers, KeepNumbersThatWereRequested)
{
  const WallLayers asked{4, 0.1, 1.3};
  EXPECT_EQ(fitted(asked, 1.0), asked);
  EXPECT_EQ(fitted(asked, 1e-3), asked);
}

TEST(FittedLayers, AreAsManyAsLeaveNoRoomForOneMore)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.002, 0.6);
  std::uniform_real_distribution<double> growth(1.0, 2.0);
  for (int i = 0; i < 200; ++i)
  {
    const double size = 0.37;
    const WallLayers layers = fitted({WallLayers::asManyAsFit, share(random) * size, growth(random)}, size);
    SCOPED_TRACE(testing::Message() << layers.layers << " from " << layers.firstHeight << " by " << layers.growth);
    ASSERT_GE(layers.layers, 1);
    ASSERT_LE(layers.layers, 100);
    const double next = nextHeight(layers);
    EXPECT_TRUE(layers.layers == 100 || heightOf(layers) + next >= 0.75 * size * (1.0 - 1e-9));
    WallLayers fewer = layers;
    --fewer.layers;
    EXPECT_TRUE(fewer.layers == 0 || heightOf(fewer) + nextHeight(fewer) <= 0.75 * size * (1.0 + 1e-9));
  }
}

TEST(FittedLayers, GrowSoThatTheNextIsAsHighAsWhatIsLeft)
{
  const WallLayers layers = fitted({5, 0.02, WallLayers::fittingGrowth}, 1.0);
  EXPECT_NEAR(heightOf(layers) + nextHeight(layers), 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(fitted({3, 0.5, WallLayers::fittingGrowth}, 1.0).growth, 1.0) << "too high already";
  EXPECT_DOUBLE_EQ(fitted({3, 1e-4, WallLayers::fittingGrowth}, 1.0).growth, maximumGrowth) << "too low in any case";
}

TEST(FlatLayers, AreMetByTheBoxesTheyStandFor)
{
  // Two layers of 0.1 and 0.2 in cubes of 1: 0.7 is left.
  const FlatLayers flat = flatLayers({2, 0.1, 2.0}, 1.0);
  EXPECT_NEAR(flat.weight, 0.2 / 0.9, 1e-12);
  EXPECT_NEAR(flat.volumeRatio, 0.2 / 0.7, 1e-12);
  EXPECT_NEAR(flat.convexity, 0.1 / std::hypot(0.1, 1.0), 1e-12);
  // The first has five neighbors, the second six: sums of A A^T over the mean area squared, by 8.
  const double first = 2.0 * 0.01 * 2.0 * 0.01 * 1.0 / std::pow((4.0 * 0.1 + 1.0) / 5.0, 6) / 8.0;
  const double second = 2.0 * 0.04 * 2.0 * 0.04 * 2.0 / std::pow((4.0 * 0.2 + 2.0) / 6.0, 6) / 8.0;
  EXPECT_NEAR(flat.determinantRoot, std::sqrt(std::sqrt(std::min(first, second))), 1e-12);
}

} // namespace

} // namespace atria
