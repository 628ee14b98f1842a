// SPDX-License-Identifier: GPL-3.0-or-later
/// Gaps narrower than an octant.
#include "FoundZones.h"

#include <gmock/gmock.h>

#include <cmath>

namespace {

using namespace atria;
using atria::testing::addSheet;
using atria::testing::addSurface;
using atria::testing::FoundZones;
using atria::testing::turned;
using atria::testing::uniformGrid;

const Box3 domain{Vec3(-4, -4, 0), Vec3(4, 4, 6)};
constexpr double size = 0.5;
/// Half way between two planes of the grid across y: these pass through -4 + (i + 0.5) * size.
constexpr double between = 0.5;

/// A wall through the whole domain at x = 0.13, in two parts with a crack at `y`.
TriangleSurface crackedWall(double y, double width, double degrees = 0.0)
{
  TriangleSurface surface;
  addSheet(surface, "South", Vec3(0.13, -9, -1), Vec3(0, 9 + y - 0.5 * width, 0), Vec3(0, 0, 9));
  addSheet(surface, "North", Vec3(0.13, y + 0.5 * width, -1), Vec3(0, 9, 0), Vec3(0, 0, 9));
  atria::testing::turn(surface, degrees);
  return surface;
}

TEST(Cracks, BelowAnOctantBetweenGridLinesDoNotLeakAndAreListedWhereTheyAre)
{
  for (const double part : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
  {
    SCOPED_TRACE(part);
    FoundZones found(crackedWall(between, part * size), uniformGrid(domain, size));
    EXPECT_NE(found.zoneAt(Vec3(-3, 0, 3)), found.zoneAt(Vec3(3, 0, 3)));
    const auto cracks = found.cracks();
    ASSERT_EQ(cracks.size(), 1u);
    const Crack& crack = cracks.front();
    EXPECT_FALSE(crack.open);
    EXPECT_NEAR(crack.width, part * size, 1e-6);
    ASSERT_EQ(crack.path.size(), 2u);
    const auto [low, high] = std::minmax(crack.path.front()[2], crack.path.back()[2]);
    EXPECT_NEAR(low, 0.0, 0.25 * size);
    EXPECT_NEAR(high, 6.0, 0.25 * size);
    for (const Vec3& p : crack.path)
    {
      EXPECT_NEAR(p[0], 0.13, 1e-6);
      EXPECT_NEAR(p[1], between, 1e-6);
    }
    const Vec3 beside = found.position(crack.point);
    EXPECT_LT(std::hypot(beside[0] - 0.13, beside[1] - between), 2.0 * size);
  }
}

TEST(Cracks, ThoseThroughWhichAnEdgePassesLeakAndAreListedAsOpen)
{
  for (const double part : {0.1, 0.5, 0.9})
  {
    SCOPED_TRACE(part);
    FoundZones found(crackedWall(between + 0.5 * size, part * size), uniformGrid(domain, size));
    EXPECT_EQ(found.zoneAt(Vec3(-3, 0, 3)), found.zoneAt(Vec3(3, 0, 3)));
    const auto cracks = found.cracks();
    ASSERT_EQ(cracks.size(), 1u);
    EXPECT_TRUE(cracks[0].open);
    EXPECT_NEAR(cracks[0].width, part * size, 1e-6);
    EXPECT_NEAR((cracks[0].path.front() - cracks[0].path.back()).norm(), 6.0, 0.5 * size);
  }
}

TEST(Cracks, WidthsOfAnOctantAndMoreAreNotListed)
{
  EXPECT_TRUE(FoundZones(crackedWall(between, 1.01 * size), uniformGrid(domain, size)).cracks().empty());
  EXPECT_TRUE(FoundZones(crackedWall(between, 2.4 * size), uniformGrid(domain, size)).cracks().empty());
}

TEST(Cracks, AlongATurnedWallEveryPlaceIsListedAsClosedOrOpen)
{
  for (const double degrees : {13.0, 29.0, 45.0})
  {
    for (const double part : {0.15, 0.4, 0.8})
    {
      SCOPED_TRACE(degrees);
      SCOPED_TRACE(part);
      const double width = part * size;
      FoundZones found(crackedWall(0.2, width, degrees), uniformGrid(domain, size));
      const auto cracks = found.cracks();
      double open = 0.0, closed = 0.0;
      for (const Crack& crack : cracks)
      {
        EXPECT_NEAR(crack.width, width, 1e-6);
        for (std::size_t i = 0; i + 1 < crack.path.size(); ++i)
        {
          const Vec3 middle = turned(Vec3(0.13, 0.2, 0.5 * (crack.path[i][2] + crack.path[i + 1][2])), degrees);
          EXPECT_LT((0.5 * (crack.path[i] + crack.path[i + 1]) - middle).norm(), 1e-6);
          (crack.open ? open : closed) += (crack.path[i + 1] - crack.path[i]).norm();
        }
      }
      EXPECT_NEAR(open + closed, domain.size()[2], 0.5 * size);
      EXPECT_EQ(found.zoneAt(Vec3(-3, 0, 3)) == found.zoneAt(Vec3(3, 0, 3)), open > 0.0);
    }
  }
}

TEST(Cracks, BetweenAnEdgeAndAFaceAndOverTheGround)
{
  TriangleSurface surface;
  // Grid planes across z are at 0.25 + i * 0.5: the wall hangs between the ground and a slab, near to both.
  addSheet(surface, "Wall", Vec3(0.13, -1.6, 0.2), Vec3(0, 3.2, 0), Vec3(0, 0, 2.7));
  addSheet(surface, "Slab", Vec3(-2, -2, 3.1), Vec3(4, 0, 0), Vec3(0, 4, 0));
  FoundZones found(surface, uniformGrid(domain, size));
  auto cracks = found.cracks();
  ASSERT_EQ(cracks.size(), 2u);
  EXPECT_FALSE(cracks[0].open || cracks[1].open);
  std::sort(cracks.begin(), cracks.end(), [](const auto& l, const auto& r) { return l.path[0][2] < r.path[0][2]; });
  EXPECT_NEAR(cracks[0].width, 0.2, 1e-6);
  EXPECT_NEAR(cracks[0].path[0][2], 0.1, 1e-6);
  EXPECT_NEAR(cracks[1].width, 0.2, 1e-6);
  EXPECT_NEAR(cracks[1].path[0][2], 3.0, 1e-6);
  for (const Crack& crack : cracks)
  {
    EXPECT_NEAR((crack.path.back() - crack.path.front()).norm(), 3.2, 1e-6);
  }
}

TEST(Cracks, FreeSheetsTheirCornersAndSheetsThatMeetHaveNone)
{
  TriangleSurface surface;
  addSheet(surface, "Strip", Vec3(-2, -2, 1), Vec3(0.2, 0, 0), Vec3(0, 4, 0)); // narrower than an octant
  addSheet(surface, "Wall", Vec3(1, -2, 2), Vec3(0, 4, 0), Vec3(0, 0, 2));
  addSheet(surface, "Other", Vec3(1, -2, 2), Vec3(2, 0, 0), Vec3(0, 0, 2));      // at an edge of the wall
  addSheet(surface, "Partition", Vec3(1, 0.7, 2), Vec3(2, 0, 0), Vec3(0, 0, 2)); // ends on the wall's face
  const Box3 wide{Vec3(-5, -5, 0), Vec3(5, 5, 6)};
  EXPECT_TRUE(FoundZones(surface, uniformGrid(wide, size)).cracks().empty());
  atria::testing::turn(surface, 31.0);
  EXPECT_TRUE(FoundZones(surface, uniformGrid(wide, size)).cracks().empty());
}

/// A wall with a window as many octants wide.
TriangleSurface wallWithWindow(double width, double degrees)
{
  TriangleSurface surface;
  const double half = 0.5 * width * size;
  atria::testing::addPierced(surface, "Wall", Vec3(0.13, -9, -9), Vec3(0, 18, 0), Vec3(0, 0, 24),
                             {0.5 + (0.11 - half) / 18, 10.21 / 24}, {0.5 + (0.11 + half) / 18, 13.63 / 24});
  atria::testing::turn(surface, degrees);
  return surface;
}

TEST(Cracks, AreNoneAtCornersOfOpeningsAsWideAsAnOctant)
{
  for (const double degrees : {0.0, 17.0, 31.0, 45.0})
  {
    for (const double width : {1.0, 1.25, 2.0})
    {
      SCOPED_TRACE(std::to_string(degrees) + " degrees, " + std::to_string(width));
      const TriangleSurface surface = wallWithWindow(width, degrees);
      EXPECT_TRUE(FoundZones(surface, uniformGrid(domain, size)).cracks().empty());
    }
  }
}

TEST(Cracks, RunsGoOnOverPointsOfTheBoundary)
{
  // A wall in eight parts, one beside another, each welded to the next: the boundary edge is a chain of edges.
  TriangleSurface surface;
  for (int i = 0; i < 8; ++i)
  {
    addSheet(surface, "Wall" + std::to_string(i), Vec3(0.13, -2 + 0.5 * i, 0.6), Vec3(0, 0.5, 0), Vec3(0, 0, 2.3));
  }
  addSheet(surface, "Slab", Vec3(-2, -2.5, 3.1), Vec3(4, 0, 0), Vec3(0, 5, 0));
  FoundZones found(surface, uniformGrid(domain, size));
  const auto cracks = found.cracks();
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_EQ(cracks[0].path.size(), 2u);
  EXPECT_NEAR((cracks[0].path.back() - cracks[0].path.front()).norm(), 4.0, 1e-6);
}

/// All of what a model has that divides its domain across x.
void expectClosed(FoundZones& found, bool closed)
{
  EXPECT_EQ(found.zoneAt(Vec3(-3, 0, 3)) != found.zoneAt(Vec3(3, 0, 3)), closed);
  for (const Crack& crack : found.cracks())
  {
    EXPECT_NE(crack.open, closed);
  }
}

TEST(ClosedCracks, AreThoseWithinTheToleranceWhereverTheGridIs)
{
  for (const double degrees : {0.0, 13.0, 45.0})
  {
    for (const double part : {0.1, 0.3, 0.49})
    {
      for (const double y : {between, between + 0.25 * size, between + 0.5 * size})
      {
        SCOPED_TRACE(std::to_string(degrees) + " degrees, " + std::to_string(part) + " at " + std::to_string(y));
        FoundZones found(crackedWall(y, part * size, degrees), uniformGrid(domain, size));
        found.closeCracksUpTo(0.5);
        expectClosed(found, true);
      }
    }
  }
}

TEST(ClosedCracks, CrossEdgesOnceThatPermeableSurfacesCrossToo)
{
  TriangleSurface surface = crackedWall(between + 0.5 * size, 0.4 * size);
  addSheet(surface, "Screen", Vec3(-0.2, -9, -1), Vec3(0, 18, 0), Vec3(0, 0, 9));
  FoundZones found(surface, uniformGrid(domain, size));
  found.model.kinds = {SurfaceKind::wall, SurfaceKind::wall, SurfaceKind::faceZone};
  found.crossings = findCrossings(found.grid, found.model, found.context());
  const std::size_t crossed = found.crossings.crossedEdges.size();
  found.closeCracksUpTo(0.5);
  EXPECT_NE(found.zoneAt(Vec3(-3, 0, 3)), found.zoneAt(Vec3(3, 0, 3)));
  EXPECT_EQ(found.crossings.crossedEdges.size(), crossed);
  for (const CrossedEdge& edge : found.crossings.crossedEdges)
  {
    const auto cuts = found.crossings.of(edge);
    ASSERT_EQ(cuts.size(), 2U);
    EXPECT_EQ(found.model.surfaceIds[cuts[0].triangle], 2U) << "the screen comes first along x";
    EXPECT_LT(cuts[0].parameter, cuts[1].parameter);
  }
}

TEST(ClosedCracks, WiderGapsStayOpenAndAtZeroAllDo)
{
  for (const auto& [part, tolerance] : {std::pair(0.51, 0.5), std::pair(0.3, 0.25), std::pair(0.1, 0.0)})
  {
    SCOPED_TRACE(part);
    FoundZones found(crackedWall(between + 0.5 * size, part * size), uniformGrid(domain, size));
    found.closeCracksUpTo(tolerance);
    expectClosed(found, false);
  }
}

/// A wall across the whole domain but for a gap about it, and a frame in which it stands.
TriangleSurface framedPanel(double gap, double aside, double degrees)
{
  TriangleSurface surface;
  atria::testing::addPierced(surface, "Frame", Vec3(0.13, -9, -9), Vec3(0, 18, 0), Vec3(0, 0, 24),
                             {0.5 - 1.37 / 18, (9 + 1.21) / 24}, {0.5 + 1.37 / 18, (9 + 4.63) / 24});
  addSheet(surface, "Panel", Vec3(0.13 + aside, -1.37 + gap, 1.21 + gap), Vec3(0, 2.74 - 2 * gap, 0),
           Vec3(0, 0, 3.42 - 2 * gap));
  atria::testing::turn(surface, degrees);
  return surface;
}

TEST(ClosedCracks, GoRoundCornersAndBetweenSheetsThatAreOutOfLine)
{
  for (const double degrees : {0.0, 17.0, 31.0})
  {
    for (const double gap : {0.1, 0.25, 0.35})
    {
      for (const double aside : {0.0, 0.5})
      {
        SCOPED_TRACE(std::to_string(degrees) + " degrees, gap " + std::to_string(gap) + ", " + std::to_string(aside));
        const TriangleSurface surface = framedPanel(gap * size, aside * gap * size, degrees);
        FoundZones open(surface, uniformGrid(domain, size));
        EXPECT_EQ(open.zoneAt(Vec3(-3, 0, 3)), open.zoneAt(Vec3(3, 0, 3)));
        FoundZones found(surface, uniformGrid(domain, size));
        found.closeCracksUpTo(0.5);
        expectClosed(found, true);
      }
    }
  }
}

TEST(ClosedCracks, LeaveWindowsAsTheyAreDownToTheTolerance)
{
  for (const double degrees : {0.0, 17.0, 31.0, 45.0})
  {
    for (const double width : {0.6, 1.0, 2.0})
    {
      SCOPED_TRACE(std::to_string(degrees) + " degrees, " + std::to_string(width));
      const TriangleSurface surface = wallWithWindow(width, degrees);
      FoundZones found(surface, uniformGrid(domain, size));
      const auto neighbors = found.crossings.neighbors;
      found.closeCracksUpTo(0.5);
      EXPECT_EQ(found.crossings.neighbors, neighbors);
    }
  }
}

TEST(ClosedCracks, BetweenAnEdgeAndAFaceOverTheGroundAndInAWedge)
{
  for (const double z : {0.0, 0.1, 0.23, 0.31})
  {
    TriangleSurface surface;
    // Upright through the domain, over its bare bottom by a gap that narrows to nothing at one end of the lower
    // boundary edge.
    addSurface(surface, "Wall", {Vec3(0.13, -9, z), Vec3(0.13, 9, 0.24), Vec3(0.13, 9, 2.9), Vec3(0.13, -9, 2.9)},
               {{0, 1, 2}, {0, 2, 3}});
    addSheet(surface, "Slab", Vec3(-9, -9, 3.1), Vec3(18, 0, 0), Vec3(0, 18, 0));
    for (const double rise : {0.0, 0.07, 0.13, 0.19})
    {
      GridOptions grid = uniformGrid(domain, size);
      grid.domain.min[2] -= rise; // the gaps lie elsewhere in the octants
      grid.domain.max[2] -= rise;
      FoundZones found(surface, grid);
      const double widest = std::max(z, 0.24) + rise;
      found.closeCracksUpTo(widest / size + 0.01);
      EXPECT_NE(found.zoneAt(Vec3(-3, 0, 1.5)), found.zoneAt(Vec3(3, 0, 1.5))) << z << ", " << rise;
    }
  }
}

TEST(ClosedCracks, TheSameForOneTwoAndSevenThreads)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const GridOptions grid = uniformGrid({Vec3::Constant(-4.3), Vec3::Constant(4.1)}, 0.25);
    const TriangleSurface soup = atria::testing::randomSoup(seed);
    FoundZones wanted(soup, grid, 1);
    wanted.closeCracksUpTo(0.5);
    for (const int threads : {2, 7})
    {
      FoundZones found(soup, grid, threads);
      found.closeCracksUpTo(0.5);
      EXPECT_EQ(found.crossings.neighbors, wanted.crossings.neighbors);
      EXPECT_EQ(found.zones.ofPoint, wanted.zones.ofPoint);
    }
  }
}

TEST(Cracks, TheSameForOneTwoAndSevenThreads)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const GridOptions grid = uniformGrid({Vec3::Constant(-4.3), Vec3::Constant(4.1)}, 0.25);
    const TriangleSurface soup = atria::testing::randomSoup(seed);
    const auto wanted = FoundZones(soup, grid, 1).cracks();
    for (const int threads : {2, 7})
    {
      const auto cracks = FoundZones(soup, grid, threads).cracks();
      ASSERT_EQ(cracks.size(), wanted.size());
      for (std::size_t i = 0; i < cracks.size(); ++i)
      {
        EXPECT_EQ(cracks[i].path, wanted[i].path);
        EXPECT_EQ(cracks[i].width, wanted[i].width);
        EXPECT_EQ(cracks[i].point, wanted[i].point);
        EXPECT_EQ(cracks[i].open, wanted[i].open);
      }
    }
  }
}

} // namespace
