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
    EXPECT_TRUE(isSound(mesh, 0));
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
  EXPECT_TRUE(findElementsToLeaveOut(meshed.mesh(), some, true, quietContext()).empty());
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
    const std::vector<Index> found = findElementsToLeaveOut(improved.mesh, byThemselves, true, quietContext());
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

/// Whether an element has a face on a wall, or on sides of the domain alone.
bool isAt(bool side, const DualMesh& mesh, Index element)
{
  const Index wall = wallOf(mesh, element);
  return wall != noIndex && mesh.boundaryFaces[wall].onDomainSide == side;
}

/// By point, whether an element at a wall, or at a side alone, has it, or one so many rows about these.
std::vector<char> pointsNear(bool side, const DualMesh& mesh, int rows)
{
  std::vector<char> marked(mesh.points.size(), 0);
  const auto markIf = [&](auto&& isWanted) {
    std::vector<char> more = marked;
    for (Index e = 0; e < mesh.elementCount(); ++e)
    {
      if (isWanted(e))
      {
        std::ranges::for_each(mesh.corners[e], [&](Index p) { more[p] = 1; });
      }
    }
    marked = std::move(more);
  };
  markIf([&](Index e) { return isAt(side, mesh, e); });
  for (int row = 0; row < rows; ++row)
  {
    markIf([&](Index e) { return std::ranges::any_of(mesh.corners[e], [&](Index p) { return marked[p] != 0; }); });
  }
  return marked;
}

/// Turns over elements about a point that no element less than so many rows from a wall has, but one beside those, or
/// at a side. Returns those that fail.
std::vector<Index> turnOver(DualMesh& mesh, bool atSide, int rows, unsigned seed)
{
  const std::vector<char> atWalls = pointsNear(false, mesh, rows - 1);
  const std::vector<char> beside = pointsNear(atSide, mesh, atSide ? 0 : rows - 1);
  std::vector<char> onBoundary(mesh.points.size(), 0);
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    for (int i = 0; i < 4; ++i)
    {
      onBoundary[cornerOf(mesh, face, i)] = 1;
    }
  }
  std::vector<std::pair<Index, Index>> chosen; // elements, and points of them
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    const auto& corners = mesh.corners[e];
    const auto free = std::ranges::find_if(corners, [&](Index p) { return !atWalls[p] && !onBoundary[p]; });
    if (free != corners.end() && std::ranges::any_of(corners, [&](Index p) { return beside[p] != 0; }))
    {
      chosen.emplace_back(e, *free);
    }
  }
  const auto [element, point] = chosen[(7919 * (seed + 1)) % chosen.size()];
  Vec3 middle = Vec3::Zero();
  for (const Index p : mesh.corners[element])
  {
    middle += mesh.points[p] / 8.0;
  }
  mesh.points[point] += 1.8 * (middle - mesh.points[point]);
  return failingAsWritten(mesh, {.mergeCells = false, .mergeFaces = true});
}

/// Leaves elements out, and returns how many fail then.
std::size_t failingWithout(const std::vector<Index>& elements, ImprovedMesh improved)
{
  EXPECT_THAT(wallsOf(improved.mesh, elements), Each(Ne(noIndex)));
  const std::vector<double> before = volumes(improved.mesh);
  const double gone =
      std::transform_reduce(elements.begin(), elements.end(), 0.0, std::plus(), [&](Index e) { return before[e]; });
  const double whole = totalVolume(improved.mesh);
  leaveOut(elements, improved);
  EXPECT_TRUE(elementsAreClosed(improved.mesh));
  EXPECT_TRUE(boundaryIsWatertight(improved.mesh));
  EXPECT_NEAR(totalVolume(improved.mesh) + gone, whole, 1e-9);
  return failingAsWritten(improved.mesh).size();
}

/// How many elements fail where some are turned over in meshes, and without what is left out then: at walls, and at
/// sides of the domain, too.
struct FailingSums
{
  std::size_t before = 0;
  std::size_t atWalls = 0;
  std::size_t withSides = 0;
};

FailingSums failingWhereTurnedOver(bool atSide, int rows = 1)
{
  FailingSums sums;
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    ImprovedMesh improved = improvedOf(sample());
    const std::vector<Index> alone = turnOver(improved.mesh, atSide, rows, seed);
    EXPECT_FALSE(alone.empty());
    const std::size_t before = failingAsWritten(improved.mesh).size();
    const std::vector<Index> found = findElementsToLeaveOut(improved.mesh, alone, false, quietContext());
    for (const Index wall : wallsOf(improved.mesh, found))
    {
      EXPECT_FALSE(improved.mesh.boundaryFaces[wall].onDomainSide);
    }
    const std::size_t atWalls = failingWithout(found, improved);
    const std::size_t withSides =
        failingWithout(findElementsToLeaveOut(improved.mesh, alone, true, quietContext()), improved);
    EXPECT_LE(atWalls, before);
    EXPECT_LE(withSides, atWalls);
    sums.before += before;
    sums.atWalls += atWalls;
    sums.withSides += withSides;
  }
  return sums;
}

TEST(LeaveOut, ReachesWhatFailsBehindWalls)
{
  for (const int rows : {1, 2})
  {
    SCOPED_TRACE(rows);
    const FailingSums failing = failingWhereTurnedOver(false, rows);
    EXPECT_LT(failing.atWalls, failing.before);
  }
}

TEST(LeaveOut, TakesElementsAtSidesIfNothingElseHelps)
{
  const FailingSums failing = failingWhereTurnedOver(true);
  EXPECT_LT(failing.withSides, failing.before);
}

} // namespace
