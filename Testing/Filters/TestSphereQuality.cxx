// SPDX-License-Identifier: GPL-3.0-or-later
/// Quality of the meshes about the sphere in a cube: all valid, cell squish below 0.8.
#include "Support/Campaign.h"
#include "Support/VtkErrorGuard.h"
#include "SurfaceInput.h"
#include "vtkAtriaDualMesher.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

namespace {

struct Row
{
  double size;
  bool adaptive;
  bool large;
};

void PrintTo(const Row& row, std::ostream* os) { *os << (row.adaptive ? "adaptive " : "uniform ") << row.size << " m"; }

class SphereQuality : public atria::testing::VtkTest, public ::testing::WithParamInterface<Row>
{
};

TEST_P(SphereQuality, IsValidAndNotSquished)
{
  const Row row = GetParam();
  if (row.large && !atria::testing::isFullCampaign())
  {
    GTEST_SKIP() << "set ATRIA_TEST_FULL for the largest mesh";
  }
  vtkNew<vtkAtriaDualMesher> mesher;
  mesher->SetNumberOfLayers(0);
  mesher->SetInputData(atria::testing::exampleModel("sphere_in_cube.wrl"));
  mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
  mesher->SetSizeMin(row.size);
  mesher->SetSizeMid(row.size);
  mesher->SetSizeMax(row.adaptive ? 100.0 : row.size);
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(0, mesher->GetOutputPort(0));
  quality->SetInputConnection(1, mesher->GetOutputPort(1));
  quality->Update();
  EXPECT_EQ(quality->GetNumberOfInvalidCells(), 0);
  vtkTable* summary = quality->GetSummary();
  double squish = -1.0;
  for (vtkIdType i = 0; i < summary->GetNumberOfRows(); ++i)
  {
    if (summary->GetValueByName(i, "Metric").ToString() == "CellSquish")
    {
      squish = summary->GetValueByName(i, "Maximum").ToDouble();
    }
  }
  EXPECT_GE(squish, 0.0);
  EXPECT_LT(squish, 0.8);
}

INSTANTIATE_TEST_SUITE_P(Published, SphereQuality,
                         ::testing::Values(Row{0.2, false, false}, Row{0.1, false, false}, Row{0.05, false, true},
                                           Row{0.2, true, false}, Row{0.1, true, false}, Row{0.05, true, false}));

} // namespace
