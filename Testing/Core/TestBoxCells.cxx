// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests which boxes an optimizer evaluates.
#include "KernelSamples.h"
#include "Optimize/Kernel/BoxCells.h"
#include "Optimize/Kernel/MeasuredCells.h"
#include "Optimize/Kernel/QualityTargets.h"
#include "Optimize/Kernel/Region.h"
#include "QualityRanges.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::allRanges;
using atria::testing::boxesOf;
using atria::testing::cubes;
using atria::testing::hexahedra;
using atria::testing::Loop;
using atria::testing::neighborsOf;
using atria::testing::quietContext;
using atria::testing::Sample;
using atria::testing::upTo;
using ::testing::IsEmpty;

/// Targets that all boxes reach.
QualityTargets noTargets()
{
  QualityTargets targets;
  for (const auto range : allRanges)
  {
    targets.*range = {range == &QualityTargets::skewness ? 9.0 : -1.0, range == &QualityTargets::skewness ? 8.0 : 0.0};
  }
  return targets;
}

/// Measures of a box, of which more is better: those that are exact, and what bounds its corner volumes from below.
struct BoxMeasures
{
  double convexity = 0.0;
  double determinantRoot = 0.0;
  double weight = 0.5;
  double volumeRatio = 1.0;
  double cornerVolume = 0.0;
  double leastCornerVolume = 0.0;
};

BoxMeasures measureBox(const DualMesh& mesh, Index cell)
{
  const DualSource source(mesh);
  CellBox own;
  source.boxOf(cell, own);
  BoxMeasures out;
  const double shortest = own.lengths.minCoeff();
  out.convexity = shortest / std::hypot(shortest, own.lengths.maxCoeff());
  double volume = own.lengths.prod();
  double cube = std::pow(own.lengths.mean(), 3);
  out.cornerVolume = volume / cube;
  double areas = 0.0;
  double count = 0.0;
  Vec3 squares = Vec3::Zero();
  for (int direction = 0; direction < 6; ++direction)
  {
    CellBox beside;
    if (own.across[direction] == noIndex || !source.boxOf(own.across[direction], beside))
    {
      continue;
    }
    const int axis = axisOf(direction);
    const double area = own.lengths.prod() / own.lengths[axis];
    areas += area;
    count += 1.0;
    squares[axis] += area * area;
    const auto [less, more] = std::minmax({own.lengths[axis], beside.lengths[axis]});
    out.weight = std::min(out.weight, less / (less + more));
    out.volumeRatio = std::min(out.volumeRatio, less / more);
    volume = std::min(volume, beside.lengths.prod());
    cube = std::max(cube, std::pow(beside.lengths.mean(), 3));
  }
  out.determinantRoot = std::pow(squares.prod() / std::pow(areas / count, 6) / 8.0, 0.25);
  out.leastCornerVolume = volume / cube;
  return out;
}

/// Lengths between 1 and `most`.
std::vector<double> someLengths(std::size_t count, double most, std::mt19937& random)
{
  std::uniform_real_distribution<double> some(0.0, std::log(most));
  std::vector<double> lengths(count);
  std::ranges::generate(lengths, [&] { return std::exp(some(random)); });
  return lengths;
}

DualMesh someBoxes(std::mt19937& random)
{
  const double most = 1.2 + static_cast<double>(random() % 10);
  return boxesOf({{someLengths(2 + random() % 3, most, random), someLengths(1 + random() % 4, most, random),
                   someLengths(1 + random() % 4, most, random)}});
}

TEST(BoxCells, AreEvaluatedUnlessTheyAreBetterThanTheTargets)
{
  using Pick = std::pair<QualityRange QualityTargets::*, double BoxMeasures::*>;
  const std::vector<Pick> picks{{&QualityTargets::convexity, &BoxMeasures::convexity},
                                {&QualityTargets::determinantRoot, &BoxMeasures::determinantRoot},
                                {&QualityTargets::weight, &BoxMeasures::weight},
                                {&QualityTargets::volumeRatio, &BoxMeasures::volumeRatio},
                                {&QualityTargets::cornerVolume, &BoxMeasures::cornerVolume}};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> some(0.0, 1.0);
  for (const auto& [range, measure] : picks)
  {
    std::array<int, 2> decided{};
    for (int round = 0; round < 40; ++round)
    {
      const DualMesh mesh = someBoxes(random);
      QualityTargets targets = noTargets();
      (targets.*range).target = some(random) * (range == &QualityTargets::weight ? 0.5 : 1.0);
      const Loop kept = cellsToEvaluate(DualSource(mesh), upTo(mesh.elementCount()), targets, quietContext());
      for (Index cell = 0; cell < mesh.elementCount(); ++cell)
      {
        const BoxMeasures box = measureBox(mesh, cell);
        const double surely = measure == &BoxMeasures::cornerVolume ? box.leastCornerVolume : box.*measure;
        const bool isKept = std::ranges::binary_search(kept, cell);
        decided[0] += box.*measure < (targets.*range).target ? 1 : 0;
        decided[1] += surely > 1.03 * (targets.*range).target ? 1 : 0;
        EXPECT_TRUE(isKept || box.*measure >= (targets.*range).target) << round << ' ' << cell;
        EXPECT_TRUE(!isKept || surely <= 1.03 * (targets.*range).target) << round << ' ' << cell;
      }
    }
    EXPECT_GT(std::min(decided[0], decided[1]), 50);
  }
}

TEST(BoxCells, ThatAreNotEvaluatedAreGood)
{
  std::mt19937 random(13);
  std::size_t good = 0;
  std::size_t bad = 0;
  for (int round = 0; round < 40; ++round)
  {
    const DualMesh mesh = someBoxes(random);
    const DualSource source(mesh);
    QualityTargets targets;
    targets.scaledJacobian = round % 2 == 0 ? 0.0 : 0.9;
    targets.determinantRoot.target = round % 3 == 0 ? 0.0 : targets.determinantRoot.target;
    targets.determinantRoot.limit = round % 3 == 0 ? -1.0 : targets.determinantRoot.limit;
    const Loop all = upTo(mesh.elementCount());
    const Loop kept = cellsToEvaluate(source, all, targets, quietContext());
    Region region = extractCells(source, all, true, quietContext());
    for (const ShortCell& cell : shortCellsOf(QualityEvaluator(region, targets, quietContext()), 0.0, quietContext()))
    {
      EXPECT_TRUE(std::ranges::binary_search(kept, cell.cell)) << round << ' ' << cell.cell;
      ++bad;
    }
    good += all.size() - kept.size();
  }
  EXPECT_GT(good, 100U);
  EXPECT_GT(bad, 100U);
}

TEST(BoxCells, WithoutAnyNeighborIsEvaluated)
{
  QualityTargets targets = noTargets();
  targets.determinantRoot.target = 0.3;
  EXPECT_EQ(cellsToEvaluate(DualSource(cubes({1, 1, 1})), {0}, targets, quietContext()), Loop{0});
}

TEST(BoxCells, AreAllEvaluatedIfBoxesMayNotDo)
{
  const DualMesh mesh = cubes({3, 3, 3});
  const Loop all = upTo(27);
  const auto keptWith = [&](auto&& change) {
    QualityTargets targets = noTargets();
    change(targets);
    return cellsToEvaluate(DualSource(mesh), all, targets, quietContext());
  };
  for (const double target : {0.97, 0.999})
  {
    const auto matches = target < 0.98 ? ::testing::Matcher<Loop>(IsEmpty()) : ::testing::Matcher<Loop>(all);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.pyramidCosine.target = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.faceCosine.target = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.boundaryShape.target = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.scaledJacobian = target; }), matches);
    EXPECT_THAT(keptWith([&](QualityTargets& t) { t.skewness.target = 1.0 - target; }), matches);
  }
}

TEST(BoxCells, AreEvaluatedBesideCellsThatAreNone)
{
  DualMesh mesh = cubes({5, 5, 5});
  const std::size_t moved = 2 + 6 * (3 + 6 * 2);
  mesh.points[moved] += Vec3(0.01, 0.02, 0.03);
  const DualSource source(mesh);
  std::set<Index> expected;
  std::set<Index> bent;
  for (Index cell = 0; cell < mesh.elementCount(); ++cell)
  {
    if (std::ranges::count(mesh.corners[cell], moved) > 0)
    {
      bent.insert(cell);
      expected.insert(cell);
      std::ranges::for_each(neighborsOf(source, cell), [&](Index other) { expected.insert(other); });
    }
  }
  EXPECT_EQ(bent.size(), 8U);
  Loop cells = upTo(mesh.elementCount());
  std::ranges::reverse(cells);
  const QualityTargets targets = noTargets();
  for (const int threads : {1, 3})
  {
    const ThreadExecutor executor(threads);
    EXPECT_EQ(cellsToEvaluate(source, cells, targets, quietContext(executor)), Loop(expected.rbegin(), expected.rend()))
        << "in the same order";
  }
  std::erase_if(cells, [&](Index cell) { return bent.contains(cell); });
  Loop beside(expected.rbegin(), expected.rend());
  std::erase_if(beside, [&](Index cell) { return bent.contains(cell); });
  EXPECT_EQ(cellsToEvaluate(source, cells, targets, quietContext()), beside) << "bent cells need not be listed";
}

TEST(BoxCells, AreOnlyThoseOfDualMeshes)
{
  const Sample grid(hexahedra({3, 3, 3}));
  EXPECT_EQ(cellsToEvaluate(grid.source, upTo(27), noTargets(), quietContext()), upTo(27));
  EXPECT_THAT(cellsToEvaluate(grid.source, {}, noTargets(), quietContext()), IsEmpty());
}

} // namespace
