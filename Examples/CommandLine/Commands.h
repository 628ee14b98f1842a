// SPDX-License-Identifier: GPL-3.0-or-later
/// The subcommands. Each declares its options on the application, and runs if it is the one requested.
#pragma once

#include <stdexcept>
#include <string>

namespace CLI {
class App;
}

namespace atria::tool {

class Console;
class Workers;

/// Meanings of the program's exit status. 1 is left to failures that no input causes, such as a full disk.
enum ExitStatus : int
{
  Done = 0,
  Failed = 1,
  Usage = 2,
  BadInput = 3,
  MeshNotValid = 4,
  ChecksFailed = 5, ///< the mesh is valid, but the written one fails checks of checkMesh
  // 6: the page of a case is written, but its runs are not credible; see atria.report
  Interrupted = 130 ///< Ctrl-C was pressed; shells report the same
};

/// Ends the program with a status and a message for the user.
class Failure : public std::runtime_error
{
public:
  Failure(ExitStatus withStatus, const std::string& message) : std::runtime_error(message), status(withStatus) {}
  ExitStatus status;
};

/// Returns the status for a written mesh.
inline ExitStatus statusOf(long long invalidElements, bool checksFail)
{
  return invalidElements > 0 ? MeshNotValid : checksFail ? ChecksFailed : Done;
}

/// Add a subcommand, which stores its result in `status` from CLI11's callback.
void addMeshCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status);
void addInspectCommand(CLI::App& app, Console& console, ExitStatus& status);
void addQualityCommand(CLI::App& app, Console& console, ExitStatus& status);
void addImproveCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status);
void addConvertCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status);
void addClimateCommand(CLI::App& app, Console& console, ExitStatus& status);
void addCaseCommand(CLI::App& app, Console& console, ExitStatus& status);
/// Adds the subcommand that continues as another program; that program's exit status is the result.
void addReportCommand(CLI::App& app);

} // namespace atria::tool
