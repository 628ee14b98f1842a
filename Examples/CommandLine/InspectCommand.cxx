// SPDX-License-Identifier: GPL-3.0-or-later
/// atria inspect: lists the content of a model, surface by surface, and its features.
#include "Commands.h"
#include "Console.h"
#include "Files.h"
#include "InputFiles.h"
#include "Numbers.h"
#include "OutputFiles.h"
#include "Report.h"
#include "Words.h"

#include <Mesher/ModelRepair.h>
#include <Surface/Inspection/Inspection.h>
#include <Surface/Inspection/Problems.h>

#include <vtkAtriaDualMesher.h>
#include <vtkAtriaFeatureGraph.h>
#include <vtkAtriaSurfaceReader.h>
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
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace atria::tool {

namespace {

struct InspectOptions
{
  std::string file;
  ModelOptions model;
  std::string features;
  double gap = ProblemOptions{}.gapTolerance;
  double atSize = 0.0;
  bool json = false;
  bool noProblems = false;
  bool openings = false;
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

Json messagesOf(vtkStringArray* texts)
{
  Json list = Json::array();
  for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
  {
    list.push_back(inOptions(texts->GetValue(i)));
  }
  return list;
}

Json jsonOf(const std::vector<Problem>& problems, const TriangleSurface& surface)
{
  Json list = Json::array();
  for (const Problem& problem : problems)
  {
    Json names = Json::array();
    for (const Index id : problem.surfaces)
    {
      names.push_back(surface.names[id]);
    }
    list.push_back({{"kind", problemNames[static_cast<int>(problem.kind)]},
                    {"count", problem.count},
                    {"size", problem.size},
                    {"place", {problem.place.x(), problem.place.y(), problem.place.z()}},
                    {"surfaces", names}});
  }
  return list;
}

Json jsonOf(const Inspection& inspection, vtkAtriaSurfaceReader* reader)
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
  report["warnings"] = messagesOf(reader->GetWarnings());
  report["notes"] = messagesOf(reader->GetNotes());
  report["skipped"] = jsonOf(reader->GetSkippedNodes());
  report["merged_faces"] = reader->GetNumberOfMergedFaces();
  return report;
}

/// Returns the number of digits that distinguish places in a model, however far from the origin it lies.
int digitsOf(const Box3& box)
{
  constexpr int near = 6;
  const double size = box.empty() ? 0.0 : box.size().maxCoeff();
  const double distance = box.empty() ? 0.0 : std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  return size > 0.0 ? std::min(near + static_cast<int>(std::log10(distance / size)), 15) : near;
}

/// Returns a coordinate in that many digits. Values negligible beside the size of the model are zero.
std::string coordinate(double value, int digits, double size)
{
  constexpr double nothing = 1e-9;
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.*g", digits, std::abs(value) < nothing * size ? 0.0 : value);
  return text.data();
}

void printLine(const SurfaceSummary& summary, const std::string& name, int width, int digits)
{
  std::array<char, 32> area{"not finite"};
  if (std::isfinite(summary.area))
  {
    std::snprintf(area.data(), area.size(), "%.6g", summary.area);
  }
  std::printf("%-*s %10zu %14s %8zu %8zu", width, name.c_str(), summary.triangles, area.data(), summary.openEdges,
              summary.nonManifoldEdges);
  for (int axis = 0; axis < 3 && !summary.bounds.empty(); ++axis)
  {
    // Adding zero turns a negative zero into zero.
    std::printf("  %.*g..%.*g", digits, summary.bounds.min[axis] + 0.0, digits, summary.bounds.max[axis] + 0.0);
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
  const int digits = digitsOf(inspection.total.bounds);
  std::printf("%-*s %10s %14s %8s %8s  %s\n", width, "name", "triangles", "area", "open", "non-man.", "bounds x, y, z");
  for (const SurfaceSummary& summary : inspection.surfaces)
  {
    printLine(summary, summary.name, width, digits);
  }
  printLine(inspection.total, "total", width, digits);
  std::printf("open, non-man.: edges that one triangle uses, or three and more; the total sees all surfaces "
              "together\n");
}

/// Prints lines, points, lights and other nodes that make no surface.
void printSkipped(vtkStringArray* nodes)
{
  for (vtkIdType i = 0; i < nodes->GetNumberOfValues(); ++i)
  {
    std::printf("%s%s", i == 0 ? "no surfaces, left out: " : ", ", nodes->GetValue(i).c_str());
  }
  std::printf(nodes->GetNumberOfValues() > 0 ? "\n" : "");
}

/// Prints at most `most` of a kind, those with the highest counts first.
void printProblems(std::vector<Problem> problems, const TriangleSurface& surface, const Box3& bounds)
{
  constexpr std::size_t most = 10;
  if (problems.empty())
  {
    std::printf("\nno problems\n");
    return;
  }
  const int digits = digitsOf(bounds);
  const double size = bounds.empty() ? 0.0 : bounds.size().maxCoeff();
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::pair(a.kind, b.count) < std::pair(b.kind, a.count);
  });
  std::printf("\n%-18s %8s %12s  %-32s %s\n", "problem", "count", "size", "at x y z", "surfaces");
  for (std::size_t i = 0, ofKind = 0; i < problems.size(); ++i)
  {
    const Problem& problem = problems[i];
    const char* kind = problemNames[static_cast<int>(problem.kind)];
    ofKind = i > 0 && problems[i - 1].kind == problem.kind ? ofKind + 1 : 0;
    const bool isLast = i + 1 == problems.size() || problems[i + 1].kind != problem.kind;
    if (ofKind < most)
    {
      const Vec3& p = problem.place;
      const std::string place = coordinate(p.x(), digits, size) + ' ' + coordinate(p.y(), digits, size) + ' ' +
                                coordinate(p.z(), digits, size);
      std::printf("%-18s %8zu %12.4g  %-32s", kind, problem.count, problem.size, place.c_str());
      for (std::size_t k = 0; k < problem.surfaces.size() && k < 3; ++k)
      {
        std::printf("%s%s", k == 0 ? " " : " + ", surface.names[problem.surfaces[k]].c_str());
      }
      std::printf(problem.surfaces.size() > 3 ? " + %zu more\n" : "\n", problem.surfaces.size() - 3);
    }
    if (isLast && ofKind >= most)
    {
      std::printf("%-18s and %zu more places; --json lists them\n", kind, ofKind + 1 - most);
    }
  }
  if (problems.back().kind == ProblemKind::clusters)
  {
    std::printf(
        "clusters: triangles among too many others in one place; crossings, contacts and gaps were looked for among "
        "the first of them only, so there are more\n");
  }
  std::printf(
      "size: length of edges, area of duplicates and overlaps, height of the thinnest sliver, width of the widest "
      "gap; of surfaces that have duplicates or overlaps the first keeps its faces there\n");
}

/// Shows the progress of the core, and stops it at Ctrl-C.
class ConsoleMonitor : public ProgressMonitor
{
public:
  explicit ConsoleMonitor(Console& shown) : console(shown) {}
  void report(double fraction, const char* phase) override { console.progress(fraction, phase); }
  bool aborted() const override { return Console::wasInterrupted(); }

private:
  Console& console;
};

std::vector<Problem> findProblems(const TriangleSurface& surface, const InspectOptions& options, Console& console)
{
  const ThreadExecutor threads(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  ConsoleMonitor monitor(console);
  const AbortableExecutor executor(threads, monitor);
  try
  {
    return atria::findProblems(surface, {options.gap}, {executor, ProgressRange(monitor)});
  }
  catch (const Aborted&)
  {
    Console::throwIfInterrupted();
    throw;
  }
}

/// Returns the details of surfaces that are too fine for octants of this size at features.
Json hiddenAt(double size, const TriangleSurface& surface, Console& console)
{
  atria::ModelOptions model;
  model.site.mode = DomainMode::bounds;
  for (const Vec3& p : surface.points)
  {
    model.site.bounds.extend(p);
  }
  constexpr double margin = 4.0; // so that a flat model has a domain
  model.site.bounds.min -= Vec3::Constant(margin * size);
  model.site.bounds.max += Vec3::Constant(margin * size);
  model.sizes.sizeMin = size;
  model.sizes.sizeMid = 2.0 * size;
  model.sizes.sizeMax = 4.0 * size;
  const ThreadExecutor threads(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  ConsoleMonitor monitor(console);
  const AbortableExecutor executor(threads, monitor);
  try
  {
    const RunContext context{executor, ProgressRange(monitor)};
    return hiddenDetailOf(reportRepair(surface, model, context).hidden, surface.names);
  }
  catch (const Aborted&)
  {
    Console::throwIfInterrupted();
    throw;
  }
}

/// Writes the curves of the whole model: a domain some way off it cuts none.
void writeFeatures(const std::string& file, vtkAtriaSurfaceReader* reader, Console& console)
{
  vtkNew<vtkAtriaFeatureGraph> features;
  features->SetInputConnection(reader->GetOutputPort());
  std::array<double, 6> bounds;
  reader->GetOutput()->GetBounds(bounds.data());
  for (std::size_t axis = 0; axis < 3; ++axis)
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

/// Returns the model's openings and rooms at sizes that suit it, or at requested ones. The mesh has them.
Json roomsAt(double size, const std::string& file, vtkAtriaSurfaceReader* reader, Console& console)
{
  vtkNew<vtkAtriaDualMesher> mesher;
  mesher->SetInputConnection(0, reader->GetOutputPort());
  mesher->SetFindOpenings(true);
  mesher->SetNumberOfLayers(0);
  mesher->SetSupportElements(false);
  if (size > 0.0)
  {
    mesher->SetSizeMin(size);
    mesher->SetSizeMid(2.0 * size);
    mesher->SetSizeMax(8.0 * size);
  }
  else
  {
    mesher->SuggestSizes();
    throwIfErrors(console, BadInput, file);
  }
  console.follow(mesher, 0.05, 0.9);
  updateOrFail(mesher, file, console);
  auto* diagnostics = vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2));
  return {{"openings", openingsOf(diagnostics)}, {"rooms", roomsOf(diagnostics)}};
}

std::string nameOf(const Json& room) { return room.is_null() ? "-" : room.get<std::string>(); }

void printRooms(const Json& found)
{
  std::printf("\n%-32s %12s  %s\n", "opening", "area", "between");
  for (const Json& opening : found["openings"])
  {
    std::printf("%-32s %12.5g  %s, %s\n", opening["name"].get<std::string>().c_str(), opening["area"].get<double>(),
                nameOf(opening["rooms"][0]).c_str(), nameOf(opening["rooms"][1]).c_str());
  }
  std::printf("\n%-32s %12s %12s %9s\n", "room", "volume", "floor area", "openings");
  for (const Json& room : found["rooms"])
  {
    std::printf("%-32s %12.5g %12.5g %9zu\n", room["name"].get<std::string>().c_str(), room["volume"].get<double>(),
                room["floor_area"].get<double>(), room["openings"].size());
  }
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
  const TriangleSurface surface = trianglesOf(reader->GetOutput());
  const Inspection inspection = inspect(surface);
  const bool looksForProblems = !options.noProblems && std::isfinite(inspection.total.area);
  const std::vector<Problem> problems =
      looksForProblems ? findProblems(surface, options, console) : std::vector<Problem>{};
  const Json hidden = options.atSize > 0.0 ? hiddenAt(options.atSize, surface, console) : Json();
  const Json rooms = options.openings ? roomsAt(options.atSize, options.file, reader, console) : Json();
  console.clearBar();
  if (options.json)
  {
    Json report = jsonOf(inspection, reader);
    report["problems"] = looksForProblems ? jsonOf(problems, surface) : Json();
    if (options.atSize > 0.0)
    {
      report["hidden_detail"] = hidden;
    }
    if (options.openings)
    {
      report.update(rooms);
    }
    std::cout << report.dump(2) << '\n';
  }
  else
  {
    printTable(inspection);
    printSkipped(reader->GetSkippedNodes());
    if (looksForProblems)
    {
      printProblems(problems, surface, inspection.total.bounds);
    }
    if (options.openings)
    {
      printRooms(rooms);
    }
    if (options.atSize > 0.0)
    {
      std::cout << "\nToo fine for elements of " << options.atSize
                << " m: " << (hidden.empty() ? "nothing\n" : "\n" + hiddenDetailText(hidden, "  "));
    }
  }
  return Done;
}

} // namespace

void addInspectCommand(CLI::App& app, Console& console, ExitStatus& status)
{
  CLI::App* command =
      app.add_subcommand("inspect", "List the surfaces of a model by name, and what may be wrong with it");
  auto options = std::make_shared<InspectOptions>();
  command->add_option("MODEL", options->file, modelFormats)->required();
  declareModelOptions(*command, options->model);
  command
      ->add_option(
          "--features", options->features,
          "Also write the curves and corners that a mesh is to keep: boundary edges, creases, junctions, borders")
      ->type_name("OUT.vtp");
  command->add_option("--gap", options->gap, "Width in meters up to which gaps are looked for; 0 for none")
      ->capture_default_str()
      ->check(atLeast(0.0))
      ->type_name("M");
  command
      ->add_option(
          "--at-size", options->atSize,
          "Also list what is too fine for elements of this size in meters (--size-min): small parts that would "
          "be left out, and triangles in clusters")
      ->check(atLeast(0.0))
      ->type_name("M");
  command->add_flag("--no-problems", options->noProblems, "List surfaces only, which is quicker");
  command->add_flag(
      "--openings", options->openings,
      "Also list windows, doors and hatches, and the rooms they join, as a mesh of --at-size has them, or "
      "of sizes that suit the model");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &console, &status] { status = runInspect(*options, console); });
}

} // namespace atria::tool
