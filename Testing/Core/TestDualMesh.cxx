// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the faces, neighbors and marks of dual meshes, and own elements.
#include "Dual/Mesh/DualMesh.h"
#include "Dual/Mesh/OwnElements.h"
#include "DualBlock.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

Vec3 cornerPlace(std::uint8_t corner)
{
  const unsigned bits = hexahedronCorner.at(corner);
  return {bits & 1 ? 1.0 : 0.0, bits & 2 ? 1.0 : 0.0, bits & 4 ? 1.0 : 0.0};
}

TEST(DualMesh, HasFacesOutwardsOnTheirSides)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto& face = hexahedronFace.at(static_cast<std::size_t>(direction));
    const int axis = axisOf(direction);
    for (const std::uint8_t c : face)
    {
      EXPECT_EQ(cornerPlace(c)[axis], isUpper(direction) ? 1.0 : 0.0);
    }
    const Vec3 u = cornerPlace(face[1]) - cornerPlace(face[0]);
    const Vec3 v = cornerPlace(face[2]) - cornerPlace(face[1]);
    EXPECT_EQ(u.cross(v)[axis], isUpper(direction) ? 1.0 : -1.0);
    EXPECT_EQ(cornerPlace(face[3]), cornerPlace(face[0]) + v);
  }
}

TEST(DualMesh, ReducesFacesByNeighboringCornersThatAreOne)
{
  for (unsigned merged = 0; merged < 16; ++merged)
  {
    std::array<Index, 4> loop{10, 11, 12, 13}; // corner i + 1 is corner i where bit i is set
    for (std::size_t i = 0; i < 4; ++i)
    {
      if ((merged >> i & 1) != 0)
      {
        std::ranges::replace(loop, loop.at((i + 1) % 4), loop.at(i));
      }
    }
    std::vector<Index> expected;
    for (std::size_t i = 0; i < 4; ++i)
    {
      expected.insert(expected.end(), loop.at(i) != loop.at((i + 3) % 4) ? 1 : 0, loop.at(i));
    }
    for (int direction = 0; direction < 6; ++direction)
    {
      std::array<Index, 8> corners{0, 1, 2, 3, 4, 5, 6, 7};
      for (std::size_t i = 0; i < 4; ++i)
      {
        corners.at(hexahedronFace.at(static_cast<std::size_t>(direction)).at(i)) = loop.at(i);
      }
      const ReducedFace face = faceOf(corners, direction);
      std::vector<Index> found(face.loop().begin(), face.loop().end());
      EXPECT_EQ(found.size() < 3, expected.size() < 3) << merged;
      const auto begin = std::ranges::find(found, expected.empty() ? noIndex : expected[0]);
      std::rotate(found.begin(), begin, found.end());
      EXPECT_TRUE(expected.size() < 3 || found == expected) << merged;
    }
  }
}

TEST(DualMesh, CodesNeighbors)
{
  EXPECT_FALSE(DualMesh::isBoundary(DualMesh::noFace));
  EXPECT_FALSE(DualMesh::isBoundary(0));
  for (const Index face : {0U, 1U, 77U})
  {
    const std::int32_t code = ~static_cast<std::int32_t>(face);
    EXPECT_TRUE(DualMesh::isBoundary(code));
    EXPECT_EQ(DualMesh::boundaryFaceOf(code), face);
  }
}

TEST(DualMesh, AppendsElementsWithTheLabelsOfOthers)
{
  DualMesh from = Block({2, 1, 1}, noSheet).mesh;
  from.levels[1] = 7;
  from.zones[1] = 5;
  from.rooms.assign(2, 0);
  from.cellZones.assign(2, 0);
  from.rooms[1] = 3;
  from.cellZones[1] = 4;
  const std::array<Index, 8> corners{8, 7, 6, 5, 4, 3, 2, 1};
  const std::array<std::int32_t, 6> neighbors{1, 2, 3, 4, 5, 6};
  appendElement(from, corners, neighbors, from, 1);
  EXPECT_EQ(from.corners[2], corners);
  EXPECT_EQ(from.neighbors[2], neighbors);
  EXPECT_EQ(from.levels[2], 7);
  EXPECT_EQ(from.zones[2], 5);
  EXPECT_EQ(from.rooms[2], 3);
  EXPECT_EQ(from.cellZones[2], 4);
  DualMesh bare = Block({1, 1, 1}, noSheet).mesh;
  appendElement(bare, corners, neighbors, bare, 0);
  EXPECT_EQ(bare.elementCount(), 2U);
  EXPECT_TRUE(bare.rooms.empty() && bare.cellZones.empty());
}

TEST(DualMesh, MarksPoints)
{
  const DualMesh mesh = Block({3, 3, 3}, noSheet).mesh;
  const ThreadExecutor executor(3);
  const std::vector<char> onBoundary = boundaryPoints(mesh, executor);
  std::vector<char> inZones(mesh.points.size(), 0);
  DualMesh zoned = mesh;
  zoned.zoneFaces = {{13, 0, xMax, SheetSide::front}};
  markZonePoints(zoned, inZones);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    const Vec3& at = mesh.points[p];
    EXPECT_EQ(onBoundary[p] != 0, at.minCoeff() < 0.5 || at.maxCoeff() > 2.5);
    const bool isOnFace = at[0] == 2.0 && at[1] > 0.5 && at[1] < 2.5 && at[2] > 0.5 && at[2] < 2.5;
    EXPECT_EQ(inZones[p] != 0, isOnFace) << at.transpose();
  }
  for (std::size_t c = 0; c < 8; ++c)
  {
    std::vector<char> marked(mesh.points.size(), 0);
    marked[mesh.corners[13].at(c)] = 1;
    EXPECT_TRUE(hasMarked(mesh.corners[13], marked));
  }
  EXPECT_FALSE(hasMarked(mesh.corners[13], std::vector<char>(mesh.points.size(), 0)));
}

TEST(OwnElements, AreAllUnlessSomethingElseIsSaid)
{
  const OwnElements all;
  EXPECT_TRUE(all.owns(0) && all.owns(99) && all.isWhole());
  OwnElements some;
  some.isOwn = [](Index element) { return element > 3; };
  EXPECT_FALSE(some.owns(3));
  EXPECT_TRUE(some.owns(4));
}

} // namespace
