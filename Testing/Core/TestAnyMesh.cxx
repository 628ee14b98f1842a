// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/AnyMesh/MeshOptimizer.h"

#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Checks/Metrics.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>

namespace {

using atria::FaceMesh;
using atria::Index;
using atria::MeshOptimizerOptions;
using atria::MeshOptimizerReport;
using atria::QualityMetrics;
using atria::Vec3;
using atria::testing::SampleMesh;

MeshOptimizerReport improve(SampleMesh& sample, const MeshOptimizerOptions& options = {},
                            const atria::Executor& executor = atria::SerialExecutor())
{
  FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const MeshOptimizerReport report =
      optimizeMesh(mesh, sample.view(), {}, options, atria::testing::quietContext(executor));
  sample.points = mesh.points;
  return report;
}

QualityMetrics measure(const SampleMesh& sample)
{
  return computeQuality(makeFaceMesh(sample.points, sample.view()), sample.view(), atria::testing::quietContext());
}

double least(std::span<const double> values)
{
  double out = std::numeric_limits<double>::infinity();
  for (const double value : values)
  {
    out = std::isnan(value) ? out : std::min(out, value);
  }
  return out;
}

double greatest(std::span<const double> values) { return values.empty() ? 0.0 : *std::ranges::max_element(values); }

double room(double value) { return 1e-9 * std::max(1.0, std::abs(value)); }

void expectWorstNoWorse(const QualityMetrics& before, const QualityMetrics& after)
{
  for (const auto metric : {&QualityMetrics::cellSquish, &QualityMetrics::faceSquish, &QualityMetrics::aspectRatio,
                            &QualityMetrics::nonOrthogonality, &QualityMetrics::skewness})
  {
    const double was = greatest(before.*metric);
    EXPECT_LE(greatest(after.*metric), was + room(was));
  }
  for (const auto metric : {&QualityMetrics::inverseAspectRatio, &QualityMetrics::orthogonalQuality,
                            &QualityMetrics::volume, &QualityMetrics::facePyramids, &QualityMetrics::scaledJacobian})
  {
    const double was = least(before.*metric);
    EXPECT_GE(least(after.*metric), was - room(was));
  }
  EXPECT_LE(after.invalidCells, before.invalidCells);
}

/// The least of what checkMesh judges, too.
std::array<double, 3> leastQuantities(const SampleMesh& sample)
{
  const atria::RunContext context = atria::testing::quietContext();
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const atria::MeasuredMesh measured = measureMesh(mesh, context);
  std::array<double, 3> out;
  std::ranges::transform(std::array{atria::CheckQuantity::Determinant, atria::CheckQuantity::FaceWeight,
                                    atria::CheckQuantity::VolumeRatio},
                         out.begin(),
                         [&](atria::CheckQuantity quantity) { return least(measure(measured, quantity, context)); });
  return out;
}

Index pointAt(const SampleMesh& mesh, const Vec3& place)
{
  for (Index p = 0; p < mesh.points.size(); ++p)
  {
    if (mesh.points[p] == place)
    {
      return p;
    }
  }
  ADD_FAILURE() << "no point at " << place.transpose();
  return 0;
}

/// Moves a point of a grid of cubes far off, and expects the mesh to be good again and its outline what it was.
void expectMended(std::array<int, 3> n, const Vec3& from, const Vec3& to)
{
  SCOPED_TRACE(::testing::Message() << from.transpose() << " to " << to.transpose());
  SampleMesh mesh = atria::testing::hexahedra(n);
  const std::vector<Vec3> grid = mesh.points;
  mesh.points[pointAt(mesh, from)] = to;
  const QualityMetrics before = measure(mesh);
  ASSERT_LT(least(before.scaledJacobian), 0.0);
  const MeshOptimizerReport report = improve(mesh);
  EXPECT_GT(report.shortBefore, 0u);
  EXPECT_EQ(report.shortAfter, 0u);
  const QualityMetrics after = measure(mesh);
  EXPECT_EQ(after.invalidCells, 0u);
  expectWorstNoWorse(before, after);
  EXPECT_LE(greatest(after.nonOrthogonality), 60.0 + 1e-9);
  EXPECT_LE(greatest(after.cellSquish), 0.8 + 1e-9);
  EXPECT_GE(least(after.scaledJacobian), 0.3 - 1e-9);
  for (Index p = 0; p < grid.size(); ++p)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (grid[p][axis] == 0.0 || grid[p][axis] == n[axis])
      {
        EXPECT_EQ(mesh.points[p][axis], grid[p][axis]) << "point " << p << " left its side";
      }
    }
    if ((grid[p] - from).cwiseAbs().maxCoeff() > 4.0 && (grid[p] - to).cwiseAbs().maxCoeff() > 4.0)
    {
      EXPECT_EQ(mesh.points[p], grid[p]) << "far from what was bad";
    }
  }
}

TEST(MeshOptimizer, UntanglesAPointInside)
{
  expectMended({9, 9, 9}, {4, 4, 4}, {5.6, 4.3, 4.1});
  expectMended({9, 9, 9}, {4, 4, 4}, {2.2, 2.4, 5.5});
  expectMended({9, 9, 9}, {4, 4, 4}, {6.5, 4, 4});
}

TEST(MeshOptimizer, UntanglesAPointOnASideWithinIt)
{
  expectMended({9, 9, 9}, {4, 4, 0}, {5.4, 4.3, 0});
  expectMended({9, 9, 9}, {9, 4, 4}, {9, 2.3, 5.6});
}

TEST(MeshOptimizer, UntanglesAPointOnAnEdgeAlongIt)
{
  expectMended({9, 9, 9}, {4, 0, 0}, {5.5, 0, 0});
  expectMended({9, 9, 9}, {9, 9, 4}, {9, 9, 2.6});
}

/// Of all cell types, tangled the more the greater `distance` is.
SampleMesh tangled(unsigned seed, double distance) { return atria::testing::mixedCells({6, 5, 7}, seed, distance); }

TEST(MeshOptimizer, LeavesAloneWhatIsGoodEnough)
{
  SampleMesh grid = atria::testing::hexahedra({4, 3, 5});
  const std::vector<Vec3> before = grid.points;
  EXPECT_EQ(improve(grid).movedPoints, 0u);
  EXPECT_EQ(grid.points, before);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.8, 0.8);
  for (Vec3& p : grid.points)
  {
    const bool inside = p[0] > 0 && p[0] < 4 && p[1] > 0 && p[1] < 3 && p[2] > 0 && p[2] < 5;
    p += inside ? Vec3(shift(random), shift(random), shift(random)) : Vec3(Vec3::Zero());
  }
  const MeshOptimizerReport first = improve(grid);
  EXPECT_GT(first.movedPoints, 0u);
  ASSERT_EQ(first.shortAfter, 0u);
  const std::vector<Vec3> improved = grid.points;
  const MeshOptimizerReport again = improve(grid);
  EXPECT_EQ(again.shortBefore, 0u);
  EXPECT_EQ(again.movedPoints, 0u);
  EXPECT_EQ(grid.points, improved);
}

TEST(MeshOptimizer, NeverMakesTheWorstWorse)
{
  for (unsigned seed = 0; seed < 12; ++seed)
  {
    const double distance = 0.15 + 0.07 * seed;
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", distance " << distance);
    SampleMesh mesh = tangled(seed, distance);
    const QualityMetrics before = measure(mesh);
    const auto quantities = leastQuantities(mesh);
    const MeshOptimizerReport report = improve(mesh);
    EXPECT_LE(report.shortAfter, report.shortBefore);
    expectWorstNoWorse(before, measure(mesh));
    const auto quantitiesThen = leastQuantities(mesh);
    for (std::size_t i = 0; i < quantities.size(); ++i)
    {
      EXPECT_GE(quantitiesThen[i], quantities[i] - room(quantities[i])) << "quantity " << i;
    }
  }
}

TEST(MeshOptimizer, MakesTangledMeshesOfAllTypesValid)
{
  for (unsigned seed = 20; seed < 26; ++seed)
  {
    SCOPED_TRACE(seed);
    SampleMesh mesh = tangled(seed, 0.9);
    ASSERT_GT(measure(mesh).invalidCells, 50u);
    const MeshOptimizerReport report = improve(mesh);
    EXPECT_EQ(measure(mesh).invalidCells, 0u);
    EXPECT_LT(report.shortAfter, report.shortBefore / 25) << "cells are left that only just fall short";
  }
}

TEST(MeshOptimizer, GivesTheSameBitsForAnyNumberOfThreads)
{
  const SampleMesh start = tangled(4, 0.5);
  SampleMesh serial = start;
  improve(serial);
  ASSERT_NE(serial.points, start.points);
  for (const int threads : {2, 7})
  {
    SampleMesh mesh = start;
    improve(mesh, {}, atria::ThreadExecutor(threads));
    EXPECT_EQ(mesh.points, serial.points) << threads << " threads";
  }
}

TEST(MeshOptimizer, DoesNotUndoWhatItDidBefore)
{
  SampleMesh mesh = tangled(9, 0.45);
  std::size_t shortCells = improve(mesh).shortAfter;
  for (int again = 0; again < 3; ++again)
  {
    const QualityMetrics before = measure(mesh);
    const MeshOptimizerReport report = improve(mesh);
    EXPECT_EQ(report.shortBefore, shortCells);
    EXPECT_LE(report.shortAfter, shortCells);
    shortCells = report.shortAfter;
    expectWorstNoWorse(before, measure(mesh));
  }
}

TEST(MeshOptimizer, KeepsAFixedBoundary)
{
  SampleMesh mesh = atria::testing::hexahedra({6, 6, 6});
  const Index onSide = pointAt(mesh, {3, 3, 0});
  const Index inside = pointAt(mesh, {3, 3, 3});
  mesh.points[onSide] = {3.7, 3.4, 0.0};
  mesh.points[inside] = {4.4, 3.2, 3.1};
  const std::vector<Vec3> before = mesh.points;
  MeshOptimizerOptions options;
  options.fixedBoundary = true;
  options.optimizer.targets.faceCosine.aimAt(0.95);
  improve(mesh, options);
  EXPECT_NE(mesh.points[inside], before[inside]);
  for (Index p = 0; p < before.size(); ++p)
  {
    const Vec3& q = before[p];
    if (q.minCoeff() == 0.0 || q.maxCoeff() == 6.0)
    {
      EXPECT_EQ(mesh.points[p], q);
    }
  }
}

/// The faces of a grid's middle plane as keys of both cells.
struct Sheet
{
  std::vector<std::array<std::int64_t, 4>> points;
  std::vector<atria::BoundaryFaceKey> keys;
};

Sheet middleSheet(const SampleMesh& mesh, double z)
{
  Sheet sheet;
  const FaceMesh faces = makeFaceMesh(mesh.points, mesh.view());
  std::vector<std::size_t> found;
  for (std::size_t f = 0; f < faces.internalFaceCount(); ++f)
  {
    const auto points = faces.face(f);
    if (std::ranges::all_of(points, [&](Index p) { return mesh.points[p][2] == z; }))
    {
      found.push_back(f);
      sheet.points.push_back({points[0], points[1], points[2], points[3]});
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    sheet.keys.push_back({faces.owner[found[i]], sheet.points[i]});
    sheet.keys.push_back({faces.neighbor[found[i]], sheet.points[i]});
  }
  return sheet;
}

TEST(MeshOptimizer, KeepsPointsOfASheetWithinIt)
{
  SampleMesh sample = atria::testing::hexahedra({8, 8, 8});
  const Sheet sheet = middleSheet(sample, 4.0);
  const Index moved = pointAt(sample, {4, 4, 4});
  sample.points[moved] = {5.4, 4.3, 4.0};
  FaceMesh mesh = makeFaceMesh(sample.points, sample.view(), sheet.keys);
  const std::vector<Vec3> before = mesh.points;
  const MeshOptimizerReport report =
      optimizeMesh(mesh, sample.view(), {}, MeshOptimizerOptions(), atria::testing::quietContext());
  EXPECT_GT(report.shortBefore, 0u);
  EXPECT_EQ(report.shortAfter, 0u);
  EXPECT_NE(mesh.points[moved], before[moved]);
  for (Index p = 0; p < before.size(); ++p)
  {
    EXPECT_EQ(mesh.points[p][2] == 4.0, before[p][2] == 4.0) << "point " << p;
  }
}

TEST(MeshOptimizer, KeepsBothSidesOfADoubledSheetTogether)
{
  // Two grids on top of each other that share no point.
  SampleMesh mesh = atria::testing::hexahedra({8, 8, 4});
  const SampleMesh upper = mesh;
  const auto shift = static_cast<std::int64_t>(mesh.points.size());
  for (const Vec3& p : upper.points)
  {
    mesh.points.emplace_back(p + Vec3(0, 0, 4));
  }
  for (std::size_t c = 0; c < upper.types.size(); ++c)
  {
    std::vector<std::int64_t> ids(upper.connectivity.begin() + upper.offsets[c],
                                  upper.connectivity.begin() + upper.offsets[c + 1]);
    std::ranges::for_each(ids, [&](std::int64_t& id) { id += shift; });
    mesh.addCell(upper.types[c], ids);
  }
  const std::vector<Vec3> grid = mesh.points;
  for (Index p = 0; p < grid.size(); ++p)
  {
    mesh.points[p] = grid[p] == Vec3(4, 4, 4) ? Vec3(5.4, 4.3, 4.0) : grid[p];
  }
  EXPECT_EQ(improve(mesh).shortAfter, 0u);
  std::size_t pairs = 0;
  for (Index p = 0; p < grid.size(); ++p)
  {
    for (Index q = 0; q < p; ++q)
    {
      if (grid[p] == grid[q])
      {
        ++pairs;
        EXPECT_EQ(mesh.points[p], mesh.points[q]);
        EXPECT_EQ(mesh.points[p][2], 4.0);
      }
    }
  }
  EXPECT_EQ(pairs, 81u);
}

TEST(MeshOptimizer, KeepsEdgesBetweenPatches)
{
  SampleMesh sample = atria::testing::hexahedra({8, 8, 4});
  sample.points[pointAt(sample, {4, 4, 0})] = {4.0, 5.3, 0.0};
  FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  std::vector<Index> patches;
  for (std::size_t f = mesh.internalFaceCount(); f < mesh.faceCount(); ++f)
  {
    double sum = 0.0;
    for (const Index p : mesh.face(f))
    {
      sum += mesh.points[p][0];
    }
    patches.push_back(sum < 16.0 ? 0 : 1);
  }
  const std::vector<Vec3> before = mesh.points;
  const MeshOptimizerReport report =
      optimizeMesh(mesh, sample.view(), patches, MeshOptimizerOptions(), atria::testing::quietContext());
  EXPECT_EQ(report.shortAfter, 0u);
  EXPECT_GT(report.movedPoints, 0u);
  for (Index p = 0; p < before.size(); ++p)
  {
    if (before[p][0] == 4.0 && before[p][2] == 0.0)
    {
      EXPECT_EQ(mesh.points[p][0], 4.0);
      EXPECT_EQ(mesh.points[p][2], 0.0);
    }
  }
}

TEST(MeshOptimizer, KeepsPointsOnACurvedBoundary)
{
  // A quarter of a thick pipe, its points shuffled inside.
  SampleMesh mesh = atria::testing::mixedCells({5, 16, 5}, 8, 0.45);
  for (Vec3& p : mesh.points)
  {
    const double angle = p[1] / 16.0 * std::acos(0.0);
    p = Vec3((8.0 + p[0]) * std::cos(angle), (8.0 + p[0]) * std::sin(angle), p[2]);
  }
  const SampleMesh before = mesh;
  const QualityMetrics measured = measure(mesh);
  improve(mesh);
  expectWorstNoWorse(measured, measure(mesh));
  const FaceMesh faces = makeFaceMesh(before.points, before.view());
  std::vector<char> onBoundary(before.points.size(), 0);
  for (std::size_t f = faces.internalFaceCount(); f < faces.faceCount(); ++f)
  {
    for (const Index p : faces.face(f))
    {
      onBoundary[p] = 1;
    }
  }
  std::size_t moved = 0;
  for (Index p = 0; p < before.points.size(); ++p)
  {
    if (!onBoundary[p] || mesh.points[p] == before.points[p])
    {
      continue;
    }
    ++moved;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t f = faces.internalFaceCount(); f < faces.faceCount(); ++f)
    {
      const auto corners = faces.face(f);
      Vec3 mean = Vec3::Zero();
      for (const Index c : corners)
      {
        mean += before.points[c] / static_cast<double>(corners.size());
      }
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        const Vec3 near = atria::nearestOnTriangle(mesh.points[p], before.points[corners[i]],
                                                   before.points[corners[(i + 1) % corners.size()]], mean);
        distance = std::min(distance, (near - mesh.points[p]).norm());
      }
    }
    EXPECT_LT(distance, 1e-9);
  }
  EXPECT_GT(moved, 0u);
}

TEST(MeshOptimizer, OpensPointsThatCoincide)
{
  SampleMesh mesh = atria::testing::hexahedra({6, 6, 6});
  mesh.points[pointAt(mesh, {3, 3, 3})] = {2, 3, 3};
  const MeshOptimizerReport report = improve(mesh);
  EXPECT_GT(report.shortBefore, 0u);
  EXPECT_EQ(report.shortAfter, 0u);
  // On a side, where points in one place would otherwise stay together.
  SampleMesh side = atria::testing::hexahedra({6, 6, 6});
  side.points[pointAt(side, {3, 3, 0})] = {2, 3, 0};
  EXPECT_EQ(improve(side).shortAfter, 0u);
}

TEST(MeshOptimizer, StopsWhenAsked)
{
  class Impatient : public atria::ProgressMonitor
  {
  public:
    void report(double fraction, const char*) override
    {
      EXPECT_GE(fraction, last);
      last = fraction;
    }
    bool aborted() const override { return last > 0.5; }
    double last = 0.0;
  };
  SampleMesh sample = tangled(1, 0.6);
  FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  Impatient monitor;
  const atria::SerialExecutor serial;
  EXPECT_THROW(optimizeMesh(mesh, sample.view(), {}, MeshOptimizerOptions(), {serial, atria::ProgressRange(monitor)}),
               atria::Aborted);
  EXPECT_EQ(mesh.points, sample.points);
}

} // namespace
