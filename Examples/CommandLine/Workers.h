// SPDX-License-Identifier: GPL-3.0-or-later
/// The MPI ranks that mpiexec has started the program on. The first one does what the program does alone and talks to
/// people; the others wait for it, asleep, and end with its status. Without mpiexec, or in a build without VTK's MPI,
/// there is one rank, and MPI is not started.
#pragma once

#include <memory>

namespace atria::tool {

class Workers
{
public:
  /// Starts MPI if a launcher says that it started several ranks.
  Workers(int* argc, char*** argv);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Whether there are others.
  explicit operator bool() const;
  bool isWorker() const;

  /// On all but the first rank: waits for its end, and returns its status.
  int serve();
  /// On the first: ends the others with a status, and returns it.
  int end(int status);

private:
  class Ranks;
  std::unique_ptr<Ranks> ranks; ///< null for one
};

} // namespace atria::tool
