// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts of an audit: clipped areas, distances between a mesh and its model, and samples of surfaces.
#include "Audit/ClippedTriangles.h"
#include "Audit/MeshAudit.h"
#include "Audit/MeshDistances.h"
#include "Audit/SurfaceSamples.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addSheet;
using atria::testing::addSurface;
using atria::testing::quietContext;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Sums of an audit.

SurfaceAudit auditWith(double placed, double drawn)
{
  SurfaceAudit audit;
  audit.placedArea = placed;
  audit.drawnArea = drawn;
  audit.underGround = 1.0;
  audit.inSolid = 2.0;
  audit.inRoom = 4.0;
  audit.shared = 8.0;
  return audit;
}

TEST(SurfaceAudit, SeesThePlacedAreaWithoutWhatIsHidden)
{
  EXPECT_EQ(auditWith(100.0, 50.0).seenArea(), 93.0);
  EXPECT_EQ(SurfaceAudit().seenArea(), 0.0);
}

TEST(SurfaceAudit, CoversTheDrawnAreaThatShouldBeInTheMesh)
{
  SurfaceAudit audit = auditWith(0.0, 35.0); // 20 of it should be there
  const std::vector<std::pair<double, double>> cases{{0.0, 0.0}, {5.0, 0.25}, {20.0, 1.0}, {30.0, 1.0}};
  for (const auto& [meshArea, covered] : cases)
  {
    audit.meshArea = meshArea;
    EXPECT_EQ(audit.coverage(), covered) << meshArea;
  }
  for (const double drawn : {15.0, 10.0})
  {
    audit.drawnArea = drawn; // nothing should be there
    audit.meshArea = 0.0;
    EXPECT_EQ(audit.coverage(), 1.0) << drawn;
  }
}

TEST(VolumeAudit, DisplacesWhatIsNoAir) { EXPECT_EQ((VolumeAudit{10.0, 7.0, 1.0}).displaced(), 3.0); }

TEST(MeshAudit, IsFinishedByWhatIsDrawn)
{
  MeshAudit audit;
  audit.surfaces.assign(4, auditWith(60.0, 0.0));
  for (SurfaceAudit& surface : audit.surfaces)
  {
    surface.shared = 0.0;
    surface.meshArea = 20.0;
  }
  SurfaceRepairReport repair;
  repair.hidden.push_back({1, 5, 7.0, 3, 0.5});
  repair.shared = {{0, 1, 3.0, 0, 0}, {2, 1, 4.0, 0, 0}, {1, 2, 9.0, 0, 0}};
  finishAudit({{50.0, 60.0, 30.0}, {1.0, 2.0, 3.0}, {11.0, 12.0, 13.0}}, repair, audit);
  const auto listOf = [&](double SurfaceAudit::*field) {
    std::vector<double> values;
    std::ranges::transform(audit.surfaces, std::back_inserter(values), field);
    return values;
  };
  EXPECT_THAT(listOf(&SurfaceAudit::drawnArea), ElementsAre(50.0, 60.0, 30.0, 20.0)) << "openings are not drawn";
  EXPECT_THAT(listOf(&SurfaceAudit::outside), ElementsAre(1.0, 2.0, 3.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::extent), ElementsAre(11.0, 12.0, 13.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::leftOut), ElementsAre(0.0, 0.5, 0.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::shared), ElementsAre(0.0, 7.0, 9.0, 0.0));
  EXPECT_THAT(listOf(&SurfaceAudit::lost), ElementsAre(50.0 - 20 - 7, 60.0 - 20 - 7 - 7 - 0.5, 0.0, 0.0));
}

TEST(MeshAudit, PutsPlacesAlongTheAxesOfTheModel)
{
  MeshAudit audit;
  audit.surfaces.resize(2);
  audit.surfaces[1].distances.ofFaces.at = Vec3(1, 2, 3);
  audit.surfaces[1].distances.ofSurface.at = Vec3(4, 0, 5);
  placeInModel(audit, Placement(90.0));
  EXPECT_LT((audit.surfaces[1].distances.ofFaces.at - Vec3(-2, 1, 3)).norm(), 1e-12);
  EXPECT_LT((audit.surfaces[1].distances.ofSurface.at - Vec3(0, 4, 5)).norm(), 1e-12);
}

// Clipped triangles.

using Corners = std::array<Vec3, 3>;

class RandomTriangles
{
public:
  explicit RandomTriangles(unsigned seed) : random(seed) {}
  Vec3 place() { return {some(random), some(random), some(random)}; }
  Corners triangle() { return {place(), place(), place()}; }

private:
  std::mt19937 random;
  std::uniform_real_distribution<double> some{-3.0, 3.0};
};

double areaOf(const Corners& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

ConvexRegion::Part within(const ConvexRegion& region, const Corners& t, double level = 0.0)
{
  return region.within(t[0], t[1], t[2], level);
}

/// Sums the parts of a triangle in regions.
ConvexRegion::Part sumOver(const std::vector<ConvexRegion>& regions, const Corners& t, double level)
{
  ConvexRegion::Part sum;
  for (const ConvexRegion& region : regions)
  {
    const ConvexRegion::Part part = within(region, t, level);
    sum.area += part.area;
    sum.heightTimesArea += part.heightTimesArea;
  }
  return sum;
}

TEST(ConvexRegion, OfBoxesSideBySideHaveAllOfATriangle)
{
  std::vector<ConvexRegion> boxes;
  for (int i = 0; i < 27; ++i)
  {
    const Vec3 place(i % 3, i / 3 % 3, i / 9);
    const Vec3 low = 3.0 * place - Vec3::Constant(4.0);
    boxes.emplace_back(Box3{low, low + Vec3::Constant(3.0)}, 0.0);
  }
  RandomTriangles triangles(3);
  for (int round = 0; round < 200; ++round)
  {
    const Corners t = triangles.triangle();
    const double level = 0.1 * round;
    const ConvexRegion::Part sum = sumOver(boxes, t, level);
    EXPECT_NEAR(sum.area, areaOf(t), 1e-11);
    EXPECT_NEAR(sum.heightTimesArea, areaOf(t) * ((t[0][2] + t[1][2] + t[2][2]) / 3.0 - level), 1e-9);
  }
}

TEST(ConvexRegion, HasWhatLiesWithinItsPlanes)
{
  struct Case
  {
    Corners corners;
    double area;
    double height;
  };
  const ConvexRegion region(Box3{Vec3(0, 0, 0), Vec3(2, 4, 6)}, 0.0);
  const double root = std::sqrt(2.0);
  const std::vector<Case> cases{
      {{Vec3(0.5, 1, 1), Vec3(1.5, 1, 1), Vec3(0.5, 3, 1)}, 1.0, 1.0},             // inside
      {{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 4, 0)}, 4.0, 0.0},                   // on the bottom
      {{Vec3(0, 0, 6), Vec3(2, 0, 6), Vec3(0, 4, 6)}, 4.0, 6.0},                   // on the top
      {{Vec3(-9, -9, 5), Vec3(99, -9, 5), Vec3(-9, 99, 5)}, 8.0, 5.0},             // covers a level
      {{Vec3(1, -99, -99), Vec3(1, 99, -99), Vec3(1, 0, 199)}, 24.0, 3.0},         // covers a plane x = 1
      {{Vec3(-99, 1, -99), Vec3(99, 1, -99), Vec3(0, 1, 199)}, 12.0, 3.0},         // covers a plane y = 1
      {{Vec3(-1, 1, 2), Vec3(1, 1, 2), Vec3(-1, 3, 2)}, 0.5, 2.0},                 // its middle is on a side
      {{Vec3(-99, -99, -99), Vec3(99, -99, 99), Vec3(0, 99, 0)}, 8.0 * root, 1.0}, // covers a plane z = x
      {{Vec3(-1, 1, 2), Vec3(-2, 1, 2), Vec3(-1, 3, 2)}, 0.0, 0.0},                // outside
      {{Vec3(1, 1, -1), Vec3(1.5, 1, -1), Vec3(1, 3, -0.1)}, 0.0, 0.0},            // below
      {{Vec3(3, 3, 3), Vec3(1, 6, 3), Vec3(3, 6, 3)}, 0.0, 0.0}};                  // past an edge
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    for (std::size_t start = 0; start < 3; ++start)
    {
      Corners t = cases[i].corners;
      std::ranges::rotate(t, t.begin() + static_cast<std::ptrdiff_t>(start));
      const ConvexRegion::Part part = within(region, t, -1.0);
      EXPECT_NEAR(part.area, cases[i].area, 1e-9) << i;
      EXPECT_NEAR(part.heightTimesArea, cases[i].area * (cases[i].height + 1.0), 1e-8) << i;
    }
  }
}

TEST(ConvexRegion, ReachesBeyondItsPlanesByTheTolerance)
{
  constexpr double tolerance = 0.01;
  const Box3 box{Vec3(0, 0, 0), Vec3(2, 4, 6)};
  const PlacedPrism upright(Placement(), {{0, 0}, {2, 0}, {2, 4}, {0, 4}}, 0.0, 6.0);
  ASSERT_FALSE(upright.isBox());
  for (const ConvexRegion& region :
       {ConvexRegion(box, tolerance), ConvexRegion(PlacedPrism({Placement(), box}), tolerance),
        ConvexRegion(upright, tolerance)})
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      for (const double factor : {0.9, 1.1})
      {
        // A small triangle in front of the middle of a side.
        const int axis = axisOf(direction);
        Corners t;
        t.fill(box.center());
        t[1][(axis + 1) % 3] += 0.1;
        t[2][(axis + 2) % 3] += 0.1;
        const double beyond = factor * tolerance;
        std::ranges::for_each(
            t, [&](Vec3& p) { p[axis] = isUpper(direction) ? box.max[axis] + beyond : box.min[axis] - beyond; });
        EXPECT_NEAR(within(region, t).area, factor < 1.0 ? 0.005 : 0.0, 1e-12) << direction;
      }
    }
  }
}

TEST(ConvexRegion, OfAPrismThatIsABoxIsTheBox)
{
  const Box3 box{Vec3(-1, -2, -1.5), Vec3(2, 1, 1)};
  const std::vector<ConvexRegion> regions{
      ConvexRegion(PlacedPrism({Placement(), box}), 0.25),
      ConvexRegion(PlacedPrism(Placement(), {{-1, -2}, {2, -2}, {2, 1}, {-1, 1}}, -1.5, 1.0), 0.25)};
  const ConvexRegion expected(box, 0.25);
  RandomTriangles triangles(5);
  for (int round = 0; round < 300; ++round)
  {
    const Corners t = triangles.triangle();
    for (const ConvexRegion& region : regions)
    {
      EXPECT_NEAR(within(region, t, 0.5).area, within(expected, t).area, 1e-11);
      EXPECT_NEAR(within(region, t, 0.5).heightTimesArea, within(expected, t, 0.5).heightTimesArea, 1e-11);
    }
  }
}

TEST(ConvexRegion, OfPartsOfAPrismHaveAllThatThePrismHas)
{
  const std::vector<Vec2> hexagon{{2, 0}, {1, 1.7}, {-1, 1.7}, {-2, 0}, {-1, -1.7}, {1, -1.7}};
  const std::vector<Vec2> upper(hexagon.begin(), hexagon.begin() + 4);
  const std::vector<Vec2> lower{hexagon[3], hexagon[4], hexagon[5], hexagon[0]};
  const ConvexRegion whole(PlacedPrism(Placement(), hexagon, -2.0, 2.0), 0.0);
  const std::vector<ConvexRegion> parts{ConvexRegion(PlacedPrism(Placement(), upper, -2.0, 1.0), 0.0),
                                        ConvexRegion(PlacedPrism(Placement(), lower, -2.0, 1.0), 0.0),
                                        ConvexRegion(PlacedPrism(Placement(), hexagon, 1.0, 2.0), 0.0)};
  RandomTriangles triangles(7);
  for (int round = 0; round < 200; ++round)
  {
    const Corners t = triangles.triangle();
    EXPECT_NEAR(sumOver(parts, t, 0.0).area, within(whole, t).area, 1e-11);
  }
  const Corners level{Vec3(-99, -99, 0), Vec3(99, -99, 0), Vec3(0, 99, 0)};
  EXPECT_NEAR(within(whole, level).area, 2 * 1.7 * 3, 1e-9);
}

// Drawn surfaces.

TEST(DrawnSurfaces, AreMeasuredWithinTheDomainAndOutside)
{
  TriangleSurface surface;
  addSheet(surface, "Inside", Vec3(1, 1, 1), Vec3(2, 0, 0), Vec3(0, 3, 0));
  addSheet(surface, "Half", Vec3(-2, 0, 0), Vec3(4, 0, 0), Vec3(0, 5, 0));
  addSheet(surface, "Buried", Vec3(5, 1, -3), Vec3(0, 2, 0), Vec3(0, 0, 4));
  addSheet(surface, "Far", Vec3(50, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0));
  surface.names.emplace_back("Nothing");
  addSheet(surface, "Twice", Vec3(1, 1, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  addSheet(surface, "Twice", Vec3(1, 1, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  surface.names.pop_back();
  std::ranges::replace(surface.surfaceIds, Index{6}, Index{5});
  addSheet(surface, "Side", Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  surface.names.pop_back(); // its triangles are sides of the domain
  for (const double degrees : {0.0, 30.0, 90.0})
  {
    SCOPED_TRACE(degrees);
    TriangleSurface turned = surface;
    atria::testing::turn(turned, degrees);
    const PlacedPrism domain({Placement(degrees), Box3{Vec3(0, 0, 0), Vec3(10, 10, 10)}});
    const DrawnSurfaces drawn = measureDrawn(turned, domain, 1e-9);
    const auto near = [](double value) { return DoubleNear(value, 1e-6); };
    EXPECT_THAT(drawn.areas, ElementsAre(near(6), near(10), near(2), near(0), near(0), near(2)));
    EXPECT_THAT(drawn.outside, ElementsAre(near(0), near(10), near(6), near(12), near(0), near(0)));
    EXPECT_EQ(drawn.extents.size(), 6U);
    EXPECT_EQ(drawn.extents[4], 0.0) << "it has no triangles";
    EXPECT_NEAR(drawn.extents[2], std::hypot(2.0, 4.0), 1e-9);
  }
}

TEST(DrawnSurfaces, HaveAllOfTheirAreaInAreasAndOutside)
{
  RandomTriangles triangles(11);
  TriangleSurface surface;
  std::vector<double> expected;
  std::vector<Box3> bounds;
  for (int i = 0; i < 30; ++i)
  {
    const Corners t = triangles.triangle();
    addSurface(surface, "S" + std::to_string(i), {t[0], t[1], t[2]}, {{0, 1, 2}});
    expected.push_back(areaOf(t));
    bounds.emplace_back();
    std::ranges::for_each(t, [&](const Vec3& p) { bounds.back().extend(p); });
  }
  const DrawnSurfaces drawn = measureDrawn(surface, {{Placement(20.0), {Vec3(-2, -2, -2), Vec3(2, 2, 3)}}, 5}, 0.0);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_NEAR(drawn.areas[i] + drawn.outside[i], expected[i], 1e-11);
    EXPECT_GE(drawn.areas[i], 0.0);
    EXPECT_GE(drawn.outside[i], 0.0);
    EXPECT_DOUBLE_EQ(drawn.extents[i], bounds[i].size().norm());
  }
}

// Distances.

/// A model on the lattice of a domain, and a mesh of boxes above it that is not made of it.
struct Setting
{
  Setting()
  {
    GridOptions grid;
    grid.domain = {Vec3(-1, -1, -8), Vec3(9, 9, 8)};
    grid.sizeMin = 0.25;
    frame = makeGridFrame(grid, grid.domain);
    octree = Octree(frame, {});
    finest = static_cast<std::uint8_t>(frame.depth);
  }

  void addTriangle(Index surface, const Corners& corners)
  {
    const auto first = static_cast<Index>(model.points.size());
    std::ranges::for_each(corners, [&](const Vec3& p) { model.points.push_back(frame.toLattice(p)); });
    model.triangles.push_back({first, first + 1, first + 2});
    model.surfaceIds.push_back(surface);
    model.domainSides.push_back(SurfaceModel::noSide);
    while (model.names.size() <= surface)
    {
      model.names.emplace_back("S");
    }
  }
  void addPlane(Index surface, double z)
  {
    addTriangle(surface, {Vec3(-1, -1, z), Vec3(9, -1, z), Vec3(9, 9, z)});
    addTriangle(surface, {Vec3(-1, -1, z), Vec3(9, 9, z), Vec3(-1, 9, z)});
  }

  /// Adds a row of unit boxes from x = 0 on, whose bottoms are faces of a surface.
  void addRow(int count, double y, double z, Index tag)
  {
    for (int i = 0; i < count; ++i)
    {
      std::array<Index, 8> corners{};
      for (std::size_t c = 0; c < 8; ++c)
      {
        const unsigned bits = hexahedronCorner[c];
        const Vec3 at(i + (bits & 1U), y + (bits >> 1 & 1U), z + (bits >> 2 & 1U));
        corners[c] = numberOf(at);
      }
      const auto element = static_cast<Index>(mesh.corners.size());
      mesh.corners.push_back(corners);
      mesh.levels.push_back(std::uint8_t{finest});
      mesh.boundaryFaces.push_back({element, tag, noIndex, zMin, SheetSide::front, false, 0});
    }
  }
  Index numberOf(const Vec3& at)
  {
    const auto found = std::ranges::find(mesh.points, at);
    if (found == mesh.points.end())
    {
      mesh.points.push_back(at);
      return static_cast<Index>(mesh.points.size() - 1);
    }
    return static_cast<Index>(found - mesh.points.begin());
  }

  std::vector<SurfaceDistances> measure(const std::vector<SurfaceSample>& samples = {}, const OwnElements& part = {},
                                        int threads = 1) const
  {
    const ThreadExecutor executor(threads);
    const TriangleTreeOnDemand tree(model);
    return measureDistances(mesh, samples, part, MeshingContext{quietContext(executor), octree, model, tree});
  }

  GridFrame frame;
  Octree octree;
  std::uint8_t finest = 0;
  SurfaceModel model;
  DualMesh mesh;
};

/// Returns the corners of the loop of a face, then its middle.
std::vector<Vec3> placesOf(const DualMesh& mesh, Index element, std::uint8_t direction)
{
  std::vector<Vec3> places;
  const ReducedFace face = faceOf(mesh.corners[element], direction);
  std::ranges::transform(face.loop(), std::back_inserter(places), [&](Index p) { return mesh.points[p]; });
  places.push_back(std::accumulate(places.begin(), places.end(), Vec3(Vec3::Zero())) / face.count);
  return places;
}

TEST(MeshDistances, OfFacesAreThoseOfTheirFarthestCornerOrMiddle)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-0.4, 0.4);
  for (int round = 0; round < 20; ++round)
  {
    Setting setting;
    setting.addPlane(0, 0.5);
    setting.addRow(5, 0.0, 0.5, 0);
    std::ranges::for_each(setting.mesh.points, [&](Vec3& p) { p[2] += round == 0 ? 0.25 : some(random); });
    double expected = 0.0;
    Vec3 at;
    for (const BoundaryFace& face : setting.mesh.boundaryFaces)
    {
      for (const Vec3& place : placesOf(setting.mesh, face.element, face.direction))
      {
        at = std::abs(place[2] - 0.5) > expected + 1e-9 ? place : at;
        expected = std::max(expected, std::abs(place[2] - 0.5));
      }
    }
    const FarthestPlace found = setting.measure()[0].ofFaces;
    EXPECT_NEAR(found.distance, expected, 1e-6);
    EXPECT_NEAR(found.inElements, expected / 0.25, 1e-5);
    EXPECT_TRUE(round == 0 || (found.at - at).norm() < 1e-9);
    EXPECT_EQ(setting.measure({}, {}, 3)[0].ofFaces.at, found.at);
  }
}

TEST(MeshDistances, OfFacesKnowTheirMiddles)
{
  // Corners on the tips of a roof that is turned over, whose valley is below the middle.
  Setting setting;
  setting.addTriangle(0, {Vec3(0, -1, 0), Vec3(0, 2, 0), Vec3(0.5, 0.5, -0.5)});
  setting.addTriangle(0, {Vec3(1, 2, 0), Vec3(1, -1, 0), Vec3(0.5, 0.5, -0.5)});
  setting.addRow(1, 0.0, 0.0, 0);
  const FarthestPlace found = setting.measure()[0].ofFaces;
  EXPECT_NEAR(found.distance, 0.5 / std::sqrt(2.0), 1e-6);
  EXPECT_LT((found.at - Vec3(0.5, 0.5, 0)).norm(), 1e-12);
}

TEST(MeshDistances, AreLargestInSizesOfElements)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addRow(2, 0.0, 0.0, 0);
  setting.addRow(2, 4.0, 0.0, 0);
  for (Vec3& p : setting.mesh.points)
  {
    p[2] += p[1] > 3.0 ? 0.75 : 0.5;
  }
  setting.mesh.levels[2] = setting.mesh.levels[3] = static_cast<std::uint8_t>(setting.finest - 1);
  const FarthestPlace found = setting.measure()[0].ofFaces;
  EXPECT_NEAR(found.distance, 0.5, 1e-6) << "0.75 are fewer elements of 0.5";
  EXPECT_NEAR(found.inElements, 2.0, 1e-5);
}

TEST(MeshDistances, OfPointsAreInElementsOfTheirFirstFace)
{
  for (const Index coarse : {0U, 1U})
  {
    Setting setting;
    setting.addPlane(0, 0.0);
    setting.addRow(2, 0.0, 0.0, 0);
    setting.mesh.points[setting.numberOf(Vec3(1, 0, 0))][2] = -0.5; // both faces have it
    setting.mesh.levels[coarse] = static_cast<std::uint8_t>(setting.finest - 1);
    const FarthestPlace found = setting.measure()[0].ofFaces;
    EXPECT_NEAR(found.inElements, coarse == 0 ? 1.0 : 2.0, 1e-5);
    EXPECT_NEAR(found.distance, 0.5, 1e-6);
  }
}

TEST(MeshDistances, OfFacesAreFromTheirOwnSurface)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 6.0); // far beyond the other one
  setting.addPlane(2, -0.25);
  setting.model.names.emplace_back("Empty");
  setting.addRow(2, 0.0, 0.0, 0);
  setting.addRow(2, 2.0, 0.0, 1);
  setting.addRow(2, 4.0, 0.0, 3); // of a surface without triangles
  setting.addRow(2, 6.0, 3.0, 4); // of a side of the domain
  const std::vector<SurfaceDistances> found = setting.measure();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].ofFaces.distance, 0.0);
  EXPECT_NEAR(found[1].ofFaces.distance, 6.0, 1e-6);
  EXPECT_NEAR(found[1].ofFaces.inElements, 24.0, 1e-4);
  EXPECT_EQ(found[2].ofFaces.distance, 0.0) << "it has no faces";
  EXPECT_EQ(found[3].ofFaces.distance, 0.0);
}

TEST(MeshDistances, AreThoseOfZoneFacesAndOfOwnElements)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addRow(3, 0.0, 0.0, 0);
  setting.mesh.points[setting.numberOf(Vec3(3, 1, 0))][2] = 0.5;
  setting.mesh.boundaryFaces.pop_back();
  EXPECT_EQ(setting.measure()[0].ofFaces.distance, 0.0);
  setting.mesh.zoneFaces.push_back({2, 0, zMin, SheetSide::front});
  EXPECT_NEAR(setting.measure()[0].ofFaces.distance, 0.5, 1e-6);
  for (const Index owned : {1U, 2U})
  {
    const OwnElements part{[&](Index element) { return element == owned; }};
    EXPECT_NEAR(setting.measure({}, part)[0].ofFaces.distance, owned == 2 ? 0.5 : 0.0, 1e-6);
  }
}

TEST(MeshDistances, OfSamplesAreThoseFromTheNearestFace)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 0.0);
  setting.addRow(2, 0.0, 0.0, 0);
  setting.addRow(2, 4.0, 2.0, 1);
  const std::vector<std::pair<Vec3, double>> cases{{Vec3(0.3, 0.2, 0), 0.0},                   // on a face
                                                   {Vec3(1, 1, 0), 0.0},                       // on a point
                                                   {Vec3(1.5, 0.5, -2), 2.0},                  // below a face
                                                   {Vec3(2.75, 0.5, 0), 0.75},                 // beside an edge
                                                   {Vec3(5, 5, 0), 5.0},                       // off a corner
                                                   {Vec3(0.5, 4.5, 2), std::hypot(3.5, 2.0)}}; // on one of another
  for (const auto& [at, distance] : cases)
  {
    const std::vector<SurfaceDistances> found = setting.measure({{at, 0, 0.5F}});
    EXPECT_NEAR(found[0].ofSurface.distance, distance, 1e-6) << at.transpose();
    EXPECT_NEAR(found[0].ofSurface.inElements, 2.0 * distance, 1e-5);
    EXPECT_EQ(found[0].ofSurface.at, distance > 0.0 ? at : Vec3(Vec3::Zero()));
    EXPECT_EQ(found[1].ofSurface.distance, 0.0) << "it has no samples";
  }
}

TEST(MeshDistances, OfSamplesDoNotTakeTheFacesOfTheSampleBefore)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 0.0);
  setting.addRow(1, 0.0, 0.0, 0);
  setting.addRow(1, 0.0, 2.0, 1);
  const Vec3 at(0.5, 0.4, 0.0); // on the face of surface 0
  const std::vector<SurfaceDistances> found = setting.measure({{at, 0, 0.5F}, {at, 1, 0.5F}, {at, 0, 0.5F}});
  EXPECT_EQ(found[0].ofSurface.distance, 0.0);
  EXPECT_NEAR(found[1].ofSurface.distance, 2.0, 1e-6);
}

TEST(MeshDistances, OfSamplesCountFromATenthOfAnElementOn)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addPlane(1, 0.0);
  setting.addRow(2, 0.0, 0.0, 0);
  for (const double factor : {0.99, 1.01})
  {
    const double distance = factor * 0.1 * 0.5;
    const FarthestPlace found = setting.measure({{Vec3(0.5, 0.5, -distance), 0, 0.5F}})[0].ofSurface;
    EXPECT_NEAR(found.distance, factor < 1.0 ? 0.0 : distance, 1e-6);
  }
  EXPECT_EQ(setting.measure({{Vec3(0.5, 0.5, -3), 1, 0.5F}})[1].ofSurface.distance, 0.0) << "it has no faces";
}

TEST(MeshDistances, OfManySamplesAreLargestInSizesOfTheirEdges)
{
  Setting setting;
  setting.addPlane(0, 0.0);
  setting.addRow(4, 0.0, 0.0, 0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> some(0.0, 1.0);
  std::vector<SurfaceSample> samples;
  for (int i = 0; i < 2500; ++i) // more than two pieces
  {
    samples.push_back({Vec3(4 * some(random), some(random), -4 * some(random)), 0, i % 3 == 0 ? 0.25F : 0.5F});
  }
  const auto inElements = [](const SurfaceSample& sample) { return -sample.at[2] / static_cast<double>(sample.size); };
  const SurfaceSample& farthest = *std::ranges::max_element(samples, {}, inElements);
  for (const int threads : {1, 3})
  {
    const FarthestPlace found = setting.measure(samples, {}, threads)[0].ofSurface;
    EXPECT_EQ(found.at, farthest.at);
    EXPECT_NEAR(found.inElements, inElements(farthest), 1e-5);
    EXPECT_NEAR(found.distance, -farthest.at[2], 1e-6);
  }
}

// Samples of surfaces.

/// The first points of a grid of some points.
class OwnPoints : public GridPart
{
public:
  OwnPoints(Index begin, Index end) : GridPart({begin, end}, {0, 1}, alone()) {}
};

/// Edges of a grid with cuts, and what is at their ends.
struct CutEdges : Setting
{
  /// Adds a triangle of a wall, or of one that can be looked through.
  Index addSurfaceOf(SurfaceKind kind)
  {
    const auto surface = static_cast<Index>(model.names.size());
    addTriangle(surface, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
    model.kinds.push_back(kind);
    return static_cast<Index>(model.triangles.size() - 1);
  }

  /// Adds an edge from (0, 0, 0) to (1, 2, 4) between two points of their own, one after the other; no second point if
  /// `hasOther` is false. Cuts are at a tenth, two tenths and so on.
  void addEdge(const std::vector<Index>& triangles, View first, View second, bool hasOther = true)
  {
    const auto pointOf = [&](View view) {
      zones.ofPoint.push_back(static_cast<std::int32_t>(view));
      return static_cast<Index>(zones.ofPoint.size() - 1);
    };
    const Index point = pointOf(first);
    const Index other = pointOf(second);
    const EdgeSegment segment{frame.toLattice(Vec3(0, 0, 0)),
                              frame.toLattice(Vec3(1, 2, 4)),
                              -1,
                              frame.latticeSize(frame.depth - 1),
                              {0, 0, noIndex, noIndex}};
    crossings.crossedEdges.push_back({point, hasOther ? other : noIndex, xMax, segment,
                                      static_cast<std::uint32_t>(crossings.cuts.size()),
                                      static_cast<std::uint32_t>(triangles.size())});
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      crossings.cuts.push_back({triangles[i], 1, 0.1 * static_cast<double>(i + 1)});
    }
  }

  std::vector<SurfaceSample> sample(Index begin, Index end, int threads = 1) const
  {
    std::vector<View> views; // zones have the numbers of their views
    for (std::size_t view = 0; view < viewCount; ++view)
    {
      views.push_back(static_cast<View>(view));
    }
    const ThreadExecutor executor(threads);
    const TriangleTreeOnDemand tree(model);
    return sampleSurfaces(crossings, zones, views, OwnPoints(begin, end),
                          MeshingContext{quietContext(executor), octree, model, tree});
  }
  std::vector<SurfaceSample> sampleAll(int threads = 1) const
  {
    return sample(0, static_cast<Index>(zones.ofPoint.size()), threads);
  }
  std::vector<Index> surfacesOf() const
  {
    std::vector<Index> surfaces;
    std::ranges::transform(sampleAll(), std::back_inserter(surfaces), &SurfaceSample::surface);
    return surfaces;
  }

  Crossings crossings;
  Zones zones;
};

/// Returns the places of the cuts that are seen, in order: from the start, then from the end.
std::vector<std::size_t> naiveSeen(const std::vector<bool>& isWall, bool airAtStart, bool airAtEnd)
{
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < isWall.size() && airAtStart; ++i)
  {
    if (std::find(isWall.begin(), isWall.begin() + static_cast<std::ptrdiff_t>(i), true) ==
        isWall.begin() + static_cast<std::ptrdiff_t>(i))
    {
      seen.push_back(i);
    }
  }
  for (std::size_t i = isWall.size(); i-- > 0 && airAtEnd;)
  {
    const auto after = isWall.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (std::find(after, isWall.end(), true) == isWall.end() && std::ranges::count(seen, i) == 0)
    {
      seen.push_back(i);
    }
  }
  return seen;
}

TEST(SurfaceSamples, AreTakenUpToTheFirstWallFromEachEnd)
{
  for (std::size_t count = 0; count <= 4; ++count)
  {
    for (unsigned bits = 0; bits < 4U << count; ++bits)
    {
      CutEdges edges;
      std::vector<bool> isWall;
      std::vector<Index> triangles;
      for (std::size_t i = 0; i < count; ++i)
      {
        isWall.push_back((bits >> i & 1U) != 0);
        triangles.push_back(edges.addSurfaceOf(isWall.back() ? SurfaceKind::wall : SurfaceKind::faceZone));
      }
      const bool airAtStart = (bits >> count & 1U) != 0;
      const bool airAtEnd = (bits >> (count + 1) & 1U) != 0;
      edges.addEdge(triangles, airAtStart ? View::air : View::solid, airAtEnd ? View::air : View::room);
      std::vector<Index> expected;
      for (const std::size_t place : naiveSeen(isWall, airAtStart, airAtEnd))
      {
        expected.push_back(edges.model.surfaceIds[triangles[place]]);
      }
      EXPECT_EQ(edges.surfacesOf(), expected) << count << ' ' << bits;
    }
  }
}

TEST(SurfaceSamples, LieWhereTheEdgeIsCut)
{
  CutEdges edges;
  const Index wall = edges.addSurfaceOf(SurfaceKind::wall);
  edges.addEdge({wall, wall, wall}, View::air, View::air);
  const std::vector<SurfaceSample> samples = edges.sampleAll();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_LT((samples[0].at - Vec3(0.1, 0.2, 0.4)).norm(), 1e-6);
  EXPECT_LT((samples[1].at - Vec3(0.3, 0.6, 1.2)).norm(), 1e-6);
  EXPECT_FLOAT_EQ(samples[0].size, 0.5F) << "octants of the second level from below";
}

TEST(SurfaceSamples, AreTakenFromAirOnly)
{
  CutEdges edges;
  const Index wall = edges.addSurfaceOf(SurfaceKind::wall);
  for (const View view : {View::nothing, View::ground, View::solid, View::narrow, View::room, View::beyond})
  {
    edges.addEdge({wall}, view, view);
  }
  edges.addEdge({wall}, View::solid, View::air, false); // outside of the domain there is no air
  EXPECT_THAT(edges.surfacesOf(), IsEmpty());
  edges.addEdge({wall}, View::solid, View::air);
  EXPECT_EQ(edges.surfacesOf().size(), 1U);
}

TEST(SurfaceSamples, AreNotTakenOnSidesOfADomainNorInClusters)
{
  CutEdges edges;
  const Index wall = edges.addSurfaceOf(SurfaceKind::wall);
  edges.addEdge({wall}, View::air, View::solid);
  EXPECT_EQ(edges.surfacesOf().size(), 1U);
  for (const FeatureType type : {FeatureType::several, FeatureType::cluster})
  {
    edges.octree.setItems({0, 0}, {}, {type});
    EXPECT_EQ(edges.surfacesOf().size(), type == FeatureType::cluster ? 0U : 1U);
  }
  edges.octree.setItems({0, 0}, {}, {FeatureType::none});
  edges.model.surfaceIds[wall] = static_cast<Index>(edges.model.names.size());
  EXPECT_THAT(edges.surfacesOf(), IsEmpty());
}

TEST(SurfaceSamples, AreTakenByTheOwnersOfEdgesInTheOrderOfThese)
{
  CutEdges edges;
  const Index first = edges.addSurfaceOf(SurfaceKind::wall);
  const Index second = edges.addSurfaceOf(SurfaceKind::wall);
  std::vector<Index> expected;
  std::mt19937 random(5);
  for (int i = 0; i < 9000; ++i) // more than two pieces
  {
    expected.push_back(static_cast<Index>(random() % 2));
    edges.addEdge({expected.back() == 0 ? first : second}, View::air, View::solid);
  }
  EXPECT_EQ(edges.surfacesOf(), expected);
  EXPECT_EQ(edges.sampleAll(3).size(), expected.size());
  const std::vector<SurfaceSample> some = edges.sample(4, 9); // starts of edges 2, 3 and 4
  ASSERT_EQ(some.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(some[i].surface, expected[i + 2]);
  }
}

// Parts that no air reaches.

TEST(UnreachedAreas, CountTowardWhatHidesThem)
{
  struct Case
  {
    View front;
    View back;
    View counted;
  };
  const std::vector<Case> cases{{View::solid, View::solid, View::solid},   {View::ground, View::ground, View::ground},
                                {View::solid, View::ground, View::ground}, {View::ground, View::solid, View::ground},
                                {View::room, View::solid, View::room},     {View::solid, View::room, View::room},
                                {View::narrow, View::solid, View::narrow}, {View::ground, View::room, View::room},
                                {View::nothing, View::solid, View::solid}};
  for (const Case& one : cases)
  {
    Setting setting;
    setting.addTriangle(0, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
    setting.addTriangle(1, {Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(0, 2, 1)});
    setting.addTriangle(1, {Vec3(0, 0, 2), Vec3(9, 0, 2), Vec3(0, 9, 2)});  // is reached
    setting.addTriangle(1, {Vec3(8, 0, 3), Vec3(10, 0, 3), Vec3(8, 2, 3)}); // in part beyond the domain
    const TriangleViews views{one.front, one.back};
    const UnreachedParts parts{{0, 1, 0, 1}, std::vector<TriangleViews>(4, views)};
    const std::vector<ViewAreas> areas = areasOf(parts, setting.model, setting.frame);
    ASSERT_EQ(areas.size(), 2U);
    EXPECT_EQ(areas[0], ViewAreas{});
    ViewAreas expected{};
    expected[static_cast<std::size_t>(one.counted)] = 2.0 + 1.5;
    for (std::size_t view = 0; view < viewCount; ++view)
    {
      EXPECT_NEAR(areas[1][view], expected[view], 1e-5) << view;
    }
  }
  EXPECT_THAT(areasOf({}, Setting().model, Setting().frame), IsEmpty());
}

} // namespace
