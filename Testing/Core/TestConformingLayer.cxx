// SPDX-License-Identifier: GPL-3.0-or-later
/// Where layers grow, which way, and how thick.
#include "Dual/Vertices/TurnedDomain.h"
#include "Layer/BoundaryLayers.h"
#include "Layer/ElementShape.h"
#include "Layer/LayerCoverage.h"
#include "Layer/LayerHeights.h"
#include "Support/DualMeshChecks.h"
#include "Support/Error.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>

namespace {

using namespace atria;
using namespace atria::testing;

/// Octants of one size in a cube of 4 about the origin.
GridOptions gridOf(double size)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-2.0), Vec3::Constant(2.0)};
  grid.sizeMin = grid.sizeMid = grid.sizeMax = size;
  return grid;
}

Meshed meshAll(const TriangleSurface& surface, const GridOptions& grid)
{
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.layers = {{"*", {0}}}; // the plain dual, made valid
  options.supportElements = false;
  return meshIt(surface, grid, options);
}

/// A mesh and the layers on it.
struct Layered
{
  Layered(Meshed made, const std::vector<LayerRule>& rules) : meshed(std::move(made))
  {
    options.ofTag = resolveLayerRules(rules, meshed.model.names);
    options.sideNormals = sideNormalsOf(meshed.frame);
    walls = findLayerWalls(plain(), options, quietContext());
    one = LayerGrower(walls, options).grow(plain(), {}, quietContext());
  }

  const DualMesh& plain() const { return meshed.mesh(); }
  LayerMesh divided() const { return divideLayer(plain(), walls, one, options, layersWanted(walls, one)); }
  Vec3 wayOf(Index point) const { return one.mesh.points[one.copies[point]] - plain().points[point]; }

  /// Points with faces of this tag.
  std::vector<Index> pointsOf(Index tag) const
  {
    std::vector<Index> points;
    for (const BoundaryFace& face : plain().boundaryFaces)
    {
      for (int i = 0; i < 4 && face.tag == tag; ++i)
      {
        points.push_back(cornerOf(plain(), face, i));
      }
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  std::size_t copyCount(Index tag) const
  {
    const std::vector<Index> points = pointsOf(tag);
    return std::count_if(points.begin(), points.end(), [&](Index p) { return one.copies[p] != noIndex; });
  }

  Meshed meshed;
  LayerOptions options;
  LayerWalls walls;
  LayerMesh one;
};

const std::vector<LayerRule> single{{"*", {1}}};

void expectValid(const LayerMesh& layer, const DualMesh& plain)
{
  EXPECT_TRUE(isConformal(layer.mesh, layer.plainElements));
  EXPECT_TRUE(facesAreUnique(layer.mesh));
  EXPECT_TRUE(boundaryIsWatertight(layer.mesh));
  EXPECT_NEAR(totalVolume(layer.mesh) / totalVolume(plain), 1.0, 1e-9);
  std::size_t invalid = 0;
  for (const auto& corners : layer.mesh.corners)
  {
    invalid += shapeOf(layer.mesh.points, corners).pyramid <= 0.0 ? 1 : 0;
  }
  EXPECT_EQ(invalid, 0u);
}

TriangleSurface sheet()
{
  TriangleSurface surface;
  addSheet(surface, "Sheet", {-1.03, -0.97, 0.05}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0});
  return surface;
}

TEST(ConformingLayer, CoversASphereAndABoxWhole)
{
  TriangleSurface sphere;
  addSphere(sphere, "Solid", Vec3::Zero(), 1.3, 3);
  TriangleSurface box;
  addBox(box, "Solid", {Vec3(-1.1, -0.9, -0.7), Vec3(0.8, 1.2, 1.0)});
  for (const TriangleSurface& surface : {sphere, box})
  {
    const Layered layered(meshAll(surface, gridOf(0.2)), single);
    EXPECT_EQ(layered.copyCount(0), layered.pointsOf(0).size());
    expectValid(layered.one, layered.plain());
    const LayerReport report =
        reportLayers(layered.one, layered.walls, sizesBesideWalls(layered.plain(), layered.walls, quietContext()),
                     layered.options, layered.meshed.model.names);
    ASSERT_EQ(report.surfaces.size(), 1u);
    EXPECT_DOUBLE_EQ(report.surfaces[0].full, report.surfaces[0].area);
    EXPECT_GT(report.surfaces[0].thickness, 0.5);
  }
}

/// Ways out of wall faces at those of their angles that are nearly 180 degrees, by point.
std::map<Index, std::vector<Vec3>> waysOutOfStraight(const DualMesh& mesh)
{
  std::map<Index, std::vector<Vec3>> ways;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Index p = cornerOf(mesh, face, i);
      const Vec3 before = (mesh.points[cornerOf(mesh, face, i + 3)] - mesh.points[p]).normalized();
      const Vec3 after = (mesh.points[cornerOf(mesh, face, i + 1)] - mesh.points[p]).normalized();
      if (before.dot(after) < -0.999)
      {
        const Vec3 inwards = mesh.points[cornerOf(mesh, face, i + 2)] - mesh.points[p];
        ways[p].push_back((inwards.dot(after) * after - inwards).normalized());
      }
    }
  }
  return ways;
}

/// Halfway between the normals of the walls about a point, where there are two.
std::optional<Vec3> halfway(const Layered& layered, Index point)
{
  std::map<Index, Vec3> normals;
  for (const Index f : layered.walls.graph.facesAt(point))
  {
    const BoundaryFace& face = layered.plain().boundaryFaces[f];
    normals[face.chart] = wallNormal(layered.plain(), face).normalized();
  }
  return normals.size() == 2 ? std::optional((normals.begin()->second + normals.rbegin()->second).normalized())
                             : std::nullopt;
}

TEST(ConformingLayer, LeansOutOfFacesThatAreStraightOnACrease)
{
  TriangleSurface box;
  addBox(box, "Solid", {Vec3(-1.1, -0.9, -0.7), Vec3(0.8, 1.2, 1.0)});
  const Eigen::AngleAxisd turn(0.5, Vec3(1.0, 2.0, 3.0).normalized());
  std::ranges::transform(box.points, box.points.begin(), [&](const Vec3& p) { return Vec3(turn * p); });
  const Layered layered(meshAll(box, gridOf(0.2)), single);
  std::size_t leaning = 0;
  for (const auto& [p, ways] : waysOutOfStraight(layered.plain()))
  {
    const std::optional<Vec3> upright = halfway(layered, p);
    if (upright && ways.size() == 1 && layered.one.copies[p] != noIndex)
    {
      EXPECT_GT((layered.wayOf(p).normalized() - *upright).dot(ways[0]), 0.1);
      ++leaning;
    }
  }
  EXPECT_GT(leaning, 20u);
}

TEST(ConformingLayer, TapersToNothingAtTheBoundaryEdgeOfASheet)
{
  const Layered layered(meshAll(sheet(), gridOf(0.2)), single);
  expectValid(layered.one, layered.plain());
  const std::vector<Index> points = layered.pointsOf(0);
  std::size_t boundaryEdge = 0;
  for (const Index p : points)
  {
    const Vec3 at = layered.plain().points[p];
    EXPECT_NEAR(at[2], 0.05, 1e-9);
    const Vec3 outside = (at - Vec3(1.0 - 0.03, 1.0 + 0.03, 0.0)).cwiseMax(Vec3(-1.03, -0.97, 0.0) - at);
    if (std::max(outside[0], outside[1]) > -1e-9)
    {
      ++boundaryEdge;
      EXPECT_EQ(layered.one.copies[p], atria::noIndex) << at.transpose();
    }
    else
    {
      ASSERT_NE(layered.one.copies[p], atria::noIndex) << at.transpose();
      const Vec3 way = layered.wayOf(p);
      EXPECT_NEAR(way.head<2>().norm(), 0.0, 1e-9) << "across the sheet";
      EXPECT_GT(std::abs(way[2]), 0.01);
    }
  }
  EXPECT_GT(boundaryEdge, 30u);
  EXPECT_EQ(layered.copyCount(0), points.size() - boundaryEdge);
}

TEST(ConformingLayer, LeavesOutASheetOneFaceWideAndCoversOneTwoFacesWide)
{
  // Octants of 0.4 in rows at -0.2 and 0.2 about y = 0.
  for (const int creaseSheets : {1, 2})
  {
    TriangleSurface surface;
    addSheet(surface, "Strip", {-1.0, 0.01, 0.05}, {2.0, 0.0, 0.0}, {0.0, 0.4 * creaseSheets - 0.02, 0.0});
    const Layered layered(meshAll(surface, gridOf(0.4)), single);
    expectValid(layered.one, layered.plain());
    std::size_t faces = 0;
    for (const BoundaryFace& face : layered.plain().boundaryFaces)
    {
      faces += face.tag == 0 && face.side == SheetSide::front ? 1 : 0;
    }
    ASSERT_GT(faces, 0u);
    std::size_t split = 0;
    for (const Index p : layered.pointsOf(0))
    {
      split += layered.walls.graph.facesAt(p).size() == 4 && layered.one.copies[p] != noIndex ? 1 : 0;
    }
    if (creaseSheets == 1)
    {
      EXPECT_EQ(layered.copyCount(0), 0u);
    }
    else
    {
      EXPECT_GT(split, 0u);
    }
  }
}

TEST(ConformingLayer, HasThreeCopiesWhereASheetEndsOnAnother)
{
  TriangleSurface surface;
  addSheet(surface, "Floor", {-1.9, -1.9, 0.05}, {3.8, 0.0, 0.0}, {0.0, 3.8, 0.0});
  addSheet(surface, "Wall", {0.05, -1.1, 0.05}, {0.0, 2.2, 0.0}, {0.0, 0.0, 1.2});
  const Layered layered(meshAll(surface, gridOf(0.2)), single);
  expectValid(layered.one, layered.plain());
  std::map<std::array<double, 3>, std::vector<Vec3>> ways;
  for (const Index p : layered.pointsOf(1))
  {
    const Vec3& at = layered.plain().points[p];
    if (std::abs(at[2] - 0.05) < 1e-9 && std::abs(at[1]) < 0.8)
    {
      ASSERT_NE(layered.one.copies[p], noIndex);
      ways[{at[0], at[1], at[2]}].push_back(layered.wayOf(p).normalized());
    }
  }
  EXPECT_GE(ways.size(), 6u);
  for (const auto& [at, directions] : ways)
  {
    // The third is below the floor, and belongs to no face of the wall.
    ASSERT_EQ(directions.size(), 2u);
    EXPECT_LT(directions[0][0] * directions[1][0], 0.0);
    for (const Vec3& d : directions)
    {
      EXPECT_NEAR(std::abs(d[0]), std::sqrt(0.5), 1e-9) << "half way between floor and wall";
      EXPECT_NEAR(d[2], std::sqrt(0.5), 1e-9);
    }
  }
}

TEST(ConformingLayer, EndsOnTheSidesOfTheDomain)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {-3.0, 0.05, -3.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, 6.0});
  const Layered layered(meshAll(surface, gridOf(0.2)), single);
  expectValid(layered.one, layered.plain());
  EXPECT_EQ(layered.copyCount(0), layered.pointsOf(0).size());
  std::map<Index, double> areas;
  for (const DualMesh* mesh : {&layered.plain(), &layered.one.mesh})
  {
    for (const BoundaryFace& face : mesh->boundaryFaces)
    {
      areas[face.tag] += (mesh == &layered.plain() ? -1.0 : 1.0) * wallNormal(*mesh, face).norm();
      for (int i = 0; i < 4 && face.tag >= 1; ++i)
      {
        const int side = static_cast<int>(face.tag) - 1;
        EXPECT_EQ(mesh->points[cornerOf(*mesh, face, i)][axisOf(side)], isUpper(side) ? 2.0 : -2.0);
      }
    }
  }
  for (const auto& [tag, difference] : areas)
  {
    EXPECT_NEAR(difference, 0.0, 1e-9) << "tag " << tag;
  }
}

TEST(ConformingLayer, GrowsOnBareSidesThatAreNamed)
{
  GridOptions grid = gridOf(0.2);
  TriangleSurface surface;
  addBox(surface, "Solid", {Vec3(-0.7, -0.6, -2.0), Vec3(0.6, 0.8, 0.5)});
  turn(surface, 20.0);
  const Layered layered(meshAll(surface, grid), {{"*", {1}}, {"zMin", {1}}});
  EXPECT_EQ(layered.copyCount(1 + zMin), layered.pointsOf(1 + zMin).size()) << "a bare side of that name is a wall";
  EXPECT_EQ(layered.copyCount(1 + zMax), 0u);
  for (const Index p : layered.pointsOf(1 + zMin))
  {
    const Vec3 way = layered.wayOf(p);
    const Vec3& at = layered.plain().points[p];
    for (int axis = 0; axis < 2; ++axis)
    {
      EXPECT_TRUE(std::abs(at[axis]) < 2.0 || way[axis] == 0.0) << "stays in the other sides";
    }
    EXPECT_GT(way[2], 0.0);
  }
}

TEST(ConformingLayer, TapersToNothingBesideASurfaceWithoutLayers)
{
  TriangleSurface surface;
  addSheet(surface, "Plain", {-1.1, 0.05, -1.1}, {1.1, 0.0, 0.0}, {0.0, 0.0, 2.2});
  addSheet(surface, "Layered", {0.0, 0.05, -1.1}, {1.1, 0.0, 0.0}, {0.0, 0.0, 2.2});
  const Layered layered(meshAll(surface, gridOf(0.2)), {{"*", {1}}, {"Pl*", {0}}});
  expectValid(layered.one, layered.plain());
  EXPECT_EQ(layered.copyCount(0), 0u);
  EXPECT_GT(layered.copyCount(1), layered.pointsOf(1).size() / 2);
}

TEST(BoundaryLayers, DivideTheLayerAtGeometricHeights)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {-3.0, 0.05, -3.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, 6.0});
  const double first = 0.01;
  const Layered layered(meshAll(surface, gridOf(0.4)), {{"*", {4, first, 1.5}}});
  const LayerMesh divided = layered.divided();
  expectValid(divided, layered.plain());
  EXPECT_EQ(divided.wallFaces.size(), 4 * layered.one.wallFaces.size());
  const double whole = first * (1.0 + 1.5 + 2.25 + 3.375);
  const std::array<double, 4> expected{first, first * 2.5, first * 4.75, whole};
  for (std::size_t i = 0; i < divided.wallPoints.size(); ++i)
  {
    const double height =
        (divided.mesh.points[divided.plainPoints + i] - divided.mesh.points[divided.wallPoints[i]]).norm();
    EXPECT_NEAR(height, expected[divided.places[i] - 1], 1e-9);
  }
  const LayerReport report =
      reportLayers(divided, layered.walls, sizesBesideWalls(layered.plain(), layered.walls, quietContext()),
                   layered.options, layered.meshed.model.names);
  EXPECT_NEAR(report.surfaces.at(0).thickness, 1.0, 1e-9);
  for (std::size_t f = 0; f < layered.walls.roles.size(); ++f)
  {
    EXPECT_EQ(report.counts[f], layered.walls.roles[f] == FaceRole::wall ? 4 : 0);
  }
}

TEST(BoundaryLayers, FillTheWayTheyAreGiven)
{
  const WallLayers layers{3, 0.1, 2.0};
  const double asked = 0.1 * (1.0 + 2.0 + 4.0);
  const std::vector<double> exact = divideWay(layers, asked);
  EXPECT_NEAR(exact[0] * asked, 0.1, 1e-12);
  EXPECT_NEAR(exact[1] * asked, 0.3, 1e-12);
  EXPECT_EQ(exact[2], 1.0);
  const std::vector<double> thin = divideWay(layers, 0.5 * asked);
  EXPECT_NEAR(thin[0] * 0.5 * asked, 0.1, 1e-9) << "the first keeps its height, growth is lowered";
  const std::vector<double> thinnest = divideWay(layers, 0.2 * asked);
  EXPECT_NEAR(thinnest[0], 1.0 / 3.0, 1e-9) << "but not below 1";
  const WallLayers slow{3, 0.1, 1.2};
  const std::vector<double> stretched = divideWay(slow, 0.5);
  EXPECT_NEAR(stretched[0] * 0.5, 0.1, 1e-9) << "the first keeps its height, growth is raised";
  EXPECT_LE((stretched[1] - stretched[0]) / stretched[0], maximumGrowth);
  const std::vector<double> long_ = divideWay(slow, 100.0);
  EXPECT_NEAR((long_[1] - long_[0]) / long_[0], maximumGrowth, 1e-6);
  const std::vector<double> automatic = divideWay({2, 0.0, 1.5}, 7.0);
  EXPECT_NEAR(automatic[0], 0.4, 1e-12);
}

TEST(BoundaryLayers, DifferFromSurfaceToSurface)
{
  TriangleSurface surface;
  addBox(surface, "Box", {Vec3(-1.1, -0.9, -2.0), Vec3(0.8, 1.2, 0.3)});
  addSheet(surface, "Ground", {-2.0, -2.0, -2.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0});
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.layers = {{"*", {2}}, {"Box", {5}}};
  const Meshed meshed = meshIt(surface, gridOf(0.2), options);
  const DualMesh& mesh = meshed.mesh();
  for (const auto& corners : mesh.corners)
  {
    EXPECT_GT(shapeOf(mesh.points, corners).pyramid, 0.0);
  }
  std::array<Index, 2> most{0, 0};
  std::array<Index, 2> least{noIndex, noIndex};
  for (std::size_t f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    if (const Index tag = mesh.boundaryFaces[f].tag; tag < most.size())
    {
      most.at(tag) = std::max(most.at(tag), static_cast<Index>(meshed.result.layers.counts[f]));
      least.at(tag) = std::min(least.at(tag), static_cast<Index>(meshed.result.layers.counts[f]));
    }
  }
  EXPECT_EQ(most, (std::array<Index, 2>{5, 5})) << "the ground has more where those of the box end on it";
  EXPECT_EQ(least[1], 2u);
  const auto coverage = [&](std::size_t i) -> const LayerCoverage& { return meshed.result.layers.surfaces.at(i); };
  EXPECT_GT(coverage(0).full, 0.98 * coverage(0).area) << "layers of the box run up to the ground";
}

TEST(LayerDirection, IsTheOneFarthestInsideAllWalls)
{
  const double third = 1.0 / std::sqrt(3.0);
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const LayerDirection corner = solveDirection({{x, y, z}, {}, {}, {}});
  EXPECT_NEAR((corner.direction - Vec3::Constant(third)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(corner.cosine, third, 1e-12);
  const Vec3 between = (x + y).normalized();
  EXPECT_NEAR(solveDirection({{x, y, between}, {}, {}, {}}).cosine, std::sqrt(0.5), 1e-12);
  // On a side across y the way stays in it; on the sides across x and y it is their edge.
  EXPECT_EQ(solveDirection({{between, z}, {}, {}, {y}}).direction[1], 0.0);
  EXPECT_EQ(solveDirection({{between, z}, {}, {}, {x, y}}).direction, z);
  EXPECT_EQ(solveDirection({{z}, {}, {}, {x, y, z}}).cosine, -1.0) << "there is none";
  // A fold whose sides face each other.
  EXPECT_LE(solveDirection({{x, -x}, {}, {}, {}}).cosine, 0.0);
  const Vec3 apart(1.0, 1.0, 1.0);
  const LayerDirection none = solveDirection(
      {{third * apart, third * (2.0 * x - apart), third * (2.0 * y - apart), third * (2.0 * z - apart)}, {}, {}, {}});
  EXPECT_NEAR(none.cosine, -1.0 / 3.0, 1e-12) << "nothing is inside all sides of a tetrahedron";
  // A boundary edge: out of the sheet in its plane; on the ground half way up.
  EXPECT_EQ(solveDirection({{}, {z, -z}, {x}, {}}).direction, x);
  const LayerDirection standing = solveDirection({{z}, {y, -y}, {x}, {}});
  EXPECT_NEAR((standing.direction - (x + z).normalized()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(standing.cosine, 0.0, 1e-12);
}

TEST(LayerRules, TheLastThatMatchesHolds)
{
  const std::vector<std::string> names{"WallEast", "WallWest", "xMinus"};
  const auto layers =
      resolveLayerRules({{"*", {3, 0.1, 1.5}}, {"Wall*", {2}}, {"WallWest", {0}}, {"zMin", {4}}}, names);
  ASSERT_EQ(layers.size(), 3u + sideNumbers);
  EXPECT_EQ(layers[0], (WallLayers{2}));
  EXPECT_EQ(layers[1], (WallLayers{0}));
  EXPECT_EQ(layers[2], (WallLayers{3, 0.1, 1.5}));
  EXPECT_EQ(layers[3 + xMin], WallLayers{}) << "patterns do not mean bare sides";
  EXPECT_EQ(layers[3 + zMin], (WallLayers{4}));
  EXPECT_THROW(resolveLayerRules({{"Roof", {1}}}, names), Error);
  EXPECT_THROW(resolveLayerRules({{"*", {-1}}}, names), Error);
  EXPECT_THROW(resolveLayerRules({{"*", {1, -0.1}}}, names), Error);
  EXPECT_THROW(resolveLayerRules({{"*", {1, 0.1, 0.0}}}, names), Error);
}

TEST(LayerRules, AreReadFromText)
{
  const WallLayers otherwise{1, 0.2, 1.3};
  EXPECT_EQ(layerRuleFrom("Wall* 5", otherwise).layers, (WallLayers{5, 0.2, 1.3}));
  EXPECT_EQ(layerRuleFrom("\"a b\" 5 0.01", otherwise).pattern, "a b");
  EXPECT_EQ(layerRuleFrom("a 5 0.01 1.1", otherwise).layers, (WallLayers{5, 0.01, 1.1}));
  for (const char* wrong : {"", "a", "a x", "a 1.5", "a 1 2 3 4", "a -1", "a 1 -2", "a 1 1 9"})
  {
    EXPECT_THROW(layerRuleFrom(wrong, otherwise), Error) << wrong;
  }
}

TEST(Layers, AreTheSameBitsForAnyNumberOfThreads)
{
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    GridOptions grid;
    grid.domain = {Vec3::Constant(-4.3), Vec3::Constant(4.1)};
    grid.sizeMin = 0.1;
    grid.sizeMid = 0.2;
    grid.sizeMax = 0.4;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    options.layers = {{"*", {static_cast<int>(1 + seed)}}};
    const Meshed one = meshIt(randomSoup(seed), grid, options, 1);
    for (const int threads : {2, 7})
    {
      const Meshed other = meshIt(randomSoup(seed), grid, options, threads);
      EXPECT_TRUE(identical(one.mesh(), other.mesh()));
      EXPECT_EQ(one.result.layers.counts, other.result.layers.counts);
      EXPECT_EQ(one.result.layers.thicknesses, other.result.layers.thicknesses);
    }
  }
}

} // namespace
