// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests counted values and counts over the own part of a mesh.
#include "CellSamples.h"
#include "Quality/Checks/PartCounts.h"
#include "Support/SampleMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace {

using namespace atria;
using atria::testing::cornersOf;
using atria::testing::Ids;
using atria::testing::mixedCells;
using atria::testing::SampleMesh;
using ::testing::IsEmpty;

TEST(CountedValues, KeepTheWorstAndCountFailures)
{
  for (const bool isGreatest : {false, true})
  {
    CountedValues counted{isGreatest};
    counted.add(CountedValues{isGreatest, 1e9 * (isGreatest ? 1 : -1), 0.0, 0, 0}); // without values it has no worst
    EXPECT_EQ(counted.count, 0U);
    counted.add(isGreatest ? -5.0 : 5.0, true);
    EXPECT_EQ(counted.worst, isGreatest ? -5.0 : 5.0) << "0 is no value";
    counted.add(isGreatest ? -6.0 : 6.0, false);
    EXPECT_EQ(counted.worst, isGreatest ? -5.0 : 5.0);
    counted.add(isGreatest ? -4.0 : 4.0, true);
    EXPECT_EQ(counted.worst, isGreatest ? -4.0 : 4.0);
    EXPECT_EQ(counted.sum, isGreatest ? -15.0 : 15.0);
    EXPECT_EQ(counted.count, 3U);
    EXPECT_EQ(counted.failing, 2U);
  }
}

TEST(CountedValues, AreTheSameInParts)
{
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round)
  {
    const bool isGreatest = round % 2 == 0;
    CountedValues all{isGreatest};
    std::vector<CountedValues> parts(3, CountedValues{isGreatest});
    for (int i = 0; i < round; ++i)
    {
      const double value = static_cast<double>(random() % 100) - 50.0;
      all.add(value, i % 3 == 0);
      parts[random() % 2].add(value, i % 3 == 0); // the third part stays empty
    }
    CountedValues sum{isGreatest};
    std::ranges::for_each(parts, [&](const CountedValues& part) { sum.add(part); });
    EXPECT_EQ(sum.count, all.count);
    EXPECT_EQ(sum.worst, all.worst);
    EXPECT_EQ(sum.sum, all.sum);
    EXPECT_EQ(sum.failing, all.failing);
  }
}

/// Some cells of a mesh as its own part.
struct OwnPart
{
  explicit OwnPart(unsigned seed)
      : sample(mixedCells({3, 3, 3}, seed)), mesh(makeFaceMesh(sample.points, sample.view()))
  {
    std::mt19937 random(seed);
    isOwn.resize(mesh.cellCount);
    std::ranges::generate(isOwn, [&] { return static_cast<char>(random() % 2); });
    cellIds.resize(mesh.cellCount);
    pointIds.resize(mesh.points.size());
    std::iota(cellIds.begin(), cellIds.end(), std::int64_t{100});
    std::iota(pointIds.begin(), pointIds.end(), std::int64_t{1000});
  }
  /// 1 if the first cell that has the point is an own one.
  char ownsPoint(Index point) const
  {
    for (std::size_t cell = 0; cell < isOwn.size(); ++cell)
    {
      if (std::ranges::count(cornersOf(sample, cell), point) > 0)
      {
        return isOwn[cell];
      }
    }
    return 0;
  }
  CheckedPart part() const { return {isOwn, cellIds, pointIds, alone()}; }

  SampleMesh sample;
  FaceMesh mesh;
  std::vector<char> isOwn;
  Ids cellIds;
  Ids pointIds;
};

TEST(PartCounts, CountPointsWhereTheirLowestCellIsOwn)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    OwnPart own(seed);
    own.mesh.points.emplace_back(9, 9, 9); // without a cell
    const std::vector<char> counted = pointsOfOwn(own.mesh, own.isOwn);
    ASSERT_EQ(counted.size(), own.mesh.points.size());
    std::vector<Index> some;
    std::size_t expected = 0;
    for (Index point = 0; point < counted.size(); ++point)
    {
      EXPECT_EQ(counted[point], own.ownsPoint(point)) << point;
      if (point % 3 != 0)
      {
        some.push_back(point);
        expected += own.ownsPoint(point) != 0 ? 1 : 0;
      }
    }
    const CheckedPart part = own.part();
    EXPECT_EQ(PartCounts(own.mesh, &part).countPoints(some), expected);
    EXPECT_EQ(PartCounts(own.mesh, nullptr).countPoints(some), some.size());
  }
}

TEST(PartCounts, CountFacesWhereTheirOwnerIsOwn)
{
  const OwnPart own(3);
  const CheckedPart part = own.part();
  const PartCounts counts(own.mesh, &part);
  const PartCounts all(own.mesh, nullptr);
  for (std::size_t cell = 0; cell < own.mesh.cellCount; ++cell)
  {
    EXPECT_EQ(counts(MeshPart::Cells, cell), own.isOwn[cell] != 0);
    EXPECT_TRUE(all(MeshPart::Cells, cell));
  }
  for (std::size_t f = 0; f < own.mesh.faceCount(); ++f)
  {
    EXPECT_EQ(counts(MeshPart::Faces, f), own.isOwn[own.mesh.owner[f]] != 0);
    EXPECT_TRUE(all(MeshPart::Faces, f));
  }
  EXPECT_TRUE(counts(MeshPart::Mesh, 0));
}

TEST(PartCounts, OfASingleProcessKeepItsValues)
{
  const OwnPart own(4);
  const CheckedPart part = own.part();
  for (const CheckedPart* which : {static_cast<const CheckedPart*>(nullptr), &part})
  {
    const PartCounts counts(own.mesh, which);
    CountedValues values{true, 4.0, 7.0, 2, 1};
    counts.addOthers(values);
    EXPECT_EQ(std::tuple(values.isGreatest, values.worst, values.sum, values.count, values.failing),
              std::tuple(true, 4.0, 7.0, std::size_t{2}, std::size_t{1}));
    Vec3 sum(1, 2, 3);
    double size = 4.0;
    counts.addOthers(sum, size);
    EXPECT_EQ(sum, Vec3(1, 2, 3));
    EXPECT_EQ(size, 4.0);
    Box3 box{Vec3(0, 1, 2), Vec3(3, 4, 5)};
    counts.addOthers(box);
    EXPECT_EQ(box.min, Vec3(0, 1, 2));
    EXPECT_EQ(box.max, Vec3(3, 4, 5));
    for (const MeshPart kind : {MeshPart::Cells, MeshPart::Faces, MeshPart::Mesh})
    {
      EXPECT_EQ(counts.first(kind, 0, Vec3(6, 7, 8)), Vec3(6, 7, 8));
    }
    EXPECT_EQ(counts.first(MeshPart::Faces, own.mesh.faceCount() - 1, Vec3(6, 7, 8)), Vec3(6, 7, 8));
    EXPECT_THAT(counts.pointsOfOthers(1e9), IsEmpty());
  }
}

} // namespace
