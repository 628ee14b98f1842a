// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkVersions.h"

#include "Quality/Faces/CellArrays.h"

#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace atria {

namespace {

/// Adds an array of `count` ids to `owned`. Returns a pointer to its values.
vtkIdType* makeIds(vtkIdType count, std::vector<vtkSmartPointer<vtkDataArray>>& owned)
{
  const auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetNumberOfValues(count);
  owned.emplace_back(array);
  return array->GetPointer(0);
}

} // namespace

vtkDataArray* cellTypesOf(vtkUnstructuredGrid* grid)
{
  if (grid->GetNumberOfCells() == 0)
  {
    return nullptr;
  }
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return grid->GetCellTypes();
#else
  return grid->GetCellTypesArray();
#endif
}

#if ATRIA_VTK_HAS_FACE_LISTS

std::vector<vtkDataArray*> faceArraysOf(vtkUnstructuredGrid* grid)
{
  std::vector<vtkDataArray*> arrays(faceArrayCount, nullptr);
  vtkCellArray* const locations = grid->GetPolyhedronFaceLocations();
  vtkCellArray* const faces = grid->GetPolyhedronFaces();
  if (locations && faces)
  {
    arrays = {locations->GetOffsetsArray(), locations->GetConnectivityArray(), faces->GetOffsetsArray(),
              faces->GetConnectivityArray()};
  }
  return arrays;
}

void setCells(vtkUnstructuredGrid* grid, vtkDataArray* types, vtkCellArray* cells, std::span<vtkDataArray* const> faces)
{
  // Types are a vtkUnsignedCharArray up to VTK 9.5.
  constexpr bool takesAnyTypes = VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0);
  auto* const given = static_cast<std::conditional_t<takesAnyTypes, vtkDataArray, vtkUnsignedCharArray>*>(types);
  vtkSmartPointer<vtkCellArray> lists[2];
  for (std::size_t i = 0; i < 2 && faces[0]; ++i)
  {
    lists[i] = vtkSmartPointer<vtkCellArray>::New();
    lists[i]->SetData(faces[2 * i], faces[2 * i + 1]);
  }
  grid->SetPolyhedralCells(given, cells, lists[0], lists[1]);
}

PolyhedronFaces facesIn(std::span<const IdView> faces)
{
  return PolyhedronFaces::Lists(faces[0], faces[1], faces[2], faces[3]);
}

FaceLists::FaceLists(vtkIdType cellCount, const FaceSizes& all)
{
  if (all.cells > 0)
  {
    for (const vtkIdType count : {cellCount + 1, all.faces, all.faces + 1, all.points})
    {
      values_.push_back(makeIds(count, owned_));
    }
    values_[0][cellCount] = all.faces;
    values_[2][all.faces] = all.points;
    std::iota(values_[1], values_[1] + all.faces, vtkIdType{0}); // each face belongs to one cell
  }
}

void FaceLists::skip(vtkIdType cell, const FaceSizes& before) { begin(cell, before, 0); }

void FaceLists::begin(vtkIdType cell, const FaceSizes& before, vtkIdType)
{
  if (!values_.empty())
  {
    values_[0][cell] = before.faces;
  }
}

vtkIdType* FaceLists::place(const FaceSizes& before, vtkIdType)
{
  values_[2][before.faces] = before.points;
  return values_[3] + before.points;
}

#else

std::vector<vtkDataArray*> faceArraysOf(vtkUnstructuredGrid* grid)
{
  return {grid->GetFaceLocations(), grid->GetFaces()};
}

void setCells(vtkUnstructuredGrid* grid, vtkDataArray* types, vtkCellArray* cells, std::span<vtkDataArray* const> faces)
{
  grid->SetCells(vtkUnsignedCharArray::SafeDownCast(types), cells, vtkIdTypeArray::SafeDownCast(faces[0]),
                 vtkIdTypeArray::SafeDownCast(faces[1]));
}

PolyhedronFaces facesIn(std::span<const IdView> faces) { return PolyhedronFaces::Stream(faces[1], faces[0]); }

namespace {

/// Each polyhedron and each face starts with a count.
vtkIdType inStream(const FaceSizes& sizes) { return sizes.cells + sizes.faces + sizes.points; }

} // namespace

FaceLists::FaceLists(vtkIdType cellCount, const FaceSizes& all)
{
  if (all.cells > 0)
  {
    values_.push_back(makeIds(cellCount, owned_));
    values_.push_back(makeIds(inStream(all), owned_));
  }
}

void FaceLists::skip(vtkIdType cell, const FaceSizes&)
{
  if (!values_.empty())
  {
    values_[0][cell] = -1;
  }
}

void FaceLists::begin(vtkIdType cell, const FaceSizes& before, vtkIdType count)
{
  values_[0][cell] = inStream(before);
  values_[1][inStream(before)] = count;
}

vtkIdType* FaceLists::place(const FaceSizes& before, vtkIdType count)
{
  values_[1][inStream(before)] = count;
  return values_[1] + inStream(before) + 1;
}

#endif

std::vector<vtkDataArray*> FaceLists::arrays() const
{
  std::vector<vtkDataArray*> arrays(faceArrayCount, nullptr);
  std::copy(owned_.begin(), owned_.end(), arrays.begin());
  return arrays;
}

bool isAskedToStop(vtkAlgorithm& algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  return algorithm.CheckAbort() || algorithm.GetAbortExecute();
#else
  return algorithm.GetAbortExecute() != 0;
#endif
}

} // namespace atria
