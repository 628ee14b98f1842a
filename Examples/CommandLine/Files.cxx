// SPDX-License-Identifier: GPL-3.0-or-later
#include "Files.h"

#include "Console.h"
#include "MeshSums.h"
#include "Platform.h"
#include "Report.h"
#include "Workers.h"

#include <Support/Warning.h>

#include <vtkAppendFilter.h>
#include <vtkAtriaMeshDivider.h>
#include <vtkAtriaModelReader.h>
#include <vtkAtriaVRMLReader.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkCommunicator.h>
#include <vtkDummyController.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
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

/// A folder beside a file, in which the file and those that belong to it are written. The destructor removes it.
class Unfinished
{
public:
  explicit Unfinished(const std::string& file)
      : target(file), folder(target.parent_path() / ('.' + target.filename().string() + ".unfinished"))
  {
    std::error_code error;
    fs::remove_all(folder, error); // left by a process that was killed
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

/// Returns the reason why a file of up to so many bytes cannot be written in a folder; empty if there is none. VTK's
/// writers do not report it.
std::string hindrance(const fs::path& folder, double bytes)
{
  std::ostringstream text;
  text.precision(3);
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  const std::optional<double> most = largestFile();
  if (!error && static_cast<double>(space.available) < bytes)
  {
    text << "the disk is full, with " << static_cast<double>(space.available) / 1e6 << " MB left";
  }
  else if (most && *most < bytes)
  {
    text << "files may have " << *most / 1e6 << " MB at most (ulimit -f)";
  }
  return text.str();
}

double bytesOf(vtkDataObject* data) { return 1024.0 * static_cast<double>(data->GetActualMemorySize()); }

/// Sets appended and compressed data. VTK's writers share these methods, but not all of them a base.
template <typename Writer> void prepare(Writer* writer, const std::string& file, vtkDataObject* data)
{
  writer->SetFileName(file.c_str());
  writer->SetInputDataObject(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4(); // ten times as fast as zlib, for files twice as large
}

/// Writes a VTK XML file.
template <typename Writer>
void writeCompressed(Writer* writer, const std::string& file, vtkDataObject* data, Console& console)
{
  const Unfinished unfinished(file);
  prepare(writer, unfinished.file(), data);
  console.follow(writer, 0.9, 1.0, "Writing");
  const bool written = writer->Write() != 0;
  // The uncompressed size is an upper bound for the file's.
  const std::string reason =
      written && !console.hasErrors() ? "" : hindrance(fs::path(unfinished.file()).parent_path(), bytesOf(data));
  if (!reason.empty())
  {
    console.takeErrors(); // they do not give the reason
    throw Failure(Failed, file + " could not be written: " + reason);
  }
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
  // An error that already names its file gets no prefix.
  std::string text = errors.front().find(about) == std::string::npos ? about + ": " : "";
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    text += (i == 0 ? "" : "\n") + errors[i];
  }
  throw Failure(status, text);
}

namespace {

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

} // namespace

namespace {

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

namespace {

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
  const fs::path parent = fs::path(file).parent_path();
  if (const std::string reason = hindrance(parent.empty() ? "." : parent, bytesOf(patches)); !reason.empty())
  {
    throw Failure(Failed, file + " is not written: " + reason); // VTK's writer of collections would crash
  }
  vtkNew<vtkXMLPartitionedDataSetCollectionWriter> writer;
  writeCompressed(writer.Get(), file, patches, console);
}

bool isInPieces(const std::string& file) { return fs::path(file).extension() == ".pvtu"; }

MeshPiece ownPart(const MeshPiece& whole, vtkMultiProcessController& controller)
{
  vtkNew<vtkAtriaMeshDivider> divider;
  divider->SetInputDataObject(0, whole.mesh ? whole.mesh : vtkNew<vtkUnstructuredGrid>());
  divider->SetInputDataObject(1, whole.patches ? whole.patches : vtkNew<vtkPartitionedDataSetCollection>());
  divider->UpdatePiece(controller.GetLocalProcessId(), controller.GetNumberOfProcesses(), 1);
  return {divider->GetOutput(), divider->GetPatches()};
}

namespace {

/// Writes this rank's piece; all ranks call it at the same time. Returns true if all ranks succeeded.
bool writeOwnPieces(const Json& task, const MeshPiece& held, vtkMultiProcessController& controller)
{
  const int rank = controller.GetLocalProcessId();
  const int ranks = controller.GetNumberOfProcesses();
  const MeshPiece own = task["divided"].get<bool>() ? held : ownPart(held, controller);
  vtkNew<vtkXMLPUnstructuredGridWriter> meshWriter;
  prepare(meshWriter.Get(), task["mesh"].get<std::string>(), own.mesh);
  meshWriter->SetController(&controller);
  meshWriter->SetNumberOfPieces(ranks);
  meshWriter->SetStartPiece(rank);
  meshWriter->SetEndPiece(rank);
  int done = meshWriter->Write();
  if (const auto file = task["patches"].get<std::string>(); !file.empty())
  {
    vtkNew<vtkXMLPartitionedDataSetCollectionWriter> patchesWriter;
    prepare(patchesWriter.Get(), file, own.patches);
    patchesWriter->SetController(&controller);
    done = std::min(patchesWriter->Write(), done);
  }
  int allDone = done;
  controller.AllReduce(&done, &allDone, 1, vtkCommunicator::MIN_OP);
  return allDone == 1;
}

} // namespace

void writePieces(const std::string& meshFile, const std::string& patchesFile, const MeshPiece& own, bool isDivided,
                 Console& console, const Workers& workers)
{
  const Unfinished unfinishedMesh(meshFile);
  std::optional<Unfinished> unfinishedPatches;
  Json task = {{"mesh", unfinishedMesh.file()}, {"patches", ""}, {"divided", isDivided}};
  if (!patchesFile.empty())
  {
    task["patches"] = unfinishedPatches.emplace(patchesFile).file();
  }
  bool written = false;
  const auto write = [&](vtkMultiProcessController& controller) { written = writeOwnPieces(task, own, controller); };
  if (workers)
  {
    workers.doTogether(task.dump(), write);
  }
  else
  {
    write(*vtkNew<vtkDummyController>());
  }
  throwIfErrors(console, Failed, meshFile);
  if (!written)
  {
    throw Failure(Failed, meshFile + " could not be written by all ranks; check permissions and space");
  }
  unfinishedMesh.complete();
  if (unfinishedPatches)
  {
    unfinishedPatches->complete();
  }
}

void writePiecesWithOthers(const Json& task, const MeshPiece& own, vtkMultiProcessController& controller)
{
  writeOwnPieces(task, own, controller);
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

void checkFolder(const std::string& option, const std::string& folder)
{
  fs::path path = fs::path(folder).lexically_normal();
  path = path.has_filename() ? path : path.parent_path(); // without the last slash
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (fs::exists(path) && !fs::is_directory(path))
  {
    throw Failure(Usage, option + " " + folder + " is a file; name a folder");
  }
  if (!fs::is_directory(parent))
  {
    throw Failure(Usage, option + " " + folder + ": the folder " + parent.string() + " does not exist; make it first");
  }
}

void updateOrFail(vtkAlgorithm* algorithm, const std::string& about, Console& console)
{
  algorithm->Update();
  throwIfErrors(console, BadInput, about);
}

} // namespace atria::tool
