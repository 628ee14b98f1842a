// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests regions of cells: their faces, ghosts, points, and sets of points that move together.
#include "Followers.h"
#include "KernelSamples.h"
#include "Optimize/Kernel/CellMeasure.h"
#include "Optimize/Kernel/Extraction.h"
#include "Optimize/Kernel/Region.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <span>
#include <vector>

namespace {

using namespace atria;
using atria::testing::cornersOf;
using atria::testing::cubes;
using atria::testing::facesOf;
using atria::testing::Followers;
using atria::testing::Loop;
using atria::testing::markSome;
using atria::testing::mixedCells;
using atria::testing::neighborsOf;
using atria::testing::quietContext;
using atria::testing::Sample;
using atria::testing::someOf;
using atria::testing::upTo;

/// Checks the faces of a region. Returns the cell of the mesh behind each ghost.
Loop expectFaces(const Region& region, const CellSource& source)
{
  Loop ghosts(region.ghosts.size(), noIndex);
  std::size_t f = 0;
  for (Index local = 0; local < region.cellIds.size(); ++local)
  {
    for (const auto& [loop, across] : facesOf(source, region.cellIds[local]))
    {
      const auto found = std::ranges::lower_bound(region.cellIds, across);
      const bool isJudged = found != region.cellIds.end() && *found == across;
      const auto judged = static_cast<Index>(found - region.cellIds.begin());
      if (isJudged && judged < local)
      {
        continue;
      }
      Loop named;
      std::ranges::transform(region.face(f), std::back_inserter(named), [&](Index p) { return region.pointIds.at(p); });
      EXPECT_EQ(named, loop) << f;
      EXPECT_EQ(region.owner[f], local);
      const Index neighbor = region.neighbor[f++];
      if (across == noIndex || isJudged)
      {
        EXPECT_EQ(neighbor, across == noIndex ? noIndex : judged);
        continue;
      }
      Index& ghost = ghosts.at(neighbor - region.judgedCount());
      EXPECT_TRUE(ghost == noIndex || ghost == across);
      ghost = across;
    }
  }
  EXPECT_EQ(region.faceCount(), f);
  EXPECT_EQ(region.faceOffsets.size(), f + 1);
  EXPECT_EQ(region.faceOffsets.back(), region.facePoints.size());
  return ghosts;
}

/// Checks that each judged cell has its faces, in rising order.
void expectCellFaces(const Region& region)
{
  ASSERT_EQ(region.judgedCount(), region.cellIds.size());
  for (Index cell = 0; cell < region.judgedCount(); ++cell)
  {
    Loop expected;
    for (Index f = 0; f < region.faceCount(); ++f)
    {
      expected.insert(expected.end(), region.owner[f] == cell || region.neighbor[f] == cell ? 1 : 0, f);
    }
    EXPECT_TRUE(std::ranges::equal(region.facesOf(cell), expected)) << cell;
  }
}

/// Checks the ghosts, which are these cells, and the points and native cells.
void expectMeasures(const Region& region, const CellSource& source, const Loop& ghosts, bool withNatives)
{
  CellSource::Scratch scratch;
  std::vector<FaceMeasure> faces;
  for (std::size_t g = 0; g < ghosts.size(); ++g)
  {
    ASSERT_NE(ghosts[g], noIndex);
    const SizedCell expected = measureCell(source, ghosts[g], scratch, faces);
    EXPECT_EQ(region.ghosts[g].measure.centroid, expected.measure.centroid);
    EXPECT_EQ(region.ghosts[g].measure.volume, expected.measure.volume);
    EXPECT_EQ(region.ghosts[g].size, expected.size);
  }
  ASSERT_EQ(region.points.size(), region.pointIds.size());
  for (std::size_t p = 0; p < region.points.size(); ++p)
  {
    EXPECT_EQ(region.points[p], source.points()[region.pointIds[p]]);
  }
  ASSERT_EQ(region.natives.size(), withNatives ? region.cellIds.size() : 0);
  for (std::size_t cell = 0; cell < region.natives.size(); ++cell)
  {
    const NativeCell expected = source.nativeOf(region.cellIds[cell]);
    EXPECT_EQ(region.natives[cell].type, expected.type);
    for (std::size_t i = 0; i < shapeOf(expected.type).corners; ++i)
    {
      EXPECT_EQ(region.pointIds.at(region.natives[cell].corners[i]), expected.corners[i]);
    }
  }
}

/// Returns numbers in the order in which they are first met.
Loop firstMet(const std::vector<Loop>& lists, const Loop& without = {})
{
  Loop out;
  for (const Loop& list : lists)
  {
    for (const Index number : list)
    {
      if (std::ranges::count(out, number) == 0 && std::ranges::count(without, number) == 0)
      {
        out.push_back(number);
      }
    }
  }
  return out;
}

void expectRegion(const Region& region, const CellSource& source, const Loop& cells, bool withNatives, bool isInOrder)
{
  ASSERT_EQ(region.cellIds, cells);
  const Loop ghosts = expectFaces(region, source);
  expectCellFaces(region);
  expectMeasures(region, source, ghosts, withNatives);
  EXPECT_EQ(region.cellCount(), cells.size() + ghosts.size());
  std::vector<Loop> corners;
  std::vector<Loop> neighbors;
  for (const Index cell : cells)
  {
    corners.push_back(cornersOf(source, cell));
    neighbors.push_back(neighborsOf(source, cell));
  }
  Loop points = firstMet(corners);
  Loop around = firstMet(neighbors, cells);
  if (isInOrder)
  {
    std::ranges::sort(points);
    std::ranges::sort(around);
  }
  EXPECT_EQ(region.pointIds, points);
  EXPECT_EQ(ghosts, around);
}

TEST(Region, HasTheFacesOfItsCellsAndGhostsBeyondThem)
{
  std::mt19937 random(3);
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const Sample mixed(mixedCells({3, 3, 3}, seed, 0.1));
    const DualMesh boxes = cubes({4, 3, 3});
    const DualSource dual(boxes);
    const bool withNatives = seed % 2 == 0;
    for (const CellSource* source :
         {static_cast<const CellSource*>(&dual), static_cast<const CellSource*>(&mixed.source)})
    {
      const Loop cells = someOf(source->cellCount(), random, 1 + seed % 3);
      expectRegion(extractCells(*source, cells, withNatives, quietContext()), *source, cells, withNatives, false);
      Extraction inOrder(*source, cells, withNatives, Extraction::Order::ofMesh);
      expectRegion(inOrder.run(quietContext()), *source, cells, withNatives, true);
    }
  }
}

TEST(Region, OfNoCellsIsEmpty)
{
  const DualMesh mesh = cubes({2, 2, 2});
  const DualSource source(mesh);
  expectRegion(extractCells(source, {}, true, quietContext()), source, {}, true, false);
  expectRegion(Extraction(source, {}, true, Extraction::Order::ofMesh).run(quietContext()), source, {}, true, true);
}

TEST(Region, OfSeveralPartsIsTheSameOnSeveralThreads)
{
  const DualMesh mesh = cubes({14, 12, 15});
  const DualSource source(mesh);
  Loop cells = upTo(source.cellCount()); // more than two parts
  std::erase_if(cells, [](Index cell) { return cell % 200 == 7; });
  const auto extract = [&](int threads) {
    const ThreadExecutor executor(threads);
    return Extraction(source, cells, true, Extraction::Order::ofMesh).run(quietContext(executor));
  };
  const Region one = extract(1);
  const Region three = extract(3);
  EXPECT_EQ(one.pointIds, upTo(mesh.points.size()));
  const Loop ghosts = expectFaces(one, source);
  EXPECT_TRUE(std::ranges::is_sorted(ghosts));
  expectMeasures(one, source, ghosts, true);
  EXPECT_EQ(one.facePoints, three.facePoints);
  EXPECT_EQ(one.faceOffsets, three.faceOffsets);
  EXPECT_EQ(one.owner, three.owner);
  EXPECT_EQ(one.neighbor, three.neighbor);
  EXPECT_EQ(one.cellFaces, three.cellFaces);
  EXPECT_EQ(one.cellOffsets, three.cellOffsets);
}

TEST(Extraction, ListsTheCornersOfEachCell)
{
  const DualMesh mesh = cubes({12, 10, 10});
  const DualSource source(mesh);
  const Loop cells = upTo(source.cellCount());
  Extraction extraction(source, cells, false, Extraction::Order::ofMesh);
  const ThreadExecutor executor(2);
  extraction.run(quietContext(executor));
  std::vector<Loop> found(cells.size());
  extraction.forCells(quietContext(executor), [&](Index cell, std::span<const Index> corners) {
    found.at(cell).insert(found.at(cell).end(), corners.begin(), corners.end());
  });
  for (const Index cell : cells)
  {
    EXPECT_EQ(found[cell], cornersOf(source, cell)) << cell; // all points keep their numbers
  }
}

TEST(Region, HasSetsOfPointsThatMoveTogether)
{
  std::mt19937 random(5);
  for (int round = 0; round < 10; ++round)
  {
    SCOPED_TRACE(round);
    const Sample mixed(mixedCells({4, 3, 3}, static_cast<unsigned>(round)));
    Followers followers;
    const std::vector<char> marked = markSome(mixed.mesh.points.size(), random, followers);
    const ThreadExecutor executor(round % 2 == 0 ? 1 : 3);
    const Region region = extractRegion(mixed.source, marked, followers, false, quietContext(executor));
    expectRegion(region, mixed.source, cellsWithMarked(mixed.source, marked, quietContext()), false, true);
    std::map<Index, Loop> sets;
    for (const Index point : numbersOf(marked, SerialExecutor()))
    {
      sets[followers.leaderOf(point)].push_back(point);
    }
    ASSERT_EQ(region.movable.size(), sets.size());
    std::size_t m = 0;
    for (const auto& [leader, members] : sets)
    {
      EXPECT_EQ(region.pointIds[region.movable[m]], leader);
      Loop found;
      std::ranges::for_each(region.membersOf(m), [&](Index p) { found.push_back(region.pointIds[p]); });
      EXPECT_EQ(found, members);
      std::vector<double> shares;
      std::ranges::for_each(members, [&](Index p) { shares.push_back(followers.shareOf(p)); });
      EXPECT_TRUE(std::ranges::equal(region.sharesOf(m), shares));
      Loop around;
      for (Index cell = 0; cell < region.judgedCount(); ++cell)
      {
        const Loop corners = cornersOf(mixed.source, region.cellIds[cell]);
        const bool has = std::ranges::find_first_of(corners, members) != corners.end();
        around.insert(around.end(), has ? 1 : 0, cell);
      }
      EXPECT_TRUE(std::ranges::equal(region.cellsAbout(m), around));
      ++m;
    }
  }
}

} // namespace
