// SPDX-License-Identifier: GPL-3.0-or-later
/// The options of `atria case`.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

class vtkAtriaOpenFOAMCaseWriter;

namespace CLI {
class App;
}

namespace atria::tool {

struct CaseOptions
{
  std::string input;
  std::string patches;
  std::string output;
  std::string writeConfig;
  double speed = 0.0, height = 0.0, roughness = 0.0, north = 0.0, pedestrian = 0.0;
  std::vector<double> wind;
  std::vector<double> from;
  std::string rose; ///< a number, or the file of a climate's table
  int iterations = 0, processors = 0;
  double inletSpeed = 0.0, inletFlow = 0.0;
  std::string kind, turbulence, dialect;
  bool age = false, checkProfile = false;
  std::vector<std::pair<std::string, std::string>> patchRules;
  std::vector<std::tuple<std::string, std::string, std::string>> conditions;
  std::vector<std::pair<std::string, std::string>> grounds;
  std::vector<std::tuple<std::string, std::string, std::string>> scalars;
  std::vector<std::tuple<std::string, std::string, std::string>> canopies;
  std::string trees;
  std::vector<std::pair<std::string, std::string>> screens;
  std::vector<std::pair<std::string, std::string>> fans;
  std::optional<double> outdoorTemperature;
  std::vector<std::pair<std::string, std::string>> temperatures;
  std::vector<std::pair<std::string, std::string>> heats;
  bool calm = false;
  double transient = 0.0;
};

/// Declares all options but --config.
void declareCaseOptions(CLI::App& command, CaseOptions& options);

/// Sets all properties of the writer.
void configureCase(vtkAtriaOpenFOAMCaseWriter* writer, const CaseOptions& options, const CLI::App& command);

} // namespace atria::tool
