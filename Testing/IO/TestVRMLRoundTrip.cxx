// SPDX-License-Identifier: GPL-3.0-or-later
/// What VTK's VRML exporter writes comes back.
#include "ModelSamples.h"
#include "VRMLModel.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkStripper.h>
#include <vtkTriangleFilter.h>
#include <vtkVRMLExporter.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

namespace {

using atria::Vec3;
using atria::testing::SampleModel;
using atria::testing::VRMLModel;

vtkNew<vtkPolyData> polyDataOf(const SampleModel& model, const SampleModel::Surface& surface)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : model.points)
  {
    points->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& face : surface.faces)
  {
    const std::vector<vtkIdType> ids(face.begin(), face.end());
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

class VRMLRoundTrip : public atria::testing::VtkTest
{
protected:
  vtkActor* addActor(vtkAlgorithmOutput* output, vtkPolyData* data)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    output ? mapper->SetInputConnection(output) : mapper->SetInputData(data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
    return actor;
  }

  VRMLModel written()
  {
    vtkNew<vtkGenericOpenGLRenderWindow> window;
    window->AddRenderer(renderer);
    vtkNew<vtkVRMLExporter> exporter;
    exporter->SetRenderWindow(window);
    const auto file = scratch.path() / "exported.wrl";
    exporter->SetFileName(file.c_str());
    exporter->Write();
    return VRMLModel(file);
  }

  const SampleModel house = atria::testing::sampleHouse();
  atria::testing::ScratchFolder scratch;
  vtkNew<vtkRenderer> renderer;
};

TEST_F(VRMLRoundTrip, KeepsEachActorAsASurface)
{
  for (const SampleModel::Surface& surface : house.surfaces)
  {
    addActor(nullptr, polyDataOf(house, surface));
  }
  const VRMLModel model = written();
  const std::vector<std::string> names = model.names();
  ASSERT_EQ(names.size(), house.surfaces.size());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    double area = 0.0;
    for (const auto& t : trianglesOf(house, house.surfaces[i]))
    {
      area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    }
    EXPECT_NEAR(model.area(names[i]), area, 1e-12) << house.surfaces[i].name;
  }
  EXPECT_NEAR(model.volume(), 8 * 6 * 5, 1e-10);
  EXPECT_EQ(model.bounds(), (std::vector<double>{0, 8, 0, 6, 0, 6}));
  EXPECT_EQ(atria::testing::joined(model.warnings()), "");
}

TEST_F(VRMLRoundTrip, KeepsTransformsOfActors)
{
  SampleModel::Surface all{"House", "", {}};
  for (const SampleModel::Surface& surface : house.surfaces)
  {
    all.faces.insert(all.faces.end(), surface.faces.begin(), surface.faces.end());
  }
  double area = 0.0;
  for (const auto& t : trianglesOf(house, all))
  {
    area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  }
  vtkActor* actor = addActor(nullptr, polyDataOf(house, all));
  actor->SetPosition(4'500'000.5, -20.0, 3.0);
  actor->SetScale(2.0);
  actor->RotateZ(90.0);
  actor->GetProperty()->SetDiffuseColor(0.25, 0.5, 1.0);
  actor->GetProperty()->SetOpacity(0.5);
  const VRMLModel model = written();
  messages.takeWarnings(); // that it is far off
  EXPECT_NEAR(model.area(), 4 * area, 1e-6);
  const std::vector<double> expected{4'499'988.5, 4'500'000.5, -20, -4, 3, 15};
  const std::vector<double> bounds = model.bounds();
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-8);
  }
}

TEST_F(VRMLRoundTrip, KeepsTriangleStripsAndCountsLines)
{
  SampleModel::Surface roof = house.surfaces[4];
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(polyDataOf(house, roof));
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(triangles->GetOutputPort());
  strips->Update();
  ASSERT_GT(strips->GetOutput()->GetNumberOfStrips(), 0);
  addActor(strips->GetOutputPort(), nullptr);
  vtkNew<vtkPolyData> outline;
  outline->SetPoints(strips->GetOutput()->GetPoints());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({0, 1});
  outline->SetLines(lines);
  addActor(nullptr, outline);
  const VRMLModel model = written();
  EXPECT_EQ(model.triangles(), 4);
  EXPECT_NEAR(model.area(), 2 * 8 * std::sqrt(13.0), 1e-10);
  EXPECT_EQ(model.names().size(), 1u);
  EXPECT_THAT(model.skipped(), ::testing::Contains("IndexedLineSet: 1"));
}

} // namespace
