// SPDX-License-Identifier: GPL-3.0-or-later
/// Rooms whose walls are solids, in domains that are the model's bounds.
#include "Ranks/SharedModel.h"
#include "Support/DualMeshChecks.h"
#include "Support/Error.h"
#include "Support/PieceOf.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using namespace atria;
using namespace atria::testing;

const Box3 house{Vec3(0, 0, 0), Vec3(6, 5, 3)};

MesherOptions withinBounds(double size, double degrees = 0.0)
{
  MesherOptions options;
  options.site.mode = DomainMode::surfaces;
  options.site.domainAngle = degrees;
  options.site.alignment = degrees == 0.0 ? GridAlignment::axes : GridAlignment::domain;
  options.sizes.sizeMin = options.sizes.sizeMid = size;
  options.sizes.sizeMax = 2.0 * size;
  return options;
}

double volumeOf(const DualMesh& mesh)
{
  const std::vector<double> all = volumes(mesh);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

double volumeOf(const Box3& box) { return box.size().prod(); }

double meshedVolume(const TriangleSurface& surface, const MesherOptions& options)
{
  return volumeOf(meshModel(surface, options, quietContext()).mesh);
}

Box3 shrunk(const Box3& box, double by) { return {box.min.array() + by, box.max.array() - by}; }

/// Turns the triangles of the surface that was added last.
void flipLast(TriangleSurface& surface)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.surfaceIds[t] + 1 == surface.names.size())
    {
      std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    }
  }
}

/// A box whose fronts are inside.
void addHollow(TriangleSurface& surface, const std::string& name, const Box3& box)
{
  addBox(surface, name, box);
  flipLast(surface);
}

#define EXPECT_VOLUME(actual, expected) EXPECT_NEAR(actual, expected, 0.005 * (expected))

struct Pose
{
  double thickness;
  double degrees;
  bool isWoundWell;
};

class ThickWalls : public ::testing::TestWithParam<Pose>
{
};

TEST_P(ThickWalls, RoomIsMeshedAndNotTheWall)
{
  const auto& [thickness, degrees, isWoundWell] = GetParam();
  const Box3 room = shrunk(house, thickness);
  TriangleSurface surface;
  addBox(surface, "Outside", house);
  addBox(surface, "Inside", room);
  if (isWoundWell)
  {
    flipLast(surface);
  }
  turn(surface, degrees);
  const MesherOptions options = withinBounds(0.1, degrees);
  const MeshedModel meshed = meshModel(surface, options, quietContext());
  EXPECT_VOLUME(volumeOf(meshed.mesh), volumeOf(room));
  for (const ZoneSummary& zone : meshed.zones)
  {
    EXPECT_TRUE(zone.kept || zone.kind == ZoneKind::solid || zone.kind == ZoneKind::beyond)
        << "the wall is the inside of a solid";
  }
}

INSTANTIATE_TEST_SUITE_P(Poses, ThickWalls,
                         ::testing::Values(Pose{0.3, 0, true}, Pose{0.3, 0, false}, Pose{0.1, 0, true},
                                           Pose{0.1, 0, false}, Pose{0.17, 0, true}, Pose{0.3, 17, true},
                                           Pose{0.3, 17, false}, Pose{0.1, 17, true}, Pose{0.5, 17, true}));

/// The grid stands along the model's axes, the domain does not: its sides are sheets.
TEST(ThickWallsOf, DomainThatStandsTurnedInTheGridAreNotMeshed)
{
  const Box3 room = shrunk(house, 0.3);
  TriangleSurface surface;
  addBox(surface, "Outside", house);
  addHollow(surface, "Inside", room);
  turn(surface, 17.0);
  MesherOptions options = withinBounds(0.1, 17.0);
  options.site.alignment = GridAlignment::axes;
  EXPECT_VOLUME(meshedVolume(surface, options), volumeOf(room));
}

TEST(ThickWallsOf, SeveralRoomsAreNotMeshed)
{
  const std::array rooms{Box3{Vec3(0.3, 0.3, 0.3), Vec3(2.7, 4.7, 2.7)}, Box3{Vec3(3.0, 0.3, 0.3), Vec3(5.7, 2.2, 2.7)},
                         Box3{Vec3(3.0, 2.5, 0.3), Vec3(5.7, 4.7, 2.7)}};
  TriangleSurface surface;
  addBox(surface, "Outside", house);
  double sum = 0.0;
  for (const Box3& room : rooms)
  {
    addHollow(surface, "Room" + std::to_string(surface.names.size()), room);
    sum += volumeOf(room);
  }
  EXPECT_VOLUME(meshedVolume(surface, withinBounds(0.1)), sum);
}

/// Walls of a bunker are larger than its room; their winding tells.
TEST(ThickWallsOf, BunkerAreNotMeshed)
{
  TriangleSurface surface;
  addBox(surface, "Outside", house);
  const Box3 room = shrunk(house, 0.7);
  addHollow(surface, "Inside", room);
  ASSERT_LT(volumeOf(room), 0.5 * volumeOf(house));
  EXPECT_VOLUME(meshedVolume(surface, withinBounds(0.1)), volumeOf(room));
}

/// Two slabs, and four walls between them that meet in planes or overlap.
TriangleSurface wallsInPieces(double overlap)
{
  constexpr double t = 0.3;
  const Vec3 high = house.max;
  TriangleSurface surface;
  addBox(surface, "Slab", {house.min, Vec3(high[0], high[1], t)});
  addBox(surface, "Ceiling", {Vec3(0, 0, high[2] - t), high});
  const double low = t - overlap;
  const double top = high[2] - t + overlap;
  addBox(surface, "South", {Vec3(0, 0, low), Vec3(high[0], t, top)});
  addBox(surface, "North", {Vec3(0, high[1] - t, low), Vec3(high[0], high[1], top)});
  addBox(surface, "West", {Vec3(0, low, low), Vec3(t, high[1] - low, top)});
  addBox(surface, "East", {Vec3(high[0] - t, low, low), Vec3(high[0], high[1] - low, top)});
  return surface;
}

TEST(ThickWallsOf, PiecesAreNotMeshed)
{
  for (const double overlap : {0.0, 0.15})
  {
    SCOPED_TRACE(overlap);
    EXPECT_VOLUME(meshedVolume(wallsInPieces(overlap), withinBounds(0.1)), volumeOf(shrunk(house, 0.3)));
  }
}

/// A duct of rectangular section in a solid, from side to side along x; its ends are cut out of the sides.
TriangleSurface channel(bool withPatches)
{
  const Box3 duct{Vec3(0, 0.3, 0.3), Vec3(6, 4.7, 2.7)};
  const auto frameAt = [](const Box3& box, double x) {
    return std::array{Vec3(x, box.min[1], box.min[2]), Vec3(x, box.max[1], box.min[2]), Vec3(x, box.max[1], box.max[2]),
                      Vec3(x, box.min[1], box.max[2])};
  };
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (const double x : {0.0, 6.0})
  {
    for (const Box3& box : {house, duct})
    {
      const auto corners = frameAt(box, x);
      points.insert(points.end(), corners.begin(), corners.end());
    }
  }
  for (Index i = 0; i < 4; ++i)
  {
    const Index j = (i + 1) % 4;
    quad(i, i + 4, j + 4, j);           // end at x = 0
    quad(i + 8, j + 8, j + 12, i + 12); // end at x = 6
    quad(i, j, j + 8, i + 8);           // outside
    quad(i + 4, i + 12, j + 12, j + 4); // duct
  }
  TriangleSurface surface;
  addSurface(surface, "Walls", points, triangles);
  if (withPatches)
  {
    const Vec3 y(0, 4.4, 0), z(0, 0, 2.4);
    addSheet(surface, "Inlet", duct.min, y, z);
    addSheet(surface, "Outlet", Vec3(6, 0.3, 0.3), y, z);
  }
  return surface;
}

TEST(ThickWallsOf, ChannelAreNotMeshed)
{
  for (const bool withPatches : {false, true})
  {
    SCOPED_TRACE(withPatches);
    const MeshedModel meshed = meshModel(channel(withPatches), withinBounds(0.1), quietContext());
    EXPECT_VOLUME(volumeOf(meshed.mesh), 6.0 * 4.4 * 2.4);
  }
}

TEST(ThickWallsOf, FurnishedRoomAndItsFurnitureAreNotMeshed)
{
  const Box3 room = shrunk(house, 0.3);
  const Box3 table{Vec3(2, 2, 0.8), Vec3(4, 3, 1.2)};
  const Box3 wardrobe{Vec3(0.8, 0.8, 0.3), Vec3(1.6, 2.4, 2.2)};
  TriangleSurface surface;
  addBox(surface, "Outside", house);
  addHollow(surface, "Inside", room);
  addBox(surface, "Table", table);
  addBox(surface, "Wardrobe", wardrobe);
  EXPECT_VOLUME(meshedVolume(surface, withinBounds(0.1)), volumeOf(room) - volumeOf(table) - volumeOf(wardrobe));
}

/// The part of a wardrobe in the wall is in two bodies, as a hollow is.
TEST(ThickWallsOf, RoomWithFurnitureBuiltInAreNotMeshed)
{
  const Box3 room = shrunk(house, 0.3);
  const Box3 outside{Vec3(0.3, 1.0, 0.3), Vec3(1.2, 2.5, 2.3)};
  for (const bool isWoundWell : {true, false})
  {
    SCOPED_TRACE(isWoundWell);
    TriangleSurface surface;
    addBox(surface, "Outside", house);
    addBox(surface, "Inside", room);
    if (isWoundWell)
    {
      flipLast(surface);
    }
    addBox(surface, "Wardrobe", {outside.min - Vec3(0.2, 0, 0), outside.max});
    EXPECT_VOLUME(meshedVolume(surface, withinBounds(0.1)), volumeOf(room) - volumeOf(outside));
  }
}

TEST(ThickWallsOf, NoRoomAreLeftOutInRoomsWithoutThickness)
{
  const Box3 table{Vec3(2, 2, 0.8), Vec3(4, 3, 1.2)};
  const Box3 block{Vec3(0.5, 0.5, 0), Vec3(5.5, 4.5, 2.5)};
  for (const bool isInwards : {false, true})
  {
    for (const Box3& body : {table, block})
    {
      TriangleSurface surface;
      addBox(surface, "Walls", house);
      if (isInwards)
      {
        flipLast(surface);
      }
      addBox(surface, "Body", body);
      EXPECT_VOLUME(meshedVolume(surface, withinBounds(0.1)), volumeOf(house) - volumeOf(body));
    }
  }
}

TEST(ThickWallsOf, HousesOutdoorsLeaveTheirRoomsOut)
{
  TriangleSurface surface;
  addBox(surface, "Outside", house);
  addHollow(surface, "Inside", shrunk(house, 0.3));
  MesherOptions options = withinBounds(0.1);
  options.site.mode = DomainMode::bounds;
  options.site.bounds = {Vec3(-4, -4, 0), Vec3(10, 9, 9)};
  options.sizes.sizeMax = 0.8;
  EXPECT_VOLUME(meshedVolume(surface, options), volumeOf(options.site.bounds) - volumeOf(house));
}

TEST(ThickWallsOf, RoomAreLeftOutByRanksToo)
{
  TriangleSurface surface;
  addBox(surface, "Outside", house);
  addBox(surface, "Inside", shrunk(house, 0.3));
  MesherOptions options = withinBounds(0.15);
  options.mesh.blockSize = 1000;
  const MeshedModel whole = meshModel(surface, options, quietContext());
  onRanks(3, [&](RankExchange& exchange) {
    const SharedModel made = meshSharedModel(surface, options, 1, exchange, quietContext()).value();
    expectPiece(whole.mesh, made.piece, exchange.rank());
    EXPECT_EQ(made.meshed.keptZones, whole.keptZones);
    ASSERT_EQ(made.meshed.zones.size(), whole.zones.size());
    for (std::size_t i = 0; i < whole.zones.size(); ++i)
    {
      EXPECT_EQ(made.meshed.zones[i].kind, whole.zones[i].kind);
    }
  });
}

} // namespace
