// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones, rooms and cell zones of meshes of buildings that are known, along the axes and turned, without and with
/// layers.
#include "Support/Buildings.h"
#include "Support/DualMeshChecks.h"

#include "Mesher/MeshModel.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <map>
#include <numbers>
#include <set>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addSphere;
using atria::testing::addWall;
using atria::testing::addWalls;
using atria::testing::Hole;
using atria::testing::isConformal;
using atria::testing::isValid;
using atria::testing::volumes;
using ::testing::UnorderedElementsAre;

constexpr double size = 0.25;
const Vec3 low(-2.1, -3.1, 0);
const Vec3 high(2.4, 2.5, 3);

MesherOptions optionsOf(int layers)
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = {Vec3(-7, -7, 0), Vec3(7, 7, 7)};
  options.sizes.sizeMin = size;
  options.sizes.sizeMid = 2.0 * size;
  options.sizes.sizeMax = 1.0;
  options.mesh.layers = {{"*", {layers}}};
  return options;
}

MeshedModel meshed(const TriangleSurface& surface, const MesherOptions& options, int threads = 2)
{
  const ThreadExecutor executor(threads);
  return meshModel(surface, options, atria::testing::quietContext(executor));
}

const Room& roomOf(const MeshedModel& mesh, const std::string& name)
{
  const auto& rooms = mesh.rooms.rooms;
  return *std::find_if(rooms.begin(), rooms.end(), [&](const Room& room) { return room.name == name; });
}

/// The openings and the rooms at their backs and fronts, by name.
std::map<std::string, std::pair<std::string, std::string>> connections(const MeshedModel& mesh)
{
  std::map<std::string, std::pair<std::string, std::string>> out;
  for (const RoomOpening& opening : mesh.rooms.openings)
  {
    const auto name = [&](int side) {
      return opening.rooms[side] < 0 ? std::string() : mesh.rooms.rooms[opening.rooms[side]].name;
    };
    out[mesh.names[opening.surface]] = {name(0), name(1)};
  }
  return out;
}

Vec3 areaOf(const DualMesh& mesh, const ZoneFace& zone)
{
  const ReducedFace face = faceOf(mesh.corners[zone.element], zone.direction);
  Vec3 area = Vec3::Zero();
  for (int i = 0; i < face.count; ++i)
  {
    area += 0.5 * mesh.points[face.points[i]].cross(mesh.points[face.points[(i + 1) % face.count]]);
  }
  return area;
}

/// Area vectors of face zones, from the back of their surfaces to the front.
std::map<std::string, Vec3> zoneAreas(const MeshedModel& mesh)
{
  std::map<std::string, Vec3> areas;
  for (const ZoneFace& face : mesh.mesh.zoneFaces)
  {
    const double sign = face.side == SheetSide::back ? 1.0 : -1.0;
    areas.try_emplace(mesh.names[face.tag], Vec3::Zero()).first->second += sign * areaOf(mesh.mesh, face);
  }
  return areas;
}

/// Elements that share a face are in one room, but where the face is of a face zone: also within layers, down to the
/// wall.
void expectRoomsEndAtZones(const MeshedModel& meshed)
{
  const DualMesh& mesh = meshed.mesh;
  std::set<std::pair<Index, int>> ofZones;
  for (const ZoneFace& face : mesh.zoneFaces)
  {
    const std::int32_t other = mesh.neighbors[face.element][face.direction];
    ASSERT_GE(other, 0);
    ASSERT_TRUE(ofZones.emplace(face.element, face.direction).second) << "twice";
    for (int d = 0; d < 6; ++d)
    {
      if (mesh.neighbors[other][d] == static_cast<std::int32_t>(face.element))
      {
        ofZones.emplace(other, d);
      }
    }
  }
  std::size_t between = 0;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (int d = 0; d < 6; ++d)
    {
      const std::int32_t other = mesh.neighbors[e][d];
      const bool differ = other >= 0 && mesh.rooms[e] != mesh.rooms[other];
      between += differ ? 1 : 0;
      ASSERT_TRUE(!differ || ofZones.count({e, d}) == 1) << "element " << e << ", side " << d;
    }
  }
  EXPECT_GT(between, 0U);
}

/// Two rooms with a window, a door to the outside, and a door between them.
TriangleSurface house()
{
  TriangleSurface surface;
  addWalls(surface, low, high, {{{{0.6, 0.9, 1.8, 2.1}}, {{3.9, 0.0, 4.8, 2.1}}, {}, {}}});
  const Vec3 x(high[0] - low[0], 0, 0), y(0, high[1] - low[1], 0);
  addSheet(surface, "Roof", low + Vec3(0, 0, 3), x, y);
  addSheet(surface, "Floor", low, y, x);
  addWall(surface, "Partition", low + Vec3(0, 3.2, 0), x, Vec3(0, 0, 3), {{1.5, 0.0, 2.4, 2.1}});
  return surface;
}

TEST(Rooms, OfAHouseHaveTheirVolumesFloorsAndOpenings)
{
  const double width = high[0] - low[0];
  const double deep = high[1] - low[1];
  for (const double degrees : {0.0, 17.0})
  {
    for (const int layers : {0, 1, 3})
    {
      SCOPED_TRACE("turned by " + std::to_string(degrees) + ", layers " + std::to_string(layers));
      TriangleSurface surface = house();
      atria::testing::turn(surface, degrees);
      MesherOptions options = optionsOf(layers);
      options.findOpenings = true;
      const MeshedModel mesh = meshed(surface, options);
      ASSERT_EQ(mesh.rooms.rooms.size(), 3U);
      EXPECT_EQ(mesh.rooms.rooms[0].name, "outside");
      const Room& south = roomOf(mesh, "room_1");
      const Room& north = roomOf(mesh, "room_2");
      EXPECT_NEAR(south.volume, width * 3.2 * 3.0, 0.01 * width * 3.2 * 3.0);
      EXPECT_NEAR(north.volume, width * (deep - 3.2) * 3.0, 0.01 * width * (deep - 3.2) * 3.0);
      EXPECT_NEAR(south.floorArea, width * 3.2, 0.01 * width * 3.2);
      EXPECT_NEAR(north.floorArea, width * (deep - 3.2), 0.01 * width * (deep - 3.2));
      EXPECT_NEAR(mesh.rooms.rooms[0].volume, 14.0 * 14.0 * 7.0 - width * deep * 3.0, 0.005 * 14.0 * 14.0 * 7.0);
      // Fronts of outer walls look out, that of the partition to -y.
      const std::map<std::string, std::pair<std::string, std::string>> wanted{
          {"South_opening_1", {"room_1", "outside"}},
          {"East_opening_1", {"room_2", "outside"}},
          {"Partition_opening_1", {"room_2", "room_1"}}};
      EXPECT_EQ(connections(mesh), wanted);
      EXPECT_EQ(south.openings.size(), 2U);
      EXPECT_EQ(north.openings.size(), 2U);
      const double turn = degrees * std::numbers::pi / 180.0;
      const Vec3 toSouth(std::sin(turn), -std::cos(turn), 0.0);
      const Vec3 toEast(std::cos(turn), std::sin(turn), 0.0);
      const std::map<std::string, Vec3> areas = zoneAreas(mesh);
      EXPECT_LT((areas.at("South_opening_1") - 1.44 * toSouth).norm(), 0.02 * 1.44);
      EXPECT_LT((areas.at("East_opening_1") - 1.89 * toEast).norm(), 0.02 * 1.89);
      EXPECT_LT((areas.at("Partition_opening_1") - 1.89 * toSouth).norm(), 0.02 * 1.89);
      for (const RoomOpening& opening : mesh.rooms.openings)
      {
        EXPECT_NEAR(opening.area, areas.at(mesh.names[opening.surface]).norm(), 1e-6);
        EXPECT_EQ(mesh.names[opening.surface], mesh.names[opening.wall] + "_opening_1");
      }
      expectRoomsEndAtZones(mesh);
      EXPECT_TRUE(isValid(mesh.mesh, 0));
    }
  }
}

TEST(Rooms, AreTheSameForAnyNumberOfThreads)
{
  TriangleSurface surface = house();
  atria::testing::turn(surface, 17.0);
  MesherOptions options = optionsOf(1);
  options.findOpenings = true;
  EXPECT_TRUE(atria::testing::identical(meshed(surface, options, 1).mesh, meshed(surface, options, 3).mesh));
}

/// Three storeys with an atrium, and a hatch from the lowest to the one above.
TEST(Rooms, AreStoreysWhereSlabsHaveHoles)
{
  TriangleSurface surface;
  const Vec3 top(2.4, 2.5, 6);
  addWalls(surface, low, top, {{{{1.0, 0.7, 2.2, 1.5}}, {}, {}, {}}});
  const Vec3 x(high[0] - low[0], 0, 0), y(0, high[1] - low[1], 0);
  addSheet(surface, "Roof", low + Vec3(0, 0, 6), x, y);
  const Hole atrium{1.2, 1.4, 3.1, 3.8};
  addWall(surface, "First", low + Vec3(0, 0, 2), x, y, {atrium, {3.5, 4.4, 4.2, 5.1}});
  addWall(surface, "Second", low + Vec3(0, 0, 4), x, y, {atrium});
  MesherOptions options = optionsOf(0);
  options.findOpenings = true;
  const MeshedModel mesh = meshed(surface, options);
  ASSERT_EQ(mesh.rooms.rooms.size(), 4U);
  const auto found = connections(mesh);
  ASSERT_EQ(found.size(), 4U);
  // The fronts of slabs look up: the storeys follow each other.
  const auto [lowest, outside] = found.at("South_opening_1");
  EXPECT_EQ(outside, "outside");
  EXPECT_EQ(found.at("First_opening_1").first, lowest);
  EXPECT_EQ(found.at("First_opening_2"), found.at("First_opening_1"));
  EXPECT_EQ(found.at("Second_opening_1").first, found.at("First_opening_1").second);
  const double storey = x[0] * y[1] * 2.0;
  for (const Room& room : mesh.rooms.rooms)
  {
    EXPECT_TRUE(room.name == "outside" || std::abs(room.volume - storey) < 0.02 * storey) << room.name;
  }
  expectRoomsEndAtZones(mesh);
}

/// A door that stands ajar, a window round the corner of two walls, and a slot one element wide.
TEST(Rooms, HaveOpeningsOfOddShapes)
{
  const double width = high[0] - low[0];
  const double deep = high[1] - low[1];
  const double volume = width * deep * 3.0;
  for (const double degrees : {0.0, 17.0})
  {
    for (const int layers : {0, 1})
    {
      SCOPED_TRACE("turned by " + std::to_string(degrees) + ", layers " + std::to_string(layers));
      TriangleSurface surface;
      const std::vector<Hole> north{{1.0, 0.0, 1.9, 2.1}};
      const std::vector<Hole> west{{2.0, 0.8, 2.0 + size, 2.0}};
      addWalls(surface, low, high, {{{{3.3, 1.0, width, 2.0}}, {{0.0, 1.0, 1.4, 2.0}}, north, west}});
      const Vec3 x(width, 0, 0), y(0, deep, 0);
      addSheet(surface, "Roof", low + Vec3(0, 0, 3), x, y);
      addSheet(surface, "Floor", low, y, x);
      addSheet(surface, "Leaf", Vec3(high[0] - 1.0, high[1], 0), Vec3(-0.54, 0.72, 0), Vec3(0, 0, 2.1));
      atria::testing::turn(surface, degrees);
      MesherOptions options = optionsOf(layers);
      options.findOpenings = true;
      const MeshedModel mesh = meshed(surface, options);
      const std::pair<std::string, std::string> outwards{"room_1", "outside"};
      const std::map<std::string, std::pair<std::string, std::string>> wanted{{"South_opening_1", outwards},
                                                                              {"East_opening_1", outwards},
                                                                              {"North_opening_1", outwards},
                                                                              {"West_opening_1", outwards}};
      EXPECT_EQ(connections(mesh), wanted);
      EXPECT_EQ(mesh.rooms.rooms.size(), 2U);
      EXPECT_NEAR(roomOf(mesh, "room_1").volume, volume, 0.01 * volume);
      const std::map<std::string, double> areas{{"South_opening_1", width - 3.3},
                                                {"East_opening_1", 1.4},
                                                {"North_opening_1", 0.9 * 2.1},
                                                {"West_opening_1", 1.2 * size}};
      for (const RoomOpening& opening : mesh.rooms.openings)
      {
        const auto known = areas.find(mesh.names[opening.surface]);
        ASSERT_NE(known, areas.end());
        EXPECT_NEAR(opening.area, known->second, 0.03 * known->second) << known->first;
      }
      expectRoomsEndAtZones(mesh);
      EXPECT_TRUE(isValid(mesh.mesh, 0));
    }
  }
}

TEST(Rooms, HaveTheNameOfTheGroupThatTheirSurfacesAreOf)
{
  TriangleSurface surface = house();
  for (std::string& name : surface.names)
  {
    name = "Ground/" + name;
  }
  MesherOptions options = optionsOf(0);
  options.findOpenings = true;
  const MeshedModel mesh = meshed(surface, options);
  std::vector<std::string> names;
  for (const Room& room : mesh.rooms.rooms)
  {
    names.push_back(room.name);
  }
  EXPECT_THAT(names, UnorderedElementsAre("outside", "Ground", "Ground_2"));
}

TEST(Rooms, WithoutOpeningsAreNotLookedForAndTheMeshKeepsItsBits)
{
  TriangleSurface surface;
  addBox(surface, "House", {low, high});
  addSheet(surface, "Fence", Vec3(-5, 4, 0), Vec3(9, 1, 0), Vec3(0, 0, 1.8));
  MesherOptions options = optionsOf(1);
  const MeshedModel without = meshed(surface, options);
  EXPECT_TRUE(without.rooms.rooms.empty());
  EXPECT_TRUE(without.mesh.rooms.empty());
  options.findOpenings = true;
  EXPECT_TRUE(atria::testing::identical(without.mesh, meshed(surface, options).mesh));
}

/// A screen in the open, one that stands on a wall, and a wall: only this parts anything.
TEST(FaceZones, ConformToTheirSurfaceAndPartNothing)
{
  for (const double degrees : {0.0, 17.0})
  {
    for (const int layers : {0, 1, 3})
    {
      SCOPED_TRACE("turned by " + std::to_string(degrees) + ", layers " + std::to_string(layers));
      TriangleSurface surface;
      addBox(surface, "House", {Vec3(-2.1, -1.1, 0), Vec3(0.9, 1.2, 2.3)});
      addSheet(surface, "Screen", Vec3(2.1, -1.5, 0.7), Vec3(0.4, 2.6, 0), Vec3(0, 0, 1.9));
      addSheet(surface, "Plane", Vec3(-0.4, 1.2, 0), Vec3(0, 2.3, 0), Vec3(0, 0, 1.6));
      atria::testing::turn(surface, degrees);
      MesherOptions options = optionsOf(layers);
      options.faceZones = {"Screen", "Pl*"};
      const MeshedModel mesh = meshed(surface, options);
      for (const BoundaryFace& face : mesh.mesh.boundaryFaces)
      {
        ASSERT_NE(face.tag, 1U);
        ASSERT_NE(face.tag, 2U);
      }
      const std::map<std::string, Vec3> areas = zoneAreas(mesh);
      const double turn = degrees * std::numbers::pi / 180.0;
      const auto turned = [&](const Vec3& v) { return Vec3(Eigen::AngleAxisd(turn, Vec3::UnitZ()) * v); };
      const Vec3 screen = turned(Vec3(0.4, 2.6, 0).cross(Vec3(0, 0, 1.9)));
      const Vec3 plane = turned(Vec3(2.3 * 1.6, 0, 0));
      EXPECT_LT((areas.at("Screen") - screen).norm(), 0.02 * screen.norm());
      EXPECT_LT((areas.at("Plane") - plane).norm(), 0.03 * plane.norm());
      EXPECT_EQ(mesh.rooms.rooms.size(), 1U);
      const double box = 3.0 * 2.3 * 2.3;
      EXPECT_NEAR(atria::testing::totalVolume(mesh.mesh), 14.0 * 14.0 * 7.0 - box, 0.01 * box);
      EXPECT_TRUE(isValid(mesh.mesh, 0));
    }
  }
}

TEST(FaceZones, AreToMatchSurfaces)
{
  TriangleSurface surface;
  addBox(surface, "House", {low, high});
  MesherOptions options = optionsOf(0);
  options.faceZones = {"Screen"};
  EXPECT_THROW(meshed(surface, options), Error);
  options.faceZones = {"House"};
  options.cellZones = {"House"};
  EXPECT_THROW(meshed(surface, options), Error);
}

double enclosedVolume(const TriangleSurface& surface, Index id)
{
  double volume = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    volume +=
        surface.surfaceIds[t] == id ? surface.points[a].dot(surface.points[b].cross(surface.points[c])) / 6.0 : 0.0;
  }
  return volume;
}

/// Volumes by name, "" for elements in no cell zone.
std::map<std::string, double> volumesOfCellZones(const MeshedModel& mesh)
{
  std::map<std::string, double> inside;
  const std::vector<double> all = volumes(mesh.mesh);
  for (std::size_t e = 0; e < all.size(); ++e)
  {
    const std::int32_t zone = mesh.mesh.cellZones[e];
    inside[zone < 0 ? "" : mesh.names[static_cast<std::size_t>(zone)]] += all[e];
  }
  return inside;
}

/// A round tree, and a hedge that stands on the ground and touches a house.
TEST(CellZones, AreWhatTheirSurfacesEnclose)
{
  for (const int layers : {0, 1})
  {
    TriangleSurface surface;
    addBox(surface, "House", {Vec3(-4, -2, 0), Vec3(-1, 2, 2.5)});
    addSphere(surface, "Tree", Vec3(2.6, 0.1, 2.4), 1.4, 3);
    addBox(surface, "Hedge", {Vec3(-1, -3, 0), Vec3(0, 3, 1.2)});
    MesherOptions options = optionsOf(layers);
    options.cellZones = {"Tree", "Hedge"};
    options.sizing.surfaceSizes = {{"Tree", 0.25, {}}};
    const MeshedModel mesh = meshed(surface, options);
    const std::map<std::string, double> inside = volumesOfCellZones(mesh);
    // Square faces with corners on a sphere are at most size^2 / 4 radius inside of it.
    EXPECT_NEAR(inside.at("Tree"), enclosedVolume(surface, 1), std::numbers::pi * 1.4 * size * size);
    EXPECT_NEAR(inside.at("Hedge"), 7.2, 0.1);
    EXPECT_NEAR(atria::testing::totalVolume(mesh.mesh), 14.0 * 14.0 * 7.0 - 30.0, 0.3);
    EXPECT_TRUE(mesh.rooms.rooms.empty());
    EXPECT_TRUE(isValid(mesh.mesh, 0));
  }
}

/// A rack and a tank, of which each has a part of a face in common with the other and with a house that is not meshed.
TEST(CellZones, ShareFacesWithWallsAndWithEachOther)
{
  for (const double degrees : {0.0, 17.0})
  {
    for (const int houseAt : {0, 1, 2})
    {
      SCOPED_TRACE("turned by " + std::to_string(degrees) + ", house at " + std::to_string(houseAt));
      TriangleSurface surface;
      const std::vector<std::pair<const char*, Box3>> zones{{"Rack", {Vec3(-1, -1.6, 0), Vec3(0.1, 1.2, 1.2)}},
                                                            {"Tank", {Vec3(-2.3, 1.2, 0.5), Vec3(1.3, 2.4, 2.1)}}};
      for (int i = 0; i < 3; ++i)
      {
        const auto zone = static_cast<std::size_t>(i < houseAt ? i : i - 1);
        i == houseAt ? addBox(surface, "House", {Vec3(-4, -2, 0), Vec3(-1, 1.2, 2.5)})
                     : addBox(surface, zones[zone].first, zones[zone].second);
      }
      atria::testing::turn(surface, degrees);
      MesherOptions options = optionsOf(houseAt == 1 ? 1 : 0);
      options.cellZones = {"Rack", "Tank"};
      const MeshedModel mesh = meshed(surface, options);
      const std::map<std::string, double> inside = volumesOfCellZones(mesh);
      for (const auto& [name, box] : zones)
      {
        const double volume = box.size().prod();
        EXPECT_NEAR(inside.at(name), volume, 0.03 * volume) << name;
      }
      EXPECT_NEAR(atria::testing::totalVolume(mesh.mesh), 14.0 * 14.0 * 7.0 - 24.0, 0.3);
      EXPECT_TRUE(isValid(mesh.mesh, 0));
    }
  }
}

TEST(CellZones, WithoutElementsAreWarnedOf)
{
  TriangleSurface surface;
  addBox(surface, "Hedge", {Vec3(-1, -3, 0), Vec3(0, 3, 1.2)});
  addBox(surface, "Fan", {Vec3(2.26, 1.26, 1.76), Vec3(2.3, 1.3, 1.8)});
  MesherOptions options = optionsOf(0);
  options.cellZones = {"Hedge", "Fan"};
  const MeshedModel mesh = meshed(surface, options);
  ASSERT_EQ(mesh.inputWarnings.size(), 1u);
  EXPECT_NE(mesh.inputWarnings.front().find("cell zone 'Fan' holds no element"), std::string::npos);
}

TEST(CellZones, OfSurfacesWithHolesAreAnError)
{
  TriangleSurface surface;
  addWalls(surface, low, high, {});
  MesherOptions options = optionsOf(0);
  options.cellZones = {"South"};
  EXPECT_THROW(meshed(surface, options), Error);
}

} // namespace
