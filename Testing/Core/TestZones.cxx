// SPDX-License-Identifier: GPL-3.0-or-later
/// Which zones are kept, and what is said of them.
#include "FoundZones.h"

#include "Dual/Zones/ZoneSummary.h"

#include <gmock/gmock.h>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addRoom;
using atria::testing::addSheet;
using atria::testing::FoundZones;
using atria::testing::uniformGrid;
using ::testing::Contains;
using ::testing::UnorderedElementsAre;

const Box3 domain{Vec3(-6, -6, 0), Vec3(6, 6, 7)};
const Vec3 sky(1, 1, 6.4);

/// A terrain over the whole domain, and beyond it, with a cellar in it and a house on it.
TriangleSurface terrain()
{
  TriangleSurface surface;
  addSheet(surface, "Terrain", Vec3(-8, -8, 1.3), Vec3(16, 0, 0.9), Vec3(0, 16, 1.1));
  addBox(surface, "House", {Vec3(-2, -2, 2), Vec3(2, 2, 5)});
  return surface;
}

TEST(Zones, UnderATerrainToTheLateralSidesIsDropped)
{
  FoundZones found(terrain(), uniformGrid(domain, 0.5));
  const std::vector<char> kept = found.kept(ZoneRule::outside);
  EXPECT_TRUE(kept[found.zoneAt(sky)]);
  EXPECT_FALSE(kept[found.zoneAt(Vec3(1, 1, 0.6))]);
  EXPECT_FALSE(kept[found.zoneAt(Vec3(0, 0, 4))]);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 1), 1);
}

/// More points than one thread joins at a time.
TEST(Zones, OfManyPointsAreTheInsideAndTheOutsideOfABox)
{
  TriangleSurface surface;
  const Box3 box{Vec3(-3.1, -2.1, 1.9), Vec3(4.1, 5.1, 6.1)};
  addBox(surface, "House", box);
  FoundZones found(surface, uniformGrid(domain, 0.2), 3);
  const std::size_t count = found.points.size();
  ASSERT_GT(count, 100000U);
  ASSERT_EQ(found.zones.count(), 2U);
  std::vector<std::size_t> sizes(2, 0);
  for (Index point = 0; point < count; ++point)
  {
    const Vec3 p = found.octree.frame().toModel(found.grid.place(point));
    const bool inside = (p.array() > box.min.array()).all() && (p.array() < box.max.array()).all();
    ASSERT_EQ(found.zones.ofPoint[point], inside ? 1 : 0);
    ++sizes[found.zones.ofPoint[point]];
  }
  EXPECT_EQ(found.zones.sizes[0], sizes[0]);
  EXPECT_EQ(found.zones.sizes[1], sizes[1]);
}

TEST(Zones, UnderALidThatIsTheTopIsKeptAndUnderTheTerrainIsNot)
{
  TriangleSurface surface = terrain();
  addSheet(surface, "Lid", Vec3(-8, -8, 7), Vec3(16, 0, 0), Vec3(0, 16, 0));
  FoundZones found(surface, uniformGrid(domain, 0.5));
  const std::vector<char> kept = found.kept(ZoneRule::outside);
  EXPECT_TRUE(kept[found.zoneAt(sky)]);
  EXPECT_FALSE(kept[found.zoneAt(Vec3(1, 1, 0.6))]);
  EXPECT_FALSE(kept[found.zoneAt(Vec3(0, 0, 4))]);
}

TEST(Zones, WhereNothingReachesTheTopTheLateralSidesCount)
{
  TriangleSurface surface;
  addSheet(surface, "Lid", Vec3(-8, -8, 6.9), Vec3(16, 0, 0), Vec3(0, 16, 0)); // above the last grid points
  addBox(surface, "House", {Vec3(-2, -2, 1.2), Vec3(2, 2, 5)});
  FoundZones found(surface, uniformGrid(domain, 0.5));
  const std::vector<char> kept = found.kept(ZoneRule::outside);
  EXPECT_TRUE(kept[found.zoneAt(sky)]);
  EXPECT_FALSE(kept[found.zoneAt(Vec3(0, 0, 4))]);
}

TEST(Zones, ARoomBelowTheFlatRoofThatIsTheTopIsKept)
{
  // The bounds of a house with two wings are the domain: beside the lower wing the top is open.
  TriangleSurface surface;
  addBox(surface, "High", {domain.min, Vec3(1.2, 6, 7)});
  addBox(surface, "Low", {Vec3(1.2, -6, 0), Vec3(6, 6, 3.2)});
  FoundZones found(surface, uniformGrid(domain, 0.5));
  const std::vector<char> kept = found.kept(ZoneRule::outside);
  EXPECT_TRUE(kept[found.zoneAt(Vec3(-3, 0, 3))]);
  EXPECT_TRUE(kept[found.zoneAt(Vec3(4, 0, 5))]);
  EXPECT_FALSE(kept[found.zoneAt(Vec3(4, 0, 1.5))]);
}

TEST(Zones, InADomainThatIsABuildingAllRoomsAtItsWallsAreKept)
{
  TriangleSurface surface;
  addBox(surface, "Walls", domain);
  addSheet(surface, "Storey", Vec3(-6, -6, 3.2), Vec3(12, 0, 0), Vec3(0, 12, 0));
  addBox(surface, "Shaft", {Vec3(-1, -1, 1.1), Vec3(1, 1, 2.3)});
  FoundZones found(surface, uniformGrid(domain, 0.5));
  const std::vector<char> kept = found.kept(ZoneRule::outside);
  EXPECT_TRUE(kept[found.zoneAt(sky)]);
  EXPECT_TRUE(kept[found.zoneAt(Vec3(3, 3, 1))]);
  EXPECT_FALSE(kept[found.zoneAt(Vec3(0.1, 0.1, 1.8))]);
}

TEST(Zones, SummariesTellPlaceSizeAndSurfacesOfEveryZone)
{
  TriangleSurface surface = terrain();
  addRoom(surface, "Shed", {Vec3(3.1, 2.2, 3.3), Vec3(5.2, 4.4, 4.9)}, {0.3, 0.3}, {0.35, 0.35});
  GridOptions grid = uniformGrid(domain, 0.25);
  grid.sizeMid = 0.5;
  grid.sizeMax = 1.0;
  FoundZones found(surface, grid);
  const std::vector<char> kept = found.kept(ZoneRule::outside);
  const auto zones = summarizeZones(found.zones, kept, found.crossings, found.grid, 8, found.context());
  ASSERT_EQ(zones.size(), found.zones.count());
  std::size_t total = 0;
  for (std::size_t i = 0; i < zones.size(); ++i)
  {
    total += zones[i].elements;
    EXPECT_EQ(zones[i].kept, kept[i] != 0);
    EXPECT_EQ(found.zoneAt(zones[i].inside), static_cast<std::int32_t>(i)) << "the point is a seed of the zone";
  }
  EXPECT_EQ(total, found.points.size());
  const ZoneSummary& shed = zones[found.zoneAt(Vec3(4.1, 3.3, 4.1))];
  EXPECT_FALSE(shed.kept);
  EXPECT_EQ(shed.sides, 0);
  std::vector<std::string> names;
  for (const Index s : shed.surfaces)
  {
    names.push_back(found.model.names[s]);
  }
  EXPECT_THAT(names, UnorderedElementsAre("ShedWest", "ShedEast", "ShedSouth", "ShedNorth", "ShedFloor", "ShedRoof"));
  const ZoneSummary& under = zones[found.zoneAt(Vec3(1, 1, 0.6))];
  EXPECT_EQ(under.sides, 1u << xMin | 1u << xMax | 1u << yMin | 1u << yMax | 1u << zMin);
}

TEST(Zones, RoomsAreToldFromSolidsAndGaps)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", Vec3(-8, -8, 0.6), Vec3(16, 0, 0), Vec3(0, 16, 0));
  const Box3 solid{Vec3(-4.1, -3.2, 1.9), Vec3(-0.6, 0.2, 4.4)};
  const Box3 room{Vec3(1.2, -3.1, 1.8), Vec3(4.3, 1.1, 4.6)};
  addBox(surface, "Solid", solid);
  addRoom(surface, "Room", room, {0.3, 0.3}, {0.3, 0.3}); // with a hole of no width
  addBox(surface, "Slot", {Vec3(-3.1, 2.2, 2.1), Vec3(3.2, 2.9, 4.2)});
  addSheet(surface, "Across", Vec3(0, 2.2, 2.1), Vec3(0, 0.7, 0), Vec3(0, 0, 2.1));
  FoundZones found(surface, uniformGrid(domain, 0.5));
  const auto zones = summarizeZones(found.zones, found.kept(ZoneRule::outside), found.crossings, found.grid,
                                    found.model.names.size(), found.context());
  const auto at = [&](const Vec3& p) { return zones[found.zoneAt(p)]; };
  EXPECT_EQ(at(sky).kind, ZoneKind::open);
  EXPECT_EQ(at(Vec3(0, 0, 0.3)).kind, ZoneKind::open) << "below the ground";
  EXPECT_EQ(at(solid.center()).kind, ZoneKind::solid);
  EXPECT_EQ(at(room.center()).kind, ZoneKind::room);
  EXPECT_EQ(at(Vec3(2, 2.5, 3)).kind, ZoneKind::narrow);
  double sum = 0.0;
  for (const ZoneSummary& zone : zones)
  {
    sum += zone.volume;
  }
  EXPECT_NEAR(sum, domain.size().prod(), 0.2 * domain.size().prod());
  for (const Box3& box : {solid, room})
  {
    EXPECT_GT(at(box.center()).volume, (box.size().array() - 0.5).prod());
    EXPECT_LT(at(box.center()).volume, (box.size().array() + 0.5).prod());
  }
}

TEST(Zones, SolidsMayStandOnTheGround)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", Vec3(-8, -8, 0.6), Vec3(16, 0, 0), Vec3(0, 16, 0));
  addBox(surface, "Solid", {Vec3(-4.1, -3.2, -0.3), Vec3(-0.6, 0.2, 4.4)});
  FoundZones found(surface, uniformGrid(domain, 0.5));
  const auto zones = summarizeZones(found.zones, found.kept(ZoneRule::outside), found.crossings, found.grid,
                                    found.model.names.size(), found.context());
  EXPECT_EQ(zones[found.zoneAt(Vec3(-2, -1, 3))].kind, ZoneKind::solid);
}

TEST(Zones, SummariesPointsAreSeedsWhateverTheSurfaces)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE(seed);
    GridOptions grid = uniformGrid({Vec3::Constant(-4.3), Vec3::Constant(4.1)}, 0.25);
    grid.sizeMid = 0.5;
    grid.sizeMax = 1.0;
    FoundZones found(atria::testing::randomSoup(seed), grid);
    const auto zones = summarizeZones(found.zones, found.kept(ZoneRule::all), found.crossings, found.grid,
                                      found.model.names.size(), found.context());
    for (std::size_t i = 0; i < zones.size(); ++i)
    {
      EXPECT_EQ(found.zoneAt(zones[i].inside), static_cast<std::int32_t>(i));
    }
  }
}

/// Two walls through the whole domain, 0.3 of an octant apart; the grid points between them were moved there.
TEST(Zones, ASeedInAThinGapMeansTheGap)
{
  constexpr double size = 0.5;
  for (const double degrees : {0.0, 11.0, 30.0})
  {
    for (const double at : {0.03, 0.14, 0.27, 0.41})
    {
      SCOPED_TRACE(degrees);
      SCOPED_TRACE(at);
      TriangleSurface surface;
      addSheet(surface, "West", Vec3(at, -12, -1), Vec3(0, 24, 0), Vec3(0, 0, 9));
      addSheet(surface, "East", Vec3(at + 0.3 * size, -12, -1), Vec3(0, 24, 0), Vec3(0, 0, 9));
      atria::testing::turn(surface, degrees);
      FoundZones found(surface, uniformGrid(domain, size));
      found.modify();
      const auto zoneAt = [&](double x, double y) {
        return found.zoneAt(atria::testing::turned(Vec3(at + x, y, 3.1), degrees));
      };
      const std::int32_t west = zoneAt(-0.02, 0.2), gap = zoneAt(0.15 * size, 0.2), east = zoneAt(0.17, 0.2);
      EXPECT_NE(west, gap);
      EXPECT_NE(gap, east);
      EXPECT_NE(east, west);
      for (const double y : {-1.3, -0.4, 0.1, 0.6, 1.7})
      {
        EXPECT_EQ(zoneAt(-0.02, y), west) << y;
        EXPECT_EQ(zoneAt(0.15 * size, y), gap) << y;
        EXPECT_EQ(zoneAt(0.3 * size + 0.02, y), east) << y;
      }
      const auto zones =
          summarizeZones(found.zones, found.kept(ZoneRule::all), found.crossings, found.grid, 2, found.context());
      EXPECT_EQ(found.zoneAt(zones[gap].inside), gap);
    }
  }
}

} // namespace
