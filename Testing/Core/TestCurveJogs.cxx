// SPDX-License-Identifier: GPL-3.0-or-later
/// Chains of edges on curves do not go round faces.
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"
#include "Surface/Search/Distance.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double half = 3.0;
const Vec3 low(-1.3, -0.9, -1.1);
const Vec3 high(1.2, 1.0, 1.2);

double angleOf(int i) { return 4.0 + 7.0 * i; }

/// An upright box, or the four walls of a room without floor and ceiling; in air on all sides, turned by 4, 11, 18
/// degrees and so on.
TriangleSurface turnedWalls(int i, bool isRoom)
{
  TriangleSurface out;
  if (isRoom)
  {
    const Vec3 size = high - low;
    const Vec3 x = size[0] * Vec3::UnitX(), y = size[1] * Vec3::UnitY(), z = size[2] * Vec3::UnitZ();
    addSheet(out, "South", low, x, z);
    addSheet(out, "North", low + y, x, z);
    addSheet(out, "West", low, y, z);
    addSheet(out, "East", low + x, y, z);
  }
  else
  {
    addBox(out, "Box", {low, high});
  }
  turn(out, angleOf(i));
  return out;
}

Meshed meshOf(const TriangleSurface& surface, ZoneRule zones, const std::vector<LayerRule>& layers)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-half), Vec3::Constant(half)};
  grid.sizeMin = grid.sizeMid = grid.sizeMax = 0.25;
  DualMeshOptions options;
  options.zoneRule = zones;
  options.layers = layers;
  options.supportElements = false;
  return meshIt(surface, grid, options);
}

/// The ends of each edge of the box, or of each between two walls of the room, one behind the other.
std::vector<Vec3> creasesOf(int i, bool isRoom)
{
  TriangleSurface ends;
  for (int axis = isRoom ? 2 : 0; axis < 3; ++axis)
  {
    for (int k = 0; k < 4; ++k)
    {
      Vec3 p = low;
      p[(axis + 1) % 3] = k % 2 == 0 ? low[(axis + 1) % 3] : high[(axis + 1) % 3];
      p[(axis + 2) % 3] = k / 2 == 0 ? low[(axis + 2) % 3] : high[(axis + 2) % 3];
      ends.points.push_back(p);
      p[axis] = high[axis];
      ends.points.push_back(p);
    }
  }
  turn(ends, angleOf(i));
  return ends.points;
}

/// Faces that a chain of edges goes round: all of their corners are on one crease.
Index jogsOf(const DualMesh& mesh, const std::vector<Vec3>& creases)
{
  constexpr double rounding = 1e-6;
  Index jogs = 0;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    for (std::size_t i = 0; i < creases.size(); i += 2)
    {
      bool isOn = true;
      for (int k = 0; k < 4; ++k)
      {
        const Vec3& p = mesh.points[cornerOf(mesh, face, k)];
        isOn = isOn && (nearestOnSegment(p, creases[i], creases[i + 1]) - p).norm() < rounding;
      }
      jogs += isOn ? 1 : 0;
    }
  }
  return jogs;
}

struct Case
{
  const char* name;
  bool isRoom;
  ZoneRule zones;
};

void PrintTo(const Case& what, std::ostream* out) { *out << what.name; }

class CurveJogs : public ::testing::TestWithParam<Case>
{
};

TEST_P(CurveJogs, AreRemovedAndNothingIsLost)
{
  const auto& [name, isRoom, zones] = GetParam();
  const double volume = 8.0 * half * half * half - (isRoom || zones == ZoneRule::all ? 0.0 : (high - low).prod());
  Index before = 0;
  for (int i = 0; i < 6; ++i)
  {
    SCOPED_TRACE(i);
    const TriangleSurface surface = turnedWalls(i, isRoom);
    const std::vector<Vec3> creases = creasesOf(i, isRoom);
    const Meshed plain = meshOf(surface, zones, {});
    before += jogsOf(plain.mesh(), creases);
    const Meshed straightened = meshOf(surface, zones, {{"*", {0}}});
    EXPECT_EQ(jogsOf(straightened.mesh(), creases), 0u);
    EXPECT_EQ(straightened.mesh().elementCount(), plain.mesh().elementCount());
    EXPECT_TRUE(isConformal(straightened.mesh()));
    EXPECT_TRUE(boundaryIsWatertight(straightened.mesh()));
    const Meshed layered = meshOf(surface, zones, {{"*", {1}}});
    EXPECT_TRUE(boundaryIsWatertight(layered.mesh()));
    EXPECT_NEAR(totalVolume(layered.mesh()), volume, 1e-6 * volume);
    EXPECT_TRUE(layered.result.diagnostics.empty());
  }
  EXPECT_GT(before, 0u) << "there was nothing to remove";
}

INSTANTIATE_TEST_SUITE_P(All, CurveJogs,
                         ::testing::Values(Case{"Solids", false, ZoneRule::outside},
                                           Case{"ClosedRooms", false, ZoneRule::all},
                                           Case{"OpenRooms", true, ZoneRule::outside}),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
