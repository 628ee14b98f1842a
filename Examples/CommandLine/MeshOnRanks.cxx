// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshOnRanks.h"

#include "ConfigFile.h"
#include "Console.h"
#include "MeshOptions.h"
#include "Threads.h"
#include "Workers.h"

#include <vtkAtriaDualMesher.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>

#include <sstream>

namespace atria::tool {

namespace {

/// The first rank gets the whole: reports and most formats need it.
void updatePiece(vtkAtriaDualMesher* mesher, vtkMultiProcessController& controller)
{
  mesher->DistributeOutputOff();
  mesher->UpdatePiece(controller.GetLocalProcessId(), controller.GetNumberOfProcesses(), 0);
}

} // namespace

void updateOnRanks(vtkAtriaDualMesher* mesher, const CLI::App& command, const MeshOptions& options,
                   const Workers& workers)
{
  const Json task = {{"make", configFileOf(command)},
                     {"sizes", {options.sizeMax.value(), options.sizeMid.value(), options.sizeMin.value()}}};
  workers.doTogether(task.dump(), [&](vtkMultiProcessController& controller) { updatePiece(mesher, controller); });
}

void makeMeshWithOthers(const Json& task, vtkMultiProcessController& controller)
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
  updatePiece(mesher, controller);
  console.takeErrors(); // the first rank tells what was wrong
}

} // namespace atria::tool
