// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of polyhedra in both of the forms that VTK has had.
#include "Quality/Faces/CellArrays.h"
#include "Quality/Faces/FaceMesh.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

namespace {

using namespace atria;
using ::testing::ElementsAre;
using Faces = std::vector<std::vector<std::int64_t>>;
using Ids = std::vector<std::int64_t>;

/// Those of a cell, and whether its lists were whole.
std::pair<Faces, bool> facesOf(const PolyhedronFaces& faces, std::size_t cell)
{
  std::pair<Faces, bool> out;
  out.second = faces.each(cell, [&](const IdView& points) {
    out.first.emplace_back();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      out.first.back().push_back(points[i]);
    }
  });
  return out;
}

/// Two polyhedra with a cell between them that is none.
struct Stream
{
  Ids stream{2, 3, 0, 1, 2, 4, 0, 1, 3, 4, 1, 3, 5, 6, 7};
  Ids locations{0, -1, 10};
  PolyhedronFaces view() const { return PolyhedronFaces::Stream(stream, locations); }
};

struct Lists
{
  Ids cellOffsets{0, 2, 2, 3};
  std::vector<std::int32_t> cellFaces{1, 0, 2};
  Ids faceOffsets{0, 4, 7, 10};
  std::vector<std::int32_t> points{0, 1, 3, 4, 0, 1, 2, 5, 6, 7};
  PolyhedronFaces view() const { return PolyhedronFaces::Lists(cellOffsets, cellFaces, faceOffsets, points); }
};

template <typename Form> class PolyhedronFacesIn : public ::testing::Test
{
};
using Forms = ::testing::Types<Stream, Lists>;
TYPED_TEST_SUITE(PolyhedronFacesIn, Forms);

TYPED_TEST(PolyhedronFacesIn, EitherFormAreTheSame)
{
  const TypeParam form;
  EXPECT_EQ(facesOf(form.view(), 0), std::pair(Faces({{0, 1, 2}, {0, 1, 3, 4}}), true));
  EXPECT_EQ(facesOf(form.view(), 2), std::pair(Faces({{5, 6, 7}}), true));
}

TYPED_TEST(PolyhedronFacesIn, EitherFormEndWithTheCells)
{
  const TypeParam form;
  EXPECT_FALSE(facesOf(form.view(), 3).second);
  EXPECT_FALSE(facesOf(PolyhedronFaces(), 0).second);
}

TYPED_TEST(PolyhedronFacesIn, EitherFormAreAppendedToAStreamWithNewPoints)
{
  const TypeParam form;
  Ids stream{9};
  EXPECT_TRUE(appendFaces(
      form.view(), 0, [](std::int64_t p) { return p + 10; }, stream));
  EXPECT_THAT(stream, ElementsAre(9, 2, 3, 10, 11, 12, 4, 10, 11, 13, 14));
}

TEST(PolyhedronFaces, OfADamagedStreamStopAtItsEnd)
{
  for (std::size_t length = 0; length < 10; ++length)
  {
    Stream form;
    form.stream.resize(length);
    EXPECT_FALSE(facesOf(form.view(), 0).second) << length;
  }
  Stream negative;
  negative.stream[1] = -3;
  EXPECT_FALSE(facesOf(negative.view(), 0).second);
  negative.stream[1] = std::numeric_limits<std::int64_t>::max();
  EXPECT_FALSE(facesOf(negative.view(), 0).second);
}

TEST(PolyhedronFaces, OfDamagedListsStopAtTheirEnds)
{
  const auto expectDamaged = [](auto&& damage) {
    Lists form;
    damage(form);
    EXPECT_FALSE(facesOf(form.view(), 0).second);
  };
  expectDamaged([](Lists& lists) { lists.cellOffsets[1] = 5; });
  expectDamaged([](Lists& lists) { lists.cellOffsets[0] = -1; });
  expectDamaged([](Lists& lists) { lists.cellFaces[0] = 3; });
  expectDamaged([](Lists& lists) { lists.cellFaces[1] = -1; });
  expectDamaged([](Lists& lists) { lists.faceOffsets[2] = 11; });
  expectDamaged([](Lists& lists) { lists.faceOffsets[1] = 9; });
}

/// A tetrahedron as a polyhedron has the same faces in either form.
TEST(PolyhedronFaces, MakeTheSameMesh)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<unsigned char> types{42};
  const Ids offsets{0, 4};
  const Ids corners{0, 1, 2, 3};
  const Ids stream{4, 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3};
  const Ids locations{0};
  const Ids cellOffsets{0, 4};
  const Ids cellFaces{0, 1, 2, 3};
  const Ids faceOffsets{0, 3, 6, 9, 12};
  const Ids facePoints{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  const FaceMesh one = makeFaceMesh(points, {types, offsets, corners, PolyhedronFaces::Stream(stream, locations)});
  const FaceMesh other = makeFaceMesh(
      points, {types, offsets, corners, PolyhedronFaces::Lists(cellOffsets, cellFaces, faceOffsets, facePoints)});
  ASSERT_EQ(one.faceCount(), 4u);
  EXPECT_TRUE(std::ranges::equal(one.facePoints, other.facePoints));
  EXPECT_TRUE(std::ranges::equal(one.owner, other.owner));
}

} // namespace
