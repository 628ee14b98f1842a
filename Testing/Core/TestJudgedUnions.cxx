// SPDX-License-Identifier: GPL-3.0-or-later
/// Unions of cells and faces keep what was sound sound, on meshes of all types of cells.
#include "Quality/Unions/JudgedUnions.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <gtest/gtest.h>

namespace {

using namespace atria;

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

} // namespace
