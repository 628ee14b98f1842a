// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/BoundaryEdges.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace atria;

const ThreadExecutor executor(2);

/// A grid of nx * ny squares of two triangles each, some left out.
std::vector<std::array<Index, 3>> gridSheet(Index nx, Index ny, const std::set<Index>& holes = {})
{
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j < ny; ++j)
  {
    for (Index i = 0; i < nx; ++i)
    {
      const Index p = j * (nx + 1) + i;
      if (holes.count(j * nx + i) == 0)
      {
        triangles.push_back({p, p + 1, p + nx + 2});
        triangles.push_back({p, p + nx + 2, p + nx + 1});
      }
    }
  }
  return triangles;
}

/// Runs follow edges from point to point, and hold each edge once.
void expectRunsAreWhole(const BoundaryEdges& boundary)
{
  std::vector<int> times(boundary.edges().size(), 0);
  for (const BoundaryEdges::Run& run : boundary.runs())
  {
    const auto end = [&](const BoundaryEdges::Link& link, unsigned which) {
      return boundary.edges()[link.edge].end(link.forward ? which : 1 - which);
    };
    for (std::size_t i = 0; i < run.links.size(); ++i)
    {
      ++times[run.links[i].edge];
      if (i > 0)
      {
        EXPECT_EQ(end(run.links[i - 1], 1), end(run.links[i], 0));
        EXPECT_EQ(boundary.at(end(run.links[i], 0)).size(), 2u);
      }
    }
    EXPECT_EQ(run.isRing, end(run.links.front(), 0) == end(run.links.back(), 1) &&
                              boundary.at(end(run.links.front(), 0)).size() == 2);
  }
  EXPECT_EQ(std::vector<int>(times.size(), 1), times);
}

TEST(BoundaryEdges, AreThoseOfOneTriangleInItsSense)
{
  const auto triangles = gridSheet(4, 3, {5});
  const BoundaryEdges boundary(triangles, 20, executor);
  EXPECT_EQ(boundary.edges().size(), 2u * (4 + 3) + 4u);
  for (const BoundaryEdge& edge : boundary.edges())
  {
    const auto& t = triangles[edge.triangle];
    const auto begin = std::ranges::find(t, edge.a) - t.begin();
    EXPECT_EQ(t[(begin + 1) % 3], edge.b);
    EXPECT_EQ(t[(begin + 2) % 3], edge.third);
    for (const BoundaryEdge& other : boundary.of(edge.triangle))
    {
      EXPECT_EQ(other.triangle, edge.triangle);
    }
  }
}

TEST(BoundaryEdges, OfASheetWithAHoleAreTwoRings)
{
  const BoundaryEdges boundary(gridSheet(4, 3, {5}), 20, executor);
  const auto runs = boundary.runs();
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_TRUE(runs[0].isRing && runs[1].isRing);
  EXPECT_EQ(runs[0].links.size() + runs[1].links.size(), boundary.edges().size());
  expectRunsAreWhole(boundary);
}

TEST(BoundaryEdges, RunsEndWhereMoreThanTwoMeetAndGoOnOverTrianglesWoundOtherwise)
{
  auto triangles = gridSheet(4, 4, {0, 5, 10}); // the holes touch in points
  for (std::size_t t = 0; t < triangles.size(); t += 3)
  {
    std::swap(triangles[t][0], triangles[t][1]);
  }
  const BoundaryEdges boundary(triangles, 25, executor);
  std::size_t meetings = 0;
  for (Index p = 0; p < 25; ++p)
  {
    meetings += boundary.at(p).size() > 2 ? 1 : 0;
  }
  EXPECT_EQ(meetings, 2u);
  const auto runs = boundary.runs();
  EXPECT_EQ(runs.size(), 4u); // the outside, two sides of the middle hole, the last hole
  expectRunsAreWhole(boundary);
}

TEST(BoundaryEdges, LeaveOutUnwantedTriangles)
{
  const auto triangles = gridSheet(2, 1);
  const BoundaryEdges boundary(triangles, 6, executor, [](Index t) { return t >= 2; });
  for (const BoundaryEdge& edge : boundary.edges())
  {
    EXPECT_GE(edge.triangle, 2u);
  }
  EXPECT_EQ(boundary.edges().size(), 3u);
}

TEST(BoundaryEdges, AheadIsWithin45DegreesOfWhereTheSheetGoesOn)
{
  const std::vector<LatticePoint> points{{0, 0, 0}, {1000, 0, 0}, {300, -700, 0}};
  const Vec3 outward = outwardOf(BoundaryEdge{0, 1, 2, 0}, points);
  EXPECT_LT((outward - Vec3::UnitY()).norm(), 1e-12);
  for (const double degrees : {0.0, 30.0, 44.0, 46.0, 90.0, 180.0})
  {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec3 way = 30.0 * (std::cos(angle) * Vec3::UnitY() + std::sin(angle) * Vec3(0.6, 0.0, 0.8));
    EXPECT_EQ(isAhead(outward, way), degrees < 45.0);
    if (degrees < 45.0)
    {
      const Box3 box{way - Vec3::Ones(), way + Vec3::Ones()};
      EXPECT_TRUE(reachesAhead(outward, Vec3::Zero(), box));
    }
  }
  EXPECT_FALSE(reachesAhead(outward, Vec3::Zero(), {Vec3(-5, -9, -5), Vec3(5, -8, 5)}));
}

} // namespace
