// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones, openings, rooms and cell zones of meshes that several ranks make together.
#include "Ranks/SharedModel.h"
#include "Support/Buildings.h"
#include "Support/DualMeshChecks.h"
#include "Support/PieceOf.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <random>
#include <string>

namespace {

using namespace atria;
using namespace atria::testing;

MesherOptions optionsOf(const Box3& domain, double size, int layers)
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = domain;
  options.sizes.sizeMin = size;
  options.sizes.sizeMid = 2.0 * size;
  options.sizes.sizeMax = 1.0;
  options.mesh.layers = {{"*", {layers}}};
  options.mesh.blockSize = 1000;
  return options;
}

void expectRooms(const RoomReport& whole, const RoomReport& shared)
{
  EXPECT_EQ(shared.hasOutside, whole.hasOutside);
  EXPECT_EQ(shared.found, whole.found);
  ASSERT_EQ(shared.rooms.size(), whole.rooms.size());
  for (std::size_t i = 0; i < whole.rooms.size(); ++i)
  {
    EXPECT_EQ(shared.rooms[i].name, whole.rooms[i].name);
    EXPECT_EQ(shared.rooms[i].volume, whole.rooms[i].volume);
    EXPECT_EQ(shared.rooms[i].floorArea, whole.rooms[i].floorArea);
    EXPECT_EQ(shared.rooms[i].openings, whole.rooms[i].openings);
  }
  ASSERT_EQ(shared.openings.size(), whole.openings.size());
  for (std::size_t i = 0; i < whole.openings.size(); ++i)
  {
    EXPECT_EQ(shared.openings[i].surface, whole.openings[i].surface);
    EXPECT_EQ(shared.openings[i].wall, whole.openings[i].wall);
    EXPECT_EQ(shared.openings[i].area, whole.openings[i].area);
    EXPECT_EQ(shared.openings[i].rooms, whole.openings[i].rooms);
  }
}

void expectMet(const std::vector<MetSides>& whole, const std::vector<MetSides>& shared)
{
  ASSERT_EQ(shared.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    EXPECT_EQ(shared[i].front, whole[i].front);
    EXPECT_EQ(shared[i].back, whole[i].back);
    EXPECT_EQ(shared[i].atOnce, whole[i].atOnce);
    EXPECT_EQ(shared[i].within, whole[i].within);
  }
}

/// Returns the whole, or nothing where it is an error, on ranks too.
std::optional<MeshedModel> expectSameOnRanks(const TriangleSurface& surface, const MesherOptions& options, int ranks)
{
  const auto makeOnRanks = [&](RankExchange& exchange) {
    return meshSharedModel(surface, options, 1, exchange, quietContext());
  };
  std::optional<MeshedModel> whole;
  try
  {
    whole = meshModel(surface, options, quietContext());
  }
  catch (const Error& error)
  {
    const std::string message = error.what();
    onRanks(ranks, [&](RankExchange& exchange) {
      try
      {
        makeOnRanks(exchange);
        ADD_FAILURE() << "ranks made a mesh where one process has: " << message;
      }
      catch (const Error& shared)
      {
        EXPECT_EQ(shared.what(), message);
      }
    });
    return whole;
  }
  std::atomic<std::size_t> zoneFaces = 0;
  onRanks(ranks, [&](RankExchange& exchange) {
    const SharedModel made = makeOnRanks(exchange).value();
    expectPiece(whole->mesh, made.piece, exchange.rank());
    expectRooms(whole->rooms, made.meshed.rooms);
    expectMet(whole->metSides, made.meshed.metSides);
    EXPECT_EQ(made.meshed.names, whole->names);
    EXPECT_EQ(made.meshed.inputWarnings, whole->inputWarnings);
    zoneFaces += made.piece.mesh.zoneFaces.size();
  });
  EXPECT_EQ(zoneFaces, whole->mesh.zoneFaces.size());
  return whole;
}

/// Two rooms with a window, a door to the outside, and a door between them.
void addHouse(TriangleSurface& surface, const Vec3& low)
{
  const Vec3 high = low + Vec3(4.5, 5.6, 3.0);
  addWalls(surface, low, high, {{{{0.6, 0.9, 1.8, 2.1}}, {{3.9, 0.0, 4.8, 2.1}}, {}, {}}});
  const Vec3 x(4.5, 0, 0), y(0, 5.6, 0);
  addSheet(surface, "Roof", low + Vec3(0, 0, 3), x, y);
  addSheet(surface, "Floor", low, y, x);
  addWall(surface, "Partition", low + Vec3(0, 3.2, 0), x, Vec3(0, 0, 3), {{1.5, 0.0, 2.4, 2.1}});
}

class SharedRooms : public OnNumbersOfRanks
{
};

TEST_P(SharedRooms, OfAHouseAreThoseOfOneRank)
{
  for (const double degrees : {0.0, 17.0})
  {
    for (const int layers : {0, 1, 3})
    {
      SCOPED_TRACE("turned by " + std::to_string(degrees) + ", layers " + std::to_string(layers));
      TriangleSurface surface;
      addHouse(surface, Vec3(-2.1, -3.1, 0));
      turn(surface, degrees);
      MesherOptions options = optionsOf({Vec3(-7, -7, 0), Vec3(7, 7, 7)}, 0.25, layers);
      options.findOpenings = true;
      const auto whole = expectSameOnRanks(surface, options, GetParam());
      ASSERT_TRUE(whole.has_value());
      EXPECT_EQ(whole->rooms.rooms.size(), 3U);
      EXPECT_EQ(whole->rooms.openings.size(), 3U);
    }
  }
}

TEST_P(SharedRooms, AndCellZonesAreThoseOfOneRank)
{
  for (const int layers : {0, 1})
  {
    SCOPED_TRACE(layers);
    TriangleSurface surface;
    addBox(surface, "House", {Vec3(-4, -2, 0), Vec3(-1, 2, 2.5)});
    addSphere(surface, "Tree", Vec3(2.6, 0.1, 2.4), 1.4, 3);
    addBox(surface, "Hedge", {Vec3(-1, -3, 0), Vec3(0, 3, 1.2)});
    addBox(surface, "Air", {Vec3(-9, -9, 3.1), Vec3(9, 9, 9)}); // reaches beyond the domain
    addBox(surface, "Fan", {Vec3(2.26, 4.26, 1.76), Vec3(2.3, 4.3, 1.8)});
    addSheet(surface, "Screen", Vec3(-6.5, -5.5, 0.7), Vec3(12.4, 1.6, 0), Vec3(0, 0, 1.9));
    MesherOptions options = optionsOf({Vec3(-7, -7, 0), Vec3(7, 7, 7)}, 0.25, layers);
    options.cellZones = {"Tree", "Hedge", "Air", "Fan"};
    options.faceZones = {"Screen"};
    const auto whole = expectSameOnRanks(surface, options, GetParam());
    ASSERT_TRUE(whole.has_value());
    EXPECT_EQ(whole->inputWarnings.size(), 2U); // of the air's bounds, and of the fan, which is smaller than elements
    for (const Index zone : {1, 2, 3})
    {
      EXPECT_GT(std::ranges::count(whole->mesh.cellZones, static_cast<std::int32_t>(zone)), 50);
    }
    EXPECT_EQ(whole->rooms.rooms.size(), 1U);
  }
}

TEST_P(SharedRooms, AndCellZonesThatShareFacesAreThoseOfOneRank)
{
  for (const double degrees : {0.0, 17.0})
  {
    SCOPED_TRACE("turned by " + std::to_string(degrees));
    TriangleSurface surface;
    addBox(surface, "Tank", {Vec3(-2.3, 1.2, 0.5), Vec3(1.3, 2.4, 2.1)});
    addBox(surface, "House", {Vec3(-4, -2, 0), Vec3(-1, 1.2, 2.5)});
    addBox(surface, "Rack", {Vec3(-1, -1.6, 0), Vec3(0.1, 1.2, 1.2)});
    turn(surface, degrees);
    MesherOptions options = optionsOf({Vec3(-7, -7, 0), Vec3(7, 7, 7)}, 0.25, 0);
    options.mesh.zoneRule = ZoneRule::all; // the house, too, in which nothing of the zones is
    options.cellZones = {"Rack", "Tank"};
    const auto whole = expectSameOnRanks(surface, options, GetParam());
    ASSERT_TRUE(whole.has_value());
    for (const Index zone : {0, 2})
    {
      EXPECT_GT(std::ranges::count(whole->mesh.cellZones, static_cast<std::int32_t>(zone)), 100);
    }
  }
}

TEST_P(SharedRooms, OfSoupsAreThoseOfOneRank)
{
  std::size_t meshes = 0;
  std::size_t withZoneFaces = 0;
  std::size_t withCellZones = 0;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    SCOPED_TRACE(seed);
    const TriangleSurface surface = randomSoup(seed);
    MesherOptions options = optionsOf({Vec3::Constant(-4.3), Vec3::Constant(4.1)}, 0.15, seed % 3 == 0 ? 1 : 0);
    options.mesh.blockSize = 300;
    options.mesh.zoneRule = seed % 2 == 0 ? ZoneRule::all : ZoneRule::outside;
    std::mt19937 random(seed);
    for (const std::string& name : surface.names)
    {
      const unsigned kind = random() % 3;
      if (kind > 0)
      {
        (kind == 1 ? options.faceZones : options.cellZones).push_back(name);
      }
    }
    if (const auto whole = expectSameOnRanks(surface, options, GetParam()))
    {
      ++meshes;
      withZoneFaces += whole->mesh.zoneFaces.empty() ? 0 : 1;
      withCellZones += std::ranges::count(whole->mesh.cellZones, -1) < std::ssize(whole->mesh.cellZones) ? 1 : 0;
    }
  }
  EXPECT_GE(meshes, 4U);
  EXPECT_GE(withZoneFaces, 3U);
  EXPECT_GE(withCellZones, 2U);
}

TEST(SharedRoomsOfASite, AreMadeOfPartsOfTheOctree)
{
  constexpr int houses = 6;
  constexpr double distance = 9.0;
  TriangleSurface surface;
  for (int i = 0; i < houses; ++i)
  {
    const std::size_t first = surface.names.size();
    addHouse(surface, Vec3(i * distance, 0.3, 0.0));
    for (std::size_t name = first; name < surface.names.size(); ++name)
    {
      surface.names[name] = "House" + std::to_string(i) + "/" + surface.names[name];
    }
  }
  addBox(surface, "Hedge", {Vec3(-1.5, 6.6, 0.0), Vec3(houses * distance - 2.6, 7.6, 1.4)});
  for (const int layers : {0, 1})
  {
    SCOPED_TRACE(layers);
    MesherOptions options = optionsOf({Vec3(-4, -3, 0), Vec3(houses * distance, 10, 5)}, 0.25, layers);
    options.sizes.sizeMid = options.sizes.sizeMin;
    options.findOpenings = true;
    options.cellZones = {"Hedge"};
    const auto whole = expectSameOnRanks(surface, options, 4);
    ASSERT_TRUE(whole.has_value());
    EXPECT_EQ(whole->rooms.rooms.size(), 1U + 2U * houses);
    EXPECT_EQ(whole->rooms.openings.size(), 3U * houses);
  }
}

TEST(SharedCellZones, OfSurfacesWithHolesAreAnErrorOnAllRanks)
{
  TriangleSurface surface;
  addBox(surface, "Hedge", {Vec3(-6.1, -3, 0.5), Vec3(6.2, 3, 1.9)});
  addBox(surface, "House", {Vec3(-2.1, 4.1, 0), Vec3(0.9, 5.2, 2.3)});
  MesherOptions options = optionsOf({Vec3(-7, -7, 0), Vec3(7, 7, 7)}, 0.25, 0);
  options.cellZones = {"Hedge"};
  EXPECT_TRUE(expectSameOnRanks(surface, options, 3).has_value());
  for (std::size_t missing = 0; missing < 12; missing += 5)
  {
    SCOPED_TRACE(missing);
    TriangleSurface open = surface;
    open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(missing));
    open.surfaceIds.erase(open.surfaceIds.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_FALSE(expectSameOnRanks(open, options, 3).has_value());
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedRooms, ::testing::Values(1, 2, 3, 5),
                         [](const auto& one) { return std::to_string(one.param); });

} // namespace
