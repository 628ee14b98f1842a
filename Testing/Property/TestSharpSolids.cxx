// SPDX-License-Identifier: GPL-3.0-or-later
/// Uniform meshes about solids whose edges run across the grid.
#include "CheckWritten.h"
#include "Quality/Checks/Metrics.h"
#include "Support/Campaign.h"
#include "Support/DualMeshChecks.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Support/Watchdog.h"
#include "VtkDualMesh.h"
#include "VtkFaceMesh.h"

#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;

using Polygon = std::vector<Eigen::Vector2d>;

TriangleSurface prism(const Polygon& polygon, double height)
{
  TriangleSurface out;
  addPrism(out, "Solid", polygon, -0.5 * height, 0.5 * height);
  return out;
}

constexpr double domainSize = 8.0;

struct Solid
{
  const char* shape;
  TriangleSurface surface;
};

/// Of about 3 m, at a random pose in a cube of 8 m, or upright on its floor. The same for the same seed.
Solid randomSolid(unsigned seed)
{
  std::mt19937 random(seed);
  const auto between = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  const double x = between(1.0, 1.7), y = between(0.8, 1.4), height = between(2.0, 3.0);
  const Polygon box{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  const Polygon angle{{-0.3 * x, -0.3 * y}, {-0.3 * x, y}, {-x, y}, {-x, -y}, {x, -y}, {x, -0.3 * y}};
  const Polygon house{{-x, -y}, {x, -y}, {x, 0.3 * y}, {0.0, between(0.8, 1.6) * y}, {-x, 0.3 * y}};
  const std::array<Solid, 5> solids{Solid{"box", prism(box, height)},
                                    Solid{"hexagonal prism", prism(regularPolygon(6, x), height)},
                                    Solid{"angle", prism(angle, height)}, Solid{"house", prism(house, height)},
                                    Solid{"cylinder", prism(regularPolygon(72, y), height)}};
  Solid out = solids[seed % solids.size()];
  const bool isUpright = seed / solids.size() % 2 == 1;
  const bool isHouse = seed % solids.size() == 3;
  Eigen::Quaterniond turned(Eigen::AngleAxisd(
      between(0.0, std::numbers::pi),
      isUpright ? Vec3::UnitZ() : Vec3(between(-1.0, 1.0), between(-1.0, 1.0), between(0.1, 1.0)).normalized()));
  if (isUpright && isHouse)
  {
    turned = turned * Eigen::AngleAxisd(std::numbers::pi / 2.0, Vec3::UnitX()); // the roof up
  }
  const double foot = isHouse ? y : 0.5 * height;
  const Vec3 to(between(-0.1, 0.1), between(-0.1, 0.1),
                isUpright ? foot - 0.5 * domainSize - between(0.05, 0.5) : between(-0.1, 0.1));
  std::ranges::for_each(out.surface.points, [&](Vec3& p) { p = turned * p + to; });
  return out;
}

QualityMetrics measure(const DualMesh& mesh)
{
  vtkNew<vtkUnstructuredGrid> volume;
  volumeToVtk(mesh, volume, SerialExecutor());
  const VtkFaceMesh faces = faceMeshFromVtk(volume, nullptr);
  return computeQuality(faces.mesh, faces.cells.view(), quietContext());
}

/// Those whose worst hexahedron has less than 0.3, 0.26 to 0.28: in a row along a crease, or where one is lost on the
/// ground.
const std::set<unsigned> poor{27, 37, 57, 97};
constexpr unsigned usualSolids = 10;
constexpr unsigned allSolids = 100;

class SharpSolids : public ::testing::TestWithParam<unsigned>
{
};

TEST_P(SharpSolids, HaveGoodHexahedra)
{
  const unsigned seed = GetParam();
  if (seed >= usualSolids && !isFullCampaign())
  {
    GTEST_SKIP() << "set ATRIA_TEST_FULL for more solids";
  }
  const Solid solid = randomSolid(seed);
  const std::string what = "solid " + std::to_string(seed) + ", " + solid.shape;
  SCOPED_TRACE(what);
  const Watchdog watchdog(what, std::chrono::seconds(300));
  GridOptions grid;
  grid.domain = {Vec3::Constant(-0.5 * domainSize), Vec3::Constant(0.5 * domainSize)};
  grid.sizeMin = grid.sizeMid = grid.sizeMax = 0.2;
  DualMeshOptions options;
  options.layers = {{"*", {1}}};
  const Meshed meshed = meshIt(solid.surface, grid, options, 2);
  const QualityMetrics metrics = measure(meshed.mesh());
  EXPECT_EQ(metrics.invalidCells, 0u);
  EXPECT_GE(leastScaledJacobian(meshed.mesh()), poor.contains(seed) ? 0.25 : 0.3);
  EXPECT_LE(std::ranges::max(metrics.nonOrthogonalityOfFaces), 61.0);
  if (!haveCheckMesh())
  {
    GTEST_SKIP() << withoutCheckMesh;
  }
  EXPECT_THAT(checkAsWritten(meshed).failures, ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, SharpSolids, ::testing::Range(0u, allSolids));

} // namespace
