// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how polygons, cells and meshes are measured, and sums that are added in order.
#include "FaceSamples.h"
#include "Quality/Faces/Geometry.h"
#include "Quality/Faces/InOrder.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::facesOf;
using atria::testing::Loop;
using atria::testing::measureCellOf;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::RandomShapes;
using atria::testing::SampleMesh;
using atria::testing::upTo;

TEST(InOrder, AddsProductsFromTheFirstComponentToTheLast)
{
  EXPECT_EQ(dotInOrder({2, 3, 5}, {7, 11, 13}), 14 + 33 + 65);
  const Vec3 ones = Vec3::Ones();
  EXPECT_EQ(dotInOrder({1e16, -1e16, 1}, ones), 1.0);
  EXPECT_EQ(dotInOrder({1e16, 1, -1e16}, ones), 0.0) << "1 is lost beside 1e16";
  EXPECT_EQ(dotInOrder({1, 1e16, -1e16}, ones), 0.0);
}

TEST(InOrder, LengthIsTheRootOfTheSquares)
{
  EXPECT_EQ(lengthInOrder({3, 4, 12}), 13.0);
  EXPECT_EQ(lengthInOrder({-2, 3, -6}), 7.0);
  EXPECT_EQ(lengthInOrder(Vec3::Zero()), 0.0);
}

TEST(CellFaces, AreThoseACellOwnsAndThenTheOthers)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    const SampleMesh sample = mixedCells({3, 3, 3}, seed);
    const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
    for (const int threads : {1, 3})
    {
      const CellFaces cellFaces = makeCellFaces(mesh, ThreadExecutor(threads));
      for (Index cell = 0; cell < mesh.cellCount; ++cell)
      {
        Loop expected;
        for (const Buffer<Index>* side : {&mesh.owner, &mesh.neighbor})
        {
          for (Index f = 0; f < side->size(); ++f)
          {
            expected.insert(expected.end(), (*side)[f] == cell ? 1 : 0, f);
          }
        }
        EXPECT_TRUE(std::ranges::equal(cellFaces.of(cell), expected)) << cell;
      }
    }
  }
}

TEST(PolygonMeasure, OfFlatConvexPolygonsIsThatOfAFan)
{
  RandomShapes shapes(3);
  for (int round = 0; round < 200; ++round)
  {
    const std::size_t size = 3 + static_cast<std::size_t>(round % 6);
    Vec3 normal;
    const std::vector<Vec3> points = shapes.convexPolygon(size, normal);
    Vec3 area = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 2; i < size; ++i)
    {
      const Vec3 part = 0.5 * (points[i - 1] - points[0]).cross(points[i] - points[0]);
      area += part;
      moment += part.norm() * (points[0] + points[i - 1] + points[i]) / 3.0;
    }
    Loop loop = upTo(size);
    const PolygonMeasure front = measurePolygon(points, loop);
    EXPECT_LT((front.area - area).norm(), 1e-12) << round;
    EXPECT_GT(front.area.dot(normal), 0.0) << round;
    EXPECT_LT((front.centroid - moment / area.norm()).norm(), 1e-11) << round;
    std::ranges::reverse(loop);
    const PolygonMeasure back = measurePolygon(points, loop);
    EXPECT_LT((back.area + area).norm(), 1e-12) << round;
    EXPECT_LT((back.centroid - front.centroid).norm(), 1e-11) << round;
  }
}

TEST(PolygonMeasure, OfBentQuadrilateralsWeighsTheTrianglesAroundTheMean)
{
  RandomShapes shapes(5);
  for (int round = 0; round < 100; ++round)
  {
    const std::vector<Vec3> p{shapes.place(), shapes.place(), shapes.place(), shapes.place()};
    const Vec3 mean = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    double weights = 0.0;
    Vec3 moment = Vec3::Zero();
    for (const auto& [a, b] :
         {std::pair(p[0], p[1]), std::pair(p[1], p[2]), std::pair(p[2], p[3]), std::pair(p[3], p[0])})
    {
      const double weight = (a - mean).cross(b - mean).norm();
      weights += weight;
      moment += weight * (a + b + mean) / 3.0;
    }
    const PolygonMeasure measure = measurePolygon(p, upTo(4));
    EXPECT_LT((measure.area - 0.5 * (p[2] - p[0]).cross(p[3] - p[1])).norm(), 1e-12);
    EXPECT_LT((measure.centroid - moment / weights).norm(), 1e-12);
  }
}

TEST(PolygonMeasure, OfPolygonsWithoutAreaIsTheMeanOfTheirPoints)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {5, 10, 15}, {5, 10, 15}};
  const std::vector<std::pair<Loop, Vec3>> cases{
      {{1, 1, 1}, {1, 2, 3}}, {{1, 1, 1, 1}, {1, 2, 3}}, {{0, 1, 2}, {1, 2, 3}}, {{3, 4, 3, 4, 3}, {5, 10, 15}}};
  for (const auto& [loop, mean] : cases)
  {
    const PolygonMeasure measure = measurePolygon(points, loop);
    EXPECT_EQ(measure.area, Vec3(Vec3::Zero()));
    EXPECT_LT((measure.centroid - mean).norm(), 1e-14);
  }
}

TEST(CellMeasureInOrder, OfTetrahedraIsExact)
{
  RandomShapes shapes(7);
  const std::vector<Loop> faces{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}};
  for (int round = 0; round < 100; ++round)
  {
    const std::vector<Vec3> p{shapes.place(), shapes.place(), shapes.place(), shapes.place()};
    const CellMeasureInOrder cell = measureCellOf(p, faces);
    const double volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
    EXPECT_NEAR(cell.volume, volume, 1e-12) << "negative if the corners run the other way";
    EXPECT_LT((cell.centroid - 0.25 * (p[0] + p[1] + p[2] + p[3])).norm(), 1e-9 / std::abs(volume)) << round;
  }
}

TEST(CellMeasureInOrder, OfAPyramidLiesAQuarterAboveItsBase)
{
  const std::vector<Vec3> points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {4, 5, 4}};
  const CellMeasureInOrder cell = measureCellOf(points, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  EXPECT_NEAR(cell.volume, 16.0 / 3.0, 1e-12);
  EXPECT_LT((cell.centroid - Vec3(0.75 + 1.0, 0.75 + 1.25, 1.0)).norm(), 1e-12);
}

TEST(CellMeasureInOrder, OfFlatCellsIsTheMeanOfFaceCentroids)
{
  const std::vector<Vec3> points{{0, 0, 0}, {6, 0, 0}, {0, 3, 0}};
  const CellMeasureInOrder flat = measureCellOf(points, {{0, 1, 2}, {2, 1, 0}, {0, 1, 1}});
  EXPECT_EQ(flat.volume, 0.0);
  EXPECT_LT((flat.centroid - (Vec3(4, 2, 0) + Vec3(4, 0, 0)) / 3.0).norm(), 1e-12);
  const CellMeasureInOrder none = measureCellOf(points, {});
  EXPECT_EQ(none.volume, 0.0);
  EXPECT_EQ(none.centroid, Vec3(Vec3::Zero()));
}

TEST(MeshGeometry, TurnsFacesOutOfTheirNeighbors)
{
  const SampleMesh sample = mixedCells({3, 3, 3}, 2, 0.2);
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const ThreadExecutor threads(3);
  const MeasuredMesh measured = measureMesh(mesh, quietContext(threads));
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const PolygonMeasure face = measurePolygon(mesh.points, mesh.face(f));
    EXPECT_EQ(measured.geometry.faceAreas[f], face.area);
    EXPECT_EQ(measured.geometry.faceCentroids[f], face.centroid);
  }
  double all = 0.0;
  for (std::size_t cell = 0; cell < mesh.cellCount; ++cell)
  {
    const CellMeasureInOrder own = measureCellOf(sample.points, facesOf(sample, cell));
    EXPECT_NEAR(measured.geometry.cellVolumes[cell], own.volume, 1e-12);
    EXPECT_LT((measured.geometry.cellCentroids[cell] - own.centroid).norm(), 1e-10);
    all += own.volume;
  }
  EXPECT_NEAR(all, 27.0, 1e-9);
}

} // namespace
