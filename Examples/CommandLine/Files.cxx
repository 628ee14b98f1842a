// SPDX-License-Identifier: GPL-3.0-or-later
#include "Files.h"

#include "Console.h"

#include <vtkAtriaModelReader.h>
#include <vtkAtriaOpenFOAMWriter.h>
#include <vtkAtriaVRMLReader.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

namespace atria::tool {

namespace fs = std::filesystem;

namespace {

void checkReadable(const std::string& file)
{
  if (fs::is_directory(file))
  {
    throw Failure(BadInput, file + " is a folder; name a file");
  }
  if (!fs::exists(file))
  {
    throw Failure(BadInput, file + " does not exist; check the path");
  }
  if (!std::ifstream(file).good())
  {
    throw Failure(BadInput, file + " cannot be opened; check its permissions");
  }
}

void printWarnings(vtkAtriaSurfaceReader* reader, const std::string& file, Console& console)
{
  constexpr vtkIdType most = 20;
  vtkStringArray* warnings = reader->GetWarnings();
  for (vtkIdType i = 0; i < std::min(most, warnings->GetNumberOfValues()); ++i)
  {
    console.warning(warnings->GetValue(i)); // names file and line
  }
  if (const vtkIdType all = reader->GetNumberOfWarnings(); all > most)
  {
    console.warning(file + ": and " + std::to_string(all - most) + " more; see atria inspect --json");
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

/// A folder beside a file, in which that is written with what belongs to it. It is removed whatever happens.
class Unfinished
{
public:
  explicit Unfinished(const std::string& file)
      : target(file), folder(target.parent_path() / ('.' + target.filename().string() + ".unfinished"))
  {
    std::error_code error;
    fs::remove_all(folder, error); // of a process that was killed
    fs::create_directory(folder, error);
    if (error)
    {
      throw Failure(Failed, file + " could not be written: " + error.message());
    }
  }
  ~Unfinished()
  {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  std::string file() const { return (folder / target.filename()).string(); }

  void complete() const
  {
    Console::throwIfInterrupted();
    std::error_code error;
    const std::vector<fs::directory_entry> entries(fs::recursive_directory_iterator(folder), {});
    for (const fs::directory_entry& entry : entries)
    {
      const fs::path to = target.parent_path() / fs::relative(entry.path(), folder);
      if (entry.is_directory())
      {
        fs::create_directory(to, error);
      }
      else
      {
        fs::rename(entry.path(), to, error);
      }
      if (error)
      {
        throw Failure(Failed, to.string() + " could not be written: " + error.message());
      }
    }
  }

private:
  fs::path target;
  fs::path folder;
};

/// A VTK XML file, appended and compressed. VTK's writers share these methods, but not all of them a base.
template <typename Writer>
void writeCompressed(Writer* writer, const std::string& file, vtkDataObject* data, Console& console)
{
  const Unfinished unfinished(file);
  writer->SetFileName(unfinished.file().c_str());
  console.follow(writer, 0.9, 1.0, "Writing");
  writer->SetInputDataObject(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4(); // ten times as fast as zlib, for files twice as large
  const bool written = writer->Write() != 0;
  throwIfErrors(console, Failed, file);
  if (!written || !fs::exists(unfinished.file()))
  {
    throw Failure(Failed, file + " could not be written; check permissions and space");
  }
  unfinished.complete();
}

} // namespace

void throwIfErrors(Console& console, ExitStatus status, const std::string& about)
{
  Console::throwIfInterrupted();
  const std::vector<std::string> errors = console.takeErrors();
  if (errors.empty())
  {
    return;
  }
  // An error that already names its file is not prefixed with it again.
  std::string text = errors.front().find(about) == std::string::npos ? about + ": " : "";
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    text += (i == 0 ? "" : "\n") + errors[i];
  }
  throw Failure(status, text);
}

namespace {

/// A file that ends so is read as VRML even if it has no header.
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
    throw Failure(BadInput, file + " is of no format that is known; give " + modelFormats + ", unpacked but for VRML");
  }
  return vtkSmartPointer<vtkAtriaVRMLReader>::New();
}

} // namespace

vtkSmartPointer<vtkAtriaSurfaceReader> readModel(const std::string& file, const ModelOptions& options, Console& console)
{
  checkReadable(file);
  const vtkSmartPointer<vtkAtriaSurfaceReader> reader = readerFor(file);
  // An observer keeps the reader's one summarizing warning away from the console: printWarnings tells more.
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
  return reader;
}

vtkSmartPointer<vtkUnstructuredGrid> readMesh(const std::string& file, Console& console)
{
  checkReadable(file);
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

void writeMesh(const std::string& file, vtkUnstructuredGrid* mesh, Console& console)
{
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writeCompressed(writer.Get(), file, mesh, console);
}

void writePolyData(const std::string& file, vtkPolyData* data, Console& console)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writeCompressed(writer.Get(), file, data, console);
}

void writePatches(const std::string& file, vtkPartitionedDataSetCollection* patches, Console& console)
{
  vtkNew<vtkXMLPartitionedDataSetCollectionWriter> writer;
  writeCompressed(writer.Get(), file, patches, console);
}

MergedParts writeOpenFOAM(const std::string& folder, vtkUnstructuredGrid* mesh,
                          vtkPartitionedDataSetCollection* patches, bool restoreOffset, Console& console)
{
  vtkNew<vtkAtriaOpenFOAMWriter> writer;
  writer->SetRestoreOffset(restoreOffset);
  writer->WriteBinaryOn();
  writer->SetInputDataObject(0, mesh);
  writer->SetInputDataObject(1, patches);
  writer->SetCaseDirectory(folder.c_str());
  console.follow(writer, 0.9, 1.0);
  const bool written = writer->Write() != 0;
  throwIfErrors(console, Failed, folder);
  if (!written)
  {
    throw Failure(Failed, folder + ": the OpenFOAM case could not be written; check permissions and space");
  }
  return {writer->GetNumberOfMergedCells(), writer->GetNumberOfMergedFaces(), writer->GetNumberOfAddedCells()};
}

void writeText(const std::string& file, const std::string& text)
{
  const Unfinished unfinished(file);
  std::ofstream stream(unfinished.file());
  stream << text;
  stream.close();
  if (!stream)
  {
    throw Failure(Failed, file + " could not be written; check permissions and space");
  }
  unfinished.complete();
}

void checkOutput(const std::string& option, const std::string& file, const std::string& ending)
{
  const fs::path path(file);
  if (path.extension() != ending)
  {
    throw Failure(Usage, option + " " + file + ": the file's name must end in " + ending);
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
  {
    throw Failure(Usage, option + " " + file + ": the folder " + folder.string() + " does not exist; make it first");
  }
}

void updateOrFail(vtkAlgorithm* algorithm, const std::string& about, Console& console)
{
  algorithm->Update();
  throwIfErrors(console, BadInput, about);
}

} // namespace atria::tool
