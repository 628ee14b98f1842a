// SPDX-License-Identifier: GPL-3.0-or-later
/// Polydata and composites of any kind as the filters take them.
#include "Support/Error.h"
#include "VtkSurface.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <map>

namespace {

using atria::surfaceFromVtk;
using atria::surfaceNamesFromVtk;
using atria::Vec3;
using atria::VtkSurface;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// An arrow head in the plane z = 0, of area 2: 0, 1, 2, 3 with the reflex corner 3.
vtkNew<vtkPoints> arrow()
{
  vtkNew<vtkPoints> points;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(4, 2, 0), Vec3(0, 4, 0), Vec3(3, 2, 0)})
  {
    points->InsertNextPoint(p.data());
  }
  return points;
}

vtkNew<vtkPolyData> withCells(void (vtkPolyData::*set)(vtkCellArray*), std::initializer_list<vtkIdType> cell)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(arrow());
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(cell);
  (data->*set)(cells);
  return data;
}

vtkNew<vtkPolyData> arrowHead() { return withCells(&vtkPolyData::SetPolys, {0, 1, 2, 3}); }

std::map<std::string, double> areasOf(const VtkSurface& read)
{
  std::map<std::string, double> areas;
  const auto& surface = read.surface;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    const auto& t = surface.triangles[i];
    const Vec3 normal =
        (surface.points[t[1]] - surface.points[t[0]]).cross(surface.points[t[2]] - surface.points[t[0]]);
    EXPECT_GT(normal.z(), 0.0);
    areas[surface.names[surface.surfaceIds[i]]] += 0.5 * normal.norm();
  }
  return areas;
}

std::string errorOf(vtkDataObject* data)
{
  try
  {
    surfaceFromVtk({data});
  }
  catch (const atria::Error& error)
  {
    return error.what();
  }
  return {};
}

void addBlock(vtkMultiBlockDataSet* to, vtkDataObject* block, const char* name)
{
  const unsigned index = to->GetNumberOfBlocks();
  to->SetBlock(index, block);
  if (name)
  {
    to->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name);
  }
}

TEST(SurfaceInput, TriangulatesConcavePolygonsAndStripsAndCountsTheRest)
{
  EXPECT_EQ(areasOf(surfaceFromVtk({arrowHead()})).at("surface"), 2.0);
  const VtkSurface strip = surfaceFromVtk({withCells(&vtkPolyData::SetStrips, {0, 3, 2, 1})});
  EXPECT_EQ(strip.surface.triangles.size(), 2u);
  EXPECT_EQ(areasOf(surfaceFromVtk({withCells(&vtkPolyData::SetStrips, {0, 1, 3})})).at("surface"), 1.0);
  EXPECT_EQ(surfaceFromVtk({withCells(&vtkPolyData::SetLines, {0, 1, 2})}).ignoredCells, 1u);
}

TEST(SurfaceInput, NamesBlocksByTheirOwnNameOrThatOfTheNearestAround)
{
  vtkNew<vtkMultiBlockDataSet> inner;
  addBlock(inner, arrowHead(), nullptr);
  addBlock(inner, arrowHead(), "Door");
  vtkNew<vtkMultiBlockDataSet> outer;
  addBlock(outer, inner, "Wall");
  addBlock(outer, arrowHead(), "Roof");
  addBlock(outer, nullptr, "Nothing");
  addBlock(outer, vtkNew<vtkUnstructuredGrid>(), "Volume");
  EXPECT_THAT(surfaceFromVtk({outer}).surface.names, ElementsAre("Wall", "Door", "Roof"));
  EXPECT_THAT(surfaceNamesFromVtk(outer), ElementsAre("Wall", "Door", "Roof"));
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, arrowHead());
  collection->SetPartition(0, 1, arrowHead());
  collection->SetPartition(1, 0, arrowHead());
  collection->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "Pieces");
  const auto areas = areasOf(surfaceFromVtk({collection}));
  EXPECT_EQ(areas.at("Pieces"), 4.0);
  EXPECT_EQ(areas.at("surface"), 2.0);
}

TEST(SurfaceInput, TakesNamesOfCellsFromAnArrayOfStrings)
{
  vtkNew<vtkPolyData> data = arrowHead();
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({0, 1, 3});
  cells->InsertNextCell({3, 1, 2});
  data->SetPolys(cells);
  vtkNew<vtkStringArray> names;
  names->SetName("SurfaceName");
  names->InsertNextValue("East");
  names->InsertNextValue("West");
  data->GetCellData()->AddArray(names);
  EXPECT_THAT(surfaceNamesFromVtk(data), ElementsAre("East", "West"));
  const auto areas = areasOf(surfaceFromVtk({data}));
  EXPECT_EQ(areas.at("East"), 1.0);
  EXPECT_EQ(areas.at("West"), 1.0);
}

TEST(SurfaceInput, RefusesCellsWhosePointsOrNamesDoNotExist)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  addBlock(blocks, withCells(&vtkPolyData::SetPolys, {0, 1, 7}), "Wall");
  EXPECT_THAT(errorOf(blocks), HasSubstr("cell 0 of 'Wall' has a point that does not exist"));
  vtkNew<vtkPolyData> data = arrowHead();
  vtkNew<vtkIntArray> ids;
  ids->SetName("SurfaceId");
  ids->InsertNextValue(1);
  data->GetCellData()->AddArray(ids);
  vtkNew<vtkStringArray> names;
  names->SetName("SurfaceName");
  names->InsertNextValue("East");
  data->GetFieldData()->AddArray(names);
  EXPECT_THAT(errorOf(data), HasSubstr("SurfaceId"));
}

} // namespace
