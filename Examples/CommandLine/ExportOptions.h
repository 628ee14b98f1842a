// SPDX-License-Identifier: GPL-3.0-or-later
/// The options that write a mesh in formats of solvers.
#pragma once

#include "Files.h"
#include "Report.h"

#include <string>
#include <vector>

class vtkMultiProcessController;

namespace CLI {
class App;
}

namespace atria::tool {

class Console;
class Workers;

struct ExportOptions
{
  std::string openfoam;
  bool ascii = false;
  int processors = 1;
  bool saysProcessors = false; ///< or takes them as they are by default
  bool processorsOnly = false; ///< without the whole mesh, if ranks write them
  std::string fluent;
  std::string cgns;
  std::string su2;
  bool restoreOffset = false;

  /// Those that are asked for.
  std::vector<std::string> targets() const;
  /// Whether ranks can write all of these of the pieces that they have.
  bool needNoWhole() const;
};

void declareExportOptions(CLI::App& command, ExportOptions& options);

/// Throws Failure(Usage) for names and folders that cannot be, and for a format that this build does not have.
void checkExportOptions(const ExportOptions& options);

/// `patches` may be null, for those recorded in the mesh. Prints a warning for each check that fails. Returns what was
/// merged in the OpenFOAM case and what checkMesh says of it: {merged_cells, added_cells, merged_faces, failed_checks,
/// checks}; null where no case is written. With workers, and unless a number of processors is said, each rank writes
/// the folder of the case's processor of its number: of what each has where the mesh is divided.
Json writeExports(const ExportOptions& options, const MeshPiece& own, bool isDivided, Console& console,
                  const Workers& workers);

/// A worker's part of a case that all ranks write.
void writeCaseWithOthers(const Json& task, const MeshPiece& own, vtkMultiProcessController& controller);

} // namespace atria::tool
