// SPDX-License-Identifier: GPL-3.0-or-later
/// What checkMesh judges, on cells whose values are known. That the real checkMesh finds the same is tested with the
/// filters.
#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Checks/MeshChecks.h"
#include "Quality/Checks/Metrics.h"
#include "Support/Error.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

using namespace atria;
using atria::testing::SampleMesh;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A sample mesh measured, with all it is made of.
class Sample
{
public:
  explicit Sample(const SampleMesh& sample, int numberOfThreads = 1)
      : threads(numberOfThreads), mesh(makeFaceMesh(sample.points, sample.view())),
        measured(measureMesh(mesh, context()))
  {
  }

  RunContext context() { return atria::testing::quietContext(threads); }
  std::vector<double> values(CheckQuantity quantity) { return measure(measured, quantity, context()); }
  std::vector<double> ofCells(CheckQuantity quantity)
  {
    return worstOverFaces(measured, values(quantity), describe(quantity).greaterIsWorse, context());
  }
  MeshVerdict verdict() { return checkMesh(measured, context()); }

  ThreadExecutor threads;
  FaceMesh mesh;
  MeasuredMesh measured;
};

/// Two boxes beside each other, the second `length` long.
SampleMesh twoBoxes(double length)
{
  SampleMesh mesh = atria::testing::hexahedra({2, 1, 1});
  for (Vec3& p : mesh.points)
  {
    p[0] = p[0] > 1.5 ? 1.0 + length : p[0];
  }
  return mesh;
}

TEST(CheckQuantities, AreIdealInACubeAmongCubes)
{
  Sample cubes(atria::testing::hexahedra({3, 3, 3}));
  constexpr Index middle = 13;
  EXPECT_NEAR(cubes.values(CheckQuantity::Openness)[middle], 0.0, 1e-14);
  EXPECT_NEAR(cubes.values(CheckQuantity::AreaAspectRatio)[middle], 1.0, 1e-14);
  EXPECT_NEAR(cubes.values(CheckQuantity::Determinant)[middle], 1.0, 1e-14);
  EXPECT_NEAR(cubes.values(CheckQuantity::Concavity)[middle], -std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(cubes.ofCells(CheckQuantity::FaceWeight)[middle], 0.5, 1e-14);
  EXPECT_NEAR(cubes.ofCells(CheckQuantity::VolumeRatio)[middle], 1.0, 1e-14);
  EXPECT_NEAR(cubes.ofCells(CheckQuantity::FaceFlatness)[middle], 1.0, 1e-14);
  EXPECT_EQ(cubes.ofCells(CheckQuantity::FaceConcaveAngle)[middle], 0.0);
  EXPECT_NEAR(cubes.ofCells(CheckQuantity::EdgeLength)[middle], 1.0, 1e-14);
}

TEST(CheckQuantities, HaveTheirNamesInOrder)
{
  for (std::size_t i = 0; i < checkQuantityCount; ++i)
  {
    EXPECT_EQ(static_cast<std::size_t>(checkQuantities()[i].quantity), i);
    EXPECT_EQ(describe(checkQuantities()[i].quantity).name, checkQuantities()[i].name);
  }
}

TEST(CheckQuantities, WeightAndVolumeRatioTellHowMuchNeighborsDiffer)
{
  for (const double length : {0.5, 0.1, 1e-3})
  {
    Sample boxes(twoBoxes(length));
    EXPECT_NEAR(boxes.values(CheckQuantity::FaceWeight)[0], length / (1.0 + length), 1e-12);
    EXPECT_NEAR(boxes.values(CheckQuantity::VolumeRatio)[0], length, 1e-12);
    EXPECT_NEAR(boxes.values(CheckQuantity::AreaAspectRatio)[1], 1.0 / length, 1e-9 / length);
    EXPECT_NEAR(boxes.ofCells(CheckQuantity::EdgeLength)[1], length, 1e-12);
  }
}

TEST(CheckQuantities, ACellIsDeterminedByInternalFacesInThreeDirections)
{
  EXPECT_THAT(Sample(atria::testing::hexahedra({3, 1, 1})).values(CheckQuantity::Determinant), Each(0.0));
  EXPECT_THAT(Sample(atria::testing::hexahedra({3, 3, 1})).values(CheckQuantity::Determinant), Each(0.0));
  // Of the corner of a block each direction has one internal face instead of two: an eighth.
  EXPECT_NEAR(Sample(atria::testing::hexahedra({2, 2, 2})).values(CheckQuantity::Determinant)[0], 0.125, 1e-14);
}

TEST(CheckQuantities, TwoFacesInAPlaneAreConcavityNull)
{
  // A cube whose top is cut in two: its halves lie in one plane.
  SampleMesh cube = atria::testing::hexahedra({1, 1, 1});
  SampleMesh cut;
  cut.points = cube.points;
  cut.addPolyhedron({{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7}, {4, 7, 6}});
  EXPECT_NEAR(Sample(cut).values(CheckQuantity::Concavity)[0], 0.0, 1e-14);
  EXPECT_THAT(Sample(cut).verdict()["Concavity"].failing, ElementsAre(0));
  for (const double lift : {0.2, -0.2})
  {
    // Corners 5 and 6 up make a valley in the roof, down a ridge.
    cut.points[5][2] = cut.points[6][2] = 1.0 + lift;
    const double value = Sample(cut).values(CheckQuantity::Concavity)[0];
    EXPECT_EQ(value > 0.0, lift > 0.0) << lift;
  }
}

TEST(CheckQuantities, FlatnessIsTheShareOfTheAreaThatIsLeftOfAWarpedFace)
{
  SampleMesh box = atria::testing::hexahedra({1, 1, 1});
  double before = 1.0;
  for (const double lift : {0.1, 0.3, 0.9})
  {
    box.points[7][2] = 1.0 + lift;
    const double flatness = Sample(box).ofCells(CheckQuantity::FaceFlatness)[0];
    EXPECT_LT(flatness, before);
    EXPECT_GT(flatness, 0.0);
    before = flatness;
  }
}

TEST(CheckQuantities, ConcaveAngleIsTheTurnAtTheReEntrantCorner)
{
  // Corner 3 of the faces z = 0 and 1 moved inwards: the edges meet there at a right angle, turned the wrong way.
  SampleMesh box = atria::testing::hexahedra({1, 1, 1});
  for (const double depth : {0.6, 0.75, 1.0})
  {
    box.points[3] = Vec3(1.0 - depth, 1.0 - depth, 0.0);
    box.points[7] = Vec3(1.0 - depth, 1.0 - depth, 1.0);
    const Vec3 in = box.points[3] - box.points[1];
    const Vec3 out = box.points[2] - box.points[3];
    const double sine = std::abs(in[0] * out[1] - in[1] * out[0]) / (in.norm() * out.norm());
    EXPECT_NEAR(Sample(box).ofCells(CheckQuantity::FaceConcaveAngle)[0], std::asin(sine) * 180.0 / M_PI, 1e-9) << depth;
    EXPECT_THAT(Sample(box).verdict()["FaceConcaveAngle"].failing, SizeIs(2));
  }
}

TEST(CheckQuantities, TetQualityTellsWhereTheCentroidDoesNotSeeAFace)
{
  SampleMesh boxes = twoBoxes(1.0);
  EXPECT_GT(Sample(boxes).ofCells(CheckQuantity::TetQuality)[0], 0.0);
  boxes.points[1] = Vec3(3.0, 0.0, 0.0); // beyond the second box
  EXPECT_LT(Sample(boxes).ofCells(CheckQuantity::TetQuality)[1], 0.0);
}

TEST(MeshChecks, NameWhatFailsAndWhatItCounts)
{
  Sample row(atria::testing::hexahedra({4, 1, 1}));
  const MeshVerdict verdict = row.verdict();
  EXPECT_THAT(verdict["Determinant"].failing, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(verdict["Openness"].failing, IsEmpty());
  EXPECT_EQ(verdict.failedChecks(), 1);
  EXPECT_FALSE(verdict.ok());
  EXPECT_THROW(verdict["Beauty"], Error);
}

TEST(MeshChecks, CellsKnowTheChecksTheyFail)
{
  Sample sample(atria::testing::mixedCells({4, 4, 4}, 3, 0.45));
  const MeshVerdict verdict = sample.verdict();
  const std::vector<std::uint32_t> bits = failedChecksOfCells(sample.measured, verdict);
  ASSERT_EQ(bits.size(), sample.mesh.cellCount);
  for (std::size_t i = 0; i < verdict.checks.size(); ++i)
  {
    const MeshCheck& check = verdict.checks[i];
    std::vector<bool> wanted(bits.size(), false);
    for (const Index id : check.failing)
    {
      if (check.part == MeshPart::Cells)
      {
        wanted[id] = true;
      }
      else if (check.part == MeshPart::Faces)
      {
        wanted[sample.mesh.owner[id]] = true;
        if (id < sample.mesh.internalFaceCount())
        {
          wanted[sample.mesh.neighbor[id]] = true;
        }
      }
    }
    for (std::size_t c = 0; c < bits.size(); ++c)
    {
      EXPECT_EQ((bits[c] >> i & 1U) != 0, wanted[c]) << check.name << ", cell " << c;
    }
  }
}

TEST(MeshChecks, AgreeWithTheMetrics)
{
  const SampleMesh cells = atria::testing::mixedCells({5, 5, 5}, 9, 0.3);
  Sample sample(cells);
  const MeshVerdict verdict = sample.verdict();
  const QualityMetrics metrics = computeQuality(sample.measured, cells.view(), sample.context());
  EXPECT_EQ(verdict["Skewness"].worst, *std::max_element(metrics.skewness.begin(), metrics.skewness.end()));
  EXPECT_EQ(verdict["Volume"].worst, *std::min_element(metrics.volume.begin(), metrics.volume.end()));
  EXPECT_NEAR(verdict["NonOrthogonality"].worst,
              *std::max_element(metrics.nonOrthogonality.begin(), metrics.nonOrthogonality.end()), 1e-9);
  EXPECT_NEAR(verdict["FacePyramids"].worst,
              *std::min_element(metrics.facePyramids.begin(), metrics.facePyramids.end()), 1e-14);
  for (std::size_t c = 0; c < metrics.valid.size(); ++c)
  {
    // A cell is valid where its volume and pyramids are positive and it is closed, whichever function says so.
    bool sound = metrics.volume[c] > 0.0 && sample.values(CheckQuantity::Openness)[c] <= 1e-6;
    for (const Index f : sample.measured.cellFaces.of(c))
    {
      sound = sound && pyramidVolume(sample.measured, f, static_cast<Index>(c)) > 0.0;
    }
    EXPECT_EQ(metrics.valid[c] == 1, sound) << c;
  }
}

TEST(MeshChecks, HaveTheSameBitsForAnyNumberOfThreads)
{
  const SampleMesh mesh = atria::testing::mixedCells({24, 24, 24}, 5, 0.4);
  Sample one(mesh);
  Sample seven(mesh, 7);
  for (const CheckQuantityInfo& info : checkQuantities())
  {
    const std::vector<double> a = one.values(info.quantity);
    const std::vector<double> b = seven.values(info.quantity);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0) << info.name;
  }
  const MeshVerdict first = one.verdict();
  const MeshVerdict second = seven.verdict();
  for (std::size_t i = 0; i < first.checks.size(); ++i)
  {
    EXPECT_EQ(first.checks[i].failing, second.checks[i].failing) << first.checks[i].name;
    EXPECT_EQ(std::memcmp(&first.checks[i].mean, &second.checks[i].mean, sizeof(double)), 0) << first.checks[i].name;
  }
}

TEST(MeshChecks, StopWhenAsked)
{
  struct Impatient : ProgressMonitor
  {
    void report(double, const char*) override { ++reports; }
    bool aborted() const override { return reports > 3; }
    int reports = 0;
  } impatient;
  Sample sample(atria::testing::hexahedra({3, 3, 3}));
  EXPECT_THROW(checkMesh(sample.measured, {sample.threads, ProgressRange(impatient)}), Aborted);
}

} // namespace
