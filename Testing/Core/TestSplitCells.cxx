// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests cells cut into pyramids.
#include "Quality/Faces/Geometry.h"
#include "Quality/Unions/SplitCells.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UnionSamples.h"
#include "UpTo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::expectWellFormed;
using atria::testing::hexahedra;
using atria::testing::Loop;
using atria::testing::loopOf;
using atria::testing::meshOf;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::upTo;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::vector<Index> someCells(std::size_t count, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<Index> cells = upTo(count);
  std::ranges::shuffle(cells, random);
  cells.resize(count / 3);
  return cells;
}

/// Returns the number of edges of a cell.
std::size_t edgesOf(const FaceMesh& mesh, const CellFaces& faces, Index cell)
{
  std::set<std::pair<Index, Index>> edges;
  for (const Index f : faces.of(cell))
  {
    const Loop loop = loopOf(mesh, f);
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      edges.insert(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return edges.size();
}

TEST(SplitCells, AreOnePyramidPerFace)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    FaceMesh mesh = meshOf(mixedCells({3, 3, 3}, seed, 0.1));
    const FaceMesh before = mesh;
    const CellFaces facesBefore = makeCellFaces(before);
    const std::vector<Index> cells = someCells(mesh.cellCount, seed);
    const SplitCells split = splitIntoPyramids(mesh, cells);
    std::size_t triangles = 0;
    std::vector<Index> cellOf;
    for (const Index cell : cells)
    {
      triangles += edgesOf(before, facesBefore, cell);
      cellOf.insert(cellOf.end(), facesBefore.of(cell).size() - 1, cell);
    }
    EXPECT_EQ(split.cellOf, cellOf);
    EXPECT_EQ(mesh.cellCount, before.cellCount + cellOf.size());
    EXPECT_EQ(mesh.points.size(), before.points.size() + cells.size());
    EXPECT_EQ(mesh.faceCount(), before.faceCount() + triangles);
    EXPECT_EQ(mesh.internalFaceCount(), before.internalFaceCount() + triangles);
    expectWellFormed(mesh);
  }
}

TEST(SplitCells, KeepTheFacesThatWereThere)
{
  FaceMesh mesh = meshOf(mixedCells({3, 3, 3}, 5, 0.1));
  const FaceMesh before = mesh;
  const SplitCells split = splitIntoPyramids(mesh, someCells(mesh.cellCount, 5));
  const auto cellBefore = [&](Index cell) {
    return cell < before.cellCount ? cell : split.cellOf[cell - before.cellCount];
  };
  ASSERT_EQ(split.faceOf.size(), before.faceCount());
  EXPECT_EQ(std::set<Index>(split.faceOf.begin(), split.faceOf.end()).size(), before.faceCount());
  for (std::size_t f = 0; f < before.faceCount(); ++f)
  {
    const Index now = split.faceOf[f];
    Loop loop = loopOf(mesh, now);
    const bool isTurned = cellBefore(mesh.owner[now]) != before.owner[f];
    if (isTurned)
    {
      std::ranges::reverse(loop);
    }
    EXPECT_EQ(loop, loopOf(before, f));
    ASSERT_EQ(now < mesh.internalFaceCount(), f < before.internalFaceCount());
    if (f < before.internalFaceCount())
    {
      const std::pair<Index, Index> sides{cellBefore(mesh.owner[now]), cellBefore(mesh.neighbor[now])};
      EXPECT_EQ(isTurned ? sides.first : sides.second, before.neighbor[f]);
      EXPECT_EQ(isTurned ? sides.second : sides.first, before.owner[f]);
    }
  }
}

TEST(SplitCells, FillTheCellFromItsCentroid)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    SCOPED_TRACE(seed);
    FaceMesh mesh = meshOf(mixedCells({3, 3, 3}, seed, 0.1));
    const FaceMesh before = mesh;
    const MeshGeometry old = measureMesh(before, quietContext()).geometry;
    const std::vector<Index> cells = someCells(mesh.cellCount, seed);
    const SplitCells split = splitIntoPyramids(mesh, cells);
    const MeasuredMesh measured = measureMesh(mesh, quietContext());
    std::vector<double> volumes(measured.geometry.cellVolumes.begin(), measured.geometry.cellVolumes.end());
    for (std::size_t i = 0; i < split.cellOf.size(); ++i)
    {
      volumes[split.cellOf[i]] += volumes[before.cellCount + i];
    }
    for (Index cell = 0; cell < mesh.cellCount; ++cell)
    {
      EXPECT_GT(measured.geometry.cellVolumes[cell], 0.0);
      EXPECT_TRUE(cell >= before.cellCount || std::abs(volumes[cell] - old.cellVolumes[cell]) < 1e-10) << cell;
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      EXPECT_LT((mesh.points[before.points.size() + i] - old.cellCentroids[cells[i]]).norm(), 1e-10);
    }
  }
}

TEST(SplitCells, OfNoneChangeNothing)
{
  FaceMesh mesh = meshOf(mixedCells({2, 3, 2}, 1));
  const FaceMesh before = mesh;
  const SplitCells split = splitIntoPyramids(mesh, {});
  EXPECT_EQ(split.faceOf, upTo(before.faceCount()));
  EXPECT_THAT(split.cellOf, IsEmpty());
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.owner, before.owner);
  EXPECT_EQ(mesh.neighbor, before.neighbor);
  EXPECT_EQ(mesh.facePoints, before.facePoints);
  EXPECT_EQ(mesh.cellCount, before.cellCount);
}

TEST(SplitCells, OfACubeAreSixPyramids)
{
  FaceMesh mesh = meshOf(hexahedra({1, 1, 1}));
  const SplitCells split = splitIntoPyramids(mesh, Loop{0});
  EXPECT_THAT(split.cellOf, ElementsAre(0, 0, 0, 0, 0));
  EXPECT_EQ(mesh.internalFaceCount(), 12U);
  EXPECT_EQ(mesh.points.back(), Vec3(0.5, 0.5, 0.5));
  const MeasuredMesh measured = measureMesh(mesh, quietContext());
  for (const double volume : measured.geometry.cellVolumes)
  {
    EXPECT_NEAR(volume, 1.0 / 6.0, 1e-14);
  }
  for (Index cell = 0; cell < 6; ++cell)
  {
    std::vector<std::size_t> sizes;
    std::ranges::for_each(measured.cellFaces.of(cell), [&](Index f) { sizes.push_back(mesh.face(f).size()); });
    EXPECT_THAT(sizes, UnorderedElementsAre(3U, 3U, 3U, 3U, 4U));
  }
}

} // namespace
