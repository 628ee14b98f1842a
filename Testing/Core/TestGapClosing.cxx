// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how gaps between triangles are closed.
#include "RepairSamples.h"
#include "Support/QuietContext.h"
#include "Surface/Repair/GapClosing.h"
#include "Surface/Triangles/SoupParts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

TEST(SoupAsDrawn, HasPartsAndShortestEdgesOfSources)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {30, 0, 0}, {0, 40, 0}, {30, 40, 12}, {500, 0, 0}, {560, 0, 0}, {500, 80, 0}};
  soup.add({0, 1, 2}, 0, 1); // 30, 50, 40
  soup.add({1, 3, 2}, 0, 1);
  soup.add({4, 5, 6}, 0, 3); // 60, 100, 80
  const SoupAsDrawn drawn(soup);
  EXPECT_EQ(drawn.parts, partsOf(soup));
  ASSERT_EQ(drawn.shortestEdges.size(), 4u);
  EXPECT_EQ(drawn.shortestEdges[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(drawn.shortestEdges[1], 30.0);
  EXPECT_EQ(drawn.shortestEdges[3], 60.0);
}

/// A triangle on the ground, and one that stands above it on two feet.
TriangleSoup standing(const LatticePoint& foot, const LatticePoint& other)
{
  TriangleSoup soup;
  addTriangle(soup, {-5000, -5000, 0}, {5000, -5000, 0}, {0, 8000, 0});
  addTriangle(soup, foot, other, {(foot[0] + other[0]) / 2, (foot[1] + other[1]) / 2, foot[2] + 2000});
  return soup;
}

/// Closes gaps and returns the flags of the points.
std::vector<char> closed(TriangleSoup& soup, double tolerance, const GridFrame& frame = smallFrame())
{
  const SoupAsDrawn drawn(soup);
  ClusterCells clusters;
  return closeGaps(soup, frame, {tolerance, drawn, clusters}, quietContext());
}

TEST(GapClosing, MovesPointsWithinTheToleranceOntoAFace)
{
  for (const std::int64_t height : {-41, -40, 0, 2, 3, 39, 40, 41})
  {
    TriangleSoup soup = standing({-500, 0, height}, {500, 0, height});
    const TriangleSoup before = soup;
    const bool moves = std::abs(height) >= 3 && std::abs(height) <= 40;
    const char flag = moves ? 1 : 0;
    EXPECT_THAT(closed(soup, 40.0), ElementsAre(0, 0, 0, flag, flag, 0)) << height;
    EXPECT_EQ(soup.points[3], (LatticePoint{-500, 0, moves ? 0 : height}));
    EXPECT_EQ(soup.points[4], (LatticePoint{500, 0, moves ? 0 : height}));
    EXPECT_EQ(soup.points[5], before.points[5]);
    EXPECT_EQ(soup.triangles, before.triangles);
  }
}

TEST(GapClosing, MovesNothingBelowAToleranceOfOne)
{
  TriangleSoup soup = standing({-500, 0, 30}, {500, 0, 30});
  const std::vector<LatticePoint> before = soup.points;
  EXPECT_THAT(closed(soup, 0.99), Each(0));
  EXPECT_THAT(closed(soup, 0.0), Each(0));
  EXPECT_EQ(soup.points, before);
  TriangleSoup empty;
  EXPECT_THAT(closed(empty, 40.0), IsEmpty());
}

TEST(GapClosing, PrefersCornersAndEdgesUpToTwiceAsFarAsTheFace)
{
  struct Case
  {
    LatticePoint foot;
    double tolerance;
    LatticePoint expected;
  };
  const std::vector<Case> cases{
      {{-500, -4985, 20}, 40.0, {-500, -5000, 0}},   // 25 to the edge, 20 to the face
      {{-500, -4960, 20}, 40.0, {-500, -4960, 0}},   // 45 is beyond the tolerance
      {{-500, -4960, 20}, 200.0, {-500, -4960, 0}},  // and more than twice as far
      {{-500, -4966, 20}, 200.0, {-500, -5000, 0}},  // 39.4 is not
      {{-500, -5012, 16}, 40.0, {-500, -5000, 0}},   // beside the triangle
      {{-4990, -4995, 20}, 40.0, {-5000, -5000, 0}}, // 23 to the corner
  };
  for (const Case& test : cases)
  {
    TriangleSoup soup = standing(test.foot, {test.foot[0] + 1000, test.foot[1], 500});
    const std::vector<char> isMoved = closed(soup, test.tolerance);
    EXPECT_EQ(soup.points[3], test.expected) << test.foot[1] << ' ' << test.tolerance;
    EXPECT_THAT(isMoved, ElementsAre(0, 0, 0, 1, 0, 0));
  }
}

TEST(GapClosing, LeavesPointsOfPartsFinerThanTwoTolerances)
{
  for (const std::int64_t width : {79, 80})
  {
    TriangleSoup soup = standing({0, 0, 30}, {width, 0, 30});
    EXPECT_THAT(closed(soup, 40.0), ElementsAre(0, 0, 0, width == 80, width == 80, 0)) << width;
  }
}

TEST(GapClosing, LeavesTrianglesThatWouldTurnBy45Degrees)
{
  for (const std::int64_t height : {10, 200})
  {
    TriangleSoup soup;
    addTriangle(soup, {-5000, -5000, 0}, {5000, -5000, 0}, {0, 8000, 0});
    addTriangle(soup, {-500, 0, 30}, {500, 0, 30}, {0, height, 30});
    const char flag = height == 200 ? 1 : 0;
    EXPECT_THAT(closed(soup, 40.0), ElementsAre(0, 0, 0, flag, flag, flag)) << height;
  }
}

TEST(GapClosing, MovesTheSmallerPart)
{
  // Each has a corner close to the face of the other.
  for (const bool isFirst : {false, true})
  {
    TriangleSoup soup;
    const auto large = [&] { addTriangle(soup, {-5000, -5000, 0}, {5000, -5000, 0}, {0, 8000, 0}); };
    const auto small = [&] { addTriangle(soup, {-500, 0, 20}, {500, 0, 20}, {0, 900, 20}); };
    isFirst ? large() : small();
    isFirst ? small() : large();
    const std::size_t moved = isFirst ? 3 : 0;
    const std::vector<char> isMoved = closed(soup, 40.0);
    for (std::size_t p = 0; p < 6; ++p)
    {
      EXPECT_EQ(isMoved[p], p >= moved && p < moved + 3 ? 1 : 0);
      EXPECT_EQ(soup.points[p][2], 0);
    }
  }
}

TEST(GapClosing, KeepsPointsOnSidesOfTheDomain)
{
  // A wall that is not quite upright, and a foot at its side: the way to the wall is mostly across.
  for (const std::int64_t side : {-500, -501})
  {
    GridFrame frame = smallFrame();
    frame.domainLow[0] = side;
    TriangleSoup level = standing({-500, 0, 30}, {500, 0, 30});
    EXPECT_THAT(closed(level, 40.0, frame), ElementsAre(0, 0, 0, 1, 1, 0)) << "it slides down the side";
    EXPECT_EQ(level.points[3], (LatticePoint{-500, 0, 0}));
    TriangleSoup across;
    addTriangle(across, {-530, -5000, -5000}, {-530, 5000, -5000}, {-530, 0, 8000});
    addTriangle(across, {-500, -500, 0}, {-500, 500, 0}, {1500, 0, 0});
    const char flag = side == -500 ? 0 : 1;
    EXPECT_THAT(closed(across, 40.0, frame), ElementsAre(0, 0, 0, flag, flag, 0)) << side;
  }
}

TEST(GapClosing, SlidesPointsAlongTheirSideOfTheDomain)
{
  // The ground rises by 1 in 4 along x, so that its nearest point is off the side.
  GridFrame frame = smallFrame();
  frame.domainLow[0] = -4000;
  TriangleSoup soup;
  addTriangle(soup, {-8000, -5000, -2000}, {8000, -5000, 2000}, {-8000, 9000, -2000});
  addTriangle(soup, {-4000, -500, -980}, {-4000, 500, -980}, {-4000, 0, 900});
  EXPECT_THAT(closed(soup, 40.0, frame), ElementsAre(0, 0, 0, 1, 1, 0));
  EXPECT_EQ(soup.points[3][0], -4000);
  EXPECT_LT(soup.points[3][2], -995);
}

TEST(GapClosing, LooksAtNoHiddenTriangles)
{
  TriangleSoup soup = standing({-500, 0, 30}, {500, 0, 30});
  const SoupAsDrawn drawn(soup);
  ClusterCells clusters;
  clusters.hide(0);
  EXPECT_THAT(closeGaps(soup, smallFrame(), {40.0, drawn, clusters}, quietContext()), Each(0));
}

TEST(GapClosing, MovesEdgesOntoTheirOwnPartAheadOfThem)
{
  // A sheet bent to a box without its front: the last wall ends short of the first one.
  for (const std::int64_t gap : {30, 41})
  {
    TriangleSoup soup;
    soup.points = {{0, 0, 0},          {0, 0, 3000},   {4000, 0, 0},      {4000, 0, 3000}, {4000, 4000, 0},
                   {4000, 4000, 3000}, {gap, 4000, 0}, {gap, 4000, 3000}, {0, 6000, 0},    {0, 6000, 3000}};
    for (const Triangle& t :
         {Triangle{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}, {4, 6, 7}, {4, 7, 5}, {8, 0, 1}, {8, 1, 9}})
    {
      soup.add(t, 0, static_cast<Index>(soup.triangles.size()));
    }
    const std::vector<char> isMoved = closed(soup, 40.0);
    for (std::size_t p = 0; p < soup.points.size(); ++p)
    {
      EXPECT_EQ(isMoved[p], gap == 30 && (p == 6 || p == 7) ? 1 : 0) << p;
    }
    EXPECT_EQ(soup.points[6], (LatticePoint{gap == 30 ? 0 : gap, 4000, 0}));
  }
}

} // namespace
