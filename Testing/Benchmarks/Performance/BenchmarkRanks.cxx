// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh on MPI ranks: seconds and memory by rank, and what MPI is given to carry, counted.
///
/// Usage: mpiexec -n RANKS benchmark_ranks MODEL SIZE_MAX SIZE_MID SIZE_MIN [LAYERS [BLOCK_SIZE]]
/// The domain is the model's bounds; every rank has one thread. With a block size ranks make the mesh together, and
/// nothing is dealt out. Prints a row of a table: model, ranks, elements, most elements of a rank; seconds of the first
/// rank's processor for meshing, dealing out and quality; the most memory of the first rank and of any other, in
/// megabytes; messages and megabytes that all ranks send until each has its piece, and megabytes for quality.
#include "MemoryPeak.h"
#include "Support/Memory.h"
#include "vtkAtriaDualMesher.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkCallbackCommand.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>

void useThreads(int count); // Threads.cxx

namespace {

std::int64_t messages = 0;
std::int64_t bytes = 0;

void carried(int count, MPI_Datatype type)
{
  int size = 0;
  PMPI_Type_size(type, &size);
  ++messages;
  bytes += static_cast<std::int64_t>(count) * size;
}

} // namespace

// What VTK calls; each is counted and done as ever.
extern "C" int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  carried(count, type);
  return PMPI_Send(data, count, type, to, tag, comm);
}

extern "C" int MPI_Ssend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  carried(count, type);
  return PMPI_Ssend(data, count, type, to, tag, comm);
}

extern "C" int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm)
{
  int rank = 0, ranks = 1;
  PMPI_Comm_rank(comm, &rank);
  PMPI_Comm_size(comm, &ranks);
  for (int other = 1; rank == root && other < ranks; ++other)
  {
    carried(count, type);
  }
  return PMPI_Bcast(data, count, type, root, comm);
}

extern "C" int MPI_Allgather(const void* data, int count, MPI_Datatype type, void* all, int counts, MPI_Datatype types,
                             MPI_Comm comm)
{
  carried(count, type);
  return PMPI_Allgather(data, count, type, all, counts, types, comm);
}

extern "C" int MPI_Allreduce(const void* data, void* all, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm)
{
  carried(count, type);
  return PMPI_Allreduce(data, all, count, type, operation, comm);
}

namespace {

double processorSeconds()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::int64_t overRanks(std::int64_t own, MPI_Op operation)
{
  std::int64_t all = 0;
  PMPI_Allreduce(&own, &all, 1, MPI_INT64_T, operation, MPI_COMM_WORLD);
  return all;
}

std::int64_t ownCells(vtkUnstructuredGrid* piece)
{
  vtkUnsignedCharArray* ghosts = piece->GetCellGhostArray();
  return ghosts ? std::count(ghosts->Begin(), ghosts->End(), 0) : piece->GetNumberOfCells();
}

void measure(int argc, char** argv, int rank, int ranks)
{
  atria::measuring::MemoryPeak peak;
  vtkNew<vtkAtriaVRMLReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkAtriaDualMesher> mesher;
  mesher->CacheStagesOff();
  mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
  mesher->SetSizeMax(std::atof(argv[2]));
  mesher->SetSizeMid(std::atof(argv[3]));
  mesher->SetSizeMin(std::atof(argv[4]));
  mesher->SetNumberOfLayers(argc > 5 ? std::atoi(argv[5]) : 1);
  mesher->SetBlockSize(argc > 6 ? std::atoi(argv[6]) : 0);
  mesher->SetInputConnection(reader->GetOutputPort());
  reader->UpdatePiece(rank, ranks, 0);
  std::array<double, 3> seconds{processorSeconds(), 0.0, 0.0};
  double made = 0.0; // when the mesher told of its end, before its mesh is dealt out
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&made);
  observer->SetCallback([](vtkObject* caller, unsigned long, void* data, void*) {
    double& end = *static_cast<double*>(data);
    end = end == 0.0 && static_cast<vtkAlgorithm*>(caller)->GetProgress() >= 1.0 ? processorSeconds() : end;
  });
  mesher->AddObserver(vtkCommand::ProgressEvent, observer);
  mesher->UpdatePiece(rank, ranks, 1);
  seconds[1] = processorSeconds();
  const std::array<std::int64_t, 2> sent{overRanks(messages, MPI_SUM), overRanks(bytes, MPI_SUM)};
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(0, mesher->GetOutputPort(0));
  quality->SetInputConnection(1, mesher->GetOutputPort(1));
  const double before = processorSeconds();
  quality->UpdatePiece(rank, ranks, 1);
  seconds[2] = processorSeconds() - before;
  const std::int64_t memory = peak.sinceLast();
  const std::int64_t others = overRanks(rank > 0 ? memory : 0, MPI_MAX);
  const std::int64_t own = ownCells(vtkUnstructuredGrid::SafeDownCast(mesher->GetOutputDataObject(0)));
  const auto elements = static_cast<double>(overRanks(own, MPI_SUM));
  const std::int64_t most = overRanks(own, MPI_MAX);
  const double inAll = static_cast<double>(overRanks(bytes, MPI_SUM));
  if (rank == 0)
  {
    std::printf("| %s | %d | %.0f | %lld | %.2f | %.2f | %.2f | %.0f | %.0f | %lld | %.1f | %.1f |\n",
                std::filesystem::path(argv[1]).stem().c_str(), ranks, elements, static_cast<long long>(most),
                made - seconds[0], seconds[1] - made, seconds[2], static_cast<double>(memory) * 1e-6,
                static_cast<double>(others) * 1e-6, static_cast<long long>(sent[0]),
                static_cast<double>(sent[1]) * 1e-6, (inAll - static_cast<double>(sent[1])) * 1e-6);
  }
}

} // namespace

int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> mpi;
  mpi->Initialize(&argc, &argv);
  if (argc < 5)
  {
    std::fprintf(stderr, "usage: %s MODEL SIZE_MAX SIZE_MID SIZE_MIN [LAYERS [BLOCK_SIZE]]\n", argv[0]);
    mpi->Finalize();
    return 2;
  }
  atria::keepFreedMemory();
  useThreads(1);
  vtkMultiProcessController::SetGlobalController(mpi);
  measure(argc, argv, mpi->GetLocalProcessId(), mpi->GetNumberOfProcesses());
  vtkMultiProcessController::SetGlobalController(nullptr);
  mpi->Finalize();
  return 0;
}
