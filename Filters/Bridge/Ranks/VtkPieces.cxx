// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/VtkPieces.h"

#include "Ranks/VtkNumberedPieces.h"
#include "Support/Error.h"
#include "VtkSubset.h"

#include <vtkAppendFilter.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace atria {

namespace {

using Pieces = std::vector<vtkSmartPointer<vtkDataObject>>;

template <class Type> bool areAll(const Pieces& pieces)
{
  return std::all_of(pieces.begin(), pieces.end(), [](vtkDataObject* p) { return Type::SafeDownCast(p) != nullptr; });
}

bool isNumberedGrid(vtkDataObject* piece)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(piece);
  return grid && isNumbered(grid);
}

/// Joins the partitions if they are polygons with ids; else leaves them unchanged.
void joinPartitions(vtkPartitionedDataSetCollection* sets, unsigned int set)
{
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  for (unsigned int j = 0; j < sets->GetNumberOfPartitions(set); ++j)
  {
    auto* part = vtkPolyData::SafeDownCast(sets->GetPartitionAsDataObject(set, j));
    if (!part || !isNumbered(part) || part->GetNumberOfPolys() != part->GetNumberOfCells())
    {
      return;
    }
    parts.emplace_back(part);
  }
  if (!parts.empty())
  {
    sets->SetNumberOfPartitions(set, 1);
    sets->SetPartition(set, 0, joinNumberedSurfaces({parts.begin(), parts.end()}));
  }
}

vtkSmartPointer<vtkDataObject> joinCollections(const Pieces& pieces)
{
  const auto joined = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  std::map<std::string, unsigned int> known;
  for (vtkDataObject* piece : pieces)
  {
    auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(piece);
    for (unsigned int i = 0; i < sets->GetNumberOfPartitionedDataSets(); ++i)
    {
      const char* name = sets->HasMetaData(i) ? sets->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : nullptr;
      const unsigned int next = joined->GetNumberOfPartitionedDataSets();
      const unsigned int at = name ? known.try_emplace(name, next).first->second : next;
      if (at == next)
      {
        joined->SetNumberOfPartitionedDataSets(next + 1);
        joined->GetMetaData(at)->Copy(sets->GetMetaData(i));
      }
      for (unsigned int j = 0; j < sets->GetNumberOfPartitions(i); ++j)
      {
        if (vtkDataObject* part = sets->GetPartitionAsDataObject(i, j)) // readers omit empty partitions
        {
          joined->SetPartition(at, joined->GetNumberOfPartitions(at), part);
        }
      }
    }
  }
  for (unsigned int i = 0; i < joined->GetNumberOfPartitionedDataSets(); ++i)
  {
    joinPartitions(joined, i);
  }
  joined->GetFieldData()->PassData(pieces.front()->GetFieldData());
  return joined;
}

vtkSmartPointer<vtkDataObject> joinGridsByIds(const Pieces& pieces, std::vector<Index>* pieceOfCells)
{
  std::vector<vtkUnstructuredGrid*> grids;
  std::ranges::transform(pieces, std::back_inserter(grids),
                         [](vtkDataObject* piece) { return vtkUnstructuredGrid::SafeDownCast(piece); });
  NumberedWhole whole = joinNumberedGrids(grids);
  if (pieceOfCells)
  {
    *pieceOfCells = std::move(whole.pieceOf);
  }
  return whole.grid;
}

vtkSmartPointer<vtkDataObject> joinGrids(const Pieces& pieces)
{
  vtkNew<vtkAppendFilter> append;
  append->MergePointsOn(); // points are merged by their ids only
  for (vtkDataObject* piece : pieces)
  {
    auto* grid = vtkUnstructuredGrid::SafeDownCast(piece);
    if (!grid->GetPointData()->GetArray("GlobalPointIds"))
    {
      throw Error("the mesh comes in " + std::to_string(pieces.size()) +
                  " pieces, whose points have no global ids (GlobalPointIds) by which they could be joined: give the "
                  "points such ids before the mesh is distributed, or have one rank hold it");
    }
    append->AddInputData(grid);
  }
  append->Update();
  vtkSmartPointer<vtkDataObject> joined = append->GetOutput();
  joined->GetFieldData()->PassData(pieces.front()->GetFieldData());
  return joined;
}

vtkSmartPointer<vtkDataObject> joinSurfaces(const Pieces& pieces)
{
  const auto joined = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (vtkDataObject* piece : pieces)
  {
    joined->SetBlock(joined->GetNumberOfBlocks(), piece);
  }
  joined->GetFieldData()->PassData(pieces.front()->GetFieldData());
  return joined;
}

} // namespace

bool isEmptyPiece(vtkDataObject* piece) { return piece->GetNumberOfElements(vtkDataObject::CELL) == 0; }

vtkSmartPointer<vtkDataObject> withoutGhosts(vtkDataObject* piece)
{
  if (isNumberedGrid(piece))
  {
    return piece;
  }
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(piece))
  {
    return withoutGhostCells(grid);
  }
  auto copy = vtkSmartPointer<vtkDataObject>::Take(piece->NewInstance());
  copy->ShallowCopy(piece);
  if (auto* tree = vtkDataObjectTree::SafeDownCast(copy))
  {
    vtkSmartPointer<vtkDataObjectTreeIterator> it;
    it.TakeReference(tree->NewTreeIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      tree->SetDataSet(it, withoutGhosts(it->GetCurrentDataObject()));
    }
  }
  else if (auto* surfaces = vtkPolyData::SafeDownCast(copy))
  {
    surfaces->RemoveGhostCells();
  }
  return copy;
}

vtkSmartPointer<vtkDataObject> inOnePiece(vtkDataObject* data)
{
  if (auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(data))
  {
    unsigned int most = 0;
    for (unsigned int i = 0; i < sets->GetNumberOfPartitionedDataSets(); ++i)
    {
      most = std::max(most, sets->GetNumberOfPartitions(i));
    }
    return most > 1 ? joinCollections({data}) : vtkSmartPointer<vtkDataObject>(data);
  }
  if (isNumberedGrid(data) && isInPieces(vtkUnstructuredGrid::SafeDownCast(data)))
  {
    return joinGridsByIds({data}, nullptr);
  }
  return data;
}

vtkSmartPointer<vtkDataObject> joinPieces(const Pieces& pieces, std::vector<Index>* pieceOfCells)
{
  if (std::ranges::all_of(pieces, isNumberedGrid))
  {
    return joinGridsByIds(pieces, pieceOfCells);
  }
  if (pieces.size() == 1)
  {
    return pieces.front();
  }
  if (areAll<vtkPartitionedDataSetCollection>(pieces))
  {
    return joinCollections(pieces);
  }
  if (areAll<vtkUnstructuredGrid>(pieces))
  {
    return joinGrids(pieces);
  }
  const bool hasGrid = std::any_of(pieces.begin(), pieces.end(), [](vtkDataObject* piece) {
    return !vtkPolyData::SafeDownCast(piece) && !vtkDataObjectTree::SafeDownCast(piece);
  });
  if (hasGrid)
  {
    throw Error(std::string("pieces of a ") + pieces.front()->GetClassName() +
                " cannot be joined: have one rank hold it all");
  }
  return joinSurfaces(pieces);
}

} // namespace atria
