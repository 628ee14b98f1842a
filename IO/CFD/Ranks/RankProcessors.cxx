// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/RankProcessors.h"

#include "OutputFolders.h"
#include "ProcessorFolders.h"
#include "Support/Error.h"

#include <vtkMultiProcessController.h>
#include <vtkMultiProcessStream.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

namespace atria {

namespace {

namespace fs = std::filesystem;

constexpr int root = 0;
constexpr int tag = 27186;

template <typename List> void sendList(const List& list, int rank, vtkMultiProcessController& controller)
{
  const auto bytes = static_cast<vtkIdType>(list.size()) * static_cast<vtkIdType>(sizeof(*list.data()));
  controller.Send(&bytes, 1, rank, tag);
  if (bytes > 0)
  {
    controller.Send(reinterpret_cast<const unsigned char*>(list.data()), bytes, rank, tag);
  }
}

template <typename List> void receiveList(List& list, int rank, vtkMultiProcessController& controller)
{
  vtkIdType bytes = 0;
  controller.Receive(&bytes, 1, rank, tag);
  list.resize(static_cast<std::size_t>(bytes) / sizeof(*list.data()));
  if (bytes > 0)
  {
    controller.Receive(reinterpret_cast<unsigned char*>(list.data()), bytes, rank, tag);
  }
}

/// Calls `body` with all lists of numbers of a mesh, in a fixed order.
template <typename Mesh, typename F> void forLists(Mesh& part, F&& body)
{
  body(part.mesh.points);
  body(part.mesh.faceOffsets);
  body(part.mesh.facePoints);
  body(part.mesh.owner);
  body(part.mesh.neighbor);
  body(part.cells);
  body(part.points);
  body(part.faces);
  body(part.ofPatches);
  for (auto& zone : part.faceZones)
  {
    body(zone.faces);
    body(zone.flips);
  }
  for (auto& zone : part.cellZones)
  {
    body(zone.cells);
  }
}

/// Returns all texts and counts of a part.
vtkMultiProcessStream headOf(const ProcessorMesh& part)
{
  vtkMultiProcessStream head;
  head << static_cast<int>(part.patches.size());
  for (const PatchEntry& patch : part.patches)
  {
    head << patch.name << patch.comment << static_cast<vtkTypeInt64>(patch.firstFace)
         << static_cast<vtkTypeInt64>(patch.faceCount) << static_cast<int>(patch.entries.size());
    for (const auto& [key, value] : patch.entries)
    {
      head << key << value;
    }
  }
  head << static_cast<int>(part.faceZones.size());
  for (const FaceZone& zone : part.faceZones)
  {
    head << zone.name;
  }
  head << static_cast<int>(part.cellZones.size());
  for (const CellZone& zone : part.cellZones)
  {
    head << zone.name;
  }
  return head;
}

template <typename T> T take(vtkMultiProcessStream& head)
{
  T value{};
  head >> value;
  return value;
}

template <typename List> void takeCount(vtkMultiProcessStream& head, List& list)
{
  list.resize(static_cast<std::size_t>(take<int>(head)));
}

ProcessorMesh meshOf(vtkMultiProcessStream& head)
{
  ProcessorMesh part;
  takeCount(head, part.patches);
  for (PatchEntry& patch : part.patches)
  {
    patch.name = take<std::string>(head);
    patch.comment = take<std::string>(head);
    patch.firstFace = static_cast<std::size_t>(take<vtkTypeInt64>(head));
    patch.faceCount = static_cast<std::size_t>(take<vtkTypeInt64>(head));
    takeCount(head, patch.entries);
    for (auto& [key, value] : patch.entries)
    {
      key = take<std::string>(head);
      value = take<std::string>(head);
    }
  }
  takeCount(head, part.faceZones);
  for (FaceZone& zone : part.faceZones)
  {
    zone.name = take<std::string>(head);
  }
  takeCount(head, part.cellZones);
  for (CellZone& zone : part.cellZones)
  {
    zone.name = take<std::string>(head);
  }
  return part;
}

void sendPart(const ProcessorMesh& part, int rank, vtkMultiProcessController& controller)
{
  const int comes = 1;
  controller.Send(&comes, 1, rank, tag);
  controller.Send(headOf(part), rank, tag);
  forLists(part, [&](const auto& list) { sendList(list, rank, controller); });
}

/// Writes the part that arrives, if any. Sends the first rank the reason if it cannot be written.
void receiveAndWrite(const fs::path& caseFolder, OpenFOAMFormat format, vtkMultiProcessController& controller,
                     const ProgressRange& progress)
{
  int comes = 0;
  controller.Receive(&comes, 1, root, tag);
  if (!comes)
  {
    return;
  }
  vtkMultiProcessStream head;
  controller.Receive(head, root, tag);
  ProcessorMesh part = meshOf(head);
  forLists(part, [&](auto& list) { receiveList(list, root, controller); });
  part.mesh.cellCount = part.cells.size();
  std::string hindrance;
  try
  {
    const int rank = controller.GetLocalProcessId();
    writeProcessor(unfinishedProcessors(caseFolder), static_cast<std::size_t>(rank), part, format, progress);
  }
  catch (const std::exception& error)
  {
    hindrance = error.what();
  }
  sendList(hindrance, root, controller);
}

std::string receiveText(int rank, vtkMultiProcessController& controller)
{
  std::string text;
  receiveList(text, rank, controller);
  return text;
}

/// Informs a rank that no part comes. The rank does not answer.
std::string sendNothing(int rank, vtkMultiProcessController& controller)
{
  const int comes = 0;
  controller.Send(&comes, 1, rank, tag);
  return {};
}

/// Throws Error if a part has no cells.
void checkParts(const std::vector<Index>& partOf, std::size_t parts)
{
  std::vector<bool> has(parts, false);
  std::ranges::for_each(partOf, [&](Index part) { has[part] = true; });
  if (std::ranges::find(has, false) != has.end())
  {
    throw Error("a mesh of " + std::to_string(partOf.size()) + " cells cannot be divided among " +
                std::to_string(parts) + " ranks so that each has some");
  }
}

/// Makes, sends and writes all parts on the first rank, and puts them in place. Throws only after the other ranks were
/// informed and have answered.
void sendAndWrite(const fs::path& caseFolder, const DividedMesh& mesh, OpenFOAMFormat format,
                  vtkMultiProcessController& controller, const ProgressRange& progress)
{
  const int ranks = controller.GetNumberOfProcesses();
  const UnfinishedFolder unfinished(unfinishedProcessors(caseFolder));
  std::exception_ptr failure;
  int next = root + 1;
  try
  {
    checkParts(mesh.partOf, static_cast<std::size_t>(ranks));
    const ProcessorMeshes meshes = decompose(mesh.poly, mesh.partOf, static_cast<std::size_t>(ranks));
    for (; next < ranks; ++next)
    {
      progress.report(static_cast<double>(next) / ranks, "Dividing the mesh among ranks");
      sendPart(meshes(static_cast<std::size_t>(next)), next, controller);
    }
    writeProcessor(unfinished.path, root, meshes(root), format, progress);
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  for (int rank = root + 1; rank < ranks; ++rank)
  {
    const std::string hindrance = rank < next ? receiveText(rank, controller) : sendNothing(rank, controller);
    if (!failure && !hindrance.empty())
    {
      failure = std::make_exception_ptr(Error("rank " + std::to_string(rank) + ": " + hindrance));
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  placeProcessors(caseFolder, static_cast<std::size_t>(ranks), sizeOf(mesh.poly.mesh));
}

} // namespace

bool writeProcessorsOnRanks(const fs::path& caseFolder, const DividedMesh* mesh, OpenFOAMFormat format,
                            vtkMultiProcessController& controller, const ProgressRange& progress)
{
  std::exception_ptr failure;
  if (mesh)
  {
    try
    {
      sendAndWrite(caseFolder, *mesh, format, controller, progress);
    }
    catch (...)
    {
      failure = std::current_exception();
    }
  }
  else
  {
    receiveAndWrite(caseFolder, format, controller, progress);
  }
  int done = failure ? 0 : 1;
  controller.Broadcast(&done, 1, root);
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  return done != 0;
}

} // namespace atria
