// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes with one layer about simple shapes: checkMesh has nothing to object to, and they are good.
#include "CheckWritten.h"
#include "Quality/Checks/Metrics.h"
#include "Support/Campaign.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "VtkDualMesh.h"
#include "VtkFaceMesh.h"

#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace atria;
using namespace atria::testing;

TriangleSurface sphere()
{
  TriangleSurface out;
  addSphere(out, "Sphere", Vec3::Zero(), 2.0, 5);
  return out;
}

TriangleSurface torus()
{
  constexpr Index around = 96, across = 48;
  constexpr double radius = 2.5, tube = 1.0;
  TriangleSurface out;
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < around; ++i)
  {
    const double a = 2.0 * std::numbers::pi * i / around;
    const Index next = (i + 1) % around;
    for (Index j = 0; j < across; ++j)
    {
      const double b = 2.0 * std::numbers::pi * j / across;
      const double r = radius + tube * std::cos(b);
      points.emplace_back(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
      const Index up = (j + 1) % across;
      triangles.push_back({i * across + j, next * across + j, next * across + up});
      triangles.push_back({i * across + j, next * across + up, i * across + up});
    }
  }
  addSurface(out, "Torus", points, triangles);
  return out;
}

TriangleSurface box()
{
  TriangleSurface out;
  addBox(out, "Box", {Vec3(-1.5, -1.0, -1.2), Vec3(1.5, 1.0, 1.2)});
  return out;
}

TriangleSurface tilted()
{
  TriangleSurface out = box();
  for (Vec3& p : out.points)
  {
    p = Eigen::AngleAxisd(0.7, Vec3(0.3, 0.5, 0.8).normalized()) * p;
  }
  return out;
}

struct Shape
{
  const char* name;
  TriangleSurface (*make)();
  double size;
  bool uniform;
  double leastJacobian; ///< of a uniform mesh
  double maxAngle;      ///< of non-orthogonality, degrees
  double maxCellSquish;
  bool large = false;
};

void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name << ", " << shape.size << " m"; }

QualityMetrics measure(const DualMesh& mesh)
{
  vtkNew<vtkUnstructuredGrid> volume;
  volumeToVtk(mesh, volume, SerialExecutor());
  const VtkFaceMesh faces = faceMeshFromVtk(volume, nullptr);
  return computeQuality(faces.mesh, faces.cells.view(), quietContext());
}

class LayeredShapes : public ::testing::TestWithParam<Shape>
{
};

TEST_P(LayeredShapes, PassCheckMeshAndAreGood)
{
  const Shape& shape = GetParam();
  if (shape.large && !isFullCampaign())
  {
    GTEST_SKIP() << "set ATRIA_TEST_FULL for the large meshes";
  }
  GridOptions grid;
  grid.domain = {Vec3::Constant(-5.0), Vec3::Constant(5.0)};
  grid.sizeMin = grid.sizeMid = shape.size;
  grid.sizeMax = shape.uniform ? shape.size : 100.0;
  DualMeshOptions options;
  options.layers = {{"*", {1}}};
  const Meshed meshed = meshIt(shape.make(), grid, options, 2);
  const QualityMetrics metrics = measure(meshed.mesh());
  EXPECT_EQ(metrics.invalidCells, 0u);
  EXPECT_LE(std::ranges::max(metrics.nonOrthogonalityOfFaces), shape.maxAngle);
  EXPECT_LT(std::ranges::max(metrics.cellSquish), shape.maxCellSquish);
  EXPECT_LT(std::ranges::max(metrics.squishOfFaces), 0.5);
  if (shape.uniform)
  {
    EXPECT_GE(std::ranges::min(metrics.scaledJacobian), shape.leastJacobian);
  }
  if (!haveCheckMesh())
  {
    GTEST_SKIP() << withoutCheckMesh;
  }
  const CheckMeshReport report = checkAsWritten(meshed);
  EXPECT_THAT(report.failures, ::testing::IsEmpty());
  EXPECT_EQ(report.failedChecks, 0);
}

/// Of snappyHexMesh 27 to 40 degrees and a skewness of 0.69 to 0.80 were measured, of cfMesh 18 to 20 and 0.55.
TEST(CurvedWalls, AreAsGoodAsAskedFor)
{
  for (const bool uniform : {true, false})
  {
    SCOPED_TRACE(uniform ? "uniform" : "adaptive");
    GridOptions grid;
    grid.domain = {Vec3::Constant(-5.0), Vec3::Constant(5.0)};
    grid.sizeMin = grid.sizeMid = 0.2;
    grid.sizeMax = uniform ? 0.2 : 100.0;
    DualMeshOptions options;
    options.layers = {{"*", {1}}};
    const QualityMetrics byDefault = measure(meshIt(sphere(), grid, options, 2).mesh());
    const double greatest = std::ranges::max(byDefault.nonOrthogonalityOfFaces);
    EXPECT_LE(greatest, 20.0);
    EXPECT_LE(std::ranges::max(byDefault.skewnessOfFaces), 0.55);
    options.curvedWalls = {30.0, 0.75};
    const QualityMetrics asked = measure(meshIt(sphere(), grid, options, 2).mesh());
    EXPECT_GT(std::ranges::max(asked.nonOrthogonalityOfFaces), greatest);
    EXPECT_LE(std::ranges::max(asked.nonOrthogonalityOfFaces), 30.0);
    EXPECT_LE(std::ranges::max(asked.skewnessOfFaces), 0.76);
    EXPECT_EQ(asked.invalidCells, 0u);
    if (uniform)
    {
      EXPECT_GE(std::ranges::min(byDefault.scaledJacobian), 0.5);
      EXPECT_GE(std::ranges::min(asked.scaledJacobian), 0.5);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, LayeredShapes,
                         ::testing::Values(Shape{"Sphere_uniform_20cm", sphere, 0.2, true, 0.5, 20.0, 0.7},
                                           Shape{"Sphere_uniform_10cm", sphere, 0.1, true, 0.5, 20.0, 0.7, true},
                                           Shape{"Sphere_uniform_5cm", sphere, 0.05, true, 0.5, 20.0, 0.7, true},
                                           Shape{"Sphere_20cm", sphere, 0.2, false, 0.0, 20.0, 0.7},
                                           Shape{"Sphere_10cm", sphere, 0.1, false, 0.0, 20.0, 0.7},
                                           Shape{"Sphere_5cm", sphere, 0.05, false, 0.0, 20.0, 0.7, true},
                                           Shape{"Torus_uniform_20cm", torus, 0.2, true, 0.5, 50.0, 0.6},
                                           Shape{"Box_uniform_20cm", box, 0.2, true, 0.3, 65.0, 0.6},
                                           Shape{"Tilted_box_uniform_20cm", tilted, 0.2, true, 0.3, 65.0, 0.8},
                                           Shape{"Tilted_box_20cm", tilted, 0.2, false, 0.0, 65.0, 0.8}),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
