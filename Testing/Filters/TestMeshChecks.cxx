// SPDX-License-Identifier: GPL-3.0-or-later
/// What checkMesh() of the core finds is what OpenFOAM's checkMesh finds: the same cells and faces in its sets, the
/// same figures in its report.
#include "DualMesherTest.h"
#include "Quality/Checks/CheckQuantities.h"
#include "Quality/Checks/MeshChecks.h"
#include "Support/CheckMesh.h"
#include "Support/CheckWarnings.h"
#include "Support/QuietContext.h"
#include "Support/SampleGrid.h"
#include "Support/TestPaths.h"
#include "VtkFaceMesh.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkNew.h>
#include <vtkPoints.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using atria::Index;
using atria::MeshCheck;
using atria::MeshPart;
using atria::MeshVerdict;
using atria::Vec3;
using atria::testing::CheckMeshReport;
using atria::testing::SampleMesh;

/// The numbers in a set that checkMesh wrote; none without one.
std::set<Index> readSet(const fs::path& caseFolder, const std::string& name)
{
  std::set<Index> ids;
  const std::string text = atria::testing::bytesOf(caseFolder / "constant" / "polyMesh" / "sets" / name);
  const std::size_t begin = text.rfind('(');
  if (begin == std::string::npos || text.find(')', begin) == std::string::npos)
  {
    return ids;
  }
  std::istringstream numbers(text.substr(begin + 1, text.find(')', begin) - begin - 1));
  for (Index id = 0; numbers >> id;)
  {
    ids.insert(id);
  }
  return ids;
}

/// The number after a text, in what comes after "Checking geometry".
std::optional<double> figure(const std::string& log, const std::string& text)
{
  const std::size_t at = log.find(text, log.find("Checking geometry"));
  return at == std::string::npos ? std::nullopt : std::optional(std::strtod(log.c_str() + at + text.size(), nullptr));
}

class MeshChecks : public atria::testing::DualMesherTest
{
protected:
  void SetUp() override
  {
    if (!atria::testing::haveCheckMesh())
    {
      GTEST_SKIP() << atria::testing::withoutCheckMesh;
    }
  }

  /// Compares everything; returns the core's verdict.
  MeshVerdict expectAgreement(vtkUnstructuredGrid* grid, vtkPartitionedDataSetCollection* patches = nullptr)
  {
    const atria::testing::ScratchFolder scratch;
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetInputDataObject(0, grid);
    if (patches)
    {
      writer->SetInputDataObject(1, patches);
    }
    writer->SetCaseDirectory(scratch.path().c_str());
    writer->MergeUnderdeterminedCellsOff();
    writer->MergeCoplanarFacesOff(); // ours are the checks of the mesh as it is
    EXPECT_EQ(writer->Write(), 1);
    EXPECT_EQ(messages.takeWarnings("No patches were given").size(), patches ? 0u : 1u);
    atria::testing::expectCheckWarnings(messages, writer->GetChecks());
    const CheckMeshReport report = atria::testing::runCheckMesh(scratch.path(), "-allGeometry");
    EXPECT_TRUE(report.completed) << report.log;

    const atria::FaceMesh mesh = atria::faceMeshFromVtk(grid, patches).mesh;
    const atria::RunContext context = atria::testing::quietContext();
    const MeshVerdict verdict = checkMesh(measureMesh(mesh, context), context);
    for (const MeshCheck& check : verdict.checks)
    {
      expectSet(check, scratch.path(), mesh.internalFaceCount(), !patches);
    }
    expectNearPoints(verdict, scratch.path());
    expectFigures(verdict, report.log);
    const std::string geometry = report.log.substr(report.log.find("Checking geometry"));
    int failures = 0;
    for (std::size_t at = geometry.find("\n ***"); at != std::string::npos; at = geometry.find("\n ***", at + 1))
    {
      ++failures;
    }
    EXPECT_EQ(verdict.failedChecks(), failures) << geometry;
    EXPECT_EQ(writer->GetNumberOfFailedChecks(), failures) << geometry;
    return verdict;
  }

  MeshVerdict expectAgreement(const SampleMesh& sample) { return expectAgreement(atria::testing::toGrid(sample)); }

private:
  /// With patches, a polyMesh has its boundary faces in another order: they are counted.
  static void expectSet(const MeshCheck& check, const fs::path& folder, std::size_t internalFaces, bool sameOrder)
  {
    const std::string name = check.set;
    if (name.empty() || check.name == std::string("PointDistance"))
    {
      return;
    }
    std::set<Index> theirs = readSet(folder, name);
    std::set<Index> ours(check.failing.begin(), check.failing.end());
    EXPECT_EQ(theirs.size(), ours.size()) << name;
    if (check.part == MeshPart::Faces && !sameOrder)
    {
      theirs.erase(theirs.lower_bound(static_cast<Index>(internalFaces)), theirs.end());
      ours.erase(ours.lower_bound(static_cast<Index>(internalFaces)), ours.end());
    }
    EXPECT_EQ(theirs, ours) << name;
  }

  /// checkMesh adds the ends of short edges to points that are near, and writes no set where that is all.
  static void expectNearPoints(const MeshVerdict& verdict, const fs::path& folder)
  {
    const auto& shortEdges = verdict["EdgeLength"].failing;
    const auto& near = verdict["PointDistance"].failing;
    std::set<Index> ours(shortEdges.begin(), shortEdges.end());
    ours.insert(near.begin(), near.end());
    EXPECT_EQ(readSet(folder, "nearPoints"), ours.size() > shortEdges.size() ? ours : std::set<Index>());
  }

  static void expectFigures(const MeshVerdict& verdict, const std::string& log)
  {
    struct Printed
    {
      const char* check;
      std::vector<const char*> texts; ///< what the number stands after, where the check passes and where it fails
      bool isMean;
    };
    const Printed all[]{
        {"Openness", {"Max cell openness = ", "max cell openness: "}, false},
        {"AreaAspectRatio", {"Max aspect ratio = ", "Max aspect ratio: "}, false},
        {"FaceArea", {"Minimum face area = ", "Minimum area: "}, false},
        {"Volume", {"Min volume = ", "Minimum negative volume: "}, false},
        {"NonOrthogonality", {"Mesh non-orthogonality Max: "}, false},
        {"NonOrthogonality", {" average: "}, true},
        {"Skewness", {"Max skewness = "}, false},
        {"EdgeLength", {"Min/max edge length = ", "min/max edge length = "}, false},
        {"FaceFlatness", {"(1 = flat, 0 = butterfly) : min = "}, false},
        {"FaceConcaveAngle", {"Max concave angle = "}, false},
        {"Determinant", {"Cell determinant (wellposedness) : minimum: "}, false},
        {"FaceWeight", {"Face interpolation weight : minimum: "}, false},
        {"VolumeRatio", {"Face volume ratio : minimum: "}, false},
    };
    int compared = 0;
    for (const Printed& printed : all)
    {
      for (const char* text : printed.texts)
      {
        if (const auto theirs = figure(log, text))
        {
          const double ours = printed.isMean ? verdict[printed.check].mean : verdict[printed.check].worst;
          // checkMesh prints twelve digits; near 0 degrees the arc cosine has but half of them.
          const double digits = std::string(printed.check) == "NonOrthogonality" ? 1e-6 : 1e-15;
          EXPECT_NEAR(ours, *theirs, 1e-11 * std::abs(*theirs) + digits) << text;
          ++compared;
        }
      }
    }
    EXPECT_GE(compared, 9) << log;
  }
};

/// Moves some points far: cells are turned inside out, folded and stretched.
void damage(SampleMesh& mesh, unsigned seed, double share, double distance)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  std::uniform_real_distribution<double> move(-distance, distance);
  for (Vec3& p : mesh.points)
  {
    const Vec3 way(move(random), move(random), move(random));
    if (chance(random) < share)
    {
      p += way;
    }
  }
}

TEST_F(MeshChecks, CubesPassAll)
{
  const MeshVerdict verdict = expectAgreement(atria::testing::hexahedra({3, 3, 3}));
  EXPECT_TRUE(verdict.ok());
  EXPECT_EQ(verdict.checks.size(), 18u);
}

TEST_F(MeshChecks, AgreeOnDamagedMeshes)
{
  std::set<std::string> failed;
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    SampleMesh mesh = atria::testing::mixedCells({4, 4, 4}, seed, seed % 3 == 0 ? 0.4 : 0.1);
    damage(mesh, seed, seed % 2 == 0 ? 0.05 : 0.5, 0.2 * seed);
    SCOPED_TRACE(seed);
    for (const MeshCheck& check : expectAgreement(mesh).checks)
    {
      if (!check.failing.empty())
      {
        failed.insert(check.name);
      }
    }
  }
  for (const char* name : {"Volume", "FacePyramids", "NonOrthogonality", "NonOrthogonalityError", "Skewness",
                           "TetQuality", "FaceFlatness", "FaceConcaveAngle", "Concavity", "FaceWeight", "VolumeRatio"})
  {
    EXPECT_EQ(failed.count(name), 1u) << name << " was never put to the test";
  }
}

TEST_F(MeshChecks, AgreeOnLayersTooThin)
{
  for (const double height : {1e-2, 1e-3, 1e-7, 1e-16, 0.0})
  {
    SCOPED_TRACE(height);
    SampleMesh mesh = atria::testing::hexahedra({4, 4, 4});
    for (Vec3& p : mesh.points)
    {
      p[2] = p[2] > 1.5 ? p[2] - 1.0 + height : p[2];
    }
    const MeshVerdict verdict = expectAgreement(mesh);
    EXPECT_FALSE(verdict.ok());
  }
}

TEST_F(MeshChecks, AgreeOnOpenCellsAndLonelyOnes)
{
  SampleMesh mesh = atria::testing::mixedCells({3, 3, 3}, 4, 0.1);
  const auto first = static_cast<std::int64_t>(mesh.points.size());
  for (const Vec3& p : {Vec3(9, 0, 0), Vec3(10, 0, 0), Vec3(10, 1, 0), Vec3(9, 1, 0), Vec3(9.4, 0.3, 1)})
  {
    mesh.points.push_back(p);
  }
  mesh.addPolyhedron({{first, first + 3, first + 2, first + 1},
                      {first, first + 1, first + 4},
                      {first + 1, first + 2, first + 4},
                      {first + 2, first + 3, first + 4}});
  const MeshVerdict verdict = expectAgreement(mesh);
  const auto open = static_cast<Index>(mesh.types.size() - 1);
  EXPECT_THAT(verdict["Openness"].failing, ::testing::ElementsAre(open));
  EXPECT_THAT(verdict["Determinant"].failing, ::testing::Contains(open));
  EXPECT_THAT(verdict["BoundaryOpenness"].failing, ::testing::ElementsAre(0));
}

TEST_F(MeshChecks, AgreeOnSpheres)
{
  for (const double sizeMax : {0.4, 3.2})
  {
    mesher->SetInputDataObject(atria::testing::exampleModel("sphere_in_cube.wrl"));
    mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
    mesher->SetSizeMax(sizeMax);
    mesher->SetSizeMid(0.4);
    mesher->SetSizeMin(0.4);
    mesher->Update();
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    expectAgreement(volume(), patches());
  }
}

TEST_F(MeshChecks, AgreeOnHouses)
{
  for (const char* model : {"house.wrl", "house_turned17.wrl"})
  {
    SCOPED_TRACE(model);
    mesher->SetInputDataObject(atria::testing::exampleModel(model));
    mesher->SetDomainMode(vtkAtriaDualMesher::Site);
    mesher->SetSizeMax(8.0);
    mesher->SetSizeMid(2.0);
    mesher->SetSizeMin(1.0);
    mesher->Update();
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    const MeshVerdict verdict = expectAgreement(volume(), patches());
    EXPECT_FALSE(verdict["PointDistance"].failing.empty()) << "the two sides of a sheet have points of their own";
    EXPECT_EQ(verdict["PointDistance"].worst, 0.0);
  }
}

TEST_F(MeshChecks, AgreeOnSoups)
{
  mesher->SetDomainMode(vtkAtriaDualMesher::Explicit);
  mesher->SetDomainBounds(-4.1, 4.2, -4.3, 4.1, -4.2, 4.3);
  mesher->SetSizeMax(1.0);
  mesher->SetSizeMid(0.5);
  mesher->SetSizeMin(0.25);
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    mesher->SetInputDataObject(atria::testing::toPolyData(atria::testing::randomSoup(seed)));
    mesher->Update();
    messages.takeWarnings(atria::testing::cutAtSides);
    messages.takeWarnings(atria::testing::endAtSides);
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    expectAgreement(volume(), patches());
  }
}

} // namespace
