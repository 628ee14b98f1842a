// SPDX-License-Identifier: GPL-3.0-or-later
#include "OutputFiles.h"

#include "Console.h"
#include "Files.h"
#include "Platform.h"
#include "Workers.h"

#include <vtkAtriaMeshDivider.h>
#include <vtkCommunicator.h>
#include <vtkDummyController.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

namespace atria::tool {

namespace fs = std::filesystem;

namespace {

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

} // namespace atria::tool
