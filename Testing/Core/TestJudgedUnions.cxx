// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of cells and faces keep what was sound sound, on meshes of all types of cells.
#include "Ranks/UnionsOnRanks.h"
#include "Support/DividedMesh.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace {

using namespace atria;
using namespace atria::testing;

FaceMesh meshOf(unsigned seed)
{
  const atria::testing::SampleMesh sample = atria::testing::mixedCells({4, 4, 4}, seed, 0.05 + 0.01 * (seed % 25));
  return makeFaceMesh(sample.points, sample.view());
}

/// Runs `use` on a context of so many threads.
template <typename F> auto withThreads(int threads, F&& use)
{
  const ThreadExecutor executor(threads);
  return use(atria::testing::quietContext(executor));
}

JudgedMesh judged(unsigned seed, const UnionOptions& options = {}, int threads = 1)
{
  return withThreads(threads, [&](const RunContext& context) {
    return uniteAndJudge([&] { return meshOf(seed); }, {}, options, context);
  });
}

/// By cell, whether it fails a check that is an error.
std::vector<char> failingCells(const FaceMesh& mesh)
{
  return withThreads(1, [&](const RunContext& context) {
    const MeasuredMesh measured = measureMesh(mesh, context);
    const MeshVerdict verdict = checkMesh(measured, context);
    std::vector<char> out;
    for (const std::uint32_t bits : failedChecksOfCells(measured, verdict))
    {
      bool fails = false;
      for (std::size_t i = 0; i < verdict.checks.size(); ++i)
      {
        fails = fails || (verdict.checks[i].isError && (bits >> i & 1) != 0);
      }
      out.push_back(fails);
    }
    return out;
  });
}

/// How many cells fail that are made of cells which did not.
std::size_t spoiledCells(const std::vector<char>& failedBefore, const std::vector<Index>& cellOf,
                         const std::vector<Index>& added, const FaceMesh& now)
{
  std::vector<char> hasFailed(now.cellCount, 0);
  for (Index cell = 0; cell < failedBefore.size(); ++cell)
  {
    hasFailed[cellOf.empty() ? cell : cellOf[cell]] |= failedBefore[cell];
  }
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    hasFailed[now.cellCount - added.size() + i] = hasFailed[added[i]];
  }
  const std::vector<char> fails = failingCells(now);
  std::size_t spoiled = 0;
  for (Index cell = 0; cell < fails.size(); ++cell)
  {
    spoiled += fails[cell] && !hasFailed[cell] ? 1 : 0;
  }
  return spoiled;
}

constexpr unsigned seeds = 50;

TEST(JudgedUnions, NoSoundCellFailsAfterwards)
{
  std::size_t united = 0;
  for (unsigned seed = 0; seed < seeds; ++seed)
  {
    SCOPED_TRACE(seed);
    const JudgedMesh now = judged(seed);
    EXPECT_EQ(spoiledCells(failingCells(meshOf(seed)), now.cellOf, now.added, now.mesh), 0u);
    united += now.mergedCells + now.mergedFaces + now.added.size();
  }
  EXPECT_GT(united, 0u) << "all unions were undone";
}

TEST(JudgedUnions, NothingIsLost)
{
  for (unsigned seed = 0; seed < seeds; ++seed)
  {
    SCOPED_TRACE(seed);
    const FaceMesh before = meshOf(seed);
    const JudgedMesh now = judged(seed);
    const auto geometryOf = [](const FaceMesh& mesh) {
      return withThreads(1, [&](const RunContext& context) { return measureMesh(mesh, context).geometry; });
    };
    const MeshGeometry old = geometryOf(before);
    const MeshGeometry made = geometryOf(now.mesh);
    std::vector<double> volumes(now.mesh.cellCount, 0.0);
    for (Index cell = 0; cell < before.cellCount; ++cell)
    {
      volumes[now.cellOf.empty() ? cell : now.cellOf[cell]] += old.cellVolumes[cell];
    }
    for (Index cell = 0; cell < now.mesh.cellCount; ++cell)
    {
      const std::size_t firstAdded = now.mesh.cellCount - now.added.size();
      volumes[cell < firstAdded ? cell : now.added[cell - firstAdded]] -= made.cellVolumes[cell];
    }
    std::vector<Vec3> areas(now.mesh.faceCount(), Vec3::Zero());
    for (Index face = 0; face < before.faceCount(); ++face)
    {
      const Index at = now.faceOf.empty() ? face : now.faceOf[face];
      if (at != noIndex && face >= before.internalFaceCount())
      {
        EXPECT_GE(at, now.mesh.internalFaceCount());
        areas[at] += old.faceAreas[face];
      }
    }
    for (std::size_t face = now.mesh.internalFaceCount(); face < areas.size(); ++face)
    {
      EXPECT_LT((areas[face] - made.faceAreas[face]).norm(), 1e-9);
    }
    for (const double left : volumes)
    {
      EXPECT_NEAR(left, 0.0, 0.05); // merged internal faces need not be flat
    }
  }
}

TEST(JudgedUnions, UnitesNothingThatWasNotAskedFor)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    const FaceMesh before = meshOf(seed);
    const JudgedMesh now = judged(seed, {false, false});
    EXPECT_TRUE(now.cellOf.empty());
    EXPECT_TRUE(now.faceOf.empty());
    EXPECT_EQ(now.mesh.owner, before.owner);
    EXPECT_EQ(now.mesh.neighbor, before.neighbor);
    EXPECT_EQ(now.mesh.facePoints, before.facePoints);
    EXPECT_EQ(judged(seed, {true, false}).mergedFaces, 0u);
    EXPECT_EQ(judged(seed, {false, true}).mergedCells, 0u);
  }
}

TEST(JudgedUnions, TheSameForAnyNumberOfThreads)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    const JudgedMesh one = judged(seed);
    const JudgedMesh three = judged(seed, {}, 3);
    EXPECT_EQ(one.mesh.points, three.mesh.points);
    EXPECT_EQ(one.mesh.facePoints, three.mesh.facePoints);
    EXPECT_EQ(one.cellOf, three.cellOf);
    EXPECT_EQ(one.faceOf, three.faceOf);
    EXPECT_EQ(one.failures, three.failures);
  }
}

/// Cells as they are now, by the lowest of those they were made of: all of these, and their faces, each with its points
/// and the cell across. What is new has the numbers of UnitedCells.
struct DescribedCell
{
  std::vector<std::int64_t> members;
  std::vector<std::pair<std::vector<std::int64_t>, std::int64_t>> faces;

  bool operator==(const DescribedCell&) const = default;
};

std::map<std::int64_t, DescribedCell> describe(const JudgedMesh& now, const WidePiece& piece, const UnitedCells& united)
{
  std::vector<DescribedCell> cells(now.mesh.cellCount);
  for (std::size_t cell = 0; cell < piece.cellIds.size(); ++cell)
  {
    cells[now.cellOf.empty() ? cell : now.cellOf[cell]].members.push_back(piece.cellIds[cell]);
  }
  for (std::size_t f = 0; f < now.mesh.faceCount(); ++f)
  {
    const bool isInternal = f < now.mesh.internalFaceCount();
    const Index owner = now.mesh.owner[f];
    const Index neighbor = isInternal ? now.mesh.neighbor[f] : noIndex;
    std::vector<std::int64_t> points;
    std::ranges::transform(now.mesh.face(f), std::back_inserter(points), [&](Index p) { return united.pointIds[p]; });
    cells[owner].faces.push_back({points, isInternal ? united.cellIds[neighbor] : -1});
    if (isInternal)
    {
      cells[neighbor].faces.push_back({points, united.cellIds[owner]});
    }
  }
  std::map<std::int64_t, DescribedCell> out;
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    if (united.isOwn[cell])
    {
      out[united.cellIds[cell]] = std::move(cells[cell]);
    }
  }
  return out;
}

/// Unions that a rank makes, or none where ranks do not agree.
struct RankUnions
{
  std::map<std::int64_t, DescribedCell> cells;
  std::vector<std::string> failures;
  int failedChecks = 0;
  std::size_t cellsLookedAt = 0;
};

std::vector<RankUnions> unionsOnRanks(const DividedSample& sample, int ranks)
{
  std::vector<RankUnions> out(static_cast<std::size_t>(ranks));
  try
  {
    onRanks(ranks, [&](RankExchange& exchange) {
      const PieceOfSample piece(sample, static_cast<Index>(exchange.rank()));
      const WidePiece wide = widen(piece.view(), unionRings, exchange);
      const PieceOnRanks part{wide, exchange};
      UnionsOnRanks port(part);
      const JudgedMesh now = uniteAndJudge([&] { return makeFaceMesh(wide.points, wide.cells(), wide.faceKeys()); }, {},
                                           {}, quietContext(), port);
      out[static_cast<std::size_t>(exchange.rank())] = {describe(now, wide, unitedCells(now, part)), now.failures,
                                                        now.verdict.failedChecks(), wide.types.size()};
    });
  }
  catch (const RanksDisagree&)
  {
    return {};
  }
  return out;
}

TEST(JudgedUnions, OnRanksAreThoseOfTheWhole)
{
  constexpr std::array<int, 3> size{3, 4, 40};
  std::size_t agreed = 0;
  std::size_t united = 0;
  double leastPart = 1.0;
  for (unsigned seed = 0; seed < seeds; ++seed)
  {
    SCOPED_TRACE(seed);
    const double distance = 0.05 + 0.01 * (seed % 25);
    const RankUnions whole = unionsOnRanks(DividedSample(seed, 1, size, distance), 1).at(0);
    std::map<std::int64_t, DescribedCell> cells;
    const std::vector<RankUnions> all = unionsOnRanks(DividedSample(seed, 3, size, distance), 3);
    agreed += all.empty() ? 0 : 1;
    for (const RankUnions& own : all)
    {
      leastPart =
          std::min(leastPart, static_cast<double>(own.cellsLookedAt) / static_cast<double>(whole.cellsLookedAt));
      cells.insert(own.cells.begin(), own.cells.end());
      EXPECT_EQ(own.failures, whole.failures);
      EXPECT_EQ(own.failedChecks, whole.failedChecks);
    }
    EXPECT_TRUE(all.empty() || cells == whole.cells);
    united += static_cast<std::size_t>(
        std::ranges::count_if(cells, [](const auto& cell) { return cell.second.members.size() != 1; }));
  }
  EXPECT_GT(united, 100U);
  EXPECT_LT(leastPart, 0.6);
  EXPECT_EQ(agreed, seeds);
}

} // namespace
