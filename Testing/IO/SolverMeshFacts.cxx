// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolverMeshFacts.h"

#include "Quality/Faces/Geometry.h"
#include "Support/QuietContext.h"
#include "VtkFaceMesh.h"

#include <vtkCompositeDataSet.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <set>
#include <sstream>

namespace atria::testing {

namespace {

double areaOf(std::span<const Vec3> points)
{
  std::vector<Index> loop(points.size());
  std::iota(loop.begin(), loop.end(), Index{0});
  return measurePolygon(points, loop).area.norm();
}

double volumeOf(const FaceMesh& mesh)
{
  const MeasuredMesh measured = measureMesh(mesh, quietContext());
  double sum = 0.0;
  double sizes = 0.0;
  for (const double volume : measured.geometry.cellVolumes)
  {
    sum += volume;
    sizes += std::abs(volume);
  }
  EXPECT_NEAR(std::abs(sum), sizes, 1e-12 * sizes) << "cells are turned in different ways";
  return sum;
}

/// All cells of a dataset as one patch.
PatchFacts patchOf(vtkDataSet* data)
{
  PatchFacts facts;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    data->GetCellPoints(i, ids);
    std::vector<Vec3> points;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      points.emplace_back(data->GetPoint(ids->GetId(k)));
    }
    ++facts.faces;
    facts.area += areaOf(points);
  }
  return facts;
}

bool isVolume(vtkDataSet* data) { return data->GetNumberOfCells() > 0 && data->GetCell(0)->GetCellDimension() == 3; }

/// Lines without comments.
std::istringstream linesOf(const std::string& file)
{
  std::ifstream in(file);
  std::string text;
  for (std::string line; std::getline(in, line);)
  {
    text += line.starts_with('%') ? "" : line + '\n';
  }
  return std::istringstream(text);
}

std::size_t countAfter(std::istringstream& in, const std::string& keyword)
{
  std::string word;
  std::size_t count = 0;
  in >> word >> count;
  EXPECT_EQ(word, keyword + "=");
  return count;
}

std::size_t cornersOf(int type)
{
  const std::map<int, std::size_t> corners{{5, 3}, {9, 4}, {10, 4}, {12, 8}, {13, 6}, {14, 5}};
  const auto found = corners.find(type);
  EXPECT_NE(found, corners.end()) << "type " << type;
  return found == corners.end() ? 0 : found->second;
}

std::vector<std::int64_t> readElement(std::istringstream& in, int& type)
{
  in >> type;
  std::vector<std::int64_t> ids(cornersOf(type));
  for (std::int64_t& id : ids)
  {
    in >> id;
  }
  return ids;
}

} // namespace

MeshFacts factsOf(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches)
{
  MeshFacts facts;
  const VtkFaceMesh source = faceMeshFromVtk(volume, patches);
  facts.cells = source.mesh.cellCount;
  facts.volume = volumeOf(source.mesh);
  for (unsigned i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
  {
    facts.patches[patches->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())] =
        patchOf(patches->GetPartitionedDataSet(i)->GetPartition(0));
  }
  return facts;
}

MeshFacts factsOf(vtkMultiBlockDataSet* data)
{
  MeshFacts facts;
  for (unsigned i = 0; i < data->GetNumberOfBlocks(); ++i)
  {
    if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(data->GetBlock(i)))
    {
      MeshFacts more = factsOf(inner);
      facts.cells += more.cells;
      facts.volume += more.volume;
      facts.patches.merge(more.patches);
    }
    else if (auto* leaf = vtkDataSet::SafeDownCast(data->GetBlock(i)))
    {
      auto* grid = vtkUnstructuredGrid::SafeDownCast(leaf);
      if (grid && isVolume(grid))
      {
        const FaceMesh mesh = faceMeshFromVtk(grid, nullptr).mesh;
        facts.cells += mesh.cellCount;
        facts.volume += volumeOf(mesh);
      }
      else
      {
        facts.patches[data->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())] = patchOf(leaf);
      }
    }
  }
  return facts;
}

MeshFacts factsOfSU2(const std::string& file)
{
  std::istringstream in = linesOf(file);
  EXPECT_EQ(countAfter(in, "NDIME"), 3u);
  SampleMesh mesh;
  const std::size_t cells = countAfter(in, "NELEM");
  for (std::size_t i = 0; i < cells; ++i)
  {
    int type = 0;
    const std::vector<std::int64_t> ids = readElement(in, type);
    std::size_t number = 0;
    in >> number;
    EXPECT_EQ(number, i);
    mesh.addCell(static_cast<unsigned char>(type), ids);
  }
  mesh.points.resize(countAfter(in, "NPOIN"));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    std::size_t number = 0;
    in >> mesh.points[i][0] >> mesh.points[i][1] >> mesh.points[i][2] >> number;
    EXPECT_EQ(number, i);
  }
  // Faces of the markers are on the boundary even where others have their points.
  std::vector<std::vector<std::int64_t>> faces;
  std::set<std::vector<std::int64_t>> sorted;
  MeshFacts facts;
  const std::size_t markers = countAfter(in, "NMARK");
  for (std::size_t m = 0; m < markers; ++m)
  {
    std::string keyword;
    std::string name;
    in >> keyword >> name;
    EXPECT_EQ(keyword, "MARKER_TAG=");
    EXPECT_EQ(facts.patches.count(name), 0u) << name;
    PatchFacts& patch = facts.patches[name];
    patch.faces = countAfter(in, "MARKER_ELEMS");
    for (std::size_t i = 0; i < patch.faces; ++i)
    {
      int type = 0;
      std::vector<std::int64_t> ids = readElement(in, type);
      std::vector<Vec3> points;
      std::ranges::transform(ids, std::back_inserter(points), [&](std::int64_t id) { return mesh.points[id]; });
      patch.area += areaOf(points);
      std::ranges::sort(ids);
      EXPECT_TRUE(sorted.insert(ids).second) << "a face of " << name << " is there twice";
    }
  }
  EXPECT_TRUE(static_cast<bool>(in));
  // Throws where three cells share a face.
  const FaceMesh all = makeFaceMesh(mesh.points, mesh.view());
  EXPECT_EQ(all.faceCount() - all.internalFaceCount(), sorted.size());
  for (std::size_t f = all.internalFaceCount(); f < all.faceCount(); ++f)
  {
    std::vector<std::int64_t> ids(all.face(f).begin(), all.face(f).end());
    std::ranges::sort(ids);
    EXPECT_EQ(sorted.count(ids), 1u);
  }
  facts.cells = cells;
  facts.volume = volumeOf(all);
  return facts;
}

void expectSameFacts(const MeshFacts& found, const MeshFacts& expected, double tolerance, bool faces)
{
  EXPECT_NEAR(found.volume, expected.volume, tolerance * expected.volume);
  EXPECT_EQ(found.patches.size(), expected.patches.size());
  for (const auto& [name, patch] : expected.patches)
  {
    const auto its = found.patches.find(name);
    ASSERT_NE(its, found.patches.end()) << name;
    EXPECT_NEAR(its->second.area, patch.area, tolerance * patch.area) << name;
    if (faces)
    {
      EXPECT_EQ(its->second.faces, patch.faces) << name;
    }
  }
  if (faces)
  {
    EXPECT_EQ(found.cells, expected.cells);
  }
}

} // namespace atria::testing
