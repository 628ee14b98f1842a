// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkArrays.h"

#include "Support/Error.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

namespace atria {

namespace {

std::vector<std::int64_t> integers(vtkDataArray* array)
{
  std::vector<std::int64_t> values(array ? array->GetNumberOfValues() : 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<std::int64_t>(array->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  return values;
}

/// Appends one patch; `ids` maps its points to the volume mesh's.
void appendPatch(VtkPatches& out, const std::string& name, vtkPolyData* patch, vtkUnstructuredGrid* volume)
{
  vtkDataArray* owners = patch->GetCellData()->GetArray("OwnerCellId");
  vtkDataArray* pointIds = patch->GetPointData()->GetArray("VolumePointId");
  if (!owners || !pointIds)
  {
    throw Error("patch '" + name +
                "' lacks the cell array OwnerCellId or the point array VolumePointId; "
                "patches must come from the mesher");
  }
  const std::vector<std::int64_t> ids = integers(pointIds);
  vtkNew<vtkIdList> face;
  for (vtkIdType cell = 0; cell < patch->GetNumberOfCells(); ++cell)
  {
    const auto owner = static_cast<vtkIdType>(owners->GetComponent(cell, 0));
    if (owner < 0 || owner >= volume->GetNumberOfCells())
    {
      throw Error("patch '" + name + "': face " + std::to_string(cell) + " belongs to cell " + std::to_string(owner) +
                  ", which the volume mesh does not have");
    }
    out.owners.push_back(static_cast<Index>(owner));
    patch->GetCellPoints(cell, face);
    for (vtkIdType i = 0; i < face->GetNumberOfIds(); ++i)
    {
      const std::int64_t id = ids[face->GetId(i)];
      if (id < 0 || id >= volume->GetNumberOfPoints())
      {
        throw Error("patch '" + name + "': face " + std::to_string(cell) + " has point " + std::to_string(id) +
                    ", which the volume mesh does not have");
      }
      out.points.push_back(id);
    }
    out.offsets.push_back(static_cast<std::int64_t>(out.points.size()));
  }
}

std::string nameOf(vtkPartitionedDataSetCollection* patches, unsigned int i)
{
  if (patches->HasMetaData(i) && patches->GetMetaData(i)->Has(vtkCompositeDataSet::NAME()))
  {
    return patches->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
  }
  return "patch" + std::to_string(i);
}

} // namespace

std::vector<Vec3> pointsFromVtk(vtkPoints* points)
{
  std::vector<Vec3> out(points ? points->GetNumberOfPoints() : 0);
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    points->GetPoint(static_cast<vtkIdType>(i), out[i].data());
  }
  return out;
}

VtkCells cellsFromVtk(vtkUnstructuredGrid* grid)
{
  VtkCells cells;
  const vtkIdType count = grid->GetNumberOfCells();
  cells.types.resize(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    cells.types[i] = static_cast<unsigned char>(grid->GetCellType(i));
  }
  if (count == 0)
  {
    cells.offsets = {0};
    return cells;
  }
  cells.offsets = integers(grid->GetCells()->GetOffsetsArray());
  cells.connectivity = integers(grid->GetCells()->GetConnectivityArray());
  cells.faceStream = integers(grid->GetFaces());
  cells.faceLocations = integers(grid->GetFaceLocations());
  return cells;
}

std::vector<BoundaryFaceKey> VtkPatches::keys() const
{
  std::vector<BoundaryFaceKey> out(owners.size());
  for (std::size_t f = 0; f < owners.size(); ++f)
  {
    out[f] = {owners[f], {points.data() + offsets[f], points.data() + offsets[f + 1]}};
  }
  return out;
}

VtkPatches patchesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume)
{
  VtkPatches out;
  for (unsigned int i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    const std::string name = nameOf(patches, i);
    const std::size_t first = out.owners.size();
    vtkPartitionedDataSet* parts = patches->GetPartitionedDataSet(i);
    for (unsigned int j = 0; parts && j < parts->GetNumberOfPartitions(); ++j)
    {
      if (auto* polyData = vtkPolyData::SafeDownCast(parts->GetPartitionAsDataObject(j)))
      {
        appendPatch(out, name, polyData, volume);
      }
    }
    out.patches.push_back({name, first, out.owners.size() - first});
  }
  return out;
}

} // namespace atria
