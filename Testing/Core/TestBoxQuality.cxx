// SPDX-License-Identifier: GPL-3.0-or-later
/// Quality without the faces of regular boxes: the same as with all faces, up to rounding.
#include "Quality/Checks/BoxQuality.h"
#include "Quality/Checks/Statistics.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

namespace {

using atria::AskedFaces;
using atria::BoundaryFaceKey;
using atria::Index;
using atria::QualityByBoxes;
using atria::QualityMetrics;
using atria::Vec3;
using atria::testing::SampleMesh;

/// Faces of a hexahedron, seen from outside.
constexpr std::array<std::array<int, 4>, 6> faces{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

std::vector<std::int64_t> cornersOf(const SampleMesh& mesh, std::size_t cell)
{
  return {mesh.connectivity.begin() + mesh.offsets[cell], mesh.connectivity.begin() + mesh.offsets[cell + 1]};
}

std::vector<std::int64_t> faceOf(const std::vector<std::int64_t>& corners, int face)
{
  std::vector<std::int64_t> out;
  std::ranges::transform(faces[face], std::back_inserter(out), [&](int i) { return corners[i]; });
  return out;
}

/// The eight parts of a hexahedron, with points of their own but at its corners: faces beside it do not fit.
void addParts(SampleMesh& mesh, const std::vector<std::int64_t>& corners)
{
  const Vec3 low = mesh.points[corners[0]];
  const Vec3 half = 0.5 * (mesh.points[corners[6]] - low);
  static constexpr std::array<std::array<int, 3>, 8> places{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  std::map<std::array<int, 3>, std::int64_t> made;
  for (int c = 0; c < 8; ++c)
  {
    made[{2 * places[c][0], 2 * places[c][1], 2 * places[c][2]}] = corners[c];
  }
  for (const auto& part : places)
  {
    std::vector<std::int64_t> ids;
    for (const auto& place : places)
    {
      const std::array<int, 3> at{part[0] + place[0], part[1] + place[1], part[2] + place[2]};
      const auto [entry, isNew] = made.insert({at, static_cast<std::int64_t>(mesh.points.size())});
      if (isNew)
      {
        mesh.points.push_back(low + Vec3(at[0] * half[0], at[1] * half[1], at[2] * half[2]));
      }
      ids.push_back(entry->second);
    }
    mesh.addCell(atria::hexahedronCell, ids);
  }
}

struct Sample
{
  SampleMesh mesh;
  std::vector<std::vector<std::int64_t>> patchPoints;
  std::vector<Index> patchCells;

  std::vector<BoundaryFaceKey> patches() const
  {
    std::vector<BoundaryFaceKey> keys;
    for (std::size_t i = 0; i < patchCells.size(); ++i)
    {
      keys.push_back({patchCells[i], patchPoints[i]});
    }
    return keys;
  }
};

/// A grid of boxes of different sizes of which a few are left out, moved, made polyhedra or divided, and in which a few
/// faces are those of sheets.
Sample randomSample(unsigned seed)
{
  std::mt19937 random(seed);
  const auto oneIn = [&](int n) { return std::uniform_int_distribution(1, n)(random) == 1; };
  std::uniform_real_distribution<double> some(-0.2, 0.2);
  const SampleMesh grid = atria::testing::hexahedra({28, 26, 27});
  Sample out;
  out.mesh.points = grid.points;
  for (Vec3& p : out.mesh.points)
  {
    p = Vec3(0.1 * p[0] * (1.0 + 0.1 * p[0]), 0.3 * p[1], p[2] / 3.0);
  }
  for (std::size_t c = 0; c < grid.types.size(); ++c)
  {
    const std::vector<std::int64_t> corners = cornersOf(grid, c);
    if (oneIn(3000))
    {
      continue;
    }
    if (oneIn(3000))
    {
      addParts(out.mesh, corners);
      continue;
    }
    if (oneIn(3000))
    {
      std::vector<std::vector<std::int64_t>> polygons;
      for (int f = 0; f < 6; ++f)
      {
        polygons.push_back(faceOf(corners, f));
      }
      out.mesh.addPolyhedron(polygons);
      continue;
    }
    if (oneIn(3000))
    {
      const int f = std::uniform_int_distribution(0, 5)(random);
      out.patchCells.push_back(static_cast<Index>(out.mesh.types.size()));
      out.patchPoints.push_back(faceOf(corners, f));
    }
    out.mesh.addCell(atria::hexahedronCell, corners);
  }
  for (int i = 0; i < 5; ++i)
  {
    out.mesh.points[random() % grid.points.size()] += 0.1 * Vec3(some(random), some(random), some(random));
  }
  return out;
}

std::optional<QualityByBoxes> byBoxes(const SampleMesh& mesh, const AskedFaces& asked = {},
                                      const atria::Executor& executor = atria::SerialExecutor(),
                                      std::size_t length = atria::measuredAtOnce)
{
  return computeQualityByBoxes(mesh.points, mesh.view(), asked, atria::testing::quietContext(executor), length);
}

QualityMetrics whole(const SampleMesh& mesh, std::span<const BoundaryFaceKey> patches = {})
{
  return computeQuality(makeFaceMesh(mesh.points, mesh.view(), patches), mesh.view(), atria::testing::quietContext());
}

void expectNear(double a, double b, double scale, const char* what, std::size_t cell)
{
  EXPECT_TRUE(std::abs(a - b) <= 1e-12 * scale || (std::isnan(a) && std::isnan(b)))
      << what << " of cell " << cell << ": " << a << ", " << b;
}

/// Values and so many zeros, in order.
std::vector<double> sorted(const atria::Buffer<double>& values, std::size_t zeros)
{
  std::vector<double> out(values.begin(), values.end());
  out.resize(out.size() + zeros, 0.0);
  std::ranges::sort(out);
  return out;
}

void expectSameFaces(const QualityByBoxes& boxes, const QualityMetrics& all)
{
  const std::array<atria::Buffer<double> QualityMetrics::*, 3> metrics{
      &QualityMetrics::squishOfFaces, &QualityMetrics::nonOrthogonalityOfFaces, &QualityMetrics::skewnessOfFaces};
  for (const auto metric : metrics)
  {
    const std::vector<double> a = sorted(boxes.metrics.*metric, boxes.idealFaces);
    const std::vector<double> b = sorted(all.*metric, 0);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      ASSERT_NEAR(a[i], b[i], metric == &QualityMetrics::nonOrthogonalityOfFaces ? 2e-6 : 1e-12) << i;
    }
  }
}

void expectSame(const QualityByBoxes& boxes, const QualityMetrics& all)
{
  ASSERT_EQ(boxes.isRegular.size(), all.volume.size());
  std::vector<Index> place(all.volume.size(), atria::noIndex);
  for (Index i = 0; i < boxes.others.size(); ++i)
  {
    place[boxes.others[i]] = i;
  }
  const QualityMetrics& q = boxes.metrics;
  for (std::size_t c = 0; c < place.size(); ++c)
  {
    const Index i = place[c];
    ASSERT_EQ(i == atria::noIndex, boxes.isRegular[c] != 0) << c;
    const auto of = [&](const auto& values, double ofBox) { return i == atria::noIndex ? ofBox : values[i]; };
    expectNear(of(q.cellSquish, 0.0), all.cellSquish[c], 1.0, "squish", c);
    expectNear(of(q.faceSquish, 0.0), all.faceSquish[c], 1.0, "squish of faces", c);
    expectNear(of(q.aspectRatio, boxes.aspectRatios[c]), all.aspectRatio[c], all.aspectRatio[c], "aspect ratio", c);
    expectNear(of(q.orthogonalQuality, 1.0), all.orthogonalQuality[c], 1.0, "orthogonal quality", c);
    expectNear(of(q.nonOrthogonality, 0.0), all.nonOrthogonality[c], 2e6, "non-orthogonality", c);
    expectNear(of(q.skewness, 0.0), all.skewness[c], 1.0, "skewness", c);
    expectNear(of(q.volume, boxes.volumes[c]), all.volume[c], all.volume[c], "volume", c);
    expectNear(of(q.facePyramids, boxes.volumes[c] / 6.0), all.facePyramids[c], all.volume[c], "pyramids", c);
    expectNear(of(q.scaledJacobian, 1.0), all.scaledJacobian[c], 1.0, "scaled Jacobian", c);
    EXPECT_EQ(i == atria::noIndex ? 1 : q.valid[i], all.valid[c]) << c;
  }
  EXPECT_EQ(q.invalidCells, all.invalidCells);
  expectSameFaces(boxes, all);
}

TEST(BoxQuality, IsThatOfTheWholeMesh)
{
  int known = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const Sample sample = randomSample(seed);
    const std::vector<BoundaryFaceKey> patches = sample.patches();
    QualityMetrics all;
    try
    {
      all = whole(sample.mesh, patches);
    }
    catch (const atria::Error&)
    {
      EXPECT_FALSE(byBoxes(sample.mesh, {patches, false, {}, {}}));
      continue;
    }
    for (const std::size_t length : {300u, 100000u})
    {
      const std::optional<QualityByBoxes> boxes =
          byBoxes(sample.mesh, {patches, false, {}, {}}, atria::SerialExecutor(), length);
      ASSERT_TRUE(boxes);
      EXPECT_GT(boxes->regularCount, boxes->others.size());
      expectSame(*boxes, all);
      ++known;
    }
  }
  EXPECT_GT(known, 60);
}

TEST(BoxQuality, OfAPlainGridOnlyItsBorderIsMeasured)
{
  const SampleMesh mesh = atria::testing::hexahedra({24, 24, 24});
  const std::optional<QualityByBoxes> boxes = byBoxes(mesh);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->regularCount, 10648u);
  expectSame(*boxes, whole(mesh));
}

TEST(BoxQuality, HasTheSameBitsForAnyNumberOfThreads)
{
  const Sample sample = randomSample(3);
  const std::vector<BoundaryFaceKey> patches = sample.patches();
  const auto serial = byBoxes(sample.mesh, {patches, false, {}, {}});
  ASSERT_TRUE(serial);
  for (const int threads : {2, 7})
  {
    const auto other = byBoxes(sample.mesh, {patches, false, {}, {}}, atria::ThreadExecutor(threads));
    ASSERT_TRUE(other);
    EXPECT_EQ(other->others, serial->others);
    EXPECT_EQ(other->idealFaces, serial->idealFaces);
    EXPECT_EQ(other->metrics.skewness, serial->metrics.skewness);
    EXPECT_EQ(other->metrics.squishOfFaces, serial->metrics.squishOfFaces);
  }
}

TEST(BoxQuality, OfMeshesWithoutBoxesIsThatOfTheWholeMesh)
{
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE(seed);
    const SampleMesh mesh = atria::testing::mixedCells({6, 5, 7}, seed, 0.1);
    for (const std::size_t length : {7u, 50u})
    {
      SCOPED_TRACE(length);
      const std::optional<QualityByBoxes> boxes = byBoxes(mesh, {}, atria::SerialExecutor(), length);
      ASSERT_TRUE(boxes);
      expectSame(*boxes, whole(mesh));
    }
    EXPECT_FALSE(byBoxes(mesh)); // it would be one window
  }
}

TEST(BoxQuality, LeavesWhatIsWrongToTheWholeMesh)
{
  const SampleMesh mesh = atria::testing::hexahedra({24, 24, 24});
  ASSERT_TRUE(byBoxes(mesh));
  SampleMesh wrong = mesh;
  wrong.types[7000] = 99;
  EXPECT_FALSE(byBoxes(wrong));
  wrong = mesh;
  wrong.connectivity[5000] = 1000000;
  EXPECT_FALSE(byBoxes(wrong));
  wrong.connectivity[5000] = -1;
  EXPECT_FALSE(byBoxes(wrong));
  wrong = mesh;
  wrong.offsets[40] += 1;
  EXPECT_FALSE(byBoxes(wrong));
  wrong.offsets[40] = -5;
  EXPECT_FALSE(byBoxes(wrong));
  wrong = mesh;
  wrong.addCell(atria::hexahedronCell, cornersOf(mesh, 5850)); // the same cell twice
  EXPECT_FALSE(byBoxes(wrong));
}

TEST(BoxQuality, KnowsFacesOfPatchesAndZones)
{
  const SampleMesh mesh = atria::testing::hexahedra({24, 24, 24});
  const Index cell = 5 + 24 * (6 + 24 * 7);
  const std::vector<std::int64_t> points = faceOf(cornersOf(mesh, cell), 1);
  const std::vector<BoundaryFaceKey> face{{cell, points}};
  std::vector<Index> beyond;
  for (Index c = 0; c < mesh.types.size(); ++c)
  {
    const std::vector<std::int64_t> corners = cornersOf(mesh, c);
    if (c != cell && std::ranges::all_of(points, [&](std::int64_t p) { return std::ranges::count(corners, p) == 1; }))
    {
      beyond.push_back(c);
    }
  }
  ASSERT_EQ(beyond.size(), 1u);
  const std::vector<Index> elsewhere{cell};
  const auto sheet = byBoxes(mesh, {face, false, {}, {}});
  ASSERT_TRUE(sheet);
  expectSame(*sheet, whole(mesh, face));
  EXPECT_TRUE(byBoxes(mesh, {{}, false, face, beyond}));
  EXPECT_FALSE(byBoxes(mesh, {{}, false, face, elsewhere}));
  EXPECT_FALSE(byBoxes(mesh, {face, false, face, beyond})); // it is on the boundary
  const std::vector<BoundaryFaceKey> other{{cell + 20, points}};
  EXPECT_FALSE(byBoxes(mesh, {other, false, {}, {}}));
  const std::vector<BoundaryFaceKey> twice{face[0], face[0]};
  EXPECT_FALSE(byBoxes(mesh, {twice, false, {}, {}}));
}

TEST(BoxQuality, KnowsWhetherPatchesAreTheBoundary)
{
  const SampleMesh mesh = atria::testing::hexahedra({24, 24, 24});
  const atria::FaceMesh all = makeFaceMesh(mesh.points, mesh.view());
  std::vector<std::vector<std::int64_t>> points;
  std::vector<BoundaryFaceKey> boundary;
  points.reserve(all.faceCount());
  for (std::size_t f = all.internalFaceCount(); f < all.faceCount(); ++f)
  {
    points.emplace_back(all.face(f).begin(), all.face(f).end());
    boundary.push_back({all.owner[f], points.back()});
  }
  EXPECT_TRUE(byBoxes(mesh, {boundary, true, {}, {}}));
  boundary.pop_back();
  EXPECT_FALSE(byBoxes(mesh, {boundary, true, {}, {}}));
  EXPECT_TRUE(byBoxes(mesh, {boundary, false, {}, {}}));
}

TEST(Statistics, RepeatedValuesCountAsIfTheyWereThere)
{
  const std::vector<double> values{3.0, -1.5, 0.25, 8.0, 8.0};
  for (const double repeated : {0.0, 1.0, 11.0})
  {
    std::vector<double> all = values;
    all.resize(values.size() + 37, repeated);
    const atria::Distribution a = atria::distributionOf(values, 9, atria::SerialExecutor(), {repeated, 37});
    const atria::Distribution b = atria::distributionOf(all, 9);
    EXPECT_EQ(a.statistics.count, b.statistics.count);
    EXPECT_EQ(a.statistics.minimum, b.statistics.minimum);
    EXPECT_EQ(a.statistics.maximum, b.statistics.maximum);
    EXPECT_NEAR(a.statistics.mean, b.statistics.mean, 1e-14);
    EXPECT_NEAR(a.statistics.standardDeviation, b.statistics.standardDeviation, 1e-14);
    EXPECT_EQ(a.histogram.cumulative, b.histogram.cumulative);
  }
  const atria::Distribution alone = atria::distributionOf({}, 3, atria::SerialExecutor(), {2.0, 5});
  EXPECT_EQ(alone.statistics.count, 5u);
  EXPECT_EQ(alone.statistics.mean, 2.0);
  EXPECT_EQ(alone.statistics.standardDeviation, 0.0);
}

} // namespace
