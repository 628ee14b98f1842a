// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/SampleGrid.h"

#include "Quality/Faces/CellShapes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <map>

namespace atria::testing {

namespace {

/// The faces of one patch, each by its owner.
struct PatchFaces
{
  std::vector<std::vector<Index>> faces;
  std::vector<Index> owners;

  void add(std::vector<Index> face, Index owner)
  {
    faces.push_back(std::move(face));
    owners.push_back(owner);
  }
};

vtkSmartPointer<vtkPolyData> toPolyData(const FaceMesh& mesh, const PatchFaces& patch)
{
  std::map<Index, vtkIdType> ids;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> pointIds;
  pointIds->SetName("VolumePointId");
  vtkNew<vtkIdTypeArray> ownerIds;
  ownerIds->SetName("OwnerCellId");
  vtkNew<vtkCellArray> polygons;
  for (std::size_t f = 0; f < patch.faces.size(); ++f)
  {
    std::vector<vtkIdType> polygon;
    for (const Index point : patch.faces[f])
    {
      const auto [found, isNew] = ids.try_emplace(point, points->GetNumberOfPoints());
      if (isNew)
      {
        points->InsertNextPoint(mesh.points[point].data());
        pointIds->InsertNextValue(point);
      }
      polygon.push_back(found->second);
    }
    polygons->InsertNextCell(static_cast<vtkIdType>(polygon.size()), polygon.data());
    ownerIds->InsertNextValue(patch.owners[f]);
  }
  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  polyData->SetPoints(points);
  polyData->SetPolys(polygons);
  polyData->GetPointData()->AddArray(pointIds);
  polyData->GetCellData()->AddArray(ownerIds);
  return polyData;
}

Vec3 centerOf(const FaceMesh& mesh, std::size_t f)
{
  Vec3 sum = Vec3::Zero();
  for (const Index point : mesh.face(f))
  {
    sum += mesh.points[point];
  }
  return sum / static_cast<double>(mesh.face(f).size());
}

} // namespace

vtkSmartPointer<vtkUnstructuredGrid> toGrid(const SampleMesh& mesh)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points)
  {
    points->InsertNextPoint(p.data());
  }
  grid->SetPoints(points);
  for (std::size_t c = 0; c < mesh.types.size(); ++c)
  {
    if (mesh.types[c] == polyhedronCell)
    {
      const std::vector<vtkIdType> stream(mesh.faceStream.begin() + mesh.faceLocations[c], mesh.faceStream.end());
      grid->InsertNextCell(polyhedronCell, stream[0], stream.data() + 1);
    }
    else
    {
      const std::vector<vtkIdType> ids(mesh.connectivity.begin() + mesh.offsets[c],
                                       mesh.connectivity.begin() + mesh.offsets[c + 1]);
      grid->InsertNextCell(mesh.types[c], static_cast<vtkIdType>(ids.size()), ids.data());
    }
  }
  return grid;
}

vtkSmartPointer<vtkPartitionedDataSetCollection> toPatches(const FaceMesh& mesh, const NameOfFace& boundary)
{
  return toPatches(mesh, boundary, [](const Vec3&) { return std::string(); });
}

vtkSmartPointer<vtkPartitionedDataSetCollection> toPatches(const FaceMesh& mesh, const NameOfFace& boundary,
                                                           const NameOfFace& sheet)
{
  std::map<std::string, PatchFaces> patches;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const bool internal = f < mesh.internalFaceCount();
    const std::string name = internal ? sheet(centerOf(mesh, f)) : boundary(centerOf(mesh, f));
    std::vector<Index> face(mesh.face(f).begin(), mesh.face(f).end());
    if (!name.empty())
    {
      patches[internal ? name + "_front" : name].add(face, mesh.owner[f]);
    }
    if (!name.empty() && internal)
    {
      patches[name + "_back"].add({face.rbegin(), face.rend()}, mesh.neighbor[f]);
    }
  }
  auto out = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  for (const auto& [name, patch] : patches)
  {
    const unsigned int i = out->GetNumberOfPartitionedDataSets();
    vtkNew<vtkPartitionedDataSet> part;
    part->SetPartition(0, toPolyData(mesh, patch));
    out->SetPartitionedDataSet(i, part);
    out->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), name.c_str());
  }
  return out;
}

NameOfFace sidesOfBox(std::array<int, 3> n)
{
  return [n](const Vec3& center) -> std::string {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (center[axis] < 1e-9)
      {
        return sideNames[2 * axis];
      }
      if (center[axis] > n[axis] - 1e-9)
      {
        return sideNames[2 * axis + 1];
      }
    }
    return {};
  };
}

} // namespace atria::testing
