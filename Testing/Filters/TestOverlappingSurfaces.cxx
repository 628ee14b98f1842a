// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of models whose surfaces lie upon each other: areas by name within 0.5 %, whatever the order of surfaces.
#include "DualMesherTest.h"

#include "Support/Text.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

namespace {

using atria::Box3;
using atria::Index;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::areaOf;
using atria::testing::fieldStrings;
using atria::testing::setGrid;
using ::testing::HasSubstr;

using Areas = std::map<std::string, double>;

class OverlappingSurfaces : public atria::testing::DualMesherTest
{
protected:
  static constexpr double size = 0.25;

  /// Surfaces rotated by as many places, so that others come first, and every other time wound the other way.
  static TriangleSurface ordered(const TriangleSurface& surface, Index places)
  {
    TriangleSurface out;
    const auto count = static_cast<Index>(surface.names.size());
    for (Index i = 0; i < count; ++i)
    {
      const Index id = (i + places) % count;
      std::vector<std::array<Index, 3>> triangles;
      for (Index t = 0; t < surface.triangles.size(); ++t)
      {
        if (surface.surfaceIds[t] == id)
        {
          triangles.push_back(surface.triangles[t]);
          if (places % 2 == 1 && i % 2 == 0)
          {
            std::swap(triangles.back()[0], triangles.back()[1]);
          }
        }
      }
      atria::testing::addSurface(out, surface.names[id], surface.points, triangles);
    }
    return out;
  }

  void expectAreas(const TriangleSurface& surface, const Areas& wanted, Index orders)
  {
    for (Index places = 0; places < orders; ++places)
    {
      SCOPED_TRACE("order " + std::to_string(places));
      setSurface(ordered(surface, places));
      mesher->Update();
      messages.takeWarnings();
      ASSERT_GT(volume()->GetNumberOfCells(), 0);
      const auto found = namedPatches();
      for (const auto& [name, area] : wanted)
      {
        ASSERT_TRUE(area == 0.0 || found.contains(name)) << name;
        EXPECT_NEAR(found.contains(name) ? areaOf(found.at(name)) : 0.0, area, 0.005 * area) << name;
      }
    }
  }

  std::string inputWarnings() { return atria::joined(fieldStrings(diagnostics(), "InputWarning")); }
};

/// A building that no wall of is cut: windows on one wall and across two, a pane that covers a side, and two copies.
TEST_F(OverlappingSurfaces, OfABuildingHaveTheAreasOfACutOne)
{
  for (const double angle : {0.0, 17.0, 30.0, 45.0})
  {
    SCOPED_TRACE(angle);
    TriangleSurface surface;
    addSheet(surface, "Left", {-3, -2, 0}, {3, 0, 0}, {0, 0, 3});
    addSheet(surface, "Right", {0, -2, 0}, {3, 0, 0}, {0, 0, 3});
    addSheet(surface, "Walls", {-3, -2, 0}, {0, 4, 0}, {0, 0, 3});
    addSheet(surface, "North", {-3, 2, 0}, {6, 0, 0}, {0, 0, 3});
    addSheet(surface, "East", {3, -2, 0}, {0, 4, 0}, {0, 0, 3});
    for (std::size_t t = 6; t < 10; ++t) // three sides of one surface
    {
      surface.surfaceIds[t] = 2;
    }
    surface.names.resize(3);
    addSheet(surface, "Roof", {-3, -2, 3}, {6, 0, 0}, {0, 4, 0});
    addSheet(surface, "Window", {-2.5, -2, 1}, {1, 0, 0}, {0, 0, 1.5});
    addSheet(surface, "Across", {-0.75, -2, 0.75}, {2, 0, 0}, {0, 0, 1});
    addSheet(surface, "Pane", {3, -2, 0}, {0, 4, 0}, {0, 0, 3});
    atria::testing::turn(surface, angle);
    const Areas wanted{{"Left", 9 - 1.5 - 0.75}, {"Right", 9 - 1.25}, {"Walls", 42 - 12}, {"Roof", 24},
                       {"Window", 1.5},          {"Across", 2},       {"Pane", 12}};
    setGrid(mesher, Box3(Vec3(-6, -6, 0), Vec3(6, 6, 5)), size, 2 * size, 1.0);
    expectAreas(surface, wanted, angle == 17.0 ? 7 : 2);
  }
}

/// A room whose walls are the sides of the domain.
TEST_F(OverlappingSurfaces, OnSidesOfTheDomainNameThem)
{
  for (const double angle : {0.0, 30.0})
  {
    SCOPED_TRACE(angle);
    TriangleSurface surface;
    addBox(surface, "Room", {{0, 0, 0}, {5, 4, 3}});
    addSheet(surface, "Inlet", {0, 1, 1}, {0, 0, 1}, {0, 1, 0});
    addSheet(surface, "Outlet", {5, 1, 1}, {0, 1, 0}, {0, 0, 1});
    atria::testing::turn(surface, angle);
    setGrid(mesher, domain, size, size, size);
    mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
    mesher->SetDomainAngle(angle);
    expectAreas(surface, {{"Room", 92}, {"Inlet", 1}, {"Outlet", 1}}, 3);
  }
}

TEST_F(OverlappingSurfaces, ThatAreEqualKeepTheFirstAndThatIsSaid)
{
  TriangleSurface surface;
  addSheet(surface, "First", {-2, 0, 1}, {4, 0, 0}, {0, 0, 2});
  addSheet(surface, "Second", {-2, 0, 1}, {0, 0, 2}, {4, 0, 0});
  setGrid(mesher, Box3(Vec3(-5, -4, 0), Vec3(5, 4, 4)), size, 2 * size, 1.0);
  expectAreas(surface, {{"First", 16}, {"Second", 0}}, 1);
  EXPECT_THAT(inputWarnings(), HasSubstr("'First' and 'Second' lie upon each other in 8 square meters"));
}

TEST_F(OverlappingSurfaces, AreOpenedByFaceZonesThatAreSmaller)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {-5, 0, 0}, {10, 0, 0}, {0, 0, 4});
  addSheet(surface, "Door", {-1, 0, 0}, {1, 0, 0}, {0, 0, 2});
  addSheet(surface, "Whole", {-5, 0, 0}, {0, 0, 4}, {10, 0, 0});
  setGrid(mesher, Box3(Vec3(-5, -4, 0), Vec3(5, 4, 4)), size, 2 * size, 1.0);
  mesher->AddFaceZone("Door");
  mesher->AddFaceZone("Whole");
  expectAreas(surface, {{"Wall", 76}, {"Door", 2}, {"Whole", 0}}, 3);
  EXPECT_THAT(inputWarnings(), HasSubstr("the face zone 'Door' opens the wall 'Wall', on which it lies, in 2 square"));
  EXPECT_THAT(inputWarnings(), HasSubstr("the face zone 'Whole' lies on the wall 'Wall' in 38 square meters"));
}

} // namespace
