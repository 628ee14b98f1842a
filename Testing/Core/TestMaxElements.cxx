// SPDX-License-Identifier: GPL-3.0-or-later
/// A limit on elements is a budget: sizes in the open are given up first, those at features last.
#include "Mesher/ModelOptions.h"
#include "SizedOctree.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>
#include <regex>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The tower of a report, in the open.
TriangleSurface tower()
{
  TriangleSurface surface;
  addBox(surface, "Tower", {Vec3(-10.1, -10.2, -60.0), Vec3(9.9, 9.8, 40.3)});
  return surface;
}

/// Some boxes of house size, and a sheet that stands by each.
TriangleSurface houses(unsigned seed)
{
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  TriangleSurface surface;
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 at(-40.0 + 30.0 * i, between(-20.0, 20.0), -60.0);
    const Vec3 size(between(6.0, 18.0), between(6.0, 18.0), between(4.0, 25.0));
    addBox(surface, "House" + std::to_string(i), {at, at + size});
    addSheet(surface, "Screen" + std::to_string(i), at + Vec3(between(-9.0, -3.0), 0.3, 0.0),
             Vec3(0.0, between(3.0, 8.0), 0.0), Vec3(0.4, 0.0, between(2.0, 5.0)));
  }
  return surface;
}

struct Scene
{
  TriangleSurface surface;
  GridOptions grid;
  SizingOptions sizing;
};

std::vector<Scene> scenes()
{
  std::vector<Scene> out{{tower(), gridOf(256.0, 1.0, 2.0, 8.0), {}}};
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    out.push_back({houses(seed), gridOf(160.0, 0.5, 1.0, 4.0), {}});
  }
  Scene grown = out.back();
  grown.sizing.cellsPerLevel = 3;
  grown.sizing.boxes = {{{Vec3(-20, -20, -60), Vec3(30, 10, -40)}, 2.0}};
  grown.sizing.distanceSizes = {{"House1", 8.0, 1.0}};
  out.push_back(grown);
  for (unsigned seed = 0; seed < 2; ++seed)
  {
    out.push_back({randomSoup(seed), gridOf(8.0, 0.25, 0.5, 1.0), everything()});
  }
  return out;
}

Sized limited(const Scene& scene, std::size_t most, int threads = 1)
{
  SizingOptions sizing = scene.sizing;
  sizing.maxElements = most;
  return sized(scene.surface, scene.grid, sizing, threads);
}

/// Whether each octant that `some` refines is refined in `others`.
bool isWithin(const RefinedSets& some, const RefinedSets& others)
{
  bool within = some.size() <= others.size();
  for (std::size_t l = 0; within && l < some.size(); ++l)
  {
    within = std::ranges::includes(others[l], some[l]);
  }
  return within;
}

TEST(MaxElements, IsKeptToAndSaid)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    const TriangleSurface soup = randomSoup(seed);
    const GridOptions grid = gridOf(8.0, 0.25, 0.5, 1.0);
    const std::size_t unlimited = sized(soup, grid, everything()).elements();
    std::size_t before = 0;
    for (const double part : {0.02, 0.1, 0.3, 0.7, 0.99, 1.0, 1.5})
    {
      SizingOptions sizing = everything();
      sizing.maxElements = static_cast<std::size_t>(part * static_cast<double>(unlimited));
      const Sized s = sized(soup, grid, sizing);
      EXPECT_LE(s.elements(), sizing.maxElements);
      EXPECT_GE(s.elements(), before) << "a higher limit gives no less";
      EXPECT_EQ(s.elements() < unlimited, !s.octants.warning.empty());
      EXPECT_TRUE(s.octants.warning.empty() ||
                  s.octants.warning.find("MaxElements " + std::to_string(sizing.maxElements)) != std::string::npos);
      before = s.elements();
    }
    EXPECT_EQ(before, unlimited);
  }
}

TEST(MaxElements, AHigherLimitGivesNoCoarserOctantAnywhere)
{
  for (const Scene& scene : scenes())
  {
    const Sized free = limited(scene, 0);
    const auto all = static_cast<double>(free.elements());
    RefinedSets before;
    for (double part = 0.02; part < 1.05; part *= 1.25)
    {
      SCOPED_TRACE(part);
      const auto most = static_cast<std::size_t>(part * all);
      const Sized s = limited(scene, most);
      EXPECT_LE(s.elements(), most);
      EXPECT_TRUE(isWithin(before, s.octants.refined));
      EXPECT_TRUE(isWithin(s.octants.refined, free.octants.refined));
      before = s.octants.refined;
    }
  }
}

TEST(MaxElements, SurfacesKeepTheirSizesAsLongAsTheOpenCanGive)
{
  int scenesWithOpen = 0;
  for (Scene scene : scenes())
  {
    const Sized free = limited(scene, 0);
    Scene coarse = scene;
    coarse.grid.sizeMax = 1e6;
    const std::size_t least = limited(coarse, 0).elements();
    if (least == free.elements())
    {
      continue; // surfaces are everywhere
    }
    ++scenesWithOpen;
    for (std::size_t most = least; most < free.elements(); most += 1 + (free.elements() - least) / 4)
    {
      SCOPED_TRACE(most);
      const Sized s = limited(scene, most);
      EXPECT_THAT(s.octants.warning, HasSubstr("SizeMax"));
      EXPECT_THAT(s.octants.warning,
                  HasSubstr("surfaces, feature curves, corners and close surfaces have the sizes requested"));
      EXPECT_THAT(s.octants.warning, Not(HasSubstr("no finer")));
      eachLeaf(s.octree, [&](Index leaf) {
        const Index same =
            s.octree.items(leaf).empty() ? noIndex : free.octree.leafAt(s.frame.toLattice(s.octree.center(leaf)));
        EXPECT_TRUE(same == noIndex || free.octree.level(same) == s.octree.level(leaf));
      });
    }
  }
  EXPECT_GE(scenesWithOpen, 5);
}

/// Feature curves and corners, where no other rule asks for finer octants.
double coarsestAtFeatures(const Sized& s)
{
  double coarsest = 0.0;
  eachLeaf(s.octree, [&](Index leaf) {
    const FeatureType type = s.octree.featureType(leaf);
    const bool isFeature = type == FeatureType::curve || type == FeatureType::corner;
    coarsest = isFeature ? std::max(coarsest, sizeOf(s.octree, leaf)) : coarsest;
  });
  return coarsest;
}

TEST(MaxElements, FeaturesAreTheLastToGo)
{
  for (Scene scene : scenes())
  {
    if (!scene.sizing.surfaceSizes.empty())
    {
      continue; // features of several sizes
    }
    scene.grid.sizeMid = scene.grid.sizeMin;
    const std::size_t all = limited(scene, 0).elements();
    int surfacesOnly = 0;
    for (double part = 0.5; part > 0.02; part *= 0.8)
    {
      SCOPED_TRACE(part);
      const Sized s = limited(scene, static_cast<std::size_t>(part * static_cast<double>(all)));
      const bool surfacesAreCoarser = s.octants.warning.find("SizeMid") != std::string::npos ||
                                      s.octants.warning.find("surfaces away") != std::string::npos;
      const bool featuresAreCoarser = s.octants.warning.find("(SizeMin)") != std::string::npos;
      EXPECT_EQ(coarsestAtFeatures(s) > scene.grid.sizeMin, featuresAreCoarser) << s.octants.warning;
      EXPECT_TRUE(surfacesAreCoarser || !featuresAreCoarser) << s.octants.warning;
      surfacesOnly += surfacesAreCoarser && !featuresAreCoarser ? 1 : 0;
    }
    EXPECT_GT(surfacesOnly, 0);
  }
}

TEST(MaxElements, SizesOfTheWarningGiveTheSameMesh)
{
  for (const Scene& scene : scenes())
  {
    const auto all = static_cast<double>(limited(scene, 0).elements());
    for (double part = 0.1; part < 1.0; part += 0.2)
    {
      const Sized s = limited(scene, static_cast<std::size_t>(part * all));
      const std::regex form("SizeMax ([0-9.e+-]+) instead of [^;,]*(, CellsPerLevel ([0-9]+) instead of [0-9]+)?;.*");
      std::smatch found;
      const std::string text = s.octants.warning.substr(s.octants.warning.find("taken: ") + 7);
      if (!std::regex_match(text, found, form))
      {
        continue;
      }
      SCOPED_TRACE(text);
      Scene named = scene;
      named.grid.sizeMax = std::stod(found[1]);
      named.sizing.cellsPerLevel = found[3].matched ? std::stoi(found[3]) : scene.sizing.cellsPerLevel;
      EXPECT_EQ(limited(named, 0).octants.refined, s.octants.refined);
    }
  }
}

TEST(MaxElements, ABoxKeepsItsSizeAtSurfacesWhereItLosesItElsewhere)
{
  Scene scene{twoBoxes(), gridOf(24.0, 0.25, 1.0, 2.0), {}};
  Scene without = scene;
  scene.sizing.boxes = {{{Vec3(3, -2, -3), Vec3(11, 6, 6)}, 0.25}};
  const std::size_t plain = limited(without, 0).elements();
  const Sized s = limited(scene, 4 * plain);
  EXPECT_THAT(s.octants.warning, AllOf(HasSubstr("RefinementBoxes no finer than"), HasSubstr("away from surfaces")));
  int finest = 0;
  eachLeaf(s.octree, [&](Index leaf) {
    const Vec3 at = s.octree.center(leaf);
    const bool atDetail = !s.octree.items(leaf).empty() && at[0] > 4.0 && at[1] > 0.0;
    EXPECT_TRUE(!atDetail || sizeOf(s.octree, leaf) == 0.25) << at.transpose();
    finest += atDetail ? 1 : 0;
  });
  EXPECT_GT(finest, 100);
}

TEST(MaxElements, SidesOfAPrismKeepTheirFaces)
{
  ModelOptions options;
  options.site.mode = DomainMode::automatic;
  options.site.domainSides = 48;
  options.sizes.sizeMin = 1.0;
  options.sizes.sizeMid = 2.0;
  options.sizes.sizeMax = 2.0;
  options.sizes.startLevel = 2;
  TriangleSurface surface;
  addBox(surface, "Hut", {Vec3(0, 0, 0), Vec3(5, 4, 3.5)});
  const PlacedModel placed = placeModel(surface, options);
  const RunContext context = quietContext();
  const SurfaceModel model = makeSurfaceModel(placed, options, context);
  const double narrowest = narrowestSide(*placed.frame.turnedDomain);
  ASSERT_GT(narrowest, 4.0 * std::numbers::sqrt2);
  ASSERT_LT(narrowest, 8.0 * std::numbers::sqrt2) << "the next size would be too large";
  options.sizing.maxElements = 0;
  const SizedOctants free = sizeOctants(model, placed.frame, options, context);
  const std::size_t all = countElements(free.refined, false, placed.frame, context);
  for (const std::size_t most : {all - 1, all * 3 / 4, all / 2})
  {
    SCOPED_TRACE(most);
    options.sizing.maxElements = most;
    const SizedOctants octants = sizeOctants(model, placed.frame, options, context);
    const Octree octree(placed.frame, octants.refined);
    double coarsest = 0.0;
    eachLeaf(octree, [&](Index leaf) { coarsest = std::max(coarsest, sizeOf(octree, leaf)); });
    EXPECT_EQ(coarsest, 4.0) << "as coarse as the sides allow";
  }
}

TEST(MaxElements, GivesTheSameForAnyNumberOfThreads)
{
  for (const Scene& scene : scenes())
  {
    const std::size_t all = limited(scene, 0).elements();
    for (const std::size_t most : {all / 20, all / 3, all - 1})
    {
      const Sized one = limited(scene, most);
      const Sized many = limited(scene, most, 7);
      EXPECT_EQ(one.octants.refined, many.octants.refined);
      EXPECT_EQ(one.octants.warning, many.octants.warning);
    }
  }
}

} // namespace
