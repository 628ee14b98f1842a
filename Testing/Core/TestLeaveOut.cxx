// SPDX-License-Identifier: GPL-3.0-or-later
/// What is left of a mesh without some of its elements is one.
#include "Mesher/Improvement/ElementsToLeaveOut.h"
#include "Mesher/Improvement/PartialMesh.h"
#include "Mesher/LeaveOut.h"
#include "Quality/Unions/JudgedUnions.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::Each;
using ::testing::Ne;

/// A turned sheet and a turned box in air, with a layer.
Meshed sample()
{
  TriangleSurface surface;
  addBox(surface, "Solid", {Vec3(-0.9, -0.7, -0.8), Vec3(0.6, 0.8, 0.9)});
  addSheet(surface, "Sheet", Vec3(0.6, -0.7, -0.8), Vec3(0.9, 0, 0), Vec3(0, 0, 1.2));
  turn(surface, 17.0);
  GridOptions grid;
  grid.domain = {Vec3::Constant(-2.0), Vec3::Constant(2.0)};
  grid.sizeMin = 0.2;
  grid.sizeMid = grid.sizeMax = 0.4;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::outside;
  options.layers = {{"*", {1}}};
  return meshIt(surface, grid, options);
}

/// Some of the elements at walls, in order.
std::vector<Index> someAtWalls(const DualMesh& mesh, unsigned seed)
{
  std::vector<Index> atWalls;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (wallOf(mesh, e) != noIndex)
    {
      atWalls.push_back(e);
    }
  }
  std::vector<Index> chosen;
  std::ranges::sample(atWalls, std::back_inserter(chosen), 1 + seed, std::mt19937(seed));
  return chosen;
}

ImprovedMesh improvedOf(const Meshed& meshed)
{
  ImprovedMesh improved;
  improved.mesh = meshed.mesh();
  improved.layers = meshed.result.layers;
  for (Index p = 0; p < improved.mesh.points.size(); p += 3)
  {
    improved.detached.push_back({p, improved.mesh.points[p]});
  }
  return improved;
}

/// These and what shares a face with one of them, in order.
std::vector<Index> withBeside(const DualMesh& mesh, std::vector<Index> elements)
{
  for (std::size_t i = elements.size(); i-- > 0;)
  {
    std::ranges::copy_if(mesh.neighbors[elements[i]], std::back_inserter(elements),
                         [](std::int32_t code) { return code >= 0; });
  }
  std::ranges::sort(elements);
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

TEST(LeaveOut, KeepsWhatIsLeftSound)
{
  const Meshed meshed = sample();
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE(seed);
    std::vector<Index> elements = someAtWalls(meshed.mesh(), seed);
    if (seed % 2 == 1)
    {
      elements = withBeside(meshed.mesh(), elements);
      EXPECT_THAT(wallsOf(meshed.mesh(), elements), Each(Ne(noIndex)));
    }
    const std::vector<double> before = volumes(meshed.mesh());
    ImprovedMesh improved = improvedOf(meshed);
    leaveOut(elements, improved);
    const DualMesh& mesh = improved.mesh;
    EXPECT_EQ(mesh.elementCount() + elements.size(), meshed.mesh().elementCount());
    EXPECT_TRUE(isConformal(mesh, 0));
    EXPECT_TRUE(elementsAreClosed(mesh));
    EXPECT_TRUE(boundaryIsWatertight(mesh));
    const double gone =
        std::transform_reduce(elements.begin(), elements.end(), 0.0, std::plus(), [&](Index e) { return before[e]; });
    EXPECT_NEAR(totalVolume(mesh) + gone, totalVolume(meshed.mesh()), 1e-9);
    EXPECT_EQ(improved.layers.counts.size(), mesh.boundaryFaces.size());
    EXPECT_EQ(improved.leftOut.size(), elements.size());
    for (const DetachedVertex& vertex : improved.detached)
    {
      EXPECT_EQ(mesh.points[vertex.point], vertex.wanted);
    }
    for (Index e = 0; e < improved.numbers.size(); ++e)
    {
      EXPECT_EQ(improved.numbers[e] == noIndex, std::ranges::binary_search(elements, e));
      if (improved.numbers[e] != noIndex)
      {
        EXPECT_EQ(mesh.levels[improved.numbers[e]], meshed.mesh().levels[e]);
      }
    }
  }
}

std::vector<Index> allOf(const DualMesh& mesh)
{
  std::vector<Index> all(mesh.elementCount());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

/// Elements in cells that checkMesh objects to, in order.
std::vector<Index> failingAsWritten(const DualMesh& mesh, const UnionOptions& options = {})
{
  const PartialMesh whole = makePartialMesh(mesh, allOf(mesh));
  const JudgedMesh written = uniteAndJudge([&] { return whole.mesh; }, whole.patchOf, options, quietContext());
  const std::vector<std::uint32_t> fails =
      failedErrorsOfCells(measureMesh(written.mesh, quietContext()), written.verdict);
  std::vector<Index> failing;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (fails[written.cellOf.empty() ? e : written.cellOf[e]] != 0)
    {
      failing.push_back(e);
    }
  }
  return failing;
}

TEST(LeaveOut, FindsNothingInAMeshThatPasses)
{
  const Meshed meshed = sample();
  EXPECT_TRUE(failingAsWritten(meshed.mesh()).empty());
  std::vector<Index> some;
  std::ranges::sample(allOf(meshed.mesh()), std::back_inserter(some), 50, std::mt19937(1));
  EXPECT_TRUE(findElementsToLeaveOut(meshed.mesh(), some, quietContext()).empty());
}

/// Holes at walls leave elements with too few neighbors, and concave ones.
TEST(LeaveOut, LeavesLessThatFails)
{
  const Meshed meshed = sample();
  std::size_t before = 0;
  std::size_t after = 0;
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    SCOPED_TRACE(seed);
    ImprovedMesh improved = improvedOf(meshed);
    leaveOut(someAtWalls(meshed.mesh(), 40 + seed), improved);
    const std::vector<Index> byThemselves = failingAsWritten(improved.mesh, {.mergeCells = false, .mergeFaces = true});
    const std::vector<Index> failing = failingAsWritten(improved.mesh);
    const std::vector<Index> found = findElementsToLeaveOut(improved.mesh, byThemselves, quietContext());
    EXPECT_THAT(wallsOf(improved.mesh, found), Each(Ne(noIndex)));
    leaveOut(found, improved);
    const std::size_t left = failingAsWritten(improved.mesh).size();
    EXPECT_LE(left, failing.size());
    EXPECT_TRUE(elementsAreClosed(improved.mesh));
    before += failing.size();
    after += left;
  }
  EXPECT_GT(before, 0);
  EXPECT_LT(after, before);
}

/// Turns over elements that are behind those at walls, by a point that none at a wall has.
std::vector<Index> turnOverBehindWalls(DualMesh& mesh, unsigned seed)
{
  std::vector<char> atWalls(mesh.points.size(), 0);
  const auto eachOf = [&](bool atWall, auto&& visit) {
    for (Index e = 0; e < mesh.elementCount(); ++e)
    {
      if ((wallOf(mesh, e) != noIndex) == atWall)
      {
        visit(e);
      }
    }
  };
  eachOf(true, [&](Index e) {
    for (const Index p : mesh.corners[e])
    {
      atWalls[p] = 1;
    }
  });
  std::vector<Index> behind;
  eachOf(false, [&](Index e) {
    if (std::ranges::any_of(mesh.corners[e], [&](Index p) { return atWalls[p] != 0; }) &&
        std::ranges::any_of(mesh.corners[e], [&](Index p) { return atWalls[p] == 0; }))
    {
      behind.push_back(e);
    }
  });
  const Index chosen = behind[(7919 * (seed + 1)) % behind.size()];
  const auto& corners = mesh.corners[chosen];
  const Index point = *std::ranges::find_if(corners, [&](Index p) { return atWalls[p] == 0; });
  Vec3 middle = Vec3::Zero();
  for (const Index p : corners)
  {
    middle += mesh.points[p] / static_cast<double>(corners.size());
  }
  mesh.points[point] += 1.8 * (middle - mesh.points[point]);
  return failingAsWritten(mesh, {.mergeCells = false, .mergeFaces = true});
}

TEST(LeaveOut, ReachesWhatFailsBehindWalls)
{
  std::size_t before = 0;
  std::size_t after = 0;
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    ImprovedMesh improved = improvedOf(sample());
    const std::vector<Index> byThemselves = turnOverBehindWalls(improved.mesh, seed);
    EXPECT_FALSE(byThemselves.empty());
    const std::size_t failing = failingAsWritten(improved.mesh).size();
    const std::vector<Index> found = findElementsToLeaveOut(improved.mesh, byThemselves, quietContext());
    EXPECT_THAT(wallsOf(improved.mesh, found), Each(Ne(noIndex)));
    leaveOut(found, improved);
    const std::size_t left = failingAsWritten(improved.mesh).size();
    EXPECT_LE(left, failing);
    EXPECT_TRUE(elementsAreClosed(improved.mesh));
    before += failing;
    after += left;
  }
  EXPECT_LT(after, before);
}

} // namespace
