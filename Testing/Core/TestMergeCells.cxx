// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/MeshChecks.h"
#include "Quality/Unions/CellUnion.h"
#include "Quality/Unions/MergeCells.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace atria;
using atria::testing::SampleMesh;

FaceMesh facesOf(const SampleMesh& sample) { return makeFaceMesh(sample.points, sample.view()); }

/// Runs `use` on a context of so many threads.
template <typename F> auto withThreads(int threads, F&& use)
{
  const ThreadExecutor executor(threads);
  return use(atria::testing::quietContext(executor));
}

MergedCells merge(FaceMesh& mesh, int threads = 1)
{
  return withThreads(threads, [&](const RunContext& context) { return mergeUnderdeterminedCells(mesh, {}, context); });
}

MeshVerdict verdictOf(const FaceMesh& mesh)
{
  return withThreads(1, [&](const RunContext& context) { return checkMesh(measureMesh(mesh, context), context); });
}

/// Unit cubes at the given places of a grid.
SampleMesh cubes(const std::vector<std::array<int, 3>>& places)
{
  SampleMesh sample;
  std::map<std::array<int, 3>, std::int64_t> pointAt;
  for (const std::array<int, 3>& place : places)
  {
    std::vector<std::int64_t> ids;
    for (const auto& [x, y, z] : std::vector<std::array<int, 3>>{
             {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
    {
      const std::array<int, 3> at{place[0] + x, place[1] + y, place[2] + z};
      const auto [found, isNew] = pointAt.emplace(at, static_cast<std::int64_t>(sample.points.size()));
      if (isNew)
      {
        sample.points.emplace_back(at[0], at[1], at[2]);
      }
      ids.push_back(found->second);
    }
    sample.addCell(12, ids);
  }
  return sample;
}

/// A room of 3 x 3 x 3 cells with a duct, one cell wide, that leads into the middle of its side. The duct and the
/// middle cells of the room have the given height, all else is 1.
SampleMesh roomWithDuct(int length, double height)
{
  std::vector<std::array<int, 3>> places;
  for (int x = -length; x < 0; ++x)
  {
    places.push_back({x, 1, 1});
  }
  for (int i = 0; i < 27; ++i)
  {
    places.push_back({i % 3, i / 3 % 3, i / 9});
  }
  SampleMesh sample = cubes(places);
  for (Vec3& p : sample.points)
  {
    p[2] += p[2] > 1.5 ? height - 1.0 : 0.0;
  }
  return sample;
}

/// What has to be true of any merging and cutting: every face of before is one now, between the cells that its cells
/// became or pyramids of these; all other faces are between pyramids of one cell; the order is the one FaceMesh asks
/// for.
void expectSame(const FaceMesh& before, const FaceMesh& after, const MergedCells& merged)
{
  ASSERT_EQ(merged.cellOf.size(), before.cellCount);
  ASSERT_EQ(merged.faceOf.size(), before.faceCount());
  const std::size_t whole = before.cellCount - merged.count;
  ASSERT_EQ(after.cellCount, whole + merged.added.size());
  const auto wholeOf = [&](Index cell) { return cell < whole ? cell : merged.added[cell - whole]; };
  EXPECT_EQ(after.faceCount() - after.internalFaceCount(), before.faceCount() - before.internalFaceCount());
  std::set<Index> seen;
  for (std::size_t f = 0; f < before.faceCount(); ++f)
  {
    const bool internal = f < before.internalFaceCount();
    const Index owner = merged.cellOf[before.owner[f]];
    const Index neighbor = internal ? merged.cellOf[before.neighbor[f]] : noIndex;
    const Index now = merged.faceOf[f];
    if (owner == neighbor)
    {
      EXPECT_EQ(now, noIndex);
      continue;
    }
    ASSERT_LT(now, after.faceCount());
    EXPECT_TRUE(seen.insert(now).second);
    ASSERT_EQ(now < after.internalFaceCount(), internal);
    const bool turned = wholeOf(after.owner[now]) != owner;
    EXPECT_EQ(wholeOf(after.owner[now]), turned ? neighbor : owner);
    const Vec3 area = measurePolygon(before.points, before.face(f)).area;
    const Vec3 areaNow = measurePolygon(after.points, after.face(now)).area;
    EXPECT_LT((turned ? Vec3(areaNow + area) : Vec3(areaNow - area)).norm(), 1e-14);
    if (internal)
    {
      EXPECT_EQ(wholeOf(after.neighbor[now]), turned ? owner : neighbor);
      EXPECT_LT(after.owner[now], after.neighbor[now]);
    }
  }
  for (Index f = 0; f < after.faceCount(); ++f)
  {
    EXPECT_TRUE(seen.contains(f) ||
                (f < after.internalFaceCount() && wholeOf(after.owner[f]) == wholeOf(after.neighbor[f])));
  }
  for (std::size_t f = 1; f < after.faceCount(); ++f)
  {
    const bool bothInternal = f < after.internalFaceCount();
    const bool bothBoundary = f > after.internalFaceCount();
    EXPECT_TRUE(!bothInternal ||
                std::pair(after.owner[f - 1], after.neighbor[f - 1]) <= std::pair(after.owner[f], after.neighbor[f]));
    EXPECT_TRUE(!bothBoundary || after.owner[f - 1] <= after.owner[f]);
  }
  EXPECT_TRUE(verdictOf(after)["Openness"].failing.empty());
}

TEST(MergeCells, AFlatDuctBecomesOneWithTheRoomItLeadsInto)
{
  for (const int length : {1, 2, 3})
  {
    SCOPED_TRACE(length);
    const FaceMesh before = facesOf(roomWithDuct(length, 0.16));
    EXPECT_EQ(verdictOf(before)["Determinant"].failing.size(), static_cast<std::size_t>(length));
    FaceMesh after = before;
    const MergedCells merged = merge(after);
    EXPECT_EQ(merged.count, static_cast<std::size_t>(length));
    EXPECT_TRUE(merged.added.empty());
    expectSame(before, after, merged);
    const MeshVerdict verdict = verdictOf(after);
    EXPECT_TRUE(verdict["Determinant"].failing.empty());
    EXPECT_TRUE(verdict["FacePyramids"].failing.empty());
    EXPECT_TRUE(verdict["TetQuality"].failing.empty());
    EXPECT_TRUE(verdict["NonOrthogonality"].failing.empty());
  }
}

TEST(MergeCells, AFlatDuctTooLongToBecomeOneStays)
{
  const FaceMesh before = facesOf(roomWithDuct(8, 0.16));
  FaceMesh after = before;
  const MergedCells merged = merge(after);
  expectSame(before, after, merged);
  EXPECT_LT(verdictOf(after)["Determinant"].failing.size(), 8u);
  EXPECT_GT(verdictOf(after)["Determinant"].failing.size(), 0u);
}

TEST(MergeCells, ADuctOfCubesIsCutIntoPyramids)
{
  // One with the room it would be concave.
  for (const int length : {1, 2, 8})
  {
    SCOPED_TRACE(length);
    const FaceMesh before = facesOf(roomWithDuct(length, 1.0));
    FaceMesh after = before;
    const MergedCells merged = merge(after);
    EXPECT_EQ(merged.count, 0u);
    EXPECT_EQ(merged.added.size(), 5u * static_cast<std::size_t>(length));
    expectSame(before, after, merged);
    for (const MeshCheck& check : verdictOf(after).checks)
    {
      EXPECT_TRUE(check.failing.empty()) << check.name;
    }
    FaceMesh again = after;
    EXPECT_TRUE(merge(again).cellOf.empty());
  }
}

/// A duct of one cell into a room, with points moved by up to `most`.
FaceMesh movedDuct(unsigned seed, double height, double most)
{
  SampleMesh sample = roomWithDuct(1, height);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-most, most);
  for (Vec3& p : sample.points)
  {
    p += Vec3(move(random), move(random), move(random));
  }
  return facesOf(sample);
}

/// The least penalty of convex unions of a cell and one other that serve.
std::optional<double> unionPenalty(const CellUnions& unions, Index cell)
{
  std::optional<double> least;
  for (const Index other : unions.neighborsOf(std::array{cell}))
  {
    const UnionVerdict verdict = judgeUnion(unions, std::array{cell, other}, SerialExecutor());
    if (verdict.sound && verdict.determined && !verdict.concave)
    {
      least = std::min(least.value_or(verdict.penalty), verdict.penalty);
    }
  }
  return least;
}

TEST(MergeCells, TheLessSkewOfUnionAndPyramidsIsTaken)
{
  int united = 0;
  int cut = 0;
  for (unsigned seed = 1; seed <= 400; ++seed)
  {
    SCOPED_TRACE(seed);
    FaceMesh mesh = movedDuct(seed, seed % 2 == 0 ? 0.3 : 0.6, 0.1);
    const CellUnions unions(mesh, {}, SerialExecutor());
    const std::optional<double> whole = unionPenalty(unions, 0);
    const std::optional<double> pyramids = splitPenalty(unions, 0, SerialExecutor());
    if (!whole || !pyramids || verdictOf(mesh)["Determinant"].failing != std::vector<Index>{0})
    {
      continue;
    }
    const bool isCut = *pyramids < *whole;
    FaceMesh after = mesh;
    EXPECT_EQ(merge(after).added.empty(), !isCut);
    (isCut ? cut : united) += 1;
  }
  EXPECT_GT(united, 0);
  EXPECT_GT(cut, 0);
}

TEST(MergeCells, NothingChangesWhereNoNeighborHelps)
{
  // In a plane or a row no gradient across it can be determined, however cells are merged; a room has nothing to merge.
  for (const std::array<int, 3> n : {std::array{4, 4, 1}, {5, 1, 1}, {1, 1, 1}, {4, 4, 4}})
  {
    const FaceMesh before = facesOf(atria::testing::hexahedra(n));
    FaceMesh after = before;
    const MergedCells merged = merge(after);
    EXPECT_EQ(merged.count, 0u);
    EXPECT_TRUE(merged.cellOf.empty());
    EXPECT_TRUE(merged.faceOf.empty());
    EXPECT_EQ(after.owner, before.owner);
    EXPECT_EQ(after.facePoints, before.facePoints);
  }
}

TEST(MergeCells, ThinCellsOfALayerStay)
{
  SampleMesh sample = atria::testing::hexahedra({4, 4, 4});
  for (Vec3& p : sample.points)
  {
    p[2] = p[2] < 1.5 ? 1e-3 * p[2] : p[2];
  }
  FaceMesh mesh = facesOf(sample);
  const auto thin = verdictOf(mesh)["Determinant"].failing;
  EXPECT_EQ(thin.size(), 16u) << "checkMesh objects to thin cells as well";
  EXPECT_LE(merge(mesh).count, 4u) << "but for those in corners they have four neighbors or more";
}

TEST(MergeCells, MixedMeshesAreDeterminedAfterwards)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    const FaceMesh before = facesOf(atria::testing::mixedCells({4, 4, 4}, seed, 0.12));
    const MeshVerdict plain = verdictOf(before);
    FaceMesh after = before;
    const MergedCells merged = merge(after);
    if (merged.cellOf.empty())
    {
      EXPECT_TRUE(plain["Determinant"].failing.empty());
      continue;
    }
    expectSame(before, after, merged);
    const MeshVerdict now = verdictOf(after);
    EXPECT_TRUE(now["Determinant"].failing.empty());
    for (const MeshCheck& check : plain.checks)
    {
      if (check.isError && std::string(check.name) != "Concavity")
      {
        EXPECT_LE(now[check.name].failing.size(), check.failing.size()) << check.name;
      }
    }
    FaceMesh again = after;
    EXPECT_TRUE(merge(again).cellOf.empty());
    for (const int threads : {2, 7})
    {
      FaceMesh other = before;
      EXPECT_EQ(merge(other, threads).cellOf, merged.cellOf);
      EXPECT_EQ(other.facePoints, after.facePoints);
      EXPECT_EQ(other.neighbor, after.neighbor);
    }
  }
}

} // namespace
