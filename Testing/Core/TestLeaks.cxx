// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones, and ways out of those that should be closed.
#include "FoundZones.h"

#include "Support/Error.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addPierced;
using atria::testing::addRoom;
using atria::testing::addSheet;
using atria::testing::FoundZones;
using atria::testing::turned;
using atria::testing::uniformGrid;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

const Box3 domain{Vec3(-6, -6, 0), Vec3(6, 6, 7)};
constexpr double size = 0.5;
const Box3 roomBox{Vec3(-2.2, -1.9, 1.1), Vec3(1.8, 2.3, 4.2)};
const Vec3 inRoom(-0.4, 0.3, 2.4);

/// A room with a hole in its east wall, turned about the vertical.
struct Room
{
  std::array<double, 2> low;
  std::array<double, 2> high;
  double degrees = 0.0;

  TriangleSurface surface() const
  {
    TriangleSurface out;
    addRoom(out, "", roomBox, low, high);
    atria::testing::turn(out, degrees);
    return out;
  }

  /// A point of the hole by its parts s, t in [0, 1].
  Vec3 inHole(double s, double t) const
  {
    const Vec3 corner(roomBox.max[0], roomBox.min[1], roomBox.min[2]);
    return turned(corner + Vec3(0, low[0] + s * (high[0] - low[0]), low[1] + t * (high[1] - low[1])), degrees);
  }

  /// Whether a segment passes through the hole.
  bool isPassedBy(const Vec3& p, const Vec3& q) const
  {
    const Vec3 u = inHole(1, 0) - inHole(0, 0);
    const Vec3 v = inHole(0, 1) - inHole(0, 0);
    const Vec3 n = u.cross(v);
    const double before = n.dot(p - inHole(0, 0));
    const double after = n.dot(q - inHole(0, 0));
    if (before * after > 0.0 || before == after)
    {
      return false;
    }
    const Vec3 x = p + before / (before - after) * (q - p) - inHole(0, 0);
    const double s = x.dot(u) / u.squaredNorm();
    const double t = x.dot(v) / v.squaredNorm();
    return s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0;
  }

  double distanceTo(const Vec3& p) const
  {
    double least = 1e9;
    for (double s = 0.0; s <= 1.0; s += 0.05)
    {
      for (double t = 0.0; t <= 1.0; t += 0.05)
      {
        least = std::min(least, (inHole(s, t) - p).norm());
      }
    }
    return least;
  }
};

/// Whether an edge of the grid passes through the hole: the grid is uniform, so its lines are known.
bool gridPasses(const Room& room, const GridFrame& frame)
{
  Box3 box;
  for (const double s : {0.0, 1.0})
  {
    box.extend(room.inHole(s, 0));
    box.extend(room.inHole(s, 1));
  }
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = static_cast<int>(std::floor((box.min[axis] - frame.origin[axis]) / size)) - 1;
    last[axis] = static_cast<int>(std::ceil((box.max[axis] - frame.origin[axis]) / size)) + 1;
  }
  for (int i = first[0]; i <= last[0]; ++i)
  {
    for (int j = first[1]; j <= last[1]; ++j)
    {
      for (int k = first[2]; k <= last[2]; ++k)
      {
        const Vec3 p = frame.origin + size * Vec3(i, j, k);
        for (int axis = 0; axis < 3; ++axis)
        {
          if (room.isPassedBy(p, p + size * Vec3::Unit(axis)))
          {
            return true;
          }
        }
      }
    }
  }
  return false;
}

/// The way is one: from the seed's point over uncut edges to an open side.
void expectWay(const Leak& leak, const FoundZones& found, const Vec3& seed)
{
  ASSERT_FALSE(leak.points.empty());
  EXPECT_EQ(leak.points.front(), pointOfSeed(seed, "seed", found.grid, found.model));
  for (std::size_t i = 0; i + 1 < leak.points.size(); ++i)
  {
    const auto& neighbors = found.crossings.neighbors[leak.points[i]];
    EXPECT_THAT(neighbors, ::testing::Contains(static_cast<std::int32_t>(leak.points[i + 1])));
    EXPECT_EQ(leak.path[i], found.position(leak.points[i]));
  }
  const std::int32_t code = found.crossings.neighbors[leak.points.back()][leak.direction];
  ASSERT_TRUE(DualMesh::isBoundary(code));
  const BoundaryFace& exit = found.crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)];
  EXPECT_TRUE(exit.onDomainSide);
  EXPECT_EQ(exit.tag, found.model.names.size() + leak.side);
  ASSERT_EQ(leak.path.size(), leak.points.size() + 1);
  EXPECT_EQ(leak.path.back()[axisOf(leak.side)], found.octree.frame().planeOf(leak.side));
  EXPECT_EQ(std::set<Index>(leak.points.begin(), leak.points.end()).size(), leak.points.size()) << "no point twice";
}

TEST(Leaks, ARoomLeaksJustWhereAnEdgeOfTheGridPassesThroughItsHoleAndTheWayGoesThroughIt)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.3, 1.6);
  std::uniform_real_distribution<double> length(0.1, 1.1);
  int open = 0, closed = 0;
  for (int i = 0; i < 60; ++i)
  {
    SCOPED_TRACE(i);
    Room room;
    room.low = {place(random), place(random)};
    room.high = {room.low[0] + length(random), room.low[1] + length(random)};
    room.degrees = i % 3 == 0 ? 0.0 : (i % 3 == 1 ? 17.0 : 41.0);
    FoundZones found(room.surface(), uniformGrid(domain, size));
    const Vec3 seed = turned(inRoom, room.degrees);
    const bool passes = gridPasses(room, found.octree.frame());
    const auto leaks = found.leaks({seed});
    ASSERT_EQ(leaks.size(), passes ? 1u : 0u);
    ASSERT_EQ(found.zoneAt(seed) == found.zoneAt(Vec3(5, 5, 6)), passes);
    ++(passes ? open : closed);
    if (!passes)
    {
      continue;
    }
    const Leak& leak = leaks.front();
    expectWay(leak, found, seed);
    int through = 0;
    for (std::size_t p = 0; p + 1 < leak.path.size(); ++p)
    {
      through += room.isPassedBy(leak.path[p], leak.path[p + 1]) ? 1 : 0;
    }
    EXPECT_EQ(through % 2, 1);
    EXPECT_LT(room.distanceTo(leak.place), 0.1 * size) << leak.place.transpose();
    const double narrow = std::min(room.high[0] - room.low[0], room.high[1] - room.low[1]);
    EXPECT_NEAR(leak.width, narrow, 0.02 * size);
    ASSERT_EQ(leak.surfaces.size(), 1u);
    EXPECT_EQ(found.model.names[leak.surfaces.front()], "East");
  }
  EXPECT_GT(open, 10);
  EXPECT_GT(closed, 10);
}

TEST(Leaks, TheWayGoesThroughTheWiderOfTwoHolesAlsoFromASeedAtAWall)
{
  TriangleSurface surface;
  const Vec3 s = roomBox.size();
  const Vec3 x(s[0], 0, 0), y(0, s[1], 0), z(0, 0, s[2]);
  addPierced(surface, "West", roomBox.min, y, z, {0.3, 0.3}, {0.5, 0.6});
  addPierced(surface, "East", roomBox.min + x, y, z, {0.2, 0.2}, {0.7, 0.8});
  addSheet(surface, "South", roomBox.min, x, z);
  addSheet(surface, "North", roomBox.min + y, x, z);
  addSheet(surface, "Floor", roomBox.min, x, y);
  addSheet(surface, "Roof", roomBox.min + z, x, y);
  FoundZones found(surface, uniformGrid(domain, 0.25));
  for (const Vec3& seed : {inRoom, Vec3(roomBox.min + Vec3(0.2, 0.2, 0.2)), Vec3(-1.9, 2.1, 1.3)})
  {
    SCOPED_TRACE(seed.transpose());
    const auto leaks = found.leaks({seed});
    ASSERT_EQ(leaks.size(), 1u);
    expectWay(leaks[0], found, seed);
    EXPECT_NEAR(leaks[0].place[0], roomBox.max[0], 0.01);
    EXPECT_NEAR(leaks[0].width, 0.6 * s[2], 0.02);
  }
}

TEST(Leaks, OfTwoRoomsInARowTheNarrowestPlaceIsTheSmallerHole)
{
  for (const bool innerIsSmaller : {true, false})
  {
    TriangleSurface surface;
    const std::array<double, 2> low{1.0, 0.8};
    const double inner = innerIsSmaller ? 0.7 : 1.5;
    const double outer = innerIsSmaller ? 1.5 : 0.7;
    // The inner room's east wall is the outer room's west wall.
    const Box3 first{Vec3(-4.1, -1.6, 1.1), Vec3(-0.7, 2.1, 4.2)};
    const Vec3 y(0, 3.7, 0), z(0, 0, 3.1), x(3.3, 0, 0);
    addRoom(surface, "Inner", first, low, {low[0] + inner, low[1] + inner});
    const Vec3 corner(-0.7, -1.6, 1.1);
    addSheet(surface, "South", corner, x, z);
    addSheet(surface, "North", corner + y, x, z);
    addSheet(surface, "Floor", corner, x, y);
    addSheet(surface, "Roof", corner + z, x, y);
    addPierced(surface, "OuterEast", corner + x, y, z, {low[0] / 3.7, low[1] / 3.1},
               {(low[0] + outer) / 3.7, (low[1] + outer) / 3.1});
    FoundZones found(surface, uniformGrid(domain, 0.25));
    const Vec3 seed(-2.5, 0.2, 2.5);
    const auto leaks = found.leaks({seed, Vec3(1.0, 0.2, 2.5)});
    ASSERT_EQ(leaks.size(), 2u) << "each room is told";
    expectWay(leaks[0], found, seed);
    EXPECT_NEAR(leaks[0].place[0], innerIsSmaller ? -0.7 : 2.6, 0.01);
    EXPECT_NEAR(leaks[0].width, 0.7, 0.01);
    EXPECT_EQ(found.model.names[leaks[0].surfaces.at(0)], innerIsSmaller ? "InnerEast" : "OuterEast");
    EXPECT_NEAR(leaks[1].width, outer, 0.01);
    EXPECT_EQ(leaks[1].index, 1u);
  }
}

TEST(Leaks, AGapOverTheBareGroundIsBesideTheGround)
{
  TriangleSurface surface;
  const Vec3 x(4, 0, 0), y(0, 4, 0), z(0, 0, 3);
  const Vec3 corner(-2.1, -1.9, 0);
  addSheet(surface, "West", corner, y, z);
  addSheet(surface, "South", corner, x, z);
  addSheet(surface, "North", corner + y, x, z);
  addSheet(surface, "Roof", corner + z, x, y);
  addSheet(surface, "East", corner + x + Vec3(0, 0, 0.6), y, z - Vec3(0, 0, 0.6));
  FoundZones found(surface, uniformGrid(domain, 0.25));
  const Vec3 seed(0, 0, 1.5);
  const auto leaks = found.leaks({seed});
  ASSERT_EQ(leaks.size(), 1u);
  EXPECT_NEAR(leaks[0].width, 0.6, 0.01);
  EXPECT_NEAR(leaks[0].place[2], 0.3, 0.01);
  std::vector<std::string> names;
  for (const Index surface_ : leaks[0].surfaces)
  {
    names.push_back(surface_ == noIndex ? "bottom" : found.model.names[surface_]);
  }
  EXPECT_THAT(names, UnorderedElementsAre("East", "bottom"));
}

TEST(Leaks, ThroughAThickWallTheNarrowestPlaceIsInTheReveal)
{
  for (const double degrees : {0.0, 23.0, 45.0})
  {
    SCOPED_TRACE(degrees);
    const std::array<double, 2> low{1.1, 0.9};
    const std::array<double, 2> high{2.0, 2.1};
    const double depth = 0.6;
    TriangleSurface surface;
    addRoom(surface, "", roomBox, low, high);
    const Vec3 corner(roomBox.max[0], roomBox.min[1] + low[0], roomBox.min[2] + low[1]);
    const Vec3 x(depth, 0, 0), y(0, high[0] - low[0], 0), z(0, 0, high[1] - low[1]);
    addSheet(surface, "Sill", corner, x, y);
    addSheet(surface, "Lintel", corner + z, x, y);
    addSheet(surface, "Left", corner, x, z);
    addSheet(surface, "Right", corner + y, x, z);
    atria::testing::turn(surface, degrees);
    FoundZones found(surface, uniformGrid(domain, 0.25));
    const Vec3 seed = turned(inRoom, degrees);
    const auto leaks = found.leaks({seed});
    ASSERT_EQ(leaks.size(), 1u);
    expectWay(leaks[0], found, seed);
    EXPECT_NEAR(leaks[0].width, 0.9, 0.02);
    const Vec3 place = turned(leaks[0].place, -degrees);
    EXPECT_GT(place[0], corner[0] - 0.05);
    EXPECT_LT(place[0], corner[0] + depth + 0.05);
    EXPECT_NEAR(place[1], corner[1] + 0.45, 0.02);
    EXPECT_GT(place[2], corner[2]);
    EXPECT_LT(place[2], corner[2] + z[2]);
  }
}

TEST(Leaks, ClosedRoomsDoNotLeakAndTheBottomIsNoWayOut)
{
  TriangleSurface surface;
  addBox(surface, "Room", roomBox);
  addBox(surface, "OnGround", {Vec3(2.5, -5, 0), Vec3(5.1, -2.2, 2.4)});
  FoundZones found(surface, uniformGrid(domain, size));
  EXPECT_TRUE(found.leaks({inRoom, Vec3(4, -3, 1)}).empty());
  TriangleSurface tent; // open below
  const Vec3 x(3, 0, 0), y(0, 3, 0), z(0, 0, 2);
  addSheet(tent, "Roof", z, x, y);
  addSheet(tent, "South", Vec3(0, 0, 0), x, z);
  addSheet(tent, "North", y, x, z);
  addSheet(tent, "West", Vec3(0, 0, 0), y, z);
  addSheet(tent, "East", x, y, z);
  FoundZones standing(tent, uniformGrid(domain, size));
  EXPECT_TRUE(standing.leaks({Vec3(1.5, 1.5, 1)}).empty());
}

TEST(Leaks, TheSameForOneTwoAndSevenThreads)
{
  const Room room{{0.9, 0.8}, {1.9, 2.0}, 17.0};
  const GridOptions grid = uniformGrid(domain, 0.2);
  const Vec3 seed = turned(inRoom, 17.0);
  const auto wanted = FoundZones(room.surface(), grid, 1).leaks({seed});
  ASSERT_EQ(wanted.size(), 1u);
  for (const int threads : {2, 7})
  {
    const auto leaks = FoundZones(room.surface(), grid, threads).leaks({seed});
    ASSERT_EQ(leaks.size(), 1u);
    EXPECT_EQ(leaks[0].points, wanted[0].points);
    EXPECT_EQ(leaks[0].place, wanted[0].place);
    EXPECT_EQ(leaks[0].width, wanted[0].width);
    EXPECT_EQ(leaks[0].surfaces, wanted[0].surfaces);
  }
}

TEST(LeaksError, ASealedSeedOutsideTheDomain)
{
  TriangleSurface surface;
  addBox(surface, "Room", roomBox);
  FoundZones found(surface, uniformGrid(domain, size));
  for (const Vec3& seed : {Vec3(0, 0, 50), Vec3(-1e30, 0, 1), Vec3(0, 0, std::nan(""))})
  {
    try
    {
      found.leaks({seed});
      FAIL() << "no error";
    }
    catch (const Error& error)
    {
      EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("sealed seed"), ::testing::HasSubstr("domain")));
    }
  }
}

} // namespace
