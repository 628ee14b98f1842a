// SPDX-License-Identifier: GPL-3.0-or-later
/// Options on how a model is read, shared by subcommands.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}
class vtkAtriaSurfaceReader;

namespace atria::tool {

struct ModelOptions
{
  std::string unit;
  double scale = 1.0;
  std::string up;
  bool recenter = false;
  bool keepDuplicates = false;
  std::string surfacesBy = "shape";
  std::vector<std::string> without;
  double roundAngle = 10.0;
  double roundError = 0.0;
};

void declareModelOptions(CLI::App& command, ModelOptions& options);
void configure(vtkAtriaSurfaceReader* reader, const ModelOptions& options);

} // namespace atria::tool
