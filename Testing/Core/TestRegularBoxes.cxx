// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the boxes that lie among boxes, against their definition.
#include "CellSamples.h"
#include "Quality/Checks/RegularBoxes.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/SampleMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace {

using namespace atria;
using atria::testing::cornersOf;
using atria::testing::hexahedra;
using atria::testing::Ids;
using atria::testing::SampleMesh;
using ::testing::Each;

/// Place of each corner of VTK's hexahedron along x, y and z.
constexpr std::array<std::array<int, 3>, 8> places{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

bool isHexahedron(const SampleMesh& mesh, std::size_t cell)
{
  const Ids corners = cornersOf(mesh, cell);
  return mesh.types[cell] == hexahedronCell && corners.size() == 8 && std::ranges::all_of(corners, [&](std::int64_t p) {
           return p >= 0 && p < static_cast<std::int64_t>(mesh.points.size());
         });
}

bool isBox(const SampleMesh& mesh, std::size_t cell)
{
  if (!isHexahedron(mesh, cell))
  {
    return false;
  }
  const Ids corners = cornersOf(mesh, cell);
  const Vec3 low = mesh.points[corners[0]];
  const Vec3 size = mesh.points[corners[6]] - low;
  bool same = size.minCoeff() > 0.0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3& expected = places[i][axis] != 0 ? mesh.points[corners[6]] : low;
      same = same && mesh.points[corners[i]][axis] == expected[axis];
    }
  }
  return same;
}

/// Regular boxes by their definition: eight boxes lie around each corner, each at another place.
struct NaiveBoxes
{
  NaiveBoxes(const SampleMesh& mesh, const Ids& apart) : isRegular(mesh.types.size()), isTouched(mesh.points.size())
  {
    std::vector<std::multiset<int>> placesAt(mesh.points.size());
    constexpr int noBox = 8;
    eachCorner(mesh, [&](std::size_t cell, std::size_t i, std::int64_t p) {
      placesAt[p].insert(isBox(mesh, cell) ? static_cast<int>(i) : noBox);
    });
    const auto isGood = [&](std::int64_t p) {
      return placesAt[p] == std::multiset<int>{0, 1, 2, 3, 4, 5, 6, 7} && std::ranges::count(apart, p) == 0;
    };
    for (std::size_t cell = 0; cell < isRegular.size(); ++cell)
    {
      isRegular[cell] = isBox(mesh, cell) && std::ranges::all_of(cornersOf(mesh, cell), isGood) ? 1 : 0;
    }
    eachCorner(mesh, [&](std::size_t cell, std::size_t, std::int64_t p) { isTouched[p] |= isRegular[cell] ? 0 : 1; });
    countFaces(mesh);
  }

  std::vector<char> isRegular;
  std::vector<char> isTouched;
  std::vector<Index> measured;
  std::size_t idealFaces = 0;

private:
  template <typename F> static void eachCorner(const SampleMesh& mesh, F&& use)
  {
    for (std::size_t cell = 0; cell < mesh.types.size(); ++cell)
    {
      const Ids corners = cornersOf(mesh, cell);
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        if (corners[i] >= 0 && corners[i] < static_cast<std::int64_t>(mesh.points.size()))
        {
          use(cell, i, corners[i]);
        }
      }
    }
  }

  void countFaces(const SampleMesh& mesh)
  {
    std::map<std::set<std::int64_t>, int> sidesOf; // of faces between regular boxes that are not touched everywhere
    for (Index cell = 0; cell < isRegular.size(); ++cell)
    {
      bool isMeasured = !isRegular[cell];
      for (const LocalFace& face : isRegular[cell] ? shapeOf(hexahedronCell).faces : std::span<const LocalFace>())
      {
        std::set<std::int64_t> points;
        std::ranges::for_each(face.corners, [&](int c) { points.insert(cornersOf(mesh, cell)[c]); });
        const bool all = std::ranges::all_of(points, [&](std::int64_t p) { return isTouched[p] != 0; });
        isMeasured = isMeasured || all;
        sidesOf[points] += all ? 0 : 1;
      }
      measured.insert(measured.end(), isMeasured ? 1 : 0, cell);
    }
    idealFaces =
        static_cast<std::size_t>(std::ranges::count(sidesOf, 2, [](const auto& entry) { return entry.second; }));
  }
};

void expectBoxes(const SampleMesh& mesh, const Ids& apart, const Executor& executor = SerialExecutor())
{
  const NaiveBoxes expected(mesh, apart);
  const RegularBoxes found = findRegularBoxes(mesh.points, mesh.view(), apart, executor);
  EXPECT_TRUE(std::ranges::equal(found.isRegular, expected.isRegular));
  EXPECT_TRUE(std::ranges::equal(found.isTouched, expected.isTouched));
  EXPECT_EQ(found.measured, expected.measured);
  EXPECT_EQ(found.idealFaces, expected.idealFaces);
  for (std::size_t cell = 0; cell < mesh.types.size(); ++cell)
  {
    if (isBox(mesh, cell))
    {
      const Ids corners = cornersOf(mesh, cell);
      const Vec3 size = mesh.points[corners[6]] - mesh.points[corners[0]];
      EXPECT_DOUBLE_EQ(found.volumes[cell], size[0] * size[1] * size[2]);
      EXPECT_DOUBLE_EQ(found.aspectRatios[cell], size.norm() / std::min({size[0], size[1], size[2]}));
    }
  }
}

/// Boxes of different lengths.
SampleMesh gradedBoxes(std::array<int, 3> n)
{
  SampleMesh mesh = hexahedra(n);
  for (Vec3& p : mesh.points)
  {
    p = Vec3(p[0] * (1.0 + 0.3 * p[0]), 0.5 * p[1] * (3.0 - 0.1 * p[1]), p[2] * p[2]);
  }
  return mesh;
}

TEST(RegularBoxes, AreAmongEightBoxesAtEachCorner)
{
  for (const std::array<int, 3>& n : {std::array{1, 1, 1}, std::array{2, 3, 3}, std::array{3, 3, 3},
                                      std::array{5, 4, 3}, std::array{5, 5, 5}, std::array{7, 6, 5}})
  {
    SCOPED_TRACE(n[0]);
    expectBoxes(gradedBoxes(n), {});
  }
  const SampleMesh cubes = hexahedra({3, 3, 3});
  const RegularBoxes boxes = findRegularBoxes(cubes.points, cubes.view(), {}, SerialExecutor());
  EXPECT_EQ(std::ranges::count(boxes.isRegular, 1), 1);
  EXPECT_EQ(boxes.isRegular[13], 1);
  EXPECT_EQ(boxes.idealFaces, 0U) << "all its faces are touched";
}

TEST(RegularBoxes, AreNotAtPointsThatAreApart)
{
  const SampleMesh mesh = gradedBoxes({6, 6, 6});
  expectBoxes(mesh, {3 + 7 * (3 + 7 * 3)});
  expectBoxes(mesh, {2 + 7 * (2 + 7 * 2), 4 + 7 * (3 + 7 * 2), 0});
  expectBoxes(mesh, {-1, 343, 342}); // there are points 0 to 342
}

TEST(RegularBoxes, AreNotAtMovedPointsHoweverLittle)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SampleMesh mesh = gradedBoxes({6, 6, 6});
    double& place = mesh.points[2 + 7 * (3 + 7 * 3)][axis];
    place = std::nextafter(place, 1e9);
    expectBoxes(mesh, {});
  }
}

TEST(RegularBoxes, HaveLengthsAboveZero)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double factor : {-1.0, 0.0})
    {
      SampleMesh mesh = gradedBoxes({3, 3, 3});
      std::ranges::for_each(mesh.points, [&](Vec3& p) { p[axis] *= factor; });
      EXPECT_THAT(findRegularBoxes(mesh.points, mesh.view(), {}, SerialExecutor()).isRegular, Each(0)) << axis;
    }
  }
}

TEST(RegularBoxes, HaveEightCorners)
{
  const SampleMesh whole = gradedBoxes({6, 6, 6});
  for (const std::size_t size : {7U, 9U})
  {
    SampleMesh mesh;
    mesh.points = whole.points;
    for (std::size_t cell = whole.types.size(); cell-- > 0;)
    {
      Ids corners = cornersOf(whole, cell);
      if (cell == 87) // inside
      {
        corners.resize(size, corners.front());
      }
      mesh.addCell(hexahedronCell, corners);
    }
    expectBoxes(mesh, {});
  }
}

/// Boxes of which some are left out, moved, or of another type.
SampleMesh brokenBoxes(unsigned seed)
{
  std::mt19937 random(seed);
  const SampleMesh whole = gradedBoxes({7, 7, 7});
  SampleMesh mesh;
  mesh.points = whole.points;
  for (std::size_t cell = 0; cell < whole.types.size(); ++cell)
  {
    const Ids c = cornersOf(whole, cell);
    switch (random() % 150)
    {
      case 0:
        break;
      case 1:
        mesh.addCell(voxelCell, {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
        break;
      case 2:
        mesh.addCell(hexahedronCell, {c[1], c[2], c[3], c[0], c[5], c[6], c[7], c[4]}); // starts at another corner
        break;
      case 3:
        mesh.addCell(hexahedronCell, {c.begin(), c.begin() + 7}); // is wrong
        break;
      default:
        mesh.addCell(hexahedronCell, c);
    }
  }
  mesh.points[random() % mesh.points.size()][seed % 3] += 0.01;
  return mesh;
}

TEST(RegularBoxes, AreFoundBesideCellsThatAreNone)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    expectBoxes(brokenBoxes(seed), {static_cast<std::int64_t>(seed * 17)}, ThreadExecutor(seed % 2 == 0 ? 1 : 3));
  }
}

TEST(RegularBoxes, AreNotBesideCellsWithPointsThatDoNotExist)
{
  for (const std::int64_t wrong : {std::int64_t{-1}, std::int64_t{343}})
  {
    SampleMesh mesh = gradedBoxes({6, 6, 6});
    mesh.connectivity[8 * 100 + 2] = wrong;
    expectBoxes(mesh, {});
  }
}

TEST(RegularBoxes, AreNotBesideCellsThatTakeTheSamePlace)
{
  SampleMesh mesh = gradedBoxes({6, 6, 6});
  mesh.addCell(hexahedronCell, cornersOf(mesh, 86));
  expectBoxes(mesh, {});
}

} // namespace
