// SPDX-License-Identifier: GPL-3.0-or-later
/// atria mesh: runs reader, mesher, quality and writers.
#include "Commands.h"
#include "ConfigFile.h"
#include "Console.h"
#include "Files.h"
#include "InputFiles.h"
#include "LeftOut.h"
#include "MeshOnRanks.h"
#include "MeshOptions.h"
#include "MeshSums.h"
#include "OutputFiles.h"
#include "Platform.h"
#include "Report.h"
#include "Summary.h"
#include "Threads.h"

#include <vtkAtriaDualMesher.h>
#include <vtkAtriaMeshQuality.h>
#include <vtkAtriaOctreeSource.h>
#include <vtkAtriaPreflight.h>
#include <vtkAtriaSurfaceReader.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <array>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <tuple>
#include <vector>

namespace atria::tool {

namespace {

class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

private:
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

Json makeReport(vtkAtriaDualMesher* mesher, vtkAtriaMeshQuality* quality, const Json& sums, const Json& seconds,
                double speed)
{
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0));
  auto* diagnostics = vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2));
  Json report;
  report["counts"] = sums["counts"];
  report["zones"] = zonesOf(sums["zone_volumes"], diagnostics);
  report["rooms"] = roomsOf(diagnostics);
  report["openings"] = openingsOf(diagnostics);
  report["leaks"] = leaksOf(diagnostics);
  report["patches"] = patchesOf(sums);
  report["quality"] = qualityOf(vtkTable::SafeDownCast(quality->GetOutputDataObject(1)));
  report["invalid_elements"] = quality->GetNumberOfInvalidCells();
  report["max_level"] = maxLevelOf(mesh);
  report["seconds"] = seconds;
  report["peak_memory_bytes"] = peakMemoryBytes();
  report["threads"] = threadsInUse();
  report["repair"] = repairOf(diagnostics);
  report["hidden_detail"] = hiddenDetailOf(diagnostics);
  report["layers"] = layersOf(diagnostics, speed);
  report["failing_by_thin_layers"] = textsOf(diagnostics, "FailingByThinLayers");
  report["audit"] = auditOf(diagnostics);
  report["left_out_elements"] = leftOutElementsOf(diagnostics);
  report["diagnostics"] = diagnosticsOf(diagnostics);
  return report;
}

/// Returns the result of writeExports(), null if no case is written.
Json writeOutputs(const MeshOptions& options, vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches,
                  Console& console, const Workers& workers)
{
  const bool isDivided = staysInPieces(options, workers);
  if (isInPieces(options.output))
  {
    writePieces(options.output, options.patches, {mesh, patches}, isDivided, console, workers);
  }
  else
  {
    writeMesh(options.output, mesh, console);
    if (!options.patches.empty())
    {
      writePatches(options.patches, patches, console);
    }
  }
  return writeExports(options.exports, {mesh, patches}, isDivided, console, workers);
}

/// Prints the number of elements that layers add, which the estimate of octants does not include.
void printLayerEstimate(const MeshOptions& options, vtkAtriaSurfaceReader* reader, vtkIdType elements, Console& console)
{
  vtkNew<vtkAtriaDualMesher> mesher;
  configure(mesher, options);
  mesher->SetInputConnection(0, reader->GetOutputPort());
  const vtkIdType added = mesher->EstimateLayerElements();
  Console::throwIfInterrupted();
  if (added < 0)
  {
    console.takeErrors(); // the misfit of sizes and memory was already reported
    return;
  }
  std::cout << "with layers: about " << elements + added << " or more\n";
}

ExitStatus runPreflight(const MeshOptions& options, vtkAtriaSurfaceReader* reader, Console& console)
{
  vtkNew<vtkAtriaPreflight> preflight;
  configureGrid(preflight, options);
  preflight->SetInputConnection(0, reader->GetOutputPort());
  console.follow(preflight, 0.05, 1.0);
  updateOrFail(preflight, options.input, console);
  const Json report = preflightOf(preflight->GetOutput());
  console.clearBar();
  printPreflight(preflight->GetOutput());
  printLayerEstimate(options, reader, report["EstimatedElements"].get<vtkIdType>(), console);
  if (!options.report.empty())
  {
    writeText(options.report, report.dump(2) + "\n");
  }
  return Done;
}

ExitStatus printEstimate(const MeshOptions& options, vtkAtriaSurfaceReader* reader, Console& console)
{
  vtkNew<vtkAtriaOctreeSource> source;
  configureGrid(source, options);
  source->SetInputConnection(reader->GetOutputPort());
  console.follow(source, 0.05, 1.0);
  const bool estimated = source->Estimate();
  console.clearBar();
  if (!estimated)
  {
    throwIfErrors(console, BadInput, options.input);
  }
  std::istringstream warnings(source->GetEstimateWarning());
  for (std::string warning; std::getline(warnings, warning);)
  {
    console.warning(warning);
  }
  std::cout << estimateText(source);
  if (!source->GetEstimateIsTooLarge())
  {
    printLayerEstimate(options, reader, source->GetEstimatedElements(), console);
  }
  return Done;
}

/// Warns of requests that the mesher could not fulfill, and of its own decisions.
void warn(vtkAtriaDualMesher* mesher, const Json& report, const MeshOptions& options, Console& console)
{
  for (const Json& warning : report["audit"]["warnings"])
  {
    console.warning(options.input + ": " + warning.get<std::string>());
  }
  for (const Json& note : report["diagnostics"]["InputNote"])
  {
    console.note(options.input + ": " + note.get<std::string>());
  }
  if (mesher->GetZoneRule() == vtkAtriaDualMesher::Outside) // seeds are the user's choice of zones
  {
    tellLeftOut(report["zones"], options.input, console);
  }
  tellLeftOutElements(report["left_out_elements"], options.input, console);
  for (const Json& leak : report["leaks"])
  {
    console.warning(options.input + ": " + leak["message"].get<std::string>());
  }
  if (const auto invalid = report["invalid_elements"].get<long long>(); invalid > 0)
  {
    console.warning(options.output + ": " + std::to_string(invalid) + " of " +
                    std::to_string(report["counts"]["elements"].get<long long>()) +
                    " elements are not valid; see the cell array Valid");
  }
}

void printMerged(const Json& openfoam, const std::string& folder)
{
  const auto count = [&](const char* key) { return openfoam.is_null() ? 0LL : openfoam[key].get<long long>(); };
  if (const auto cells = count("merged_cells"); cells > 0)
  {
    std::cout << folder << ": " << cells
              << " cells fewer, as elements with too few neighbors were made one with one of them\n";
  }
  if (const auto cells = count("added_cells"); cells > 0)
  {
    std::cout << folder << ": " << cells << " cells more, as elements with too few neighbors were cut into pyramids\n";
  }
  if (const auto faces = count("merged_faces"); faces > 0)
  {
    std::cout << folder << ": " << faces << " faces fewer, as coplanar ones of an element were merged\n";
  }
}

/// True if the written case fails a check for another reason than that layers are as thin as requested.
bool checksFail(const Json& report)
{
  if (report["openfoam"].is_null())
  {
    return false;
  }
  const Json& expected = report["failing_by_thin_layers"];
  return std::ranges::any_of(failedIn(report["openfoam"]["checks"]), [&](const std::string& name) {
    return std::ranges::find(expected, Json(name)) == expected.end();
  });
}

void makeElements(vtkAtriaDualMesher* mesher, const CLI::App& command, const MeshOptions& options, Console& console,
                  const Workers& workers)
{
  vtkIdType elements = 0;
  if (isMadeTogether(options, workers))
  {
    elements = makeTogether(mesher, command, options, workers);
  }
  else
  {
    mesher->Update();
    elements = mesher->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL);
  }
  throwIfErrors(console, BadInput, options.input);
  if (elements == 0)
  {
    throw Failure(BadInput, options.input + ": no element of the domain is fluid; check --domain, --zone and --seed");
  }
}

/// Returns the sums over all elements and patches made.
Json measure(vtkAtriaMeshQuality* quality, vtkAtriaDualMesher* mesher, const MeshOptions& options, Console& console,
             const Workers& workers)
{
  quality->SetInputDataObject(0, mesher->GetOutputDataObject(0));
  quality->SetInputDataObject(1, mesher->GetOutputDataObject(1));
  if (staysInPieces(options, workers))
  {
    Json sums = measureTogether(quality, workers);
    throwIfErrors(console, BadInput, options.input);
    return sums;
  }
  updateOrFail(quality, options.input, console);
  return sumsOf(vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0)),
                vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1)));
}

/// Makes mesh, quality and files of a model that was read.
ExitStatus makeMesh(const MeshOptions& options, const CLI::App& command, vtkAtriaSurfaceReader* reader,
                    double readSeconds, const Stopwatch& total, Console& console, const Workers& workers)
{
  vtkNew<vtkAtriaDualMesher> mesher;
  configure(mesher, options);
  // The reader is not connected: ranks ask for pieces, and the others read nothing.
  mesher->SetInputDataObject(0, reader->GetOutput());
  console.follow(mesher, 0.05, 0.75);
  makeElements(mesher, command, options, console, workers);
  const Stopwatch measuring;
  vtkNew<vtkAtriaMeshQuality> quality;
  console.follow(quality, 0.75, 0.9);
  const Json sums = measure(quality, mesher, options, console, workers);
  const double qualitySeconds = measuring.seconds();

  const Stopwatch writing;
  const Json openfoam =
      writeOutputs(options, vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0)),
                   vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1)), console, workers);
  Json seconds = {{"Read", readSeconds}};
  seconds.update(stageSecondsOf(mesher));
  seconds["Quality"] = qualitySeconds;
  seconds["Write"] = writing.seconds();
  seconds["Total"] = total.seconds();
  Json report = makeReport(mesher, quality, sums, seconds, options.layers.speed);
  report["openfoam"] = openfoam;
  if (!options.report.empty())
  {
    writeText(options.report, report.dump(2) + "\n");
  }
  console.clearBar();
  printMerged(openfoam, options.exports.openfoam);
  printLayers(report["layers"]);
  std::vector<std::string> files{options.output, options.patches};
  const std::vector<std::string> exported = options.exports.targets();
  files.insert(files.end(), exported.begin(), exported.end());
  files.push_back(options.report);
  std::cout << summaryOf(report, files) << std::flush;
  warn(mesher, report, options, console);
  return statusOf(report["invalid_elements"].get<long long>(), checksFail(report));
}

/// Completes the sizes that are not given, and reports them.
void completeSizes(MeshOptions& options, vtkAtriaSurfaceReader* reader, Console& console)
{
  vtkNew<vtkAtriaOctreeSource> source;
  configureGrid(source, options);
  source->SetInputConnection(reader->GetOutputPort());
  source->CompleteSizes();
  throwIfErrors(console, BadInput, options.input);
  std::ostringstream text;
  text << options.input << (options.hasSize() ? ": sizes that are not given:" : ": sizes from the model's area:");
  const auto take = [&](const char* name, std::optional<double>& size, double completed) {
    if (!size)
    {
      text << ' ' << name << ' ' << completed;
    }
    size = size.value_or(completed);
  };
  take("--size-max", options.sizeMax, source->GetSizeMax());
  take("--size-mid", options.sizeMid, source->GetSizeMid());
  take("--size-min", options.sizeMin, source->GetSizeMin());
  console.note(text.str());
}

ExitStatus runMesh(MeshOptions options, const CLI::App& command, Console& console, const Workers& workers)
{
  if (writesConfigFile(command, options.writeConfig))
  {
    return Done;
  }
  if (options.input.empty())
  {
    throw Failure(Usage, "MODEL is required: name the file of the model");
  }
  completeMeshOptions(options);
  // If zones share faces with walls, the mesher knows which to keep; a reader does not know zones.
  options.model.keepDuplicates =
      options.model.keepDuplicates || !options.faceZones.empty() || !options.cellZones.empty();
  setThreads(options.threads);
  const Stopwatch total;
  const auto reader = readModel(options.input, options.model, console);
  const double readSeconds = total.seconds();
  if (!options.site.empty())
  {
    checkSite(options.site, reader->GetOutput());
  }
  if (!options.hasAllSizes())
  {
    completeSizes(options, reader, console);
  }
  return options.preflight  ? runPreflight(options, reader, console)
         : options.estimate ? printEstimate(options, reader, console)
                            : makeMesh(options, command, reader, readSeconds, total, console, workers);
}

} // namespace

void addMeshCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status)
{
  CLI::App* command = app.add_subcommand("mesh", "Make a volume mesh of a model");
  command->fallthrough(); // to --config
  auto options = std::make_shared<MeshOptions>();
  declareMeshOptions(*command, *options);
  command->callback(
      [options, command, &console, &workers, &status] { status = runMesh(*options, *command, console, workers); });
}

} // namespace atria::tool
