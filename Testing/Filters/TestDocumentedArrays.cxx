// SPDX-License-Identifier: GPL-3.0-or-later
/// docs/arrays.md lists the arrays of the outputs, all of them and no others.
#include "DualMesherTest.h"
#include "Ranks/VtkShares.h"
#include "Support/Buildings.h"
#include "Support/SampleGrid.h"
#include "Support/TestPaths.h"
#include "vtkAtriaFeatureGraph.h"
#include "vtkAtriaMeshOptimizer.h"
#include "vtkAtriaOctreeSource.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

namespace {

using ::testing::UnorderedElementsAre;
using ::testing::UnorderedElementsAreArray;

/// Text between grave accents and bars of a row `| a | b | c |`.
std::vector<std::string> cellsOf(const std::string& row)
{
  std::vector<std::string> cells;
  std::string cell;
  for (const char c : row.substr(1))
  {
    if (c == '|')
    {
      cells.push_back(
          cell.substr(cell.find_first_not_of(' '), cell.find_last_not_of(' ') - cell.find_first_not_of(' ') + 1));
      cell.clear();
    }
    else if (c != '`')
    {
      cell += c;
    }
  }
  return cells;
}

/// "name on type" of the tables under the heading that has this text. A row may have several names.
std::vector<std::string> documented(const std::string& heading)
{
  std::ifstream file(atria::testing::dataFolder().parent_path().parent_path() / "docs" / "arrays.md");
  std::vector<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);)
  {
    inside = line.starts_with("## ") ? line.find(heading) != std::string::npos : inside;
    if (inside && line.starts_with("| `"))
    {
      const std::vector<std::string> cells = cellsOf(line);
      std::istringstream names(cells.at(0));
      for (std::string name; std::getline(names >> std::ws, name, ',');)
      {
        rows.push_back(name + " " + cells.at(1));
      }
    }
  }
  return rows;
}

void appendArrays(vtkFieldData* data, const std::string& on, std::vector<std::string>& rows)
{
  for (int i = 0; data && i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string type = array->GetDataTypeAsString();
    rows.push_back(std::string(array->GetName()) + " " + on + " " + (type == "idtype" ? "id" : type));
  }
}

std::vector<std::string> present(vtkDataObject* data)
{
  std::vector<std::string> rows;
  appendArrays(data->GetAttributes(vtkDataObject::POINT), "points", rows);
  appendArrays(data->GetAttributes(vtkDataObject::CELL), "cells", rows);
  appendArrays(data->GetFieldData(), "field", rows);
  return rows;
}

class DocumentedArrays : public atria::testing::DualMesherTest
{
protected:
  static atria::TriangleSurface building()
  {
    atria::TriangleSurface surface;
    atria::testing::addBox(surface, "Building", {atria::Vec3(-1.7, -1.9, 0), atria::Vec3(1.1, 1.4, 2.6)});
    return surface;
  }
};

TEST_F(DocumentedArrays, OfModels)
{
  EXPECT_THAT(present(atria::testing::exampleModel("house.wrl")),
              UnorderedElementsAreArray(documented("vtkAtriaVRMLReader")));
}

TEST_F(DocumentedArrays, OfFeatures)
{
  vtkNew<vtkAtriaFeatureGraph> features;
  atria::testing::setGrid(features, domain, 0.5, 1.0, 2.0);
  features->SetInputDataObject(atria::testing::toPolyData(building()));
  features->Update();
  EXPECT_THAT(present(features->GetOutputDataObject(0)), UnorderedElementsAreArray(documented("Feature curves")));
  EXPECT_THAT(present(features->GetOutputDataObject(1)), UnorderedElementsAreArray(documented("second output")));
}

TEST_F(DocumentedArrays, OfOctrees)
{
  vtkNew<vtkAtriaOctreeSource> source;
  atria::testing::setGrid(source, domain, 0.5, 1.0, 2.0);
  source->SetInputDataObject(atria::testing::toPolyData(building()));
  source->Update();
  EXPECT_THAT(present(source->GetOutputDataObject(0)), UnorderedElementsAreArray(documented("vtkAtriaOctreeSource")));
  source->SetOutputType(vtkAtriaOctreeSource::HyperTreeGrid);
  source->Update();
  EXPECT_THAT(present(source->GetOutputDataObject(0)), UnorderedElementsAreArray(documented("vtkAtriaOctreeSource")));
}

bool isOfZones(const std::string& row)
{
  return row.starts_with("Room") || row.starts_with("Opening") || row.starts_with("FaceZone") ||
         row.starts_with("CellZone") || row.starts_with("NeighborCellId");
}

std::vector<std::string> withoutZones(std::vector<std::string> rows)
{
  std::erase_if(rows, isOfZones);
  return rows;
}

TEST_F(DocumentedArrays, OfMeshes)
{
  setSurface(building());
  mesher->Update();
  EXPECT_THAT(present(volume()), UnorderedElementsAreArray(withoutZones(documented("port 0"))));
  EXPECT_THAT(present(diagnostics()), UnorderedElementsAreArray(withoutZones(documented("port 2"))));
  for (const auto& [name, patch] : namedPatches())
  {
    EXPECT_THAT(present(patch), UnorderedElementsAreArray(withoutZones(documented("port 1")))) << name;
  }
}

TEST_F(DocumentedArrays, OfMeshesWithZones)
{
  atria::TriangleSurface surface;
  atria::testing::addWalls(surface, {-1.7, -1.9, 0}, {1.1, 1.4, 2.6}, {{{{1.0, 0.8, 2.0, 1.8}}, {}, {}, {}}});
  atria::testing::addSheet(surface, "Roof", {-1.7, -1.9, 2.6}, {2.8, 0, 0}, {0, 3.3, 0});
  atria::testing::addBox(surface, "Tree", {atria::Vec3(1.9, -1, 0.5), atria::Vec3(3.1, 1, 2.5)});
  setSurface(surface);
  mesher->SetFindOpenings(true);
  mesher->AddCellZone("Tree");
  mesher->Update();
  EXPECT_THAT(present(volume()), UnorderedElementsAreArray(documented("port 0")));
  EXPECT_THAT(present(diagnostics()), UnorderedElementsAreArray(documented("port 2")));
  EXPECT_THAT(present(namedPatches().at("South_opening_1")),
              UnorderedElementsAre("SurfaceId cells int", "OwnerCellId cells id", "NeighborCellId cells id",
                                   "VolumePointId points id"));
}

TEST_F(DocumentedArrays, OfPieces)
{
  setSurface(building());
  mesher->Update();
  const auto added = [](vtkDataObject* piece, vtkDataObject* whole) {
    std::vector<std::string> rows = present(piece);
    for (const std::string& row : present(whole))
    {
      std::erase(rows, row);
    }
    return rows;
  };
  atria::MeshShares shares(volume(), std::vector<atria::Index>(volume()->GetNumberOfCells(), 0), 1, 1);
  EXPECT_THAT(added(shares.mesh(0), volume()), UnorderedElementsAreArray(documented("Pieces of a mesh")));
  const auto pieces = shares.patches(patches(), 0);
  EXPECT_THAT(added(pieces->GetPartitionAsDataObject(0, 0), patches()->GetPartitionAsDataObject(0, 0)),
              UnorderedElementsAre("GlobalCellIds cells id", "GlobalPointIds points id"));
}

TEST_F(DocumentedArrays, OfImprovedMeshes)
{
  vtkNew<vtkAtriaMeshOptimizer> optimizer;
  optimizer->SetInputData(atria::testing::toGrid(atria::testing::mixedCells({3, 3, 3}, 2, 0.5)));
  optimizer->Update();
  EXPECT_THAT(present(optimizer->GetOutput()), UnorderedElementsAreArray(documented("vtkAtriaMeshOptimizer")));
}

} // namespace
