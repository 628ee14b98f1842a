// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that are improved block by block.
#include "Mesher/Improvement/ConcaveElements.h"
#include "Mesher/Improvement/ImproverStages.h"
#include "Optimize/Kernel/MeasuredCells.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <algorithm>

namespace {

using namespace atria;
using namespace atria::testing;

GridOptions gridOf(double sizeMin, double sizeMid)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-4.3), Vec3::Constant(4.1)};
  grid.sizeMin = sizeMin;
  grid.sizeMid = sizeMid;
  grid.sizeMax = 0.8;
  return grid;
}

DualMeshOptions optionsOf(int layers, double firstHeight = 0.0)
{
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.layers = {{"*", {.layers = layers, .firstHeight = firstHeight}}};
  return options;
}

std::size_t leftOut(const Meshed& meshed)
{
  return static_cast<std::size_t>(
      std::ranges::count(meshed.result.diagnostics, Diagnostic::leftOutElement, &Diagnostic::kind));
}

/// Elements that checkMesh objects to. Measured all anew: an improver measures those only that it has looked at.
std::size_t failing(const DualMesh& mesh, bool layered)
{
  const std::vector<char> everywhere(mesh.points.size(), 1);
  const MeshTraits traits{layered, false, false, false, false, false};
  const auto cells = findShortCells(DualSource(mesh), everywhere, targetsOfChecks(traits), quietContext());
  const auto bad = std::ranges::count_if(cells, [](const ShortCell& cell) { return cell.worst < 0.0F; });
  return static_cast<std::size_t>(bad) + (layered ? findConcaveAtWalls(mesh, quietContext()).size() : 0);
}

struct Case
{
  const char* name;
  int layers;
  double firstHeight;
};

class BlockImprover : public ::testing::TestWithParam<Case>
{
};

TEST_P(BlockImprover, BlocksMakeASoundMesh)
{
  std::size_t failingInBlocks = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const TriangleSurface surface = randomSoup(seed);
    DualMeshOptions options = optionsOf(GetParam().layers, GetParam().firstHeight);
    const Meshed whole = meshIt(surface, gridOf(0.2, 0.2), options);
    options.blockSize = 1000;
    const Meshed blocks = meshIt(surface, gridOf(0.2, 0.2), options);
    EXPECT_TRUE(isValid(blocks.mesh(), 0));
    EXPECT_TRUE(facesAreUnique(blocks.mesh()));
    const bool layered = GetParam().layers > 0;
    failingInBlocks += failing(blocks.mesh(), layered);
    EXPECT_LE(leftOut(blocks), leftOut(whole));
    EXPECT_NEAR(totalVolume(blocks.mesh()), totalVolume(whole.mesh()), 1e-3 * totalVolume(whole.mesh()));
  }
  EXPECT_EQ(failingInBlocks, 0U);
}

TEST_P(BlockImprover, ThreadsDoNotMatter)
{
  const TriangleSurface surface = randomSoup(7);
  DualMeshOptions options = optionsOf(GetParam().layers, GetParam().firstHeight);
  options.blockSize = 1500;
  const Meshed serial = meshIt(surface, gridOf(0.2, 0.2), options, 1);
  for (const int threads : {2, 7})
  {
    SCOPED_TRACE(threads);
    EXPECT_TRUE(identical(serial.mesh(), meshIt(surface, gridOf(0.2, 0.2), options, threads).mesh()));
  }
}

INSTANTIATE_TEST_SUITE_P(Layers, BlockImprover,
                         ::testing::Values(Case{"None", 0, 0.0}, Case{"One", 1, 0.0}, Case{"Five", 5, 0.0},
                                           Case{"OfAHeight", 2, 0.02}),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
