// SPDX-License-Identifier: GPL-3.0-or-later
/// Real threads, whatever the machine has: the core's own executor starts as many as it is told.
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"

namespace {

using atria::Vec3;

TEST(DualThreads, TheMeshIsTheSameBitForBitWithOneTwoAndSevenThreads)
{
  atria::GridOptions grid;
  grid.domain = {Vec3::Constant(-4.3), Vec3::Constant(4.1)};
  grid.sizeMin = 0.1;
  grid.sizeMid = 0.2;
  grid.sizeMax = 0.4;
  atria::DualMeshOptions options;
  options.zoneRule = atria::ZoneRule::all;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    const atria::TriangleSurface surface = atria::testing::randomSoup(seed);
    const atria::testing::Meshed serial = atria::testing::meshIt(surface, grid, options, 1);
    EXPECT_GT(serial.mesh().elementCount(), 8192u); // more than one piece of a loop
    for (const int threads : {2, 7})
    {
      SCOPED_TRACE(threads);
      const atria::testing::Meshed other = atria::testing::meshIt(surface, grid, options, threads);
      EXPECT_TRUE(atria::testing::identical(serial.mesh(), other.mesh()));
      EXPECT_EQ(serial.result.diagnostics.size(), other.result.diagnostics.size());
    }
  }
}

} // namespace
