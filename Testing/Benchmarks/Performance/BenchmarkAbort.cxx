// SPDX-License-Identifier: GPL-3.0-or-later
/// How soon the mesher, the quality filter and OpenFOAM's writer answer when they should stop.
///
/// Usage: benchmark_abort MODEL SIZE_MAX SIZE_MID SIZE_MIN [LAYERS [THREADS [TIMES]]]
/// First a whole run, with the longest time in each phase without an occasion to abort; then TIMES (default 20) runs
/// that are aborted at moments spread over it, with the time until each returned.
#include "vtkAtriaDualMesher.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaModelReader.h"
#include "vtkAtriaOpenFOAMWriter.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

void useThreads(int count); // Threads.cxx

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Notes when events come, and aborts at the first one after a moment.
class Watch
{
public:
  Watch()
  {
    observer->SetClientData(this);
    observer->SetCallback([](vtkObject* caller, unsigned long, void* self, void*) {
      static_cast<Watch*>(self)->event(static_cast<vtkAlgorithm*>(caller));
    });
  }

  void follow(vtkAlgorithm* algorithm) { algorithm->AddObserver(vtkCommand::ProgressEvent, observer); }

  void event(vtkAlgorithm* algorithm)
  {
    const double gap = since(last);
    last = Clock::now();
    const char* text = algorithm->GetProgressText();
    // The time before an event belongs to the phase that the event before it told.
    const auto found = std::find_if(gaps.begin(), gaps.end(), [&](const auto& g) { return g.first == phase; });
    if (found == gaps.end())
    {
      gaps.emplace_back(phase, gap);
    }
    else
    {
      found->second = std::max(found->second, gap);
    }
    phase = text ? text : "";
    if (moment >= 0.0 && since(start) > moment)
    {
      algorithm->AbortExecuteOn();
    }
  }

  std::vector<std::pair<std::string, double>> gaps;
  Clock::time_point start = Clock::now();
  Clock::time_point last = start;
  double moment = -1.0;
  std::string phase;

private:
  vtkNew<vtkCallbackCommand> observer;
};

/// All one after the other, until one is aborted.
void run(vtkAtriaDualMesher* mesher, vtkAtriaMeshQuality* quality, vtkAtriaOpenFOAMWriter* writer, Watch& watch)
{
  watch.start = watch.last = Clock::now();
  mesher->Modified();
  mesher->Update();
  if (!mesher->GetAbortExecute())
  {
    quality->Update();
  }
  if (!mesher->GetAbortExecute() && !quality->GetAbortExecute())
  {
    quality->GetOutputDataObject(0)->Initialize(); // room for the writer
    writer->Write();
  }
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 5)
  {
    std::fprintf(stderr, "usage: %s MODEL SIZE_MAX SIZE_MID SIZE_MIN [LAYERS [THREADS [TIMES]]]\n", argv[0]);
    return 2;
  }
  useThreads(argc > 6 ? std::atoi(argv[6]) : 0);
  vtkSmartPointer<vtkAtriaSurfaceReader> reader = vtkSmartPointer<vtkAtriaVRMLReader>::New();
  if (vtkAtriaModelReader::CanReadFile(argv[1]))
  {
    reader = vtkSmartPointer<vtkAtriaModelReader>::New();
  }
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkNew<vtkAtriaDualMesher> mesher;
  mesher->CacheStagesOff();
  mesher->SetInputConnection(reader->GetOutputPort());
  mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
  mesher->SetSizeMax(std::atof(argv[2]));
  mesher->SetSizeMid(std::atof(argv[3]));
  mesher->SetSizeMin(std::atof(argv[4]));
  mesher->SetNumberOfLayers(argc > 5 ? std::atoi(argv[5]) : 1);
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(0, mesher->GetOutputPort(0));
  quality->SetInputConnection(1, mesher->GetOutputPort(1));
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "atria_benchmark_abort";
  vtkNew<vtkAtriaOpenFOAMWriter> writer;
  writer->SetCaseDirectory(folder.c_str());
  writer->SetInputConnection(0, mesher->GetOutputPort(0));
  writer->SetInputConnection(1, mesher->GetOutputPort(1));
  Watch watch;
  watch.follow(mesher);
  watch.follow(quality);
  watch.follow(writer);
  run(mesher, quality, writer, watch);
  const double whole = since(watch.start);
  std::printf("whole run: %.2f s; longest time between occasions to abort:\n", whole);
  for (const auto& [phase, gap] : watch.gaps)
  {
    std::printf("  %6.3f s  %s\n", gap, phase.c_str());
  }
  const int times = argc > 7 ? std::atoi(argv[7]) : 20;
  double longest = 0.0;
  for (int i = 0; i < times; ++i)
  {
    watch.moment = whole * (i + 0.5) / times;
    run(mesher, quality, writer, watch);
    const double late = std::max(0.0, since(watch.start) - watch.moment);
    longest = std::max(longest, late);
    std::printf("aborted after %6.2f s, returned %.3f s later, from: %s\n", watch.moment, late, watch.phase.c_str());
  }
  std::printf("longest: %.3f s\n", longest);
  std::filesystem::remove_all(folder);
  return 0;
}
