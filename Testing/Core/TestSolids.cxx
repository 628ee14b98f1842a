// SPDX-License-Identifier: GPL-3.0-or-later
/// Insides of solids are told from closed rooms, whatever the solids touch or sink into.
#include "Mesher/MeshModel.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Surface/Search/ClosedBodies.h"

#include <gmock/gmock.h>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Box3 domain{Vec3(-8, -8, -2), Vec3(8, 8, 8)};

MesherOptions outdoors()
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = domain;
  options.site.terrain = "Terrain*";
  options.sizes.sizeMin = options.sizes.sizeMid = 0.25;
  options.sizes.sizeMax = 1.0;
  return options;
}

void addSlope(TriangleSurface& surface)
{
  addSheet(surface, "Terrain", Vec3(-9, -9, -0.5), Vec3(18, 0, 1.9), Vec3(0, 18, 0.7));
}

void flip(TriangleSurface& surface, Index id)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.surfaceIds[t] == id)
    {
      std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    }
  }
}

/// Makes each side of a box a surface of its own: wound as `outwards` says, side by side.
void addSides(TriangleSurface& surface, const std::string& name, const Box3& box, unsigned outwards = 63)
{
  const Vec3 size = box.size();
  const Vec3 x(size[0], 0, 0), y(0, size[1], 0), z(0, 0, size[2]);
  const auto add = [&](int side, const Vec3& corner, const Vec3& u, const Vec3& v) {
    const bool isOut = (outwards >> side & 1) != 0;
    addSheet(surface, name + "/" + std::to_string(side), corner, isOut ? u : v, isOut ? v : u);
  };
  add(0, box.min, z, y);
  add(1, box.min + x, y, z);
  add(2, box.min, x, z);
  add(3, box.min + y, z, x);
  add(4, box.min, y, x);
  add(5, box.min + z, x, y);
}

std::size_t count(const MeshedModel& meshed, ZoneKind kind)
{
  return static_cast<std::size_t>(std::ranges::count(meshed.zones, kind, &ZoneSummary::kind));
}

void expectSolidsOnly(const TriangleSurface& surface, std::size_t solids, const MesherOptions& options = outdoors())
{
  const MeshedModel meshed = meshModel(surface, options, quietContext());
  EXPECT_EQ(count(meshed, ZoneKind::room), 0U);
  EXPECT_EQ(count(meshed, ZoneKind::narrow), 0U);
  EXPECT_GE(count(meshed, ZoneKind::solid), solids);
}

TEST(Solids, MaySinkIntoASlope)
{
  TriangleSurface surface;
  addSlope(surface);
  addBox(surface, "House", {Vec3(-3, -2, -1), Vec3(3, 2, 4)});
  expectSolidsOnly(surface, 1);
}

TEST(Solids, MayShareWallsWithNeighbors)
{
  for (const bool areSides : {false, true})
  {
    SCOPED_TRACE(areSides);
    TriangleSurface surface;
    addSlope(surface);
    for (int i = 0; i < 3; ++i)
    {
      const Box3 house{Vec3(-5 + 3 * i, -2, -1), Vec3(-2 + 3 * i, 2, 3 + i)};
      const std::string name = "House" + std::to_string(i);
      areSides ? addSides(surface, name, house) : addBox(surface, name, house);
    }
    expectSolidsOnly(surface, 3);
  }
}

/// Walls and a roof without a floor, one of them wound the wrong way.
TEST(Solids, MayBeOpenBelowTheGround)
{
  TriangleSurface surface;
  addSlope(surface);
  addSides(surface, "House", {Vec3(-3, -2, -1), Vec3(3, 2, 4)}, 63 & ~4);
  const auto isFloor = [&](std::size_t t) { return surface.names[surface.surfaceIds[t]] == "House/4"; };
  for (std::size_t t = surface.triangles.size(); t-- > 0;)
  {
    if (isFloor(t))
    {
      surface.triangles.erase(surface.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      surface.surfaceIds.erase(surface.surfaceIds.begin() + static_cast<std::ptrdiff_t>(t));
    }
  }
  expectSolidsOnly(surface, 1);
}

TEST(Solids, MayBeWoundEitherWay)
{
  TriangleSurface surface;
  addSlope(surface);
  addBox(surface, "House", {Vec3(-3, -2, -1), Vec3(3, 2, 4)});
  flip(surface, 1);
  addSides(surface, "Shed", {Vec3(4, -2, 0), Vec3(6.5, 2, 3.3)}, 21);
  expectSolidsOnly(surface, 2);
}

TEST(Solids, MayHoldOthers)
{
  TriangleSurface surface;
  addSlope(surface);
  addBox(surface, "Slab", {Vec3(-5, -4, 2.6), Vec3(5, 4, 4.6)});
  for (int i = 0; i < 3; ++i)
  {
    addBox(surface, "Beam" + std::to_string(i), {Vec3(-4 + 3 * i, -3.2, 3.1), Vec3(-3 + 3 * i, 3.2, 4.1)});
  }
  expectSolidsOnly(surface, 4);
}

TEST(Solids, HaveHollowsThatAreRooms)
{
  TriangleSurface surface;
  addSlope(surface);
  const Box3 hollow{Vec3(-4, -3, 1.9), Vec3(4, 3, 4.1)};
  addBox(surface, "House", {Vec3(-5, -4, -1), Vec3(5, 4, 5)});
  addBox(surface, "Room", hollow);
  flip(surface, 2);
  addBox(surface, "Table", {Vec3(-2, -1, 2.4), Vec3(2, 1, 3.4)});
  const MeshedModel meshed = meshModel(surface, outdoors(), quietContext());
  EXPECT_EQ(count(meshed, ZoneKind::room), 1U);
  EXPECT_GE(count(meshed, ZoneKind::solid), 2U) << "the wall and the table";
}

std::vector<Index> around(const TriangleSurface& surface, const Vec3& p)
{
  return ClosedBodies(
             surface, [](Index) { return true; }, 1e-6, quietContext())
      .around(p);
}

TEST(ClosedBodies, AreFoundByParity)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(0, 0, 0), Vec3(4, 4, 4)});
  addBox(surface, "Chest", {Vec3(1, 1, 1), Vec3(2, 2, 2)});
  addSheet(surface, "Sheet", Vec3(-1, -1, 3), Vec3(6, 0, 0), Vec3(0, 6, 0));
  flip(surface, 1);
  EXPECT_THAT(around(surface, Vec3(3, 3, 3.5)), ElementsAre(0));
  EXPECT_THAT(around(surface, Vec3(1.5, 1.5, 1.5)), ElementsAre(0, 1));
  EXPECT_THAT(around(surface, Vec3(2, 2, 2.5)), ElementsAre(0)) << "below an edge and a corner";
  EXPECT_THAT(around(surface, Vec3(5, 3, 3.5)), IsEmpty());
  const ClosedBodies bodies(
      surface, [](Index) { return true; }, 1e-6, quietContext());
  EXPECT_TRUE(bodies.isInside(1, 0));
  EXPECT_FALSE(bodies.isInside(0, 1));
  EXPECT_GT(bodies.bodies()[0].volume, 0.0);
  EXPECT_LT(bodies.bodies()[1].volume, 0.0);
}

TEST(ClosedBodies, AreNeitherOpenNorDoubled)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(0, 0, 0), Vec3(4, 4, 4)});
  const std::size_t once = surface.triangles.size();
  for (std::size_t t = 0; t < once; ++t) // the same once more
  {
    surface.triangles.push_back(surface.triangles[t]);
    surface.surfaceIds.push_back(0);
  }
  EXPECT_THAT(around(surface, Vec3(1, 2, 3)), ElementsAre(0));
  surface.triangles.resize(once - 1);
  surface.surfaceIds.resize(once - 1);
  EXPECT_THAT(around(surface, Vec3(1, 2, 3)), IsEmpty());
}

/// Spheres are above every point of a grid in every way: beside, through edges, and through corners.
TEST(ClosedBodies, HoldThePointsOfSpheres)
{
  TriangleSurface surface;
  addSphere(surface, "Ball", Vec3(0, 0, 0), 1.0, 2);
  const ClosedBodies bodies(
      surface, [](Index) { return true; }, 1e-6, quietContext());
  for (int i = -12; i <= 12; ++i)
  {
    for (int j = -12; j <= 12; ++j)
    {
      for (int k = -12; k <= 12; ++k)
      {
        const Vec3 p = 0.1 * Vec3(i, j, k);
        const double r = p.norm();
        if (r < 0.95 || r > 1.0)
        {
          ASSERT_EQ(bodies.around(p).size(), r < 1.0 ? 1U : 0U) << p.transpose();
        }
      }
    }
  }
}

} // namespace
