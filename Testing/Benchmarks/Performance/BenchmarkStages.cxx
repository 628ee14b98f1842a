// SPDX-License-Identifier: GPL-3.0-or-later
/// Time of each stage, from reading to writing, on three models and with one and two threads.
///
/// Usage: benchmark_stages [--benchmark_filter=REGEX …]; see Google Benchmark's documentation.
#include "Dual/Displacement/DisplacedGrid.h"
#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPoints.h"
#include "Dual/Vertices/DualVertices.h"
#include "Mesher/DualMesher.h"
#include "Octree/Sizing/Refinement.h"
#include "Octree/Sizing/Sizing.h"
#include "Octree/Tree/Balance.h"
#include "SmpExecutor.h"
#include "SphereOctants.h"
#include "Support/Memory.h"
#include "Surface/Model/SurfaceModel.h"
#include "VtkSurface.h"
#include "vtkAtriaDualMesher.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaOpenFOAMWriter.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

void useThreads(int count); // Threads.cxx

namespace {

namespace fs = std::filesystem;

using namespace atria;

struct Case
{
  const char* name;
  const char* model;
  std::array<double, 3> sizes; ///< largest, at surfaces, at features
};

constexpr std::array<Case, 3> cases{Case{"uniform", "sphere_in_cube.wrl", {0.1, 0.1, 0.1}},
                                    Case{"adaptive", "sphere_in_cube.wrl", {0.8, 0.1, 0.1}},
                                    Case{"building", "building.wrl", {8.0, 2.0, 1.0}}};

std::string fileOf(const Case& which) { return std::string(ATRIA_EXAMPLE_DATA) + "/" + which.model; }

/// What the stages work on, made up to the one that is measured.
class Work
{
public:
  explicit Work(const Case& which) : context{executor, ProgressRange(silent)}
  {
    vtkNew<vtkAtriaVRMLReader> reader;
    reader->SetFileName(fileOf(which).c_str());
    reader->Update();
    surface = surfaceFromVtk({reader->GetOutput()}).surface;
    for (const Vec3& p : surface.points)
    {
      extent.extend(p);
    }
    GridOptions options;
    options.domain = extent;
    options.domain.max[2] = std::max(extent.max[2], extent.min[2] + 0.3 * extent.size().maxCoeff());
    options.sizeMax = which.sizes[0];
    options.sizeMid = which.sizes[1];
    options.sizeMin = which.sizes[2];
    frame = makeGridFrame(options, extent);
    model = makeSurfaceModel(surface, frame, {}, context);
    sized = sizeOctants(model, frame, {}, context);
    octree = buildOctree(model, frame, sized, context);
    points = findGridPoints(octree, context);
    grid.emplace(octree, points);
    crossings = findCrossings(*grid, model, context);
    const TriangleTreeOnDemand tree(model);
    displaced = displaceGrid(points, crossings, GridPart(points), {context, octree, model, tree}).crossings;
    for (const auto& about : points.leaves)
    {
      leaves.insert(leaves.end(), about.begin(), about.end());
    }
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  }

  SmpExecutor executor;
  SilentMonitor silent;
  RunContext context;
  TriangleSurface surface;
  Box3 extent;
  GridFrame frame;
  SurfaceModel model;
  SizedOctants sized;
  Octree octree;
  GridPoints points;
  std::optional<GridPlaces> grid;
  Crossings crossings;
  Crossings displaced;
  std::vector<Index> leaves;
};

const Work& workOf(const Case& which)
{
  static std::map<std::string, Work> made;
  return made.try_emplace(which.name, which).first->second;
}

/// A mesh by the filter, with a layer.
vtkAtriaDualMesher* meshOf(const Case& which)
{
  static std::map<std::string, vtkSmartPointer<vtkAtriaDualMesher>> made;
  vtkSmartPointer<vtkAtriaDualMesher>& mesher = made[which.name];
  if (!mesher)
  {
    vtkNew<vtkAtriaVRMLReader> reader;
    reader->SetFileName(fileOf(which).c_str());
    mesher = vtkSmartPointer<vtkAtriaDualMesher>::New();
    mesher->SetInputConnection(reader->GetOutputPort());
    mesher->CacheStagesOff();
    mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
    mesher->SetSizeMax(which.sizes[0]);
    mesher->SetSizeMid(which.sizes[1]);
    mesher->SetSizeMin(which.sizes[2]);
    mesher->Update();
  }
  return mesher;
}

vtkUnstructuredGrid* volumeOf(const Case& which)
{
  return vtkUnstructuredGrid::SafeDownCast(meshOf(which)->GetOutputDataObject(0));
}

void count(benchmark::State& state, std::size_t items)
{
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * items));
}

void read(benchmark::State& state, const Case& which)
{
  for (auto _ : state)
  {
    vtkNew<vtkAtriaVRMLReader> reader;
    reader->SetFileName(fileOf(which).c_str());
    reader->Update();
  }
  count(state, workOf(which).surface.triangles.size());
}

void surface(benchmark::State& state, const Case& which)
{
  const Work& work = workOf(which);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(makeSurfaceModel(work.surface, work.frame, {}, work.context));
  }
  count(state, work.surface.triangles.size());
}

void sizing(benchmark::State& state, const Case& which)
{
  const Work& work = workOf(which);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(sizeOctants(work.model, work.frame, {}, work.context));
  }
  count(state, work.octree.leafCount());
}

void octree(benchmark::State& state, const Case& which)
{
  const Work& work = workOf(which);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(buildOctree(work.model, work.frame, work.sized, work.context));
  }
  count(state, work.octree.leafCount());
}

void dual(benchmark::State& state, const Case& which)
{
  const Work& work = workOf(which);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(findGridPoints(work.octree, work.context));
  }
  count(state, work.points.size());
}

void crossings(benchmark::State& state, const Case& which)
{
  const Work& work = workOf(which);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(findCrossings(*work.grid, work.model, work.context));
  }
  count(state, work.points.size());
}

void movedPoints(benchmark::State& state, const Case& which)
{
  const Work& work = workOf(which);
  for (auto _ : state)
  {
    state.PauseTiming();
    Crossings undisplaced = work.crossings;
    const TriangleTreeOnDemand tree(work.model);
    state.ResumeTiming();
    benchmark::DoNotOptimize(displaceGrid(work.points, std::move(undisplaced), GridPart(work.points),
                                          {work.context, work.octree, work.model, tree}));
  }
  count(state, work.points.size());
}

void vertices(benchmark::State& state, const Case& which)
{
  const Work& work = workOf(which);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(placeVertices(work.octree, work.model, work.displaced, work.leaves, work.context));
  }
  count(state, work.leaves.size());
}

/// Stages that are timed in a whole run, as what they work on is not kept.
void stageOf(benchmark::State& state, const Case& which, const std::string& stage)
{
  vtkAtriaDualMesher* mesher = meshOf(which);
  for (auto _ : state)
  {
    mesher->Modified();
    mesher->Update();
    for (int i = 0; i < mesher->GetNumberOfStages(); ++i)
    {
      if (mesher->GetStageName(i) == stage)
      {
        state.SetIterationTime(mesher->GetStageSeconds(i));
      }
    }
  }
  count(state, static_cast<std::size_t>(volumeOf(which)->GetNumberOfCells()));
}

void quality(benchmark::State& state, const Case& which)
{
  vtkAtriaDualMesher* mesher = meshOf(which);
  for (auto _ : state)
  {
    vtkNew<vtkAtriaMeshQuality> filter;
    filter->SetInputDataObject(0, mesher->GetOutputDataObject(0));
    filter->SetInputDataObject(1, mesher->GetOutputDataObject(1));
    filter->Update();
  }
  count(state, static_cast<std::size_t>(volumeOf(which)->GetNumberOfCells()));
}

void writeVtu(benchmark::State& state, const Case& which)
{
  const fs::path file = fs::temp_directory_path() / "atria_benchmark.vtu";
  vtkUnstructuredGrid* volume = volumeOf(which);
  for (auto _ : state)
  {
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputDataObject(volume);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToLZ4();
    writer->Write();
  }
  count(state, static_cast<std::size_t>(volume->GetNumberOfCells()));
  fs::remove(file);
}

void writeOpenFOAM(benchmark::State& state, const Case& which)
{
  const fs::path folder = fs::temp_directory_path() / "atria_benchmark_case";
  vtkAtriaDualMesher* mesher = meshOf(which);
  for (auto _ : state)
  {
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetInputDataObject(0, mesher->GetOutputDataObject(0));
    writer->SetInputDataObject(1, mesher->GetOutputDataObject(1));
    writer->SetCaseDirectory(folder.c_str());
    writer->WriteBinaryOn();
    writer->Write();
  }
  count(state, static_cast<std::size_t>(volumeOf(which)->GetNumberOfCells()));
  fs::remove_all(folder);
}

/// Balance alone, and the linear octree, of a refinement without a model.
void balanceSphere(benchmark::State& state)
{
  const int depth = static_cast<int>(state.range(0));
  const RefinedSets given = atria::measuring::sphereOctants(depth);
  const GridFrame frame = atria::measuring::sphereFrame(depth);
  const SmpExecutor executor;
  SilentMonitor silent;
  std::size_t leaves = 0;
  for (auto _ : state)
  {
    RefinedSets sets = given;
    balance(sets, frame, {executor, ProgressRange(silent)});
    leaves = Octree(frame, sets).leafCount();
  }
  count(state, leaves);
}

using Stage = void (*)(benchmark::State&, const Case&);

void add(const std::string& name, const Case& which, Stage stage, int threads)
{
  const std::string full = name + "/" + which.name + "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(full.c_str(),
                               [stage, &which, threads](benchmark::State& state) {
                                 useThreads(threads);
                                 stage(state, which);
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void addStage(const std::string& name, const Case& which, int threads)
{
  const std::string full = name + "/" + which.name + "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(full.c_str(),
                               [name, &which, threads](benchmark::State& state) {
                                 useThreads(threads);
                                 stageOf(state, which, name);
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(1);
}

} // namespace

int main(int argc, char* argv[])
{
  atria::keepFreedMemory();
  for (const int threads : {1, 2})
  {
    for (const Case& which : cases)
    {
      add("read", which, read, threads);
      add("surface", which, surface, threads);
      add("sizing", which, sizing, threads);
      add("octree", which, octree, threads);
      add("dual", which, dual, threads);
      add("crossings", which, crossings, threads);
      add("moved_points", which, movedPoints, threads);
      add("vertices", which, vertices, threads);
      addStage("layers", which, threads);
      add("quality", which, quality, threads);
      add("write_vtu", which, writeVtu, threads);
      add("write_openfoam", which, writeOpenFOAM, threads);
    }
    benchmark::RegisterBenchmark(("balance/sphere/threads:" + std::to_string(threads)).c_str(),
                                 [threads](benchmark::State& state) {
                                   useThreads(threads);
                                   balanceSphere(state);
                                 })
        ->Arg(8)
        ->Arg(9)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
