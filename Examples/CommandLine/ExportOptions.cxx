// SPDX-License-Identifier: GPL-3.0-or-later
#include "ExportOptions.h"

#include "Commands.h"
#include "Console.h"
#include "Files.h"
#include "Numbers.h"
#include "OutputFiles.h"
#include "Workers.h"

#include <vtkAtriaAbaqusWriter.h>
#include <vtkAtriaCGNSWriter.h>
#include <vtkAtriaFluentWriter.h>
#include <vtkAtriaGmshWriter.h>
#include <vtkAtriaOpenFOAMWriter.h>
#include <vtkAtriaSU2Writer.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

namespace atria::tool {

std::vector<std::string> ExportOptions::targets() const
{
  std::vector<std::string> all;
  for (const std::string* target : {&openfoam, &fluent, &cgns, &su2, &gmsh, &abaqus})
  {
    if (!target->empty())
    {
      all.push_back(*target);
    }
  }
  return all;
}

bool ExportOptions::needNoWhole() const
{
  return targets().empty() || (processorsOnly && !saysProcessors && targets().size() == 1 && !openfoam.empty());
}

void declareExportOptions(CLI::App& command, ExportOptions& options)
{
  command.add_option("--openfoam", options.openfoam, "Also write an OpenFOAM case with the mesh")->type_name("DIR");
  command.add_flag("--ascii", options.ascii, "Write the OpenFOAM case as text (default: binary, which is faster)");
  vtkNew<vtkAtriaOpenFOAMWriter> standard;
  options.processors = standard->GetNumberOfProcessors();
  command
      .add_option("--processors", options.processors,
                  "Write the OpenFOAM case also divided among N processors (under mpiexec, unless this is "
                  "said: its ranks, each of which writes its own part)")
      ->each([&options](const std::string&) { options.saysProcessors = true; })
      ->capture_default_str()
      ->check(numberIn(standard->GetNumberOfProcessorsMinValue(), standard->GetNumberOfProcessorsMaxValue()))
      ->type_name("N");
  command.add_flag(
      "--processors-only", options.processorsOnly,
      "Write these without the whole mesh, under mpiexec: of a mesh in pieces no rank needs memory for it");
  command.add_option("--fluent", options.fluent, "Also write a Fluent mesh")->type_name("OUT.msh");
  command.add_option("--cgns", options.cgns, "Also write a CGNS file")->type_name("OUT.cgns");
  command.add_option("--su2", options.su2, "Also write an SU2 mesh, with polyhedra divided")->type_name("OUT.su2");
  command.add_option("--gmsh", options.gmsh, "Also write a Gmsh mesh; there must be no polyhedra (see --hex)")
      ->type_name("OUT.msh");
  command
      .add_option("--abaqus", options.abaqus,
                  "Also write a mesh for Abaqus and CalculiX; there must be no polyhedra and pyramids (see --hex)")
      ->type_name("OUT.inp");
  command.add_flag("--restore-offset", options.restoreOffset,
                   "Write these where the model was before --recenter of `atria mesh` moved it");
}

void checkExportOptions(const ExportOptions& options)
{
  const auto check = [](const char* option, const std::string& file, const char* ending) {
    if (!file.empty())
    {
      checkOutput(option, file, ending);
    }
  };
  check("--fluent", options.fluent, ".msh");
  check("--cgns", options.cgns, ".cgns");
  check("--su2", options.su2, ".su2");
  check("--gmsh", options.gmsh, ".msh");
  check("--abaqus", options.abaqus, ".inp");
  if (!options.gmsh.empty() && options.gmsh == options.fluent)
  {
    throw Failure(Usage, "--fluent and --gmsh have the same file " + options.gmsh + "; name two");
  }
  if (!options.openfoam.empty())
  {
    checkFolder("--openfoam", options.openfoam);
  }
  if (!options.cgns.empty() && !vtkAtriaCGNSWriter::IsAvailable())
  {
    throw Failure(Usage, "--cgns: this atria was built without libcgns; choose another format");
  }
}

namespace {

void write(vtkAtriaMeshWriter* writer, const ExportOptions& options, const std::string& target,
           vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches, Console& console)
{
  writer->SetRestoreOffset(options.restoreOffset);
  writer->SetInputDataObject(0, mesh);
  writer->SetInputDataObject(1, patches);
  console.follow(writer, 0.9, 1.0);
  const bool written = writer->Write() != 0;
  throwIfErrors(console, Failed, target);
  if (!written)
  {
    throw Failure(Failed, target + " could not be written; check permissions and space");
  }
}

template <typename Writer>
void writeFile(const ExportOptions& options, const std::string& file, vtkUnstructuredGrid* mesh,
               vtkPartitionedDataSetCollection* patches, Console& console)
{
  if (!file.empty())
  {
    vtkNew<Writer> writer;
    writer->SetFileName(file.c_str());
    write(writer, options, file, mesh, patches, console);
  }
}

/// Returns the data that workers need for a case.
Json caseTask(const ExportOptions& options, bool hasPatches, bool isDivided)
{
  return {{"case", options.openfoam},         {"binary", !options.ascii}, {"offset", options.restoreOffset},
          {"whole", !options.processorsOnly}, {"patches", hasPatches},    {"divided", isDivided}};
}

/// Returns a rank's part: its own piece, or a part of the first rank's mesh.
MeshPiece partOf(const Json& task, const MeshPiece& held, vtkMultiProcessController& controller)
{
  const bool staysWhole = task["whole"].get<bool>();
  MeshPiece own = task["divided"].get<bool>() || staysWhole ? held : ownPart(held, controller);
  own.mesh = own.mesh ? own.mesh : vtkSmartPointer<vtkUnstructuredGrid>::New();
  const bool hasPatches = task["patches"].get<bool>();
  const auto none = hasPatches ? vtkSmartPointer<vtkPartitionedDataSetCollection>::New() : nullptr;
  own.patches = own.patches && hasPatches ? own.patches : none;
  return own;
}

/// `controller` is null for one rank.
void configure(vtkAtriaOpenFOAMWriter* writer, const Json& task, vtkMultiProcessController* controller)
{
  writer->SetCaseDirectory(task["case"].get<std::string>().c_str());
  writer->SetWriteBinary(task["binary"].get<bool>());
  writer->SetRestoreOffset(task["offset"].get<bool>());
  writer->SetWriteWholeMesh(task["whole"].get<bool>());
  if (controller)
  {
    writer->UseRanksAsProcessorsOn();
    writer->SetNumberOfPieces(controller->GetNumberOfProcesses());
    writer->SetPiece(controller->GetLocalProcessId());
  }
}

} // namespace

void writeCaseWithOthers(const Json& task, const MeshPiece& own, vtkMultiProcessController& controller)
{
  const MeshPiece part = partOf(task, own, controller);
  vtkNew<vtkAtriaOpenFOAMWriter> writer;
  configure(writer, task, &controller);
  writer->SetInputDataObject(0, part.mesh);
  writer->SetInputDataObject(1, part.patches);
  writer->Write(); // the first rank reports errors
}

Json writeExports(const ExportOptions& options, const MeshPiece& own, bool isDivided, Console& console,
                  const Workers& workers)
{
  vtkUnstructuredGrid* const mesh = own.mesh;
  vtkPartitionedDataSetCollection* const patches = own.patches;
  Json openfoam;
  if (!options.openfoam.empty())
  {
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetNumberOfProcessors(options.processors);
    const Json task = caseTask(options, patches != nullptr, isDivided);
    const auto writeCase = [&](vtkMultiProcessController* controller) {
      const MeshPiece part = controller ? partOf(task, own, *controller) : own;
      configure(writer, task, controller);
      write(writer, options, options.openfoam, part.mesh, part.patches, console);
    };
    if (workers && !options.saysProcessors)
    {
      workers.doTogether(task.dump(), [&](vtkMultiProcessController& controller) { writeCase(&controller); });
    }
    else
    {
      writeCase(nullptr);
    }
    openfoam = {{"merged_cells", writer->GetNumberOfMergedCells()},
                {"added_cells", writer->GetNumberOfAddedCells()},
                {"merged_faces", writer->GetNumberOfMergedFaces()},
                {"failed_checks", writer->GetNumberOfFailedChecks()},
                {"checks", checksOf(writer->GetChecks())}};
  }
  writeFile<vtkAtriaFluentWriter>(options, options.fluent, mesh, patches, console);
  writeFile<vtkAtriaCGNSWriter>(options, options.cgns, mesh, patches, console);
  writeFile<vtkAtriaSU2Writer>(options, options.su2, mesh, patches, console);
  writeFile<vtkAtriaGmshWriter>(options, options.gmsh, mesh, patches, console); // these may refuse the mesh
  writeFile<vtkAtriaAbaqusWriter>(options, options.abaqus, mesh, patches, console);
  return openfoam;
}

} // namespace atria::tool
