// SPDX-License-Identifier: GPL-3.0-or-later
/// What must hold of every repaired surface, whatever went in.
#include "Support/Campaign.h"
#include "Support/QuietContext.h"
#include "Surface/Repair/SurfaceRepair.h"

#include "Grid/GridFrame.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <random>

namespace {

using atria::between;
using atria::Index;
using atria::LatticePoint;
using atria::SurfaceRepairReport;
using atria::TriangleSoup;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::campaign;

struct Repaired
{
  TriangleSoup soup;
  SurfaceRepairReport report;
};

atria::GridFrame cube(double half)
{
  atria::GridOptions grid;
  grid.domain = {Vec3::Constant(-half), Vec3::Constant(half)};
  return makeGridFrame(grid, grid.domain);
}

TriangleSoup onLattice(const TriangleSurface& surface, const atria::GridFrame& frame)
{
  TriangleSoup soup;
  for (const Vec3& p : surface.points)
  {
    soup.points.push_back(frame.toLattice(p));
  }
  for (Index t = 0; t < surface.triangles.size(); ++t)
  {
    soup.add(surface.triangles[t], surface.surfaceIds[t], t);
  }
  return soup;
}

/// As the filters have it: 1e-5 of the finest octant.
constexpr std::int64_t usualWeld = 10737;

Repaired repair(TriangleSoup soup, const atria::GridFrame& frame, std::int64_t weldDistance = 0,
                double gapTolerance = 0.0)
{
  Repaired out;
  out.soup = std::move(soup);
  for (Index t = 0; t < out.soup.triangles.size(); ++t)
  {
    out.soup.sources[t] = t;
  }
  atria::SurfaceRepairOptions options;
  options.weldDistance = weldDistance;
  options.gapTolerance = gapTolerance;
  const atria::RunContext context = atria::testing::quietContext();
  repairSurface(out.soup, frame, options, out.report, context);
  return out;
}

double area(const TriangleSoup& soup, Index surface)
{
  double sum = 0.0;
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    const Vec3 normal =
        between(soup.corner(t, 0), soup.corner(t, 1)).cross(between(soup.corner(t, 0), soup.corner(t, 2)));
    sum += soup.surfaceIds[t] == surface ? 0.5 * normal.norm() : 0.0;
  }
  return sum;
}

double lengthOfEdges(const TriangleSoup& soup, Index surface)
{
  double length = 0.0;
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    for (int i = 0; i < 3 && soup.surfaceIds[t] == surface; ++i)
    {
      length += between(soup.corner(t, i), soup.corner(t, (i + 1) % 3)).norm();
    }
  }
  return length;
}

std::map<atria::EdgeKey, int> edgeUses(const TriangleSoup& soup)
{
  std::map<atria::EdgeKey, int> uses;
  for (const auto& t : soup.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      ++uses[atria::edgeKey(t, i)];
    }
  }
  return uses;
}

/// How deep, in lattice units, an edge of `a` reaches through the inside of `b`: its ends beyond the plane, and the
/// place where it passes from the outline.
double depthOfCut(const TriangleSoup& soup, Index a, Index b)
{
  const LatticePoint& origin = soup.corner(b, 0);
  const Vec3 n = between(origin, soup.corner(b, 1)).cross(between(origin, soup.corner(b, 2))).normalized();
  double depth = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 u = between(origin, soup.corner(a, i));
    const Vec3 v = between(origin, soup.corner(a, (i + 1) % 3));
    const double below = n.dot(u);
    const double above = n.dot(v);
    if (below * above >= 0.0)
    {
      continue;
    }
    const Vec3 x = u + below / (below - above) * (v - u);
    double cut = std::min(std::abs(below), std::abs(above));
    for (int j = 0; j < 3; ++j)
    {
      const Vec3 p = between(origin, soup.corner(b, j));
      const Vec3 q = between(origin, soup.corner(b, (j + 1) % 3));
      cut = std::min(cut, n.cross((q - p).normalized()).dot(x - p));
    }
    depth = std::max(depth, cut);
  }
  return depth;
}

double deepestCut(const TriangleSoup& soup)
{
  double deepest = 0.0;
  for (Index a = 0; a < soup.triangles.size(); ++a)
  {
    for (Index b = 0; b < soup.triangles.size(); ++b)
    {
      if (a != b)
      {
        deepest = std::max(deepest, depthOfCut(soup, a, b));
      }
    }
  }
  return deepest;
}

/// Triangles in general position.
TriangleSurface confetti(unsigned seed, int count, double size)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::uniform_real_distribution<double> offset(-size, size);
  TriangleSurface surface;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 at(place(random), place(random), place(random));
    std::vector<Vec3> points;
    for (int j = 0; j < 3; ++j)
    {
      points.push_back(at + Vec3(offset(random), offset(random), offset(random)));
    }
    atria::testing::addSurface(surface, "T" + std::to_string(i % 5), points, {{0, 1, 2}});
  }
  return surface;
}

TEST(RepairedSoups, TrianglesInGeneralPositionMeetInCommonEdgesAndKeepTheirArea)
{
  const atria::GridFrame frame = cube(8.0);
  for (int seed = 0; seed < campaign(30, 300); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TriangleSurface surface = confetti(seed, 40, 2.5);
    const TriangleSoup soup = onLattice(surface, frame);
    const Repaired out = repair(soup, frame);
    EXPECT_EQ(out.report.unresolvedContacts, 0u);
    EXPECT_LE(deepestCut(out.soup), 2.0 * 4.0);
    for (Index s = 0; s < surface.names.size(); ++s)
    {
      // A free edge is cut at a point that is rounded.
      EXPECT_NEAR(area(out.soup, s), area(soup, s), 1e-9 * area(soup, s) + lengthOfEdges(soup, s));
    }
  }
}

TEST(RepairedSoups, RandomBoxesSpheresAndSheetsMeetInCommonEdges)
{
  const atria::GridFrame frame = cube(16.0);
  for (int seed = 0; seed < campaign(60, 1000); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Repaired out = repair(onLattice(atria::testing::randomSoup(seed), frame), frame);
    EXPECT_EQ(out.report.unresolvedContacts, 0u);
    if (out.soup.triangles.size() < 2000)
    {
      EXPECT_LE(deepestCut(out.soup), 2.0 * 4.0);
    }
  }
}

/// Bushes: leaves in fans hardly larger than the gaps that are closed, which rise a little from a floor and cross it.
/// Triangles meet at small angles, and lose their width when points move.
TriangleSurface bushes(unsigned seed, int count, double size)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::uniform_real_distribution<double> part(0.2, 1.0);
  std::uniform_real_distribution<double> rise(-0.15, 0.15);
  TriangleSurface surface;
  atria::testing::addSheet(surface, "Floor", {-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
  for (int i = 0; i < count; ++i)
  {
    const Vec3 at(place(random), place(random), size * rise(random));
    std::vector<Vec3> points{at};
    std::vector<std::array<Index, 3>> leaves;
    for (Index j = 0; j < 5; ++j)
    {
      const double angle = 1.1 * j;
      points.push_back(at + size * part(random) * Vec3(std::cos(angle), std::sin(angle), rise(random)));
      if (j > 0)
      {
        leaves.push_back({0, j, j + 1});
      }
    }
    atria::testing::addSurface(surface, "Bush", points, leaves);
  }
  return surface;
}

TEST(RepairedSoups, BushesAsFineAsGapsComeToAnEnd)
{
  const atria::GridFrame frame = cube(8.0);
  const double tolerance = 0.05 * frame.finestSize / frame.latticeUnit();
  const int seeds = campaign(10, 100);
  int resolved = 0;
  for (int seed = 0; seed < seeds; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Repaired out = repair(onLattice(bushes(seed, 150, 0.3), frame), frame, usualWeld, tolerance);
    EXPECT_GT(out.report.closedGaps, 20u);
    EXPECT_LE(out.report.unresolvedContacts, 10u) << "of some ten thousand";
    resolved += out.report.unresolvedContacts == 0 ? 1 : 0;
  }
  EXPECT_GE(10 * resolved, 9 * seeds);
}

TEST(RepairedSoups, RepairingTwiceChangesNothing)
{
  const atria::GridFrame frame = cube(16.0);
  for (int seed = 0; seed < campaign(60, 1000); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Repaired once = repair(onLattice(atria::testing::randomSoup(seed), frame), frame);
    const Repaired twice = repair(once.soup, frame);
    EXPECT_EQ(twice.soup.points, once.soup.points);
    EXPECT_EQ(twice.soup.triangles, once.soup.triangles);
    EXPECT_EQ(twice.report.splitTriangles, 0u);
    EXPECT_EQ(twice.report.flippedTriangles, 0u);
  }
}

TEST(RepairedSoups, SolidsThatCutEachOtherStayClosed)
{
  const atria::GridFrame frame = cube(16.0);
  for (int seed = 0; seed < campaign(40, 400); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-2.0, 2.0);
    std::uniform_real_distribution<double> size(0.5, 3.0);
    TriangleSurface surface;
    for (int i = 0; i < 4; ++i)
    {
      const Vec3 at(place(random), place(random), place(random));
      if (i % 2 == 0)
      {
        atria::testing::addBox(surface, "B", {at, at + Vec3(size(random), size(random), size(random))});
      }
      else
      {
        atria::testing::addSphere(surface, "S", at, size(random), 2);
      }
      atria::testing::turn(surface, 7.0);
    }
    const Repaired out = repair(onLattice(surface, frame), frame);
    EXPECT_EQ(out.report.unresolvedContacts, 0u);
    for (Index s = 0; s < surface.names.size(); ++s)
    {
      std::map<atria::EdgeKey, int> uses;
      for (Index t = 0; t < out.soup.triangles.size(); ++t)
      {
        for (int i = 0; i < 3 && out.soup.surfaceIds[t] == s; ++i)
        {
          ++uses[atria::edgeKey(out.soup.triangles[t], i)];
        }
      }
      for (const auto& [edge, count] : uses)
      {
        EXPECT_EQ(count % 2, 0);
      }
    }
  }
}

TEST(RepairedSoups, AQuarterTurnMakesNoDifference)
{
  const atria::GridFrame frame = cube(16.0);
  for (int seed = 0; seed < campaign(30, 300); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TriangleSoup soup = onLattice(confetti(seed, 30, 2.5), frame);
    TriangleSoup turned = soup;
    const std::int64_t size = frame.latticeSize(0);
    for (LatticePoint& p : turned.points)
    {
      p = {size - p[1], p[0], p[2]};
    }
    const Repaired a = repair(soup, frame);
    const Repaired b = repair(turned, frame);
    EXPECT_EQ(a.soup.triangles.size(), b.soup.triangles.size());
    EXPECT_EQ(a.report.splitTriangles, b.report.splitTriangles);
    EXPECT_EQ(a.report.intersectionEdges, b.report.intersectionEdges);
    EXPECT_EQ(edgeUses(a.soup).size(), edgeUses(b.soup).size());
  }
}

TEST(RepairedSoups, SurvivesHostileInput)
{
  const atria::GridFrame frame = cube(16.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  const auto point = [&] { return Vec3(place(random), place(random), place(random)); };
  TriangleSurface star, needles, pile, coplanar;
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 a = point(), b = point(), c = point();
    const auto flat = [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.25); };
    atria::testing::addSurface(needles, "N", {a, b, a + 1e-4 * c}, {{0, 1, 2}});
    if (i < 40)
    {
      // All pass through the origin.
      atria::testing::addSurface(star, "S", {a, b, -a - b}, {{0, 1, 2}});
      atria::testing::addSurface(coplanar, "C", {flat(a), flat(b), flat(c)}, {{0, 1, 2}});
    }
  }
  const Vec3 a = point(), b = point(), c = point();
  for (int i = 0; i < 1000; ++i)
  {
    atria::testing::addSurface(pile, "P", {a, b, c}, {{0, 1, 2}});
  }
  for (const auto& [name, surface] :
       {std::pair("star", star), {"needles", needles}, {"pile", pile}, {"coplanar", coplanar}})
  {
    const Repaired out = repair(onLattice(surface, frame), frame, usualWeld);
    EXPECT_EQ(out.report.unresolvedContacts, 0u) << name;
    EXPECT_FALSE(out.soup.triangles.empty());
  }
}

} // namespace
