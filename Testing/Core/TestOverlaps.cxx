// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces that lie upon each other in the repaired model: areas by name, whatever the order in the file.
#include "Mesher/OverlapWarnings.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Surface/Model/SurfaceModel.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numeric>

namespace {

using atria::Index;
using atria::SharedArea;
using atria::SurfaceKind;
using atria::SurfaceModel;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;

using Areas = std::map<std::string, double>;
/// Area by the names of the surface that keeps and the one that gives.
using Shared = std::map<std::pair<std::string, std::string>, double>;

constexpr double size = 0.25;

SurfaceModel repaired(const TriangleSurface& surface, const std::vector<std::string>& faceZones = {},
                      const atria::Box3& domain = {Vec3::Constant(-10.0), Vec3::Constant(10.0)}, int threads = 1)
{
  atria::GridOptions grid;
  grid.domain = domain;
  grid.sizeMin = size;
  grid.sizeMid = grid.sizeMax = 1.0;
  atria::Box3 extent;
  std::ranges::for_each(surface.points, [&](const Vec3& p) { extent.extend(p); });
  atria::FeatureOptions options;
  for (const std::string& name : surface.names)
  {
    options.kinds.push_back(std::ranges::find(faceZones, name) != faceZones.end() ? SurfaceKind::faceZone
                                                                                  : SurfaceKind::wall);
  }
  const atria::ThreadExecutor executor(threads);
  return makeSurfaceModel(surface, makeGridFrame(grid, extent), options, atria::testing::quietContext(executor));
}

Areas areasOf(const SurfaceModel& model)
{
  const double unit = size / std::ldexp(1.0, 30);
  Areas areas;
  std::ranges::for_each(model.names, [&](const std::string& name) { areas[name] = 0.0; });
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    areas[model.names[model.surfaceIds[t]]] += 0.5 * model.normal(t).norm() * unit * unit;
  }
  return areas;
}

Shared sharedOf(const SurfaceModel& model)
{
  Shared shared;
  for (const SharedArea& each : model.repair.shared)
  {
    shared[{model.names[each.keeps], model.names[each.gives]}] = each.area;
  }
  return shared;
}

template <typename Map> void expectNear(const Map& found, const Map& wanted, double tolerance)
{
  for (const auto& [key, area] : wanted)
  {
    ASSERT_TRUE(found.contains(key)) << ::testing::PrintToString(key);
    EXPECT_NEAR(found.at(key), area, tolerance) << ::testing::PrintToString(key);
  }
  EXPECT_EQ(found.size(), wanted.size());
}

/// Orders that put each surface first and last.
std::vector<std::vector<Index>> ordersOf(std::size_t count)
{
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  std::vector<std::vector<Index>> all;
  for (std::size_t i = 0; i < count; ++i)
  {
    all.push_back(order);
    std::ranges::rotate(order, order.begin() + 1);
  }
  std::ranges::reverse(order);
  all.push_back(order);
  return all;
}

/// Turns the winding of a surface.
void flip(TriangleSurface& surface, const std::string& name)
{
  for (Index t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.names[surface.surfaceIds[t]] == name)
    {
      std::swap(surface.triangles[t][0], surface.triangles[t][1]);
    }
  }
}

/// Two uncut walls side by side, a window on one of them, one on both, a sign that reaches beyond them, and a pane that
/// covers the side of a box, whose surface is larger.
TriangleSurface facade()
{
  TriangleSurface surface;
  addSheet(surface, "Left", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  addSheet(surface, "Right", {3, 0, 0}, {4, 0, 0}, {0, 0, 3});
  addBox(surface, "House", {{0, 2, 0}, {4, 5, 3}});
  addSheet(surface, "Window", {1, 0, 1}, {1, 0, 0}, {0, 0, 1});
  addSheet(surface, "Across", {2.5, 0, 0.5}, {1, 0, 0}, {0, 0, 1.2});
  addSheet(surface, "Sign", {6, 0, 2}, {2, 0, 0}, {0, 0, 1.5});
  addSheet(surface, "Pane", {0, 2, 0}, {4, 0, 0}, {0, 0, 3});
  return surface;
}

const Areas facadeAreas{{"Left", 9 - 1 - 0.6}, {"Right", 12 - 0.6 - 1.0}, {"House", 66 - 12},
                        {"Window", 1.0},       {"Across", 1.2},           {"Sign", 3.0},
                        {"Pane", 12.0}};
const Shared facadeShared{{{"Window", "Left"}, 1.0},
                          {{"Across", "Left"}, 0.6},
                          {{"Across", "Right"}, 0.6},
                          {{"Sign", "Right"}, 1.0},
                          {{"Pane", "House"}, 12.0}};

TEST(Overlaps, LeaveTheSmallerSurfaceItsFacesWhateverTheOrder)
{
  for (const double angle : {0.0, 17.0, 30.0, 45.0})
  {
    for (const std::string flipped : {"", "Window", "Across", "Pane", "Left"})
    {
      TriangleSurface surface = facade();
      flip(surface, flipped);
      atria::testing::turn(surface, angle);
      for (const std::vector<Index>& order : ordersOf(surface.names.size()))
      {
        SCOPED_TRACE(std::to_string(angle) + ' ' + flipped + ' ' + ::testing::PrintToString(order));
        const SurfaceModel model = repaired(atria::testing::inOrder(surface, order));
        expectNear(areasOf(model), facadeAreas, 1e-6);
        expectNear(sharedOf(model), facadeShared, 1e-6);
        EXPECT_TRUE(warningsOfOverlaps(model, size).empty()) << "the normal case is no reason to warn";
      }
    }
  }
}

TEST(Overlaps, DoNotDependOnThreads)
{
  TriangleSurface surface = facade();
  atria::testing::turn(surface, 17.0);
  const SurfaceModel one = repaired(surface);
  const SurfaceModel seven = repaired(surface, {}, {Vec3::Constant(-10.0), Vec3::Constant(10.0)}, 7);
  EXPECT_EQ(one.triangles, seven.triangles);
  EXPECT_EQ(one.surfaceIds, seven.surfaceIds);
  EXPECT_EQ(sharedOf(one), sharedOf(seven));
}

TEST(Overlaps, GoByThePatchNotByTheWholeSurface)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  addSheet(surface, "Glass", {1, 0, 1}, {1, 0, 0}, {0, 0, 1});
  for (int i = 0; i < 20; ++i) // and on twenty more walls
  {
    addSheet(surface, "Pane", {1, 0.25 * (i + 1), 1}, {1, 0, 0}, {0, 0, 1});
    surface.surfaceIds[surface.surfaceIds.size() - 1] = surface.surfaceIds[surface.surfaceIds.size() - 2] = 1;
  }
  const Areas areas = areasOf(repaired(surface));
  EXPECT_NEAR(areas.at("Wall"), 8.0, 1e-6);
  EXPECT_NEAR(areas.at("Glass"), 21.0, 1e-6);
}

TEST(Overlaps, AreSettledByTheOrderWhereSurfacesAreEqualAndThatIsSaid)
{
  for (const bool isFlipped : {false, true})
  {
    TriangleSurface surface;
    addSheet(surface, "Wall", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
    addSheet(surface, "Copy", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
    if (isFlipped)
    {
      flip(surface, "Copy");
    }
    const SurfaceModel model = repaired(surface);
    expectNear(areasOf(model), {{"Wall", 9.0}, {"Copy", 0.0}}, 1e-6);
    ASSERT_EQ(model.repair.shared.size(), 1u);
    EXPECT_NEAR(model.repair.shared[0].equalArea, 9.0, 1e-6);
    const std::vector<std::string> warnings = warningsOfOverlaps(model, size);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("'Wall' and 'Copy' lie upon each other in 9 square meters"), std::string::npos)
        << warnings[0];
  }
}

TEST(Overlaps, OfSolidsThatTouchAreNoReasonToWarn)
{
  TriangleSurface surface;
  addBox(surface, "House", {{0, 0, 0}, {2, 2, 2}});
  addBox(surface, "Next", {{2, 0, 0}, {4, 2, 2}});
  const SurfaceModel model = repaired(surface);
  expectNear(areasOf(model), {{"House", 24.0}, {"Next", 20.0}}, 1e-6);
  expectNear(sharedOf(model), {{{"House", "Next"}, 4.0}}, 1e-6);
  EXPECT_TRUE(warningsOfOverlaps(model, size).empty());
}

TEST(Overlaps, OfSmallerFaceZonesOpenWalls)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  addSheet(surface, "Door", {1, 0, 0}, {1, 0, 0}, {0, 0, 2});
  for (const std::vector<Index>& order : ordersOf(2))
  {
    const SurfaceModel model = repaired(atria::testing::inOrder(surface, order), {"Door"});
    expectNear(areasOf(model), {{"Wall", 7.0}, {"Door", 2.0}}, 1e-6);
    const std::vector<std::string> warnings = warningsOfOverlaps(model, size);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("the face zone 'Door' opens the wall 'Wall', on which it lies, in 2 square meters"),
              std::string::npos)
        << warnings[0];
  }
}

TEST(Overlaps, OfFaceZonesThatAreNotSmallerLeaveWallsClosed)
{
  for (const double height : {2.0, 2.5})
  {
    TriangleSurface surface;
    addSheet(surface, "Wall", {0, 0, 0}, {3, 0, 0}, {0, 0, 2});
    addSheet(surface, "Zone", {0, 0, 0}, {3, 0, 0}, {0, 0, height});
    addSheet(surface, "Floor", {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
    surface.surfaceIds[4] = surface.surfaceIds[5] = 0; // a wall that is the larger surface
    surface.names.pop_back();
    for (const std::vector<Index>& order : ordersOf(2))
    {
      const SurfaceModel model = repaired(atria::testing::inOrder(surface, order), {"Zone"});
      expectNear(areasOf(model), {{"Wall", 15.0}, {"Zone", 3.0 * (height - 2.0)}}, 1e-6);
      const std::vector<std::string> warnings = warningsOfOverlaps(model, size);
      ASSERT_EQ(warnings.size(), 1u);
      EXPECT_NE(warnings[0].find("the face zone 'Zone' lies on the wall 'Wall' in 6 square meters"), std::string::npos)
          << warnings[0];
    }
  }
}

TEST(Overlaps, OnSidesOfTheDomainNameThem)
{
  TriangleSurface surface;
  addBox(surface, "Room", {{0, 0, 0}, {5, 4, 3}});
  addSheet(surface, "Inlet", {0, 1, 1}, {0, 1, 0}, {0, 0, 1});
  addSheet(surface, "Outlet", {5, 1, 1}, {0, 0, 1}, {0, 1, 0});
  for (const std::vector<Index>& order : ordersOf(3))
  {
    const SurfaceModel model =
        repaired(atria::testing::inOrder(surface, order), {"Outlet"}, {Vec3(0, 0, 0), Vec3(5, 4, 3)});
    expectNear(areasOf(model), {{"Room", 92.0}, {"Inlet", 1.0}, {"Outlet", 1.0}}, 1e-6);
    EXPECT_EQ(std::ranges::count(model.domainSides, SurfaceModel::noSide), 0);
    EXPECT_TRUE(warningsOfOverlaps(model, size).empty()) << "what lies on a side opens nothing";
  }
}

TEST(Overlaps, ThatCloseAGapCountToo)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  addSheet(surface, "Window", {1, -0.04, 1}, {1, 0, 0}, {0, 0, 1}); // 4 cm before it
  for (const std::vector<Index>& order : ordersOf(2))
  {
    const SurfaceModel model = repaired(atria::testing::inOrder(surface, order));
    EXPECT_GT(model.repair.closedGaps, 0u);
    expectNear(areasOf(model), {{"Wall", 8.0}, {"Window", 1.0}}, 1e-6);
    expectNear(sharedOf(model), {{{"Window", "Wall"}, 1.0}}, 1e-6);
  }
}

TEST(Overlaps, WithinOneSurfaceAreCountedButNoReasonToWarn)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  addSheet(surface, "Again", {1, 0, 1}, {1, 0, 0}, {0, 0, 1});
  surface.surfaceIds[2] = surface.surfaceIds[3] = 0;
  surface.names.pop_back();
  const SurfaceModel model = repaired(surface);
  expectNear(areasOf(model), {{"Wall", 9.0}}, 1e-6);
  expectNear(sharedOf(model), {{{"Wall", "Wall"}, 1.0}}, 1e-6);
  EXPECT_TRUE(warningsOfOverlaps(model, size).empty());
}

} // namespace
