// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshSums.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <map>
#include <string>

namespace atria::tool {

namespace {

/// Returns the length of the polygon's area vector, by triangles around its first point; exact for planar faces.
double polygonArea(vtkPoints* points, vtkIdType count, const vtkIdType* ids)
{
  double origin[3], p[3], q[3];
  double sum[3] = {0, 0, 0};
  points->GetPoint(ids[0], origin);
  for (vtkIdType i = 1; i + 1 < count; ++i)
  {
    points->GetPoint(ids[i], p);
    points->GetPoint(ids[i + 1], q);
    for (int axis = 0; axis < 3; ++axis)
    {
      const int j = (axis + 1) % 3, k = (axis + 2) % 3;
      sum[axis] += (p[j] - origin[j]) * (q[k] - origin[k]) - (p[k] - origin[k]) * (q[j] - origin[j]);
    }
  }
  return 0.5 * std::hypot(sum[0], sum[1], sum[2]);
}

/// Returns {zone: volume}; null without the arrays.
Json zoneVolumesOf(vtkUnstructuredGrid* mesh)
{
  vtkDataArray* ids = mesh->GetCellData()->GetArray("ZoneId");
  vtkDataArray* cellVolumes = mesh->GetCellData()->GetArray("Volume");
  if (!ids || !cellVolumes)
  {
    return {};
  }
  vtkUnsignedCharArray* ghosts = mesh->GetCellGhostArray();
  std::map<int, double> volumes;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    if (!ghosts || ghosts->GetValue(i) == 0)
    {
      volumes[static_cast<int>(ids->GetTuple1(i))] += cellVolumes->GetTuple1(i);
    }
  }
  Json sums = Json::object();
  for (const auto& [zone, volume] : volumes)
  {
    sums[std::to_string(zone)] = volume;
  }
  return sums;
}

/// Returns [{name, faces, area, face_zone}].
Json allPatchesOf(vtkPartitionedDataSetCollection* patches)
{
  Json list = Json::array();
  for (unsigned int i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkIdType faces = 0;
    double area = 0.0;
    bool isFaceZone = false;
    for (unsigned int j = 0; j < patches->GetNumberOfPartitions(i); ++j)
    {
      if (auto* part = vtkPolyData::SafeDownCast(patches->GetPartition(i, j)))
      {
        faces += part->GetNumberOfCells();
        area += areaOf(part);
        isFaceZone = isFaceZone || part->GetCellData()->HasArray("NeighborCellId") != 0;
      }
    }
    const bool named = patches->HasMetaData(i) && patches->GetMetaData(i)->Has(vtkCompositeDataSet::NAME());
    const char* name = named ? patches->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : "";
    list.push_back({{"name", name}, {"faces", faces}, {"area", area}, {"face_zone", isFaceZone}});
  }
  return list;
}

/// Adds the numbers of one object to those of another, key by key. Either may be null.
void addNumbers(const Json& from, Json& to)
{
  to = to.is_null() && !from.is_null() ? Json::object() : to;
  for (const auto& [key, value] : from.items())
  {
    if (value.is_number_float())
    {
      to[key] = to.value(key, 0.0) + value.get<double>();
    }
    else if (value.is_number())
    {
      to[key] = to.value(key, 0LL) + value.get<long long>();
    }
  }
}

} // namespace

double areaOf(vtkPolyData* surface)
{
  double area = 0.0;
  auto faces = vtk::TakeSmartPointer(surface->GetPolys()->NewIterator());
  for (faces->GoToFirstCell(); !faces->IsDoneWithTraversal(); faces->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    faces->GetCurrentCell(count, ids);
    if (count > 2)
    {
      area += polygonArea(surface->GetPoints(), count, ids);
    }
  }
  return area;
}

Json countsOf(vtkUnstructuredGrid* mesh)
{
  const auto isGhost = [](vtkUnsignedCharArray* ghosts, vtkIdType i) { return ghosts && ghosts->GetValue(i) != 0; };
  vtkIdType elements = 0, hexahedra = 0, wedges = 0, pyramids = 0, tetrahedra = 0, polyhedra = 0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    if (isGhost(mesh->GetCellGhostArray(), i))
    {
      continue;
    }
    ++elements;
    switch (mesh->GetCellType(i))
    {
      case VTK_HEXAHEDRON:
      case VTK_VOXEL:
        ++hexahedra;
        break;
      case VTK_WEDGE:
        ++wedges;
        break;
      case VTK_PYRAMID:
        ++pyramids;
        break;
      case VTK_TETRA:
        ++tetrahedra;
        break;
      case VTK_POLYHEDRON:
        ++polyhedra;
        break;
      default:
        break;
    }
  }
  vtkIdType vertices = 0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    vertices += isGhost(mesh->GetPointGhostArray(), i) ? 0 : 1;
  }
  return {{"vertices", vertices}, {"elements", elements},     {"hexahedra", hexahedra}, {"wedges", wedges},
          {"pyramids", pyramids}, {"tetrahedra", tetrahedra}, {"polyhedra", polyhedra}};
}

Json sumsOf(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches)
{
  return {{"counts", countsOf(mesh)}, {"zone_volumes", zoneVolumesOf(mesh)}, {"patches", allPatchesOf(patches)}};
}

void addSums(const Json& piece, Json& sums)
{
  addNumbers(piece["counts"], sums["counts"]);
  addNumbers(piece["zone_volumes"], sums["zone_volumes"]);
  for (std::size_t i = 0; i < sums["patches"].size(); ++i)
  {
    Json& patch = sums["patches"][i];
    addNumbers(piece["patches"][i], patch);
    patch["face_zone"] = patch["face_zone"].get<bool>() || piece["patches"][i]["face_zone"].get<bool>();
  }
}

Json patchesOf(const Json& sums)
{
  Json list = Json::array();
  for (const Json& patch : sums["patches"])
  {
    if (!patch["face_zone"].get<bool>())
    {
      list.push_back({{"name", patch["name"]}, {"faces", patch["faces"]}, {"area", patch["area"]}});
    }
  }
  return list;
}

} // namespace atria::tool
