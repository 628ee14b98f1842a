// SPDX-License-Identifier: GPL-3.0-or-later
/// Which openings the rule finds, in buildings that stand along the axes and turned.
#include "Support/Buildings.h"

#include "Mesher/ModelStages.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <map>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addWall;
using atria::testing::addWalls;
using atria::testing::Hole;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr double turns[] = {0.0, 17.0};

/// Areas of the openings found, by name.
std::map<std::string, double> openingsOf(TriangleSurface surface, double degrees, double size = 0.25,
                                         const std::vector<std::string>& without = {}, int threads = 1)
{
  atria::testing::turn(surface, degrees);
  ModelOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = {Vec3(-12, -12, 0), Vec3(12, 12, 12)};
  options.sizes.sizeMin = size;
  options.sizes.sizeMid = 2.0 * size;
  options.sizes.sizeMax = 2.0;
  options.findOpenings = true;
  options.withoutOpenings = without;
  const ThreadExecutor executor(threads);
  const PlacedModel placed = placeModel(surface, options);
  const SurfaceModel model = makeSurfaceModel(placed, options, atria::testing::quietContext(executor));
  std::map<std::string, double> areas;
  const double unit = placed.frame.latticeUnit();
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (model.isPermeable(t))
    {
      EXPECT_EQ(model.kindOf(t), SurfaceKind::faceZone);
      areas[model.names[model.surfaceIds[t]]] += 0.5 * model.normal(t).norm() * unit * unit;
    }
  }
  return areas;
}

void expectOpenings(const TriangleSurface& surface, const std::map<std::string, double>& wanted, double size = 0.25)
{
  for (const double degrees : turns)
  {
    const std::map<std::string, double> found = openingsOf(surface, degrees, size);
    std::vector<std::string> names;
    for (const auto& [name, area] : found)
    {
      names.push_back(name);
      const auto known = wanted.find(name);
      EXPECT_TRUE(known != wanted.end()) << name << " turned by " << degrees;
      if (known != wanted.end())
      {
        EXPECT_NEAR(area, known->second, 1e-4 * known->second) << name << " turned by " << degrees;
      }
    }
    EXPECT_EQ(found.size(), wanted.size()) << "turned by " << degrees << ": " << ::testing::PrintToString(names);
  }
}

const Vec3 low(-2, -3, 0);
const Vec3 high(2.5, 2.5, 3);

TriangleSurface house(const std::array<std::vector<Hole>, 4>& holes, bool hasFloor = true)
{
  TriangleSurface surface;
  addWalls(surface, low, high, holes);
  const Vec3 size = high - low;
  addSheet(surface, "Roof", low + Vec3(0, 0, size[2]), Vec3(size[0], 0, 0), Vec3(0, size[1], 0));
  if (hasFloor)
  {
    addSheet(surface, "Floor", low, Vec3(size[0], 0, 0), Vec3(0, size[1], 0));
  }
  return surface;
}

TEST(Openings, AreWindowsAndDoorsDownToTheFloor)
{
  const Hole window{1.1, 0.9, 2.7, 2.2};
  const Hole small{3.2, 1.0, 3.9, 1.8};
  const Hole door{0.6, 0.0, 1.6, 2.1};
  for (const bool hasFloor : {true, false}) // without one the bottom of the domain closes the door
  {
    expectOpenings(
        house({{{window, small}, {door}, {}, {}}}, hasFloor),
        {{"South_opening_1", window.area()}, {"South_opening_2", small.area()}, {"East_opening_1", door.area()}});
  }
}

TEST(Openings, AreNoneInAClosedHouseAndBesideAWallThatStandsFree)
{
  TriangleSurface surface = house({});
  addSheet(surface, "Fence", Vec3(-6, 4, 0), Vec3(9, 1, 0), Vec3(0, 0, 1.8));
  addBox(surface, "Shed", {Vec3(5, -2, 0), Vec3(7, 1, 2.5)});
  expectOpenings(surface, {});
}

TEST(Openings, WithADoorAjarAreTheDoor)
{
  const Hole door{0.6, 0.0, 1.6, 2.1};
  TriangleSurface surface = house({{{}, {door}, {}, {}}});
  const Vec3 hinge(high[0], low[1] + door.left, 0.0);
  addSheet(surface, "Leaf", hinge, Vec3(0.6, 0.8, 0.0), Vec3(0, 0, 2.1));
  expectOpenings(surface, {{"East_opening_1", door.area()}});
}

TEST(Openings, AreNoCracksBesideADoorThatIsShut)
{
  const Hole door{0.6, 0.0, 1.6, 2.1};
  TriangleSurface surface = house({{{}, {door}, {}, {}}});
  addSheet(surface, "Leaf", Vec3(high[0], low[1] + 0.65, 0.05), Vec3(0, 0.9, 0), Vec3(0, 0, 2.0));
  expectOpenings(surface, {});
}

TEST(Openings, RoundACornerAreOneInEachWall)
{
  TriangleSurface surface = house({{{{3.3, 1.0, 4.5, 2.0}}, {{0.0, 1.0, 1.4, 2.0}}, {}, {}}});
  expectOpenings(surface, {{"South_opening_1", 1.2}, {"East_opening_1", 1.4}});
}

TEST(Openings, AreHatchesInFloors)
{
  TriangleSurface surface = house({});
  const Vec3 size = high - low;
  const Hole hatch{1.0, 2.0, 2.2, 3.1};
  addWall(surface, "Slab", low + Vec3(0, 0, 1.4), Vec3(size[0], 0, 0), Vec3(0, size[1], 0), {hatch});
  expectOpenings(surface, {{"Slab_opening_1", hatch.area()}});
}

TEST(Openings, OfAnAtriumAreOneInEachSlab)
{
  TriangleSurface surface;
  const Vec3 top = high + Vec3(0, 0, 6);
  addWalls(surface, low, top, {});
  const Vec3 size = top - low;
  const Vec3 x(size[0], 0, 0), y(0, size[1], 0);
  addSheet(surface, "Roof", low + Vec3(0, 0, size[2]), x, y);
  const Hole atrium{1.2, 1.4, 3.1, 3.8};
  addWall(surface, "First", low + Vec3(0, 0, 3), x, y, {atrium});
  addWall(surface, "Second", low + Vec3(0, 0, 6), x, y, {atrium});
  expectOpenings(surface, {{"First_opening_1", atrium.area()}, {"Second_opening_1", atrium.area()}});
}

TEST(Openings, AreGapsBetweenWallsFromFloorToCeiling)
{
  TriangleSurface surface = house({});
  addSheet(surface, "PartitionA", Vec3(low[0], 0.1, 0), Vec3(1.6, 0, 0), Vec3(0, 0, 3));
  addSheet(surface, "PartitionB", Vec3(0.5, 0.1, 0), Vec3(2.0, 0, 0), Vec3(0, 0, 3));
  expectOpenings(surface, {{"PartitionA_opening_1", 0.9 * 3.0}});
}

TEST(Openings, InThickWallsAreOneForEachHole)
{
  TriangleSurface surface;
  // A wall of four boxes about a window, and one as a single solid with a hole through it.
  addBox(surface, "Pier", {Vec3(-4, 0, 0), Vec3(-2, 0.3, 3)});
  addBox(surface, "Pier2", {Vec3(-0.5, 0, 0), Vec3(2, 0.3, 3)});
  addBox(surface, "Sill", {Vec3(-2, 0, 0), Vec3(-0.5, 0.3, 0.9)});
  addBox(surface, "Lintel", {Vec3(-2, 0, 2.1), Vec3(-0.5, 0.3, 3)});
  for (const double degrees : turns)
  {
    const auto found = openingsOf(surface, degrees);
    ASSERT_EQ(found.size(), 1U) << ::testing::PrintToString(found);
    EXPECT_NEAR(found.begin()->second, 1.5 * 1.2, 1e-3);
  }
}

TEST(Openings, OneElementWideIsFoundAndNarrowerIsNot)
{
  const Hole slot{1.0, 0.8, 1.5, 2.2};
  const TriangleSurface surface = house({{{slot}, {}, {}, {}}});
  expectOpenings(surface, {{"South_opening_1", slot.area()}}, 0.5);
  expectOpenings(surface, {}, 0.6);
}

TEST(Openings, AreNotLookedForWherePatternsSayAndDoNotDependOnThreads)
{
  const Hole window{1.1, 0.9, 2.7, 2.2};
  const TriangleSurface surface = house({{{window}, {window}, {window}, {}}});
  EXPECT_EQ(openingsOf(surface, 17.0).size(), 3U);
  const auto found = openingsOf(surface, 17.0, 0.25, {"*th"}, 3);
  EXPECT_EQ(found.size(), 1U);
  EXPECT_EQ(found, openingsOf(surface, 17.0, 0.25, {"*th"}, 1));
  EXPECT_THAT(openingsOf(surface, 0.0, 0.25, {"*"}), IsEmpty());
  EXPECT_THROW(openingsOf(surface, 0.0, 0.25, {"Wall*"}), Error);
}

/// A hole that a surface of the model spans, such as a pane, is no opening; and names that are taken stay.
TEST(Openings, AreNotSpannedTwiceAndHaveNamesOfTheirOwn)
{
  const Hole window{1.1, 0.9, 2.7, 2.2};
  TriangleSurface surface = house({{{window}, {window}, {}, {}}});
  addSheet(surface, "Pane", low + Vec3(window.left, 0, window.bottom), Vec3(1.6, 0, 0), Vec3(0, 0, 1.3));
  addSheet(surface, "East_opening_1", Vec3(6, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1));
  expectOpenings(surface, {{"East_opening_2", window.area()}});
}

} // namespace
