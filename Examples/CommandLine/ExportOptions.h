// SPDX-License-Identifier: GPL-3.0-or-later
/// The options that write a mesh in formats of solvers.
#pragma once

#include "OutputFiles.h"
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
  bool saysProcessors = false; ///< or takes the default
  bool processorsOnly = false; ///< without the whole mesh, if ranks write them
  std::string fluent;
  std::string cgns;
  std::string su2;
  std::string gmsh;
  std::string abaqus;
  bool restoreOffset = false;

  /// Returns the requested files and folders.
  std::vector<std::string> targets() const;
  /// True if ranks can write all of these from their pieces.
  bool needNoWhole() const;
};

void declareExportOptions(CLI::App& command, ExportOptions& options);

/// Throws Failure(Usage) for invalid names and folders, and for a format that this build does not have.
void checkExportOptions(const ExportOptions& options);

/// Writes the requested formats. Without patches in `own`, those recorded in the mesh are used. Prints a warning for
/// each check that fails. Returns the merges in the OpenFOAM case and checkMesh's results: {merged_cells, added_cells,
/// merged_faces, failed_checks, checks}; null if no case is written. With workers, and unless a number of processors is
/// given, each rank writes the folder of the case's processor of its number, from its own piece if the mesh is divided.
Json writeExports(const ExportOptions& options, const MeshPiece& own, bool isDivided, Console& console,
                  const Workers& workers);

/// Writes a worker's part of a case that all ranks write.
void writeCaseWithOthers(const Json& task, const MeshPiece& own, vtkMultiProcessController& controller);

} // namespace atria::tool
