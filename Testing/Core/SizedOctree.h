// SPDX-License-Identifier: GPL-3.0-or-later
/// Octrees by sizing rules, for tests.
#pragma once

#include "Octree/Sizing/Estimate.h"
#include "Octree/Sizing/Refinement.h"
#include "Octree/Sizing/SizeRules.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

namespace atria::testing {

/// Model, frame and octree of one set of sizes.
struct Sized
{
  GridFrame frame;
  SurfaceModel model;
  SizedOctants octants;
  Octree octree;

  std::size_t elements() const { return countElements(octants.refined, false, frame, quietContext()); }
};

inline GridOptions gridOf(double length, double sizeMin, double sizeMid, double sizeMax)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-0.5 * length), Vec3::Constant(0.5 * length)};
  grid.sizeMin = sizeMin;
  grid.sizeMid = sizeMid;
  grid.sizeMax = sizeMax;
  grid.startLevel = 2;
  return grid;
}

inline Sized sized(const TriangleSurface& surface, GridOptions grid, const SizingOptions& sizing, int threads = 1)
{
  const ThreadExecutor executor(threads);
  const RunContext context = quietContext(executor);
  Box3 extent;
  for (const Vec3& p : surface.points)
  {
    extent.extend(p);
  }
  Sized out;
  grid.finestAsked = finestSizeOf(sizing);
  out.frame = makeGridFrame(grid, extent);
  out.model = makeSurfaceModel(surface, out.frame, {}, context);
  out.octants = sizeOctants(out.model, out.frame, sizing, context);
  out.octree = buildOctree(out.model, out.frame, out.octants, context);
  return out;
}

inline double sizeOf(const Octree& octree, Index leaf) { return octree.frame().sizeOf(octree.level(leaf)); }

template <typename Visit> void eachLeaf(const Octree& octree, Visit&& visit)
{
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    if (octree.inDomain(leaf))
    {
      visit(leaf);
    }
  }
}

inline TriangleSurface twoBoxes()
{
  TriangleSurface surface;
  addBox(surface, "Wall north", {Vec3(-9.3, -6.1, -3.2), Vec3(-4.1, 5.2, 2.9)});
  addBox(surface, "Detail", {Vec3(5.3, 1.1, 0.2), Vec3(7.7, 3.2, 1.9)});
  return surface;
}

/// All rules at once.
inline SizingOptions everything()
{
  SizingOptions sizing;
  sizing.surfaceSizes = {{"S*", 0.25, 0.125}};
  sizing.boxes = {{{Vec3(-1, -1, -1), Vec3(1, 0.5, 1.5)}, 0.2}};
  sizing.distanceSizes = {{"S0", 0.7, 0.3}};
  sizing.curvatureAngle = 15.0;
  sizing.cellsAcrossGap = 3;
  sizing.cellsPerLevel = 2;
  return sizing;
}

} // namespace atria::testing
