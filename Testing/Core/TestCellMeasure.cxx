// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests measures of faces and cells.
#include "KernelSamples.h"
#include "Optimize/Kernel/CellMeasure.h"
#include "Quality/Faces/Geometry.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace {

using namespace atria;
using atria::testing::hexahedra;
using atria::testing::Sample;
using atria::testing::SampleMesh;
using atria::testing::upTo;

class RandomPlaces
{
public:
  explicit RandomPlaces(unsigned seed) : random(seed) {}
  Vec3 place() { return {some(random), some(random), some(random)}; }
  std::vector<Vec3> places(std::size_t count)
  {
    std::vector<Vec3> out(count);
    std::ranges::generate(out, [&] { return place(); });
    return out;
  }

private:
  std::mt19937 random;
  std::uniform_real_distribution<double> some{-2.0, 2.0};
};

auto pointsOf(const std::vector<Vec3>& points)
{
  return [&](std::size_t i) -> const Vec3& { return points.at(i); };
}

TEST(FaceMeasure, IsThatOfPolygons)
{
  RandomPlaces random(3);
  for (std::size_t round = 0; round < 100; ++round)
  {
    const std::size_t size = 3 + round % 5;
    const std::vector<Vec3> points = random.places(size);
    EXPECT_LT((crossOf(points[0], points[1]) - points[0].cross(points[1])).norm(), 1e-14);
    const PolygonMeasure expected = measurePolygon(points, upTo(size));
    for (const FaceMeasure& face : {measureFace(size, pointsOf(points)), measureAnyFace(size, pointsOf(points))})
    {
      EXPECT_LT((face.area - expected.area).norm(), 1e-12);
      EXPECT_LT((face.centroid - expected.centroid).norm(), 1e-12);
      EXPECT_NEAR(face.length, expected.area.norm(), 1e-12);
      EXPECT_LT((face.normal - expected.area.normalized()).norm(), 1e-12);
    }
  }
}

TEST(FaceMeasure, OfAFaceWithoutAreaHasNoNormal)
{
  for (const std::vector<Vec3>& points :
       {std::vector<Vec3>(3, Vec3(1, 2, 3)), std::vector<Vec3>{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}},
        std::vector<Vec3>{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {1, 2, 3}}})
  {
    const FaceMeasure face = measureFace(points.size(), pointsOf(points));
    EXPECT_EQ(face.length, 0.0);
    EXPECT_EQ(face.normal, Vec3(Vec3::Zero()));
    EXPECT_LT((face.centroid - Vec3(1, 2, 3)).norm(), 1e-14);
  }
}

TEST(FaceMeasure, HasThePerimeterOfAClosedPolygon)
{
  const std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}};
  const std::vector<double> lengths{0.0, 6.0, 12.0, 14.0};
  for (std::size_t size = 1; size <= 4; ++size)
  {
    EXPECT_DOUBLE_EQ(perimeterOf(size, pointsOf(points)), lengths[size - 1]) << size;
  }
}

TEST(CellMeasure, IsThatOfPolygonsInOrder)
{
  RandomPlaces random(5);
  for (std::size_t round = 0; round < 100; ++round)
  {
    std::vector<PolygonMeasure> faces;
    for (std::size_t i = 0; i < round % 7; ++i)
    {
      faces.push_back({random.place(), random.place()});
    }
    const CellMeasureInOrder expected = measureCellInOrder(faces.size(), [&](std::size_t i) { return faces[i]; });
    Vec3 mean = Vec3::Zero();
    const CellMeasure cell = measureCell([&](auto&& visit) {
      mean = Vec3::Zero();
      for (const PolygonMeasure& face : faces)
      {
        mean += face.centroid / static_cast<double>(faces.size());
        visit(face.centroid, face.area);
      }
    });
    EXPECT_NEAR(cell.volume, expected.volume, 1e-12);
    EXPECT_LT((cell.mean - mean).norm(), 1e-12);
    EXPECT_LT((cell.centroid - expected.centroid).norm(), 1e-9 * (1.0 + expected.centroid.norm()));
  }
}

TEST(CellMeasure, OfASourceHasTheMeanOfAllEdges)
{
  SampleMesh boxes = hexahedra({3, 1, 1});
  for (Vec3& p : boxes.points)
  {
    p = p.cwiseProduct(Vec3(1, 2, 6));
  }
  const Sample row(boxes);
  CellSource::Scratch scratch;
  std::vector<FaceMeasure> faces;
  for (Index cell = 0; cell < 3; ++cell)
  {
    const SizedCell sized = measureCell(row.source, cell, scratch, faces);
    EXPECT_NEAR(sized.measure.volume, 12.0, 1e-12);
    EXPECT_LT((sized.measure.centroid - Vec3(cell + 0.5, 1, 3)).norm(), 1e-12);
    EXPECT_NEAR(sized.size, 3.0, 1e-12);
    EXPECT_EQ(faces.size(), 6U);
  }
}

TEST(CellMeasure, WeighsAFaceByItsDistancesAlongItsNormal)
{
  FaceMeasure face{};
  face.centroid = Vec3(1, 1, 1);
  face.normal = Vec3::UnitX();
  CellMeasure own{};
  CellMeasure other{};
  const std::vector<std::array<double, 3>> cases{{0, 2, 0.5}, {0, 4, 0.25}, {-2, 2, 0.25}, {1, 2, 0.0}, {1, 1, 0.0}};
  for (const auto& [ownX, otherX, weight] : cases)
  {
    own.centroid = Vec3(ownX, 9, -3); // only the distance along the normal counts
    other.centroid = Vec3(otherX, -7, 5);
    EXPECT_DOUBLE_EQ(weightOf(face, own, other), weight);
    EXPECT_DOUBLE_EQ(weightOf(face, other, own), weight);
  }
}

TEST(CellMeasure, ComparesTheSmallerVolumeWithTheLarger)
{
  const std::vector<std::array<double, 3>> cases{{1, 1, 1},    {1, 4, 0.25}, {-1, 4, -0.25}, {-4, 1, -1},
                                                 {-4, -1, -1}, {0, 3, 0},    {0, 0, 0}};
  for (const auto& [a, b, ratio] : cases)
  {
    CellMeasure own{};
    CellMeasure other{};
    own.volume = a;
    other.volume = b;
    EXPECT_DOUBLE_EQ(volumeRatioOf(own, other), ratio) << a << ' ' << b;
    EXPECT_DOUBLE_EQ(volumeRatioOf(other, own), ratio) << a << ' ' << b;
  }
}

} // namespace
