// SPDX-License-Identifier: GPL-3.0-or-later
/// The subcommands. Each declares its options on the application and, when it is the one asked for, runs.
#pragma once

#include <stdexcept>
#include <string>

namespace CLI {
class App;
}

namespace atria::tool {

class Console;
class Workers;

/// What the program's exit status means. 1 is left to failures that are nobody's input, such as a full disk.
enum ExitStatus : int
{
  Done = 0,
  Failed = 1,
  Usage = 2,
  BadInput = 3,
  MeshNotValid = 4,
  ChecksFailed = 5, ///< the mesh is valid, but what is written fails checks of checkMesh
  // 6: the page of a case is written, but its runs are not to be believed; see atria.report
  Interrupted = 130 ///< by Ctrl-C; what shells say too
};

/// Ends the program with a status and a message for people.
class Failure : public std::runtime_error
{
public:
  Failure(ExitStatus withStatus, const std::string& message) : std::runtime_error(message), status(withStatus) {}
  ExitStatus status;
};

/// The status of a mesh that is written.
inline ExitStatus statusOf(long long invalidElements, bool checksFail)
{
  return invalidElements > 0 ? MeshNotValid : checksFail ? ChecksFailed : Done;
}

/// A subcommand stores its result in `status` from CLI11's callback.
void addMeshCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status);
void addInspectCommand(CLI::App& app, Console& console, ExitStatus& status);
void addQualityCommand(CLI::App& app, Console& console, ExitStatus& status);
void addImproveCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status);
void addConvertCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status);
void addCaseCommand(CLI::App& app, Console& console, ExitStatus& status);
/// Goes on as another program, whose exit status is the result.
void addReportCommand(CLI::App& app);

} // namespace atria::tool
