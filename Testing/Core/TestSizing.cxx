// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/BoxDistance.h"
#include "Octree/Tree/GeometryLists.h"
#include "SizedOctree.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double rounding = 1.0 + 1e-9;

LatticeBox boxOf(const Octree& octree, Index leaf)
{
  return domainBoxOf(octree.frame(), octree.level(leaf), octree.key(leaf));
}

bool holdsSurface(const Sized& s, Index leaf, Index surface)
{
  const auto items = s.octree.items(leaf);
  return std::any_of(items.begin(), items.end(), [&](ModelItem item) {
    return item.kind == ModelItem::triangle && s.model.surfaceIds[item.index] == surface;
  });
}

/// Calls `visit(leaf)` for leaves in the domain.
Index leafAt(const Octree& octree, const Vec3& p) { return octree.leafAt(octree.frame().toLattice(p)); }

/// Leaves that a line along `axis` through `p` passes between two coordinates.
int leavesAcross(const Octree& octree, Vec3 p, int axis, double from, double to)
{
  int count = 0;
  Index last = noIndex;
  constexpr int steps = 4000;
  for (int i = 0; i <= steps; ++i)
  {
    p[axis] = from + (to - from) * (1e-3 + i * (1.0 - 2e-3) / steps);
    const Index leaf = leafAt(octree, p);
    count += leaf != last ? 1 : 0;
    last = leaf;
  }
  return count;
}

/// Triangles about a point at some distance beside a box, each of which passes through it, and shares an edge within it
/// with the one before and the one behind.
SurfaceModel fanThrough(const LatticeBox& box, Index count)
{
  SurfaceModel fan;
  fan.points.push_back({box.low[0] - 1000, box.low[1], box.low[2]});
  for (Index i = 0; i <= count; ++i)
  {
    const std::int64_t width = box.high[1] - box.low[1];
    fan.points.push_back({box.high[0] + 1000, box.low[1] + (i + 1) * width / (count + 2), box.low[2]});
  }
  for (Index i = 0; i < count; ++i)
  {
    fan.triangles.push_back({0, i + 1, i + 2});
  }
  return fan;
}

TEST(SeveralSurfaces, AreToldFromOneForAnyNumberOfTrianglesInAnyOrder)
{
  const LatticeBox box{{0, 0, 0}, {4000, 4000, 4000}};
  std::mt19937 random(3);
  for (Index count = 1; count < 50; ++count)
  {
    const SurfaceModel fan = fanThrough(box, count);
    std::vector<ModelItem> pieces;
    for (Index t = 0; t < count; ++t)
    {
      pieces.push_back({ModelItem::triangle, t});
    }
    std::ranges::shuffle(pieces, random);
    EXPECT_FALSE(severalSurfaces(box, pieces, fan)) << count;
    // Without one between them two parts have their point outside the box in common, and nothing within it.
    const Index gone = 1 + static_cast<Index>(random() % std::max<Index>(1, count - 2));
    std::erase_if(pieces, [&](ModelItem piece) { return piece.index == gone; });
    EXPECT_EQ(severalSurfaces(box, pieces, fan), count > 2) << count << " without " << gone;
    // A box about that point holds one surface again.
    EXPECT_FALSE(severalSurfaces({{-2000, 0, 0}, {4000, 4000, 4000}}, pieces, fan)) << count;
  }
}

TEST(SizePatterns, StarsAndQuestionMarksStandForText)
{
  EXPECT_TRUE(matchesPattern("Wall*", "Wall north"));
  EXPECT_TRUE(matchesPattern("*", ""));
  EXPECT_TRUE(matchesPattern("*a*b*", "xxaxxbaab"));
  EXPECT_TRUE(matchesPattern("Wall_?", "Wall_7"));
  EXPECT_TRUE(matchesPattern("a*aab", "aaaaab"));
  EXPECT_FALSE(matchesPattern("Wall_?", "Wall_"));
  EXPECT_FALSE(matchesPattern("Wall", "Walls"));
  EXPECT_FALSE(matchesPattern("*a*b", "xxaxxbaa"));
  EXPECT_FALSE(matchesPattern("", "x"));
}

TEST(SizePatterns, MisspeltNamesAreToldWhatTheyAreLikelyToBe)
{
  const std::vector<std::string> names{"Floor", "WallSouth", "WallNorth", "Roof 1", "Garden"};
  EXPECT_EQ(nearestName("Flor", names), "Floor");
  EXPECT_EQ(nearestName("wallnorth", names), "WallNorth");
  EXPECT_EQ(nearestName("WallSuoth", names), "WallSouth");
  EXPECT_EQ(nearestName("wall*", names), "WallSouth");
  EXPECT_EQ(nearestName("Gardens*", names), "Garden");
  EXPECT_EQ(nearestName("Chimney", names), "");
  EXPECT_EQ(nearestName("*", names), "");
  EXPECT_EQ(nearestName("x", {}), "");
  EXPECT_EQ(namesInstead("Flor", names),
            "did you mean 'Floor'? There are: Floor, WallSouth, WallNorth, Roof 1, Garden");
  EXPECT_EQ(namesInstead("Chimney", names), "there are: Floor, WallSouth, WallNorth, Roof 1, Garden");
}

TEST(SizePatterns, RulesAsTextComeBackAsTheyWere)
{
  const SurfaceSize rule = surfaceSizeFrom(textOf(SurfaceSize{"Wall \"2\" *", 0.1, 0.3}));
  EXPECT_EQ(rule.pattern, "Wall \"2\" *");
  EXPECT_EQ(rule.size, 0.1);
  EXPECT_EQ(rule.featureSize, 0.3);
  EXPECT_EQ(surfaceSizeFrom("Wall* 2").featureSize, std::nullopt);
  const std::vector<DistanceSize> sizes = distanceSizesFrom("Wall* 5 1 10 2");
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_EQ(sizes[1].distance, 10.0);
  EXPECT_EQ(sizes[1].size, 2.0);
  for (const char* text : {"", "Wall", "Wall x", "Wall 1 2 3", "Wall 1 m"})
  {
    EXPECT_THROW(surfaceSizeFrom(text), Error) << text;
  }
  EXPECT_THROW(distanceSizesFrom("Wall 1"), Error);
}

TEST(Sizing, WithoutRulesTheFinestOctantsHaveSizeMinAtFeaturesOnly)
{
  const Sized s = sized(twoBoxes(), gridOf(24.0, 0.5, 1.0, 4.0), {});
  EXPECT_EQ(s.frame.featureLevel, s.frame.depth);
  EXPECT_EQ(s.frame.finestSize, 0.5);
  eachLeaf(s.octree, [&](Index leaf) {
    EXPECT_TRUE(s.octree.featureType(leaf) <= FeatureType::surface || sizeOf(s.octree, leaf) == 0.5);
  });
}

TEST(Sizing, AFinerRuleAddsLevelsAndLeavesOthersAsTheyWere)
{
  const GridOptions grid = gridOf(24.0, 0.5, 1.0, 4.0);
  SizingOptions sizing;
  sizing.surfaceSizes = {{"Detail", 0.07, {}}};
  const Sized s = sized(twoBoxes(), grid, sizing);
  EXPECT_EQ(s.frame.finestSize, 0.0625);
  EXPECT_EQ(s.frame.depth - s.frame.featureLevel, 3);
  EXPECT_EQ(s.frame.sizeOf(s.frame.featureLevel), 0.5);
  eachLeaf(s.octree, [&](Index leaf) {
    if (holdsSurface(s, leaf, 1))
    {
      EXPECT_LE(sizeOf(s.octree, leaf), 0.07);
    }
    else if (s.octree.center(leaf)[0] < 0.0)
    {
      EXPECT_GE(sizeOf(s.octree, leaf), 0.5) << "balance does not reach the other side";
    }
  });
}

TEST(Sizing, ARuleTakesThePlaceOfBothSizes)
{
  SizingOptions sizing;
  sizing.surfaceSizes = {{"Wall*", 2.0, 2.0}, {"D?tail", 0.5, 0.25}};
  const Sized s = sized(twoBoxes(), gridOf(24.0, 0.5, 1.0, 4.0), sizing);
  double coarsestOnWall = 0.0;
  eachLeaf(s.octree, [&](Index leaf) {
    const double size = sizeOf(s.octree, leaf);
    if (holdsSurface(s, leaf, 1))
    {
      EXPECT_LE(size, s.octree.featureType(leaf) > FeatureType::surface ? 0.25 : 0.5);
    }
    if (holdsSurface(s, leaf, 0))
    {
      coarsestOnWall = std::max(coarsestOnWall, size);
      EXPECT_GE(size, 1.0);
    }
  });
  EXPECT_EQ(coarsestOnWall, 2.0);
}

TEST(Sizing, TheFinestOfSeveralRulesHoldsInAnyOrder)
{
  SizingOptions one;
  one.surfaceSizes = {{"*", 0.5, {}}, {"Detail", 0.25, {}}};
  SizingOptions other;
  other.surfaceSizes = {one.surfaceSizes[1], one.surfaceSizes[0]};
  const GridOptions grid = gridOf(24.0, 0.5, 1.0, 4.0);
  const Sized s = sized(twoBoxes(), grid, one);
  EXPECT_EQ(s.octants.refined, sized(twoBoxes(), grid, other).octants.refined);
  eachLeaf(s.octree, [&](Index leaf) {
    EXPECT_TRUE(!holdsSurface(s, leaf, 1) || sizeOf(s.octree, leaf) <= 0.25);
    EXPECT_TRUE(!holdsSurface(s, leaf, 0) || sizeOf(s.octree, leaf) <= 0.5);
  });
}

TEST(Sizing, SiteOfMoreThanAKilometerTakesDetailsOfCentimeters)
{
  TriangleSurface surface;
  addBox(surface, "Building", {Vec3(600, 700, 0), Vec3(640, 730, 25)});
  addBox(surface, "Detail", {Vec3(600.3, 699.2, 3.1), Vec3(601.1, 699.8, 3.6)});
  GridOptions grid;
  grid.domain = {Vec3::Zero(), Vec3(1343, 1692, 507)};
  grid.sizeMin = grid.sizeMid = 1.0;
  grid.sizeMax = 8.0;
  SizingOptions sizing;
  sizing.surfaceSizes = {{"Detail", 0.05, {}}};
  const Sized s = sized(surface, grid, sizing);
  EXPECT_LE(s.frame.finestSize, 0.05);
  EXPECT_GE(s.frame.subBits, 8);
  eachLeaf(s.octree, [&](Index leaf) {
    ASSERT_TRUE(!holdsSurface(s, leaf, 1) || sizeOf(s.octree, leaf) <= 0.05);
    ASSERT_TRUE(!holdsSurface(s, leaf, 0) || sizeOf(s.octree, leaf) <= 1.0);
    ASSERT_LE(sizeOf(s.octree, leaf), 8.0);
  });
  // The domain's planes are where they would be without the rule: by the centers of octants of SizeMin.
  for (int axis = 0; axis < 3; ++axis)
  {
    const double inUnits = (grid.domain.min[axis] - s.frame.origin[axis]) / grid.sizeMin;
    EXPECT_NEAR(inUnits - std::floor(inUnits), 0.5, 0.05);
  }
}

TEST(Sizing, BoxesAreObeyedAndNoOctantBesidesIsFinerThanBalanceAsks)
{
  const Box3 region{Vec3(-2.2, -3.1, 1.3), Vec3(1.9, 0.4, 2.2)};
  SizingOptions sizing;
  sizing.boxes = {{region, 0.25}};
  const Sized s = sized({}, gridOf(24.0, 0.5, 1.0, 4.0), sizing);
  EXPECT_EQ(s.frame.finestSize, 0.25);
  eachLeaf(s.octree, [&](Index leaf) {
    const LatticeBox box = boxOf(s.octree, leaf);
    const Vec3 low = s.frame.toModel(box.low);
    const Vec3 high = s.frame.toModel(box.high);
    const double apart = (low - region.max).cwiseMax(region.min - high).maxCoeff();
    const double size = sizeOf(s.octree, leaf);
    EXPECT_TRUE(apart >= 0.0 || size <= 0.25 * rounding);
    // In a balanced octree from level 0.25 up, an octant of size h is within h of the next finer ones.
    EXPECT_TRUE(size > 0.25 * rounding || apart < 2.0 * 0.25) << size << " at " << apart;
    EXPECT_TRUE(size > 0.5 * rounding || apart < 2.0 * 0.75) << size << " at " << apart;
  });
}

TEST(Sizing, SizesHoldUpToTheDistancesOfARule)
{
  TriangleSurface surface;
  addSheet(surface, "Sheet", Vec3(-1.3, -2.1, 0.4), Vec3(2.2, 1.1, 0.3), Vec3(-0.4, 3.0, 1.1));
  SizingOptions sizing;
  sizing.distanceSizes = {{"Sheet", 1.0, 0.5}, {"Sheet", 3.0, 1.0}};
  const Sized s = sized(surface, gridOf(32.0, 0.5, 0.5, 4.0), sizing);
  int within = 0;
  eachLeaf(s.octree, [&](Index leaf) {
    const LatticeBox box = boxOf(s.octree, leaf);
    const double size = sizeOf(s.octree, leaf);
    for (Index t = 0; t < s.model.triangles.size(); ++t)
    {
      const TriangleDistance distance(box, s.model.corner(t, 0), s.model.corner(t, 1), s.model.corner(t, 2));
      within += distance.anyWithin(3.0 / s.frame.latticeUnit()) ? 1 : 0;
      EXPECT_TRUE(size <= 0.5 || !distance.anyWithin(1.0 / s.frame.latticeUnit()));
      EXPECT_TRUE(size <= 1.0 || !distance.anyWithin(3.0 / s.frame.latticeUnit()));
    }
    const double center = std::sqrt(3.0) * size;
    bool near = false;
    for (Index t = 0; t < s.model.triangles.size(); ++t)
    {
      const TriangleDistance distance(box, s.model.corner(t, 0), s.model.corner(t, 1), s.model.corner(t, 2));
      near = near || distance.anyWithin((1.0 + 2.0 * center) / s.frame.latticeUnit());
    }
    EXPECT_TRUE(near || size > 0.5) << "no octant far away is this fine";
  });
  EXPECT_GT(within, 100);
}

TEST(Sizing, LevelsGrowByAsManyLayersAsAsked)
{
  for (int layers = 1; layers <= 5; ++layers)
  {
    SCOPED_TRACE(layers);
    SizingOptions sizing;
    sizing.boxes = {{{Vec3::Constant(-0.2), Vec3::Constant(0.2)}, 0.25}};
    sizing.cellsPerLevel = layers;
    const Sized s = sized({}, gridOf(60.0, 0.25, 0.5, 8.0), sizing);
    // Along each axis away from the box: so many octants at least of each size between finest and coarsest.
    for (int axis = 0; axis < 3; ++axis)
    {
      std::map<double, int> counts;
      Index last = noIndex;
      for (Vec3 p = Vec3::Constant(0.01); p[axis] < 29.0; p[axis] += 0.1)
      {
        const Index leaf = leafAt(s.octree, p);
        counts[sizeOf(s.octree, leaf)] += leaf != last ? 1 : 0;
        last = leaf;
      }
      ASSERT_GE(counts.size(), 4u);
      for (auto it = std::next(counts.begin()); std::next(it) != counts.end(); ++it)
      {
        EXPECT_GE(it->second, layers) << it->first;
        EXPECT_LE(it->second, layers + 2) << it->first;
      }
    }
  }
}

TEST(Sizing, CurvedSurfacesAreRefinedAndFlatOnesAreNot)
{
  TriangleSurface surface;
  addSphere(surface, "Sphere", Vec3(-4.0, 0.1, 0.2), 3.0, 5);
  addSheet(surface, "Flat", Vec3(4.0, -3.1, -3.2), Vec3(1.3, 6.0, 0.0), Vec3(0.0, 1.1, 6.0));
  SizingOptions sizing;
  sizing.curvatureAngle = 15.0;
  const GridOptions grid = gridOf(24.0, 0.125, 1.0, 2.0);
  const Sized s = sized(surface, grid, sizing);
  const Sized plain = sized(surface, grid, {});
  const Index flat = leafAt(plain.octree, Vec3(4.65, 0.45, -0.2));
  EXPECT_EQ(sizeOf(plain.octree, flat), 1.0);
  EXPECT_EQ(sizeOf(s.octree, leafAt(s.octree, Vec3(4.65, 0.45, -0.2))), 1.0);
  // A chord of 15 degrees is 0.78 long. Facets are 0.1 long, so octants of 0.25 hold less of the sphere.
  double finest = 1.0;
  eachLeaf(s.octree, [&](Index leaf) {
    std::vector<Vec3> normals;
    for (const ModelItem item : s.octree.items(leaf))
    {
      if (item.kind == ModelItem::triangle && s.model.surfaceIds[item.index] == 0)
      {
        normals.push_back(s.model.normal(item.index).normalized());
        EXPECT_GE(normals.back().dot(normals.front()), std::cos(15.0 * std::numbers::pi / 180.0) - 1e-9);
        finest = std::min(finest, sizeOf(s.octree, leaf));
      }
    }
  });
  EXPECT_EQ(finest, 0.25);
  sizing.curvatureAngle = 90.0;
  EXPECT_EQ(sized(surface, grid, sizing).octants.refined, plain.octants.refined);
}

TEST(Sizing, GapsBetweenWallsGetTheirCells)
{
  for (const double width : {0.55, 1.0, 1.7, 3.1, 6.0})
  {
    for (const int cells : {2, 4})
    {
      SCOPED_TRACE(::testing::Message() << width << " wide, " << cells << " cells");
      TriangleSurface surface;
      addSheet(surface, "Left", Vec3(-0.5 * width, -5.1, -5.2), Vec3(0, 10.3, 0), Vec3(0, 0, 10.1));
      addSheet(surface, "Right", Vec3(0.5 * width, -5.1, -5.2), Vec3(0, 10.3, 0), Vec3(0, 0, 10.1));
      SizingOptions sizing;
      sizing.cellsAcrossGap = cells;
      const Sized s = sized(surface, gridOf(32.0, 0.125, 2.0, 4.0), sizing);
      for (const double at : {-4.9, -2.3, 0.1, 1.7, 4.8})
      {
        EXPECT_GE(leavesAcross(s.octree, Vec3(0, at, 0.7 * at), 0, -0.5 * width, 0.5 * width), cells);
        // BoundaryEdges make their surroundings finer.
        EXPECT_TRUE(std::abs(at) > 1.0 ||
                    leavesAcross(s.octree, Vec3(0, at, 0.7 * at), 0, -0.5 * width, 0.5 * width) <= 2 * cells + 2);
      }
      // The other sides of the walls face nothing.
      EXPECT_GE(sizeOf(s.octree, leafAt(s.octree, Vec3(-12.0, 0.1, 0.1))), 2.0);
    }
  }
}

TEST(Sizing, GapsBetweenTurnedWallsGetTheirCellsToo)
{
  TriangleSurface surface;
  addSheet(surface, "Left", Vec3(-0.8, -5.1, -5.2), Vec3(0, 10.3, 0), Vec3(0, 0, 10.1));
  addSheet(surface, "Right", Vec3(0.8, -5.1, -5.2), Vec3(0, 10.3, 0), Vec3(0, 0, 10.1));
  turn(surface, 31.0);
  SizingOptions sizing;
  sizing.cellsAcrossGap = 4;
  const Sized s = sized(surface, gridOf(32.0, 0.125, 2.0, 4.0), sizing);
  eachLeaf(s.octree, [&](Index leaf) {
    const Vec3 c = s.octree.center(leaf);
    const double turned = 31.0 * std::numbers::pi / 180.0;
    const Vec3 p(std::cos(turned) * c[0] + std::sin(turned) * c[1], std::cos(turned) * c[1] - std::sin(turned) * c[0],
                 c[2]);
    if (std::abs(p[0]) < 0.8 && std::abs(p[1]) < 5.0 && std::abs(p[2]) < 4.8)
    {
      EXPECT_LE(sizeOf(s.octree, leaf), 0.4) << p.transpose();
    }
  });
}

TEST(Sizing, WallsThatMeetAtARightAngleAreNoGap)
{
  TriangleSurface surface;
  addSheet(surface, "Floor", Vec3(-5.1, -5.2, -5.3), Vec3(10, 0, 0), Vec3(0, 10, 0));
  addSheet(surface, "Wall", Vec3(-5.1, -5.2, -5.3), Vec3(0, 10, 0), Vec3(0, 0, 10));
  const GridOptions grid = gridOf(32.0, 0.25, 1.0, 4.0);
  SizingOptions sizing;
  sizing.cellsAcrossGap = 4;
  EXPECT_EQ(sized(surface, grid, sizing).octants.refined, sized(surface, grid, {}).octants.refined);
}

TEST(Sizing, GapsDoNotGetFinerThanFeatures)
{
  TriangleSurface surface;
  addSheet(surface, "Left", Vec3(-0.05, -5.1, -5.2), Vec3(0, 10.3, 0), Vec3(0, 0, 10.1));
  addSheet(surface, "Right", Vec3(0.05, -5.1, -5.2), Vec3(0, 10.3, 0), Vec3(0, 0, 10.1));
  SizingOptions sizing;
  sizing.cellsAcrossGap = 8;
  sizing.boxes = {{{Vec3::Constant(9.0), Vec3::Constant(9.5)}, 0.125}};
  const Sized s = sized(surface, gridOf(32.0, 0.5, 1.0, 4.0), sizing);
  eachLeaf(s.octree, [&](Index leaf) { EXPECT_TRUE(s.octree.center(leaf)[0] > 5.0 || sizeOf(s.octree, leaf) >= 0.5); });
}

TEST(Sizing, GivesTheSameForAnyNumberOfThreads)
{
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    const TriangleSurface soup = randomSoup(seed);
    const GridOptions grid = gridOf(8.0, 0.25, 0.5, 1.0);
    const Sized one = sized(soup, grid, everything(), 1);
    EXPECT_EQ(one.octants.refined, sized(soup, grid, everything(), 2).octants.refined);
    EXPECT_EQ(one.octants.refined, sized(soup, grid, everything(), 7).octants.refined);
  }
}

TEST(Sizing, AQuarterTurnChangesNoCount)
{
  TriangleSurface surface;
  addBox(surface, "S0", {Vec3(-3.0, -2.0, -1.0), Vec3(-1.5, 2.5, 1.75)});
  addBox(surface, "S1", {Vec3(0.5, -2.0, -1.0), Vec3(1.5, 2.5, 2.0)});
  addSphere(surface, "S2", Vec3(2.5, 0.0, -2.5), 0.9, 3);
  TriangleSurface turned = surface;
  for (Vec3& p : turned.points)
  {
    p = Vec3(-p[1], p[0], p[2]);
  }
  SizingOptions sizing = everything();
  SizingOptions sizingTurned = sizing;
  sizingTurned.boxes = {{{Vec3(-0.5, -1, -1), Vec3(1, 1, 1.5)}, 0.2}};
  // With 63 octants of SizeMin the root sticks out by half of one on all sides: the grid is symmetric.
  const GridOptions grid = gridOf(63 * 0.125, 0.125, 0.5, 1.0);
  const Sized s = sized(surface, grid, sizing);
  const Sized t = sized(turned, grid, sizingTurned);
  EXPECT_EQ(s.elements(), t.elements());
  ASSERT_EQ(s.octants.refined.size(), t.octants.refined.size());
  for (std::size_t l = 0; l < s.octants.refined.size(); ++l)
  {
    EXPECT_EQ(s.octants.refined[l].size(), t.octants.refined[l].size()) << "level " << l;
  }
}

} // namespace
