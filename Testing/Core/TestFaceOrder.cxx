// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the faces of cells, their order in a mesh, and how faces and cells are measured.
#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/Geometry.h"
#include "Quality/Faces/HalfFaces.h"
#include "Quality/Faces/InOrder.h"
#include "Quality/Faces/NativeCells.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <Eigen/Geometry>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::hexahedra;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::SampleMesh;
using ::testing::HasSubstr;
using Loop = std::vector<Index>;

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

TEST(CellShapes, HaveCornersAndFacesThatFitEuler)
{
  const std::map<unsigned char, std::array<std::size_t, 2>> sizes{{tetrahedronCell, {4, 4}},
                                                                  {voxelCell, {8, 6}},
                                                                  {hexahedronCell, {8, 6}},
                                                                  {wedgeCell, {6, 5}},
                                                                  {pyramidCell, {5, 5}}};
  for (int type = 0; type < 256; ++type)
  {
    const CellShape shape = shapeOf(static_cast<unsigned char>(type));
    const auto found = sizes.find(static_cast<unsigned char>(type));
    const std::array<std::size_t, 2> size = found == sizes.end() ? std::array<std::size_t, 2>{} : found->second;
    EXPECT_EQ(shape.corners, size[0]) << type;
    EXPECT_EQ(shape.faces.size(), size[1]) << type;
    std::set<std::array<int, 2>> edges; // directed: each edge is there once in each direction
    for (const LocalFace& face : shape.faces)
    {
      for (int i = 0; i < face.size; ++i)
      {
        edges.insert({face.corners[i], face.corners[(i + 1) % face.size]});
      }
    }
    EXPECT_EQ(shape.corners + shape.faces.size(), found == sizes.end() ? 0 : edges.size() / 2 + 2) << type;
  }
}

// Half-faces.

/// Leaves out repeated corners.
Loop withoutRepeats(Loop loop)
{
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.back() == loop.front())
  {
    loop.pop_back();
  }
  return loop;
}

/// Returns the faces of a cell of a sample as written, corner by corner.
std::vector<Loop> rawFaces(const SampleMesh& sample, std::size_t cell)
{
  std::vector<Loop> faces;
  const auto first = static_cast<std::size_t>(sample.offsets[cell]);
  for (const LocalFace& local : shapeOf(sample.types[cell]).faces)
  {
    faces.emplace_back();
    for (int i = 0; i < local.size; ++i)
    {
      faces.back().push_back(static_cast<Index>(sample.connectivity[first + local.corners[i]]));
    }
  }
  if (sample.types[cell] == polyhedronCell)
  {
    sample.view().faces.each(cell, [&](const IdView& points) {
      faces.emplace_back();
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        faces.back().push_back(static_cast<Index>(points[i]));
      }
    });
  }
  return faces;
}

/// Returns the faces of a cell that have three corners at least.
std::vector<Loop> facesOf(const SampleMesh& sample, std::size_t cell)
{
  std::vector<Loop> faces = rawFaces(sample, cell);
  std::ranges::transform(faces, faces.begin(), withoutRepeats);
  std::erase_if(faces, [](const Loop& loop) { return loop.size() < 3; });
  return faces;
}

void expectHalfFaces(const HalfFaces& halves, const SampleMesh& sample)
{
  ASSERT_EQ(halves.cellOffsets.size(), sample.types.size() + 1);
  ASSERT_EQ(halves.cellOffsets[0], 0U);
  std::size_t h = 0;
  for (std::size_t cell = 0; cell < sample.types.size(); ++cell)
  {
    for (const Loop& loop : facesOf(sample, cell))
    {
      ASSERT_LT(h, halves.count());
      EXPECT_TRUE(std::ranges::equal(halves.face(h), loop)) << "half-face " << h;
      EXPECT_EQ(halves.cell[h++], cell);
    }
    EXPECT_EQ(halves.cellOffsets[cell + 1], h);
  }
  EXPECT_EQ(halves.count(), h);
  EXPECT_EQ(halves.offsets.size(), h + 1);
  EXPECT_EQ(halves.offsets.back(), halves.points.size());
}

HalfFaces halvesOf(const SampleMesh& sample, int threads = 1)
{
  return takeApart(sample.view(), sample.points.size(), ThreadExecutor(threads));
}

/// Cells whose corners are drawn from a few points, so that many coincide.
SampleMesh cellsWithRepeats(unsigned seed)
{
  std::mt19937 random(seed);
  SampleMesh sample;
  sample.points.resize(1 + seed % 7);
  const auto some = [&](std::size_t count) {
    std::vector<std::int64_t> ids(count);
    std::ranges::generate(ids, [&] { return static_cast<std::int64_t>(random() % sample.points.size()); });
    return ids;
  };
  for (int i = 0; i < 20; ++i)
  {
    sample.addCell(tetrahedronCell, some(4));
    sample.addCell(hexahedronCell, some(8));
    sample.addCell(voxelCell, some(8));
    sample.addCell(wedgeCell, some(6));
    sample.addCell(pyramidCell, some(5));
    sample.addPolyhedron({some(1), some(3), some(6), some(2), some(4)});
  }
  return sample;
}

TEST(HalfFaces, AreTheFacesOfEachCellInTurn)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    const SampleMesh sample = mixedCells({3, 3, 3}, seed);
    expectHalfFaces(halvesOf(sample), sample);
  }
}

TEST(HalfFaces, LeaveOutRepeatedCornersAndFacesWithFewerThanThree)
{
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE(seed);
    const SampleMesh sample = cellsWithRepeats(seed);
    expectHalfFaces(halvesOf(sample), sample);
  }
}

TEST(HalfFaces, OfSeveralPiecesAreTheSameOnSeveralThreads)
{
  const SampleMesh sample = hexahedra({2, 30, 70}); // more than one piece of cells
  const HalfFaces one = halvesOf(sample);
  const HalfFaces three = halvesOf(sample, 3);
  EXPECT_EQ(one.cellOffsets, three.cellOffsets);
  EXPECT_EQ(one.offsets, three.offsets);
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.cell, three.cell);
  expectHalfFaces(three, sample);
}

TEST(HalfFaces, OfNoCellsAreNone)
{
  const HalfFaces halves = halvesOf({});
  EXPECT_EQ(halves.count(), 0U);
  EXPECT_EQ(halves.cellOffsets, (Buffer<Index>{0}));
  EXPECT_EQ(halves.offsets, (Buffer<Index>{0}));
}

/// Returns the message of takeApart(), or nothing.
std::string errorOf(const SampleMesh& sample)
{
  try
  {
    halvesOf(sample);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return {};
}

TEST(HalfFacesError, NamesTheFirstCellThatIsWrong)
{
  struct Case
  {
    std::function<void(SampleMesh&)> spoil;
    const char* text;
  };
  const std::vector<Case> cases{
      {[](SampleMesh&) {}, ""},
      {[](SampleMesh& m) { m.points.pop_back(); }, "cell 2 (type 10) has point 11"},
      {[](SampleMesh& m) { m.connectivity[9] = 12; }, "cell 1 (type 12) has point 12"},
      {[](SampleMesh& m) { m.connectivity[4] = -1; }, "cell 1 (type 12) has point -1"},
      {[](SampleMesh& m) { m.types[1] = 5; }, "cell 1 (type 5) is of a type"},
      {[](SampleMesh& m) { m.offsets[1] = 3; }, "cell 0 (type 10) has 3 points instead of 4"},
      {[](SampleMesh& m) { m.offsets[2] = 13; }, "cell 1 (type 12) has 9 points instead of 8"},
      {[](SampleMesh& m) { m.offsets[0] = -1; }, "cell 0 (type 10) has 5 points"},
      {[](SampleMesh& m) { m.connectivity.pop_back(); }, "cell 2 (type 10)"},
      {[](SampleMesh& m) { m.types[0] = polyhedronCell; }, "cell 0 (type 42) has no complete list of faces"},
      {[](SampleMesh& m) { m.offsets.pop_back(); }, "do not fit together"},
      {[](SampleMesh& m) { m.offsets.push_back(16); }, "do not fit together"}};
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    SampleMesh sample;
    sample.points.resize(12);
    sample.addCell(tetrahedronCell, {0, 1, 2, 3});
    sample.addCell(hexahedronCell, {0, 1, 2, 3, 4, 5, 6, 7});
    sample.addCell(tetrahedronCell, {8, 9, 10, 11});
    cases[i].spoil(sample);
    EXPECT_THAT(errorOf(sample), HasSubstr(cases[i].text)) << "case " << i;
    EXPECT_EQ(errorOf(sample).empty(), *cases[i].text == 0) << "case " << i;
  }
}

TEST(HalfFaces, HaveTheSamePointsInAnyOrder)
{
  const auto same = [](const Loop& a, const Loop& b) { return samePoints(a, b); };
  EXPECT_TRUE(same({}, {}));
  EXPECT_TRUE(same({1, 2, 3}, {3, 1, 2}));
  EXPECT_TRUE(same({1, 2, 3}, {3, 2, 1}));
  EXPECT_TRUE(same({1, 1, 2}, {1, 2, 1}));
  EXPECT_FALSE(same({1, 1, 2}, {1, 2, 2}));
  EXPECT_FALSE(same({1, 2, 3}, {1, 2, 4}));
  EXPECT_FALSE(same({1, 2, 3}, {1, 2}));
  EXPECT_FALSE(same({1, 2}, {1, 2, 3}));
}

TEST(HalfFaces, AreCopiedToTheLastPointAndNoFurther)
{
  for (std::size_t size = 0; size < 8; ++size)
  {
    Loop face(size);
    std::iota(face.begin(), face.end(), Index{10});
    Loop to(9, 7);
    copyPoints(face, to.data());
    Loop expected(9, 7);
    std::ranges::copy(face, expected.begin());
    EXPECT_EQ(to, expected) << size;
  }
}

// Faces of a mesh, against pairs of half-faces that are compared one by one.

/// Faces by their sorted points: owner, neighbor, and the loop as the owner sees it.
struct NaiveFace
{
  Index owner;
  Index neighbor;
  Loop loop;
};

std::vector<NaiveFace> naiveFaces(const SampleMesh& sample)
{
  std::vector<NaiveFace> all;
  for (Index cell = 0; cell < sample.types.size(); ++cell)
  {
    for (const Loop& loop : facesOf(sample, cell))
    {
      const auto other = std::ranges::find_if(all, [&](const NaiveFace& face) { return samePoints(face.loop, loop); });
      if (other == all.end())
      {
        all.push_back({cell, noIndex, loop});
      }
      else
      {
        other->neighbor = cell;
      }
    }
  }
  std::ranges::stable_sort(all, [](const NaiveFace& a, const NaiveFace& b) {
    const auto key = [](const NaiveFace& f) {
      return std::tuple(f.neighbor == noIndex, f.owner, f.neighbor == noIndex ? 0 : f.neighbor);
    };
    return key(a) < key(b);
  });
  return all;
}

TEST(FaceOrder, IsOwnerByOwnerThenNeighborByNeighborThenTheBoundary)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    SCOPED_TRACE(seed);
    const SampleMesh sample = mixedCells({3, 2, 3}, seed);
    const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
    const std::vector<NaiveFace> faces = naiveFaces(sample);
    ASSERT_EQ(mesh.faceCount(), faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      EXPECT_EQ(mesh.owner[f], faces[f].owner) << f;
      EXPECT_EQ(f < mesh.internalFaceCount() ? mesh.neighbor[f] : noIndex, faces[f].neighbor) << f;
      EXPECT_TRUE(std::ranges::equal(mesh.face(f), faces[f].loop)) << f;
    }
  }
}

TEST(FaceOrder, FindsEachFaceByItsCellAndPoints)
{
  const SampleMesh sample = mixedCells({3, 3, 2}, 4);
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const std::size_t internal = mesh.internalFaceCount();
  std::vector<std::vector<std::int64_t>> points;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    points.emplace_back(mesh.face(f).rbegin(), mesh.face(f).rend());
  }
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const auto face = static_cast<Index>(f);
    const bool isInternal = f < internal;
    const Index neighbor = isInternal ? mesh.neighbor[f] : noIndex;
    const std::vector<BoundaryFaceKey> keys{{mesh.owner[f], points[f]}, {mesh.owner[f] + 1, points[f]}};
    EXPECT_EQ(findBoundaryFaces(mesh, keys), (Loop{isInternal ? noIndex : face, noIndex})) << f;
    EXPECT_EQ(findInternalFaces(mesh, keys, Loop{neighbor, neighbor})[0], isInternal ? face : noIndex) << f;
    if (isInternal)
    {
      const std::vector<BoundaryFaceKey> turned{{neighbor, points[f]}, {neighbor, points[(f + 1) % internal]}};
      EXPECT_EQ(findInternalFaces(mesh, turned, Loop{mesh.owner[f], mesh.owner[f]})[0], face) << f;
    }
  }
}

TEST(FaceOrder, PutsTheLowerCellFirst)
{
  const OrderedFace kept = orderFace(5, 1, 2);
  EXPECT_EQ(kept, (OrderedFace{false, 1, 2, 5, false}));
  EXPECT_EQ(orderFace(5, 2, 1), (OrderedFace{false, 1, 2, 5, true}));
  EXPECT_EQ(orderFace(5, 3, noIndex), (OrderedFace{true, 3, noIndex, 5, false}));
  EXPECT_EQ(orderFace(5, noIndex, 3), (OrderedFace{true, 3, noIndex, 5, true}));
}

TEST(FaceOrder, SortsInternalFacesBeforeAllOthers)
{
  const std::vector<OrderedFace> inOrder{orderFace(9, 0, 1),      orderFace(2, 3, 0),       orderFace(3, 0, 3),
                                         orderFace(1, 2, 1),      orderFace(7, 0, noIndex), orderFace(8, noIndex, 0),
                                         orderFace(0, 4, noIndex)};
  EXPECT_TRUE(std::ranges::is_sorted(inOrder));
  EXPECT_LT(orderFace(1, 9, 8), orderFace(0, 0, noIndex));
  EXPECT_LT(orderFace(3, 1, 2), orderFace(4, 1, 2)) << "faces between the same cells keep their order";
}

TEST(FaceOrder, AppendsFacesAsTheirOwnersSeeThem)
{
  FaceMesh mesh;
  appendFace(mesh, orderFace(0, 0, 1), Loop{4, 5, 6});
  appendFace(mesh, orderFace(1, 2, 1), Loop{1, 2, 3, 7});
  appendFace(mesh, orderFace(2, 3, noIndex), Loop{8, 9, 4});
  appendFace(mesh, orderFace(3, noIndex, 4), Loop{1, 2, 3});
  EXPECT_EQ(mesh.owner, (Buffer<Index>{0, 1, 3, 4}));
  EXPECT_EQ(mesh.neighbor, (Buffer<Index>{1, 2}));
  EXPECT_EQ(mesh.faceOffsets, (Buffer<Index>{0, 3, 7, 10, 13}));
  EXPECT_EQ(mesh.facePoints, (Buffer<Index>{4, 5, 6, 7, 3, 2, 1, 8, 9, 4, 3, 2, 1}));
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

// Geometry.

class RandomShapes
{
public:
  explicit RandomShapes(unsigned seed) : random(seed) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 place() { return {in(-2, 2), in(-2, 2), in(-2, 2)}; }
  /// Points on a circle that is squeezed and turned, counterclockwise around `normal`.
  std::vector<Vec3> convexPolygon(std::size_t size, Vec3& normal)
  {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
    const Vec3 shift = place();
    const double squeezed = in(0.2, 1.0);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < size; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + in(0.0, 0.9)) / static_cast<double>(size);
      points.push_back(turn * Vec3(std::cos(angle), squeezed * std::sin(angle), 0.0) + shift);
    }
    normal = turn * Vec3::UnitZ();
    return points;
  }

private:
  std::mt19937 random;
};

Loop upTo(std::size_t count)
{
  Loop loop(count);
  std::iota(loop.begin(), loop.end(), Index{0});
  return loop;
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

CellMeasureInOrder measureCellOf(const std::vector<Vec3>& points, const std::vector<Loop>& faces)
{
  return measureCellInOrder(faces.size(), [&](std::size_t i) { return measurePolygon(points, faces[i]); });
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

// Parts of faces, for formats without polyhedra.

/// Returns the triangles of the fan from the lowest-numbered corner that sees the whole polygon; from the lowest corner
/// if there is none.
std::set<Loop> fanOf(const std::vector<Vec3>& points, const Loop& face)
{
  const Vec3 normal = measurePolygon(points, face).area;
  const std::size_t size = face.size();
  Loop starts = face;
  std::ranges::sort(starts);
  starts.push_back(starts.front());
  std::set<Loop> triangles;
  for (const Index start : starts)
  {
    triangles.clear();
    const auto from = static_cast<std::size_t>(std::ranges::find(face, start) - face.begin());
    bool fits = true;
    for (std::size_t i = 1; i + 1 < size; ++i)
    {
      Loop part{start, face[(from + i) % size], face[(from + i + 1) % size]};
      fits = fits && measurePolygon(points, part).area.dot(normal) > 0.0;
      std::ranges::sort(part);
      triangles.insert(part);
    }
    if (fits)
    {
      break;
    }
  }
  return triangles;
}

TEST(DividedFaces, AreFansFromTheLowestCornerThatSeesAll)
{
  RandomShapes shapes(11);
  std::mt19937 random(13);
  for (int round = 0; round < 300; ++round)
  {
    Loop face = upTo(5 + static_cast<std::size_t>(round % 4));
    Vec3 normal;
    std::vector<Vec3> points = shapes.convexPolygon(face.size(), normal);
    for (int dent = 0; dent < round % 3; ++dent) // corners that not all others see
    {
      Vec3& corner = points[random() % points.size()];
      corner += 0.8 * (measurePolygon(points, face).centroid - corner);
    }
    std::vector<Vec3> renamed = points;
    Loop names = face;
    std::ranges::shuffle(names, random);
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      renamed[names[i]] = points[i];
    }
    const std::set<Loop> expected = fanOf(renamed, names);
    for (int side = 0; side < 2; ++side)
    {
      std::set<Loop> found;
      const Vec3 area = measurePolygon(renamed, names).area;
      Vec3 sum = Vec3::Zero();
      divideFace(renamed, names, [&](std::span<const Index> part) {
        sum += measurePolygon(renamed, part).area;
        Loop sorted(part.begin(), part.end());
        std::ranges::sort(sorted);
        found.insert(sorted);
      });
      EXPECT_EQ(found, expected) << round;
      EXPECT_LT((sum - area).norm(), 1e-12) << "triangles are wound as the face";
      std::ranges::reverse(names);
    }
  }
}

TEST(DividedFaces, OfUpToFourCornersStayWhole)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const Loop& face : {Loop{2, 0, 1}, Loop{3, 0, 1, 2}})
  {
    std::vector<Loop> parts;
    divideFace(points, face, [&](std::span<const Index> part) { parts.emplace_back(part.begin(), part.end()); });
    EXPECT_EQ(parts, std::vector<Loop>{face});
  }
}

TEST(NativeCells, KeepTheVolumesOfAllCells)
{
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    const SampleMesh sample = mixedCells({3, 3, 3}, seed, 0.1);
    const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
    const CellFaces cellFaces = makeCellFaces(mesh);
    const NativeCells native = makeNativeCells(mesh, cellFaces, sample.view(), {}, quietContext().progress);
    SampleMesh made;
    made.points = sample.points;
    made.points.insert(made.points.end(), native.apices.begin(), native.apices.end());
    for (std::size_t cell = 0; cell < native.types.size(); ++cell)
    {
      made.addCell(native.types[cell], {native.cornersOf(cell).begin(), native.cornersOf(cell).end()});
      EXPECT_GT(measureCellOf(made.points, facesOf(made, cell)).volume, 0.0);
    }
    const auto polyhedra = static_cast<std::size_t>(std::ranges::count(sample.types, polyhedronCell));
    EXPECT_EQ(native.dividedPolyhedra, polyhedra);
    EXPECT_EQ(native.apices.size(), polyhedra);
    EXPECT_EQ(native.invertedCells, 0U);
    EXPECT_EQ(std::ranges::count(native.types, voxelCell), 0);
    const FaceMesh again = makeFaceMesh(made.points, made.view());
    EXPECT_EQ(again.faceCount() - again.internalFaceCount(), mesh.faceCount() - mesh.internalFaceCount())
        << "parts meet without gaps";
  }
}

} // namespace
