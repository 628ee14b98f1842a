// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkArrays.h"

#include "Support/Error.h"
#include "Support/Memory.h"
#include "VtkVersions.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <utility>

namespace atria {

namespace {

Buffer<std::int64_t> integers(vtkDataArray* array)
{
  Buffer<std::int64_t> values(array ? array->GetNumberOfValues() : 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<std::int64_t>(array->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  return values;
}

Index cellOf(vtkDataArray* array, vtkIdType face, const std::string& name, vtkUnstructuredGrid* volume)
{
  const auto cell = static_cast<vtkIdType>(array->GetComponent(face, 0));
  if (cell < 0 || cell >= volume->GetNumberOfCells())
  {
    throw Error("patch '" + name + "': face " + std::to_string(face) + " belongs to cell " + std::to_string(cell) +
                ", which the volume mesh does not have");
  }
  return static_cast<Index>(cell);
}

vtkDataArray* neighborsOf(vtkPolyData* patch) { return patch->GetCellData()->GetArray("NeighborCellId"); }

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
  const Buffer<std::int64_t> ids = integers(pointIds);
  vtkDataArray* neighbors = neighborsOf(patch);
  vtkNew<vtkIdList> face;
  std::vector<std::int64_t> corners;
  for (vtkIdType cell = 0; cell < patch->GetNumberOfCells(); ++cell)
  {
    const Index owner = cellOf(owners, cell, name, volume);
    const auto neighbor = neighbors ? std::optional(cellOf(neighbors, cell, name, volume)) : std::nullopt;
    patch->GetCellPoints(cell, face);
    corners.clear();
    for (vtkIdType i = 0; i < face->GetNumberOfIds(); ++i)
    {
      const std::int64_t id = ids[face->GetId(i)];
      if (id < 0 || id >= volume->GetNumberOfPoints())
      {
        throw Error("patch '" + name + "': face " + std::to_string(cell) + " has point " + std::to_string(id) +
                    ", which the volume mesh does not have");
      }
      corners.push_back(id);
    }
    out.append(owner, neighbor, corners);
  }
}

/// Reads the blocks that are face zones, or those that are not.
VtkPatches blocksFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume, bool zones)
{
  VtkPatches out;
  for (unsigned int i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    const std::string name = patchNameOf(patches, i);
    const std::size_t first = out.owners.size();
    bool isZone = false;
    vtkPartitionedDataSet* parts = patches->GetPartitionedDataSet(i);
    for (unsigned int j = 0; parts && j < parts->GetNumberOfPartitions(); ++j)
    {
      auto* polyData = vtkPolyData::SafeDownCast(parts->GetPartitionAsDataObject(j));
      isZone = isZone || (polyData && neighborsOf(polyData));
      if (polyData && (neighborsOf(polyData) != nullptr) == zones)
      {
        appendPatch(out, name, polyData, volume);
      }
    }
    if (isZone == zones)
    {
      out.close(name, first);
    }
  }
  return out;
}

} // namespace

std::string patchNameOf(vtkPartitionedDataSetCollection* patches, unsigned int i)
{
  if (patches->HasMetaData(i) && patches->GetMetaData(i)->Has(vtkCompositeDataSet::NAME()))
  {
    return patches->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
  }
  return "patch" + std::to_string(i);
}

std::vector<Vec3> pointsFromVtk(vtkPoints* points, const Executor& executor)
{
  if (!points)
  {
    return {};
  }
  std::vector<Vec3> out(static_cast<std::size_t>(points->GetNumberOfPoints()));
  if (auto* doubles = vtkDoubleArray::SafeDownCast(points->GetData()))
  {
    const double* values = doubles->GetPointer(0);
    executor.forEach(out.size(), 65536, [&](std::size_t i) { out[i] = Vec3(values + 3 * i); });
    return out;
  }
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    points->GetPoint(static_cast<vtkIdType>(i), out[i].data());
  }
  return out;
}

vtkSmartPointer<vtkPoints> pointsToVtk(std::span<const Vec3> points, const Executor& executor)
{
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  double* const to = coordinates->GetPointer(0);
  useLargePages(to, points.size_bytes());
  executor.forRanges(points.size(), 65536, [&](std::size_t begin, std::size_t end) {
    std::copy_n(points[begin].data(), 3 * (end - begin), to + 3 * begin);
  });
  auto out = vtkSmartPointer<vtkPoints>::New();
  out->SetData(coordinates);
  return out;
}

VtkPoints::VtkPoints(vtkPoints* points, const Executor& executor)
{
  if (auto* doubles = points ? vtkDoubleArray::SafeDownCast(points->GetData()) : nullptr)
  {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    points_ = {reinterpret_cast<const Vec3*>(doubles->GetPointer(0)),
               static_cast<std::size_t>(points->GetNumberOfPoints())};
    return;
  }
  copy_ = pointsFromVtk(points, executor);
  points_ = copy_;
}

IdView VtkCells::viewOrCopy(vtkDataArray* array)
{
  const bool sameLayout = array && array->GetDataTypeSize() == sizeof(std::int64_t) &&
                          array->HasStandardMemoryLayout() && array->GetDataType() != VTK_DOUBLE;
  if (sameLayout)
  {
    return IdView::Wide(static_cast<const std::int64_t*>(array->GetVoidPointer(0)),
                        static_cast<std::size_t>(array->GetNumberOfValues()));
  }
  if (vtkTypeInt32Array* narrow = vtkArrayDownCast<vtkTypeInt32Array>(array))
  {
    return IdView::Narrow(narrow->GetPointer(0), static_cast<std::size_t>(narrow->GetNumberOfValues()));
  }
  return copies.emplace_back(integers(array));
}

std::span<const unsigned char> VtkCells::viewOrCopyTypes(vtkDataArray* array)
{
  if (auto* types = vtkUnsignedCharArray::FastDownCast(array))
  {
    return {types->GetPointer(0), static_cast<std::size_t>(types->GetNumberOfValues())};
  }
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    typeCopy.push_back(static_cast<unsigned char>(array->GetComponent(i, 0)));
  }
  return typeCopy;
}

VtkCells::VtkCells(vtkUnstructuredGrid* grid)
{
  static const std::int64_t none[] = {0};
  arrays.offsets = none;
  if (grid->GetNumberOfCells() == 0)
  {
    return;
  }
  arrays.types = viewOrCopyTypes(cellTypesOf(grid));
  arrays.offsets = viewOrCopy(grid->GetCells()->GetOffsetsArray());
  arrays.connectivity = viewOrCopy(grid->GetCells()->GetConnectivityArray());
  const std::vector<vtkDataArray*> faceArrays = faceArraysOf(grid);
  if (!faceArrays.front() && std::ranges::find(arrays.types, VTK_POLYHEDRON) != arrays.types.end())
  {
    throw Error("the mesh has polyhedra without faces: VTK 9.4 and later write them to files in a form that earlier "
                "versions pass over; read such a file where VTK is as new, or write it there in another format");
  }
  std::vector<IdView> faces;
  std::ranges::transform(faceArrays, std::back_inserter(faces), [&](vtkDataArray* array) { return viewOrCopy(array); });
  arrays.faces = facesIn(faces);
}

std::span<const std::int64_t> VtkPatches::face(std::size_t f) const
{
  return {points.data() + offsets[f], points.data() + offsets[f + 1]};
}

void VtkPatches::close(std::string name, std::size_t firstFace)
{
  patches.push_back({std::move(name), firstFace, owners.size() - firstFace});
}

std::vector<BoundaryFaceKey> VtkPatches::keys() const
{
  std::vector<BoundaryFaceKey> out(owners.size());
  for (std::size_t f = 0; f < owners.size(); ++f)
  {
    out[f] = {owners[f], face(f)};
  }
  return out;
}

VtkPatches patchesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume)
{
  return blocksFromVtk(patches, volume, false);
}

VtkPatches faceZonesFromVtk(vtkPartitionedDataSetCollection* patches, vtkUnstructuredGrid* volume)
{
  return blocksFromVtk(patches, volume, true);
}

} // namespace atria
