// SPDX-License-Identifier: GPL-3.0-or-later
#include "InputFiles.h"

#include "Console.h"
#include "Files.h"
#include "MeshSums.h"

#include <Support/Warning.h>

#include <vtkAppendFilter.h>
#include <vtkAtriaMeshDivider.h>
#include <vtkAtriaModelReader.h>
#include <vtkAtriaVRMLReader.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

namespace atria::tool {

namespace fs = std::filesystem;

namespace {

void printWarnings(vtkAtriaSurfaceReader* reader, const std::string& file, Console& console)
{
  constexpr std::size_t most = 20;
  vtkStringArray* texts = reader->GetWarnings();
  std::vector<Warning> warnings;
  for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
  {
    warnings.push_back({texts->GetValue(i)}); // the gravest are first
  }
  vtkIdType more = reader->GetNumberOfWarnings();
  warnings = counted(warnings);
  warnings.resize(std::min(warnings.size(), most));
  for (const Warning& warning : warnings)
  {
    console.warning(warning.text); // names file and line
    more -= static_cast<vtkIdType>(warning.count);
  }
  if (more > 0)
  {
    console.warning(file + ": and " + std::to_string(more) + " more; see atria inspect --json");
  }
}

void printNotes(vtkAtriaSurfaceReader* reader, const std::string& file, Console& console)
{
  constexpr vtkIdType most = 5;
  vtkStringArray* notes = reader->GetNotes();
  for (vtkIdType i = 0; i < std::min(most, notes->GetNumberOfValues()); ++i)
  {
    console.note(file + ": " + notes->GetValue(i));
  }
  if (const vtkIdType all = notes->GetNumberOfValues(); all > most)
  {
    console.note(file + ": and " + std::to_string(all - most) + " more notes; see atria inspect --json");
  }
}

/// True for endings that are read as VRML even without a header.
bool endsLikeVrml(const std::string& file)
{
  std::string name = fs::path(file).filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto ends = [&](std::string_view ending) {
    return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  };
  return ends(".wrl") || ends(".wrz") || ends(".wrl.gz") || ends(".vrml") || ends(".vrml.gz");
}

vtkSmartPointer<vtkAtriaSurfaceReader> readerFor(const std::string& file)
{
  if (vtkAtriaModelReader::CanReadFile(file.c_str()))
  {
    return vtkSmartPointer<vtkAtriaModelReader>::New();
  }
  if (!endsLikeVrml(file) && !vtkAtriaVRMLReader::CanReadFile(file.c_str()))
  {
    if (const std::string advice = vtkAtriaModelReader::GetExportAdvice(file.c_str()); !advice.empty())
    {
      throw Failure(BadInput, file + ' ' + advice);
    }
    throw Failure(BadInput, file + " is of no format that is known; give " + modelFormats + ", unpacked but for VRML");
  }
  return vtkSmartPointer<vtkAtriaVRMLReader>::New();
}

void checkArea(vtkPolyData* model, const std::string& file, Console& console)
{
  const double area = areaOf(model);
  if (area == 0.0)
  {
    throw Failure(BadInput, file + ": the model has no extent: no face has an area; check the scale it is given in");
  }
  if (!std::isfinite(area))
  {
    console.warning(file + ": areas are not finite, as coordinates are too large; check the unit and the scale");
  }
}

/// Reads a mesh as it was before it was divided. Pieces are read one by one. If they are read at once and some have no
/// polyhedra, VTK 9.1 gives the faces of polyhedra to other elements.
vtkSmartPointer<vtkUnstructuredGrid> readPieces(const std::string& file, Console& console)
{
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  console.follow(reader, 0.0, 0.5, "Reading the mesh");
  reader->UpdateInformation();
  vtkNew<vtkAppendFilter> pieces;
  for (int piece = 0; piece < reader->GetNumberOfPieces(); ++piece)
  {
    reader->UpdatePiece(piece, reader->GetNumberOfPieces(), 0);
    vtkNew<vtkUnstructuredGrid> read;
    read->ShallowCopy(reader->GetOutput());
    pieces->AddInputData(read);
  }
  throwIfErrors(console, BadInput, file);
  pieces->Update();
  pieces->GetOutput()->GetFieldData()->PassData(reader->GetOutput()->GetFieldData());
  vtkNew<vtkAtriaMeshDivider> divider;
  divider->SetInputDataObject(0, pieces->GetOutput());
  divider->Update();
  throwIfErrors(console, BadInput, file);
  return divider->GetOutput();
}

} // namespace

vtkSmartPointer<vtkAtriaSurfaceReader> readModel(const std::string& file, const ModelOptions& options, Console& console)
{
  checkReadable(file);
  vtkSmartPointer<vtkAtriaSurfaceReader> reader = readerFor(file);
  // An observer keeps the reader's one summarizing warning away from the console: printWarnings prints more.
  vtkNew<vtkCallbackCommand> silence;
  reader->AddObserver(vtkCommand::WarningEvent, silence);
  reader->SetFileName(file.c_str());
  configure(reader, options);
  console.follow(reader, 0.0, 0.05);
  reader->Update();
  printWarnings(reader, file, console); // they may say why there is an error
  throwIfErrors(console, BadInput, file);
  printNotes(reader, file, console);
  if (reader->GetOutput()->GetNumberOfCells() == 0)
  {
    throw Failure(BadInput, file + " holds no surfaces; export the model with its faces");
  }
  checkArea(reader->GetOutput(), file, console);
  return reader;
}

vtkSmartPointer<vtkUnstructuredGrid> readMesh(const std::string& file, Console& console)
{
  checkReadable(file);
  if (isInPieces(file))
  {
    return readPieces(file, console);
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(file.c_str()))
  {
    console.takeErrors();
    throw Failure(BadInput,
                  file + " is not a VTK XML unstructured grid; give a .vtu file, such as `atria mesh` writes");
  }
  reader->SetFileName(file.c_str());
  console.follow(reader, 0.0, 0.5, "Reading the mesh");
  reader->Update();
  throwIfErrors(console, BadInput, file);
  return reader->GetOutput();
}

vtkSmartPointer<vtkPartitionedDataSetCollection> readPatches(const std::string& file, Console& console)
{
  checkReadable(file);
  vtkNew<vtkXMLPartitionedDataSetCollectionReader> reader;
  if (!reader->CanReadFile(file.c_str()))
  {
    console.takeErrors();
    throw Failure(BadInput, file + " holds no patches; give a .vtpc file, such as `atria mesh --patches` writes");
  }
  reader->SetFileName(file.c_str());
  console.follow(reader, 0.5, 0.5, "Reading patches");
  reader->Update();
  throwIfErrors(console, BadInput, file);
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches =
      vtkPartitionedDataSetCollection::SafeDownCast(reader->GetOutputDataObject(0));
  return patches;
}

} // namespace atria::tool
