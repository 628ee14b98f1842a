// SPDX-License-Identifier: GPL-3.0-or-later
/// Tubes in front of the boundary edges of sheets: which elements they have, and layers round them.
#include "Dual/Mesh/Sheets.h"
#include "DualBlock.h"
#include "Layer/EdgeTubes.h"
#include "Layer/LayerTopology.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace atria;
using namespace atria::testing;

using Cell = std::array<Index, 3>;

constexpr Index side = 6; // elements along a block's edge

Cell cellOf(Index e) { return {e % side, e / side % side, e / (side * side)}; }

/// A sheet in a block: tells whether the upper face of a cell on an axis is on it.
struct Sheet
{
  const char* name;
  std::function<bool(Cell cell, int axis)> isOn;
  std::function<bool(Cell cell)> isInTube;
};

void PrintTo(const Sheet& sheet, std::ostream* out) { *out << sheet.name; }

bool isBeside(Index place, Index first) { return place == first || place + 1 == first; }

const std::vector<Sheet> sheets{
    {"Whole", [](Cell c, int axis) { return axis == 2 && c[2] == 2; }, [](Cell) { return false; }},
    {"HalfPlane", [](Cell c, int axis) { return axis == 2 && c[2] == 2 && c[0] < 3; },
     [](Cell c) { return c[0] == 3 && isBeside(c[2], 3); }},
    {"Corner", [](Cell c, int axis) { return axis == 2 && c[2] == 2 && c[0] < 3 && c[1] < 3; },
     [](Cell c) { return std::max(c[0], c[1]) == 3 && isBeside(c[2], 3); }},
    {"WindowOfOneElement", [](Cell c, int axis) { return axis == 2 && c[2] == 2 && !(c[0] == 2 && c[1] == 3); },
     [](Cell c) { return c[0] == 2 && c[1] == 3 && isBeside(c[2], 3); }},
    {"StripOfOneElement", [](Cell c, int axis) { return axis == 2 && c[2] == 2 && c[0] == 2; },
     [](Cell c) { return (c[0] == 1 || c[0] == 3) && isBeside(c[2], 3); }},
    {"FoldEndingInAir",
     [](Cell c, int axis) {
       return c[1] < 3 && ((axis == 2 && c[2] == 1 && c[0] < 2) || (axis == 0 && c[0] == 1 && c[2] == 2) ||
                           (axis == 2 && c[2] == 2 && c[0] >= 2));
     },
     [](Cell c) {
       const bool touchesLow = c[0] < 3 && isBeside(c[2], 2);
       const bool touchesHigh = c[0] > 0 && isBeside(c[2], 3);
       return c[1] == 3 && (touchesLow || touchesHigh);
     }},
    {"OnFloor", [](Cell c, int axis) { return axis == 0 && c[0] == 2 && c[1] < 3 && c[2] < 3; },
     [](Cell c) { return isBeside(c[0], 3) && std::max(c[1], c[2]) == 3; }},
};

class EdgeTubesTest : public ::testing::TestWithParam<Sheet>
{
protected:
  /// A block whose outside has tags from 1 on, split.
  EdgeTubesTest()
  {
    const auto isSheet = [](Index e, int direction) { return GetParam().isOn(cellOf(e), axisOf(direction)); };
    mesh = Block({side, side, side}, isSheet, {.sheet = 0, .firstSide = 1}).mesh;
    split();
    options.ofTag.assign(1 + sideNumbers, WallLayers{.layers = 1});
    options.wraps = true;
  }

  void split()
  {
    vertexOf.resize(mesh.points.size());
    if (firstSplit)
    {
      std::iota(vertexOf.begin(), vertexOf.end(), Index{0});
      firstSplit = false;
    }
    for (const Index source : splitSheets(mesh, quietContext()))
    {
      vertexOf.push_back(vertexOf[source]);
    }
  }

  /// Returns the mesh with layers at all points that may have one, or without any.
  DualMesh grow(bool layers)
  {
    tubes = findEdgeTubes(mesh, quietContext());
    cutTubes(mesh, 1, tubes);
    split();
    addTubes(options);
    LayerWalls walls = findLayerWalls(mesh, options, quietContext());
    keepTubes(mesh, tubes, walls);
    counts = layers ? walls.counts : std::vector<Index>(walls.counts.size(), 0);
    DualMesh grown = buildLayer(mesh, walls, counts).mesh;
    joinTubes(grown, tubes, vertexOf, 1);
    return grown;
  }

  bool firstSplit = true;
  DualMesh mesh;
  std::vector<Index> vertexOf;
  LayerOptions options;
  EdgeTubes tubes;
  std::vector<Index> counts;
};

TEST_P(EdgeTubesTest, AreInFrontOfBoundaryEdges)
{
  std::vector<Index> wanted;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (GetParam().isInTube(cellOf(e)))
    {
      wanted.push_back(e);
    }
  }
  EXPECT_EQ(findEdgeTubes(mesh, quietContext()).elements, wanted);
}

TEST_P(EdgeTubesTest, LeaveTheMeshAsItWasWithoutLayers)
{
  const DualMesh before = mesh;
  EXPECT_TRUE(identical(grow(false), before));
}

TEST_P(EdgeTubesTest, GiveHexahedraOnlyWithLayers)
{
  const auto facesOfWalls = static_cast<Index>(mesh.boundaryFaces.size());
  const auto elements = static_cast<Index>(mesh.elementCount());
  const DualMesh grown = grow(true);
  EXPECT_TRUE(isSound(grown, elements));
  EXPECT_TRUE(std::ranges::all_of(grown.corners, hasAllCorners));
  Index bare = 0; // faces of tubes on the block's sides
  for (const BoundaryFace& face : grown.boundaryFaces)
  {
    bare += std::ranges::binary_search(tubes.elements, face.element) ? 1 : 0;
  }
  EXPECT_EQ(grown.elementCount(), elements + facesOfWalls - bare + tubes.faceCount / 2);
  EXPECT_EQ(grown.boundaryFaces.size(), facesOfWalls);
}

INSTANTIATE_TEST_SUITE_P(All, EdgeTubesTest, ::testing::ValuesIn(sheets),
                         [](const auto& tested) { return tested.param.name; });

/// A plate with a window, turned in its plane and out of it.
class TurnedPlates : public ::testing::TestWithParam<std::pair<double, double>>
{
};

TEST_P(TurnedPlates, HaveValidHexahedraOnlyAndLayersEverywhere)
{
  const auto [inPlane, outOfPlane] = GetParam();
  TriangleSurface plate;
  const std::vector<Vec3> corners{{-2, -2, 0},     {2, -2, 0},     {2, 2, 0},     {-2, 2, 0},
                                  {-0.8, -0.6, 0}, {0.8, -0.6, 0}, {0.8, 0.6, 0}, {-0.8, 0.6, 0}};
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < 4; ++i)
  {
    const Index next = (i + 1) % 4;
    const Index first = 4 * i;
    points.insert(points.end(), {corners[i], corners[next], corners[next + 4], corners[i + 4]});
    triangles.insert(triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  }
  addSurface(plate, "Plate", points, triangles);
  for (Vec3& p : plate.points)
  {
    p = Eigen::AngleAxisd(outOfPlane, Vec3::UnitX()) * Eigen::AngleAxisd(inPlane, Vec3::UnitZ()) * p +
        Vec3(0.03, 0.02, 0.01);
  }
  GridOptions grid;
  grid.domain = {Vec3::Constant(-5.0), Vec3::Constant(5.0)};
  grid.sizeMin = grid.sizeMid = 0.25;
  grid.sizeMax = 1.0;
  DualMeshOptions options;
  options.hexahedra = true;
  options.layers = {{"*", {1}}};
  const Meshed meshed = meshIt(plate, grid, options);
  const DualMesh& mesh = meshed.mesh();
  EXPECT_TRUE(isValid(mesh, 0));
  EXPECT_TRUE(std::ranges::all_of(mesh.corners, hasAllCorners));
  EXPECT_GT(leastScaledJacobian(mesh), inPlane * outOfPlane == 0.0 ? -1e-9 : -0.25);
  EXPECT_EQ(std::ranges::count(meshed.result.diagnostics, Diagnostic::leftOutElement, &Diagnostic::kind), 0);
}

INSTANTIATE_TEST_SUITE_P(Angles, TurnedPlates,
                         ::testing::Values(std::pair(0.0, 0.0), std::pair(0.3, 0.0), std::pair(0.0, 0.5),
                                           std::pair(0.3, 0.5), std::pair(0.785, 0.0)));

} // namespace
