// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of models whose surfaces lie upon each other: areas by name within 0.5 %, whatever the order of surfaces.
#include "Mesher/MeshModel.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Support/Text.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <map>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addSheet;
using ::testing::HasSubstr;
using ::testing::Not;

using Areas = std::map<std::string, double>;

constexpr double size = 0.25;

/// Surfaces rotated by as many places, so that others come first; in odd orders every other one is wound the other way.
TriangleSurface ordered(const TriangleSurface& surface, Index places)
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

MesherOptions optionsIn(const Box3& domain, double sizeMax = 1.0)
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = domain;
  options.sizes.sizeMin = size;
  options.sizes.sizeMid = std::min(2.0 * size, sizeMax);
  options.sizes.sizeMax = sizeMax;
  options.mesh.layers = {{"*", {0}}};
  return options;
}

double areaOf(const DualMesh& mesh, Index element, int direction)
{
  const ReducedFace face = faceOf(mesh.corners[element], direction);
  Vec3 area = Vec3::Zero();
  for (int i = 0; i < face.count; ++i)
  {
    area += 0.5 * mesh.points[face.points[i]].cross(mesh.points[face.points[(i + 1) % face.count]]);
  }
  return area.norm();
}

/// Of both sides of sheets, and once of faces within the mesh.
Areas areasOf(const MeshedModel& meshed)
{
  Areas areas;
  for (const BoundaryFace& face : meshed.mesh.boundaryFaces)
  {
    if (face.tag < meshed.names.size())
    {
      areas[meshed.names[face.tag]] += areaOf(meshed.mesh, face.element, face.direction);
    }
  }
  for (const ZoneFace& face : meshed.mesh.zoneFaces)
  {
    areas[meshed.names[face.tag]] += areaOf(meshed.mesh, face.element, face.direction);
  }
  return areas;
}

/// Returns the warnings of the last mesh.
std::string expectAreas(const TriangleSurface& surface, const MesherOptions& options, const Areas& wanted, Index orders)
{
  std::string warnings;
  for (Index places = 0; places < orders; ++places)
  {
    SCOPED_TRACE("order " + std::to_string(places));
    const ThreadExecutor executor(2);
    const MeshedModel meshed = meshModel(ordered(surface, places), options, atria::testing::quietContext(executor));
    const Areas found = areasOf(meshed);
    for (const auto& [name, area] : wanted)
    {
      const double actual = found.contains(name) ? found.at(name) : 0.0;
      EXPECT_NEAR(actual, area, 0.005 * area) << name;
    }
    warnings = joined(meshed.inputWarnings, "\n");
  }
  return warnings;
}

/// A building of which no wall is cut: a window on one wall, one across two, and a pane that covers a side.
TEST(OverlapMeshes, OfABuildingHaveTheAreasOfACutOne)
{
  for (const double angle : {0.0, 17.0, 30.0, 45.0})
  {
    SCOPED_TRACE(angle);
    TriangleSurface surface;
    addSheet(surface, "Left", {-3, -2, 0}, {3, 0, 0}, {0, 0, 3});
    addSheet(surface, "Right", {0, -2, 0}, {3, 0, 0}, {0, 0, 3});
    addSheet(surface, "Walls", {-3, -2, 0}, {0, 4, 0}, {0, 0, 3});
    addSheet(surface, "Walls", {-3, 2, 0}, {6, 0, 0}, {0, 0, 3});
    addSheet(surface, "Walls", {3, -2, 0}, {0, 4, 0}, {0, 0, 3});
    std::fill(surface.surfaceIds.begin() + 6, surface.surfaceIds.end(), 2); // one surface
    surface.names.resize(3);
    addSheet(surface, "Roof", {-3, -2, 3}, {6, 0, 0}, {0, 4, 0});
    addSheet(surface, "Window", {-2.5, -2, 1}, {1, 0, 0}, {0, 0, 1.5});
    addSheet(surface, "Across", {-0.75, -2, 0.75}, {2, 0, 0}, {0, 0, 1});
    addSheet(surface, "Pane", {3, -2, 0}, {0, 4, 0}, {0, 0, 3});
    atria::testing::turn(surface, angle);
    const Areas wanted{{"Left", 9 - 1.5 - 0.75}, {"Right", 9 - 1.25}, {"Walls", 42 - 12}, {"Roof", 24},
                       {"Window", 1.5},          {"Across", 2},       {"Pane", 12}};
    const std::string warnings =
        expectAreas(surface, optionsIn({Vec3(-6, -6, 0), Vec3(6, 6, 5)}), wanted, angle == 17.0 ? Index{7} : Index{2});
    EXPECT_THAT(warnings, Not(HasSubstr("upon each other")));
  }
}

/// A room whose walls are the sides of the domain, and the same turned.
TEST(OverlapMeshes, OfARoomNameTheSidesOfTheDomain)
{
  for (const double angle : {0.0, 30.0})
  {
    SCOPED_TRACE(angle);
    TriangleSurface surface;
    addBox(surface, "Room", {{0, 0, 0}, {5, 4, 3}});
    addSheet(surface, "Inlet", {0, 1, 1}, {0, 0, 1}, {0, 1, 0});
    addSheet(surface, "Outlet", {5, 1, 1}, {0, 1, 0}, {0, 0, 1});
    atria::testing::turn(surface, angle);
    MesherOptions options = optionsIn({}, size);
    options.site.mode = DomainMode::surfaces;
    options.site.domainAngle = angle;
    expectAreas(surface, options, {{"Room", 92}, {"Inlet", 1}, {"Outlet", 1}}, 3);
  }
}

TEST(OverlapMeshes, OfEqualSurfacesKeepTheFirstAndSaySo)
{
  TriangleSurface surface;
  addSheet(surface, "First", {-2, 0, 1}, {4, 0, 0}, {0, 0, 2});
  addSheet(surface, "Second", {-2, 0, 1}, {0, 0, 2}, {4, 0, 0});
  const std::string warnings =
      expectAreas(surface, optionsIn({Vec3(-5, -4, 0), Vec3(5, 4, 4)}), {{"First", 16}, {"Second", 0}}, 1);
  EXPECT_THAT(warnings, HasSubstr("'First' and 'Second' lie upon each other in 8 square meters"));
}

TEST(OverlapMeshes, AreOpenWhereAFaceZoneIsSmallerThanItsWall)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {-5, 0, 0}, {10, 0, 0}, {0, 0, 4});
  addSheet(surface, "Door", {-1, 0, 0}, {1, 0, 0}, {0, 0, 2});
  addSheet(surface, "Whole", {-5, 0, 0}, {0, 0, 4}, {10, 0, 0});
  MesherOptions options = optionsIn({Vec3(-5, -4, 0), Vec3(5, 4, 4)});
  options.faceZones = {"Door", "Whole"};
  const std::string warnings = expectAreas(surface, options, {{"Wall", 76}, {"Door", 2}, {"Whole", 0}}, 3);
  EXPECT_THAT(warnings, HasSubstr("the face zone 'Door' opens the wall 'Wall', on which it lies, in 2 square meters"));
  EXPECT_THAT(warnings, HasSubstr("the face zone 'Whole' lies on the wall 'Wall' in 40 square meters"));
}

} // namespace
