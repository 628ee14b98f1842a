// SPDX-License-Identifier: GPL-3.0-or-later
/// Quality on ranks.
#include "OnRanks.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <tuple>

namespace {

using namespace atria::testing;

/// Whether values are equal but for rounding: angles of boxes are 0 or what the arc cosine makes of that.
void expectNear(double value, double wanted, const std::string& what)
{
  const double most = what.find("NonOrthogonality") != std::string::npos ? 1e-5 : 1e-9;
  EXPECT_LE(std::abs(value - wanted), most * std::max({1.0, std::abs(value), std::abs(wanted)})) << what;
}

/// The first column names what a row is about.
void expectNear(vtkTable* table, vtkTable* wanted)
{
  ASSERT_EQ(table->GetNumberOfRows(), wanted->GetNumberOfRows());
  ASSERT_EQ(table->GetNumberOfColumns(), wanted->GetNumberOfColumns());
  for (vtkIdType row = 0; row < wanted->GetNumberOfRows(); ++row)
  {
    const std::string subject = wanted->GetValue(row, 0).ToString();
    for (vtkIdType i = 0; i < wanted->GetNumberOfColumns(); ++i)
    {
      const std::string column = wanted->GetColumnName(i);
      const vtkVariant value = table->GetValue(row, i), inWhole = wanted->GetValue(row, i);
      if (!inWhole.IsDouble())
      {
        EXPECT_EQ(value.ToString(), inWhole.ToString()) << subject << " " << column;
      }
      else if (!std::isnan(value.ToDouble()) || !std::isnan(inWhole.ToDouble()))
      {
        expectNear(value.ToDouble(), inWhole.ToDouble(), std::string(subject).append(" ").append(column));
      }
    }
  }
}

/// The values of all cells of a piece, ghosts among them, are those of the whole: with checks to the bit.
void expectValues(vtkUnstructuredGrid* piece, vtkUnstructuredGrid* whole, bool exactly)
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
        if (exactly)
        {
          EXPECT_EQ(value, inWhole) << wanted->GetName();
        }
        expectNear(value, inWhole, wanted->GetName());
      }
    }
  }
}

TEST_F(OnRanks, QualityOfAMeshOnOneRankIsThatOfOneProcess)
{
  mesher->DistributeOutputOff();
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
  for (const auto& [blockSize, withPatches, checkMesh] : {std::tuple(0, true, false),
                                                          {0, true, true},
                                                          {0, false, false},
                                                          {0, false, true},
                                                          {1000, true, false},
                                                          {1000, true, true},
                                                          {1000, false, false},
                                                          {1000, false, true}})
  {
    mesher->SetBlockSize(blockSize); // made by the first rank, or by all
    quality->SetCheckMesh(checkMesh);
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
    vtkNew<vtkTable> checks;
    checks->DeepCopy(quality->GetChecks());
    const vtkIdType invalid = quality->GetNumberOfInvalidCells();
    const int failed = quality->GetNumberOfFailedChecks();
    works = false;
    update(quality);
    EXPECT_EQ(works, ranks() > 1); // one has done so already
    EXPECT_EQ(quality->GetNumberOfInvalidCells(), invalid);
    EXPECT_EQ(quality->GetNumberOfFailedChecks(), failed);
    expectValues(quality->GetOutput(), alone, checkMesh);
    if (rank() == 0)
    {
      expectNear(quality->GetSummary(), summary);
      expectNear(quality->GetChecks(), checks);
    }
    else
    {
      EXPECT_EQ(quality->GetSummary()->GetNumberOfRows(), 0);
      EXPECT_EQ(quality->GetChecks()->GetNumberOfRows(), 0);
    }
    setSceneEverywhere();
  }
}

} // namespace
