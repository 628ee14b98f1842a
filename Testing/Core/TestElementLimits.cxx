// SPDX-License-Identifier: GPL-3.0-or-later
/// How many elements a mesh will have, limits on them, and rules that cannot be met.
#include "SizedOctree.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"

#include <gmock/gmock.h>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Estimate, CountsExactlyWhatAMeshOfAllZonesHas)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    const Sized s =
        sized(randomSoup(seed), gridOf(8.0 + 0.37 * seed, 0.25, 0.5, 1.0), seed % 2 ? everything() : SizingOptions{});
    const RunContext context = quietContext();
    StageClock clock;
    DualMeshOptions options;
    options.zoneRule = ZoneRule::all;
    const DualMeshResult result = makeDualMesh(s.octree, s.model, options, clock, context);
    EXPECT_EQ(s.elements(), result.mesh.elementCount());
    const MeshEstimate estimate =
        estimateElements(s.model, s.frame, seed % 2 ? everything() : SizingOptions{}, context);
    EXPECT_EQ(estimate.elements, result.mesh.elementCount());
    std::vector<std::size_t> octants(estimate.octants.size(), 0);
    eachLeaf(s.octree, [&](Index leaf) { ++octants[s.octree.level(leaf)]; });
    EXPECT_EQ(estimate.octants, octants);
  }
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

TEST(MaxElements, FeaturesAreTheLastToGo)
{
  TriangleSurface surface;
  addBox(surface, "Building", {Vec3(-3.1, -2.2, -4.1), Vec3(2.9, 3.3, 1.2)});
  const GridOptions grid = gridOf(16.0, 0.25, 1.0, 2.0);
  const std::size_t plain = sized(surface, grid, {}).elements();
  SizingOptions sizing;
  sizing.surfaceSizes = {{"Building", 0.25, 0.25}};
  sizing.maxElements = plain + plain / 2;
  const Sized s = sized(surface, grid, sizing);
  EXPECT_THAT(s.octants.warning, HasSubstr("for feature curves"));
  int curves = 0;
  eachLeaf(s.octree, [&](Index leaf) {
    const bool feature = s.octree.featureType(leaf) == FeatureType::curve;
    curves += feature ? 1 : 0;
    EXPECT_TRUE(!feature || sizeOf(s.octree, leaf) == 0.25);
  });
  EXPECT_GT(curves, 100);
}

template <typename Call> std::string errorOf(Call&& call)
{
  try
  {
    call();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return {};
}

TEST(SizingErrors, SayWhatIsWrong)
{
  const GridOptions grid = gridOf(24.0, 0.5, 1.0, 4.0);
  const auto with = [&](auto&& change) {
    return errorOf([&] {
      SizingOptions sizing;
      change(sizing);
      sized(twoBoxes(), grid, sizing);
    });
  };
  EXPECT_THAT(with([](auto& s) {
                s.surfaceSizes = {{"Roof*", 1.0, {}}};
              }),
              AllOf(HasSubstr("'Roof*'"), HasSubstr("Wall north, Detail")));
  EXPECT_THAT(with([](auto& s) { s.distanceSizes = {{"Roof", 1.0, 1.0}}; }), HasSubstr("'Roof'"));
  EXPECT_THAT(with([](auto& s) { s.surfaceSizes = {{"*", 0.0, {}}}; }), HasSubstr("not positive"));
  EXPECT_THAT(with([](auto& s) { s.distanceSizes = {{"*", -1.0, 1.0}}; }), HasSubstr("distance"));
  EXPECT_THAT(with([](auto& s) { s.boxes = {{{Vec3::Constant(1.0), Vec3(2, 0, 2)}, 1.0}}; }), HasSubstr("min < max"));
  EXPECT_THAT(with([](auto& s) {
                s.boxes = {{{Vec3::Constant(50.0), Vec3::Constant(60.0)}, 1.0}};
              }),
              HasSubstr("outside of the domain"));
  EXPECT_THAT(with([](auto& s) { s.maxElements = 10; }),
              AllOf(HasSubstr("MaxElements 10"), HasSubstr("shortest side"), HasSubstr("24 wide")));
  EXPECT_THAT(with([](auto& s) { s.surfaceSizes = {{"*", 1e-9, {}}}; }), HasSubstr("finer size"));
  EXPECT_THAT(with([](auto& s) { s.cellsPerLevel = 0; }), HasSubstr("cells of a level"));

  GridOptions fine = grid;
  fine.startLevel = 4; // more than the domain's sides need
  SizingOptions few;
  few.maxElements = 10;
  EXPECT_THAT(errorOf([&] { sized(twoBoxes(), fine, few); }), HasSubstr("lower StartLevel"));
}

} // namespace
