// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests which parts of a soup are small. Octants at features are 64 lattice units long.
#include "RepairSamples.h"
#include "Support/QuietContext.h"
#include "Surface/Repair/SmallParts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <tuple>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addTriangle;
using atria::testing::quietContext;
using atria::testing::smallFrame;
using atria::testing::Triangle;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Parts below 50 lattice units are small.
SmallPartOptions belowFifty()
{
  SmallPartOptions options;
  options.size = 50.0 / 64.0;
  return options;
}

std::vector<char> smallOf(const TriangleSoup& soup, const SmallPartOptions& options)
{
  return findSmallParts(soup, smallFrame(), options, quietContext());
}

/// Adds a triangle that fills a box without depth.
void addFlat(TriangleSoup& soup, const LatticePoint& low, std::int64_t x, std::int64_t y)
{
  addTriangle(soup, low, {low[0] + x, low[1], low[2]}, {low[0], low[1] + y, low[2]});
}

TEST(SmallParts, HaveADiagonalBelowTheLimit)
{
  TriangleSoup soup;
  addFlat(soup, {0, 0, 0}, 30, 40); // 50
  addFlat(soup, {1000, 0, 0}, 30, 39);
  addFlat(soup, {2000, 0, 0}, 31, 40);
  addTriangle(soup, {0, 3000, 0}, {0, 3030, 0}, {0, 3000, 39});
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(0, 1, 0, 1));
}

TEST(SmallParts, AreNoneWithoutASize)
{
  TriangleSoup soup;
  addFlat(soup, {0, 0, 0}, 3, 4);
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
  {
    SmallPartOptions options;
    options.size = size;
    EXPECT_THAT(smallOf(soup, options), ElementsAre(0));
  }
  EXPECT_THAT(smallOf({}, belowFifty()), IsEmpty());
}

TEST(SmallParts, CountAllTrianglesOfAPart)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {20, 0, 0}, {0, 20, 0}, {45, 20, 0}, {500, 0, 0}, {520, 0, 0}, {500, 20, 0}};
  soup.add({0, 1, 2}, 0, 3);
  soup.add({1, 3, 2}, 0, 4); // with this, 45 * 20
  soup.add({4, 5, 6}, 0, 7);
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(1, 1, 1));
  soup.points[3][0] = 46; // 46 * 20 is beyond 50
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(0, 0, 1));
}

TEST(SmallParts, AreNoneOfKeptSurfaces)
{
  TriangleSoup soup;
  for (std::int64_t i = 0; i < 3; ++i)
  {
    addFlat(soup, {1000 * i, 0, 0}, 20, 20);
    soup.surfaceIds.back() = static_cast<Index>(i);
  }
  SmallPartOptions options = belowFifty();
  options.keptSurfaces = {0, 1};
  EXPECT_THAT(smallOf(soup, options), ElementsAre(1, 0, 1));
}

TEST(SmallParts, AreMeasuredByTheFinestOctantsAtTheirPlace)
{
  TriangleSoup soup;
  addFlat(soup, {0, 0, 0}, 18, 24);                                                         // 30
  addFlat(soup, {1000, 0, 0}, 12, 16);                                                      // 20
  for (const auto& [level, low, expected] : {std::tuple<int, std::int64_t, char>{5, 18, 0}, // below 25 here
                                             {5, 19, 1},
                                             {4, 18, 1},
                                             {3, 18, 1}}) // no coarser ones
  {
    SmallPartOptions options = belowFifty();
    options.finerPlaces = {{{{low, 0, 0}, {2000, 100, 100}}, level}, {{{-900, 0, 0}, {-800, 9, 9}}, 9}};
    EXPECT_THAT(smallOf(soup, options), ElementsAre(expected, 1)) << level << ' ' << low;
  }
}

TEST(SmallParts, ThatAreNearEachOtherCountAsOne)
{
  // Cells are 16 long. Together the two parts are longer than 50.
  struct Case
  {
    std::int64_t first;
    std::int64_t second;
    double gapTolerance;
    bool isOne;
  };
  for (const Case& test : {Case{0, 47, 0.0, true},
                           {0, 80, 0.0, false},
                           {0, 57, 0.0, false},
                           {0, 57, 7.5, true},
                           {-40, -88, 0.0, true},
                           {-40, -87, 0.0, true},
                           {-40, -120, 0.0, false}})
  {
    TriangleSoup soup;
    addFlat(soup, {test.first, 3, 3}, 40, 9);
    addFlat(soup, {test.second, 3, 3}, 40, 9);
    SmallPartOptions options = belowFifty();
    options.gapTolerance = test.gapTolerance;
    EXPECT_THAT(smallOf(soup, options), Each(test.isOne ? 0 : 1)) << test.first << ' ' << test.second;
  }
}

TEST(SmallParts, ThatTogetherAreSmallAreStillSmall)
{
  TriangleSoup soup;
  addFlat(soup, {0, 3, 3}, 20, 5);
  addFlat(soup, {25, 3, 3}, 20, 5);
  EXPECT_THAT(smallOf(soup, belowFifty()), Each(1));
}

TEST(SmallParts, StayAtABoundaryEdgeOfOthers)
{
  for (const std::int64_t gap : {0, 3, 4})
  {
    TriangleSoup soup;
    addFlat(soup, {0, 0, 0}, 1000, 1000);
    addFlat(soup, {500, -20 - gap, 0}, 20, 20);
    addFlat(soup, {530, -30 - gap, 0}, 9, 5); // in a cell with the last one
    addFlat(soup, {500, -90, 0}, 20, 20);     // alone
    SmallPartOptions options = belowFifty();
    options.gapTolerance = 3.0;
    const char expected = gap <= 3 ? 0 : 1;
    EXPECT_THAT(smallOf(soup, options), ElementsAre(0, expected, expected, 1)) << gap;
  }
}

TEST(SmallParts, DoNotStayAtAClosedPartOrAtAnotherSmallOne)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}, {0, 0, 1000}};
  for (const Triangle& t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
  {
    soup.add(t, 0, static_cast<Index>(soup.triangles.size()));
  }
  addFlat(soup, {500, 0, 0}, 20, 20);
  addFlat(soup, {-500, 0, 0}, 20, 20);
  addFlat(soup, {-500, 0, 0}, 20, 20);
  EXPECT_THAT(smallOf(soup, belowFifty()), ElementsAre(0, 0, 0, 0, 1, 1, 1));
}

} // namespace
