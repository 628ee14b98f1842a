// SPDX-License-Identifier: GPL-3.0-or-later
/// How many elements a mesh will have, and rules that cannot be met.
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
  EXPECT_THAT(with([](auto& s) { s.surfaceSizes = {{"*", 1e-9, {}}}; }), HasSubstr("finer requested size"));
  EXPECT_THAT(with([](auto& s) { s.cellsPerLevel = 0; }), HasSubstr("cells of a level"));

  GridOptions fine = grid;
  fine.startLevel = 4; // more than the domain's sides need
  SizingOptions few;
  few.maxElements = 10;
  EXPECT_THAT(errorOf([&] { sized(twoBoxes(), fine, few); }), HasSubstr("lower StartLevel"));
}

} // namespace
