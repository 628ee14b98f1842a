// SPDX-License-Identifier: GPL-3.0-or-later
/// Quality on ranks.
#include "OnRanks.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkTable.h>

#include <gmock/gmock.h>

#include <cmath>
#include <string>

namespace {

using namespace atria::testing;

/// Whether values are equal but for rounding: angles of boxes are 0 or what the arc cosine makes of that.
void expectNear(double value, double wanted, const std::string& what)
{
  const double most = what.find("NonOrthogonality") != std::string::npos ? 1e-5 : 1e-9;
  EXPECT_LE(std::abs(value - wanted), most * std::max({1.0, std::abs(value), std::abs(wanted)})) << what;
}

void expectNear(vtkTable* table, vtkTable* wanted)
{
  ASSERT_EQ(table->GetNumberOfRows(), wanted->GetNumberOfRows());
  for (vtkIdType row = 0; row < wanted->GetNumberOfRows(); ++row)
  {
    const std::string metric = wanted->GetValueByName(row, "Metric").ToString();
    EXPECT_EQ(table->GetValueByName(row, "Metric").ToString(), metric);
    EXPECT_EQ(table->GetValueByName(row, "Count"), wanted->GetValueByName(row, "Count")) << metric;
    for (const char* column : {"Minimum", "Maximum", "Mean", "StandardDeviation"})
    {
      expectNear(table->GetValueByName(row, column).ToDouble(), wanted->GetValueByName(row, column).ToDouble(),
                 metric + " " + column);
    }
  }
}

/// The values of all cells of a piece, ghosts among them, are those of the whole.
void expectNear(vtkUnstructuredGrid* piece, vtkUnstructuredGrid* whole)
{
  vtkDataArray* ids = piece->GetCellData()->GetGlobalIds();
  for (int i = 0; i < whole->GetCellData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* wanted = whole->GetCellData()->GetArray(i);
    vtkDataArray* values = piece->GetCellData()->GetArray(wanted->GetName());
    ASSERT_NE(values, nullptr) << wanted->GetName();
    for (vtkIdType cell = 0; cell < piece->GetNumberOfCells(); ++cell)
    {
      const vtkIdType id = ids ? static_cast<vtkIdType>(ids->GetComponent(cell, 0)) : cell;
      const double value = values->GetComponent(cell, 0), inWhole = wanted->GetComponent(id, 0);
      if (!std::isnan(value) || !std::isnan(inWhole))
      {
        expectNear(value, inWhole, wanted->GetName());
      }
    }
  }
}

TEST_F(OnRanks, QualityIsThatOfOneProcess)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(mesher->GetOutputPort(0));
  quality->SetPatchesConnection(mesher->GetOutputPort(1));
  quality->CheckMeshOn();
  quality->Update();
  vtkNew<vtkUnstructuredGrid> alone;
  alone->DeepCopy(quality->GetOutput());
  vtkNew<vtkTable> summary;
  summary->DeepCopy(quality->GetSummary());
  update(quality);
  expectGathered(quality->GetOutput(), alone);
  for (vtkIdType i = 0; rank() == 0 && i < summary->GetNumberOfColumns(); ++i)
  {
    for (vtkIdType row = 0; row < summary->GetNumberOfRows(); ++row)
    {
      EXPECT_EQ(quality->GetSummary()->GetValue(row, i), summary->GetValue(row, i));
    }
  }
}

TEST_F(OnRanks, QualityIsMeasuredWherePiecesAre)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(mesher->GetOutputPort(0));
  bool works = false; // on this rank
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&works);
  observer->SetCallback([](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  quality->AddObserver(vtkCommand::ProgressEvent, observer);
  for (const auto& [blockSize, withPatches] : {std::pair(0, true), {0, false}, {1000, true}, {1000, false}})
  {
    mesher->SetBlockSize(blockSize); // made by the first rank, or by all
    if (withPatches)
    {
      quality->SetPatchesConnection(mesher->GetOutputPort(1));
    }
    else
    {
      quality->SetInputConnection(1, nullptr);
    }
    quality->UpdatePiece(0, 1, 0);
    vtkNew<vtkUnstructuredGrid> alone;
    alone->DeepCopy(quality->GetOutput());
    vtkNew<vtkTable> summary;
    summary->DeepCopy(quality->GetSummary());
    const vtkIdType invalid = quality->GetNumberOfInvalidCells();
    works = false;
    update(quality);
    EXPECT_EQ(works, ranks() > 1); // one has done so already
    EXPECT_EQ(quality->GetNumberOfInvalidCells(), invalid);
    expectNear(quality->GetOutput(), alone);
    if (rank() == 0)
    {
      expectNear(quality->GetSummary(), summary);
    }
    else
    {
      EXPECT_EQ(quality->GetSummary()->GetNumberOfRows(), 0);
    }
    setSceneEverywhere();
  }
}

} // namespace
