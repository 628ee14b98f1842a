// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of generated cities: the ground is what the houses leave, no air is below them, and what they displace is
/// their volume down to the ground.
#include "Mesher/MeshStages.h"
#include "Ranks/SharedModel.h"
#include "Support/Cities.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"
#include "Support/ThreadRanks.h"

#include <cmath>
#include <mutex>

namespace {

using namespace atria;
using namespace atria::testing;

/// What is built, and what of it should be in the mesh.
struct City
{
  TriangleSurface surface;
  double footprint = 0.0;
  double displaced = 0.0; ///< above the ground

  void house(const std::string& name, double x, double y, double base, double top, bool hasBottom = true,
             double ground = 0.0)
  {
    addHouse(surface, name, x, y, base, top, hasBottom);
    footprint += 100.0;
    displaced += 100.0 * (top - ground);
  }
};

MesherOptions optionsFor()
{
  MesherOptions options;
  options.sizes.sizeMin = 0.5;
  options.sizes.sizeMid = 1.0;
  options.sizes.sizeMax = 8.0;
  options.mesh.layers = {{"*", {1}}};
  return options;
}

double area(const DualMesh& mesh, const BoundaryFace& face)
{
  const ReducedFace corners = faceOf(mesh.corners[face.element], face.direction);
  double sum = 0.0;
  for (int i = 1; i + 1 < corners.count; ++i)
  {
    const Vec3 u = mesh.points[corners.points[i]] - mesh.points[corners.points[0]];
    const Vec3 v = mesh.points[corners.points[i + 1]] - mesh.points[corners.points[0]];
    sum += 0.5 * std::abs(u[0] * v[1] - u[1] * v[0]);
  }
  return sum;
}

/// Seen from above, of the domain's bottom and of surfaces that are ground.
double groundArea(const MeshedModel& meshed, const std::string& ground = "Site")
{
  double sum = 0.0;
  for (const BoundaryFace& face : meshed.mesh.boundaryFaces)
  {
    const bool isBottom = face.tag == meshed.names.size() + zMin;
    const bool isGround = face.tag < meshed.names.size() && meshed.names[face.tag] == ground;
    sum += isBottom || isGround ? area(meshed.mesh, face) : 0.0;
  }
  return sum;
}

void expectCity(const City& city, const MesherOptions& options)
{
  const GroundedInput grounded = groundModel(city.surface, options);
  const Vec3 size = planSite(grounded.surface, grounded.options).domain.bounds.size();
  const MeshedModel meshed = meshModel(city.surface, options, quietContext());
  EXPECT_NEAR(groundArea(meshed), size[0] * size[1] - city.footprint, 0.005 * city.footprint);
  EXPECT_NEAR(totalVolume(meshed.mesh), size.prod() - city.displaced, 0.005 * city.displaced);
  EXPECT_TRUE(boundaryIsWatertight(meshed.mesh));
  EXPECT_TRUE(meshed.inputWarnings.empty()) << meshed.inputWarnings.front();
}

class GroundMeshes : public ::testing::TestWithParam<double>
{
protected:
  void expect(City& city)
  {
    turn(city.surface, GetParam());
    expectCity(city, optionsFor());
  }
};

TEST_P(GroundMeshes, HousesOnDifferentBasesStandOnTheGround)
{
  for (const bool hasBottom : {true, false})
  {
    SCOPED_TRACE(hasBottom);
    City city;
    city.house("A", 0, 0, 1.0, 9.0, hasBottom, 1.0);
    city.house("B", 20, 0, 1.4, 9.4, hasBottom, 1.0);
    city.house("C", 40, 0, 2.8, 10.8, hasBottom, 1.0);
    expect(city);
  }
}

TEST_P(GroundMeshes, CellarsAreBelowAndBridgesAbove)
{
  City city;
  city.house("House", 0, 0, 0.0, 12.0);
  city.house("Afloat", 20, 0, 0.3, 12.0, false);
  city.house("Cellar", 0, 20, -3.0, 9.0);
  city.house("Low", 20, 20, 0.0, 9.0);
  addBox(city.surface, "Bridge", {Vec3(10, 23, 5), Vec3(20, 27, 8)});
  city.displaced += 10 * 4 * 3;
  expect(city);
}

TEST_P(GroundMeshes, TerracesStandOnTheGround)
{
  City city;
  addProfile(city.surface, "Row", {{0, 9}, {0, 0}, {10, 0}, {10, 0.4}, {20, 0.4}, {20, 1.5}, {30, 1.5}, {30, 9}}, 0,
             10);
  city.footprint += 300;
  city.displaced += 300 * 9;
  expect(city);
}

TEST_P(GroundMeshes, HousesOnASlabStandOnIt)
{
  City city;
  addBox(city.surface, "Site", {Vec3(-70, -70, -1), Vec3(90, 90, 0.5)});
  city.house("A", 0, 0, 0.5, 9.0, true, 0.5);
  city.house("B", 20, 0, 0.8, 9.0, true, 0.5);
  expect(city);
}

INSTANTIATE_TEST_SUITE_P(Angles, GroundMeshes, ::testing::Values(0.0, 27.0));

/// On a plane slope of 10 %, each house displaces what is above that.
TEST(GroundMesh, HousesOnASlopeStandOnIt)
{
  City city;
  addSheet(city.surface, "Site", Vec3(-200, -200, -20), Vec3(500, 0, 50), Vec3(0, 400, 0));
  for (int i = 0; i < 4; ++i)
  {
    // At the middle the ground is 2 i + 0.5 high, and the bases from 0.5 m below that to 1 m above.
    city.house("House" + std::to_string(i), 20 * i, 0, 2 * i + 0.5 * i, 2 * i + 9.5, i % 2 == 0, 2 * i + 0.5);
  }
  const MesherOptions options = optionsFor();
  const GroundedInput grounded = groundModel(city.surface, options);
  EXPECT_EQ(grounded.report.letDown.size(), 3u);
  const SitePlan plan = planSite(grounded.surface, grounded.options);
  const Box3& box = plan.domain.bounds;
  const MeshedModel meshed = meshModel(city.surface, options, quietContext());
  EXPECT_NEAR(groundArea(meshed), box.size()[0] * box.size()[1] - city.footprint, 0.005 * city.footprint);
  const double middle = 0.1 * box.center()[0]; // height of the slope
  const double above = box.size()[0] * box.size()[1] * (box.max[2] - middle);
  EXPECT_NEAR(totalVolume(meshed.mesh), above - city.displaced, 0.005 * city.displaced);
  EXPECT_TRUE(meshed.inputWarnings.empty());
}

TEST(GroundMesh, RanksLetDownTheSame)
{
  City city;
  city.house("A", 0, 0, 1.0, 9.0);
  city.house("B", 20, 0, 1.4, 9.4);
  MesherOptions options = optionsFor();
  options.mesh.blockSize = 2000;
  const MeshedModel whole = meshModel(city.surface, options, quietContext());
  ASSERT_EQ(whole.ground.letDown.size(), 1u);
  std::mutex guard;
  std::size_t elements = 0;
  onRanks(2, [&](RankExchange& exchange) {
    const auto made = meshSharedModel(city.surface, options, 0, exchange, quietContext());
    const std::scoped_lock lock(guard);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->meshed.ground.letDown.size(), 1u);
    EXPECT_EQ(made->meshed.ground.notes, whole.ground.notes);
    EXPECT_EQ(made->meshed.inputWarnings, whole.inputWarnings);
    for (const int rank : made->piece.elementRanks)
    {
      elements += rank == exchange.rank() ? 1 : 0;
    }
  });
  EXPECT_EQ(elements, whole.mesh.elementCount());
}

} // namespace
