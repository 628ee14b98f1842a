// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the shapes of cells and the faces that cells are taken apart into.
#include "FaceSamples.h"
#include "Quality/Faces/CellShapes.h"
#include "Quality/Faces/HalfFaces.h"
#include "Support/Error.h"
#include "Support/SampleMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace atria;
using atria::testing::facesOf;
using atria::testing::hexahedra;
using atria::testing::Loop;
using atria::testing::mixedCells;
using atria::testing::SampleMesh;
using ::testing::HasSubstr;

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

} // namespace
