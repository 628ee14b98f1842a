// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Surface/Model/SurfaceModel.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace {

using atria::Box3;
using atria::Index;
using atria::SurfaceModel;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;

const Box3 domain{Vec3::Constant(-10.0), Vec3::Constant(10.0)};

/// With octants of 1 m at features.
SurfaceModel modelOf(const TriangleSurface& surface, const atria::FeatureOptions& options, int threads = 1)
{
  atria::GridOptions grid;
  grid.domain = domain;
  Box3 extent;
  for (const Vec3& p : surface.points)
  {
    extent.extend(p);
  }
  const atria::ThreadExecutor executor(threads);
  return makeSurfaceModel(surface, makeGridFrame(grid, extent), options, atria::testing::quietContext(executor));
}

atria::FeatureOptions withSmallParts(double size)
{
  atria::FeatureOptions options;
  options.smallPartSize = size;
  return options;
}

double areaOf(const SurfaceModel& model, Index surface)
{
  double sum = 0.0;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    sum += model.surfaceIds[t] == surface ? 0.5 * model.normal(t).norm() : 0.0;
  }
  return sum * std::ldexp(1.0, -60); // 30 bits below an octant of 1 m
}

Box3 cube(const Vec3& low, double size) { return {low, low + Vec3::Constant(size)}; }

/// Boxes of random sizes and places in a box.
void addClutter(TriangleSurface& to, const std::string& name, const Box3& in, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto draw = [&] { return Vec3(part(random), part(random), part(random)); };
  TriangleSurface boxes;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 size = 0.02 * Vec3::Ones() + 0.2 * draw();
    const Vec3 low = in.min + (in.max - in.min - size).cwiseProduct(draw());
    addBox(boxes, name, {low, low + size});
  }
  atria::testing::addSurface(to, name, boxes.points, boxes.triangles);
}

TEST(HiddenDetail, LeavesOutWhatIsSmallerThanAnOctant)
{
  TriangleSurface surface;
  addBox(surface, "House", cube({-4, -4, -4}, 6.0));
  addBox(surface, "Handle", cube({5, 5, 5}, 0.5)); // diagonal 0.87
  addBox(surface, "Bench", cube({-8, 5, 5}, 0.6)); // 1.04
  const SurfaceModel model = modelOf(surface, withSmallParts(1.0));
  EXPECT_NEAR(areaOf(model, 0), 6 * 36.0, 1e-6);
  EXPECT_EQ(areaOf(model, 1), 0.0);
  EXPECT_NEAR(areaOf(model, 2), 6 * 0.36, 1e-6);
  ASSERT_EQ(model.repair.hidden.size(), 1u);
  const atria::HiddenDetail& detail = model.repair.hidden.front();
  EXPECT_EQ(detail.surface, 1u);
  EXPECT_EQ(detail.leftOutTriangles, 12u);
  EXPECT_NEAR(detail.leftOutArea, 6 * 0.25, 1e-6);
  EXPECT_EQ(detail.clusteredTriangles, 0u);

  EXPECT_NEAR(areaOf(modelOf(surface, withSmallParts(0.0)), 1), 6 * 0.25, 1e-6);
  EXPECT_EQ(areaOf(modelOf(surface, withSmallParts(1.1)), 2), 0.0);
}

TEST(HiddenDetail, KeepsSmallPartsOfNamedSurfacesAndInFinerPlaces)
{
  TriangleSurface surface;
  addBox(surface, "Handle", cube({5, 5, 5}, 0.5));
  addBox(surface, "Sensor", cube({-5, 5, 5}, 0.5));
  atria::FeatureOptions options = withSmallParts(1.0);
  options.keptSurfaces = {0, 1};
  const SurfaceModel named = modelOf(surface, options);
  EXPECT_EQ(areaOf(named, 0), 0.0);
  EXPECT_NEAR(areaOf(named, 1), 1.5, 1e-6);
}

TEST(HiddenDetail, KeepsSmallPartsThatTogetherAreLarge)
{
  TriangleSurface surface;
  for (int i = 0; i < 12; ++i)
  {
    addBox(surface, "Letter" + std::to_string(i), cube({0.15 * i, 0, 0}, 0.1));
  }
  const SurfaceModel model = modelOf(surface, withSmallParts(1.0));
  for (const atria::HiddenDetail& detail : model.repair.hidden)
  {
    EXPECT_EQ(detail.leftOutTriangles, 0u);
    EXPECT_EQ(detail.clusteredTriangles, 12u);
  }
}

TEST(HiddenDetail, KeepsSmallPartsThatCloseAHole)
{
  // A wall of four sheets about a square hole, and the sheet that fills it, whose corners are no points of theirs.
  TriangleSurface surface;
  addSheet(surface, "Wall", {-5, 0, -5}, {10, 0, 0}, {0, 0, 5});
  addSheet(surface, "Wall1", {-5, 0, 0.5}, {10, 0, 0}, {0, 0, 5});
  addSheet(surface, "Wall2", {-5, 0, 0}, {5, 0, 0}, {0, 0, 0.5});
  addSheet(surface, "Wall3", {0.5, 0, 0}, {4.5, 0, 0}, {0, 0, 0.5});
  addSheet(surface, "Patch", {0.0, 0, 0.0}, {0.5, 0, 0}, {0, 0, 0.5});
  const SurfaceModel model = modelOf(surface, withSmallParts(1.0));
  EXPECT_NEAR(areaOf(model, 4), 0.25, 1e-6);
  EXPECT_TRUE(model.repair.hidden.empty());
}

/// What is sparse is repaired beside a cluster; what lies in the cluster stays as it was drawn.
TEST(HiddenDetail, RepairsOutsideOfClusters)
{
  TriangleSurface surface;
  addSheet(surface, "A", {-8, 0, -8}, {16, 0, 0}, {0, 0, 4});
  addSheet(surface, "B", {-6, -4, -7}, {0, 8, 0}, {0, 0, 2});
  addClutter(surface, "Clutter", {{3.1, 3.1, 3.1}, {4.9, 4.9, 4.9}}, 300, 1);
  const SurfaceModel model = modelOf(surface, {});
  EXPECT_GT(model.repair.intersectionEdges, 0u);
  EXPECT_EQ(model.repair.unresolvedContacts, 0u);
  ASSERT_EQ(model.repair.hidden.size(), 1u);
  const atria::HiddenDetail& detail = model.repair.hidden.front();
  EXPECT_EQ(detail.surface, 2u);
  EXPECT_GT(detail.clusteredTriangles, 3000u);
  // Boxes are neither cut nor dropped.
  double drawn = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    drawn += surface.surfaceIds[t] == 2
                 ? 0.5 * (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]).norm()
                 : 0.0;
  }
  EXPECT_NEAR(areaOf(model, 2), drawn, 1e-3 * drawn);
}

/// Copies that nearly coincide in any number are no reason to refuse a model.
TEST(HiddenDetail, RefusesNothing)
{
  for (const double jitter : {0.0, 1e-6, 1e-3, 0.02})
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-jitter, jitter);
    TriangleSurface surface;
    for (int i = 0; i < 400; ++i)
    {
      const Vec3 low(-3 + shift(random), -3 + shift(random), -3 + shift(random));
      addBox(surface, "Box", {low, low + Vec3(6 + shift(random), 6, 6)});
    }
    TriangleSurface one;
    atria::testing::addSurface(one, "Boxes", surface.points, surface.triangles);
    const SurfaceModel model = modelOf(one, {});
    EXPECT_GE(areaOf(model, 0), 200.0) << jitter;
    const SurfaceModel parallel = modelOf(one, {}, 3);
    EXPECT_EQ(model.points, parallel.points);
    EXPECT_EQ(model.triangles, parallel.triangles);
  }
}

/// Bars thinner than the gap tolerance keep their volume beside a wall that they nearly touch.
TEST(HiddenDetail, GapToleranceDoesNotFoldWhatIsFiner)
{
  TriangleSurface surface;
  addSheet(surface, "Wall", {-8, 0, -8}, {16, 0, 0}, {0, 0, 16});
  addBox(surface, "Bar", {{-5, 0.1, -5}, {5, 0.3, -4.8}});
  atria::FeatureOptions options;
  options.gapTolerance = 0.5;
  const SurfaceModel model = modelOf(surface, options);
  EXPECT_NEAR(areaOf(model, 1), 4 * 10 * 0.2 + 2 * 0.04, 1e-6);
  EXPECT_EQ(model.repair.closedGaps, 0u);
}

/// Several layers are for walls that the mesh shows.
TEST(HiddenDetail, HasOneLayer)
{
  const Box3 filled = cube(Vec3::Constant(-2.49), 4.98);
  TriangleSurface clutter;
  addClutter(clutter, "Clutter", filled, 4000, 3); // of boxes smaller than an octant
  TriangleSurface box;
  addBox(box, "Box", filled);
  const auto elementsWith = [](const TriangleSurface& surface, int layers) {
    atria::GridOptions grid;
    grid.domain = domain;
    atria::DualMeshOptions options;
    options.layers = {{"*", {.layers = layers}}};
    return atria::testing::meshIt(surface, grid, options).mesh().elementCount();
  };
  EXPECT_EQ(elementsWith(clutter, 5), elementsWith(clutter, 1));
  EXPECT_GT(elementsWith(box, 5), elementsWith(box, 1));
}

} // namespace
