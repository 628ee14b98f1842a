// SPDX-License-Identifier: GPL-3.0-or-later
/// Domains that do not suit their model are told, and those that do are not.
#include "Domain/DomainCheck.h"
#include "Support/Error.h"
#include "Support/Shapes.h"

#include <gmock/gmock.h>

namespace {

using atria::Box3;
using atria::DomainMode;
using atria::SiteOptions;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addSurface;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double sizeMin = 0.5;

std::vector<std::string> check(const TriangleSurface& surface, const SiteOptions& options)
{
  atria::GridOptions sizes;
  sizes.sizeMin = sizeMin;
  return checkDomain(surface, planSite(surface, options, sizes), options.mode, sizeMin);
}

SiteOptions within(const Box3& box, double angle = 0.0)
{
  SiteOptions options;
  options.mode = DomainMode::bounds;
  options.bounds = box;
  options.domainAngle = angle;
  return options;
}

/// Walls 8 by 6, 3 high, and a roof with its ridge at 5.
TriangleSurface house()
{
  TriangleSurface surface;
  addSurface(surface, "Walls", {{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {0, 6, 0}, {0, 0, 3}, {8, 0, 3}, {8, 6, 3}, {0, 6, 3}},
             {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}});
  addSurface(surface, "Roof", {{0, 0, 3}, {8, 0, 3}, {8, 6, 3}, {0, 6, 3}, {0, 3, 5}, {8, 3, 5}},
             {{0, 1, 5}, {0, 5, 4}, {2, 3, 4}, {2, 4, 5}});
  return surface;
}

const Box3 around{Vec3(-20, -20, 0), Vec3(40, 20, 20)};

std::string errorOf(const TriangleSurface& surface, const SiteOptions& options)
{
  try
  {
    check(surface, options);
  }
  catch (const atria::Error& error)
  {
    return error.what();
  }
  return {};
}

TEST(DomainCheck, ADomainBesideOrAboveTheModelIsRefused)
{
  EXPECT_THAT(check(house(), within(around)), IsEmpty());
  for (const Box3& box : {Box3{Vec3(20, 0, 0), Vec3(40, 20, 20)}, Box3{Vec3(-20, -20, 6), Vec3(40, 20, 20)},
                          Box3{Vec3(-20, -20, 5), Vec3(40, 20, 20)}, Box3{Vec3(-20, -20, -20), Vec3(40, 20, -1)},
                          Box3{Vec3(1, 1, 0.5), Vec3(7, 5, 2.5)}})
  {
    SCOPED_TRACE(box.min.transpose());
    EXPECT_THAT(errorOf(house(), within(box)), AllOf(HasSubstr("holds nothing of the model"),
                                                     HasSubstr("the model x from 0 to 8, y from 0 to 6, z from 0 to 5"),
                                                     HasSubstr("DomainBounds"), HasSubstr("Automatic")));
  }
  EXPECT_THAT(errorOf(house(), within({Vec3(20, 0, 0), Vec3(41, 20, 20)})), HasSubstr("it reaches x from 20 to 41"));
  EXPECT_THAT(check({}, within(around)), IsEmpty()) << "a domain without a model is one";
}

TEST(DomainCheck, AModelWithoutAreaIsRefused)
{
  TriangleSurface lines;
  addSheet(lines, "Line", Vec3(1, 1, 1), Vec3(2, 0, 0), Vec3(1, 0, 0));
  EXPECT_THAT(errorOf(lines, within(around)), HasSubstr("no face of the model has an area"));
}

TEST(DomainCheck, TellsWhichSidesCutWhichSurfaces)
{
  const auto found = check(house(), within({Vec3(-20, -20, 0), Vec3(4, 20, 4)}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0], HasSubstr("cuts through surfaces at xMax ('Walls', 'Roof') and zMax ('Roof'),"));
  EXPECT_THAT(found[0], AllOf(HasSubstr("DomainBounds"), HasSubstr("TerrainName")));
  // Of many surfaces the first few.
  TriangleSurface row;
  for (int i = 0; i < 9; ++i)
  {
    addBox(row, "House" + std::to_string(i), {Vec3(10 * i, 0, 0), Vec3(10 * i + 5, 5, 8)});
  }
  EXPECT_THAT(check(row, within({Vec3(-20, -20, 0), Vec3(120, 20, 6)})),
              ElementsAre(HasSubstr("at zMax ('House0', 'House1', 'House2', 'House3' and 5 more),")));
}

TEST(DomainCheck, TellsWhichSidesOfAPrismCutWhichSurfaces)
{
  TriangleSurface surface = house();
  addSheet(surface, "Sky", Vec3(-100, -100, 10), Vec3(200, 0, 0), Vec3(0, 200, 0)); // no corner of it is within
  addSheet(surface, "Above", Vec3(-100, -100, 30), Vec3(200, 0, 0), Vec3(0, 200, 0));
  SiteOptions options = within({Vec3(-20, -20, 0), Vec3(20, 20, 20)});
  options.domainSides = 6;
  EXPECT_THAT(
      check(surface, options),
      ElementsAre(HasSubstr("at domainSide1 ('Sky'), domainSide2 ('Sky'), domainSide3 ('Sky'), domainSide4 ('Sky'), "
                            "domainSide5 ('Sky') and domainSide6 ('Sky'),")));
  // In the corner of the box that the triangle leaves out.
  TriangleSurface shed;
  addBox(shed, "House", {Vec3(0, 0, 0), Vec3(4, 4, 4)});
  addBox(shed, "Shed", {Vec3(17, 17, 0), Vec3(19, 19, 3)});
  options.domainSides = 3;
  EXPECT_THAT(check(shed, options), IsEmpty());
  addBox(shed, "Barn", {Vec3(8, -2, 0), Vec3(30, 2, 30)});
  EXPECT_THAT(check(shed, options),
              ElementsAre(HasSubstr("at domainSide2 ('Barn'), domainSide3 ('Barn') and zMax ('Barn'),")));
}

TEST(DomainCheck, TellsWhereThereIsNoAirAboveOrBeside)
{
  // The model's own bounds, given as a box: the ridge is on the top, and gables are open.
  EXPECT_THAT(check(house(), within({Vec3(-20, -20, 0), Vec3(40, 20, 5)})),
              ElementsAre(AllOf(HasSubstr("end on the domain's sides, without air between: zMax ('Roof');"),
                                HasSubstr("FromSurfaces"))));
  EXPECT_THAT(check(house(), within({Vec3(0, -20, 0), Vec3(40, 20, 20)})),
              ElementsAre(HasSubstr("xMin ('Walls', 'Roof');")));
  EXPECT_THAT(check(house(), within({Vec3(-0.2, -20, 0), Vec3(40, 20, 20)})),
              ElementsAre(HasSubstr("xMin ('Walls', 'Roof');")))
      << "less than half an octant";
  EXPECT_THAT(check(house(), within({Vec3(-0.3, -20, 0), Vec3(40, 20, 20)})), IsEmpty());
  EXPECT_THAT(check(house(), within({Vec3(0, 0, 0), Vec3(8, 6, 5)})), ElementsAre(HasSubstr("zMax ('Roof')")));
  // Walls that end on the top while the roof is cut away as a whole.
  EXPECT_THAT(check(house(), within({Vec3(-20, -20, 0), Vec3(40, 20, 3)})), ElementsAre(HasSubstr("zMax")));
}

TEST(DomainCheck, WhatFollowsFromTheModelIsAsAsked)
{
  SiteOptions options;
  for (const auto mode : {DomainMode::surfaces, DomainMode::automatic})
  {
    options.mode = mode;
    EXPECT_THAT(check(house(), options), IsEmpty());
  }
}

TEST(DomainCheck, RoomsWhoseWallsAreTheSidesAreSound)
{
  const Box3 room{Vec3(0, 0, 0), Vec3(8, 6, 3)};
  TriangleSurface surface;
  addBox(surface, "Room", room);
  addSheet(surface, "Partition", Vec3(4, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, 3));
  addBox(surface, "Table", {Vec3(1, 1, 0), Vec3(2, 2, 0.8)});
  EXPECT_THAT(check(surface, within(room)), IsEmpty());
  // With the domain's sides as the walls.
  TriangleSurface furniture;
  addSheet(furniture, "Partition", Vec3(4, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, 3));
  addSheet(furniture, "Gallery", Vec3(0, 0, 2), Vec3(8, 0, 0), Vec3(0, 6, 0));
  addBox(furniture, "Table", {Vec3(1, 1, 0), Vec3(2, 2, 0.8)});
  EXPECT_THAT(check(furniture, within(room)), IsEmpty());
  // A cupboard in the corner has no air beside it, which nobody may have meant.
  addBox(furniture, "Cupboard", {Vec3(0, 0, 0), Vec3(1, 0.5, 2)});
  EXPECT_THAT(check(furniture, within(room)), ElementsAre(HasSubstr("xMin ('Cupboard') and yMin ('Cupboard')")));
}

TEST(DomainCheck, GroundMayGoOnBeyondTheSides)
{
  TriangleSurface surface = house();
  addSheet(surface, "Lawn", Vec3(-100, -100, 0), Vec3(200, 0, 0), Vec3(0, 200, 0));
  EXPECT_THAT(check(surface, within(around)), IsEmpty()) << "on the bottom";
  SiteOptions lower = within({Vec3(-20, -20, -2), Vec3(40, 20, 20)});
  EXPECT_THAT(check(surface, lower),
              ElementsAre(HasSubstr("xMin ('Lawn'), xMax ('Lawn'), yMin ('Lawn') and yMax ('Lawn')")));
  lower.site = "Lawn";
  EXPECT_THAT(check(surface, lower), IsEmpty());
  lower.site = "Site";
  lower.terrain = "La*";
  EXPECT_THAT(check(surface, lower), IsEmpty());
}

TEST(DomainCheck, ASiteMayBeTooLowOrTooSmallForItsBuildings)
{
  TriangleSurface surface;
  addSheet(surface, "Site", Vec3(-20, -20, 0), Vec3(40, 0, 0), Vec3(0, 40, 0));
  addBox(surface, "Tower", {Vec3(-3, -3, 0), Vec3(3, 3, 30)});
  addBox(surface, "Shed", {Vec3(15, 0, 0), Vec3(22, 5, 3)});
  SiteOptions options;
  options.mode = DomainMode::site;
  EXPECT_THAT(check(surface, options), ElementsAre(HasSubstr("at xMax ('Shed') and zMax ('Tower')")));
}

TEST(DomainCheck, WhatIsBelowTheGroundDoesNotCountUnlessItIsMostOfIt)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(0, 0, -3), Vec3(8, 6, 5)});
  EXPECT_THAT(check(surface, within(around)), IsEmpty());
  EXPECT_THAT(check(surface, within({Vec3(-20, -20, 2), Vec3(40, 20, 20)})),
              ElementsAre(HasSubstr("most of the buildings' height")));
}

TEST(DomainCheck, ADomainOverTheLawnAloneIsTold)
{
  TriangleSurface surface = house();
  addSheet(surface, "Site", Vec3(-100, -100, 0), Vec3(200, 0, 0), Vec3(0, 200, 0));
  EXPECT_THAT(check(surface, within({Vec3(20, 20, 0), Vec3(60, 60, 20)})),
              ElementsAre(AllOf(HasSubstr("holds no building"), HasSubstr("the buildings x from 0 to 8"))));
  TriangleSurface lawn;
  addSheet(lawn, "Site", Vec3(-100, -100, 0), Vec3(200, 0, 0), Vec3(0, 200, 0));
  EXPECT_THAT(check(lawn, within(around)), IsEmpty());
}

TEST(DomainCheck, TurnedDomainsAreJudgedAlongTheirSides)
{
  TriangleSurface surface = house();
  atria::testing::turn(surface, 30.0);
  const atria::PlacedBox box{atria::Placement(30.0), {Vec3(-5, -5, 0), Vec3(13, 11, 5)}};
  // Given about their middle.
  const Vec3 middle = box.axes.toModel(box.bounds.center());
  const Box3 given{middle - 0.5 * box.bounds.size(), middle + 0.5 * box.bounds.size()};
  EXPECT_THAT(check(surface, within(given, 30.0)), ElementsAre(HasSubstr("between: zMax ('Roof');")));
  EXPECT_THAT(errorOf(surface, within({given.min + Vec3(90, 0, 0), given.max + Vec3(90, 0, 0)}, 30.0)),
              HasSubstr("along the domain's axes"));
}

} // namespace
