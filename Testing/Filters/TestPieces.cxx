// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces without processes: what is asked for piece by piece, and pieces that are joined.
#include "DualMesherTest.h"
#include "Ranks/VtkPieces.h"
#include "Support/Error.h"
#include "VtkFaceMesh.h"
#include "VtkSubset.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaOctreeSource.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkExtractCells.h>
#include <vtkGenericCell.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

namespace {

using atria::joinPieces;
using atria::TriangleSurface;
using atria::Vec3;
using atria::VtkIds;
using ::testing::HasSubstr;
using Pieces = std::vector<vtkSmartPointer<vtkDataObject>>;

TriangleSurface scene()
{
  TriangleSurface surface;
  atria::testing::addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
  atria::testing::addSheet(surface, "Canopy", Vec3(-1.7, -3.2, 2.1), Vec3(2.8, 0, 0), Vec3(0, 1.3, 0));
  atria::testing::addSphere(surface, "Dome", Vec3(4.1, 1.3, 2.2), 1.4, 2);
  return surface;
}

/// Triangles from `first` up to `last`, with all points and names.
vtkSmartPointer<vtkPolyData> share(vtkPolyData* whole, vtkIdType first, vtkIdType last)
{
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  piece->SetPoints(whole->GetPoints());
  piece->GetFieldData()->PassData(whole->GetFieldData());
  vtkNew<vtkCellArray> cells;
  piece->GetCellData()->CopyAllocate(whole->GetCellData());
  for (vtkIdType i = first; i < last; ++i)
  {
    piece->GetCellData()->CopyData(whole->GetCellData(), i, cells->InsertNextCell(whole->GetCell(i)));
  }
  piece->SetPolys(cells);
  return piece;
}

/// The cells of even numbers and those of odd ones.
Pieces halves(vtkUnstructuredGrid* grid)
{
  Pieces pieces;
  for (const vtkIdType first : {0, 1})
  {
    vtkNew<vtkExtractCells> extract;
    extract->SetInputData(grid);
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = first; i < grid->GetNumberOfCells(); i += 2)
    {
      ids->InsertNextId(i);
    }
    extract->SetCellList(ids);
    extract->Update();
    pieces.emplace_back(extract->GetOutput());
  }
  return pieces;
}

class PieceRequests : public atria::testing::DualMesherTest
{
protected:
  PieceRequests() { setSurface(scene()); }
};

using JoinedPieces = PieceRequests;

TEST_F(PieceRequests, GiveEverythingAsTheFirstPieceAndNothingAsTheOthers)
{
  const auto whole = copiesOfOutputs();
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(mesher->GetOutputPort(0));
  quality->SetPatchesConnection(mesher->GetOutputPort(1));
  vtkNew<vtkAtriaOctreeSource> octree;
  atria::testing::setGrid(octree, domain, 0.5, 1.0, 2.0);
  for (const int piece : {2, 0, 1})
  {
    quality->UpdatePiece(piece, 3, 0);
    octree->UpdatePiece(piece, 3, 0);
    const bool hasCells = quality->GetOutput()->GetNumberOfCells() > 0;
    EXPECT_EQ(hasCells, piece == 0);
    EXPECT_EQ(quality->GetSummary()->GetNumberOfElements(vtkDataObject::ROW) > 0, piece == 0);
    EXPECT_EQ(octree->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL) > 0, piece == 0);
  }
  expectOutputs(whole);
}

TEST_F(PieceRequests, AskForNoGhosts)
{
  mesher->UpdatePiece(0, 3, 2);
  vtkInformation* input = mesher->GetInputInformation(0, 0);
  EXPECT_EQ(input->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()), 1);
  EXPECT_EQ(input->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), 0);
}

TEST_F(JoinedPieces, OfAModelGiveItsMesh)
{
  const auto whole = copiesOfOutputs();
  const auto model = atria::testing::toPolyData(scene());
  const vtkIdType count = model->GetNumberOfCells();
  mesher->SetInputDataObject(
      joinPieces({share(model, 0, 5), share(model, 5, count / 2), share(model, count / 2, count)}));
  expectOutputs(whole);
}

TEST_F(JoinedPieces, OfOneAreThatPiece)
{
  const vtkSmartPointer<vtkDataObject> model = atria::testing::toPolyData(scene());
  EXPECT_EQ(joinPieces({model}), model);
}

TEST_F(JoinedPieces, OfAMeshHaveTheFacesThatItHas)
{
  mesher->Update();
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalPointIds");
  ids->SetNumberOfValues(volume()->GetNumberOfPoints());
  std::iota(ids->Begin(), ids->End(), 0);
  vtkNew<vtkUnstructuredGrid> mesh;
  mesh->ShallowCopy(volume());
  mesh->GetPointData()->SetGlobalIds(ids);
  const auto joined = joinPieces(halves(mesh));
  const auto before = atria::faceMeshFromVtk(mesh, nullptr).mesh;
  const auto after = atria::faceMeshFromVtk(vtkUnstructuredGrid::SafeDownCast(joined), nullptr).mesh;
  EXPECT_EQ(after.points.size(), before.points.size());
  EXPECT_EQ(after.faceCount(), before.faceCount());
  EXPECT_EQ(after.internalFaceCount(), before.internalFaceCount()); // the canopy stays two-sided
}

TEST_F(JoinedPieces, OfAMeshWithoutIdsAreAnError)
{
  mesher->Update();
  const auto pieces = halves(volume());
  EXPECT_THAT([&] { joinPieces(pieces); }, ::testing::ThrowsMessage<atria::Error>(HasSubstr("GlobalPointIds")));
}

TEST_F(JoinedPieces, OfPatchesKeepTheirNames)
{
  mesher->Update();
  const auto pieces = joinPieces({patches(), patches()});
  auto* joined = vtkPartitionedDataSetCollection::SafeDownCast(pieces);
  ASSERT_NE(joined, nullptr);
  EXPECT_EQ(atria::testing::namesOf(atria::testing::patchesByName(joined)),
            atria::testing::namesOf(atria::testing::patchesByName(patches())));
  EXPECT_EQ(joined->GetNumberOfPartitions(0), 2u);
}

TEST_F(JoinedPieces, LeaveOutGhosts)
{
  const auto model = atria::testing::toPolyData(scene());
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(model->GetNumberOfCells());
  ghosts->FillValue(0);
  ghosts->SetValue(3, vtkDataSetAttributes::DUPLICATECELL);
  model->GetCellData()->AddArray(ghosts);
  EXPECT_EQ(atria::withoutGhosts(model)->GetNumberOfElements(vtkDataObject::CELL), model->GetNumberOfCells() - 1);
  EXPECT_EQ(model->GetNumberOfCells(), static_cast<vtkIdType>(scene().triangles.size()));
}

TEST_F(JoinedPieces, LeaveOutGhostsBesidePolyhedra)
{
  mesher->Update();
  vtkNew<vtkUnstructuredGrid> mesh;
  mesh->ShallowCopy(volume());
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  VtkIds own;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    const bool isOwn = cell % 3 == 0 || mesh->GetCellType(cell) == VTK_POLYHEDRON;
    ghosts->InsertNextValue(isOwn ? 0 : vtkDataSetAttributes::DUPLICATECELL);
    if (isOwn)
    {
      own.push_back(cell);
    }
  }
  ASSERT_GT(std::ranges::count_if(own, [&](vtkIdType c) { return mesh->GetCellType(c) == VTK_POLYHEDRON; }), 0);
  mesh->GetCellData()->AddArray(ghosts);
  const auto left = atria::withoutGhosts(mesh);
  auto* rest = vtkUnstructuredGrid::SafeDownCast(left);
  ASSERT_EQ(rest->GetNumberOfCells(), static_cast<vtkIdType>(own.size()));
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    vtkCell* wanted = mesh->GetCell(own[i]);
    vtkNew<vtkGenericCell> cell;
    rest->GetCell(static_cast<vtkIdType>(i), cell);
    ASSERT_EQ(cell->GetNumberOfFaces(), wanted->GetNumberOfFaces());
    for (int face = 0; face < wanted->GetNumberOfFaces(); ++face)
    {
      vtkPoints* points = wanted->GetFace(face)->GetPoints();
      vtkPoints* found = cell->GetFace(face)->GetPoints();
      ASSERT_EQ(found->GetNumberOfPoints(), points->GetNumberOfPoints());
      for (vtkIdType p = 0; p < points->GetNumberOfPoints(); ++p)
      {
        ASSERT_EQ(Vec3(found->GetPoint(p)), Vec3(points->GetPoint(p)));
      }
    }
  }
}

} // namespace
