// SPDX-License-Identifier: GPL-3.0-or-later
/// Workers of a build with VTK's MPI.
#include "Workers.h"

#include <vtkMPIController.h>
#include <vtkMultiProcessStream.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace atria::tool {

namespace {

constexpr int first = 0;
constexpr int taskTag = 1;

/// True if Open MPI, MPICH, Intel's MPI or a process manager has set several ranks. A single process need not wait for
/// MPI to start.
bool isStartedOnRanks(int argc, char** argv)
{
  const auto isSeveral = [](const char* name) {
    const char* value = std::getenv(name);
    return value && std::atoi(value) > 1;
  };
  constexpr std::array sizes{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"};
  const bool isBySlurm = std::getenv("PMIX_RANK") && isSeveral("SLURM_STEP_NUM_TASKS");
  // `atria report` continues as another program, which knows nothing of ranks.
  const auto isReport = [](const char* argument) { return std::string_view(argument) == "report"; };
  return (isBySlurm || std::ranges::any_of(sizes, isSeveral)) && std::none_of(argv + 1, argv + argc, isReport);
}

/// Makes the ranks known to VTK's filters and writers during its lifetime.
class InGlobalPlace
{
public:
  explicit InGlobalPlace(vtkMultiProcessController* controller)
  {
    vtkMultiProcessController::SetGlobalController(controller);
  }
  InGlobalPlace(const InGlobalPlace&) = delete;
  InGlobalPlace& operator=(const InGlobalPlace&) = delete;
  ~InGlobalPlace() { vtkMultiProcessController::SetGlobalController(nullptr); }
};

} // namespace

class Workers::Ranks
{
public:
  Ranks(int* argc, char*** argv) { mpi->Initialize(argc, argv); }
  ~Ranks() { mpi->Finalize(); }
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// Sends others a task, or with none the end and its status.
  void tellOthers(int status, const std::string& task)
  {
    for (int rank = first + 1; rank < mpi->GetNumberOfProcesses(); ++rank)
    {
      vtkMultiProcessStream message;
      message << status << task;
      mpi->Send(message, rank, taskTag);
    }
  }

  vtkNew<vtkMPIController> mpi;
};

Workers::Workers(int* argc, char*** argv)
    : ranks(isStartedOnRanks(*argc, *argv) ? std::make_unique<Ranks>(argc, argv) : nullptr)
{
}

Workers::~Workers() = default;

Workers::operator bool() const { return ranks && ranks->mpi->GetNumberOfProcesses() > 1; }

bool Workers::isWorker() const { return ranks && ranks->mpi->GetLocalProcessId() != first; }

int Workers::serve(const Work& work)
{
  for (;;)
  {
    // MPI's own waiting would take a core from the first rank's threads.
    for (int is = 0; !is;)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      ranks->mpi->Iprobe(first, taskTag, &is, nullptr);
    }
    vtkMultiProcessStream message;
    ranks->mpi->Receive(message, first, taskTag);
    int status = 0;
    std::string task;
    message >> status >> task;
    if (task.empty())
    {
      return status;
    }
    const InGlobalPlace place(ranks->mpi);
    work(task, *ranks->mpi);
  }
}

void Workers::doTogether(const std::string& task, const std::function<void(vtkMultiProcessController&)>& own) const
{
  ranks->tellOthers(0, task);
  const InGlobalPlace place(ranks->mpi);
  own(*ranks->mpi);
}

int Workers::end(int status)
{
  if (*this)
  {
    ranks->tellOthers(status, {});
  }
  return status;
}

} // namespace atria::tool
