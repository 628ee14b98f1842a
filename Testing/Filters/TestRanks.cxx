// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh on ranks.
#include "OnRanks.h"
#include "vtkAtriaMeshDivider.h"
#include "vtkAtriaMeshOptimizer.h"

#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkUnsignedCharArray.h>

#include <gmock/gmock.h>

#include <algorithm>

namespace {

using namespace atria::testing;
using atria::Vec3;
using ::testing::HasSubstr;

TEST_F(OnRanks, PiecesMakeTheMeshOfOneProcess)
{
  const auto alone = whole();
  update(mesher);
  expectPiecesOf(alone);
}

TEST_F(OnRanks, PiecesAreEquallyLarge)
{
  const vtkIdType cells = whole()[0]->GetNumberOfElements(vtkDataObject::CELL);
  update(mesher);
  const auto own = static_cast<vtkIdType>(ownCells().size());
  EXPECT_EQ(sumOverRanks(own), cells);
  EXPECT_LE(greatestOverRanks(own) * ranks(), cells + ranks() - 1);
}

/// Ids of the cells of a mesh that are some rings about others.
std::set<vtkIdType> withRings(vtkUnstructuredGrid* mesh, std::set<vtkIdType> cells, int rings)
{
  vtkNew<vtkIdList> points;
  vtkNew<vtkIdList> neighbors;
  for (int ring = 0; ring < rings; ++ring)
  {
    for (const vtkIdType cell : std::set<vtkIdType>(cells))
    {
      mesh->GetCellPoints(cell, points);
      for (const vtkIdType point : *points)
      {
        mesh->GetPointCells(point, neighbors);
        cells.insert(neighbors->begin(), neighbors->end());
      }
    }
  }
  return cells;
}

TEST_F(OnRanks, GhostsAreTheCellsAbout)
{
  if (ranks() == 1)
  {
    return;
  }
  const auto alone = whole();
  for (const int levels : {0, 1, 2})
  {
    update(mesher, levels);
    vtkIdTypeArray* ids = idsOfCells(volume());
    const std::set<vtkIdType> all(ids->Begin(), ids->End());
    EXPECT_EQ(all, withRings(vtkUnstructuredGrid::SafeDownCast(alone[0]), ownCells(), std::max(levels, 1)));
    EXPECT_EQ(volume()->GetInformation()->Get(vtkDataObject::DATA_NUMBER_OF_GHOST_LEVELS()), std::max(levels, 1));
  }
}

TEST_F(OnRanks, EveryPointIsOfOneRank)
{
  const auto alone = whole();
  update(mesher);
  vtkUnsignedCharArray* ghosts = volume()->GetPointGhostArray();
  const vtkIdType own = ghosts ? std::count(ghosts->Begin(), ghosts->End(), 0) : volume()->GetNumberOfPoints();
  EXPECT_EQ(sumOverRanks(own), alone[0]->GetNumberOfElements(vtkDataObject::POINT));
}

TEST_F(OnRanks, MoreGhostsAreNoReasonToMeshAnew)
{
  update(mesher);
  const vtkMTimeType made = volume()->GetMTime();
  update(mesher, 1);
  EXPECT_EQ(volume()->GetMTime(), made);
}

TEST_F(OnRanks, FacesOfPatchesAreWithTheirOwners)
{
  const auto alone = whole();
  update(mesher);
  auto* all = vtkPartitionedDataSetCollection::SafeDownCast(alone[1]);
  ASSERT_EQ(patches()->GetNumberOfPartitionedDataSets(), all->GetNumberOfPartitionedDataSets());
  const std::set<vtkIdType> own = ownCells();
  for (unsigned int i = 0; i < all->GetNumberOfPartitionedDataSets(); ++i)
  {
    EXPECT_STREQ(patches()->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()),
                 all->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()));
    ASSERT_EQ(patches()->GetNumberOfPartitions(i), 1u);
    auto* patch = vtkPolyData::SafeDownCast(patches()->GetPartitionAsDataObject(i, 0));
    EXPECT_EQ(sumOverRanks(patch->GetNumberOfCells()),
              all->GetPartitionAsDataObject(i, 0)->GetNumberOfElements(vtkDataObject::CELL));
    auto* owners = vtkIdTypeArray::SafeDownCast(patch->GetCellData()->GetArray("OwnerCellId"));
    EXPECT_TRUE(std::all_of(owners->Begin(), owners->End(), [&](vtkIdType owner) { return own.contains(owner); }));
  }
}

TEST_F(OnRanks, FieldDataIsEverywhere)
{
  const auto alone = whole();
  update(mesher);
  vtkFieldData* fields = volume()->GetFieldData();
  ASSERT_EQ(fields->GetNumberOfArrays(), alone[0]->GetFieldData()->GetNumberOfArrays());
  EXPECT_EQ(fields->GetArray("PatchFace")->GetNumberOfTuples(),
            alone[0]->GetFieldData()->GetArray("PatchFace")->GetNumberOfTuples());
}

TEST_F(OnRanks, TheFirstHasItAllWhereThatIsAskedFor)
{
  const auto alone = whole();
  mesher->DistributeOutputOff();
  update(mesher);
  if (rank() == 0)
  {
    EXPECT_TRUE(identical(alone[0], volume()));
    EXPECT_TRUE(identical(alone[1], patches()));
  }
  else
  {
    EXPECT_EQ(volume()->GetNumberOfCells(), 0);
    EXPECT_EQ(patches()->GetNumberOfPartitionedDataSets(),
              vtkPartitionedDataSetCollection::SafeDownCast(alone[1])->GetNumberOfPartitionedDataSets());
  }
}

TEST_F(OnRanks, AMeshThatOneRankHoldsIsDealtOutAlike)
{
  update(mesher);
  vtkNew<vtkUnstructuredGrid> piece;
  piece->DeepCopy(volume());
  vtkNew<vtkPartitionedDataSetCollection> pieceOfPatches;
  pieceOfPatches->DeepCopy(patches());
  mesher->DistributeOutputOff();
  vtkNew<vtkAtriaMeshDivider> divider;
  divider->SetInputConnection(0, mesher->GetOutputPort(0));
  divider->SetInputConnection(1, mesher->GetOutputPort(1));
  update(divider);
  EXPECT_TRUE(identical(piece, divider->GetOutput()));
  EXPECT_TRUE(identical(pieceOfPatches, divider->GetPatches()));
}

TEST_F(OnRanks, AMeshInPiecesIsDealtOutAlike)
{
  vtkNew<vtkAtriaMeshDivider> divider;
  divider->SetInputConnection(0, mesher->GetOutputPort(0));
  divider->SetInputConnection(1, mesher->GetOutputPort(1));
  update(divider);
  EXPECT_GT(divider->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_TRUE(identical(volume(), divider->GetOutput()));
  EXPECT_TRUE(identical(patches(), divider->GetPatches()));
}

TEST_F(OnRanks, RanksMayHaveNothing)
{
  mesher->SetNumberOfLayers(0);
  mesher->SetInputDataObject(vtkNew<vtkPolyData>());
  atria::testing::setGrid(mesher, {Vec3(0, 0, 0), Vec3(4, 4, 4)}, 2.0, 2.0, 2.0);
  const auto alone = whole();
  const vtkIdType cells = alone[0]->GetNumberOfElements(vtkDataObject::CELL);
  EXPECT_TRUE(cells > 0 && cells < 30) << cells;
  update(mesher);
  EXPECT_EQ(patches()->GetNumberOfPartitionedDataSets(), 6u);
  expectGathered(volume(), alone[0]);
  expectGathered(patches(), alone[1]);
}

TEST_F(OnRanks, TheImprovedMeshIsThatOfOneProcess)
{
  vtkNew<vtkAtriaMeshOptimizer> optimizer;
  optimizer->SetInputConnection(mesher->GetOutputPort(0));
  optimizer->SetPatchesConnection(mesher->GetOutputPort(1));
  optimizer->SetNumberOfSweeps(1);
  optimizer->Update();
  vtkNew<vtkUnstructuredGrid> alone;
  alone->DeepCopy(optimizer->GetOutput());
  update(optimizer);
  EXPECT_GT(optimizer->GetOutput()->GetNumberOfCells(), 0);
  expectGathered(optimizer->GetOutput(), alone);
}

TEST_F(OnRanks, AnErrorIsToldOnceAndEmptiesAll)
{
  update(mesher);
  ASSERT_GT(volume()->GetNumberOfCells(), 0);
  mesher->SetSizeMin(-1.0);
  update(mesher);
  expectEmpty();
  const auto errors = messages.takeErrors();
  if (rank() == 0)
  {
    EXPECT_THAT(atria::testing::firstOf(errors), HasSubstr("SizeMin"));
  }
  mesher->SetSizeMin(0.5);
  update(mesher);
  EXPECT_GT(volume()->GetNumberOfCells(), 0);
}

} // namespace
