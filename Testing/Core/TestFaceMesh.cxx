// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/FaceMesh.h"
#include "Quality/Faces/Geometry.h"
#include "Support/Error.h"
#include "Support/SampleMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace {

using atria::FaceMesh;
using atria::Index;
using atria::Vec3;
using atria::testing::SampleMesh;
using atria::testing::singleCell;

/// What every face mesh must keep.
void expectWellOrdered(const FaceMesh& mesh)
{
  ASSERT_EQ(mesh.faceOffsets.size(), mesh.faceCount() + 1);
  ASSERT_EQ(mesh.faceOffsets.back(), mesh.facePoints.size());
  std::pair<Index, Index> before{0, 0};
  for (std::size_t f = 0; f < mesh.internalFaceCount(); ++f)
  {
    EXPECT_LT(mesh.owner[f], mesh.neighbor[f]);
    const std::pair now{mesh.owner[f], mesh.neighbor[f]};
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_TRUE(std::is_sorted(mesh.owner.begin() + mesh.internalFaceCount(), mesh.owner.end()));
}

/// Every edge of a closed cell lies in two of its faces, once in each direction.
void expectClosedCells(const FaceMesh& mesh)
{
  std::vector<std::multiset<std::pair<Index, Index>>> edges(mesh.cellCount);
  const auto add = [&](std::size_t f, Index cell, bool turned) {
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      const Index a = face[i];
      const Index b = face[(i + 1) % face.size()];
      edges[cell].insert(turned ? std::pair(b, a) : std::pair(a, b));
    }
  };
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    add(f, mesh.owner[f], false);
    if (f < mesh.internalFaceCount())
    {
      add(f, mesh.neighbor[f], true);
    }
  }
  for (const auto& ofCell : edges)
  {
    for (const auto& [a, b] : ofCell)
    {
      EXPECT_EQ(ofCell.count({a, b}), 1u);
      EXPECT_EQ(ofCell.count({b, a}), 1u);
    }
  }
}

Vec3 normalOf(const FaceMesh& mesh, std::size_t f)
{
  const auto face = mesh.face(f);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < face.size(); ++i)
  {
    const Vec3 a = mesh.points[face[i - 1]] - mesh.points[face[0]];
    const Vec3 b = mesh.points[face[i]] - mesh.points[face[0]];
    sum += Vec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  }
  return sum;
}

std::string errorOf(const SampleMesh& mesh)
{
  try
  {
    makeFaceMesh(mesh.points, mesh.view());
  }
  catch (const atria::Error& error)
  {
    return error.what();
  }
  return {};
}

TEST(FaceMesh, CountsTheFacesOfABlockOfCubes)
{
  const SampleMesh sample = atria::testing::hexahedra({4, 3, 2});
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  EXPECT_EQ(mesh.cellCount, 24u);
  EXPECT_EQ(mesh.internalFaceCount(), 3u * 3 * 2 + 4 * 2 * 2 + 4 * 3 * 1);
  EXPECT_EQ(mesh.faceCount() - mesh.internalFaceCount(), 2u * (12 + 8 + 6));
  expectWellOrdered(mesh);
  expectClosedCells(mesh);
}

TEST(FaceMesh, FacesOfEveryCellTypePointOutward)
{
  const std::vector<SampleMesh> cells{
      singleCell(atria::tetrahedronCell, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}),
      singleCell(atria::voxelCell,
                 {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}),
      singleCell(atria::hexahedronCell,
                 {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}),
      singleCell(atria::wedgeCell, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}}),
      singleCell(atria::pyramidCell, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}})};
  for (const SampleMesh& cell : cells)
  {
    const FaceMesh mesh = makeFaceMesh(cell.points, cell.view());
    const Vec3 center = std::accumulate(mesh.points.begin(), mesh.points.end(), Vec3(0, 0, 0)) /
                        static_cast<double>(mesh.points.size());
    for (std::size_t f = 0; f < mesh.faceCount(); ++f)
    {
      EXPECT_GT(normalOf(mesh, f).dot(mesh.points[mesh.face(f)[0]] - center), 0) << "type " << int(cell.types[0]);
    }
    expectClosedCells(mesh);
  }
}

TEST(FaceMesh, JoinsCellsOfAllTypesWithoutGaps)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    const SampleMesh sample = atria::testing::mixedCells({3, 4, 3}, seed, 0.2);
    const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
    expectWellOrdered(mesh);
    expectClosedCells(mesh);
    // Only the box's own surface is left: unit squares, as the faces on it are not cut but on the bottom.
    for (std::size_t f = mesh.internalFaceCount(); f < mesh.faceCount(); ++f)
    {
      const Vec3 n = normalOf(mesh, f);
      EXPECT_NEAR(n.cwiseAbs().maxCoeff(), n.norm(), 1e-12);
    }
  }
}

TEST(FaceMesh, IsTheSameMeshForAnyCellOrder)
{
  const SampleMesh sample = atria::testing::mixedCells({3, 3, 3}, 1);
  std::vector<std::size_t> order(sample.types.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  SampleMesh shuffled;
  shuffled.points = sample.points;
  shuffled.faceStream = sample.faceStream;
  for (const std::size_t c : order)
  {
    shuffled.addCell(sample.types[c], {sample.connectivity.begin() + sample.offsets[c],
                                       sample.connectivity.begin() + sample.offsets[c + 1]});
    shuffled.faceLocations.back() = sample.faceLocations[c];
  }
  const FaceMesh a = makeFaceMesh(sample.points, sample.view());
  const FaceMesh b = makeFaceMesh(shuffled.points, shuffled.view());
  expectWellOrdered(b);
  EXPECT_EQ(a.faceCount(), b.faceCount());
  std::set<std::pair<Index, Index>> pairsA;
  std::set<std::pair<Index, Index>> pairsB;
  for (std::size_t f = 0; f < b.internalFaceCount(); ++f)
  {
    pairsA.insert(std::minmax(a.owner[f], a.neighbor[f]));
    pairsB.insert(std::minmax(static_cast<Index>(order[b.owner[f]]), static_cast<Index>(order[b.neighbor[f]])));
  }
  EXPECT_EQ(pairsA, pairsB);
}

TEST(FaceMesh, IsTheSameForAnyNumberOfThreads)
{
  const SampleMesh sample = atria::testing::mixedCells({25, 25, 25}, 11, 0.3);
  const FaceMesh one = makeFaceMesh(sample.points, sample.view());
  const atria::CellFaces facesOfOne = makeCellFaces(one);
  for (const int threads : {2, 7})
  {
    const FaceMesh many = makeFaceMesh(sample.points, sample.view(), {}, atria::ThreadExecutor(threads));
    EXPECT_EQ(many.owner, one.owner);
    EXPECT_EQ(many.neighbor, one.neighbor);
    EXPECT_EQ(many.faceOffsets, one.faceOffsets);
    EXPECT_EQ(many.facePoints, one.facePoints);
    const atria::CellFaces cellFaces = makeCellFaces(many, atria::ThreadExecutor(threads));
    EXPECT_EQ(cellFaces.offsets, facesOfOne.offsets);
    EXPECT_EQ(cellFaces.entries, facesOfOne.entries);
  }
}

TEST(FaceMesh, CellsKnowTheFacesTheyOwnFirst)
{
  const SampleMesh sample = atria::testing::mixedCells({6, 6, 6}, 3, 0.2);
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const atria::CellFaces cellFaces = makeCellFaces(mesh);
  std::size_t sides = 0;
  for (Index c = 0; c < mesh.cellCount; ++c)
  {
    const auto faces = cellFaces.of(c);
    sides += faces.size();
    const auto owned = [&](Index f) { return mesh.owner[f] == c; };
    EXPECT_TRUE(std::is_partitioned(faces.begin(), faces.end(), owned));
    const auto others = std::find_if_not(faces.begin(), faces.end(), owned);
    EXPECT_TRUE(std::is_sorted(faces.begin(), others) && std::is_sorted(others, faces.end()));
    EXPECT_TRUE(std::all_of(others, faces.end(), [&](Index f) { return mesh.neighbor[f] == c; }));
  }
  EXPECT_EQ(sides, mesh.faceCount() + mesh.internalFaceCount());
}

TEST(FaceMesh, KeysKeepBothSidesOfASheetOnTheBoundary)
{
  const SampleMesh sample = atria::testing::hexahedra({2, 1, 1});
  const FaceMesh joined = makeFaceMesh(sample.points, sample.view());
  ASSERT_EQ(joined.internalFaceCount(), 1u);
  std::vector<std::int64_t> front(joined.face(0).begin(), joined.face(0).end());
  const std::vector<std::int64_t> back(front.rbegin(), front.rend());
  const std::vector<atria::BoundaryFaceKey> keys{{0, front}, {1, back}};
  const FaceMesh split = makeFaceMesh(sample.points, sample.view(), keys);
  EXPECT_EQ(split.internalFaceCount(), 0u);
  EXPECT_EQ(split.faceCount(), 12u);
  const std::vector<Index> found = findBoundaryFaces(split, keys);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(split.owner[found[0]], 0u);
  EXPECT_EQ(split.owner[found[1]], 1u);
  expectClosedCells(split);
}

TEST(FaceMesh, OneKeyIsEnoughToPartTheSides)
{
  const SampleMesh sample = atria::testing::hexahedra({2, 1, 1});
  const FaceMesh joined = makeFaceMesh(sample.points, sample.view());
  const std::vector<std::int64_t> front(joined.face(0).begin(), joined.face(0).end());
  const std::vector<atria::BoundaryFaceKey> keys{{0, front}};
  EXPECT_EQ(makeFaceMesh(sample.points, sample.view(), keys).faceCount(), 12u);
}

TEST(FaceMesh, KeysThatAreNoFacesAreFoundOut)
{
  const SampleMesh sample = atria::testing::hexahedra({2, 1, 1});
  const std::vector<std::int64_t> nothing{0, 1, 2};
  const std::vector<atria::BoundaryFaceKey> keys{{0, nothing}, {77, nothing}};
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view(), keys);
  EXPECT_EQ(mesh.internalFaceCount(), 1u);
  EXPECT_EQ(findBoundaryFaces(mesh, keys), std::vector<Index>(2, atria::noIndex));
}

TEST(FaceMesh, TakesAHexahedronWithCoincidingCornersForWhatItIs)
{
  SampleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  mesh.addCell(atria::hexahedronCell, {0, 1, 2, 3, 4, 4, 4, 4});
  const FaceMesh faces = makeFaceMesh(mesh.points, mesh.view());
  EXPECT_EQ(faces.faceCount(), 5u);
  EXPECT_EQ(faces.facePoints.size(), 4u + 4 * 3);
  expectClosedCells(faces);
}

TEST(FaceMesh, TellsPolygonsThatShareTheirSmallestPointsApart)
{
  SampleMesh mesh; // open cells of one face each: only the matching matters here
  mesh.points.assign(7, Vec3(0, 0, 0));
  mesh.addPolyhedron({{0, 1, 2, 3, 4}});
  mesh.addPolyhedron({{0, 1, 2, 3, 5}});
  mesh.addPolyhedron({{0, 1, 2, 3}});
  mesh.addPolyhedron({{0, 1, 2, 3, 4, 6}});
  mesh.addPolyhedron({{4, 3, 2, 1, 0}});
  mesh.addPolyhedron({{3, 2, 1, 0}});
  mesh.addPolyhedron({{0, 1, 2}});
  const FaceMesh faces = makeFaceMesh(mesh.points, mesh.view());
  ASSERT_EQ(faces.internalFaceCount(), 2u);
  EXPECT_EQ(faces.faceCount(), 5u);
  EXPECT_EQ(faces.owner[0], 0u);
  EXPECT_EQ(faces.neighbor[0], 4u);
  EXPECT_EQ(faces.owner[1], 2u);
  EXPECT_EQ(faces.neighbor[1], 5u);
}

TEST(FaceMesh, EmptyMeshHasNoFaces)
{
  const SampleMesh empty;
  const FaceMesh mesh = makeFaceMesh(empty.points, empty.view());
  EXPECT_EQ(mesh.faceCount(), 0u);
  EXPECT_EQ(mesh.cellCount, 0u);
}

TEST(FaceMeshError, NamesTheCellsThatShareAFace)
{
  SampleMesh mesh = atria::testing::hexahedra({2, 1, 1});
  const FaceMesh joined = makeFaceMesh(mesh.points, mesh.view());
  mesh.points.emplace_back(3, 3, 3);
  mesh.addCell(atria::pyramidCell, {joined.face(0)[0], joined.face(0)[1], joined.face(0)[2], joined.face(0)[3], 12});
  EXPECT_THAT(errorOf(mesh), ::testing::HasSubstr("is shared by the cells 0 1 2"));
}

TEST(FaceMeshError, IsTheFirstForAnyNumberOfThreads)
{
  SampleMesh sample = atria::testing::hexahedra({30, 30, 30});
  for (const std::size_t cell : {25000, 9001, 14000})
  {
    sample.connectivity[8 * cell + 3] = 1000000 + static_cast<std::int64_t>(cell);
  }
  for (const int threads : {1, 7})
  {
    try
    {
      makeFaceMesh(sample.points, sample.view(), {}, atria::ThreadExecutor(threads));
      ADD_FAILURE() << "no error";
    }
    catch (const atria::Error& error)
    {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("cell 9001 "));
    }
  }
}

TEST(FaceMeshError, NamesACellOfUnknownType)
{
  SampleMesh mesh = atria::testing::hexahedra({1, 1, 1});
  mesh.addCell(9, {0, 1, 2, 3});
  EXPECT_THAT(errorOf(mesh), ::testing::HasSubstr("cell 1 (type 9)"));
}

TEST(FaceMeshError, NamesACellWithAPointThatIsNotThere)
{
  SampleMesh mesh = atria::testing::hexahedra({1, 1, 1});
  mesh.addCell(atria::tetrahedronCell, {0, 1, 2, 99});
  EXPECT_THAT(errorOf(mesh), ::testing::HasSubstr("cell 1 (type 10) has point 99"));
}

TEST(FaceMeshError, NamesAPolyhedronWithoutItsFaces)
{
  SampleMesh mesh = atria::testing::hexahedra({1, 1, 1});
  mesh.addCell(atria::polyhedronCell, {0, 1, 2, 3});
  EXPECT_THAT(errorOf(mesh), ::testing::HasSubstr("cell 1 (type 42) has no complete list of faces"));
}

} // namespace
