// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshOnRanks.h"

#include "ConfigFile.h"
#include "Console.h"
#include "Files.h"
#include "MeshOptions.h"
#include "MeshSums.h"
#include "Threads.h"
#include "Workers.h"

#include <vtkAtriaDualMesher.h>
#include <vtkAtriaMeshQuality.h>
#include <vtkMultiProcessController.h>
#include <vtkMultiProcessStream.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <sstream>

namespace atria::tool {

namespace {

constexpr int first = 0;
constexpr int sumsTag = 2;

/// Returns the number of elements of all ranks.
vtkIdType make(vtkAtriaDualMesher* mesher, bool inPieces, vtkMultiProcessController& controller)
{
  mesher->SetDistributeOutput(inPieces);
  mesher->UpdatePiece(controller.GetLocalProcessId(), controller.GetNumberOfProcesses(), 0);
  const vtkIdType own = mesher->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL);
  vtkIdType all = 0;
  controller.AllReduce(&own, &all, 1, vtkCommunicator::SUM_OP);
  return all;
}

/// Returns this rank's sums.
Json measure(vtkAtriaMeshQuality* quality, vtkMultiProcessController& controller)
{
  quality->UpdatePiece(controller.GetLocalProcessId(), controller.GetNumberOfProcesses(), 0);
  return sumsOf(vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0)),
                vtkPartitionedDataSetCollection::SafeDownCast(quality->GetInputDataObject(1, 0)));
}

} // namespace

bool isMadeTogether(const MeshOptions& options, const Workers& workers)
{
  return workers && options.layers.blockSize > 0;
}

bool staysInPieces(const MeshOptions& options, const Workers& workers)
{
  return isMadeTogether(options, workers) && isInPieces(options.output) && options.exports.needNoWhole();
}

vtkIdType makeTogether(vtkAtriaDualMesher* mesher, const CLI::App& command, const MeshOptions& options,
                       const Workers& workers)
{
  const bool inPieces = staysInPieces(options, workers);
  const Json task = {{"make", configFileOf(command)},
                     {"sizes", {options.sizeMax.value(), options.sizeMid.value(), options.sizeMin.value()}},
                     {"pieces", inPieces}};
  vtkIdType elements = 0;
  workers.doTogether(task.dump(),
                     [&](vtkMultiProcessController& controller) { elements = make(mesher, inPieces, controller); });
  return elements;
}

Json measureTogether(vtkAtriaMeshQuality* quality, const Workers& workers)
{
  Json sums;
  workers.doTogether(Json{{"measure", true}}.dump(), [&](vtkMultiProcessController& controller) {
    sums = measure(quality, controller);
    for (int rank = first + 1; rank < controller.GetNumberOfProcesses(); ++rank)
    {
      vtkMultiProcessStream message;
      controller.Receive(message, rank, sumsTag);
      std::string text;
      message >> text;
      addSums(Json::parse(text), sums);
    }
  });
  return sums;
}

void makeWithOthers(const Json& task, MeshPiece& piece, vtkMultiProcessController& controller)
{
  MeshOptions options;
  CLI::App app;
  declareMeshOptions(*app.add_subcommand("mesh"), options);
  std::istringstream config(task["make"].get<std::string>());
  app.parse_from_stream(config);
  const Json& sizes = task["sizes"];
  options.sizeMax = sizes[0].get<double>();
  options.sizeMid = sizes[1].get<double>();
  options.sizeMin = sizes[2].get<double>();
  completeDomain(options);
  setThreads(options.threads);
  vtkNew<vtkAtriaDualMesher> mesher;
  configure(mesher, options);
  mesher->SetInputDataObject(0, vtkNew<vtkPolyData>()); // the first rank has the model
  Console console;
  make(mesher, task["pieces"].get<bool>(), controller);
  piece.mesh = vtkUnstructuredGrid::SafeDownCast(mesher->GetOutputDataObject(0));
  piece.patches = vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1));
  console.takeErrors(); // the first rank reports errors
}

void measureWithOthers(MeshPiece& piece, vtkMultiProcessController& controller)
{
  Console console;
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputDataObject(0, piece.mesh);
  quality->SetInputDataObject(1, piece.patches);
  vtkMultiProcessStream message;
  message << measure(quality, controller).dump();
  controller.Send(message, first, sumsTag);
  piece.mesh = vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0));
  console.takeErrors();
}

} // namespace atria::tool
