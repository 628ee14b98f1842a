// SPDX-License-Identifier: GPL-3.0-or-later
/// Which points of walls that share a vertex move as one.
#include "Dual/Mesh/Sheets.h"
#include "DualBlock.h"
#include "Layer/WallFans.h"
#include "Support/QuietContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr Index side = 4; // elements along a block's edge
constexpr Index first = 1 + side * (1 + side);
constexpr Index second = 2 + side * (2 + 2 * side);

/// A block with sheets around two elements that share one point only.
class WallFans : public ::testing::Test
{
protected:
  WallFans()
  {
    const auto isSheet = [](Index e, int direction) {
      const std::array<Index, 3> steps{1, side, side * side};
      const Index beyond = e + steps[axisOf(direction)];
      return e == first || e == second || beyond == first || beyond == second;
    };
    const Block block({side, side, side}, isSheet);
    mesh = block.mesh;
    shared = block.pointAt(2, 2, 2);
    vertices.classes.assign(mesh.points.size(), VertexClass::free);
    vertices.classes[shared] = VertexClass::surface;
    vertices.leaves.resize(mesh.points.size());
    std::iota(vertices.leaves.begin(), vertices.leaves.end(), Index{100});
    vertices.offsets.assign(mesh.points.size() + 1, 0);
    std::fill(vertices.offsets.begin() + shared + 1, vertices.offsets.end(), 2);
    vertices.pieces = {7, 8};
    vertices.displacementLimits[shared] = {Vec3(2, 2, 2), 0.5};
    vertexOf.resize(mesh.points.size());
    std::iota(vertexOf.begin(), vertexOf.end(), Index{0});
    split();
  }

  void split()
  {
    for (const Index source : splitSheets(mesh, quietContext()))
    {
      vertexOf.push_back(vertexOf[source]);
    }
  }

  DualMesh mesh;
  Index shared;
  VertexClassification vertices;
  std::vector<Index> vertexOf;
};

TEST_F(WallFans, OfOneSheetStayTogether)
{
  const std::vector<Index> before = vertexOf;
  EXPECT_EQ(std::ranges::count(before, shared), 3) << "within each of two elements, and outside";
  separateFans(mesh, {}, vertices, vertexOf);
  EXPECT_EQ(vertexOf, before);
  EXPECT_EQ(vertices.classes.size(), mesh.points.size());
}

TEST_F(WallFans, OfTwoBodiesMoveApart)
{
  const std::vector<Index> before = vertexOf;
  for (BoundaryFace& face : mesh.boundaryFaces)
  {
    face.opposite = noIndex; // as where no air is meshed behind walls
  }
  separateFans(mesh, {}, vertices, vertexOf);
  ASSERT_EQ(vertices.classes.size(), mesh.points.size());
  for (Index p = 0; p < vertexOf.size(); ++p)
  {
    EXPECT_EQ(vertexOf[p], p);
    EXPECT_EQ(vertices.classes[p], vertices.classes[before[p]]);
    EXPECT_EQ(vertices.leaves[p], vertices.leaves[before[p]]);
    EXPECT_TRUE(std::ranges::equal(vertices.piecesOf(p), vertices.piecesOf(before[p])));
    EXPECT_EQ(vertices.displacementLimits.contains(p), before[p] == shared);
  }
}

TEST_F(WallFans, OnBothSidesOfATubeStayTogether)
{
  EdgeTubes tubes{.elements = {first - 1}};
  cutTubes(mesh, 6, tubes);
  split();
  ASSERT_GT(tubes.faceCount, 0U);
  separateFans(mesh, tubes, vertices, vertexOf);
  const auto verticesOf = [&](Index f) {
    std::set<Index> found;
    for (const Index p : cornersOf(mesh, mesh.boundaryFaces[f]))
    {
      found.insert(vertexOf[p]);
    }
    return found;
  };
  for (Index f = tubes.firstFace; f < tubes.firstFace + tubes.faceCount; f += 2)
  {
    EXPECT_EQ(verticesOf(f), verticesOf(f + 1));
  }
}

} // namespace
