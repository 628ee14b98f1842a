// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshOutput.h"
#include "Support/Shapes.h"
#include "Support/VtkErrorGuard.h"
#include "SurfaceInput.h"
#include "vtkAtriaFeatureGraph.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace {

using atria::Box3;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::toPolyData;
using ::testing::HasSubstr;

enum Kind
{
  boundaryEdge,
  crease,
  junction,
  border,
  corner
};

class FeatureGraph : public atria::testing::VtkTest
{
protected:
  FeatureGraph() { atria::testing::setGrid(filter, {Vec3(-10, -10, -10), Vec3(10, 10, 10)}, 0.5, 1.0, 2.0); }

  void update(const TriangleSurface& surface)
  {
    filter->SetInputDataObject(toPolyData(surface));
    filter->Update();
  }
  vtkPolyData* curves() { return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)); }
  vtkPolyData* model() { return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(1)); }
  int value(const char* array, vtkIdType cell, int component = 0)
  {
    return static_cast<int>(curves()->GetCellData()->GetArray(array)->GetComponent(cell, component));
  }
  std::string surfaces(vtkIdType cell)
  {
    return vtkStringArray::SafeDownCast(curves()->GetCellData()->GetAbstractArray("Surfaces"))->GetValue(cell);
  }

  /// Length by kind; corners by their number.
  std::map<int, double> amounts()
  {
    std::map<int, double> out;
    for (vtkIdType cell = 0; cell < curves()->GetNumberOfCells(); ++cell)
    {
      const int kind = value("CurveKind", cell);
      double amount = 1.0;
      if (kind != corner)
      {
        Vec3 a, b;
        curves()->GetPoint(curves()->GetCell(cell)->GetPointId(0), a.data());
        curves()->GetPoint(curves()->GetCell(cell)->GetPointId(1), b.data());
        amount = (b - a).norm();
      }
      out[kind] += amount;
    }
    return out;
  }

  std::set<int> curvesOf(int kind)
  {
    std::set<int> out;
    for (vtkIdType cell = 0; cell < curves()->GetNumberOfCells(); ++cell)
    {
      if (value("CurveKind", cell) == kind)
      {
        out.insert(value("CurveId", cell));
      }
    }
    return out;
  }

  vtkNew<vtkAtriaFeatureGraph> filter;
};

TEST_F(FeatureGraph, OfABoxHasItsEdgesAndCorners)
{
  TriangleSurface surface;
  addBox(surface, "Box", {Vec3(-3, -2, 1), Vec3(1, 2, 6)});
  update(surface);
  const auto found = amounts();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found.at(crease), 4.0 * (4.0 + 4.0 + 5.0), 1e-6);
  EXPECT_EQ(found.at(corner), 8.0);
  EXPECT_EQ(curvesOf(crease).size(), 12u);
  EXPECT_EQ(curves()->GetNumberOfVerts(), 8);
  for (vtkIdType cell = 0; cell < curves()->GetNumberOfCells(); ++cell)
  {
    EXPECT_EQ(value("EdgeCount", cell), cell < 8 ? 3 : 1);
    EXPECT_EQ(surfaces(cell), "Box");
    EXPECT_EQ(value("CurveId", cell) < 0, cell < 8);
    EXPECT_EQ(value("ChartId", cell, 0) == value("ChartId", cell, 1), cell < 8);
  }
  EXPECT_EQ(model()->GetNumberOfCells(), 12);
  EXPECT_EQ(model()->GetNumberOfPoints(), 8);
  EXPECT_EQ(model()->GetCellData()->GetArray("ChartId")->GetRange()[1], 5.0) << "six faces";
}

TEST_F(FeatureGraph, TellsBoundaryEdgesJunctionsAndBordersAndWhatMeetsThere)
{
  TriangleSurface surface;
  addSheet(surface, "West", {-4, 0, 0}, {4, 0, 0}, {0, 3, 0});
  addSheet(surface, "East", {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  update(surface);
  auto found = amounts();
  EXPECT_NEAR(found[boundaryEdge], 22.0, 1e-6);
  EXPECT_NEAR(found[border], 3.0, 1e-6);
  EXPECT_EQ(found[corner], 6.0);
  addSheet(surface, "Up", {0, 0, 0}, {0, 3, 0}, {0, 0, 2});
  update(surface);
  found = amounts();
  EXPECT_NEAR(found[boundaryEdge], 29.0, 1e-6);
  EXPECT_NEAR(found[junction], 3.0, 1e-6);
  EXPECT_EQ(found.count(border), 0u);
  for (vtkIdType cell = 0; cell < curves()->GetNumberOfCells(); ++cell)
  {
    if (value("CurveKind", cell) == junction)
    {
      EXPECT_EQ(surfaces(cell), "West + East + Up");
    }
  }
}

TEST_F(FeatureGraph, CurvesRunOnThroughPointsThatAreNoCorners)
{
  // The boundary edge of a disc of 24 triangles turns by 15 degrees at each point: one curve; by 60 in six: corners.
  for (const int count : {24, 6})
  {
    std::vector<Vec3> points{Vec3::Zero()};
    std::vector<std::array<atria::Index, 3>> triangles;
    for (int i = 0; i < count; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * i / count;
      points.emplace_back(4.0 * std::cos(angle), 4.0 * std::sin(angle), 0.0);
      triangles.push_back({0, static_cast<atria::Index>(1 + i), static_cast<atria::Index>(1 + (i + 1) % count)});
    }
    TriangleSurface surface;
    atria::testing::addSurface(surface, "Disc", points, triangles);
    update(surface);
    EXPECT_EQ(curves()->GetNumberOfLines(), count);
    EXPECT_EQ(curves()->GetNumberOfVerts(), count == 24 ? 0 : 6);
    EXPECT_EQ(curvesOf(boundaryEdge).size(), count == 24 ? 1u : 6u);
  }
}

TEST_F(FeatureGraph, FollowsTheFeatureAngle)
{
  TriangleSurface surface;
  addBox(surface, "Box", {Vec3(-3, -2, 1), Vec3(1, 2, 6)});
  filter->SetFeatureAngle(100.0);
  update(surface);
  EXPECT_EQ(curves()->GetNumberOfCells(), 0);
  EXPECT_EQ(model()->GetNumberOfCells(), 12);
  filter->SetFeatureAngle(30.0);
  filter->Update();
  EXPECT_EQ(curves()->GetNumberOfLines(), 12);
}

TEST_F(FeatureGraph, LeavesOutTheEdgesOfTheDomain)
{
  TriangleSurface surface;
  addBox(surface, "Box", {Vec3(-3, -2, 1), Vec3(1, 2, 6)});
  filter->SetDomainMode(vtkAtriaFeatureGraph::FromSurfaces);
  update(surface);
  EXPECT_EQ(curves()->GetNumberOfCells(), 0);
  EXPECT_EQ(model()->GetNumberOfCells(), 12);
}

TEST_F(FeatureGraph, TakesNamedBlocks)
{
  TriangleSurface surface;
  addSheet(surface, "West", {-4, 0, 0}, {4, 0, 0}, {0, 3, 0});
  addSheet(surface, "East", {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  filter->SetInputDataObject(atria::testing::toBlocks(surface));
  filter->Update();
  EXPECT_NEAR(amounts()[border], 3.0, 1e-6);
  EXPECT_THAT(atria::testing::fieldStrings(model(), "SurfaceName"), ::testing::ElementsAre("West", "East"));
}

TEST_F(FeatureGraph, OfTheBuildingHasItsOpeningsAndBoundaryEdges)
{
  filter->SetInputDataObject(atria::testing::exampleModel("building.wrl"));
  filter->SetDomainMode(vtkAtriaFeatureGraph::Site);
  filter->Update();
  const auto found = amounts();
  // What is free: 14 windows of 7 m, and more.
  EXPECT_GT(found.at(boundaryEdge), 14.0 * 7.0);
  EXPECT_GT(found.at(junction), 4.0 * 39.3);
}

TEST_F(FeatureGraph, WithoutItsSiteIsAnError)
{
  TriangleSurface surface;
  addBox(surface, "Box", {Vec3(-3, -2, 1), Vec3(1, 2, 6)});
  filter->SetDomainMode(vtkAtriaFeatureGraph::Site);
  filter->SetSiteName("Lawn");
  update(surface);
  EXPECT_THAT(atria::testing::firstOf(messages.takeErrors()), HasSubstr("Lawn"));
  EXPECT_EQ(curves()->GetNumberOfCells(), 0);
  EXPECT_EQ(model()->GetNumberOfCells(), 0);
}

} // namespace
