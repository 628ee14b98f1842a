// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts of layers on blocks of cubes: rules, axes of prisms, directions, heights and the report.
#include "Dual/Mesh/Sheets.h"
#include "Layer/BoundaryLayers.h"
#include "Layer/LayerCoverage.h"
#include "Layer/LayerDirections.h"
#include "Layer/LayerReport.h"
#include "Layer/LayerRules.h"
#include "Layer/PrismAxes.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Cubes of 1 m in rows along x, whose outer faces are the sides of the domain. The one surface is a level sheet above
/// the elements `below`, if there are any.
class Block
{
public:
  static constexpr Index surfaces = 1;
  static Index tagOf(int direction) { return surfaces + static_cast<Index>(direction); }

  explicit Block(std::array<Index, 3> count, const std::vector<Index>& below = {}) : size(count)
  {
    for (Index i = 0; i < (size[0] + 1) * (size[1] + 1) * (size[2] + 1); ++i)
    {
      mesh.points.emplace_back(i % (size[0] + 1), i / (size[0] + 1) % (size[1] + 1),
                               i / ((size[0] + 1) * (size[1] + 1)));
    }
    for (Index e = 0; e < size[0] * size[1] * size[2]; ++e)
    {
      addCube(e);
    }
    for (const Index e : below)
    {
      addSheet(e);
    }
  }

  Index pointAt(Index i, Index j, Index k) const { return i + (size[0] + 1) * (j + (size[1] + 1) * k); }

  DualMesh mesh;

private:
  void addCube(Index e)
  {
    const std::array<Index, 3> cell{e % size[0], e / size[0] % size[1], e / (size[0] * size[1])};
    std::array<Index, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c)
    {
      const Index bits = hexahedronCorner.at(c);
      corners.at(c) = pointAt(cell[0] + (bits & 1), cell[1] + (bits >> 1 & 1), cell[2] + (bits >> 2));
    }
    const std::array<Index, 3> steps{1, size[0], size[0] * size[1]};
    std::array<std::int32_t, 6> neighbors{};
    for (int direction = 0; direction < 6; ++direction)
    {
      const auto axis = static_cast<std::size_t>(axisOf(direction));
      const bool isOutside = isUpper(direction) ? cell.at(axis) + 1 == size.at(axis) : cell.at(axis) == 0;
      const Index next = isUpper(direction) ? e + steps.at(axis) : e - steps.at(axis);
      const auto face = static_cast<std::int32_t>(mesh.boundaryFaces.size());
      neighbors.at(static_cast<std::size_t>(direction)) = isOutside ? ~face : static_cast<std::int32_t>(next);
      if (isOutside)
      {
        const auto way = static_cast<std::uint8_t>(direction);
        mesh.boundaryFaces.push_back({e, tagOf(direction), noIndex, way, SheetSide::front, true, noIndex});
      }
    }
    mesh.corners.push_back(corners);
    mesh.neighbors.push_back(neighbors);
    mesh.levels.push_back(std::uint8_t{0});
    mesh.zones.push_back(std::int32_t{0});
  }

  void addSheet(Index e)
  {
    const Index above = e + size[0] * size[1];
    for (const auto& [element, other, way] : {std::tuple(e, above, zMax), std::tuple(above, e, zMin)})
    {
      mesh.neighbors[element].at(way) = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
      const auto side = way == zMax ? SheetSide::back : SheetSide::front;
      mesh.boundaryFaces.push_back({element, 0, other, way, side, false, noIndex});
    }
  }

  std::array<Index, 3> size;
};

LayerOptions optionsFor(const std::vector<LayerRule>& rules)
{
  LayerOptions options;
  options.ofTag = resolveLayerRules(rules, {"Wall"});
  return options;
}

TEST(LayerRules, TakeNumbersUpToTheirLimits)
{
  const WallLayers otherwise{9, 0.5, 1.5};
  for (const char* good : {"a 0", "a 100", "a 1 0", "a 1 1e9", "a 1 1 0.5", "a 1 1 5", "* 3", "\"a b\" 2 0.1 2"})
  {
    EXPECT_NO_THROW(layerRuleFrom(good, otherwise)) << good;
  }
  for (const char* wrong : {"a -1", "a 101", "a 1e7", "a 0.5", "a 1 -1e-9", "a 1 inf", "a 1 nan", "a 1 1 0.499",
                            "a 1 1 5.001", "a 1 1 1 1", "a", "", "a b 2"})
  {
    EXPECT_THROW(layerRuleFrom(wrong, otherwise), Error) << wrong;
  }
  EXPECT_EQ(layerRuleFrom("a 3", otherwise).layers, (WallLayers{3, 0.5, 1.5}));
  EXPECT_EQ(layerRuleFrom("a 3 0.25", otherwise).layers, (WallLayers{3, 0.25, 1.5}));
  EXPECT_EQ(layerRuleFrom("a 3 0.25 2", otherwise).layers, (WallLayers{3, 0.25, 2.0}));
  EXPECT_EQ(layerRuleFrom("\"a b\" 3", otherwise).pattern, "a b");
}

TEST(LayerRules, AreCheckedWhereTheyAreResolved)
{
  const double nan = std::nan("");
  for (const WallLayers& wrong :
       {WallLayers{-1}, {101}, {1, -0.1}, {1, nan}, {1, 0.1, 0.49}, {1, 0.1, 5.1}, {1, 0, nan}})
  {
    EXPECT_THROW(resolveLayerRules({{"*", wrong}}, {"Wall"}), Error);
  }
  EXPECT_THROW(resolveLayerRules({{"Roof", {1}}}, {"Wall"}), Error);
  EXPECT_THROW(resolveLayerRules({{"*Min", {1}}}, {"Wall"}), Error) << "patterns do not mean bare sides";
  EXPECT_NO_THROW(resolveLayerRules({{"*", {1}}}, {}));
}

TEST(LayerRules, ApplyToSurfacesAndThenToSidesByName)
{
  for (Index side = 0; side < sideNumbers; ++side)
  {
    const std::vector<WallLayers> ofTag = resolveLayerRules({{sideName(side), {4}}, {"B", {2}}}, {"A", "B"});
    ASSERT_EQ(ofTag.size(), 2U + sideNumbers);
    for (Index tag = 0; tag < ofTag.size(); ++tag)
    {
      EXPECT_EQ(ofTag[tag].layers, tag == 2 + side ? 4 : tag == 1 ? 2 : 0) << tag;
    }
  }
  const std::vector<WallLayers> last = resolveLayerRules({{"B", {2}}, {"*", {3}}, {"A", {5}}}, {"A", "B"});
  EXPECT_EQ(last[0].layers, 5);
  EXPECT_EQ(last[1].layers, 3);
}

Vec3 placeOf(std::uint8_t corner)
{
  const unsigned bits = hexahedronCorner.at(corner);
  return {bits & 1 ? 1.0 : 0.0, bits & 2 ? 1.0 : 0.0, bits & 4 ? 1.0 : 0.0};
}

TEST(PrismAxes, LeadAcrossAnElement)
{
  for (std::uint8_t corner = 0; corner < 8; ++corner)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Vec3 across = placeOf(corner);
      across[axis] = 1.0 - across[axis];
      EXPECT_EQ(placeOf(acrossAxis(corner, axis)), across);
    }
    for (int direction = 0; direction < 6; ++direction)
    {
      EXPECT_EQ(hasCorner(direction, corner), placeOf(corner)[axisOf(direction)] == (isUpper(direction) ? 1.0 : 0.0));
    }
  }
}

TEST(PrismAxes, FindTheFaceBesideAnEdge)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto& face = hexahedronFace.at(static_cast<std::size_t>(direction));
    for (int edge = 0; edge < 4; ++edge)
    {
      const auto i = static_cast<std::size_t>(edge);
      const Vec3 middle = 0.5 * (placeOf(face.at(i)) + placeOf(face.at((i + 1) % 4)));
      const int beside = besideEdge(direction, edge);
      ASSERT_GE(beside, 0);
      EXPECT_NE(axisOf(beside), axisOf(direction));
      EXPECT_EQ(middle[axisOf(beside)], isUpper(beside) ? 1.0 : 0.0) << "the edge is in its plane";
    }
  }
}

/// Random unit vectors, all on one side of a random plane.
std::vector<Vec3> randomNormals(std::mt19937& random, std::size_t count)
{
  std::normal_distribution<double> some;
  const Vec3 axis = Vec3(some(random), some(random), some(random)).normalized();
  std::vector<Vec3> normals;
  while (normals.size() < count)
  {
    const Vec3 v = Vec3(some(random), some(random), some(random)).normalized();
    if (v.dot(axis) > 0.2)
    {
      normals.push_back(v);
    }
  }
  return normals;
}

double leastCosine(const Vec3& direction, const std::vector<Vec3>& normals)
{
  double least = 1.0;
  for (const Vec3& normal : normals)
  {
    least = std::min(least, normal.dot(direction));
  }
  return least;
}

TEST(LayerDirection, IsTheBestOfAllDirections)
{
  std::mt19937 random(1);
  std::normal_distribution<double> some;
  for (int round = 0; round < 200; ++round)
  {
    const std::vector<Vec3> walls = randomNormals(random, 1 + static_cast<std::size_t>(round) % 7);
    const LayerDirection found = solveDirection({walls, {}, {}, {}});
    EXPECT_NEAR(found.direction.norm(), 1.0, 1e-12);
    EXPECT_NEAR(found.cosine, leastCosine(found.direction, walls), 1e-12);
    EXPECT_GT(found.cosine, 0.2 - 1e-9) << "the axis is as good";
    for (int i = 0; i < 60; ++i)
    {
      const double step = std::pow(10.0, -(i % 5));
      const Vec3 way(some(random), some(random), some(random));
      EXPECT_LE(leastCosine((found.direction + step * way).normalized(), walls), found.cosine + 1e-9);
    }
  }
}

TEST(LayerDirection, IsTheBestInThePlaneOfASide)
{
  std::mt19937 random(2);
  std::normal_distribution<double> some;
  std::uniform_real_distribution<double> angle(-1.3, 1.3);
  for (int round = 0; round < 100; ++round)
  {
    const Vec3 side = Vec3(some(random), some(random), some(random)).normalized();
    const Vec3 middle = side.unitOrthogonal();
    std::vector<Vec3> walls(1 + static_cast<std::size_t>(round) % 5); // square to the side
    std::ranges::generate(walls, [&] { return Vec3(Eigen::AngleAxisd(angle(random), side) * middle); });
    const LayerDirection found = solveDirection({walls, {}, {}, {side, -side}});
    EXPECT_NEAR(found.direction.norm(), 1.0, 1e-12);
    EXPECT_NEAR(found.direction.dot(side), 0.0, 1e-12);
    const Vec3 across = side.cross(found.direction);
    for (const double step : {-0.5, -1e-2, -1e-4, 1e-4, 1e-2, 0.5})
    {
      EXPECT_LE(leastCosine((found.direction + step * across).normalized(), walls), found.cosine + 1e-9);
    }
  }
}

TEST(LayerDirection, StaysInTheOnePlaneOfSheetsThatDifferLittle)
{
  const auto tilted = [](double degrees) {
    const double angle = degrees * EIGEN_PI / 180.0;
    return Vec3(0, std::sin(angle), std::cos(angle));
  };
  // Two normals spread by sin^2 of half the angle between them, up to 0.1 in one plane.
  EXPECT_NEAR(solveDirection({{}, {tilted(17), tilted(-17)}, {Vec3(1, 1, 1).normalized()}, {}}).direction[2], 0.0,
              1e-9);
  const Vec3 along = solveDirection({{}, {tilted(20), tilted(-20)}, {Vec3(1, 1, 1).normalized()}, {}}).direction;
  EXPECT_NEAR((along - Vec3::UnitX()).norm(), 0.0, 1e-9) << "they are two planes";
  EXPECT_EQ(solveDirection({{}, {}, {}, {}}).cosine, -1.0);
  EXPECT_EQ(solveDirection({{Vec3::UnitZ()}, {}, {}, {Vec3::UnitZ()}}).direction, Vec3(Vec3::Zero()));
}

/// A block whose walls have layers, with the directions at their points.
struct Grown
{
  Grown(std::array<Index, 3> size, const std::vector<LayerRule>& rules) : block(size), options(optionsFor(rules))
  {
    findWalls();
  }

  void findWalls() { walls = findLayerWalls(block.mesh, options, quietContext()); }

  LayerDirection directionAt(Index point) const
  {
    LayerDirections directions(walls, options);
    directions.update(block.mesh, walls.counts, quietContext());
    return directions.at(point);
  }
  Vec3& place(Index i, Index j, Index k) { return block.mesh.points[block.pointAt(i, j, k)]; }
  Vec3 wayAt(Index i, Index j, Index k) const { return directionAt(block.pointAt(i, j, k)).direction; }

  LayerMesh grow(const std::vector<char>& excluded = {})
  {
    return LayerGrower(walls, options).grow(block.mesh, excluded, quietContext());
  }
  std::vector<double> sizes() const { return sizesBesideWalls(block.mesh, walls, quietContext()); }

  Block block;
  LayerOptions options;
  LayerWalls walls;
};

TEST(LayerWalls, CountTheFewestLayersAroundPoints)
{
  const Grown of({3, 3, 3}, {{"zMin", {4}}, {"xMin", {2}}, {"xMax", {7}}});
  for (Index i = 0; i < 4; ++i)
  {
    for (Index k = 0; k < 4; ++k)
    {
      const Index expected = i == 0 ? 2 : k == 0 ? 4 : i == 3 ? 7 : 0;
      EXPECT_EQ(of.walls.counts[of.block.pointAt(i, 1, k)], expected) << i << " " << k;
    }
  }
}

TEST(LayerDirections, LeadOffWallsAndAlongSides)
{
  const Grown of({3, 3, 3}, {{"zMin", {1}}, {"xMin", {1}}});
  const double half = std::sqrt(0.5);
  EXPECT_NEAR((of.wayAt(1, 1, 0) - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(0, 1, 2) - Vec3::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(0, 2, 0) - Vec3(half, 0, half)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(0, 0, 0) - Vec3(half, 0, half)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(3, 3, 0) - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(of.directionAt(of.block.pointAt(0, 1, 0)).cosine, half, 1e-12);
  EXPECT_NEAR(of.directionAt(of.block.pointAt(1, 1, 0)).cosine, 1.0, 1e-12);
}

TEST(LayerDirections, OfASlopeStayInTheSidesAtItsEnds)
{
  Grown of({3, 3, 3}, {{"zMin", {1}}});
  for (Vec3& p : of.block.mesh.points)
  {
    p[2] = 0.4 * p[0] + p[2];
  }
  const double length = std::hypot(0.4, 1.0);
  EXPECT_NEAR((of.wayAt(1, 2, 0) - Vec3(-0.4, 0, 1) / length).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(1, 0, 0) - Vec3(-0.4, 0, 1) / length).norm(), 0.0, 1e-12);
  for (const Index i : {0U, 3U})
  {
    EXPECT_EQ(of.wayAt(i, 1, 0), Vec3::UnitZ());
    EXPECT_NEAR(of.directionAt(of.block.pointAt(i, 1, 0)).cosine, 1.0 / length, 1e-12);
  }
  LayerDirections directions(of.walls, of.options);
  directions.update(of.block.mesh, of.walls.counts, quietContext());
  for (Index f = 0; f < of.walls.roles.size(); ++f)
  {
    const bool isWall = of.block.mesh.boundaryFaces[f].direction == zMin;
    EXPECT_TRUE(!isWall || (directions.normal(f) - Vec3(-0.4, 0, 1)).norm() < 1e-12);
  }
}

TEST(LayerDirections, AreNoneWhereASideIsOffItsPlane)
{
  Grown of({3, 3, 3}, {{"zMin", {1}}});
  of.place(0, 1, 1)[0] += 0.01;
  for (Index j = 0; j < 4; ++j)
  {
    EXPECT_EQ(of.wayAt(0, j, 0).isZero(), j < 3) << j;
    EXPECT_FALSE(of.wayAt(1, j, 0).isZero());
  }
  of.place(0, 1, 1)[0] = 1e-7;
  EXPECT_FALSE(of.wayAt(0, 1, 0).isZero()) << "rounding is allowed";
}

TEST(LayerDirections, LeanAwayFromAFaceThatIsStraightThere)
{
  Grown of({4, 4, 2}, {{"zMin", {1}}});
  of.place(2, 2, 0) = Vec3(2.49, 2.49, 0); // almost on the line from (3, 2) to (2, 3)
  const double part = 0.25 * std::sqrt(0.5);
  EXPECT_NEAR((of.wayAt(2, 2, 0) - Vec3(-part, -part, 1).normalized()).norm(), 0.0, 1e-9);
  EXPECT_EQ(of.wayAt(3, 2, 0), Vec3::UnitZ());
  of.place(2, 2, 0) = Vec3(2.4, 2.4, 0); // 11 degrees from it at either side
  EXPECT_EQ(of.wayAt(2, 2, 0), Vec3::UnitZ());
}

TEST(LayerDirections, TaperToTheBoundaryEdgeOfASheetInItsPlane)
{
  // A sheet over the half of the cubes with y < 2, which ends on three sides of the domain.
  Grown of({4, 4, 2}, {{"Wall", {1}}});
  of.block = Block({4, 4, 2}, {0, 1, 2, 3, 4, 5, 6, 7});
  const std::vector<Index> sources = splitSheets(of.block.mesh, quietContext());
  ASSERT_EQ(sources.size(), 10U) << "all points but those of the boundary edge";
  of.findWalls();
  for (Index i = 0; i < 5; ++i)
  {
    EXPECT_NEAR((of.wayAt(i, 2, 1) - Vec3::UnitY()).norm(), 0.0, 1e-12) << i;
    EXPECT_NEAR(of.directionAt(of.block.pointAt(i, 2, 1)).cosine, 0.0, 1e-12);
    EXPECT_NEAR((of.wayAt(i, 1, 1) + Vec3::UnitZ()).norm(), 0.0, 1e-12) << "the elements below keep the points";
  }
  for (Index copy = 0; copy < sources.size(); ++copy)
  {
    const Index point = static_cast<Index>(of.block.mesh.points.size() - sources.size()) + copy;
    EXPECT_NEAR((of.directionAt(point).direction - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  }
}

TEST(LayerDirections, AreTheSameFoundAgainAroundWhatMovedAndFoundAnew)
{
  Grown of({4, 4, 3}, {{"zMin", {1}}, {"xMin", {1}}});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-0.2, 0.2);
  LayerDirections again(of.walls, of.options);
  std::vector<Index> counts = of.walls.counts;
  std::ranges::fill(counts, 0); // points get theirs one after the other
  for (int round = 0; round < 30; ++round)
  {
    const auto at = static_cast<Index>(random() % of.block.mesh.points.size());
    of.block.mesh.points[at] += Vec3(some(random), some(random), some(random));
    for (std::size_t p = 0; p < counts.size(); ++p)
    {
      counts[p] = static_cast<int>(p % 20) <= round ? of.walls.counts[p] : 0;
    }
    again.update(of.block.mesh, counts, quietContext());
    LayerDirections anew(of.walls, of.options);
    anew.update(of.block.mesh, counts, quietContext());
    for (Index p = 0; p < counts.size(); ++p)
    {
      EXPECT_TRUE(counts[p] == 0 || again.at(p).direction == anew.at(p).direction) << round;
      EXPECT_TRUE(counts[p] == 0 || again.at(p).cosine == anew.at(p).cosine);
    }
    for (Index f = 0; f < of.walls.roles.size(); ++f)
    {
      EXPECT_EQ(again.normal(f), anew.normal(f));
    }
  }
}

TEST(Thickness, IsTheSumOfHeightsOrAShareOfTheSize)
{
  LayerOptions options;
  options.relativeThickness = 0.3;
  options.dividedThickness = 0.7;
  EXPECT_NEAR(thicknessAsked({1, 0.0, 2.0}, 10.0, options), 3.0, 1e-12);
  EXPECT_NEAR(thicknessAsked({2, 0.0, 2.0}, 10.0, options), 7.0, 1e-12);
  EXPECT_NEAR(thicknessAsked({1, 0.1, 2.0}, 10.0, options), 0.1, 1e-12);
  EXPECT_NEAR(thicknessAsked({4, 0.1, 2.0}, 10.0, options), 1.5, 1e-12);
  EXPECT_NEAR(thicknessAsked({4, 0.1, 1.0}, 10.0, options), 0.4, 1e-12);
  EXPECT_NEAR(thicknessAsked({3, 0.1, 0.5}, 10.0, options), 0.175, 1e-12);
}

TEST(Heights, HaveTheGrowthAskedAndFillTheWay)
{
  for (const double growth : {0.5, 1.0, 1.2, 2.0, 5.0})
  {
    for (int layers = 1; layers <= 6; ++layers)
    {
      double sum = 0.0;
      for (int i = 0; i < layers; ++i)
      {
        sum += std::pow(growth, i);
      }
      for (const WallLayers& wall : {WallLayers{layers, 0.0, growth}, {layers, 0.1, growth}})
      {
        const std::vector<double> shares = divideWay(wall, 0.1 * sum);
        ASSERT_EQ(shares.size(), static_cast<std::size_t>(layers));
        EXPECT_EQ(shares.back(), 1.0);
        double before = 0.0;
        for (std::size_t i = 0; i < shares.size(); ++i)
        {
          EXPECT_NEAR(shares[i] - before, std::pow(growth, static_cast<double>(i)) / sum, 1e-9);
          before = shares[i];
        }
      }
    }
  }
}

TEST(Heights, KeepTheFirstAndGrowFasterWhereTheWayIsLong)
{
  const WallLayers wall{4, 0.1, 1.1};
  for (const double growth : {1.2, 1.5, 1.9, 2.0})
  {
    const double way = 0.1 * (1 + growth + growth * growth + growth * growth * growth);
    const std::vector<double> shares = divideWay(wall, way);
    EXPECT_NEAR(shares[0] * way, 0.1, 1e-9) << growth;
    EXPECT_NEAR(shares[1] * way, 0.1 + 0.1 * growth, 1e-9);
    EXPECT_NEAR(shares[2] * way, 0.1 + 0.1 * growth + 0.1 * growth * growth, 1e-9);
  }
  const std::vector<double> longest = divideWay(wall, 150.0);
  EXPECT_NEAR(longest[0], 1.0 / 15.0, 1e-9) << "growth ends at two";
  const std::vector<double> fast = divideWay({3, 0.1, 3.0}, 130.0);
  EXPECT_NEAR(fast[0], 1.0 / 13.0, 1e-9) << "or at what is asked for";
  EXPECT_NEAR(divideWay({3, 0.1, 1.5}, 0.35)[0] * 0.35, 0.1, 1e-9) << "growth falls where the way is short";
  EXPECT_NEAR(divideWay({3, 0.1, 1.5}, 0.15)[0], 1.0 / 3.0, 1e-9) << "to 1 at least";
  EXPECT_NEAR(divideWay({3, 0.0, 1.1}, 1e9)[0], 1.0 / 3.31, 1e-9) << "no height, no way to keep it";
}

TEST(Heights, AreTheSmallestOfTheWallsAroundAPoint)
{
  const Grown of({3, 3, 3}, {{"zMin", {4, 0.2, 1.5}}, {"xMin", {3, 0.0, 1.2}}, {"yMin", {5, 0.1, 1.9}}});
  const std::vector<WallLayers> layers = layersOfPoints(of.block.mesh, of.walls, of.options);
  const auto at = [&](Index i, Index j, Index k) { return layers[of.block.pointAt(i, j, k)]; };
  EXPECT_EQ(at(1, 1, 0), (WallLayers{4, 0.2, 1.5}));
  EXPECT_EQ(at(0, 1, 1), (WallLayers{3, 0.0, 1.2}));
  EXPECT_EQ(at(1, 0, 1), (WallLayers{5, 0.1, 1.9}));
  EXPECT_EQ(at(0, 1, 0), (WallLayers{3, 0.2, 1.2})) << "of heights that are given";
  EXPECT_EQ(at(0, 0, 1), (WallLayers{3, 0.1, 1.2}));
  EXPECT_EQ(at(1, 0, 0), (WallLayers{4, 0.1, 1.5}));
  EXPECT_EQ(at(0, 0, 0), (WallLayers{3, 0.1, 1.2}));
  EXPECT_EQ(at(2, 2, 2).layers, 0);
}

TEST(Heights, AreWantedWhereALayerStands)
{
  Grown of({4, 3, 2}, {{"zMin", {3, 0.02, 1.2}}});
  std::vector<char> excluded(of.block.mesh.points.size(), 0);
  excluded[of.block.pointAt(2, 1, 0)] = 1;
  const LayerMesh one = of.grow(excluded);
  const std::vector<Index> counts = layersWanted(of.block.mesh, of.walls, one, of.options);
  for (Index p = 0; p < counts.size(); ++p)
  {
    const bool isOnWall = of.block.mesh.points[p][2] == 0.0;
    EXPECT_EQ(counts[p], isOnWall && !excluded[p] ? 3U : 0U);
    EXPECT_EQ(one.copies[p] != noIndex, isOnWall && !excluded[p]);
  }
}

TEST(Heights, StandOnTheStraightLinesToTheCopies)
{
  Grown of({4, 4, 2}, {{"zMin", {3, 0.05, 2.0}}});
  const LayerMesh one = of.grow();
  std::vector<Index> counts = layersWanted(of.block.mesh, of.walls, one, of.options);
  counts[of.block.pointAt(2, 2, 0)] = 2;
  counts[of.block.pointAt(2, 1, 0)] = 0;
  const LayerMesh divided = divideLayer(of.block.mesh, of.walls, one, of.options, counts);
  std::map<Index, Index> made;
  for (std::size_t i = 0; i < divided.wallPoints.size(); ++i)
  {
    const Index wall = divided.wallPoints[i];
    const Index point = divided.plainPoints + static_cast<Index>(i);
    const bool isShort = wall == of.block.pointAt(2, 2, 0);
    // The short one fills the way of 0.35 with two layers: growth is raised to two, then both are scaled up.
    const std::array<double, 3> heights = isShort ? std::array{0.35 / 3.0, 0.35, 0.0} : std::array{0.05, 0.15, 0.35};
    const Vec3 expected = of.block.mesh.points[wall] + heights.at(divided.places[i] - 1) * Vec3::UnitZ();
    EXPECT_NEAR((divided.mesh.points[point] - expected).norm(), 0.0, 1e-9) << wall;
    ++made[wall];
  }
  for (Index p = 0; p < counts.size(); ++p)
  {
    EXPECT_EQ(made[p], counts[p]);
  }
}

TEST(Heights, WithoutAFirstOneAreEqualBesideFewerLayers)
{
  Grown of({4, 4, 2}, {{"zMin", {3, 0.0, 2.0}}});
  const LayerMesh one = of.grow();
  std::vector<Index> counts = layersWanted(of.block.mesh, of.walls, one, of.options);
  counts[of.block.pointAt(0, 0, 0)] = 2;
  const LayerMesh divided = divideLayer(of.block.mesh, of.walls, one, of.options, counts);
  const auto firstShare = [&](Index i, Index j) {
    const Index wall = of.block.pointAt(i, j, 0);
    const Index copy = divided.copies[wall];
    const Index first = copy + 1 - counts[wall];
    return divided.mesh.points[first][2] / divided.mesh.points[copy][2];
  };
  EXPECT_NEAR(firstShare(1, 1), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(firstShare(1, 0), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(firstShare(2, 1), 1.0 / 7.0, 1e-9);
  EXPECT_NEAR(firstShare(0, 0), 1.0 / 3.0, 1e-9) << "it has fewer, not more";
}

TEST(WallSizes, AreTheLongestEdgesThatLeaveTheWalls)
{
  Grown of({3, 3, 2}, {{"zMin", {1}}});
  of.place(1, 1, 1)[2] = 0.75;
  of.place(2, 2, 1)[2] = 1.25;
  const std::vector<double> sizes = of.sizes();
  EXPECT_NEAR(sizes[of.block.pointAt(0, 0, 0)], 1.0, 1e-12);
  EXPECT_NEAR(sizes[of.block.pointAt(1, 1, 0)], 0.75, 1e-12);
  EXPECT_NEAR(sizes[of.block.pointAt(2, 2, 0)], 1.25, 1e-12);
  EXPECT_EQ(sizes[of.block.pointAt(1, 1, 1)], std::numeric_limits<double>::infinity());
  const Grown between({3, 3, 1}, {{"zMin", {1}}, {"zMax", {1}}});
  EXPECT_NEAR(between.sizes()[between.block.pointAt(1, 1, 0)], 0.5, 1e-12) << "edges between walls count half";
  Grown corner({2, 2, 2}, {{"zMin", {1}}, {"xMin", {1}}, {"yMin", {1}}});
  corner.place(1, 0, 0)[0] = 0.8;
  EXPECT_NEAR(corner.sizes()[corner.block.pointAt(0, 0, 0)], 0.8, 1e-12) << "the shortest edge along the walls";
}

LayerReport reportOf(const Grown& of, const LayerMesh& layer, const OwnElements& part = {})
{
  return reportLayers(layer, of.walls, of.sizes(), of.options, {"Wall"}, part);
}

TEST(LayerReport, CoversWhatHasAllItsLayers)
{
  Grown of({3, 3, 2}, {{"zMin", {2, 0.1, 2.0}}});
  const LayerMesh one = of.grow();
  const LayerMesh divided =
      divideLayer(of.block.mesh, of.walls, one, of.options, layersWanted(of.block.mesh, of.walls, one, of.options));
  const LayerReport report = reportOf(of, divided);
  ASSERT_EQ(report.surfaces.size(), 1U);
  const LayerCoverage& all = report.surfaces[0];
  EXPECT_EQ(all.surface, "zMin");
  EXPECT_EQ(all.layers, 2);
  EXPECT_NEAR(all.area, 9.0, 1e-9);
  EXPECT_NEAR(all.layered, 9.0, 1e-9);
  EXPECT_NEAR(all.full, 9.0, 1e-9);
  EXPECT_NEAR(all.thickness, 1.0, 1e-9);
  ASSERT_EQ(report.counts.size(), divided.mesh.boundaryFaces.size());
  for (std::size_t f = 0; f < report.counts.size(); ++f)
  {
    const bool isWall = f < of.walls.roles.size() && of.walls.roles[f] == FaceRole::wall;
    EXPECT_EQ(report.counts[f], isWall ? 2 : 0);
    EXPECT_NEAR(report.thicknesses[f], isWall ? 0.3 : 0.0, 1e-9);
  }
}

TEST(LayerReport, TellsWhatHasFewerOrNone)
{
  Grown of({3, 3, 2}, {{"zMin", {2, 0.1, 2.0}}});
  std::vector<char> excluded(of.block.mesh.points.size(), 0);
  for (std::size_t p = 0; p < excluded.size(); ++p)
  {
    excluded[p] = of.block.mesh.points[p][0] <= 1.0 ? 1 : 0;
  }
  const LayerMesh one = of.grow(excluded);
  std::vector<Index> counts = layersWanted(of.block.mesh, of.walls, one, of.options);
  for (Index j = 0; j < 4; ++j)
  {
    counts[of.block.pointAt(2, j, 0)] = 1;
  }
  const LayerMesh divided = divideLayer(of.block.mesh, of.walls, one, of.options, counts);
  const LayerReport report = reportOf(of, divided);
  ASSERT_EQ(report.surfaces.size(), 1U);
  EXPECT_NEAR(report.surfaces[0].area, 9.0, 1e-9);
  EXPECT_NEAR(report.surfaces[0].layered, 6.0, 1e-9);
  EXPECT_NEAR(report.surfaces[0].full, 3.0, 1e-9);
  EXPECT_NEAR(report.surfaces[0].thickness, 0.75, 1e-9) << "half of the corners of half of the faces";
  for (Index f = 0; f < of.walls.roles.size(); ++f)
  {
    const Index cell = of.block.mesh.boundaryFaces[f].element % 3;
    const bool isWall = of.walls.roles[f] == FaceRole::wall;
    EXPECT_EQ(report.counts[f], isWall ? static_cast<int>(cell) : 0);
    EXPECT_NEAR(report.thicknesses[f], isWall ? 0.15 * cell : 0.0, 1e-9);
  }
}

TEST(LayerReport, CountsOwnElementsAndRoundsAreas)
{
  Grown of({3, 3, 2}, {{"zMin", {1, 0.1}}});
  const LayerMesh one = of.grow();
  OwnElements part;
  part.isOwn = [](Index element) { return element % 3 != 0 || element >= 9; };
  double own = 0.0;
  for (Index f = 0; f < of.walls.roles.size(); ++f)
  {
    own += of.walls.roles[f] == FaceRole::wall && part.owns(one.mesh.boundaryFaces[f].element) ? 1.0 : 0.0;
  }
  const LayerReport report = reportOf(of, one, part);
  EXPECT_NEAR(report.surfaces.at(0).area, own, 1e-9);
  EXPECT_NEAR(report.surfaces.at(0).thickness, 1.0, 1e-9);
  EXPECT_EQ(std::ranges::count(report.counts, 1), 9) << "faces are all reported";
  of.options.areaUnit = 2.0;
  EXPECT_EQ(reportOf(of, one).surfaces.at(0).area, 18.0) << "faces of 1 are rounded to 2";
  of.options.areaUnit = 4.0;
  EXPECT_THAT(reportOf(of, one).surfaces, IsEmpty()) << "and to nothing";
}

TEST(LayerReport, TellsOfLayersThatNobodyAskedForIfThereAreAny)
{
  Grown of({3, 3, 2}, {{"zMin", {1, 0.1}}, {"zMax", {1, 0.1}}});
  of.options.supporting.assign(of.options.ofTag.size(), SupportingLayer::none);
  of.options.supporting[Block::tagOf(zMin)] = SupportingLayer::whereNeeded;
  EXPECT_TRUE(of.options.isAsked());
  const LayerReport report = reportOf(of, of.grow());
  ASSERT_EQ(report.surfaces.size(), 2U);
  EXPECT_EQ(report.surfaces[0].surface, "zMin");
  EXPECT_EQ(report.surfaces[0].layers, 0);
  EXPECT_EQ(report.surfaces[1].surface, "zMax");
  EXPECT_EQ(report.surfaces[1].layers, 1);
  std::vector<char> excluded(of.block.mesh.points.size(), 0);
  std::fill_n(excluded.begin(), 16, 1);
  const LayerReport without = reportOf(of, of.grow(excluded));
  ASSERT_EQ(without.surfaces.size(), 1U);
  EXPECT_EQ(without.surfaces[0].surface, "zMax");
  of.options.supporting[Block::tagOf(zMax)] = SupportingLayer::everywhere;
  EXPECT_FALSE(of.options.isAsked());
}

TEST(LayerOptions, KnowWhatIsAskedAnywhere)
{
  const LayerOptions none = optionsFor({});
  EXPECT_FALSE(none.isAsked() || none.isDivided() || none.hasHeights());
  EXPECT_EQ(none.surfaceCount(), 1U);
  const LayerOptions one = optionsFor({{"zMax", {1}}});
  EXPECT_TRUE(one.isAsked());
  EXPECT_FALSE(one.isDivided() || one.hasHeights());
  EXPECT_TRUE(optionsFor({{"Wall", {2}}}).isDivided());
  EXPECT_TRUE(optionsFor({{"Wall", {1, 0.1}}}).hasHeights());
}

TEST(SettledPoints, KeepPlacesAndReplaceThem)
{
  SettledPoints settled;
  EXPECT_TRUE(settled.isEmpty());
  EXPECT_FALSE(settled.has(0) || settled.stays(0) || settled.keepsLayers(0) || settled.isAtCut(0));
  settled.open(4);
  EXPECT_FALSE(settled.isEmpty() || settled.has(2));
  const auto heightsOf = [&](Index point) {
    std::vector<double> heights;
    std::ranges::transform(settled.aboveOf(point), std::back_inserter(heights), [](const Vec3& p) { return p[2]; });
    return heights;
  };
  settled.settle(2, std::vector<Vec3>{{0, 0, 1}, {0, 0, 2}});
  settled.settle(1, std::vector<Vec3>{{0, 0, 3}});
  settled.settle(2, std::vector<Vec3>{{0, 0, 4}, {0, 0, 5}});
  EXPECT_THAT(heightsOf(2), ElementsAre(4, 5));
  EXPECT_THAT(heightsOf(1), ElementsAre(3));
  EXPECT_EQ(settled.above.size(), 3U) << "as many places take the earlier ones'";
  settled.settle(2, std::vector<Vec3>{{0, 0, 6}});
  settled.settle(3, std::vector<Vec3>{});
  EXPECT_THAT(heightsOf(2), ElementsAre(6));
  EXPECT_TRUE(settled.has(3));
  EXPECT_THAT(heightsOf(3), IsEmpty());
  EXPECT_FALSE(settled.keepsLayers(2));
  settled.areDivided = true;
  EXPECT_TRUE(settled.keepsLayers(2));
  EXPECT_FALSE(settled.keepsLayers(0));
  settled.fixed = {1, 0, 0, 0};
  settled.atCut = {0, 1, 0, 0};
  EXPECT_TRUE(settled.stays(0) && settled.keepsLayers(0) && settled.isAtCut(1));
  EXPECT_FALSE(settled.stays(1) || settled.isAtCut(0));
}

} // namespace
