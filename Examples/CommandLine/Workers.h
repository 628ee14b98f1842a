// SPDX-License-Identifier: GPL-3.0-or-later
/// The MPI ranks that mpiexec has started the program on. The first one does all that the program does alone, and talks
/// to the user. The others wait for it, asleep, for meshes to make and files to write together, and end with its
/// status. Without mpiexec there is one rank, and MPI is not started. A build without VTK's MPI ends with an error
/// under mpiexec.
#pragma once

#include <functional>
#include <memory>
#include <string>

class vtkMultiProcessController;

namespace atria::tool {

class Workers
{
public:
  /// Starts MPI if a launcher says that it started several ranks.
  Workers(int* argc, char*** argv);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// True if there are other ranks.
  explicit operator bool() const;
  bool isWorker() const;

  /// Does a task with all ranks; runs on all but the first.
  using Work = std::function<void(const std::string& task, vtkMultiProcessController&)>;
  /// On all but the first rank: does the tasks of the first one until its end, and returns its status.
  int serve(const Work& work);
  /// On the first rank, if there are others: has them do a task, and does its own part with them. Meanwhile VTK's
  /// global controller is that of the ranks.
  void doTogether(const std::string& task, const std::function<void(vtkMultiProcessController&)>& own) const;
  /// On the first rank: ends the others with a status, and returns it.
  int end(int status);

private:
  class Ranks;
  std::unique_ptr<Ranks> ranks; ///< null for one
};

} // namespace atria::tool
