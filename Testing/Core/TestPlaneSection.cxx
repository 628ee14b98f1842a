// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how a model divides the planes of its walls.
#include "Support/QuietContext.h"
#include "Surface/Openings/PlaneSection.h"
#include "Surface/Openings/WallPlanes.h"
#include "WallQuads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Quads;
using atria::testing::quietContext;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

GridFrame frameOf(const LatticePoint& low, const LatticePoint& high)
{
  GridFrame frame;
  frame.domainLow = low;
  frame.domainHigh = high;
  return frame;
}

const GridFrame wide = frameOf({-5000, -5000, -5000}, {5000, 5000, 5000});

/// Returns the plane of the first triangle.
WallPlane firstPlane(const SurfaceModel& model)
{
  const std::vector<WallPlane> planes = findWallPlanes(model, 2.0);
  const auto at = std::ranges::find_if(planes, [](const WallPlane& plane) { return plane.triangles.front() == 0; });
  return *at;
}

PlaneSection sectionOf(const SurfaceModel& model, const GridFrame& frame = wide, bool sidesAreWalls = false,
                       const std::vector<EdgeKey>& lines = {})
{
  constexpr double distance = 2.0;
  const SectionSource source(model, frame, sidesAreWalls, distance, quietContext());
  return sectionAt(firstPlane(model), lines, source);
}

/// Areas of the regions but the outside: those that are covered, and those that are not.
std::array<std::vector<double>, 2> areasOf(const PlaneSection& section)
{
  const PlanarTriangulation& plane = section.parted;
  std::vector<double> areas(plane.regionCount, 0.0);
  for (std::size_t t = 0; t < plane.triangles.size(); ++t)
  {
    const auto& [a, b, c] = plane.triangles[t];
    const Vec2 u = plane.points[b] - plane.points[a];
    const Vec2 v = plane.points[c] - plane.points[a];
    areas[plane.regions[t]] += 0.5 * (u[0] * v[1] - u[1] * v[0]);
  }
  std::array<std::vector<double>, 2> sorted;
  EXPECT_EQ(section.covered.size(), areas.size());
  for (std::size_t region = 1; region < areas.size(); ++region)
  {
    sorted.at(section.covered[region] ? 0 : 1).push_back(std::round(areas[region]));
  }
  std::ranges::for_each(sorted, [](std::vector<double>& list) { std::ranges::sort(list); });
  return sorted;
}

double lengthOf(const std::vector<WallEnd>& ends)
{
  double sum = 0.0;
  std::ranges::for_each(ends, [&](const WallEnd& end) { sum += (end.to - end.from).norm(); });
  return sum;
}

/// Squares of 100 in rows; true where there is one. They lie in z = 50 with their fronts up.
Quads levelWall(const std::vector<std::vector<bool>>& rows)
{
  Quads quads;
  for (std::size_t y = 0; y < rows.size(); ++y)
  {
    for (std::size_t x = 0; x < rows[y].size(); ++x)
    {
      if (rows[y][x])
      {
        quads.addLevel(0, 100 * static_cast<std::int64_t>(x), 100 * static_cast<std::int64_t>(y), 100, 50);
      }
    }
  }
  return quads;
}

/// The same, upright in y = 0 from z = 0 on.
Quads uprightWall(const std::vector<std::vector<bool>>& rows)
{
  Quads level = levelWall(rows);
  for (LatticePoint& p : level.model.points)
  {
    p = {p[0], 0, p[1]};
  }
  return level;
}

const std::vector<std::vector<bool>> withWindow{{true, true, true}, {true, false, true}, {true, true, true}};
const std::vector<std::vector<bool>> withNotch{{true, true, true}, {true, true, false}, {true, true, true}};
const std::vector<std::vector<bool>> withDoor{{true, false, true}, {true, true, true}};

TEST(PlaneSection, HasAHoleAsARegionThatNothingCovers)
{
  const Quads quads = levelWall(withWindow);
  const PlaneSection section = sectionOf(quads.model);
  const auto [covered, open] = areasOf(section);
  EXPECT_THAT(covered, ElementsAre(80000.0));
  EXPECT_THAT(open, ElementsAre(10000.0));
  EXPECT_EQ(section.covered[0], 0);
  EXPECT_EQ(section.ends.size(), 12u + 4u);
  EXPECT_NEAR(lengthOf(section.ends), 1200.0 + 400.0, 1e-9);
}

TEST(PlaneSection, KnowsTheLatticePointsOfItsPlaces)
{
  Quads quads = levelWall(withWindow);
  quads.add(1, {150, 0, 0}, {150, 300, 0}, {150, 300, 130}, {150, 0, 130}); // passes through between points
  const WallPlane plane = firstPlane(quads.model);
  const SectionSource source(quads.model, wide, false, 2.0, quietContext());
  const PlaneSection section = sectionAt(plane, {}, source);
  ASSERT_GE(section.corners.size(), 16u);
  ASSERT_LE(section.corners.size(), section.parted.points.size());
  for (std::size_t i = 0; i < section.corners.size(); ++i)
  {
    EXPECT_LT((plane.pointAt(section.parted.points[i]) - toVector(section.corners[i])).norm(), 1.0);
  }
  EXPECT_THAT(section.corners, ::testing::Contains(LatticePoint{150, 300, 50}));
}

TEST(PlaneSection, HasEndsAtEdgesInTheSenseOfTheirTriangles)
{
  const Quads quads = levelWall({{true}});
  const WallPlane plane = firstPlane(quads.model);
  const PlaneSection section = sectionOf(quads.model);
  ASSERT_EQ(section.ends.size(), 4u);
  for (const WallEnd& end : section.ends)
  {
    const auto& t = quads.model.triangles[end.triangle];
    bool isEdge = false;
    for (int i = 0; i < 3; ++i)
    {
      const auto place = [&](int corner) { return plane.placeOf(toVector(quads.model.corner(end.triangle, corner))); };
      isEdge = isEdge || (place(i) == end.from && place((i + 1) % 3) == end.to);
    }
    EXPECT_TRUE(isEdge) << t[0];
    EXPECT_THAT(end.reveals, IsEmpty());
  }
}

TEST(PlaneSection, LeavesANotchOpenUnlessAWallPassesThroughThePlaneThere)
{
  struct Case
  {
    std::int64_t x;
    std::int64_t low;
    std::int64_t high;
    bool isClosed;
  };
  for (const Case& test : {Case{300, 0, 100, true},
                           {300, 50, 100, true},
                           {300, 0, 50, true},
                           {300, 52, 100, true},
                           {300, 53, 100, false},
                           {300, 0, 47, false},
                           {304, 0, 100, false}})
  {
    Quads quads = levelWall(withNotch);
    EXPECT_THAT(areasOf(sectionOf(quads.model))[1], IsEmpty());
    quads.add(1, {test.x, 100, test.low}, {test.x, 200, test.low}, {test.x, 200, test.high}, {test.x, 100, test.high});
    const auto [covered, open] = areasOf(sectionOf(quads.model));
    EXPECT_EQ(open, test.isClosed ? std::vector<double>{10000.0} : std::vector<double>{}) << test.x << ' ' << test.low;
    EXPECT_THAT(covered, ElementsAre(80000.0));
  }
}

TEST(PlaneSection, IsDividedByEachEdgeOfATriangleInThePlane)
{
  for (int turn = 0; turn < 3; ++turn)
  {
    Quads quads = levelWall(withNotch);
    std::array<LatticePoint, 3> corners{{{300, 100, 50}, {400, 150, 50}, {300, 200, 50}}};
    std::rotate(corners.begin(), corners.begin() + turn, corners.end());
    quads.addTriangle(1, corners[0], corners[1], corners[2]);
    quads.model.domainSides.back() = zMin; // it is of no plane
    EXPECT_THAT(areasOf(sectionOf(quads.model))[1], ElementsAre(5000.0, 10000.0)) << turn;
  }
}

TEST(PlaneSection, IsDividedByWallsOnly)
{
  for (const SurfaceKind kind : {SurfaceKind::wall, SurfaceKind::faceZone, SurfaceKind::cellZone})
  {
    Quads quads = levelWall(withNotch);
    const std::size_t first = quads.model.triangles.size();
    quads.add(1, {300, 100, 0}, {300, 200, 0}, {300, 200, 100}, {300, 100, 100});
    quads.setSurface(first, 1);
    quads.model.kinds = {SurfaceKind::wall, kind};
    EXPECT_EQ(areasOf(sectionOf(quads.model))[1].size(), kind == SurfaceKind::wall ? 1u : 0u);
  }
}

TEST(PlaneSection, IsDividedByGivenLines)
{
  Quads quads = levelWall(withNotch);
  const EdgeKey line = edgeKey(quads.point({300, 100, 50}), quads.point({300, 200, 50}));
  EXPECT_THAT(areasOf(sectionOf(quads.model, wide, false, {line}))[1], ElementsAre(10000.0));
}

TEST(PlaneSection, HasADoorDownToTheBottomOfTheDomain)
{
  const Quads quads = uprightWall(withDoor);
  for (const std::int64_t ground : {0, -1, 20})
  {
    const PlaneSection section = sectionOf(quads.model, frameOf({-5000, -5000, ground}, {5000, 5000, 5000}));
    const std::vector<double> open = areasOf(section)[1];
    ASSERT_FALSE(ground >= 0 && open.empty());
    if (ground >= 0)
    {
      EXPECT_THAT(open, ::testing::Contains(100.0 * static_cast<double>(100 - ground))) << ground;
    }
    else
    {
      EXPECT_THAT(open, IsEmpty()) << "the door ends above the ground";
    }
  }
}

TEST(PlaneSection, EndsAtAllSidesOfTheDomainIfTheyAreWalls)
{
  // A wall with an opening at its left, right or upper side.
  const std::vector<std::vector<std::vector<bool>>> walls{{{true, true}, {false, true}, {true, true}},
                                                          {{true, true}, {true, false}, {true, true}},
                                                          {{true, true, true}, {true, false, true}}};
  const std::vector<std::pair<LatticePoint, LatticePoint>> domains{{{0, -5000, -5000}, {5000, 5000, 5000}},
                                                                   {{-5000, -5000, -5000}, {200, 5000, 5000}},
                                                                   {{-5000, -5000, -5000}, {5000, 5000, 200}}};
  for (std::size_t i = 0; i < walls.size(); ++i)
  {
    const Quads quads = uprightWall(walls[i]);
    const GridFrame frame = frameOf(domains[i].first, domains[i].second);
    EXPECT_THAT(areasOf(sectionOf(quads.model, frame, false))[1], IsEmpty()) << i;
    const std::vector<double> open = areasOf(sectionOf(quads.model, frame, true))[1];
    EXPECT_THAT(open, ::testing::Contains(10000.0)) << i;
    EXPECT_THAT(areasOf(sectionOf(quads.model, wide, true))[1], ::testing::Not(::testing::Contains(10000.0))) << i;
  }
}

TEST(PlaneSection, EndsWhereTheWallGoesBackButNotWhereItGoesOn)
{
  // Each side of a square goes on into another one: back, forward, in the plane, and back by less than the distance.
  for (const bool isTurned : {false, true})
  {
    Quads quads = levelWall({{true}});
    const std::int64_t back = isTurned ? 150 : -50;
    const std::int64_t forward = isTurned ? -50 : 150;
    quads.add(3, {0, 0, 50}, {0, 0, back}, {100, 0, back}, {100, 0, 50});
    quads.add(4, {100, 0, 50}, {100, 0, forward}, {100, 100, forward}, {100, 100, 50});
    quads.add(5, {0, 100, 50}, {100, 100, 50}, {100, 100, 51}, {0, 100, 51});
    if (isTurned)
    {
      std::swap(quads.model.triangles[0][1], quads.model.triangles[0][2]);
      std::swap(quads.model.triangles[1][1], quads.model.triangles[1][2]);
    }
    const SectionSource source(quads.model, wide, false, 2.0, quietContext());
    const WallPlane plane = firstPlane(levelWall({{true}}).model);
    const PlaneSection section = sectionAt(plane, {}, source);
    std::set<std::vector<Index>> reveals;
    std::ranges::for_each(section.ends, [&](const WallEnd& end) { reveals.insert(end.reveals); });
    EXPECT_EQ(section.ends.size(), 2u) << "the front edge, and the left one";
    EXPECT_EQ(reveals, (std::set<std::vector<Index>>{{}, {3}}));
  }
}

TEST(PlaneSection, HasNoEndsAtZones)
{
  Quads quads = levelWall({{true}});
  quads.addLevel(1, 500, 0, 100, 50);
  quads.setSurface(2, 1);
  quads.model.kinds = {SurfaceKind::wall, SurfaceKind::faceZone};
  const PlaneSection section = sectionOf(quads.model);
  EXPECT_EQ(section.ends.size(), 4u);
  EXPECT_TRUE(std::ranges::all_of(section.ends, [](const WallEnd& end) { return end.triangle < 2; }));
}

TEST(PlaneSection, IsEmptyWithoutEnds)
{
  // The four sides go forward.
  Quads quads;
  quads.addLevel(0, 0, 0, 100, 50);
  const std::array<LatticePoint, 4> corners{{{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}}};
  for (std::size_t i = 0; i < 4; ++i)
  {
    const LatticePoint& a = corners.at(i);
    const LatticePoint& b = corners.at((i + 1) % 4);
    quads.add(static_cast<Index>(i + 1), {a[0], a[1], 50}, {a[0], a[1], 90}, {b[0], b[1], 90}, {b[0], b[1], 50});
  }
  const PlaneSection section = sectionOf(quads.model);
  EXPECT_THAT(section.ends, IsEmpty());
  EXPECT_THAT(section.parted.triangles, IsEmpty());
  EXPECT_THAT(section.covered, IsEmpty());
}

TEST(PlaneSection, IsDividedWhereAWallStandsOnAnEdge)
{
  Quads quads = levelWall({{true, true, true}});
  EXPECT_THAT(areasOf(sectionOf(quads.model))[0], ElementsAre(30000.0));
  quads.add(1, {100, 0, 50}, {100, 100, 50}, {100, 100, 900}, {100, 0, 900});
  EXPECT_THAT(areasOf(sectionOf(quads.model))[0], ElementsAre(10000.0, 20000.0));
}

TEST(SectionSource, KnowsTheUsesOfEachEdge)
{
  Quads quads = levelWall(withWindow);
  quads.add(1, {100, 0, 50}, {100, 100, 50}, {100, 100, 900}, {100, 0, 900});
  const SectionSource source(quads.model, wide, false, 2.0, quietContext());
  for (Index t = 0; t < quads.model.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const EdgeKey edge = edgeKey(quads.model.triangles[t], i);
      std::vector<Index> expected;
      for (Index other = 0; other < quads.model.triangles.size(); ++other)
      {
        const auto& corners = quads.model.triangles[other];
        if (contains(corners, edge.first) && contains(corners, edge.second))
        {
          expected.push_back(other);
        }
      }
      const auto uses = source.usesOf[t].at(static_cast<std::size_t>(i));
      EXPECT_TRUE(std::ranges::equal(uses, expected, {}, &SoupEdgeUse::triangle));
    }
  }
}

TEST(SectionSource, SearchesWallsOnly)
{
  Quads quads = levelWall({{true, true, true}});
  quads.model.surfaceIds = {0, 0, 1, 1, 2, 0};
  quads.model.kinds = {SurfaceKind::wall, SurfaceKind::faceZone};
  const SectionSource source(quads.model, wide, false, 2.0, quietContext());
  std::set<Index> ids;
  for (std::size_t place = 0; place < source.triangles.size(); ++place)
  {
    ids.insert(source.triangles.box(place).id);
  }
  EXPECT_THAT(ids, ElementsAre(0, 1, 5));
}

} // namespace
