// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/VtkShares.h"

#include "Grid/MortonShares.h"
#include "Support/RunContext.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace atria {

namespace {

constexpr std::size_t grain = 65536;

/// Adds global ids unless there are some. `ids` are numbers in the whole mesh.
void addGlobalIds(vtkDataSetAttributes* data, const char* name, std::span<const vtkIdType> ids)
{
  if (!data->GetGlobalIds() && !data->HasArray(name))
  {
    data->SetGlobalIds(idArray(name, ids));
  }
}

template <typename IsGhost>
void addGhostArray(vtkDataSetAttributes* data, const VtkIds& ids, unsigned char mark, IsGhost&& isGhost)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::transform(ids.begin(), ids.end(), ghosts->GetPointer(0),
                 [&](vtkIdType id) { return isGhost(static_cast<std::size_t>(id)) ? mark : 0; });
  data->AddArray(ghosts);
}

/// Returns the faces of a patch whose owners are a rank's own cells.
VtkIds facesOf(vtkPolyData* patch, std::span<const Index> rankOf, std::size_t rank)
{
  vtkDataArray* owners = patch->GetCellData()->GetArray("OwnerCellId");
  VtkIds faces;
  for (vtkIdType face = 0; face < patch->GetNumberOfCells(); ++face)
  {
    const double owner = owners ? owners->GetComponent(face, 0) : -1.0;
    const bool known = owner >= 0.0 && owner < static_cast<double>(rankOf.size());
    if ((known ? rankOf[static_cast<std::size_t>(owner)] : 0) == rank)
    {
      faces.push_back(face);
    }
  }
  return faces;
}

/// Returns the points of the faces, in rising order.
VtkIds pointsOf(vtkPolyData* patch, const VtkIds& faces)
{
  std::vector<char> isUsed(static_cast<std::size_t>(patch->GetNumberOfPoints()), 0);
  vtkNew<vtkIdList> corners;
  for (const vtkIdType face : faces)
  {
    patch->GetPolys()->GetCellAtId(face, corners);
    std::for_each(corners->begin(), corners->end(), [&](vtkIdType p) { isUsed[static_cast<std::size_t>(p)] = 1; });
  }
  VtkIds points;
  for (std::size_t p = 0; p < isUsed.size(); ++p)
  {
    if (isUsed[p])
    {
      points.push_back(static_cast<vtkIdType>(p));
    }
  }
  return points;
}

vtkSmartPointer<vtkCellArray> polygonsOf(vtkPolyData* patch, const VtkIds& faces, const VtkIds& points)
{
  VtkIds newPoint(static_cast<std::size_t>(patch->GetNumberOfPoints()), -1);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    newPoint[static_cast<std::size_t>(points[i])] = static_cast<vtkIdType>(i);
  }
  VtkIds offsets{0}, connectivity;
  vtkNew<vtkIdList> corners;
  for (const vtkIdType face : faces)
  {
    patch->GetPolys()->GetCellAtId(face, corners);
    std::transform(corners->begin(), corners->end(), std::back_inserter(connectivity),
                   [&](vtkIdType p) { return newPoint[static_cast<std::size_t>(p)]; });
    offsets.push_back(static_cast<vtkIdType>(connectivity.size()));
  }
  return cellArray(offsets, connectivity, isNarrow(patch->GetPolys()));
}

VtkIds shifted(VtkIds ids, vtkIdType by)
{
  std::ranges::for_each(ids, [by](vtkIdType& id) { id += by; });
  return ids;
}

vtkSmartPointer<vtkPolyData> pieceOfPatch(vtkPolyData* patch, std::span<const Index> rankOf, std::size_t rank,
                                          vtkIdType firstFace, vtkIdType firstPoint)
{
  auto piece = vtkSmartPointer<vtkPolyData>::New();
  const VtkIds faces = facesOf(patch, rankOf, rank);
  const VtkIds points = pointsOf(patch, faces);
  piece->SetPoints(takePoints(patch->GetPoints(), points));
  piece->SetPolys(polygonsOf(patch, faces, points));
  takeTuples(patch->GetPointData(), points, piece->GetPointData());
  takeTuples(patch->GetCellData(), faces, piece->GetCellData());
  addGlobalIds(piece->GetPointData(), "GlobalPointIds", shifted(points, firstPoint));
  addGlobalIds(piece->GetCellData(), "GlobalCellIds", shifted(faces, firstFace));
  piece->GetFieldData()->PassData(patch->GetFieldData());
  return piece;
}

bool hasPolygonsAlone(vtkPolyData* data) { return data->GetNumberOfPolys() == data->GetNumberOfCells(); }

} // namespace

std::vector<Index> divideCells(vtkUnstructuredGrid* whole, std::size_t ranks, const Executor& executor)
{
  const VtkCells cells(whole);
  const CellArrays& arrays = cells.view();
  const VtkPoints points(whole->GetPoints(), executor);
  std::vector<Vec3> centers(arrays.types.size());
  executor.forEach(centers.size(), grain, [&](std::size_t cell) {
    Vec3 sum = Vec3::Zero();
    const std::int64_t first = arrays.offsets[cell], last = arrays.offsets[cell + 1];
    for (std::int64_t i = first; i < last; ++i)
    {
      sum += points.view()[static_cast<std::size_t>(arrays.connectivity[static_cast<std::size_t>(i)])];
    }
    centers[cell] = sum / static_cast<double>(std::max<std::int64_t>(last - first, 1));
  });
  SilentMonitor monitor;
  return divideAlongMorton(centers, ranks, {executor, ProgressRange(monitor)});
}

template <typename F> void MeshShares::forPoints(Index cell, F&& body) const
{
  const CellArrays& arrays = cells.view();
  const auto last = static_cast<std::size_t>(arrays.offsets[cell + 1]);
  for (auto i = static_cast<std::size_t>(arrays.offsets[cell]); i < last; ++i)
  {
    body(static_cast<std::size_t>(arrays.connectivity[i]));
  }
}

MeshShares::MeshShares(vtkUnstructuredGrid* mesh, std::vector<Index> rankOfCells, std::size_t ranks, int ghostLevels)
    : whole(mesh), cells(mesh), rankOf(std::move(rankOfCells)), levels(ghostLevels),
      rankOfPoint(static_cast<std::size_t>(mesh->GetNumberOfPoints()), noIndex), own(ranks),
      newPoint(static_cast<std::size_t>(mesh->GetNumberOfPoints()), -1)
{
  std::vector<char> isShared(rankOfPoint.size(), 0);
  for (Index cell = 0; cell < rankOf.size(); ++cell)
  {
    own[rankOf[cell]].push_back(cell);
    forPoints(cell, [&](std::size_t p) {
      isShared[p] |= rankOfPoint[p] != noIndex && rankOfPoint[p] != rankOf[cell] ? 1 : 0;
      rankOfPoint[p] = std::min(rankOfPoint[p], rankOf[cell]);
    });
  }
  for (Index cell = 0; cell < rankOf.size(); ++cell)
  {
    bool isAtBorder = false;
    forPoints(cell, [&](std::size_t p) { isAtBorder = isAtBorder || isShared[p]; });
    if (isAtBorder)
    {
      atBorders.push_back(cell);
    }
  }
}

std::vector<Index> MeshShares::cellsOf(std::size_t rank, std::vector<char>& hasPoint) const
{
  std::vector<Index> taken = own[rank];
  std::vector<char> isTaken(rankOf.size(), 0);
  std::size_t last = 0; // cells before it have marked their points
  const auto mark = [&] {
    for (; last < taken.size(); ++last)
    {
      isTaken[taken[last]] = 1;
      forPoints(taken[last], [&](std::size_t p) { hasPoint[p] = 1; });
    }
  };
  const auto takeNear = [&](Index cell) {
    bool isNear = false;
    forPoints(cell, [&](std::size_t p) { isNear = isNear || hasPoint[p]; });
    if (isNear && !isTaken[cell])
    {
      taken.push_back(cell);
    }
  };
  mark();
  for (int level = 0; level < levels; ++level)
  {
    if (level == 0)
    {
      std::ranges::for_each(atBorders, takeNear);
    }
    for (Index cell = 0; level > 0 && cell < rankOf.size(); ++cell)
    {
      takeNear(cell);
    }
    mark();
  }
  std::ranges::sort(taken);
  return taken;
}

void MeshShares::markGhosts(vtkUnstructuredGrid* piece, const VtkIds& itsCells, const VtkIds& itsPoints,
                            std::size_t rank) const
{
  addGhostArray(piece->GetCellData(), itsCells, vtkDataSetAttributes::DUPLICATECELL,
                [&](std::size_t cell) { return rankOf[cell] != rank; });
  addGhostArray(piece->GetPointData(), itsPoints, vtkDataSetAttributes::DUPLICATEPOINT,
                [&](std::size_t point) { return rankOfPoint[point] != rank; });
}

vtkSmartPointer<vtkUnstructuredGrid> MeshShares::mesh(std::size_t rank)
{
  std::vector<char> hasPoint(rankOfPoint.size(), 0);
  const std::vector<Index> taken = cellsOf(rank, hasPoint);
  VtkIds points;
  for (std::size_t p = 0; p < hasPoint.size(); ++p)
  {
    if (hasPoint[p])
    {
      newPoint[p] = static_cast<vtkIdType>(points.size());
      points.push_back(static_cast<vtkIdType>(p));
    }
  }
  auto piece = vtkSmartPointer<vtkUnstructuredGrid>::New();
  piece->SetPoints(takePoints(whole->GetPoints(), points));
  const VtkIds itsCells(taken.begin(), taken.end());
  GridBuilder builder;
  std::ranges::for_each(itsCells, [&](vtkIdType cell) { builder.add(whole, cell, newPoint); });
  builder.finish(piece, !whole->GetCells() || isNarrow(whole->GetCells()));
  takeTuples(whole->GetPointData(), points, piece->GetPointData());
  takeTuples(whole->GetCellData(), itsCells, piece->GetCellData());
  addGlobalIds(piece->GetPointData(), "GlobalPointIds", points);
  addGlobalIds(piece->GetCellData(), "GlobalCellIds", itsCells);
  markGhosts(piece, itsCells, points, rank);
  piece->GetFieldData()->PassData(whole->GetFieldData());
  return piece;
}

vtkSmartPointer<vtkPartitionedDataSetCollection> MeshShares::patches(vtkPartitionedDataSetCollection* all,
                                                                     std::size_t rank) const
{
  auto pieces = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  pieces->SetNumberOfPartitionedDataSets(all->GetNumberOfPartitionedDataSets());
  vtkIdType firstFace = 0, firstPoint = 0;
  for (unsigned int i = 0; i < all->GetNumberOfPartitionedDataSets(); ++i)
  {
    if (all->HasMetaData(i))
    {
      pieces->GetMetaData(i)->Copy(all->GetMetaData(i));
    }
    for (unsigned int j = 0; j < all->GetNumberOfPartitions(i); ++j)
    {
      auto* patch = vtkPolyData::SafeDownCast(all->GetPartitionAsDataObject(i, j));
      if (patch && hasPolygonsAlone(patch))
      {
        pieces->SetPartition(i, j, pieceOfPatch(patch, rankOf, rank, firstFace, firstPoint));
        firstFace += patch->GetNumberOfCells();
        firstPoint += patch->GetNumberOfPoints();
      }
      else if (rank == 0)
      {
        pieces->SetPartition(i, j, all->GetPartitionAsDataObject(i, j));
      }
    }
  }
  pieces->GetFieldData()->PassData(all->GetFieldData());
  return pieces;
}

} // namespace atria
