// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/SampleGrid.h"
#include "Support/VtkErrorGuard.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaWorstElements.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace {

using atria::Vec3;
using atria::testing::SampleMesh;
using atria::testing::toGrid;
using ::testing::HasSubstr;

double valueOf(vtkUnstructuredGrid* grid, const char* array, vtkIdType cell)
{
  return grid->GetCellData()->GetArray(array)->GetComponent(cell, 0);
}

std::set<vtkIdType> pointsOf(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  return {ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds()};
}

class WorstElements : public atria::testing::VtkTest
{
protected:
  /// Of all cell types, with its quality.
  WorstElements()
  {
    measure->SetInputData(toGrid(atria::testing::mixedCells({5, 5, 5}, 7, 0.35)));
    measure->Update();
    mesh = measure->GetOutput();
    vtkNew<vtkStringArray> name;
    name->SetName("Project");
    name->InsertNextValue("school");
    mesh->GetFieldData()->AddArray(name);
    vtkNew<vtkDoubleArray> heights;
    heights->SetName("Height");
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      heights->InsertNextValue(mesh->GetPoint(i)[2]);
    }
    mesh->GetPointData()->AddArray(heights);
    filter->SetInputData(mesh);
  }

  vtkUnstructuredGrid* run()
  {
    filter->Update();
    return filter->GetOutput();
  }

  std::vector<vtkIdType> originals()
  {
    std::vector<vtkIdType> ids;
    for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfCells(); ++i)
    {
      ids.push_back(static_cast<vtkIdType>(valueOf(filter->GetOutput(), "vtkOriginalCellIds", i)));
    }
    return ids;
  }

  vtkNew<vtkAtriaMeshQuality> measure;
  vtkNew<vtkAtriaWorstElements> filter;
  vtkUnstructuredGrid* mesh;
};

TEST_F(WorstElements, ComeWorstFirst)
{
  for (const auto& [metric, greatest] :
       {std::pair("CellSquish", true), std::pair("OrthogonalQuality", false), std::pair("Volume", false)})
  {
    filter->SetMetricName(metric);
    vtkUnstructuredGrid* worst = run();
    std::vector<double> all;
    for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
    {
      all.push_back(greatest ? -valueOf(mesh, metric, i) : valueOf(mesh, metric, i));
    }
    std::sort(all.begin(), all.end());
    for (int i = 0; i < filter->GetNumberOfElements(); ++i)
    {
      EXPECT_EQ(valueOf(worst, metric, i), greatest ? -all[i] : all[i]) << metric << ' ' << i;
      EXPECT_EQ(valueOf(worst, "WorstRank", i), i + 1);
      EXPECT_EQ(valueOf(worst, "Ring", i), 0);
    }
    ASSERT_GT(worst->GetNumberOfCells(), 10);
    EXPECT_EQ(valueOf(worst, "WorstRank", 10), 0);
  }
}

TEST_F(WorstElements, AreTheCellsOfTheInputWithAllTheirData)
{
  filter->SetRings(2);
  vtkUnstructuredGrid* worst = run();
  std::set<int> types;
  std::set<vtkIdType> seen;
  for (vtkIdType cell = 0; cell < worst->GetNumberOfCells(); ++cell)
  {
    const vtkIdType original = originals()[static_cast<std::size_t>(cell)];
    EXPECT_TRUE(seen.insert(original).second);
    types.insert(worst->GetCellType(cell));
    ASSERT_EQ(worst->GetCellType(cell), mesh->GetCellType(original));
    ASSERT_EQ(worst->GetCell(cell)->GetNumberOfFaces(), mesh->GetCell(original)->GetNumberOfFaces());
    EXPECT_EQ(valueOf(worst, "Skewness", cell), valueOf(mesh, "Skewness", original));
    std::set<vtkIdType> points;
    for (const vtkIdType point : pointsOf(worst, cell))
    {
      const auto there =
          static_cast<vtkIdType>(worst->GetPointData()->GetArray("vtkOriginalPointIds")->GetTuple1(point));
      points.insert(there);
      EXPECT_EQ(Vec3(worst->GetPoint(point)), Vec3(mesh->GetPoint(there)));
      EXPECT_EQ(worst->GetPointData()->GetArray("Height")->GetTuple1(point), mesh->GetPoint(there)[2]);
    }
    EXPECT_EQ(points, pointsOf(mesh, original));
  }
  EXPECT_GE(types.size(), 5u);
  EXPECT_EQ(types.count(VTK_POLYHEDRON), 1u);
  EXPECT_NE(worst->GetFieldData()->GetAbstractArray("Project"), nullptr);
  // The same figures come out when what was cut out is measured anew, where they are a cell's own.
  vtkNew<vtkAtriaMeshQuality> again;
  again->SetInputData(worst);
  again->Update();
  for (vtkIdType cell = 0; cell < worst->GetNumberOfCells(); ++cell)
  {
    EXPECT_NEAR(valueOf(again->GetOutput(), "CellSquish", cell), valueOf(worst, "CellSquish", cell), 1e-12);
  }
}

TEST_F(WorstElements, RingsAreThoseThatSharePointsWithTheRingBefore)
{
  filter->SetNumberOfElements(2);
  filter->SetRings(2);
  vtkUnstructuredGrid* worst = run();
  std::set<vtkIdType> points;
  std::set<vtkIdType> taken;
  for (int ring = 0; ring <= 2; ++ring)
  {
    std::set<vtkIdType> wanted;
    for (vtkIdType cell = 0; ring > 0 && cell < mesh->GetNumberOfCells(); ++cell)
    {
      const auto own = pointsOf(mesh, cell);
      const bool touches = std::any_of(own.begin(), own.end(), [&](vtkIdType p) { return points.count(p) > 0; });
      if (touches && taken.count(cell) == 0)
      {
        wanted.insert(cell);
      }
    }
    std::set<vtkIdType> found;
    for (vtkIdType cell = 0; cell < worst->GetNumberOfCells(); ++cell)
    {
      if (valueOf(worst, "Ring", cell) == ring)
      {
        found.insert(originals()[static_cast<std::size_t>(cell)]);
      }
    }
    EXPECT_TRUE(ring == 0 ? found.size() == 2 : found == wanted) << "ring " << ring;
    for (const vtkIdType cell : found)
    {
      taken.insert(cell);
      points.merge(pointsOf(mesh, cell));
    }
  }
}

TEST_F(WorstElements, BeyondALimitAreAllThatAre)
{
  filter->SetMetricName("NonOrthogonality");
  filter->SetRings(0);
  filter->UseLimitOn();
  for (const double limit : {10.0, 20.0, 1000.0})
  {
    filter->SetLimit(limit);
    vtkIdType wanted = 0;
    for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
    {
      wanted += valueOf(mesh, "NonOrthogonality", i) > limit ? 1 : 0;
    }
    EXPECT_EQ(run()->GetNumberOfCells(), wanted);
    EXPECT_EQ(wanted == 0, limit == 1000.0);
  }
}

TEST_F(WorstElements, OrderAndMissingNumbers)
{
  vtkNew<vtkDoubleArray> own;
  own->SetName("Own");
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    own->InsertNextValue(i == 3 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(i));
  }
  mesh->GetCellData()->AddArray(own);
  filter->SetMetricName("Own");
  filter->SetNumberOfElements(4);
  filter->SetRings(0);
  const vtkIdType last = mesh->GetNumberOfCells() - 1;
  run();
  EXPECT_EQ(originals(), (std::vector<vtkIdType>{last, last - 1, last - 2, last - 3}));
  filter->SetOrder(vtkAtriaWorstElements::SmallestFirst);
  run();
  EXPECT_EQ(originals(), (std::vector<vtkIdType>{0, 1, 2, 4}));
}

TEST_F(WorstElements, PropertiesOutsideOfTheirRangeAreErrors)
{
  filter->SetRings(-1);
  run();
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("Rings is -1; it must be a number from 0 to 100")));
  filter->SetRings(0);
  filter->SetNumberOfElements(0);
  run();
  EXPECT_THAT(messages.takeErrors(),
              ::testing::Contains(HasSubstr("NumberOfElements is 0; it must be a number of at least 1")));
  filter->SetNumberOfElements(1);
  run();
}

TEST_F(WorstElements, PropertiesArePrinted)
{
  std::ostringstream text;
  filter->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("MetricName: CellSquish"));
}

TEST_F(WorstElements, ErrorNamesTheArraysThereAre)
{
  filter->SetMetricName("Beauty");
  run();
  EXPECT_THAT(messages.takeErrors(),
              ::testing::Contains(::testing::AllOf(HasSubstr("'Beauty'"), HasSubstr("CellSquish"))));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->SetInputData(vtkNew<vtkUnstructuredGrid>());
  run();
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("no cells")));
}

} // namespace
