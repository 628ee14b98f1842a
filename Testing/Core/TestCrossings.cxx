// SPDX-License-Identifier: GPL-3.0-or-later
/// Crossings of a grid whose points moved are the same, updated or found anew.
#include "Dual/Grid/Crossings.h"
#include "Octree/Sizing/Refinement.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using namespace atria;

bool same(const BoundaryFace& l, const BoundaryFace& r)
{
  return l.element == r.element && l.tag == r.tag && l.opposite == r.opposite && l.direction == r.direction &&
         l.side == r.side && l.onDomainSide == r.onDomainSide;
}

bool same(const CrossedEdge& l, const CrossedEdge& r)
{
  return l.point == r.point && l.other == r.other && l.direction == r.direction && l.begin == r.begin &&
         l.count == r.count && l.segment.start == r.segment.start && l.segment.end == r.segment.end &&
         l.segment.axis == r.segment.axis && l.segment.about == r.segment.about;
}

bool same(const SurfaceCrossing& l, const SurfaceCrossing& r)
{
  return l.triangle == r.triangle && l.orientation == r.orientation && l.parameter == r.parameter;
}

template <typename T> bool same(const std::vector<T>& l, const std::vector<T>& r)
{
  return std::equal(l.begin(), l.end(), r.begin(), r.end(), [](const T& a, const T& b) { return same(a, b); });
}

void expectSame(const Crossings& l, const Crossings& r)
{
  EXPECT_EQ(l.neighbors, r.neighbors);
  EXPECT_TRUE(same(l.boundaryFaces, r.boundaryFaces));
  EXPECT_TRUE(same(l.crossedEdges, r.crossedEdges));
  EXPECT_TRUE(same(l.cuts, r.cuts));
}

/// Moves some points by up to half an octant. Returns them, sorted.
std::vector<Index> moveSome(GridPlaces& grid, std::mt19937& random)
{
  std::vector<Index> moved;
  const std::int64_t half = grid.octree().frame().latticeSize(grid.octree().frame().depth) / 2;
  std::uniform_int_distribution<std::int64_t> shift(-half, half);
  for (Index point = 0; point < grid.points().size(); ++point)
  {
    if (random() % 20 == 0)
    {
      const LatticePoint undisplaced = grid.undisplaced(point);
      grid.move(point,
                {undisplaced[0] + shift(random), undisplaced[1] + shift(random), undisplaced[2] + shift(random)});
      moved.push_back(point);
    }
  }
  return moved;
}

TEST(Crossings, AreTheSameUpdatedAndFoundAnew)
{
  GridOptions options;
  options.domain = {Vec3::Constant(-4.3), Vec3::Constant(4.1)};
  options.sizeMin = 0.4;
  options.sizeMid = 0.4;
  options.sizeMax = 0.8;
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE(seed);
    const atria::testing::Meshed meshed = atria::testing::meshIt(atria::testing::randomSoup(seed), options);
    const RunContext context = atria::testing::quietContext();
    const GridPoints points = findGridPoints(meshed.octree, context);
    GridPlaces grid(meshed.octree, points);
    const Crossings undisplaced = findCrossings(grid, meshed.model, context);
    std::mt19937 random(seed);
    const std::vector<Index> moved = moveSome(grid, random);
    ASSERT_FALSE(moved.empty());
    const Crossings updated = updateCrossings(grid, meshed.model, undisplaced, moved, context);
    expectSame(updated, findCrossings(grid, meshed.model, context));
    std::ranges::for_each(moved, [&](Index point) { grid.undisplace(point); });
    expectSame(updateCrossings(grid, meshed.model, updated, moved, context), undisplaced);
  }
}

} // namespace
