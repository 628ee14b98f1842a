// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts that place a model on its ground: upright lines, terrain, slabs, floors, supports and turned sides.
#include "Domain/BaseSupport.h"
#include "Domain/Floor.h"
#include "Domain/PlumbLines.h"
#include "Domain/Terrain.h"
#include "Domain/TurnedSides.h"
#include "Domain/UpperSide.h"
#include "Support/Error.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double rounding = 1e-9;

class Random
{
public:
  explicit Random(unsigned seed) : engine(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  std::size_t below(std::size_t end) { return engine() % end; }

private:
  std::mt19937 engine;
};

std::vector<Index> allTriangles(const TriangleSurface& surface)
{
  std::vector<Index> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

Vec3 areaVector(const TriangleSurface& surface, std::size_t triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  return 0.5 * (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]);
}

Vec3 middleOf(const TriangleSurface& surface, std::size_t triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  return (surface.points[a] + surface.points[b] + surface.points[c]) / 3.0;
}

/// Signed sum of the areas seen from above; positive for triangles that face up.
double areaFromAbove(const TriangleSurface& surface)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    sum += areaVector(surface, t)[2];
  }
  return sum;
}

/// Two triangles for each quad, all of one surface.
void addQuads(TriangleSurface& to, const std::string& name, const std::vector<std::array<Vec3, 4>>& quads)
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (const auto& quad : quads)
  {
    const auto first = static_cast<Index>(points.size());
    points.insert(points.end(), quad.begin(), quad.end());
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  addSurface(to, name, points, triangles);
}

/// Cells of a block that are filled.
using IsFilled = std::function<bool(int, int, int)>;

std::array<Vec3, 4> cellFace(const Vec3& low, const Vec3& size, int direction)
{
  const int axis = axisOf(direction);
  Vec3 u = Vec3::Zero();
  Vec3 v = Vec3::Zero();
  u[(axis + 1) % 3] = size[(axis + 1) % 3];
  v[(axis + 2) % 3] = size[(axis + 2) % 3];
  Vec3 corner = low;
  corner[axis] += isUpper(direction) ? size[axis] : 0.0;
  return isUpper(direction) ? std::array{corner, Vec3(corner + u), Vec3(corner + u + v), Vec3(corner + v)}
                            : std::array{corner, Vec3(corner + v), Vec3(corner + u + v), Vec3(corner + u)};
}

/// The surface of the filled cells among n x n x n, normals outwards.
void addCells(TriangleSurface& to, const std::string& name, int n, const Vec3& size, const IsFilled& isFilled)
{
  const auto has = [&](const std::array<int, 3>& c) {
    return std::ranges::all_of(c, [n](int i) { return i >= 0 && i < n; }) && isFilled(c[0], c[1], c[2]);
  };
  std::vector<std::array<Vec3, 4>> quads;
  for (int i = 0; i < n * n * n; ++i)
  {
    const std::array<int, 3> cell{i % n, i / n % n, i / (n * n)};
    for (int direction = 0; direction < 6 && has(cell); ++direction)
    {
      std::array<int, 3> next = cell;
      next.at(static_cast<std::size_t>(axisOf(direction))) += isUpper(direction) ? 1 : -1;
      if (!has(next))
      {
        const Vec3 low = Vec3(cell[0], cell[1], cell[2]).cwiseProduct(size);
        quads.push_back(cellFace(low, size, direction));
      }
    }
  }
  addQuads(to, name, quads);
}

std::vector<Box3> randomBoxes(Random& random, std::size_t count)
{
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes)
  {
    if (random.below(10) > 0)
    {
      const Vec3 low(random.in(-5, 20), random.in(3, 9), random.in(0, 1));
      box = {low, low + Vec3(random.in(0, 2), random.in(0, 1), random.in(0, 5))};
    }
  }
  return boxes;
}

bool meetFromAbove(const Box3& box, const Vec3& low, const Vec3& high)
{
  return !box.empty() && box.min[0] <= high[0] && box.max[0] >= low[0] && box.min[1] <= high[1] && box.max[1] >= low[1];
}

TEST(PlanBins, VisitAllBoxesThatARectangleTouches)
{
  Random random(1);
  for (const std::size_t count : {0U, 1U, 3U, 50U, 400U})
  {
    const std::vector<Box3> boxes = randomBoxes(random, count);
    const PlanBins bins(boxes);
    for (int round = 0; round < 50; ++round)
    {
      const Vec3 low(random.in(-8, 22), random.in(2, 11), random.in(-50, 50));
      const Vec3 high = low + Vec3(random.in(0, 4), random.in(0, 4), 0);
      std::set<Index> visited;
      bins.eachNear(low, high, [&](Index i) { visited.insert(i); });
      for (Index i = 0; i < count; ++i)
      {
        EXPECT_TRUE(!meetFromAbove(boxes[i], low, high) || visited.contains(i));
        EXPECT_TRUE(!boxes[i].empty() || !visited.contains(i)) << "empty boxes are in no bin";
      }
    }
  }
}

TEST(PlanBins, VisitFewBoxesOnceAroundAPoint)
{
  std::vector<Box3> boxes;
  for (int i = 0; i < 400; ++i)
  {
    const Vec3 low(i % 20, 3.0 * (i / 20), 0.0);
    boxes.push_back({low, low + Vec3(0.5, 0.5, 1.0)});
  }
  const PlanBins bins(boxes);
  for (int i = 0; i < 400; ++i)
  {
    std::vector<Index> visited;
    const Vec3 p = boxes[static_cast<std::size_t>(i)].center();
    bins.eachNear(p, p, [&](Index box) { visited.push_back(box); });
    EXPECT_EQ(std::ranges::count(visited, static_cast<Index>(i)), 1);
    EXPECT_LE(visited.size(), 9U) << "those of its bin and the bins beside it at most";
    EXPECT_EQ(std::set<Index>(visited.begin(), visited.end()).size(), visited.size());
  }
}

TriangleSurface randomTriangles(Random& random, Index count)
{
  TriangleSurface surface;
  surface.names = {"All"};
  for (Index t = 0; t < count; ++t)
  {
    const Vec3 a(random.in(0, 9), random.in(0, 9), random.in(0, 9));
    Vec3 b = a + Vec3(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2));
    const Vec3 c = a + Vec3(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2));
    if (t % 5 == 0)
    {
      b.head<2>() = 0.5 * (a + c).head<2>(); // upright
    }
    surface.points.insert(surface.points.end(), {a, b, c});
    surface.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    surface.surfaceIds.push_back(0);
  }
  return surface;
}

double turnOf(const Vec3& a, const Vec3& b, double x, double y)
{
  return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

/// The height of a triangle that is not upright over a place; not a number beside it.
double heightOver(const TriangleSurface& surface, Index triangle, double x, double y)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vec3& p = surface.points[a];
  const Vec3& q = surface.points[b];
  const Vec3& r = surface.points[c];
  const double whole = turnOf(p, q, r[0], r[1]);
  const double ofR = turnOf(p, q, x, y) / whole;
  const double ofP = turnOf(q, r, x, y) / whole;
  const double ofQ = turnOf(r, p, x, y) / whole;
  const bool isIn = std::abs(whole) > 1e-9 && ofP >= 0.0 && ofQ >= 0.0 && ofR >= 0.0;
  return isIn ? ofP * p[2] + ofQ * q[2] + ofR * r[2] : std::nan("");
}

TEST(PlumbLines, MeetTheTrianglesOverAPlaceFromTheLowestUp)
{
  Random random(2);
  const TriangleSurface surface = randomTriangles(random, 200);
  std::vector<Index> some;
  for (Index t = 0; t < 200; t += 1 + t % 2)
  {
    some.push_back(t);
  }
  const PlumbLines lines(surface, some);
  std::vector<PlumbHit> hits{{1.0, 7}};
  for (int round = 0; round < 300; ++round)
  {
    const double x = random.in(-2, 11);
    const double y = random.in(-2, 11);
    std::vector<std::pair<double, Index>> expected;
    for (const Index t : some)
    {
      if (const double height = heightOver(surface, t, x, y); !std::isnan(height))
      {
        expected.emplace_back(height, t);
      }
    }
    std::ranges::sort(expected);
    lines.find(x, y, hits);
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      EXPECT_EQ(hits[i].triangle, expected[i].second);
      EXPECT_NEAR(hits[i].height, expected[i].first, rounding);
    }
  }
}

TEST(PlumbLines, MeetBothTrianglesAtACommonEdgeAndNoneBeyondTheLast)
{
  TriangleSurface surface;
  addSheet(surface, "Upper", Vec3(0, 0, 2), Vec3(4, 0, 0), Vec3(0, 4, 0));
  addSheet(surface, "Lower", Vec3(0, 0, 1), Vec3(4, 0, 0), Vec3(0, 4, 0));
  addSheet(surface, "Wall", Vec3(0, 2, 0), Vec3(4, 0, 0), Vec3(0, 0, 4));
  const PlumbLines lines(surface, allTriangles(surface));
  std::vector<PlumbHit> hits;
  const auto trianglesAt = [&](double x, double y) {
    lines.find(x, y, hits);
    std::vector<Index> triangles;
    std::ranges::transform(hits, std::back_inserter(triangles), &PlumbHit::triangle);
    return triangles;
  };
  EXPECT_THAT(trianglesAt(2, 2), ElementsAre(2, 3, 0, 1)) << "equal heights go by triangle";
  EXPECT_THAT(trianglesAt(3, 1), ElementsAre(2, 0));
  EXPECT_THAT(trianglesAt(1, 3), ElementsAre(3, 1));
  EXPECT_THAT(trianglesAt(4, 0), ElementsAre(2, 0)) << "corners belong to it";
  for (const auto& [x, y] : {std::pair(-0.01, 2.0), {4.01, 2.0}, {2.0, -0.01}, {2.0, 4.01}})
  {
    EXPECT_THAT(trianglesAt(x, y), IsEmpty());
  }
  PlumbLines(surface, {}).find(2, 2, hits);
  EXPECT_THAT(hits, IsEmpty());
}

/// A line from `top` down, and whether the wall is within its reach.
struct LineBesideWall
{
  Vec3 top;
  double bottom;
  double reach;
  bool isNear;
};

TEST(PlumbLines, FindUprightTrianglesWithinReachOfALine)
{
  TriangleSurface surface; // a wall, and around it what is not upright
  addSheet(surface, "Wall", Vec3(0, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 3));
  addSheet(surface, "Floor", Vec3(-9, -9, 1), Vec3(18, 0, 0), Vec3(0, 18, 0));
  addSheet(surface, "Steep", Vec3(0, 0, 0), Vec3(0, 4, 0), Vec3(0.01, 0, 3));
  const PlumbLines lines(surface, allTriangles(surface));
  for (const LineBesideWall& line : {LineBesideWall{Vec3(0.05, 2, 5), 0.0, 0.06, true},
                                     {Vec3(0.05, 2, 5), 0.0, 0.04, false},
                                     {Vec3(-0.05, 2, 5), 0.0, 0.06, true},
                                     {Vec3(0, 2, 2), 1.0, 0.0, true},
                                     {Vec3(0, 2, 5), 3.05, 0.06, true},
                                     {Vec3(0, 2, 5), 3.05, 0.04, false},
                                     {Vec3(0, 2, -0.05), -2.0, 0.06, true},
                                     {Vec3(0, 2, -0.05), -2.0, 0.04, false},
                                     {Vec3(0.03, 4.04, 5), 0.0, 0.051, true},
                                     {Vec3(0.03, 4.04, 5), 0.0, 0.049, false},
                                     {Vec3(0.03, -0.04, 5), 0.0, 0.051, true},
                                     {Vec3(0.03, -0.04, 5), 0.0, 0.049, false}})
  {
    std::set<Index> found;
    lines.eachUprightBelow(line.top, line.bottom, line.reach, [&](Index t) { found.insert(t); });
    EXPECT_EQ(!found.empty(), line.isNear) << line.top.transpose() << " reach " << line.reach;
    EXPECT_TRUE(found.empty() || *found.rbegin() < 2U) << "only those of the wall";
  }
}

TEST(Terrain, IsTheSiteIfItIsHigherThanFlat)
{
  TriangleSurface surface;
  addSheet(surface, "House", Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 9));
  addSheet(surface, "Site", Vec3(0, 0, 3), Vec3(8, 0, 0.5), Vec3(0, 8, 0));
  EXPECT_THAT(terrainSurfaces(surface, "", "Site", 0.49), ElementsAre(0, 1));
  EXPECT_THAT(terrainSurfaces(surface, "", "Site", 0.5), ElementsAre(0, 0)) << "not more than it";
  EXPECT_THAT(terrainSurfaces(surface, "", "site", 0.0), ElementsAre(0, 0));
  EXPECT_THAT(terrainSurfaces(surface, "S*", "House", 99.0), ElementsAre(0, 1)) << "a pattern goes first";
  EXPECT_THROW(terrainSurfaces(surface, "T*", "Site", 0.0), Error);
}

/// A terrain of 4 x 3 cells of 1 m from the origin on.
struct HillyGrid
{
  static constexpr int columns = 4;
  static constexpr int rows = 3;
  std::array<std::array<double, rows + 1>, columns + 1> heights{};

  explicit HillyGrid(Random& random)
  {
    for (auto& column : heights)
    {
      std::ranges::generate(column, [&] { return random.in(0, 5); });
    }
  }

  double at(int i, int j) const { return heights.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j)); }

  TriangleSurface surface() const
  {
    std::vector<std::array<Vec3, 4>> quads;
    for (int i = 0; i < columns * rows; ++i)
    {
      const int x = i % columns;
      const int y = i / columns;
      quads.push_back({Vec3(x, y, at(x, y)), Vec3(x + 1, y, at(x + 1, y)), Vec3(x + 1, y + 1, at(x + 1, y + 1)),
                       Vec3(x, y + 1, at(x, y + 1))});
    }
    TriangleSurface out;
    addQuads(out, "Terrain", quads);
    return out;
  }

  /// Height of the border at the place nearest to one outside.
  double besides(double x, double y) const
  {
    const double u = std::clamp(x, 0.0, double{columns});
    const double v = std::clamp(y, 0.0, double{rows});
    const int i = std::min(static_cast<int>(u), columns - 1);
    const int j = std::min(static_cast<int>(v), rows - 1);
    const double s = u - i;
    const double t = v - j;
    return (1 - s) * ((1 - t) * at(i, j) + t * at(i, j + 1)) + s * ((1 - t) * at(i + 1, j) + t * at(i + 1, j + 1));
  }
};

TEST(Terrain, HasTheHeightOfTheNearestPlaceOfAnOutlineAlongTheSides)
{
  Random random(3);
  for (int round = 0; round < 10; ++round)
  {
    const HillyGrid grid(random);
    TriangleSurface surface = grid.surface();
    const TerrainOutline outline = extendTerrain(surface, {1}, {Vec3(-2, -1, 0), Vec3(7, 5, 0)}, 1e-6);
    EXPECT_EQ(outline.borderEdges, 14U);
    EXPECT_EQ(outline.nonManifoldEdges, 0U);
    EXPECT_EQ(outline.openBorders, 0U);
    EXPECT_NEAR(areaFromAbove(surface), 9.0 * 6.0, rounding);
    const PlumbLines lines(surface, allTriangles(surface));
    std::vector<PlumbHit> hits;
    for (int i = 0; i < 60; ++i)
    {
      const Vec2 p(random.in(-2, 7), random.in(-1, 5));
      lines.find(p[0], p[1], hits);
      ASSERT_FALSE(hits.empty()) << p.transpose();
      const bool isInside = p[0] > 0.0 && p[0] < 4.0 && p[1] > 0.0 && p[1] < 3.0;
      EXPECT_TRUE(isInside || std::abs(hits[0].height - grid.besides(p[0], p[1])) < 1e-6) << p.transpose();
    }
  }
}

TEST(Terrain, IsExtendedByTheSurfaceThatIsNearest)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(-2, 0, 0), Vec3(-1, 1, 5)});
  addSheet(surface, "West", Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 2, 0));
  addSheet(surface, "East", Vec3(1, 0, 1), Vec3(1, 0, 0), Vec3(0, 2, 0));
  const std::size_t before = surface.triangles.size();
  const TerrainOutline outline = extendTerrain(surface, {0, 1, 1}, {Vec3(-3, -1, -9), Vec3(5, 3, 9)}, 1e-6);
  EXPECT_EQ(outline.borderEdges, 6U) << "the common edge is none, nor are those of the house";
  EXPECT_EQ(outline.nonManifoldEdges, 0U);
  ASSERT_EQ(surface.surfaceIds.size(), surface.triangles.size());
  ASSERT_GT(surface.triangles.size(), before);
  for (std::size_t t = before; t < surface.triangles.size(); ++t)
  {
    const double x = middleOf(surface, t)[0];
    EXPECT_TRUE(surface.surfaceIds[t] == (x < 1.0 ? 1U : 2U) || (x > 0.0 && x < 2.0)) << x;
  }
}

TEST(Terrain, KeepsTheWayItFaces)
{
  for (const double way : {1.0, -1.0})
  {
    TriangleSurface surface;
    addSheet(surface, "Terrain", Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, way, 0));
    extendTerrain(surface, {1}, {Vec3(-2, -2, 0), Vec3(3, 3, 0)}, 1e-6);
    EXPECT_NEAR(areaFromAbove(surface), way * 25.0, rounding);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      EXPECT_GT(way * areaVector(surface, t)[2], 0.0);
    }
  }
}

TEST(Terrain, IsLeftAsItIsWhereItReachesAsFarAsAsked)
{
  TriangleSurface surface;
  addSheet(surface, "Terrain", Vec3(0, 0, 1), Vec3(6, 0, 0), Vec3(0, 4, 0));
  extendTerrain(surface, {1}, {Vec3(1, 1, 0), Vec3(5, 3, 0)}, 1e-6);
  EXPECT_NEAR(areaFromAbove(surface), 24.0, rounding);
  TriangleSurface oneSided;
  addSheet(oneSided, "Terrain", Vec3(0, 0, 1), Vec3(6, 0, 0), Vec3(0, 4, 0));
  extendTerrain(oneSided, {1}, {Vec3(1, 1, 0), Vec3(9, 3, 0)}, 1e-6);
  EXPECT_NEAR(areaFromAbove(oneSided), 36.0, rounding);
}

TEST(Terrain, MergesPointsWithinTheTolerance)
{
  for (const auto& [tolerance, edges] : {std::pair(1e-6, std::size_t{6}), {0.01, std::size_t{4}}})
  {
    TriangleSurface surface;
    addSurface(surface, "Terrain",
               {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.001, 0.001, 0}, {0.999, 1.001, 0}, {-0.001, 1.001, 0}},
               {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(extendTerrain(surface, {1}, {Vec3(-1, -1, 0), Vec3(2, 2, 0)}, tolerance).borderEdges, edges);
  }
}

TEST(Terrain, MergesPointsWhereverTheyAre)
{
  for (int i = 0; i < 100; ++i)
  {
    TriangleSurface surface;
    const double x = 0.0001 * i;
    const double off = x + 0.0002;
    addSurface(surface, "Terrain", {{x, 0, 0}, {1, 0, 0}, {x, 1, 0}, {off, 0, 0}, {off, 1, 0}, {-1, 0, 0}},
               {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(extendTerrain(surface, {1}, {Vec3(-2, -2, 0), Vec3(2, 2, 0)}, 0.01).borderEdges, 4U) << x;
  }
}

TEST(Terrain, CountsEdgesOfThreeTriangles)
{
  TriangleSurface surface;
  addSurface(surface, "Terrain", {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1.5, 0.5, 3}},
             {{0, 1, 2}, {0, 2, 3}, {0, 4, 2}});
  const TerrainOutline outline = extendTerrain(surface, {1}, {Vec3(-1, -1, 0), Vec3(3, 3, 0)}, 1e-6);
  EXPECT_EQ(outline.nonManifoldEdges, 1U);
  EXPECT_EQ(outline.borderEdges, 6U);
}

TEST(Terrain, ThatIsClosedOrUprightIsRefusedInWords)
{
  const auto wordsOf = [](TriangleSurface surface) -> std::string {
    try
    {
      extendTerrain(surface, {1}, {Vec3(-9, -9, 0), Vec3(9, 9, 0)}, 1e-6);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return {};
  };
  TriangleSurface solid;
  addBox(solid, "Terrain", {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  EXPECT_THAT(wordsOf(solid), HasSubstr("closed"));
  for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0)})
  {
    TriangleSurface wall;
    addSheet(wall, "Terrain", Vec3(0, 0, 0), along, Vec3(0, 0, 1));
    EXPECT_THAT(wordsOf(wall), HasSubstr("no extent"));
  }
}

/// True if the middle of a face is on the outer sides or the bottom of a block from the origin to `high`.
bool isBelowOrAround(const Vec3& middle, const Vec3& high)
{
  return middle[2] < rounding || middle[0] < rounding || middle[1] < rounding || middle[0] > high[0] - rounding ||
         middle[1] > high[1] - rounding;
}

TEST(UpperSides, OfBlocksWithPitsAndNotchesAreAllButBottomAndOuterSides)
{
  Random random(4);
  for (int round = 0; round < 60; ++round)
  {
    std::array<int, 9> heights{};
    std::ranges::generate(heights, [&] { return 1 + static_cast<int>(random.below(3)); });
    TriangleSurface surface;
    addCells(surface, "Ground", 3, Vec3(1, 2, 0.5),
             [&](int i, int j, int k) { return k < heights.at(static_cast<std::size_t>(3 * i + j)); });
    addBox(surface, "House", {Vec3(0.5, 0.5, 9), Vec3(2, 2, 12)});
    std::vector<std::array<Index, 3>> expected;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      if (surface.surfaceIds[t] == 1 || !isBelowOrAround(middleOf(surface, t), Vec3(3, 6, 1.5)))
      {
        expected.push_back(surface.triangles[t]);
      }
    }
    EXPECT_THAT(keepUpperSides(surface, {1, 0}, 1e-6), ElementsAre(0));
    EXPECT_EQ(surface.triangles, expected);
    EXPECT_EQ(surface.surfaceIds.size(), expected.size());
    EXPECT_EQ(std::ranges::count(surface.surfaceIds, 1U), 12);
  }
}

TEST(UpperSides, AreTakenOfClosedGroundAlone)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  addBox(surface, "Slab", {Vec3(2, 0, 0), Vec3(3, 1, 1)});
  addBox(surface, "Open", {Vec3(4, 0, 0), Vec3(5, 1, 1)});
  surface.triangles.pop_back();
  surface.surfaceIds.pop_back();
  addSheet(surface, "Sheet", Vec3(6, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const std::vector<std::array<Index, 3>> before = surface.triangles;
  EXPECT_THAT(keepUpperSides(surface, {0, 0, 1, 1}, 1e-6), IsEmpty());
  EXPECT_EQ(surface.triangles, before);
  EXPECT_THAT(keepUpperSides(surface, {0, 1, 1, 1}, 1e-6), ElementsAre(1));
  std::array<std::ptrdiff_t, 4> counts{};
  for (Index id = 0; id < 4; ++id)
  {
    counts.at(id) = std::ranges::count(surface.surfaceIds, id);
  }
  EXPECT_THAT(counts, ElementsAre(12, 2, 11, 2));
}

TEST(UpperSides, HaveNothingOfTheirBodyMoreThanTheToleranceAbove)
{
  for (const auto& [tolerance, kept] : {std::pair(0.09, std::size_t{2}), {0.11, std::size_t{12}}})
  {
    TriangleSurface surface;
    addBox(surface, "Slab", {Vec3(0, 0, 0), Vec3(3, 3, 0.1)});
    keepUpperSides(surface, {1}, tolerance);
    EXPECT_EQ(surface.triangles.size(), kept);
  }
  TriangleSurface stacked; // another body above takes nothing away
  addBox(stacked, "Lower", {Vec3(0, 0, 0), Vec3(3, 3, 1)});
  addBox(stacked, "Upper", {Vec3(0, 0, 2), Vec3(3, 3, 3)});
  EXPECT_THAT(keepUpperSides(stacked, {1, 1}, 1e-6), ElementsAre(0, 1));
  EXPECT_THAT(stacked.surfaceIds, ElementsAre(0, 0, 1, 1));
}

/// A slab from the origin with its top at 0, and a house on it.
struct SlabCase
{
  Vec3 slab;
  Box3 house;
  Index expected;
};

Index slabOf(const TriangleSurface& surface, double tolerance = 1e-3)
{
  return findGroundSlab(surface, findBodies(surface, SurfaceFlags(surface.names.size(), 0)), tolerance);
}

TriangleSurface slabAndHouse(const SlabCase& of)
{
  TriangleSurface surface;
  addBox(surface, "House", of.house);
  addBox(surface, "Slab", {Vec3(0, 0, -of.slab[2]), Vec3(of.slab[0], of.slab[1], 0)});
  return surface;
}

TEST(GroundSlab, IsFlatAndWideAndHoldsAllElse)
{
  const Box3 house{Vec3(3, 3, 0.01), Vec3(10, 10, 6)};
  for (const SlabCase& of : {SlabCase{Vec3(20, 30, 1), house, 1},
                             {Vec3(20, 30, 1.99), house, 1},
                             {Vec3(20, 30, 2.01), house, noIndex},
                             {Vec3(30, 20, 2.01), house, noIndex},
                             {Vec3(20, 30, 0.0005), house, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, 3, -0.5), Vec3(10, 10, 6)}, 1},
                             {Vec3(20, 30, 1), {Vec3(3, 3, -1.1), Vec3(10, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(-0.1, 3, 0.01), Vec3(10, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, -0.1, 0.01), Vec3(10, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, 3, 0.01), Vec3(20.1, 10, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(3, 3, 0.01), Vec3(10, 30.1, 6)}, noIndex},
                             {Vec3(20, 30, 1), {Vec3(1, 1, 0.01), Vec3(19, 17.6, 6)}, 1},
                             {Vec3(20, 30, 1), {Vec3(1, 1, 0.01), Vec3(19, 17.7, 6)}, noIndex}})
  {
    EXPECT_EQ(slabOf(slabAndHouse(of)), of.expected) << of.slab.transpose() << ", " << of.house.min.transpose();
  }
}

TEST(GroundSlab, IsClosedAndHasItsNameForItself)
{
  const SlabCase good{Vec3(20, 20, 1), {Vec3(3, 3, 0.01), Vec3(10, 10, 6)}, 1};
  TriangleSurface open = slabAndHouse(good);
  open.triangles.pop_back();
  open.surfaceIds.pop_back();
  EXPECT_EQ(slabOf(open), noIndex);
  TriangleSurface sameName = slabAndHouse(good);
  addBox(sameName, "Shed", {Vec3(12, 12, 0.01), Vec3(14, 14, 2)});
  EXPECT_EQ(slabOf(sameName), 1U);
  std::ranges::replace(sameName.surfaceIds, Index{2}, Index{1});
  EXPECT_EQ(slabOf(sameName), noIndex);
  TriangleSurface alone;
  addBox(alone, "Slab", {Vec3(0, 0, -1), Vec3(20, 20, 0)});
  EXPECT_EQ(slabOf(alone), noIndex);
  EXPECT_EQ(slabOf({}), noIndex);
}

/// Faces 1 m wide at a height, with a model above.
LowestFace faceAt(double height, double area, double rise) { return {height, area, rise, noIndex}; }

/// The cost by the words of groundModel().
double costOf(const std::vector<LowestFace>& faces, double floor)
{
  double cost = 0.0;
  for (const LowestFace& face : faces)
  {
    const double gap = face.height - floor;
    const bool hovers = gap > 0.25 * face.rise;
    cost += face.area * (gap < 0.0 ? 3.0 * -gap : hovers ? face.rise : gap);
  }
  return cost;
}

TEST(Floor, IsTheLeastCostlyHeightOfAFace)
{
  Random random(5);
  for (int round = 0; round < 200; ++round)
  {
    std::vector<LowestFace> faces;
    const std::size_t count = 1 + random.below(12);
    for (std::size_t i = 0; i < count; ++i)
    {
      faces.push_back(faceAt(random.in(-2, 5), random.in(0.1, 3), random.below(4) == 0 ? 0.0 : random.in(0.1, 20)));
    }
    faces.front().rise = 1.0;
    double best = faces.front().height;
    for (const LowestFace& face : faces)
    {
      best = costOf(faces, face.height) < costOf(faces, best) ? face.height : best;
    }
    EXPECT_EQ(findFloor(faces, -99.0), best);
  }
}

TEST(Floor, IsTheLowestOfEqualOnesAndWeighsDepthThreefold)
{
  const auto floorOf = [](double area, double rise) {
    return findFloor({faceAt(1, area, rise), faceAt(0, 1, 10)}, -99.0);
  };
  EXPECT_EQ(floorOf(3.0, 4.0), 0.0) << "both cost three";
  EXPECT_EQ(floorOf(3.01, 4.0), 1.0);
  EXPECT_EQ(floorOf(2.99, 4.0), 0.0);
  EXPECT_EQ(floorOf(0.8, 3.99), 1.0) << "it would hover over the other";
  EXPECT_EQ(floorOf(0.8, 4.0), 0.0) << "a quarter of its height is no hovering";
}

TEST(Floor, IsTheLowestPointIfNoFaceHasAnythingAbove)
{
  EXPECT_EQ(findFloor({}, -7.0), -7.0);
  EXPECT_EQ(findFloor({faceAt(1, 5, 0), faceAt(2, 0, 5)}, -7.0), -7.0);
  EXPECT_EQ(findFloor({faceAt(1, 5, 0), faceAt(2, 1, 5)}, -7.0), 1.0) << "faces without cost as well";
}

TEST(Floor, OfManyFacesIsNextToTheBest)
{
  Random random(6);
  for (const std::size_t count : {511U, 512U, 513U, 1024U, 1025U, 3000U})
  {
    std::vector<LowestFace> faces;
    for (std::size_t i = 0; i < count; ++i)
    {
      faces.push_back(faceAt(random.in(0, 10), 1.0, 1e3));
    }
    std::vector<double> heights;
    std::ranges::transform(faces, std::back_inserter(heights), &LowestFace::height);
    std::ranges::sort(heights);
    const double floor = findFloor(faces, -99.0);
    // A quarter of the faces lies below the best floor, as depth costs three times as much as height.
    const auto below = std::ranges::lower_bound(heights, floor) - heights.begin();
    const double off = std::abs(static_cast<double>(below) - static_cast<double>(count) / 4.0);
    EXPECT_LE(off, 1.0 + std::ceil(static_cast<double>(count) / 512.0)) << count;
  }
}

TEST(GroundBelow, IsTheHigherOneOfSurfaceAndFloor)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", Vec3(0, 0, 0), Vec3(4, 0, 4), Vec3(0, 4, 0));
  const Ground slope(surface, {1}, 0.0);
  const auto heightAt = [&](double x, std::optional<double> floor, bool useSurface) {
    return GroundBelow{slope, floor, false, useSurface}.heightAt(Vec3(x, 1, 77));
  };
  EXPECT_NEAR(heightAt(3, 2.0, true), 3.0, rounding);
  EXPECT_NEAR(heightAt(1, 2.0, true), 2.0, rounding);
  EXPECT_NEAR(heightAt(1, std::nullopt, true), 1.0, rounding);
  EXPECT_EQ(heightAt(3, 2.0, false), 2.0);
  EXPECT_EQ(heightAt(3, std::nullopt, false), -std::numeric_limits<double>::infinity());
}

/// A model, and the support of the bases of its first body.
class Supports
{
public:
  static constexpr double reach = 0.1;
  static constexpr double tolerance = 0.01;

  explicit Supports(TriangleSurface model)
      : surface(std::move(model)), bodies(findBodies(surface, SurfaceFlags(surface.names.size(), 0))),
        lines(surface, allTriangles(surface)), bases(findBases(surface, bodies, lines, 0.0, tolerance)),
        search(surface, bodies, lines, bases.bases, reach, tolerance)
  {
  }

  BaseSupport at(double height, double ground) const
  {
    for (Index base = 0; base < bases.bases.size(); ++base)
    {
      if (bases.bases[base].body == 0 && std::abs(bases.bases[base].low - height) < rounding)
      {
        return search.find(base, ground);
      }
    }
    ADD_FAILURE() << "no base at " << height;
    return BaseSupport::none;
  }
  bool isBeside(double low, double ground) const { return search.isBesideOther(0, low, ground); }

private:
  TriangleSurface surface;
  ModelBodies bodies;
  PlumbLines lines;
  BodyBases bases;
  SupportSearch search;
};

/// Another body near a block [0, 2] x [0, 2] x [2, 4].
struct Neighbor
{
  const char* what;
  Box3 box;
  double ground;
  BaseSupport expected;
};

void expectSupport(const Neighbor& neighbor)
{
  TriangleSurface surface;
  addBox(surface, "Block", {Vec3(0, 0, 2), Vec3(2, 2, 4)});
  addBox(surface, "Other", neighbor.box);
  EXPECT_EQ(Supports(surface).at(2.0, neighbor.ground), neighbor.expected) << neighbor.what;
}

TEST(BaseSupport, IsABodyBelowOrAround)
{
  for (const Neighbor& neighbor :
       {Neighbor{"far", {Vec3(9, 9, 0), Vec3(11, 11, 8)}, 0.0, BaseSupport::none},
        {"under it", {Vec3(0.5, 0.5, 0), Vec3(1.5, 1.5, 1)}, 0.0, BaseSupport::below},
        {"a cellar", {Vec3(0.5, 0.5, 0), Vec3(1.5, 1.5, 1)}, 1.0, BaseSupport::none},
        {"just higher than the ground", {Vec3(0.5, 0.5, 0), Vec3(1.5, 1.5, 1)}, 0.98, BaseSupport::below},
        {"a thin column", {Vec3(0.95, 0.95, 0), Vec3(1.05, 1.05, 1)}, 0.0, BaseSupport::below},
        {"under the border alone", {Vec3(-2, 0.5, 0), Vec3(0.09, 1.5, 1)}, 0.0, BaseSupport::none},
        {"under the border at the lower y", {Vec3(0.5, -2, 0), Vec3(1.5, 0.09, 1)}, 0.0, BaseSupport::none},
        {"under the border at the upper x", {Vec3(1.91, 0.5, 0), Vec3(4, 1.5, 1)}, 0.0, BaseSupport::none},
        {"under the border at the upper y", {Vec3(0.5, 1.91, 0), Vec3(1.5, 4, 1)}, 0.0, BaseSupport::none},
        {"under the border and farther", {Vec3(-2, 0.5, 0), Vec3(0.11, 1.5, 1)}, 0.0, BaseSupport::below},
        {"under two thirds", {Vec3(-2, -2, 0), Vec3(4, 1.3, 1)}, 0.0, BaseSupport::below},
        {"above it", {Vec3(0.5, 0.5, 5), Vec3(1.5, 1.5, 6)}, 0.0, BaseSupport::none},
        {"as low", {Vec3(0.5, 0.5, 1.995), Vec3(1.5, 1.5, 3)}, 0.0, BaseSupport::beside},
        {"around it", {Vec3(-1, -1, 0), Vec3(3, 3, 6)}, 0.0, BaseSupport::below}})
  {
    expectSupport(neighbor);
  }
}

TEST(BaseSupport, OfWallsWithoutABottomIsSoughtWithinTheirOutline)
{
  for (const Neighbor& neighbor :
       {Neighbor{"in the middle", {Vec3(0.95, 0.95, 0), Vec3(1.05, 1.05, 1)}, 0.0, BaseSupport::below},
        {"in a corner", {Vec3(0.2, 0.2, 0), Vec3(0.4, 0.4, 1)}, 0.0, BaseSupport::below},
        {"a cellar", {Vec3(0.2, 0.2, 0), Vec3(0.4, 0.4, 1)}, 1.0, BaseSupport::none},
        {"under the border alone", {Vec3(-2, 0.5, 0), Vec3(0.09, 0.8, 1)}, 0.0, BaseSupport::none},
        {"under the border and farther", {Vec3(-2, 0.5, 0), Vec3(0.11, 0.8, 1)}, 0.0, BaseSupport::below},
        {"above", {Vec3(0.2, 0.2, 5), Vec3(0.4, 0.4, 6)}, 0.0, BaseSupport::none}})
  {
    TriangleSurface surface;
    addBox(surface, "Block", {Vec3(0, 0, 2), Vec3(2, 2, 4)});
    std::erase_if(surface.triangles, [&](const std::array<Index, 3>& t) {
      return std::ranges::all_of(t, [&](Index p) { return surface.points[p][2] == 2.0; });
    });
    surface.surfaceIds.resize(surface.triangles.size());
    addBox(surface, "Other", neighbor.box);
    EXPECT_EQ(Supports(surface).at(2.0, neighbor.ground), neighbor.expected) << neighbor.what;
  }
}

TEST(BaseSupport, IsABodyBesideThatReachesAsLow)
{
  for (const Neighbor& neighbor :
       {Neighbor{"next to it", {Vec3(2.09, 0, 0), Vec3(3, 2, 6)}, 0.0, BaseSupport::beside},
        {"too far", {Vec3(2.11, 0, 0), Vec3(3, 2, 6)}, 0.0, BaseSupport::none},
        {"too far in y", {Vec3(0, -1, 0), Vec3(2, -0.11, 6)}, 0.0, BaseSupport::none},
        {"touching from below", {Vec3(2.05, 0, 0), Vec3(3, 2, 1.91)}, 0.0, BaseSupport::beside},
        {"too low to touch", {Vec3(2.05, 0, 0), Vec3(3, 2, 1.89)}, 0.0, BaseSupport::none},
        {"as low", {Vec3(2.05, 0, 2.009), Vec3(3, 2, 6)}, 0.0, BaseSupport::beside},
        {"not as low", {Vec3(2.05, 0, 2.011), Vec3(3, 2, 6)}, 0.0, BaseSupport::none},
        {"in the ground", {Vec3(2.05, 0, 0), Vec3(3, 2, 1.95)}, 1.95, BaseSupport::none}})
  {
    expectSupport(neighbor);
  }
}

TEST(BaseSupport, IsTheBodyItselfWhereItReachesLower)
{
  TriangleSurface surface; // a bridge on two legs
  addCells(surface, "Bridge", 3, Vec3(1, 1, 1), [](int i, int j, int k) { return j == 0 && (k > 0 || i != 1); });
  const Supports supports(surface);
  EXPECT_EQ(supports.at(1.0, -2.0), BaseSupport::beside);
  EXPECT_EQ(supports.at(0.0, -2.0), BaseSupport::none);
}

TEST(BaseSupport, OfOtherBodiesCountsTouchDepthAndRise)
{
  TriangleSurface surface;
  addBox(surface, "Block", {Vec3(0, 0, 2), Vec3(2, 2, 4)});
  EXPECT_FALSE(Supports(surface).isBeside(2.0, 0.0)) << "it is not beside itself";
  addBox(surface, "Other", {Vec3(2, 0, 1), Vec3(3, 2, 3)});
  const Supports supports(surface);
  EXPECT_TRUE(supports.isBeside(2.0, 0.0));
  EXPECT_TRUE(supports.isBeside(0.995, 0.0)) << "within the tolerance";
  EXPECT_FALSE(supports.isBeside(0.98, 0.0));
  EXPECT_TRUE(supports.isBeside(2.0, 2.98));
  EXPECT_FALSE(supports.isBeside(2.0, 2.995));
}

/// A diamond with corners 2 m from the origin, from 0 to 3 m.
PlacedPrism diamond() { return {Placement(), {Vec2(2, 0), Vec2(0, 2), Vec2(-2, 0), Vec2(0, -2)}, 0.0, 3.0}; }
const double diamondSide = 2.0 * std::sqrt(2.0);

std::map<Index, double> areasById(const TriangleSurface& surface)
{
  std::map<Index, double> areas;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    areas[surface.surfaceIds[t]] += areaVector(surface, t).norm();
  }
  return areas;
}

/// Expects four sides of a height that face outwards, less what covers the first of them.
void expectSides(const TriangleSurface& surface, Index names, double height, double covered = 0.0)
{
  const std::map<Index, double> areas = areasById(surface);
  for (Index side = 0; side < 4; ++side)
  {
    const auto found = areas.find(names + firstPrismSide + side);
    ASSERT_NE(found, areas.end());
    EXPECT_NEAR(found->second, diamondSide * height - (side == 0 ? covered : 0.0), 1e-9) << side;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.surfaceIds[t] >= names)
    {
      const Vec2 out = areaVector(surface, t).head<2>();
      EXPECT_GT(out.dot(middleOf(surface, t).head<2>()), 0.0) << "outwards";
    }
  }
}

TEST(TurnedSides, OfAnEmptyModelAreSheetsThatShareTheirEdges)
{
  TriangleSurface surface;
  surface.names = {"House", "Tree"};
  EXPECT_TRUE(cutToSides(surface, diamond(), 1.5, 1e-6).empty());
  expectSides(surface, 2, 6.0);
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : surface.points)
  {
    EXPECT_TRUE(p[2] == -1.5 || p[2] == 4.5);
    places.insert({p[0], p[1], p[2]});
  }
  EXPECT_EQ(places.size(), 8U) << "corners have the same bits on both sides";
}

TEST(TurnedSides, CutOffWhatIsBeyond)
{
  TriangleSurface surface;
  addSheet(surface, "Wide", Vec3(-9, -9, 1), Vec3(18, 0, 0), Vec3(0, 18, 0));
  addSheet(surface, "Within", Vec3(-0.5, -0.5, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  addSheet(surface, "Beyond", Vec3(3, 3, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  addSheet(surface, "Half", Vec3(0, -9, 2.5), Vec3(9, 0, 0), Vec3(0, 18, 0));
  EXPECT_TRUE(cutToSides(surface, diamond(), 1.5, 1e-6).empty());
  std::map<Index, double> areas = areasById(surface);
  EXPECT_NEAR(areas[0], 8.0, 1e-9);
  EXPECT_NEAR(areas[1], 1.0, 1e-9);
  EXPECT_EQ(areas[2], 0.0);
  EXPECT_NEAR(areas[3], 4.0, 1e-9);
  expectSides(surface, 4, 6.0);
  EXPECT_NEAR(areaFromAbove(surface), 13.0, 1e-9) << "fronts stay fronts";
  for (const Vec3& p : surface.points)
  {
    EXPECT_LE(std::abs(p[0]) + std::abs(p[1]), 2.0 + 1e-12);
  }
}

using PlacePair = std::array<std::array<double, 3>, 2>;

/// Number of uses of each edge by the triangles whose ids `isWanted`.
template <typename IsWanted> std::map<PlacePair, int> edgesOf(const TriangleSurface& surface, IsWanted&& isWanted)
{
  const auto placeOf = [&](Index p) {
    return std::array{surface.points[p][0], surface.points[p][1], surface.points[p][2]};
  };
  std::map<PlacePair, int> uses;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (std::size_t i = 0; i < 3 && isWanted(surface.surfaceIds[t]); ++i)
    {
      PlacePair edge{placeOf(surface.triangles[t].at(i)), placeOf(surface.triangles[t].at((i + 1) % 3))};
      std::ranges::sort(edge);
      ++uses[edge];
    }
  }
  return uses;
}

TEST(TurnedSides, ShareEdgesWithWhatTheyCut)
{
  TriangleSurface surface;
  addSheet(surface, "Slope", Vec3(-9, -9, 1), Vec3(18, 0, 0.5), Vec3(0, 18, 0.7));
  cutToSides(surface, diamond(), 1.5, 1e-6);
  const auto ofSlope = edgesOf(surface, [](Index id) { return id == 0; });
  const auto ofSides = edgesOf(surface, [](Index id) { return id != 0; });
  int borders = 0;
  for (const auto& [edge, count] : ofSlope)
  {
    borders += count == 1 ? 1 : 0;
    EXPECT_EQ(ofSides.contains(edge), count == 1);
  }
  EXPECT_GE(borders, 4);
}

TEST(TurnedSides, GiveWayToTrianglesInTheirPlanes)
{
  const Vec3 along(-1, 1, 0); // of the first side, from (2, 0) to (0, 2)
  TriangleSurface surface;
  addSheet(surface, "Gate", Vec3(1.5, 0.5, 1), along, Vec3(0, 0, 1));
  EXPECT_TRUE(cutToSides(surface, diamond(), 1.0, 1e-6).empty());
  const double gate = along.norm();
  EXPECT_NEAR(areasById(surface)[0], gate, 1e-9);
  expectSides(surface, 1, 5.0, gate);
}

TEST(TurnedSides, TakeTheSmallerOfTwoInOnePlaceAndTellWhatItShares)
{
  const Vec3 along(-1, 1, 0);
  for (const bool isWallFirst : {false, true})
  {
    TriangleSurface surface;
    const auto addWall = [&] { addSheet(surface, "Wall", Vec3(1.75, 0.25, 1), 1.5 * along, Vec3(0, 0, 1)); };
    const auto addGate = [&] { addSheet(surface, "Gate", Vec3(1.5, 0.5, 1), 0.5 * along, Vec3(0, 0, 0.5)); };
    isWallFirst ? (addWall(), addGate()) : (addGate(), addWall());
    const Index wall = isWallFirst ? 0 : 1;
    const std::vector<SharedArea> shared = cutToSides(surface, diamond(), 1.0, 1e-6);
    const double unit = along.norm();
    ASSERT_EQ(shared.size(), 1U);
    EXPECT_EQ(shared[0].gives, wall);
    EXPECT_EQ(shared[0].keeps, 1 - wall);
    EXPECT_NEAR(shared[0].area, 0.25 * unit, 1e-9);
    EXPECT_EQ(shared[0].equalArea, 0.0);
    EXPECT_NEAR(areasById(surface)[1 - wall], 0.25 * unit, 1e-9);
    EXPECT_NEAR(areasById(surface)[wall], 1.25 * unit, 1e-9);
    expectSides(surface, 2, 5.0, 1.5 * unit);
  }
}

TEST(TurnedSides, PutPointsOnThemWithinTheTolerance)
{
  for (const auto& [distance, isOn] : {std::pair(0.009, true), {-0.009, true}, {-0.011, false}})
  {
    const double off = distance / std::sqrt(2.0);
    TriangleSurface surface;
    addSheet(surface, "Gate", Vec3(1.5 + off, 0.5 + off, 1), Vec3(-1, 1, 0), Vec3(0, 0, 1));
    cutToSides(surface, diamond(), 1.0, 0.01);
    EXPECT_NEAR(areasById(surface)[0], std::sqrt(2.0), 1e-9);
    expectSides(surface, 1, 5.0, isOn ? std::sqrt(2.0) : 0.0);
  }
  TriangleSurface beyond;
  addSheet(beyond, "Gate", Vec3(1.51, 0.51, 1), Vec3(-1, 1, 0), Vec3(0, 0, 1));
  cutToSides(beyond, diamond(), 1.0, 0.01);
  EXPECT_EQ(areasById(beyond).count(0), 0U) << "what lies beyond is dropped";
}

TEST(TurnedSides, ReachAsFarAsTheSurfacesThatMeetThem)
{
  TriangleSurface surface;
  addSheet(surface, "Tower", Vec3(0, -9, -8), Vec3(0, 18, 0), Vec3(0, 0, 20));
  cutToSides(surface, diamond(), 1.0, 1e-6);
  expectSides(surface, 1, 20.0);
  TriangleSurface inside;
  addSheet(inside, "Tower", Vec3(0, -1, -8), Vec3(0, 2, 0), Vec3(0, 0, 20));
  cutToSides(inside, diamond(), 1.0, 1e-6);
  expectSides(inside, 1, 5.0);
}

} // namespace
