// SPDX-License-Identifier: GPL-3.0-or-later
/// Ranks that are aborted, or whose part of the work cannot be done: all of them stop, and go on afterwards.
#include "OnRanks.h"
#include "Support/ProgressWatch.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkTable.h>

#include <gmock/gmock.h>

#include <memory>

namespace {

using namespace atria::testing;
using ::testing::HasSubstr;

class FailuresOnRanks : public OnRanks
{
protected:
  bool isLast() const { return rank() == ranks() - 1; }

  /// Aborts a filter on this rank once so much is done.
  static std::unique_ptr<ProgressWatch> abortBeyond(vtkAlgorithm* filter, double fraction)
  {
    return std::make_unique<ProgressWatch>(filter, beyond(fraction));
  }

  void expectNoQuality()
  {
    EXPECT_EQ(quality->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(quality->GetSummary()->GetNumberOfRows(), 0);
  }

  vtkNew<vtkAtriaMeshQuality> quality;
};

TEST_F(FailuresOnRanks, AnAbortOfTheFirstEndsMeshingOnAll)
{
  const auto alone = whole();
  for (const double when : {0.05, 0.4, 0.8})
  {
    SCOPED_TRACE(when);
    mesher->Modified();
    {
      const auto watch = rank() == 0 ? abortBeyond(mesher, when) : nullptr;
      update(mesher);
    }
    expectEmpty();
    update(mesher); // what was aborted is still asked for, on all
    expectGathered(volume(), alone[0]);
    expectGathered(patches(), alone[1]);
  }
}

TEST_F(FailuresOnRanks, AnAbortOfAnyEndsWorkOnPiecesOnAll)
{
  quality->SetInputConnection(mesher->GetOutputPort(0));
  quality->SetPatchesConnection(mesher->GetOutputPort(1));
  update(mesher, 1);
  const vtkIdType cells = volume()->GetNumberOfCells();
  for (const double when : {0.1, 0.6})
  {
    SCOPED_TRACE(when);
    quality->Modified();
    {
      const auto watch = isLast() ? abortBeyond(quality, when) : nullptr;
      update(quality, 1);
    }
    expectNoQuality();
    update(quality, 1);
    EXPECT_EQ(quality->GetOutput()->GetNumberOfCells(), cells);
    EXPECT_EQ(quality->GetSummary()->GetNumberOfRows() > 0, rank() == 0);
  }
}

TEST_F(FailuresOnRanks, APieceThatDoesNotFitIsToldOnceAndEndsAll)
{
  update(mesher, 1);
  vtkNew<vtkUnstructuredGrid> piece;
  piece->ShallowCopy(volume());
  if (isLast() && ranks() > 1)
  {
    for (vtkDataSetAttributes* data : {static_cast<vtkDataSetAttributes*>(piece->GetPointData()),
                                       static_cast<vtkDataSetAttributes*>(piece->GetCellData())})
    {
      data->RemoveArray(data->GetGlobalIds()->GetName());
    }
  }
  quality->SetInputDataObject(piece);
  update(quality, 1);
  const auto errors = messages.takeErrors();
  if (ranks() == 1)
  {
    EXPECT_GT(quality->GetOutput()->GetNumberOfCells(), 0);
    return;
  }
  expectNoQuality();
  EXPECT_THAT(firstOf(errors), HasSubstr(rank() == 0 ? "GlobalPointIds" : "returned failure")); // as VTK has it
  quality->SetInputDataObject(volume());
  update(quality, 1);
  EXPECT_EQ(quality->GetOutput()->GetNumberOfCells(), volume()->GetNumberOfCells());
}

} // namespace
