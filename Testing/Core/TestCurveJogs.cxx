// SPDX-License-Identifier: GPL-3.0-or-later
/// Chains of edges on curves do not go round faces.
#include "Optimise/CurveJogs.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double half = 3.0;
const Vec3 low(-1.3, -0.9, -1.1);
const Vec3 high(1.2, 1.0, 1.2);

Meshed meshOf(const TriangleSurface& surface, const std::vector<LayerRule>& layers)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-half), Vec3::Constant(half)};
  grid.sizeMin = grid.sizeMid = grid.sizeMax = 0.25;
  DualMeshOptions options;
  options.layers = layers;
  return meshIt(surface, grid, options);
}

/// Jogs, if all points were on one curve.
Index jogsOf(DualMesh mesh)
{
  SilentMonitor silent;
  const BoundaryGraph graph = findBoundaryGraph(mesh, {SerialExecutor(), ProgressRange(silent)});
  std::vector<Index> vertexOf(mesh.points.size());
  std::iota(vertexOf.begin(), vertexOf.end(), Index{0});
  VertexAnchors anchors;
  anchors.freedom.assign(vertexOf.size(), Freedom::curve);
  anchors.pieces.assign(vertexOf.size(), 0);
  anchors.offsets.resize(vertexOf.size() + 1);
  std::iota(anchors.offsets.begin(), anchors.offsets.end(), Index{0});
  return removeJogs(mesh, graph, vertexOf, anchors).faces;
}

/// An upright box in air on all sides, turned by 4, 11, 18 degrees and so on.
TEST(CurveJogs, AreRemovedAndNothingIsLost)
{
  const double volume = 8.0 * half * half * half - (high - low).prod();
  Index before = 0;
  for (int i = 0; i < 6; ++i)
  {
    SCOPED_TRACE(i);
    TriangleSurface box;
    addBox(box, "Box", {low, high});
    turn(box, 4.0 + 7.0 * i);
    const Meshed plain = meshOf(box, {});
    before += jogsOf(plain.mesh());
    const Meshed straightened = meshOf(box, {{"*", {0}}});
    EXPECT_EQ(jogsOf(straightened.mesh()), 0u);
    EXPECT_EQ(straightened.mesh().elementCount(), plain.mesh().elementCount());
    EXPECT_TRUE(isConformal(straightened.mesh()));
    EXPECT_TRUE(boundaryIsWatertight(straightened.mesh()));
    const Meshed layered = meshOf(box, {{"*", {1}}});
    EXPECT_TRUE(boundaryIsWatertight(layered.mesh()));
    EXPECT_NEAR(totalVolume(layered.mesh()), volume, 1e-6 * volume);
    EXPECT_TRUE(layered.result.diagnostics.empty());
  }
  EXPECT_GT(before, 10u) << "there was nothing to remove";
}

} // namespace
