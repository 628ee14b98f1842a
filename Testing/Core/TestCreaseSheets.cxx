// SPDX-License-Identifier: GPL-3.0-or-later
/// Uniform meshes about solids whose edges run across the grid: hexahedra are good along them, too.
#include "Layer/BoundaryGraph.h"
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace atria;
using namespace atria::testing;

constexpr double size = 0.25;

using Polygon = std::vector<Eigen::Vector2d>;

TriangleSurface prism(const Polygon& polygon, double bottom, double top)
{
  TriangleSurface out;
  addPrism(out, "Solid", polygon, bottom, top);
  return out;
}

const Polygon rectangle{{-1.5, -1}, {1.5, -1}, {1.5, 1}, {-1.5, 1}};
const Polygon angled{{0, 0}, {0, 1.8}, {-1.8, 1.8}, {-1.8, -1.8}, {1.8, -1.8}, {1.8, 0}};

struct Solid
{
  const char* name;
  TriangleSurface surface;
  double angle;
  Vec3 axis;
  double leastJacobian;
};

void PrintTo(const Solid& solid, std::ostream* out) { *out << solid.name; }

Meshed meshAbout(const Solid& solid, int layers, int threads = 2)
{
  TriangleSurface turned = solid.surface;
  for (Vec3& p : turned.points)
  {
    p = Eigen::AngleAxisd(solid.angle, solid.axis.normalized()) * p;
  }
  GridOptions grid;
  grid.domain = {Vec3::Constant(-3.5), Vec3::Constant(3.5)};
  grid.sizeMin = grid.sizeMid = grid.sizeMax = size;
  DualMeshOptions options;
  options.layers = {{"*", {layers}}};
  options.supportElements = false; // with 0 layers this is the plain mesh
  return meshIt(turned, grid, options, threads);
}

/// The widest angle of a wall's faces, degrees.
double widestAngle(const Meshed& meshed)
{
  const DualMesh& mesh = meshed.mesh();
  double least = 1.0;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    for (int k = 0; k < 4 && face.tag < meshed.model.names.size(); ++k)
    {
      const Vec3& p = mesh.points[cornerOf(mesh, face, k)];
      const Vec3 before = (mesh.points[cornerOf(mesh, face, k + 3)] - p).normalized();
      const Vec3 after = (mesh.points[cornerOf(mesh, face, k + 1)] - p).normalized();
      least = std::min(least, -before.dot(after));
    }
  }
  return std::acos(-least) * 180.0 / std::numbers::pi;
}

struct Distances
{
  double attached = 0.0;
  double detached = 0.0; ///< of points that diagnostics tell
};

/// How far points of walls are from the model at most.
Distances farthestFromModel(const Meshed& meshed)
{
  const SurfaceModel& model = meshed.model;
  const auto isDetached = [&](const Vec3& p) {
    return std::ranges::any_of(meshed.result.diagnostics, [&](const Diagnostic& d) {
      return d.kind == Diagnostic::detachedVertex && (d.begin - p).norm() < 1e-9;
    });
  };
  Distances farthest;
  for (const BoundaryFace& face : meshed.mesh().boundaryFaces)
  {
    for (int k = 0; k < 4 && face.tag < model.names.size(); ++k)
    {
      const Vec3& p = meshed.mesh().points[cornerOf(meshed.mesh(), face, k)];
      double nearest = std::numeric_limits<double>::infinity();
      for (Index t = 0; t < model.triangles.size(); ++t)
      {
        const auto at = [&](int i) { return meshed.frame.toModel(model.corner(t, i)); };
        nearest = std::min(nearest, (nearestOnTriangle(p, at(0), at(1), at(2)) - p).norm());
      }
      double& most = isDetached(p) ? farthest.detached : farthest.attached;
      most = std::max(most, nearest);
    }
  }
  return farthest;
}

class CreaseSheets : public ::testing::TestWithParam<Solid>
{
};

TEST_P(CreaseSheets, LeaveNoElementWithAnAngleOf180Degrees)
{
  const Solid& solid = GetParam();
  const Meshed meshed = meshAbout(solid, 1);
  const DualMesh& mesh = meshed.mesh();
  const auto plainElements = static_cast<Index>(meshAbout(solid, 0).mesh().elementCount());
  EXPECT_TRUE(isValid(mesh, plainElements));
  EXPECT_TRUE(facesAreUnique(mesh));
  EXPECT_LT(widestAngle(meshed), 178.0);
  const auto [attached, detached] = farthestFromModel(meshed);
  EXPECT_LT(attached, 1e-6);
  EXPECT_LT(detached, 0.1 * size);
  EXPECT_GE(leastScaledJacobian(mesh), solid.leastJacobian);
}

INSTANTIATE_TEST_SUITE_P(
    Solids, CreaseSheets,
    ::testing::Values(Solid{"Box_turned", prism(rectangle, -1.2, 1.2), 0.5, {0, 0, 1}, 0.3},
                      Solid{"Box_turned_by_45_degrees", prism(rectangle, -1.2, 1.2), 0.7854, {0, 0, 1}, 0.3},
                      Solid{"Box_tilted", prism(rectangle, -1.2, 1.2), 0.7, {0.3, 0.5, 0.8}, 0.3},
                      Solid{"Box_tilted_otherwise", prism(rectangle, -1.2, 1.2), 1.1, {0.9, 0.2, -0.4}, 0.3},
                      Solid{"Hexagon_tilted", prism(regularPolygon(6, 1.6), -1.3, 1.3), 0.8, {0.2, -0.7, 0.4}, 0.3},
                      Solid{"Cylinder_tilted", prism(regularPolygon(72, 1.6), -1.4, 1.4), 0.6, {0.9, 0.3, 0.2}, 0.3},
                      Solid{"Angle_turned", prism(angled, -1.2, 1.2), 0.4, {0, 0, 1}, 0.3},
                      Solid{"Angle_on_the_ground", prism(angled, -5.0, 1.2), 0.4, {0, 0, 1}, 0.3}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(CreaseSheetsOf, TheSameBitsForAnyNumberOfThreads)
{
  const Solid solid{"", prism(rectangle, -1.2, 1.2), 0.7, {0.3, 0.5, 0.8}, 0.0};
  const Meshed one = meshAbout(solid, 1, 1);
  for (const int threads : {2, 5})
  {
    EXPECT_TRUE(identical(one.mesh(), meshAbout(solid, 1, threads).mesh())) << threads;
  }
}

/// One prism on each face of a wall then, and no more.
TEST(CreaseSheetsOf, SolidsAlongTheAxesAndSmoothOnesThereAreNone)
{
  TriangleSurface sphere;
  addSphere(sphere, "Solid", Vec3::Zero(), 2.0, 4);
  for (const TriangleSurface& surface : {prism(rectangle, -1.2, 1.2), sphere})
  {
    const Solid solid{"", surface, 0.0, Vec3::UnitZ(), 0.0};
    const Meshed layered = meshAbout(solid, 1);
    const Meshed plain = meshAbout(solid, 0);
    const auto walls = std::ranges::count(plain.mesh().boundaryFaces, Index{0}, &BoundaryFace::tag);
    EXPECT_EQ(layered.mesh().elementCount(), plain.mesh().elementCount() + walls);
  }
}

} // namespace
