// SPDX-License-Identifier: GPL-3.0-or-later
/// Workers of a build without VTK's MPI.
#include "Workers.h"

#include <cstdlib>
#include <iostream>
#include <string>

namespace atria::tool {

class Workers::Ranks
{
};

/// Ends the program if a launcher of MPI has started several: each would make the same mesh and write the same files.
Workers::Workers(int*, char***)
{
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"})
  {
    const char* const started = std::getenv(variable);
    if (started && std::atoi(started) > 1)
    {
      std::cerr
          << "atria: error: it was started on " << started
          << " ranks, but the VTK that it was built with has no MPI: start it without mpiexec, or build it with a "
             "VTK that has the module ParallelMPI\n";
      std::exit(EXIT_FAILURE);
    }
  }
}

Workers::~Workers() = default;

Workers::operator bool() const { return false; }

bool Workers::isWorker() const { return false; }

int Workers::serve(const Work&) { return 0; }

void Workers::doTogether(const std::string&, const std::function<void(vtkMultiProcessController&)>&) const {}

int Workers::end(int status) { return status; }

} // namespace atria::tool
