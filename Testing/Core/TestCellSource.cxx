// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sources of cells: dual meshes, meshes of faces, and their pieces.
#include "KernelSamples.h"
#include "Optimize/Kernel/CellSource.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/Pieces.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace {

using namespace atria;
using atria::testing::boxesOf;
using atria::testing::cornersOf;
using atria::testing::cubes;
using atria::testing::facesOf;
using atria::testing::Loop;
using atria::testing::mixedCells;
using atria::testing::neighborsOf;
using atria::testing::quietContext;
using atria::testing::Sample;
using atria::testing::SampleMesh;
using atria::testing::SeenFace;
using atria::testing::upTo;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::multiset<SeenFace> sortedFacesOf(const CellSource& source, Index cell)
{
  std::multiset<SeenFace> out;
  for (SeenFace face : facesOf(source, cell))
  {
    std::ranges::rotate(face.first, std::ranges::min_element(face.first));
    out.insert(face);
  }
  return out;
}

/// The same mesh, given by its faces.
SampleMesh sampleOf(const DualMesh& mesh)
{
  SampleMesh sample;
  sample.points = mesh.points;
  for (const std::array<Index, 8>& corners : mesh.corners)
  {
    sample.addCell(hexahedronCell, {corners.begin(), corners.end()});
  }
  return sample;
}

TEST(CellSource, GivesTheSameCellsOfBothKindsOfMeshes)
{
  const DualMesh mesh = boxesOf({{{1, 2, 1}, {3, 1}, {1, 1, 4}}});
  const DualSource dual(mesh);
  const Sample faces(sampleOf(mesh));
  ASSERT_EQ(dual.cellCount(), faces.source.cellCount());
  std::mt19937 random(3);
  std::vector<char> marked(mesh.points.size());
  std::ranges::generate(marked, [&] { return static_cast<char>(random() % 9 == 0 ? 1 : 0); });
  for (Index cell = 0; cell < dual.cellCount(); ++cell)
  {
    EXPECT_EQ(sortedFacesOf(dual, cell), sortedFacesOf(faces.source, cell)) << cell;
    EXPECT_EQ(dual.nativeOf(cell).type, hexahedronCell);
    EXPECT_EQ(dual.nativeOf(cell).corners, faces.source.nativeOf(cell).corners);
    EXPECT_EQ(dual.hasMarked(cell, marked), faces.source.hasMarked(cell, marked));
    const bool expected = std::ranges::any_of(mesh.corners[cell], [&](Index p) { return marked[p] != 0; });
    EXPECT_EQ(dual.hasMarked(cell, marked), expected) << cell;
  }
}

TEST(CellSource, ListsNeighborsInTheOrderOfFaces)
{
  const DualMesh mesh = cubes({3, 2, 3});
  const DualSource dual(mesh);
  const Sample mixed(mixedCells({3, 3, 3}, 2));
  for (const CellSource* source :
       {static_cast<const CellSource*>(&dual), static_cast<const CellSource*>(&mixed.source)})
  {
    for (Index cell = 0; cell < source->cellCount(); ++cell)
    {
      Loop across;
      std::set<Index> corners;
      for (const auto& [loop, other] : facesOf(*source, cell))
      {
        across.insert(across.end(), other != noIndex ? 1 : 0, other);
        corners.insert(loop.begin(), loop.end());
      }
      EXPECT_EQ(neighborsOf(*source, cell), across) << cell;
      const Loop listed = cornersOf(*source, cell);
      EXPECT_EQ(std::set<Index>(listed.begin(), listed.end()), corners) << cell;
    }
  }
}

TEST(CellSource, KnowsBoxesUpToRounding)
{
  const DualMesh whole = boxesOf({{{1, 2, 1}, {3, 1}, {1, 5}}});
  CellBox box;
  ASSERT_TRUE(DualSource(whole).boxOf(1, box));
  EXPECT_EQ(box.lengths, Vec3(2, 3, 1));
  EXPECT_THAT(box.across, ElementsAre(0, 2, noIndex, 4, noIndex, 7));
  for (const double offset : {0.99e-7, 1.01e-7, -1.01e-7, -1.5})
  {
    for (std::size_t corner = 1; corner < 8; ++corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        DualMesh mesh = whole;
        mesh.points[mesh.corners[1][hexahedronCorner[corner]]][axis] += offset;
        EXPECT_EQ(DualSource(mesh).boxOf(1, box), offset == 0.99e-7) << corner << ' ' << axis;
      }
    }
  }
  DualMesh noFace = whole;
  noFace.neighbors[1][zMin] = DualMesh::noFace;
  EXPECT_FALSE(DualSource(noFace).boxOf(1, box));
}

TEST(CellSource, HasNoHexahedronWithCoincidingCorners)
{
  DualMesh mesh = cubes({2, 1, 1});
  mesh.corners[0][6] = mesh.corners[0][7];
  mesh.neighbors[0][yMax] = ~0;
  EXPECT_EQ(DualSource(mesh).nativeOf(0).type, 0);
  EXPECT_EQ(DualSource(mesh).nativeOf(1).type, hexahedronCell);
}

TEST(CellSource, FindsMarkedCellsAndTheirNeighbors)
{
  const Sample mixed(mixedCells({4, 3, 3}, 3));
  const CellSource& source = mixed.source;
  std::mt19937 random(7);
  for (const int threads : {1, 3})
  {
    const ThreadExecutor executor(threads);
    std::vector<char> marked(source.points().size());
    std::ranges::generate(marked, [&] { return static_cast<char>(random() % 20 == 0 ? 1 : 0); });
    Loop points;
    Loop cells;
    std::set<Index> around;
    for (Index p = 0; p < marked.size(); ++p)
    {
      points.insert(points.end(), marked[p] != 0 ? 1 : 0, p);
    }
    for (Index cell = 0; cell < source.cellCount(); ++cell)
    {
      if (std::ranges::any_of(cornersOf(source, cell), [&](Index p) { return marked[p] != 0; }))
      {
        cells.push_back(cell);
        around.insert(cell);
        std::ranges::for_each(neighborsOf(source, cell), [&](Index other) { around.insert(other); });
      }
    }
    EXPECT_EQ(numbersOf(marked, executor), points);
    EXPECT_EQ(cellsWithMarked(source, marked, quietContext(executor)), cells);
    EXPECT_EQ(withNeighbors(source, cells, quietContext(executor)), Loop(around.begin(), around.end()));
  }
}

/// Cells of which each has one neighbor, half of all cells away.
class PairedCells : public CellSource
{
public:
  explicit PairedCells(Index halfOfCells) : half(halfOfCells) {}
  std::size_t cellCount() const override { return 2 * std::size_t{half}; }
  const std::vector<Vec3>& points() const override { return none; }
  void neighborsOf(Index cell, Loop& out) const override { out = {cell < half ? cell + half : cell - half}; }
  void cornersOf(Index, Loop& out) const override { out.clear(); }
  using CellSource::facesOf;
  void facesOf(Index, std::span<const Index>, Scratch&) const override {}
  bool hasMarked(Index, const std::vector<char>&) const override { return false; }

private:
  Index half;
  std::vector<Vec3> none;
};

TEST(CellSource, DividesCellsIntoPiecesWithTheirFarNeighbors)
{
  const PairedCells source(9000);
  Loop cells = upTo(source.cellCount());
  std::erase(cells, Index{9100});
  const std::vector<Loop> pieces = inPieces(source, cells);
  Loop all;
  std::map<Index, std::size_t> pieceOf;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    EXPECT_TRUE(i + 1 == pieces.size() || pieces[i].size() >= Pieces::length);
    EXPECT_LE(pieces[i].size(), Pieces::length + 1);
    all.insert(all.end(), pieces[i].begin(), pieces[i].end());
    std::ranges::for_each(pieces[i], [&](Index cell) { pieceOf[cell] = i; });
  }
  std::ranges::sort(all);
  EXPECT_EQ(all, cells);
  for (Index cell = 0; cell < 9000; ++cell)
  {
    EXPECT_TRUE(cell == 100 || pieceOf.at(cell) == pieceOf.at(cell + 9000)) << cell;
  }
  EXPECT_THAT(inPieces(source, {}), IsEmpty());
}

} // namespace
