// SPDX-License-Identifier: GPL-3.0-or-later
#include "SurfaceInput.h"

#include "Support/TestPaths.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace atria::testing {

namespace {

vtkSmartPointer<vtkPoints> pointsOf(const TriangleSurface& surface)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points)
  {
    points->InsertNextPoint(p.data());
  }
  return points;
}

void addTriangle(vtkCellArray* cells, const std::array<Index, 3>& triangle)
{
  cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
}

} // namespace

vtkSmartPointer<vtkPolyData> toPolyData(const TriangleSurface& surface)
{
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIntArray> ids;
  ids->SetName("SurfaceId");
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    addTriangle(cells, surface.triangles[i]);
    ids->InsertNextValue(static_cast<int>(surface.surfaceIds[i]));
  }
  vtkNew<vtkStringArray> names;
  names->SetName("SurfaceName");
  for (const std::string& name : surface.names)
  {
    names->InsertNextValue(name);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(surface));
  data->SetPolys(cells);
  data->GetCellData()->AddArray(ids);
  data->GetFieldData()->AddArray(names);
  return data;
}

vtkSmartPointer<vtkMultiBlockDataSet> toBlocks(const TriangleSurface& surface)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned id = 0; id < surface.names.size(); ++id)
  {
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    {
      if (surface.surfaceIds[i] == id)
      {
        addTriangle(cells, surface.triangles[i]);
      }
    }
    vtkNew<vtkPolyData> block;
    block->SetPoints(pointsOf(surface));
    block->SetPolys(cells);
    blocks->SetBlock(id, block);
    blocks->GetMetaData(id)->Set(vtkCompositeDataSet::NAME(), surface.names[id].c_str());
  }
  return blocks;
}

vtkSmartPointer<vtkPolyData> readModel(const std::filesystem::path& file)
{
  vtkNew<vtkAtriaVRMLReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPolyData> exampleModel(const char* name)
{
  return readModel(dataFolder().parent_path().parent_path() / "Examples" / "Data" / name);
}

} // namespace atria::testing
