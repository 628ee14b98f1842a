// SPDX-License-Identifier: GPL-3.0-or-later
/// checkMesh as the referee of the quality and validity that we measure.
#include "OpenFOAMWriterTest.h"
#include "Quality/Checks/Metrics.h"
#include "Quality/Faces/Geometry.h"
#include "Support/CheckMesh.h"
#include "Support/QuietContext.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <span>

namespace {

namespace fs = std::filesystem;
using atria::FaceMesh;
using atria::testing::CheckMeshReport;
using atria::testing::facesOf;
using atria::testing::OpenFOAMWriter;
using atria::testing::SampleMesh;
using atria::testing::toGrid;
using atria::testing::toPatches;
using ::testing::HasSubstr;

constexpr std::array<int, 3> size{5, 4, 4};

atria::QualityMetrics qualityOf(const SampleMesh& sample, const FaceMesh& mesh)
{
  return computeQuality(mesh, sample.view(), atria::testing::quietContext());
}

/// To the digits that checkMesh prints, but for the last, which it may round the other way.
void expectSameDigits(double ours, double theirs, const char* what)
{
  EXPECT_NEAR(ours, theirs, 1e-10 * std::max(1.0, std::abs(theirs))) << what;
}

void expectSameQuality(const atria::QualityMetrics& ours, const CheckMeshReport& theirs)
{
  const auto greatest = [](std::span<const double> v) { return *std::max_element(v.begin(), v.end()); };
  expectSameDigits(greatest(ours.nonOrthogonality), theirs.maxNonOrthogonality, "non-orthogonality");
  double cosines = 0.0;
  for (const double angle : ours.nonOrthogonalityOfFaces)
  {
    cosines += std::cos(angle * std::numbers::pi / 180);
  }
  const double mean = std::acos(cosines / ours.nonOrthogonalityOfFaces.size()) * 180 / std::numbers::pi;
  expectSameDigits(mean, theirs.averageNonOrthogonality, "average non-orthogonality");
  expectSameDigits(greatest(ours.skewness), theirs.maxSkewness, "skewness");
  expectSameDigits(*std::min_element(ours.volume.begin(), ours.volume.end()), theirs.minVolume, "least volume");
  expectSameDigits(greatest(ours.volume), theirs.maxVolume, "greatest volume");
  expectSameDigits(std::accumulate(ours.volume.begin(), ours.volume.end(), 0.0), theirs.totalVolume, "volume");
}

TEST_F(OpenFOAMWriter, CheckMeshFindsAMixedMeshSoundAndAgreesOnItsQuality)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
  const SampleMesh sample = atria::testing::mixedCells(size, 3, 0.12);
  const FaceMesh mesh = facesOf(sample);
  const auto patches = toPatches(mesh, atria::testing::sidesOfBox(size));
  const atria::QualityMetrics ours = qualityOf(sample, mesh);
  ASSERT_EQ(ours.invalidCells, 0u);
  for (const bool binary : {false, true})
  {
    const fs::path target = folder(binary ? "binary" : "ascii");
    ASSERT_EQ(write(toGrid(sample), patches, binary, target), 1);
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    ASSERT_TRUE(report.completed) << report.log;
    EXPECT_EQ(report.counts.at("cells"), static_cast<long>(mesh.cellCount));
    EXPECT_EQ(report.counts.at("faces"), static_cast<long>(mesh.faceCount()));
    EXPECT_EQ(report.counts.at("internal faces"), static_cast<long>(mesh.internalFaceCount()));
    EXPECT_EQ(report.counts.at("boundary patches"), 6);
    // Random cells next to coplanar triangles are not all convex, and a corner's pyramid has but one
    // neighbor.
    EXPECT_THAT(report.failures, ::testing::Each(::testing::AnyOf(HasSubstr("Concave"), HasSubstr("determinant"))));
    for (const char* type : {"hexahedra", "prisms", "pyramids", "tetrahedra", "polyhedra"})
    {
      EXPECT_GT(report.cellsByType.at(type), 0) << type;
    }
    expectSameQuality(ours, report);
  }
}

TEST_F(OpenFOAMWriter, CheckMeshAgreesOnTheQualityOfDistortedMeshes)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const SampleMesh sample = atria::testing::mixedCells(size, seed, 0.3);
    const fs::path target = folder(("case" + std::to_string(seed)).c_str());
    ASSERT_EQ(write(toGrid(sample), nullptr, seed % 2 == 0, target), 1);
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    ASSERT_TRUE(report.completed) << report.log;
    const atria::QualityMetrics ours = qualityOf(sample, facesOf(sample));
    EXPECT_EQ(ours.invalidCells, 0u);
    expectSameQuality(ours, report);
  }
}

TEST_F(OpenFOAMWriter, CheckMeshAgreesOnWhichMeshesAreInvalid)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
  int invalidMeshes = 0;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    const SampleMesh sample = atria::testing::mixedCells({3, 3, 3}, seed, 0.75);
    const fs::path target = folder(("case" + std::to_string(seed)).c_str());
    ASSERT_EQ(write(toGrid(sample), nullptr, false, target), 1);
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    ASSERT_TRUE(report.completed) << report.log;
    const auto invalid = ::testing::AnyOf(HasSubstr("face pyramids"), HasSubstr("negative cell volume"));
    const bool theirs = std::any_of(report.failures.begin(), report.failures.end(),
                                    [&](const std::string& line) { return ::testing::Value(line, invalid); });
    EXPECT_EQ(qualityOf(sample, facesOf(sample)).invalidCells > 0, theirs) << report.log;
    invalidMeshes += theirs ? 1 : 0;
  }
  EXPECT_GT(invalidMeshes, 0);
  EXPECT_LT(invalidMeshes, 8);
}

} // namespace
