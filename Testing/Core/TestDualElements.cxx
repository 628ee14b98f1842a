// SPDX-License-Identifier: GPL-3.0-or-later
/// Which elements arise where octants of two levels meet.
#include "Mesher/DualMesher.h"
#include "Octree/Tree/Octree.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace {

using namespace atria;
using atria::testing::ElementCounts;
using atria::testing::FaceCounts;

constexpr int coarseLevel = 4;
/// An octant of the coarse grid well inside the domain.
constexpr GridCell middle{7, 7, 7};

/// A domain 8 long, of octants of 1 (level 4 of the root) with room for finer ones of 0.5.
GridFrame frameOfEight()
{
  GridOptions options;
  options.domain = {Vec3::Zero(), Vec3::Constant(8.0)};
  options.sizeMin = 0.5;
  options.sizeMid = 1.0;
  options.sizeMax = 1.0;
  return makeGridFrame(options, {});
}

/// The whole root down to the coarse level, and these octants of it refined once more.
DualMesh meshWith(const GridFrame& frame, const std::vector<GridCell>& refinedCells)
{
  RefinedSets refined(coarseLevel + 1);
  for (int level = 0; level < coarseLevel; ++level)
  {
    refined[level].resize(std::size_t{1} << (3 * level));
    for (MortonKey key = 0; key < refined[level].size(); ++key)
    {
      refined[level][key] = key;
    }
  }
  for (const GridCell& cell : refinedCells)
  {
    refined[coarseLevel].push_back(mortonKey(cell));
  }
  std::sort(refined[coarseLevel].begin(), refined[coarseLevel].end());
  if (refined[coarseLevel].empty())
  {
    refined.pop_back();
  }
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  StageClock clock;
  return makeDualMesh(Octree(frame, refined), {}, options, clock, atria::testing::quietContext()).mesh;
}

std::vector<Index> elementsOfLevel(const DualMesh& mesh, int level)
{
  std::vector<Index> found;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (mesh.levels[e] == level)
    {
      found.push_back(e);
    }
  }
  return found;
}

void expectFull(const DualMesh& mesh)
{
  EXPECT_TRUE(atria::testing::isValid(mesh));
  EXPECT_NEAR(atria::testing::totalVolume(mesh), 8.0 * 8.0 * 8.0, 1e-9);
}

/// In lattice units, so that centers compare exactly.
using PointSet = std::set<LatticePoint>;

PointSet pointsOf(const DualMesh& mesh, const GridFrame& frame, Index element)
{
  PointSet points;
  for (const Index p : mesh.corners[element])
  {
    points.insert(frame.toLattice(mesh.points[p]));
  }
  return points;
}

/// The four octants about the coarse edge along `axis` that begins at the upper corner of `middle`, lower ones first.
std::array<GridCell, 4> octantsAboutEdge(int axis)
{
  std::array<GridCell, 4> cells;
  for (unsigned k = 0; k < 4; ++k)
  {
    cells[k] = middle;
    cells[k][(axis + 1) % 3] += k & 1;
    cells[k][(axis + 2) % 3] += k >> 1;
  }
  return cells;
}

/// The centers of the leaves about the middle of that edge: two of a refined octant, one of another.
PointSet centersAboutEdge(const GridFrame& frame, int axis, const std::array<bool, 4>& isRefined)
{
  const std::int64_t coarse = frame.latticeSize(coarseLevel);
  PointSet centers;
  const auto cells = octantsAboutEdge(axis);
  for (unsigned k = 0; k < 4; ++k)
  {
    LatticePoint center;
    for (int i = 0; i < 3; ++i)
    {
      center[i] = cells[k][i] * coarse + coarse / 2;
    }
    if (!isRefined[k])
    {
      centers.insert(center);
      continue;
    }
    center[(axis + 1) % 3] += k & 1 ? -coarse / 4 : coarse / 4;
    center[(axis + 2) % 3] += k >> 1 ? -coarse / 4 : coarse / 4;
    for (const std::int64_t along : {-coarse / 4, coarse / 4})
    {
      center[axis] = cells[k][axis] * coarse + coarse / 2 + along;
      centers.insert(center);
    }
  }
  return centers;
}

/// Refines some of the four octants about an edge, in each of the three directions, and looks at the element about its
/// middle.
void expectElementAtEdge(const std::array<bool, 4>& isRefined, std::size_t points, const FaceCounts& faces)
{
  const GridFrame frame = frameOfEight();
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    std::vector<GridCell> refined;
    for (int k = 0; k < 4; ++k)
    {
      if (isRefined[k])
      {
        refined.push_back(octantsAboutEdge(axis)[k]);
      }
    }
    const DualMesh mesh = meshWith(frame, refined);
    expectFull(mesh);
    const PointSet wanted = centersAboutEdge(frame, axis, isRefined);
    EXPECT_EQ(wanted.size(), points);
    int found = 0;
    for (const Index e : elementsOfLevel(mesh, coarseLevel + 1))
    {
      if (pointsOf(mesh, frame, e) == wanted)
      {
        ++found;
        EXPECT_EQ(atria::testing::faceCounts(mesh, e).quads, faces.quads);
        EXPECT_EQ(atria::testing::faceCounts(mesh, e).triangles, faces.triangles);
      }
    }
    EXPECT_EQ(found, 1);
  }
}

TEST(DualElements, AUniformGridIsHexahedraOnly)
{
  const DualMesh mesh = meshWith(frameOfEight(), {});
  expectFull(mesh);
  const ElementCounts counts = atria::testing::countElements(mesh, elementsOfLevel(mesh, coarseLevel));
  EXPECT_EQ(counts.hexahedra, mesh.elementCount());
}

TEST(DualElements, ARefinedOctantIsNineHexahedraSixPyramidsAndTwelvePolyhedra)
{
  const GridFrame frame = frameOfEight();
  const DualMesh uniform = meshWith(frame, {});
  const DualMesh mesh = meshWith(frame, {middle});
  expectFull(mesh);
  const ElementCounts fine = atria::testing::countElements(mesh, elementsOfLevel(mesh, coarseLevel + 1));
  EXPECT_EQ(fine.hexahedra, 9u);
  EXPECT_EQ(fine.pyramids, 6u);
  EXPECT_EQ(fine.polyhedra, 12u);
  EXPECT_EQ(fine.wedges, 0u);
  // Of the 27 the octant's 8 corners were there before; the others are as they were.
  EXPECT_EQ(mesh.elementCount(), uniform.elementCount() + 19);
  const ElementCounts coarse = atria::testing::countElements(mesh, elementsOfLevel(mesh, coarseLevel));
  EXPECT_EQ(coarse.hexahedra, uniform.elementCount() - 8);
}

TEST(DualElements, OneOfFourAboutAnEdgeIsAPolyhedronOfFivePoints)
{
  expectElementAtEdge({true, false, false, false}, 5, {2, 2});
}

TEST(DualElements, TwoAdjacentOfFourAboutAnEdgeAreAWedge)
{
  expectElementAtEdge({true, true, false, false}, 6, {3, 2});
  expectElementAtEdge({false, true, false, true}, 6, {3, 2});
}

TEST(DualElements, TwoOppositeOfFourAboutAnEdgeAreAPolyhedronOfSixPoints)
{
  expectElementAtEdge({true, false, false, true}, 6, {2, 4});
  expectElementAtEdge({false, true, true, false}, 6, {2, 4});
}

TEST(DualElements, ThreeOfFourAboutAnEdgeAreAPolyhedronOfSevenPoints)
{
  expectElementAtEdge({true, true, true, false}, 7, {4, 2});
}

TEST(DualElements, FourOfFourAboutAnEdgeAreAHexahedron) { expectElementAtEdge({true, true, true, true}, 8, {6, 0}); }

} // namespace
