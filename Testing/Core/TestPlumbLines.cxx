// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests upright lines through triangles, and bins of boxes seen from above.
#include "Domain/PlumbLines.h"
#include "Support/Shapes.h"
#include "TerrainSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double rounding = 1e-9;

std::vector<Box3> randomBoxes(Random& random, std::size_t count)
{
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes)
  {
    if (random.below(10) > 0)
    {
      const Vec3 low(random.in(-5, 20), random.in(3, 9), random.in(0, 1));
      box = {low, low + Vec3(random.in(0, 2), random.in(0, 1), random.in(0, 5))};
    }
  }
  return boxes;
}

bool meetFromAbove(const Box3& box, const Vec3& low, const Vec3& high)
{
  return !box.empty() && box.min[0] <= high[0] && box.max[0] >= low[0] && box.min[1] <= high[1] && box.max[1] >= low[1];
}

TEST(PlanBins, VisitAllBoxesThatARectangleTouches)
{
  Random random(1);
  for (const std::size_t count : {0U, 1U, 3U, 50U, 400U})
  {
    const std::vector<Box3> boxes = randomBoxes(random, count);
    const PlanBins bins(boxes);
    for (int round = 0; round < 50; ++round)
    {
      const Vec3 low(random.in(-8, 22), random.in(2, 11), random.in(-50, 50));
      const Vec3 high = low + Vec3(random.in(0, 4), random.in(0, 4), 0);
      std::set<Index> visited;
      bins.eachNear(low, high, [&](Index i) { visited.insert(i); });
      for (Index i = 0; i < count; ++i)
      {
        EXPECT_TRUE(!meetFromAbove(boxes[i], low, high) || visited.contains(i));
        EXPECT_TRUE(!boxes[i].empty() || !visited.contains(i)) << "empty boxes are in no bin";
      }
    }
  }
}

TEST(PlanBins, VisitFewBoxesOnceAroundAPoint)
{
  std::vector<Box3> boxes;
  for (int i = 0; i < 400; ++i)
  {
    const Vec3 low(i % 20, 3.0 * (i / 20), 0.0);
    boxes.push_back({low, low + Vec3(0.5, 0.5, 1.0)});
  }
  const PlanBins bins(boxes);
  for (int i = 0; i < 400; ++i)
  {
    std::vector<Index> visited;
    const Vec3 p = boxes[static_cast<std::size_t>(i)].center();
    bins.eachNear(p, p, [&](Index box) { visited.push_back(box); });
    EXPECT_EQ(std::ranges::count(visited, static_cast<Index>(i)), 1);
    EXPECT_LE(visited.size(), 9U) << "those of its bin and the bins beside it at most";
    EXPECT_EQ(std::set<Index>(visited.begin(), visited.end()).size(), visited.size());
  }
}

TriangleSurface randomTriangles(Random& random, Index count)
{
  TriangleSurface surface;
  surface.names = {"All"};
  for (Index t = 0; t < count; ++t)
  {
    const Vec3 a(random.in(0, 9), random.in(0, 9), random.in(0, 9));
    Vec3 b = a + Vec3(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2));
    const Vec3 c = a + Vec3(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2));
    if (t % 5 == 0)
    {
      b.head<2>() = 0.5 * (a + c).head<2>(); // upright
    }
    surface.points.insert(surface.points.end(), {a, b, c});
    surface.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    surface.surfaceIds.push_back(0);
  }
  return surface;
}

double turnOf(const Vec3& a, const Vec3& b, double x, double y)
{
  return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

/// The height of a triangle that is not upright over a place; not a number beside it.
double heightOver(const TriangleSurface& surface, Index triangle, double x, double y)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vec3& p = surface.points[a];
  const Vec3& q = surface.points[b];
  const Vec3& r = surface.points[c];
  const double whole = turnOf(p, q, r[0], r[1]);
  const double ofR = turnOf(p, q, x, y) / whole;
  const double ofP = turnOf(q, r, x, y) / whole;
  const double ofQ = turnOf(r, p, x, y) / whole;
  const bool isIn = std::abs(whole) > 1e-9 && ofP >= 0.0 && ofQ >= 0.0 && ofR >= 0.0;
  return isIn ? ofP * p[2] + ofQ * q[2] + ofR * r[2] : std::nan("");
}

TEST(PlumbLines, MeetTheTrianglesOverAPlaceFromTheLowestUp)
{
  Random random(2);
  const TriangleSurface surface = randomTriangles(random, 200);
  std::vector<Index> some;
  for (Index t = 0; t < 200; t += 1 + t % 2)
  {
    some.push_back(t);
  }
  const PlumbLines lines(surface, some);
  std::vector<PlumbHit> hits{{1.0, 7}};
  for (int round = 0; round < 300; ++round)
  {
    const double x = random.in(-2, 11);
    const double y = random.in(-2, 11);
    std::vector<std::pair<double, Index>> expected;
    for (const Index t : some)
    {
      if (const double height = heightOver(surface, t, x, y); !std::isnan(height))
      {
        expected.emplace_back(height, t);
      }
    }
    std::ranges::sort(expected);
    lines.find(x, y, hits);
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      EXPECT_EQ(hits[i].triangle, expected[i].second);
      EXPECT_NEAR(hits[i].height, expected[i].first, rounding);
    }
  }
}

TEST(PlumbLines, MeetBothTrianglesAtACommonEdgeAndNoneBeyondTheLast)
{
  TriangleSurface surface;
  addSheet(surface, "Upper", Vec3(0, 0, 2), Vec3(4, 0, 0), Vec3(0, 4, 0));
  addSheet(surface, "Lower", Vec3(0, 0, 1), Vec3(4, 0, 0), Vec3(0, 4, 0));
  addSheet(surface, "Wall", Vec3(0, 2, 0), Vec3(4, 0, 0), Vec3(0, 0, 4));
  const PlumbLines lines(surface, allTriangles(surface));
  std::vector<PlumbHit> hits;
  const auto trianglesAt = [&](double x, double y) {
    lines.find(x, y, hits);
    std::vector<Index> triangles;
    std::ranges::transform(hits, std::back_inserter(triangles), &PlumbHit::triangle);
    return triangles;
  };
  EXPECT_THAT(trianglesAt(2, 2), ElementsAre(2, 3, 0, 1)) << "equal heights go by triangle";
  EXPECT_THAT(trianglesAt(3, 1), ElementsAre(2, 0));
  EXPECT_THAT(trianglesAt(1, 3), ElementsAre(3, 1));
  EXPECT_THAT(trianglesAt(4, 0), ElementsAre(2, 0)) << "corners belong to it";
  for (const auto& [x, y] : {std::pair(-0.01, 2.0), {4.01, 2.0}, {2.0, -0.01}, {2.0, 4.01}})
  {
    EXPECT_THAT(trianglesAt(x, y), IsEmpty());
  }
  PlumbLines(surface, {}).find(2, 2, hits);
  EXPECT_THAT(hits, IsEmpty());
}

/// A line from `top` down, and whether the wall is within its reach.
struct LineBesideWall
{
  Vec3 top;
  double bottom;
  double reach;
  bool isNear;
};

TEST(PlumbLines, FindUprightTrianglesWithinReachOfALine)
{
  TriangleSurface surface; // a wall, and around it what is not upright
  addSheet(surface, "Wall", Vec3(0, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 3));
  addSheet(surface, "Floor", Vec3(-9, -9, 1), Vec3(18, 0, 0), Vec3(0, 18, 0));
  addSheet(surface, "Steep", Vec3(0, 0, 0), Vec3(0, 4, 0), Vec3(0.01, 0, 3));
  const PlumbLines lines(surface, allTriangles(surface));
  for (const LineBesideWall& line : {LineBesideWall{Vec3(0.05, 2, 5), 0.0, 0.06, true},
                                     {Vec3(0.05, 2, 5), 0.0, 0.04, false},
                                     {Vec3(-0.05, 2, 5), 0.0, 0.06, true},
                                     {Vec3(0, 2, 2), 1.0, 0.0, true},
                                     {Vec3(0, 2, 5), 3.05, 0.06, true},
                                     {Vec3(0, 2, 5), 3.05, 0.04, false},
                                     {Vec3(0, 2, -0.05), -2.0, 0.06, true},
                                     {Vec3(0, 2, -0.05), -2.0, 0.04, false},
                                     {Vec3(0.03, 4.04, 5), 0.0, 0.051, true},
                                     {Vec3(0.03, 4.04, 5), 0.0, 0.049, false},
                                     {Vec3(0.03, -0.04, 5), 0.0, 0.051, true},
                                     {Vec3(0.03, -0.04, 5), 0.0, 0.049, false}})
  {
    std::set<Index> found;
    lines.eachUprightBelow(line.top, line.bottom, line.reach, [&](Index t) { found.insert(t); });
    EXPECT_EQ(!found.empty(), line.isNear) << line.top.transpose() << " reach " << line.reach;
    EXPECT_TRUE(found.empty() || *found.rbegin() < 2U) << "only those of the wall";
  }
}

} // namespace
