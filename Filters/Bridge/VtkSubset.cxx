// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkSubset.h"

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <limits>

namespace atria {

namespace {

vtkNew<vtkIdList> listOf(const VtkIds& ids)
{
  vtkNew<vtkIdList> list;
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->GetPointer(0));
  return list;
}

template <typename Array> vtkNew<Array> arrayOf(const VtkIds& ids)
{
  vtkNew<Array> array;
  array->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::transform(ids.begin(), ids.end(), array->GetPointer(0),
                 [](vtkIdType id) { return static_cast<typename Array::ValueType>(id); });
  return array;
}

} // namespace

vtkSmartPointer<vtkIdTypeArray> idArray(const char* name, std::span<const vtkIdType> ids)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), array->GetPointer(0));
  return array;
}

void takeTuples(vtkDataSetAttributes* from, const VtkIds& ids, vtkDataSetAttributes* to)
{
  const vtkNew<vtkIdList> list = listOf(ids);
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = from->GetAbstractArray(i);
    const auto part = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    part->SetName(array->GetName());
    part->SetNumberOfComponents(array->GetNumberOfComponents());
    part->CopyComponentNames(array);
    part->SetNumberOfTuples(list->GetNumberOfIds());
    if (!ids.empty())
    {
      array->GetTuples(list, part);
    }
    to->AddArray(part);
  }
  for (int attribute = 0; attribute < vtkDataSetAttributes::NUM_ATTRIBUTES; ++attribute)
  {
    if (vtkAbstractArray* active = from->GetAbstractAttribute(attribute); active && active->GetName())
    {
      to->SetActiveAttribute(active->GetName(), attribute);
    }
  }
}

vtkSmartPointer<vtkPoints> takePoints(vtkPoints* from, const VtkIds& ids)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(from ? from->GetDataType() : VTK_DOUBLE);
  points->SetNumberOfPoints(static_cast<vtkIdType>(ids.size()));
  if (from && !ids.empty())
  {
    from->GetData()->GetTuples(listOf(ids), points->GetData());
  }
  return points;
}

void GridBuilder::add(vtkUnstructuredGrid* from, vtkIdType cell, std::span<const vtkIdType> newPoint)
{
  const int type = from->GetCellType(cell);
  types.push_back(static_cast<unsigned char>(type));
  vtkIdType count = 0;
  const vtkIdType* points = nullptr;
  from->GetCellPoints(cell, count, points);
  std::for_each(points, points + count,
                [&](vtkIdType p) { connectivity.push_back(newPoint[static_cast<std::size_t>(p)]); });
  offsets.push_back(static_cast<vtkIdType>(connectivity.size()));
  if (type != VTK_POLYHEDRON)
  {
    return;
  }
  // The stream holds the number of faces, then for each face the number of its points and the points.
  from->GetFaceStream(cell, faceStream);
  const vtkIdType* next = faceStream->GetPointer(0);
  faceCounts.push_back(*next++);
  for (vtkIdType f = 0; f < faceCounts.back(); ++f)
  {
    faceSizes.push_back(*next++);
    const auto take = [&](vtkIdType p) { return newPoint[static_cast<std::size_t>(p)]; };
    std::transform(next, next + faceSizes.back(), std::back_inserter(facePoints), take);
    next += faceSizes.back();
  }
}

bool isNarrow(vtkCellArray* cells)
{
  return cells->GetConnectivityArray()->GetDataTypeSize() == static_cast<int>(sizeof(std::int32_t));
}

vtkSmartPointer<vtkCellArray> cellArray(const VtkIds& offsets, const VtkIds& connectivity, bool narrow)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  if (narrow && connectivity.size() < static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
  {
    cells->SetData(arrayOf<vtkTypeInt32Array>(offsets), arrayOf<vtkTypeInt32Array>(connectivity));
  }
  else
  {
    cells->SetData(arrayOf<vtkTypeInt64Array>(offsets), arrayOf<vtkTypeInt64Array>(connectivity));
  }
  return cells;
}

void GridBuilder::finish(vtkUnstructuredGrid* out, bool narrow)
{
  vtkNew<vtkUnsignedCharArray> cellTypes;
  cellTypes->SetNumberOfValues(static_cast<vtkIdType>(types.size()));
  std::copy(types.begin(), types.end(), cellTypes->GetPointer(0));
  const auto cells = cellArray(offsets, connectivity, narrow);
  VtkIds().swap(connectivity);
  VtkIds().swap(offsets);
  setCells(out, cellTypes, cells, makeFaces().arrays());
}

FaceLists GridBuilder::makeFaces() const
{
  const auto count = [](const auto& list) { return static_cast<vtkIdType>(list.size()); };
  FaceLists lists(count(types), {count(faceCounts), count(faceSizes), count(facePoints)});
  FaceSizes used;
  for (std::size_t cell = 0; cell < types.size(); ++cell)
  {
    if (types[cell] != VTK_POLYHEDRON)
    {
      lists.skip(static_cast<vtkIdType>(cell), used);
      continue;
    }
    const vtkIdType faces = faceCounts[static_cast<std::size_t>(used.cells)];
    lists.begin(static_cast<vtkIdType>(cell), used, faces);
    ++used.cells;
    for (vtkIdType f = 0; f < faces; ++f)
    {
      const auto size = static_cast<std::size_t>(faceSizes[static_cast<std::size_t>(used.faces)]);
      lists.addFace(used, std::span(facePoints).subspan(static_cast<std::size_t>(used.points), size));
    }
  }
  return lists;
}

vtkSmartPointer<vtkUnstructuredGrid> withoutGhostCells(vtkUnstructuredGrid* grid)
{
  constexpr int leftOut = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  if (!ghosts || std::none_of(ghosts->Begin(), ghosts->End(), [](int ghost) { return (ghost & leftOut) != 0; }))
  {
    return grid;
  }
  VtkIds cells, points, newPoint(static_cast<std::size_t>(grid->GetNumberOfPoints()), -1);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if ((ghosts->GetValue(cell) & leftOut) == 0)
    {
      cells.push_back(cell);
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      grid->GetCellPoints(cell, count, corners);
      std::for_each(corners, corners + count, [&](vtkIdType p) { newPoint[static_cast<std::size_t>(p)] = 0; });
    }
  }
  for (std::size_t p = 0; p < newPoint.size(); ++p)
  {
    if (newPoint[p] == 0)
    {
      newPoint[p] = static_cast<vtkIdType>(points.size());
      points.push_back(static_cast<vtkIdType>(p));
    }
  }
  auto rest = vtkSmartPointer<vtkUnstructuredGrid>::New();
  rest->SetPoints(takePoints(grid->GetPoints(), points));
  GridBuilder builder;
  std::ranges::for_each(cells, [&](vtkIdType cell) { builder.add(grid, cell, newPoint); });
  builder.finish(rest, isNarrow(grid->GetCells()));
  takeTuples(grid->GetPointData(), points, rest->GetPointData());
  takeTuples(grid->GetCellData(), cells, rest->GetCellData());
  rest->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  rest->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  rest->GetFieldData()->PassData(grid->GetFieldData());
  return rest;
}

} // namespace atria
