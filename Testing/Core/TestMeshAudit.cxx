// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes compared with models whose areas and volumes are known.
#include "Mesher/AuditReport.h"
#include "Mesher/MeshStages.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gmock/gmock.h>

#include <numbers>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addSphere;
using atria::testing::addSurface;
using atria::testing::turn;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double size = 0.5;
/// Of areas and volumes.
constexpr double tolerance = 0.005;

MesherOptions optionsIn(const Box3& domain)
{
  MesherOptions options;
  options.site.mode = DomainMode::bounds;
  options.site.bounds = domain;
  options.sizes.sizeMin = size;
  options.sizes.sizeMid = size;
  options.sizes.sizeMax = 2.0;
  options.mesh.layers = {{"*", {1}}};
  return options;
}

const Box3 domain{Vec3(-10, -10, 0), Vec3(10, 10, 10)};

MeshedModel meshed(const TriangleSurface& surface, const MesherOptions& options, int threads = 2)
{
  const ThreadExecutor executor(threads);
  return meshModel(surface, options, atria::testing::quietContext(executor));
}

const SurfaceAudit& auditOf(const MeshedModel& mesh, const std::string& name)
{
  const auto found = std::find(mesh.names.begin(), mesh.names.end(), name);
  return mesh.audit.surfaces.at(static_cast<std::size_t>(found - mesh.names.begin()));
}

void expectNear(double value, double wanted, const char* what)
{
  EXPECT_NEAR(value, wanted, tolerance * std::max(1.0, wanted)) << what;
}

class TurnedAudit : public ::testing::TestWithParam<double>
{
};

TEST_P(TurnedAudit, FindsAllOfASolid)
{
  TriangleSurface model;
  addBox(model, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 4)});
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  const SurfaceAudit& house = auditOf(mesh, "House");
  expectNear(house.drawnArea, 2 * 24 + 80, "drawn");
  expectNear(house.meshArea, 24 + 80, "in the mesh");
  expectNear(house.underGround, 24, "the base");
  expectNear(house.lost, 0, "lost");
  expectNear(mesh.audit.volumes.domain, 4000, "domain");
  expectNear(mesh.audit.volumes.displaced(), 96, "displaced");
  expectNear(mesh.audit.volumes.displacedByModel, 96, "displaced by the model");
  EXPECT_LT(house.distances.ofFaces.inElements, 0.05);
  EXPECT_LT(house.distances.ofSurface.inElements, 0.1);
  EXPECT_NEAR(house.meanSize, size, 1e-9);
  EXPECT_NEAR(house.requestedSize, size, 1e-9);
  EXPECT_THAT(mesh.auditWarnings, IsEmpty());
}

TEST_P(TurnedAudit, CountsBothSidesOfASheetOnce)
{
  TriangleSurface model;
  addSheet(model, "Wall", Vec3(-3, 0, 2), Vec3(6, 0, 0), Vec3(0, 0, 4));
  addSheet(model, "Other", Vec3(-3, 4, 2), Vec3(6, 0, 0), Vec3(0, 0, 4));
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  for (const char* name : {"Wall", "Other"})
  {
    expectNear(auditOf(mesh, name).meshArea, 24, name);
    expectNear(auditOf(mesh, name).drawnArea, 24, name);
  }
  expectNear(mesh.audit.volumes.displaced(), 0, "displaced");
}

TEST_P(TurnedAudit, TellsWhatNoAirReaches)
{
  TriangleSurface model;
  addBox(model, "House", {Vec3(-4, -4, 0), Vec3(4, 4, 6)});
  addBox(model, "Core", {Vec3(-1, -1, 2), Vec3(1, 1, 4)});
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  EXPECT_EQ(auditOf(mesh, "Core").meshArea, 0.0);
  expectNear(auditOf(mesh, "Core").inSolid + auditOf(mesh, "Core").inRoom, 24, "in the house");
  expectNear(mesh.audit.volumes.displaced(), 384, "displaced");
  EXPECT_THAT(mesh.auditWarnings, ElementsAre(HasSubstr("Core")));
}

/// A base with a name of its own, and a house of which a part is below the bottom.
TEST_P(TurnedAudit, TellsOfBasesAndOfWhatIsBelowTheBottom)
{
  TriangleSurface model;
  addBox(model, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 4)});
  addBox(model, "Deep", {Vec3(5, -2, -3), Vec3(8, 2, 4)});
  const auto base = std::ranges::find_if(model.triangles, [&](const std::array<Index, 3>& t) {
    return std::ranges::all_of(t, [&](Index p) { return model.points[p][2] == 0.0; });
  });
  const auto first = static_cast<std::size_t>(base - model.triangles.begin());
  ASSERT_EQ(model.surfaceIds[first], model.surfaceIds[first + 1]);
  model.surfaceIds[first] = model.surfaceIds[first + 1] = static_cast<Index>(model.names.size());
  model.names.emplace_back("Base");
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  expectNear(auditOf(mesh, "Base").underGround, 24, "base");
  expectNear(auditOf(mesh, "House").underGround, 0, "house");
  const SurfaceAudit& deep = auditOf(mesh, "Deep");
  expectNear(deep.drawnArea, 56 + 12, "drawn within");
  expectNear(deep.outside, 42 + 12, "below the bottom");
  expectNear(deep.meshArea, 56 + 12, "in the mesh");
  EXPECT_THAT(mesh.auditWarnings,
              ElementsAre(AllOf(HasSubstr("Base (24 m², on or under the ground)"), Not(HasSubstr("closes it in")))));
}

INSTANTIATE_TEST_SUITE_P(Angles, TurnedAudit, ::testing::Values(0.0, 17.0, 30.0, 45.0));

TEST(MeshAudit, TellsWhatIsUnderTheGround)
{
  TriangleSurface model;
  addSheet(model, "Terrain", Vec3(-20, -20, 2), Vec3(40, 0, 0), Vec3(0, 40, 0));
  addBox(model, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 6)});
  MesherOptions options = optionsIn(domain);
  options.site.terrain = "Terrain";
  const MeshedModel mesh = meshed(model, options);
  const SurfaceAudit& house = auditOf(mesh, "House");
  expectNear(house.meshArea, 80 + 24, "in the mesh");
  expectNear(house.underGround, 24 + 40, "base and walls");
  expectNear(auditOf(mesh, "Terrain").meshArea, 400 - 24, "terrain");
  const SurfaceAudit& terrain = auditOf(mesh, "Terrain");
  expectNear(terrain.inSolid + terrain.inRoom, 24, "terrain in the house");
  const VolumeAudit& volumes = mesh.audit.volumes;
  expectNear(volumes.displaced() - volumes.displacedByModel, 0, "displaced as the model says");
  EXPECT_THAT(mesh.auditWarnings, IsEmpty());
}

/// On the lattice bases may be below the bottom by rounding.
TEST(MeshAudit, CountsBasesOnTheBottomAtAnyHeight)
{
  for (int i = 0; i < 20; ++i)
  {
    const double bottom = -1.0 + 0.1234567 * i;
    SCOPED_TRACE(bottom);
    TriangleSurface model;
    addBox(model, "House", {Vec3(-3, -2, bottom), Vec3(3, 2, bottom + 4)});
    turn(model, 30.0);
    Box3 box = domain;
    box.min[2] = bottom;
    const MeshedModel mesh = meshed(model, optionsIn(box));
    expectNear(auditOf(mesh, "House").underGround, 24, "the base");
    expectNear(auditOf(mesh, "House").lost, 0, "lost");
    EXPECT_THAT(mesh.auditWarnings, IsEmpty());
  }
}

TEST(MeshAudit, WarnsOfSurfacesThatAreTooFine)
{
  TriangleSurface model;
  addBox(model, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 4)});
  addBox(model, "Handle", {Vec3(-3.2, 0, 1), Vec3(-3.05, 0.1, 1.1)});
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  const SurfaceAudit& handle = auditOf(mesh, "Handle");
  EXPECT_EQ(handle.meshArea, 0.0);
  EXPECT_NEAR(handle.leftOut + handle.lost, handle.drawnArea, 1e-6);
  EXPECT_THAT(mesh.auditWarnings, ElementsAre(HasSubstr("1 surface without a face in the mesh: Handle")));
}

TEST(MeshAudit, LooksAtWhatIsInTheDomainAlone)
{
  TriangleSurface model;
  addSheet(model, "Road", Vec3(-30, -1, 1), Vec3(60, 0, 0), Vec3(0, 2, 0));
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  expectNear(auditOf(mesh, "Road").drawnArea, 40, "drawn");
  expectNear(auditOf(mesh, "Road").meshArea, 40, "in the mesh");
}

TEST(MeshAudit, WarnsOfSurfacesOutsideOfTheDomain)
{
  TriangleSurface model;
  addBox(model, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 4)});
  addBox(model, "Shed", {Vec3(100, 0, 0), Vec3(104, 3, 2)});
  EXPECT_THAT(meshed(model, optionsIn(domain)).auditWarnings,
              ElementsAre(AllOf(HasSubstr("1 surface without a face in the mesh, outside of the domain"),
                                HasSubstr("Shed (52 m², 5.39 m across)"))));
}

TEST(MeshAudit, MeasuresHowFarAwayFacesAre)
{
  // Facets that are finer than the mesh: it is inside of the sphere by the sagitta of a face's diagonal.
  TriangleSurface model;
  addSphere(model, "Ball", Vec3(0, 0, 5), 3.0, 4);
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  const FarthestPlace& place = auditOf(mesh, "Ball").distances.ofFaces;
  const double sagitta = 3.0 - std::sqrt(9.0 - 0.5 * size * size);
  EXPECT_GT(place.distance, 0.1 * sagitta);
  EXPECT_LT(place.distance, 3.0 * sagitta);
  EXPECT_NEAR(place.inElements, place.distance / size, 1e-6);
  EXPECT_NEAR((place.at - Vec3(0, 0, 5)).norm(), 3.0, 3.0 * sagitta);
  expectNear(mesh.audit.volumes.displacedByModel, 4.0 / 3.0 * std::numbers::pi * 27.0 * 0.997, "enclosed");
}

/// A box of 6 by 4 m that is 4 m high.
MeshedModel meshedHouse(const RunContext& run, StageCache& cache)
{
  TriangleSurface model;
  addBox(model, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 4)});
  return meshModel(model, optionsIn(domain), run, &cache);
}

TEST(MeshAudit, FindsMovedPointsAndMissingFaces)
{
  StageCache cache;
  const ThreadExecutor executor(2);
  const RunContext run = atria::testing::quietContext(executor);
  MeshedModel mesh = meshedHouse(run, cache);
  const SurfaceModel& placed = cache.sources()->model;
  const TriangleTreeOnDemand tree(placed);
  const MeshingContext context{run, cache.sources()->octree, placed, tree};
  SeenModel seen;
  seen.views.assign(placed.triangles.size(), {View::air, View::solid});
  for (double x = -2.75; x < 3.0; x += 0.5)
  {
    seen.samples.push_back({Vec3(x, 0.0, 4.0), 0, static_cast<float>(size)});
  }

  Index roof = noIndex;
  for (Index f = 0; f < mesh.mesh.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = mesh.mesh.boundaryFaces[f];
    const Vec3& p = mesh.mesh.points[faceOf(mesh.mesh.corners[face.element], face.direction).points[0]];
    const bool isInside = std::abs(p[0]) < 2.0 && std::abs(p[1]) < 1.0;
    roof = face.tag == 0 && isInside && p[2] > 3.9 ? f : roof;
  }
  ASSERT_NE(roof, noIndex);
  const BoundaryFace face = mesh.mesh.boundaryFaces[roof];
  const Index moved = faceOf(mesh.mesh.corners[face.element], face.direction).points[0];

  DualMesh pulled = mesh.mesh;
  pulled.points[moved][2] += 0.4;
  const SurfaceDistances distances = auditMesh(pulled, seen, {}, context).surfaces[0].distances;
  EXPECT_NEAR(distances.ofFaces.distance, 0.4, 1e-6);
  EXPECT_NEAR((distances.ofFaces.at - pulled.points[moved]).norm(), 0.0, 1e-9);

  DualMesh torn = mesh.mesh;
  std::erase_if(torn.boundaryFaces, [&](const BoundaryFace& one) {
    const ReducedFace loop = faceOf(torn.corners[one.element], one.direction);
    return one.tag == 0 && std::ranges::any_of(loop.loop(), [&](Index p) {
             return (torn.points[p] - mesh.mesh.points[moved]).norm() < 1.2;
           });
  });
  EXPECT_GT(auditMesh(torn, seen, {}, context).surfaces[0].distances.ofSurface.distance, 0.8);
}

TEST(MeshAudit, WarnsOfMoreFacesThanDrawn)
{
  StageCache cache;
  const ThreadExecutor executor(2);
  MeshedModel mesh = meshedHouse(atria::testing::quietContext(executor), cache);
  const GridFrame& frame = cache.sources()->octree.frame();
  EXPECT_THAT(warningsOf(mesh.audit, mesh.names, frame), IsEmpty());
  EXPECT_THAT(notesOf(mesh.audit, mesh.names, frame), IsEmpty());
  mesh.audit.surfaces[0].meshArea *= 1.01;
  EXPECT_THAT(warningsOf(mesh.audit, mesh.names, frame), IsEmpty());
  EXPECT_THAT(notesOf(mesh.audit, mesh.names, frame),
              ElementsAre(AllOf(HasSubstr("1 surface with an area that is more than 0.5 % off: House (+"),
                                HasSubstr("lower SizeMin"))));
  mesh.audit.surfaces[0].meshArea *= 1.4 / 1.01;
  EXPECT_THAT(notesOf(mesh.audit, mesh.names, frame), IsEmpty()) << "a warning says more";
  EXPECT_THAT(warningsOf(mesh.audit, mesh.names, frame),
              ElementsAre(AllOf(HasSubstr("1 surface with more faces than drawn: House (146 m² for 128 m²)"),
                                HasSubstr("lower SizeMin"))));
}

TEST_P(TurnedAudit, MeasuresPartyWallsWhereAirSeesThem)
{
  // A row of gabled houses, each a little higher: of the party walls air sees a strip below the valley.
  TriangleSurface model;
  const auto nameOf = [](const char* what, int i) { return what + std::to_string(i); };
  for (int i = 0; i < 4; ++i)
  {
    const double x = 3.0 * i - 6.0;
    const double eaves = 5.0 + 0.05 * i;
    std::vector<Vec3> points;
    for (const double y : {-4.0, 4.0})
    {
      points.insert(points.end(), {Vec3(x, y, 0), Vec3(x + 3, y, 0), Vec3(x + 3, y, eaves), Vec3(x, y, eaves),
                                   Vec3(x + 1.5, y, eaves + 2)});
    }
    addSurface(
        model, nameOf("Wall", i), points,
        {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {7, 6, 5}, {8, 7, 5}, {9, 7, 8}, {0, 3, 8}, {0, 8, 5}, {1, 6, 7}, {1, 7, 2}});
    addSurface(model, nameOf("Roof", i), points, {{2, 7, 9}, {2, 9, 4}, {3, 4, 9}, {3, 9, 8}, {0, 5, 6}, {0, 6, 1}});
  }
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_LT(auditOf(mesh, nameOf("Wall", i)).distances.ofSurface.inElements, 1.0) << i;
  }
}

TEST_P(TurnedAudit, CountsWallsThatASurfaceHasTwiceAsSuch)
{
  // Houses of one surface that touch, one of them lower.
  TriangleSurface model;
  addBox(model, "Houses", {Vec3(-4, -2, 0), Vec3(0, 2, 5)});
  addBox(model, "Lower", {Vec3(0, -2, 0), Vec3(4, 2, 3)});
  std::ranges::fill(model.surfaceIds, 0);
  model.names.pop_back();
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  const SurfaceAudit& houses = auditOf(mesh, "Houses");
  expectNear(houses.drawnArea, 112 + 80, "drawn");
  expectNear(houses.meshArea, 16 + 40 + 20 + 8 + 16 + 24 + 12, "in the mesh");
  expectNear(houses.shared, 12, "of the party wall, the one that was dropped");
  expectNear(houses.inSolid, 12, "the other one");
  expectNear(houses.underGround, 32, "bases");
  EXPECT_EQ(mesh.audit.bodies.closed, 2u);
  expectNear(houses.lost, 0, "lost");
}

TEST_P(TurnedAudit, CountsWhatBodiesHaveInCommonOnce)
{
  TriangleSurface model;
  addBox(model, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 4)});
  addBox(model, "Porch", {Vec3(2, -1, 0), Vec3(5, 1, 3)});
  addBox(model, "Stove", {Vec3(-2, -1, 1), Vec3(-1, 1, 2)});
  turn(model, GetParam());
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  const BodyAudit& bodies = mesh.audit.bodies;
  EXPECT_EQ(bodies.closed, 3U);
  EXPECT_NEAR(bodies.overlap, 6 + 2, 0.1);
  EXPECT_NEAR(bodies.volume, 96 + 12, 0.1);
  EXPECT_NEAR(mesh.audit.volumes.displaced(), 96 + 12, tolerance * 108);
  EXPECT_THAT(bodies.hollow, IsEmpty());
  EXPECT_THAT(bodies.open, IsEmpty());
  EXPECT_THAT(mesh.auditWarnings, ElementsAre(HasSubstr("without a face in the mesh: Stove (10 m², inside a solid)")));
}

TEST(MeshAudit, TellsOfBodiesWithAirInside)
{
  TriangleSurface model;
  addBox(model, "Hall", {Vec3(-8, -3, 0), Vec3(-2, 3, 4)});
  addBox(model, "Shed", {Vec3(2, -3, 0), Vec3(8, 3, 4)});
  addSheet(model, "Fence", Vec3(0, -3, 0), Vec3(0, 6, 0), Vec3(0, 0, 3));
  const auto endOfShed = [&](std::size_t t) {
    return std::ranges::all_of(model.triangles[t], [&](Index p) { return model.points[p][0] == 8.0; });
  };
  for (std::size_t t = model.triangles.size(); t-- > 0;)
  {
    if (endOfShed(t))
    {
      model.triangles.erase(model.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      model.surfaceIds.erase(model.surfaceIds.begin() + static_cast<std::ptrdiff_t>(t));
    }
  }
  MesherOptions options = optionsIn(domain);
  options.mesh.zoneRule = ZoneRule::all;
  const MeshedModel mesh = meshed(model, options);
  const BodyAudit& bodies = mesh.audit.bodies;
  EXPECT_EQ(bodies.closed, 1U);
  EXPECT_NEAR(bodies.volume, 144, 1e-6);
  ASSERT_EQ(bodies.hollow.size(), 1U);
  EXPECT_EQ(mesh.names[bodies.hollow[0].surface], "Hall");
  EXPECT_NEAR(bodies.hollow[0].volume, 144, 15) << "in octants";
  ASSERT_EQ(bodies.open.size(), 1U) << "a fence encloses nothing";
  EXPECT_EQ(mesh.names[bodies.open[0].surface], "Shed");
  EXPECT_NEAR(bodies.open[0].volume, 144, 1e-6);
  EXPECT_THAT(mesh.notes, ::testing::Contains(HasSubstr("1 body is open, and air is meshed inside of it: Shed")));
}

TEST(MeshAudit, WarnsOfClosedBodiesThatAreTooThin)
{
  TriangleSurface model;
  addBox(model, "Plate", {Vec3(-5, -5, 2), Vec3(5, 5, 2.02)});
  addBox(model, "House", {Vec3(-1, -1, 0), Vec3(1, 1, 1)});
  const MeshedModel mesh = meshed(model, optionsIn(domain));
  EXPECT_NEAR(mesh.audit.bodies.volume, 2 + 4, 1e-6);
  EXPECT_EQ(mesh.audit.volumes.displaced() < 0.99 * mesh.audit.bodies.volume,
            std::ranges::any_of(mesh.auditWarnings, [](const std::string& text) {
              return text.find("but the closed bodies of the model have 6 m³ there") != text.npos;
            }));
}

TEST(MeshAudit, IsTheSameOnAnyNumberOfThreads)
{
  const TriangleSurface model = atria::testing::randomSoup(7);
  MesherOptions options = optionsIn({Vec3(-6, -6, -6), Vec3(6, 6, 6)});
  options.mesh.zoneRule = ZoneRule::all;
  const MeshedModel one = meshed(model, options, 1);
  const MeshedModel three = meshed(model, options, 3);
  EXPECT_EQ(one.auditWarnings, three.auditWarnings);
  EXPECT_EQ(one.audit.volumes.air, three.audit.volumes.air);
  for (std::size_t i = 0; i < one.audit.surfaces.size(); ++i)
  {
    EXPECT_EQ(one.audit.surfaces[i].meshArea, three.audit.surfaces[i].meshArea);
    EXPECT_EQ(one.audit.surfaces[i].distances.ofFaces.distance, three.audit.surfaces[i].distances.ofFaces.distance);
    EXPECT_EQ(one.audit.surfaces[i].distances.ofSurface.distance, three.audit.surfaces[i].distances.ofSurface.distance);
  }
}

} // namespace
