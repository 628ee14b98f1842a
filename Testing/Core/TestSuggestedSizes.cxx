// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes for a first mesh of a model of which nothing is known.
#include "Mesher/SuggestedSizes.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

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
  return suggestSizes(cube(length), options);
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

} // namespace
