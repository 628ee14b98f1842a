// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshOutput.h"

#include "Quality/Faces/Geometry.h"
#include "Support/QuietContext.h"
#include "VtkFaceMesh.h"
#include "vtkAtriaGridAlgorithm.h"

#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace atria::testing {

namespace {

std::vector<Vec3> facePoints(vtkPolyData* patch, vtkIdType face)
{
  vtkNew<vtkIdList> ids;
  patch->GetCellPoints(face, ids);
  std::vector<Vec3> points(ids->GetNumberOfIds());
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    patch->GetPoint(ids->GetId(i), points[i].data());
  }
  return points;
}

/// Calls f(mean, a, b) for the triangles of every face.
template <typename F> void eachTriangle(vtkPolyData* patch, F&& f)
{
  for (vtkIdType face = 0; face < patch->GetNumberOfCells(); ++face)
  {
    const std::vector<Vec3> points = facePoints(patch, face);
    const Vec3 mean = std::accumulate(points.begin(), points.end(), Vec3(0, 0, 0)) / static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      f(mean, points[i], points[(i + 1) % points.size()]);
    }
  }
}

/// Whether two rings of points are the same but for where they begin.
template <typename A, typename B> bool sameRing(const A& a, const B& b)
{
  const std::size_t n = a.size();
  for (std::size_t shift = 0; n == b.size() && shift < n; ++shift)
  {
    std::size_t i = 0;
    while (i < n && static_cast<std::int64_t>(a[i]) == static_cast<std::int64_t>(b[(i + shift) % n]))
    {
      ++i;
    }
    if (i == n)
    {
      return true;
    }
  }
  return false;
}

} // namespace

void setGrid(vtkAtriaGridAlgorithm* filter, const Box3& domain, double sizeMin, double sizeMid, double sizeMax)
{
  filter->SetDomainMode(vtkAtriaGridAlgorithm::Explicit);
  filter->SetDomainBounds(domain.min[0], domain.max[0], domain.min[1], domain.max[1], domain.min[2], domain.max[2]);
  filter->SetSizeMin(sizeMin);
  filter->SetSizeMid(sizeMid);
  filter->SetSizeMax(sizeMax);
}

std::string firstOf(const std::vector<std::string>& errors) { return errors.empty() ? "" : errors.front(); }

std::map<std::string, vtkPolyData*> patchesByName(vtkPartitionedDataSetCollection* patches)
{
  std::map<std::string, vtkPolyData*> all;
  for (unsigned i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    const std::string name = patches->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
    EXPECT_TRUE(all.emplace(name, vtkPolyData::SafeDownCast(patches->GetPartitionAsDataObject(i, 0))).second) << name;
  }
  return all;
}

std::vector<std::string> namesOf(const std::map<std::string, vtkPolyData*>& patches)
{
  std::vector<std::string> names;
  for (const auto& [name, patch] : patches)
  {
    names.push_back(name);
  }
  return names;
}

double areaOf(vtkPolyData* patch)
{
  double area = 0.0;
  eachTriangle(patch, [&](const Vec3& m, const Vec3& a, const Vec3& b) { area += 0.5 * (a - m).cross(b - m).norm(); });
  return area;
}

double enclosedVolume(vtkPartitionedDataSetCollection* patches)
{
  double volume = 0.0;
  for (const auto& [name, patch] : patchesByName(patches))
  {
    eachTriangle(patch, [&](const Vec3& m, const Vec3& a, const Vec3& b) { volume += m.dot(a.cross(b)) / 6.0; });
  }
  return volume;
}

std::vector<double> volumesOf(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches)
{
  const VtkFaceMesh faces = faceMeshFromVtk(mesh, patches);
  const MeshGeometry geometry = computeGeometry(faces.mesh, makeCellFaces(faces.mesh), quietContext());
  return {geometry.cellVolumes.begin(), geometry.cellVolumes.end()};
}

double totalVolume(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches)
{
  const std::vector<double> volumes = volumesOf(mesh, patches);
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

double volumeOf(const Box3& box) { return box.size().prod(); }

::testing::AssertionResult patchesAreTheBoundary(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches)
{
  const VtkFaceMesh faces = faceMeshFromVtk(mesh, patches);
  const std::size_t internal = faces.mesh.internalFaceCount();
  if (faces.patchFaces.size() != faces.mesh.faceCount() - internal)
  {
    return ::testing::AssertionFailure() << faces.patchFaces.size() << " faces in patches, "
                                         << faces.mesh.faceCount() - internal << " on the boundary";
  }
  std::vector<char> met(faces.mesh.faceCount(), 0);
  for (std::size_t i = 0; i < faces.patchFaces.size(); ++i)
  {
    const Index f = faces.patchFaces[i];
    const std::int64_t begin = faces.patches.offsets[i];
    const std::span ring(faces.patches.points.data() + begin, faces.patches.offsets[i + 1] - begin);
    if (f >= met.size() || f < internal || met[f]++ != 0)
    {
      return ::testing::AssertionFailure() << "patch face " << i << " is not a boundary face of its own";
    }
    if (faces.mesh.owner[f] != faces.patches.owners[i] || !sameRing(ring, faces.mesh.face(f)))
    {
      return ::testing::AssertionFailure()
             << "patch face " << i << " is not the face of its owner as seen from outside";
    }
  }
  return ::testing::AssertionSuccess();
}

std::vector<std::string> fieldStrings(vtkDataObject* data, const char* array)
{
  std::vector<std::string> out;
  auto* strings = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(array));
  for (vtkIdType i = 0; strings && i < strings->GetNumberOfValues(); ++i)
  {
    out.push_back(strings->GetValue(i));
  }
  return out;
}

} // namespace atria::testing
