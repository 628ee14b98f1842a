// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the planes of walls, and how the model divides them.
#include "Surface/Openings/WallPlanes.h"

#include "Support/QuietContext.h"
#include "Surface/Openings/PlaneSection.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::quietContext;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A model of quads of two triangles. Points in one place are one.
struct Quads
{
  SurfaceModel model;
  std::map<LatticePoint, Index> known;

  Quads() { model.names = {"Wall", "Other"}; }

  Index point(const LatticePoint& p)
  {
    const auto [at, isNew] = known.try_emplace(p, static_cast<Index>(model.points.size()));
    if (isNew)
    {
      model.points.push_back(p);
    }
    return at->second;
  }

  void addTriangle(Index chart, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
  {
    model.triangles.push_back({point(a), point(b), point(c)});
    model.charts.push_back(chart);
    model.surfaceIds.push_back(0);
    model.domainSides.push_back(SurfaceModel::noSide);
  }

  /// Corners follow each other; the front is where they run counterclockwise.
  void add(Index chart, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d)
  {
    addTriangle(chart, a, b, c);
    addTriangle(chart, a, c, d);
  }

  /// Adds a square of the plane z = `height` with its front up.
  void addLevel(Index chart, std::int64_t x, std::int64_t y, std::int64_t size, std::int64_t height)
  {
    add(chart, {x, y, height}, {x + size, y, height}, {x + size, y + size, height}, {x, y + size, height});
  }

  void setSurface(std::size_t first, Index surface)
  {
    std::fill(model.surfaceIds.begin() + static_cast<std::ptrdiff_t>(first), model.surfaceIds.end(), surface);
  }
};

// Planes.

void expectSound(const SurfaceModel& model, const std::vector<WallPlane>& planes, double distance)
{
  std::set<Index> seen;
  for (const WallPlane& plane : planes)
  {
    Box3 bounds;
    double area = 0.0;
    EXPECT_TRUE(std::ranges::is_sorted(plane.triangles));
    for (const Index t : plane.triangles)
    {
      EXPECT_TRUE(seen.insert(t).second) << "each triangle is in one plane";
      area += 0.5 * model.normal(t).norm();
      for (int i = 0; i < 3; ++i)
      {
        bounds.extend(toVector(model.corner(t, i)));
        EXPECT_LE(std::abs(plane.heightOf(toVector(model.corner(t, i)))), distance);
      }
    }
    EXPECT_NEAR(plane.area, area, 1e-9 * area);
    EXPECT_EQ(plane.bounds.min, bounds.min);
    EXPECT_EQ(plane.bounds.max, bounds.max);
    EXPECT_LT((plane.u.cross(plane.v) - plane.normal).norm(), 1e-12);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR(plane.u.norm(), 1.0, 1e-12);
  }
}

TEST(WallPlanes, HoldAllChartsInOnePlaneWhicheverWayTheyFace)
{
  Quads quads;
  quads.addLevel(4, 0, 0, 100, 50);
  quads.addLevel(1, 0, 500, 300, 50);
  quads.addLevel(0, 0, 0, 200, 90);                                             // another plane
  quads.add(2, {900, 0, 50}, {900, 50, 50}, {950, 50, 50}, {950, 0, 50});       // faces down
  quads.add(3, {0, -50, 0}, {200, -50, 0}, {200, -50, 200}, {0, -50, 200});     // stands upright
  quads.add(5, {0, -50, 300}, {0, -50, 500}, {100, -50, 500}, {100, -50, 300}); // faces the other way
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
  expectSound(quads.model, planes, 10.0);
  ASSERT_EQ(planes.size(), 3u);
  EXPECT_THAT(planes[0].triangles, ElementsAre(0, 1, 2, 3, 6, 7)) << "it has the largest triangle";
  EXPECT_EQ(planes[0].normal, Vec3::UnitZ());
  EXPECT_EQ(planes[0].area, 10000.0 + 90000.0 + 2500.0);
  EXPECT_THAT(planes[1].triangles, ElementsAre(4, 5)) << "the first of equal ones has the lower chart";
  EXPECT_THAT(planes[2].triangles, ElementsAre(8, 9, 10, 11));
  EXPECT_EQ(planes[2].normal, -Vec3::UnitY());
}

TEST(WallPlanes, HoldChartsWithinTheDistance)
{
  for (const std::int64_t offset : {-11, -10, 10, 11})
  {
    Quads quads;
    quads.addLevel(0, 0, 0, 1000, 0);
    quads.addLevel(1, 2000, 0, 100, offset);
    const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
    expectSound(quads.model, planes, 10.0);
    EXPECT_EQ(planes.size(), std::abs(offset) <= 10 ? 1u : 2u) << offset;
  }
}

/// Moves the coordinates of all points up by one axis, `turns` times.
void turnAxes(SurfaceModel& model, int turns)
{
  for (LatticePoint& p : model.points)
  {
    std::rotate(p.begin(), p.begin() + turns, p.end());
  }
}

TEST(WallPlanes, HoldChartsThatAreTurnedALittle)
{
  for (const std::int64_t rise : {0, 4, 9, 10, 11, 40})
  {
    for (int round = 0; round < 12; ++round)
    {
      Quads quads;
      quads.addLevel(0, 0, 0, 6000, 0);
      std::array<LatticePoint, 4> q{{{0, 0, 0}, {4000, 0, rise}, {4000, 100, rise}, {0, 100, 0}}};
      std::ranges::for_each(q, [&](LatticePoint& p) { round % 2 == 0 ? void() : std::swap(p[0], p[1]); });
      round / 2 % 2 == 0 ? quads.add(1, q[3], q[2], q[1], q[0]) : quads.add(1, q[0], q[1], q[2], q[3]);
      turnAxes(quads.model, round / 4);
      const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
      expectSound(quads.model, planes, 10.0);
      EXPECT_EQ(planes.size(), rise <= 10 ? 1u : 2u) << rise << ' ' << round;
    }
  }
}

TEST(WallPlanes, HoldAChartBetweenTwoOfThemInThatOfTheLargerTriangle)
{
  Quads quads;
  quads.addLevel(0, 3000, 0, 100, 8);
  quads.addLevel(1, 2000, 0, 500, 15);
  quads.addLevel(2, 0, 0, 1000, 0);
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_THAT(planes[0].triangles, ElementsAre(0, 1, 4, 5));
}

TEST(WallPlanes, HoldNoChartsThatAreNotPlane)
{
  for (const std::int64_t height : {0, 10, 11, 500})
  {
    Quads quads;
    quads.add(7, {0, 0, 0}, {2000, 0, 0}, {2000, 2000, 0}, {1000, 1500, height});
    const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
    EXPECT_EQ(planes.size(), height <= 10 ? 1u : 0u) << height;
  }
}

TEST(WallPlanes, HoldNoSidesOfTheDomain)
{
  Quads quads;
  quads.addLevel(0, 0, 0, 100, 0);
  quads.addLevel(1, 200, 0, 100, 0);
  quads.addLevel(2, 400, 0, 100, 0);
  quads.model.domainSides[1] = zMin;
  quads.model.surfaceIds[3] = 2; // beyond the names: a side of a turned domain
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 1.0);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_THAT(planes[0].triangles, ElementsAre(0, 2, 4, 5));
  EXPECT_THAT(findWallPlanes(SurfaceModel{}, 1.0), IsEmpty());
}

TEST(WallPlanes, LieInTheLargestTriangle)
{
  Quads quads;
  quads.addTriangle(0, {0, 0, 5}, {100, 0, 0}, {0, 100, 0});
  quads.addTriangle(0, {100, 0, 0}, {2000, 2000, 0}, {0, 100, 0});
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_EQ(planes[0].normal, Vec3::UnitZ());
  EXPECT_EQ(planes[0].origin[2], 0.0);
}

TEST(WallPlanes, HavePlacesOfTheirOwn)
{
  Quads quads;
  quads.add(0, {10, 20, 30}, {110, 20, 80}, {110, 140, 110}, {10, 140, 60});
  const WallPlane plane = findWallPlanes(quads.model, 10.0).at(0);
  for (const Vec3& p : {Vec3(10, 20, 30), Vec3(110, 140, 110), Vec3(60, 80, 70)})
  {
    EXPECT_NEAR(plane.heightOf(p), 0.0, 1e-9);
    EXPECT_LT((plane.pointAt(plane.placeOf(p)) - p).norm(), 1e-9);
    EXPECT_NEAR(plane.heightOf(p + 3.0 * plane.normal), 3.0, 1e-9);
    EXPECT_LT((plane.placeOf(p + 3.0 * plane.normal) - plane.placeOf(p)).norm(), 1e-9);
  }
  const auto& t = quads.model.triangles[0];
  const auto place = [&](Index p) { return plane.placeOf(toVector(quads.model.points[p])); };
  const Vec2 along = place(t[1]) - place(t[0]);
  const Vec2 on = place(t[2]) - place(t[0]);
  EXPECT_NEAR(along[0] * on[1] - along[1] * on[0], quads.model.normal(0).norm(), 1e-6) << "counterclockwise";
}

// Sections.

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
