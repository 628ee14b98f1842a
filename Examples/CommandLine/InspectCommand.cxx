// SPDX-License-Identifier: GPL-3.0-or-later
/// atria inspect: what a model holds, surface by surface, and its features.
#include "Commands.h"
#include "Console.h"
#include "Files.h"
#include "Report.h"

#include <Surface/Inspection.h>

#include <vtkAtriaFeatureGraph.h>
#include <vtkAtriaVRMLReader.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>

namespace atria::tool {

namespace {

struct InspectOptions
{
  std::string file;
  ModelOptions model;
  std::string features;
  bool json = false;
};

/// The reader's output, which is triangles only.
TriangleSurface trianglesOf(vtkPolyData* model)
{
  TriangleSurface surface;
  auto* names = vtkStringArray::SafeDownCast(model->GetFieldData()->GetAbstractArray("SurfaceName"));
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    surface.names.push_back(names->GetValue(i));
  }
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    surface.points.emplace_back(model->GetPoint(i));
  }
  vtkDataArray* ids = model->GetCellData()->GetArray("SurfaceId");
  auto cells = vtk::TakeSmartPointer(model->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    cells->GetCurrentCell(count, points);
    surface.triangles.push_back(
        {static_cast<Index>(points[0]), static_cast<Index>(points[1]), static_cast<Index>(points[2])});
    surface.surfaceIds.push_back(static_cast<Index>(ids->GetTuple1(cells->GetCurrentCellId())));
  }
  return surface;
}

Json jsonOf(const SurfaceSummary& summary)
{
  Json bounds; // null for a surface without triangles
  if (!summary.bounds.empty())
  {
    const Vec3& low = summary.bounds.min;
    const Vec3& high = summary.bounds.max;
    bounds = {low.x(), high.x(), low.y(), high.y(), low.z(), high.z()};
  }
  return {{"name", summary.name},
          {"triangles", summary.triangles},
          {"degenerate", summary.degenerate},
          {"area", summary.area},
          {"bounds", bounds},
          {"open_edges", summary.openEdges},
          {"non_manifold_edges", summary.nonManifoldEdges}};
}

Json jsonOf(vtkStringArray* texts)
{
  Json list = Json::array();
  for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
  {
    list.push_back(texts->GetValue(i));
  }
  return list;
}

Json jsonOf(const Inspection& inspection, vtkAtriaVRMLReader* reader)
{
  Json report;
  report["surfaces"] = Json::array();
  for (const SurfaceSummary& summary : inspection.surfaces)
  {
    report["surfaces"].push_back(jsonOf(summary));
  }
  report["total"] = jsonOf(inspection.total);
  report["total"].erase("name");
  report["total"]["points"] = inspection.points;
  report["warnings"] = jsonOf(reader->GetWarnings());
  report["notes"] = jsonOf(reader->GetNotes());
  report["merged_faces"] = reader->GetNumberOfMergedFaces();
  return report;
}

void printLine(const SurfaceSummary& summary, const std::string& name, int width)
{
  std::printf("%-*s %10zu %14.6g %8zu %8zu", width, name.c_str(), summary.triangles, summary.area, summary.openEdges,
              summary.nonManifoldEdges);
  for (int axis = 0; axis < 3 && !summary.bounds.empty(); ++axis)
  {
    std::printf("  %g..%g", summary.bounds.min[axis], summary.bounds.max[axis]);
  }
  std::printf("\n");
}

void printTable(const Inspection& inspection)
{
  std::size_t longest = 5;
  for (const SurfaceSummary& summary : inspection.surfaces)
  {
    longest = std::max(longest, std::min<std::size_t>(summary.name.size(), 48));
  }
  const int width = static_cast<int>(longest);
  std::printf("%-*s %10s %14s %8s %8s  %s\n", width, "name", "triangles", "area", "open", "non-man.", "bounds x, y, z");
  for (const SurfaceSummary& summary : inspection.surfaces)
  {
    printLine(summary, summary.name, width);
  }
  printLine(inspection.total, "total", width);
  std::printf("open, non-man.: edges that one triangle uses, or three and more; the total sees all surfaces "
              "together\n");
}

/// The curves of the whole model: a domain some way off it cuts none.
void writeFeatures(const std::string& file, vtkAtriaVRMLReader* reader, Console& console)
{
  vtkNew<vtkAtriaFeatureGraph> features;
  features->SetInputConnection(reader->GetOutputPort());
  std::array<double, 6> bounds;
  reader->GetOutput()->GetBounds(bounds.data());
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] -= features->GetSizeMax();
    bounds[2 * axis + 1] += features->GetSizeMax();
  }
  features->SetDomainMode(vtkAtriaFeatureGraph::Explicit);
  features->SetDomainBounds(bounds.data());
  console.follow(features, 0.05, 0.9);
  updateOrFail(features, file, console);
  writePolyData(file, vtkPolyData::SafeDownCast(features->GetOutputDataObject(0)), console);
}

ExitStatus runInspect(const InspectOptions& options, Console& console)
{
  if (!options.features.empty())
  {
    checkOutput("--features", options.features, ".vtp");
  }
  const auto reader = readModel(options.file, options.model, console);
  if (!options.features.empty())
  {
    writeFeatures(options.features, reader, console);
  }
  const Inspection inspection = inspect(trianglesOf(reader->GetOutput()));
  console.clearBar();
  if (options.json)
  {
    std::cout << jsonOf(inspection, reader).dump(2) << '\n';
  }
  else
  {
    printTable(inspection);
  }
  return Done;
}

} // namespace

void addInspectCommand(CLI::App& app, Console& console, ExitStatus& status)
{
  CLI::App* command = app.add_subcommand("inspect", "List the surfaces of a model by name");
  auto options = std::make_shared<InspectOptions>();
  command->add_option("IN.wrl", options->file, "VRML model (.wrl, .wrz, .wrl.gz)")->required();
  declareModelOptions(*command, options->model);
  command
      ->add_option("--features", options->features,
                   "Also write the curves and corners that a mesh is to keep: rims, creases, junctions, borders")
      ->type_name("OUT.vtp");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &console, &status] { status = runInspect(*options, console); });
}

} // namespace atria::tool
