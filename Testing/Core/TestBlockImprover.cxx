// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that are improved block by block.
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
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

/// What holds of every mesh; elements that could not be made valid are told.
void expectSound(const Meshed& meshed)
{
  const DualMesh& mesh = meshed.mesh();
  EXPECT_TRUE(isConformal(mesh, 0));
  EXPECT_TRUE(facesAreUnique(mesh));
  EXPECT_TRUE(elementsAreClosed(mesh));
  EXPECT_TRUE(boundaryIsWatertight(mesh));
  const std::vector<double> sizes = volumes(mesh);
  EXPECT_GT(std::ranges::min(sizes), 0.0);
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
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const TriangleSurface surface = randomSoup(seed);
    DualMeshOptions options = optionsOf(GetParam().layers, GetParam().firstHeight);
    const Meshed whole = meshIt(surface, gridOf(0.2, 0.2), options);
    options.blockSize = 2000;
    const Meshed blocks = meshIt(surface, gridOf(0.2, 0.2), options);
    expectSound(blocks);
    EXPECT_LE(leftOut(blocks), leftOut(whole) + blocks.mesh().elementCount() / 500);
    EXPECT_NEAR(totalVolume(blocks.mesh()), totalVolume(whole.mesh()), 1e-3 * totalVolume(whole.mesh()));
  }
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
                         ::testing::Values(Case{"None", 0, 0.0}, Case{"One", 1, 0.0}, Case{"Three", 3, 0.0},
                                           Case{"OfAHeight", 2, 0.02}),
                         [](const auto& one) { return std::string(one.param.name); });

} // namespace
