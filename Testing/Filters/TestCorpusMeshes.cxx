// SPDX-License-Identifier: GPL-3.0-or-later
/// Models others wrote, meshed in a box around them: whatever they are like, the mesh is conformal and fills the box.
#include "DualMesherTest.h"
#include "Support/Campaign.h"
#include "Support/TestPaths.h"
#include "vtkAtriaMeshQuality.h"

#include <algorithm>

namespace {

namespace fs = std::filesystem;
using atria::Box3;
using atria::Vec3;

bool isModel(const fs::path& file)
{
  const std::string name = file.filename().string();
  return name.ends_with(".wrl") || name.ends_with(".wrz") || name.ends_with(".wrl.gz");
}

std::vector<fs::path> modelsIn(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file() && isModel(entry.path()))
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

Box3 boundsOf(vtkPolyData* model)
{
  double b[6];
  model->GetCellsBounds(b);
  return {Vec3(b[0], b[2], b[4]), Vec3(b[1], b[3], b[5])};
}

/// The files are shared between so many tests, which can run side by side.
constexpr int shares = 16;

class CorpusMeshes : public atria::testing::DualMesherTest, public ::testing::WithParamInterface<int>
{
protected:
  /// The model, or nothing where the reader refuses it.
  vtkSmartPointer<vtkPolyData> load(const fs::path& file)
  {
    const auto model = atria::testing::readModel(file);
    messages.takeWarnings(); // the files' fault, and the reader's tests'
    const bool refused = !messages.takeErrors().empty();
    EXPECT_EQ(refused, model->GetNumberOfCells() == 0);
    return refused ? nullptr : model;
  }

  /// In a box a quarter of the longest side larger all around, so that flat models have room too.
  void mesh(vtkPolyData* model)
  {
    domain = boundsOf(model);
    const double longest = domain.size().maxCoeff();
    domain.min -= Vec3::Constant(0.25 * longest);
    domain.max += Vec3::Constant(0.25 * longest);
    const double finest = longest / (atria::testing::isFullCampaign() ? 48.0 : 24.0);
    atria::testing::setGrid(mesher, domain, finest, 2.0 * finest, 4.0 * finest);
    mesher->SetZoneRule(vtkAtriaDualMesher::All);
    mesher->SetInputDataObject(model);
    mesher->Update();
  }

  void expectConformalAndWhole()
  {
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    vtkNew<vtkAtriaMeshQuality> quality;
    quality->SetInputConnection(mesher->GetOutputPort(0));
    quality->SetPatchesConnection(mesher->GetOutputPort(1));
    quality->Update(); // its errors fail the test
    EXPECT_EQ(quality->GetOutput()->GetNumberOfCells(), volume()->GetNumberOfCells());
    EXPECT_TRUE(atria::testing::patchesAreTheBoundary(volume(), patches()));
    EXPECT_NEAR((meshVolume() + volumeLeftOut()) / atria::testing::volumeOf(domain), 1.0, 1e-9);
  }
};

TEST_P(CorpusMeshes, FillTheirDomainsAndAreConformal)
{
  const auto folder = atria::testing::corpusFolder();
  if (!folder)
  {
    GTEST_SKIP() << "no corpus";
  }
  const std::vector<fs::path> files = modelsIn(*folder);
  int meshed = 0;
  for (std::size_t i = GetParam(); i < files.size(); i += shares)
  {
    SCOPED_TRACE(files[i].filename());
    if (const auto model = load(files[i]))
    {
      mesh(model);
      expectConformalAndWhole();
      ++meshed;
    }
  }
  EXPECT_GE(meshed, 2);
  RecordProperty("FilesMeshed", meshed);
}

INSTANTIATE_TEST_SUITE_P(Share, CorpusMeshes, ::testing::Range(0, shares));

} // namespace
