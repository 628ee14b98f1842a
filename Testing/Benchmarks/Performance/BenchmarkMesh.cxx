// SPDX-License-Identifier: GPL-3.0-or-later
/// One whole run, from a model's file to the mesh as VTK data, without writing it: time and peak memory by stage.
///
/// Usage: benchmark_mesh MODEL SIZE_MAX SIZE_MID SIZE_MIN [LAYERS [THREADS [SITE [DEGREES SKEWNESS]]]]
/// THREADS 0 is all cores; without SITE, or an empty one, the domain is the model's bounds. DEGREES and SKEWNESS are
/// the targets at curved walls. Prints one object of JSON.
#include "MemoryPeak.h"
#include "Support/Memory.h"
#include "vtkAtriaDualMesher.h"
#include "vtkAtriaModelReader.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

void useThreads(int count); // Threads.cxx

namespace {

using atria::measuring::MemoryPeak;

/// Peaks of resident memory while filters tell of a phase.
class Phases
{
public:
  Phases()
  {
    observer->SetClientData(this);
    observer->SetCallback([](vtkObject* caller, unsigned long, void* self, void*) {
      const char* text = static_cast<vtkAlgorithm*>(caller)->GetProgressText();
      static_cast<Phases*>(self)->enter(text ? text : "");
    });
  }

  void follow(vtkAlgorithm* algorithm) { algorithm->AddObserver(vtkCommand::ProgressEvent, observer); }

  void enter(const std::string& phase)
  {
    if (peaks.empty() || peaks.back().first != phase)
    {
      leave();
      peaks.emplace_back(phase, 0);
    }
  }

  void leave()
  {
    if (!peaks.empty())
    {
      peaks.back().second = peak.sinceLast();
    }
  }

  std::vector<std::pair<std::string, long long>> peaks;

private:
  vtkNew<vtkCallbackCommand> observer;
  MemoryPeak peak;
};

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

vtkSmartPointer<vtkAtriaSurfaceReader> readerOf(const char* file)
{
  if (vtkAtriaModelReader::CanReadFile(file))
  {
    return vtkSmartPointer<vtkAtriaModelReader>::New();
  }
  return vtkSmartPointer<vtkAtriaVRMLReader>::New();
}

void print(vtkAtriaDualMesher* mesher, vtkPolyData* model, double reading, double seconds, const Phases& phases)
{
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(mesher->GetOutputDataObject(0));
  std::printf(
      "{\"elements\": %lld, \"vertices\": %lld, \"triangles\": %lld, \"seconds\": %.4f, \"output_bytes\": %lld,\n",
      static_cast<long long>(mesh->GetNumberOfCells()), static_cast<long long>(mesh->GetNumberOfPoints()),
      static_cast<long long>(model->GetNumberOfCells()), seconds,
      1024 * static_cast<long long>(mesh->GetActualMemorySize()));
  std::printf(" \"stages\": {\"read\": %.4f", reading);
  for (int i = 0; i < mesher->GetNumberOfStages(); ++i)
  {
    std::printf(", \"%s\": %.4f", mesher->GetStageName(i).c_str(), mesher->GetStageSeconds(i));
  }
  std::printf("},\n \"peaks\": [");
  for (std::size_t i = 0; i < phases.peaks.size(); ++i)
  {
    std::printf("%s[\"%s\", %lld]", i == 0 ? "" : ", ", phases.peaks[i].first.c_str(), phases.peaks[i].second);
  }
  std::printf("]}\n");
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 5)
  {
    std::fprintf(stderr, "usage: %s MODEL SIZE_MAX SIZE_MID SIZE_MIN [LAYERS [THREADS [SITE [DEGREES SKEWNESS]]]]\n",
                 argv[0]);
    return 2;
  }
  atria::keepFreedMemory();
  useThreads(argc > 6 ? std::atoi(argv[6]) : 0);
  const auto start = std::chrono::steady_clock::now();
  Phases phases;
  const auto reader = readerOf(argv[1]);
  reader->SetFileName(argv[1]);
  phases.follow(reader);
  reader->Update();
  const double reading = secondsSince(start);
  vtkNew<vtkAtriaDualMesher> mesher;
  mesher->CacheStagesOff();
  mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
  mesher->SetSizeMax(std::atof(argv[2]));
  mesher->SetSizeMid(std::atof(argv[3]));
  mesher->SetSizeMin(std::atof(argv[4]));
  mesher->SetNumberOfLayers(argc > 5 ? std::atoi(argv[5]) : 1);
  if (argc > 7 && *argv[7])
  {
    mesher->SetDomainMode(vtkAtriaDualMesher::Site);
    mesher->SetSiteName(argv[7]);
  }
  if (argc > 9)
  {
    mesher->SetTargetNonOrthogonality(std::atof(argv[8]));
    mesher->SetTargetSkewness(std::atof(argv[9]));
  }
  mesher->SetInputConnection(reader->GetOutputPort());
  phases.follow(mesher);
  mesher->Update();
  phases.leave();
  print(mesher, reader->GetOutput(), reading, secondsSince(start), phases);
  return 0;
}
