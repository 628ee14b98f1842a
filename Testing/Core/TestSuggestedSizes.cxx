// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes that follow from the model, its domain and the sizes that are given.
#include "Mesher/SuggestedSizes.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace atria;
using namespace atria::testing;

TriangleSurface cube(double length)
{
  TriangleSurface surface;
  addBox(surface, "Cube", {Vec3::Zero(), Vec3::Constant(length)});
  return surface;
}

GridOptions sizesFor(double length, std::size_t maxElements)
{
  ModelOptions options;
  options.site.mode = DomainMode::surfaces;
  options.sizing.maxElements = maxElements;
  options.sizes.sizeMax = options.sizes.sizeMid = options.sizes.sizeMin = 0.0;
  return completeSizes(cube(length), options);
}

/// A cube of 10 m in a domain of any length; sizes of 0 are not given.
GridOptions completed(double domain, double sizeMin, double sizeMid, double sizeMax)
{
  ModelOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = {Vec3::Constant(-domain / 2), Vec3::Constant(domain / 2)};
  options.sizes.sizeMin = sizeMin;
  options.sizes.sizeMid = sizeMid;
  options.sizes.sizeMax = sizeMax;
  return completeSizes(cube(10.0), options);
}

/// The sizes are round numbers, of which the next is at most 2.5 times as large: the octants are within a factor
/// of 2.5.
TEST(SuggestedSizes, GiveTheSurfacesAsManyOctantsAtAnyScale)
{
  for (double length = 1e-3; length < 1e5; length *= 7.0)
  {
    SCOPED_TRACE(length);
    const GridOptions sizes = sizesFor(length, 0);
    const double octants = 6.0 * length * length / (sizes.sizeMid * sizes.sizeMid);
    EXPECT_GT(octants, 50000.0 / 2.6);
    EXPECT_LT(octants, 50000.0 * 2.6);
    EXPECT_DOUBLE_EQ(sizes.sizeMin, 0.5 * sizes.sizeMid);
    EXPECT_GE(sizes.sizeMax, 4.0 * sizes.sizeMid * (1.0 - 1e-12));
  }
}

TEST(SuggestedSizes, FitTheMostElements)
{
  for (const std::size_t most : {2000, 15000, 60000, 300000})
  {
    SCOPED_TRACE(most);
    const GridOptions sizes = sizesFor(10.0, most);
    const double octants = 600.0 / (sizes.sizeMid * sizes.sizeMid);
    EXPECT_GT(octants, static_cast<double>(most) / 20.0 / 2.6);
    EXPECT_LT(octants, static_cast<double>(most) / 20.0 * 2.6);
  }
  EXPECT_EQ(sizesFor(10.0, 100'000'000).sizeMid, sizesFor(10.0, 0).sizeMid) << "no more than without a limit";
}

TEST(SuggestedSizes, TheLargestFollowsFromTheDomainWhateverElseIsGiven)
{
  for (const auto& [low, mid] : {std::pair(0.5, 1.0), std::pair(0.0, 1.0), std::pair(0.5, 0.0)})
  {
    double before = 0.0;
    for (double domain = 20.0; domain < 1e5; domain *= 2.0)
    {
      SCOPED_TRACE(domain);
      const GridOptions sizes = completed(domain, low, mid, 0.0);
      EXPECT_EQ(sizes.sizeMin, 0.5);
      EXPECT_EQ(sizes.sizeMid, 1.0);
      EXPECT_GE(sizes.sizeMax, std::max(4.0, before));
      const double octants = std::pow(domain / sizes.sizeMax, 3);
      EXPECT_LT(octants, 50000.0 * 4.0);
      EXPECT_TRUE(sizes.sizeMax == 4.0 || octants > 50000.0 / 4.0) << "no larger than the domain needs";
      before = sizes.sizeMax;
    }
    EXPECT_GT(before, 1000.0);
  }
}

TEST(SuggestedSizes, WhatIsGivenStays)
{
  for (const double low : {0.0, 0.5})
  {
    for (const double mid : {0.0, 0.6})
    {
      for (const double high : {0.0, 0.7})
      {
        const GridOptions sizes = completed(100.0, low, mid, high);
        EXPECT_TRUE(low == 0.0 || sizes.sizeMin == low);
        EXPECT_TRUE(mid == 0.0 || sizes.sizeMid == mid);
        EXPECT_TRUE(high == 0.0 || sizes.sizeMax == high);
        EXPECT_TRUE(0.0 < sizes.sizeMin && sizes.sizeMin <= sizes.sizeMid && sizes.sizeMid <= sizes.sizeMax);
      }
    }
  }
}

} // namespace
