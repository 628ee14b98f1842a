// SPDX-License-Identifier: GPL-3.0-or-later
/// What cells fall short by is kept while points move: it is as if all were measured again.
#include "Optimize/Kernel/MeasuredCells.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace atria;
using namespace atria::testing;

/// Octants of two sizes about a box that is not along the axes.
DualMesh aMesh()
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-2.0), Vec3::Constant(2.0)};
  grid.sizeMax = 0.5;
  grid.sizeMid = grid.sizeMin = 0.25;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  options.layers = {{"*", {1}}};
  TriangleSurface surface;
  addBox(surface, "Box", {Vec3::Constant(-1.0), Vec3::Constant(1.0)});
  turn(surface, 17.0);
  return meshIt(surface, grid, options).mesh();
}

/// Moves some points by a part of the shortest edges, so that many cells fall short. Marks them.
std::vector<char> shake(DualMesh& mesh, std::mt19937& random, double share)
{
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<char> moved(mesh.points.size(), 0);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    if (std::abs(unit(random)) < share)
    {
      mesh.points[p] += 0.1 * Vec3(unit(random), unit(random), unit(random));
      moved[p] = 1;
    }
  }
  return moved;
}

std::vector<QualityTargets> lesserTargets(const QualityTargets& strictest)
{
  std::vector<QualityTargets> all{strictest, strictest.within(0.6), strictest.within(0.2), strictest};
  all.back().faceCosine = {0.4, 0.5};
  all.back().leastOfFaceCosine = 0.1;
  all.push_back(strictest);
  all.back().leastOfDeterminant = std::numeric_limits<double>::infinity();
  all.back().leastOfSkewness = 0.2;
  all.push_back(strictest);
  all.back().scaledJacobian = 0.0;
  return all;
}

void expectSame(const std::vector<ShortCell>& kept, const std::vector<ShortCell>& found)
{
  // Measures are kept in single precision, and shares of them are steep. Those that are nearly good do not count.
  constexpr float rounding = 1e-3F;
  const auto isClear = [](const ShortCell& cell) { return cell.worst < 1.0F - rounding; };
  std::vector<ShortCell> a;
  std::vector<ShortCell> b;
  std::ranges::copy_if(kept, std::back_inserter(a), isClear);
  std::ranges::copy_if(found, std::back_inserter(b), isClear);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].cell, b[i].cell);
    EXPECT_NEAR(a[i].worst, b[i].worst, rounding * std::max(1.0F, std::abs(b[i].worst)));
  }
}

TEST(MeasuredCells, AreAsIfAllWereMeasuredAgain)
{
  DualMesh mesh = aMesh();
  const DualSource source(mesh);
  QualityTargets strictest;
  strictest.faceCosine.target = 0.8;
  strictest.scaledJacobian = 0.6;
  MeasuredCells measured(strictest);
  const std::vector<char> all(mesh.points.size(), 1);
  measured.outdate(cellsWithMarked(source, all, quietContext()));
  std::mt19937 random(7);
  for (const double share : {0.5, 0.02, 0.001, 0.1})
  {
    const std::vector<char> moved = shake(mesh, random, share);
    measured.outdate(withNeighbors(source, cellsWithMarked(source, moved, quietContext()), quietContext()));
    measured.update(source, quietContext());
    for (const QualityTargets& targets : lesserTargets(strictest))
    {
      const std::vector<ShortCell> found = findShortCells(source, all, targets, quietContext());
      EXPECT_GT(found.size(), 100u);
      expectSame(measured.shortOf(targets), found);
    }
  }
}

TEST(MeasuredCells, GiveThoseBelowAShareOnly)
{
  DualMesh mesh = aMesh();
  std::mt19937 random(3);
  shake(mesh, random, 0.3);
  const DualSource source(mesh);
  MeasuredCells measured{QualityTargets()};
  measured.outdate(cellsWithMarked(source, std::vector<char>(mesh.points.size(), 1), quietContext()));
  measured.update(source, quietContext());
  std::vector<ShortCell> expected = measured.shortOf(QualityTargets());
  std::erase_if(expected, [](const ShortCell& cell) { return cell.worst >= 0.5F; });
  expectSame(measured.shortOf(QualityTargets(), 0.5F), expected);
  EXPECT_FALSE(expected.empty());
}

TEST(MeasuredCells, FollowCellsToOtherNumbers)
{
  DualMesh mesh = aMesh();
  std::mt19937 random(5);
  shake(mesh, random, 0.3);
  const DualSource source(mesh);
  MeasuredCells measured{QualityTargets()};
  measured.outdate(cellsWithMarked(source, std::vector<char>(mesh.points.size(), 1), quietContext()));
  measured.update(source, quietContext());
  const std::vector<ShortCell> before = measured.shortOf(QualityTargets());
  const auto count = static_cast<Index>(mesh.elementCount());
  std::vector<Index> numbers(count); // turned round, every third is lost
  for (Index cell = 0; cell < count; ++cell)
  {
    numbers[cell] = cell % 3 == 0 ? noIndex : count - 1 - cell;
  }
  measured.renumber(numbers);
  std::vector<ShortCell> expected;
  for (auto cell = before.rbegin(); cell != before.rend(); ++cell)
  {
    if (numbers[cell->cell] != noIndex)
    {
      expected.push_back({numbers[cell->cell], cell->worst});
    }
  }
  expectSame(measured.shortOf(QualityTargets()), expected);
}

} // namespace
