// SPDX-License-Identifier: GPL-3.0-or-later
#include "SizeOptions.h"

#include "Commands.h"
#include "Numbers.h"

#include <vtkAtriaOctreeSource.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>

namespace atria::tool {

namespace {

/// Returns the two numbers of SIZE[:FEATURE].
std::pair<double, std::optional<double>> sizesFrom(const std::string& text)
{
  std::istringstream in(text);
  double size = 0.0;
  double feature = 0.0;
  char colon = 0;
  if (in >> size && in.eof())
  {
    return {size, {}};
  }
  if (in >> colon >> feature && colon == ':' && in.peek() == std::istringstream::traits_type::eof())
  {
    return {size, feature};
  }
  throw Failure(Usage, "--size: " + text + " is not of the form SIZE or SIZE:FEATURE");
}

/// Declares sizes at places.
void declareRules(CLI::App& command, SizeOptions& options)
{
  command
      .add_option("--size", options.surfaces,
                  "Element size at the surfaces whose name matches the pattern (* and ? stand for text), and at their "
                  "edges, meters; may be repeated")
      ->allow_extra_args(false)
      ->type_name("PATTERN SIZE[:FEATURE]");
  command.add_option("--refine-box", options.boxes, "Element size in a box, meters; may be repeated")
      ->allow_extra_args(false)
      ->type_name("X0 X1 Y0 Y1 Z0 Z1 SIZE");
  command
      .add_option("--refine-near", options.near,
                  "Element size up to a distance from the surfaces that match, meters; may be repeated")
      ->allow_extra_args(false)
      ->type_name("PATTERN DISTANCE SIZE");
}

} // namespace

void declareSizeOptions(CLI::App& command, SizeOptions& options)
{
  // The filter is the one home of the defaults.
  vtkNew<vtkAtriaOctreeSource> filter;
  options.curvatureAngle = filter->GetCurvatureAngle();
  options.gapCells = filter->GetCellsAcrossGap();
  options.cellsPerLevel = filter->GetCellsPerLevel();
  options.maxElements = filter->GetMaxElements();
  options.memoryLimit = filter->GetMemoryLimit();
  options.startLevel = filter->GetStartLevel();
  options.featureAngle = filter->GetFeatureAngle();

  declareRules(command, options);
  command
      .add_option("--curvature-angle", options.curvatureAngle,
                  "Refine where a smooth surface turns by more in an element, degrees; 0 for nowhere")
      ->capture_default_str()
      ->check(numberIn(filter->GetCurvatureAngleMinValue(), filter->GetCurvatureAngleMaxValue()))
      ->type_name("DEG");
  command
      .add_option("--gap-cells", options.gapCells,
                  "Elements across gaps between surfaces, down to --size-min; 0 for any")
      ->capture_default_str()
      ->check(numberIn(filter->GetCellsAcrossGapMinValue(), filter->GetCellsAcrossGapMaxValue()))
      ->type_name("N");
  command.add_option("--cells-per-level", options.cellsPerLevel, "Layers of elements of each size where sizes grow")
      ->capture_default_str()
      ->check(numberIn(filter->GetCellsPerLevelMinValue(), filter->GetCellsPerLevelMaxValue()))
      ->type_name("N");
  command.add_flag(
      "--hex", options.hexahedra,
      "Make hexahedra only; surfaces that are connected have elements of one size, the finest there, and all walls "
      "have the most layers that any has, one at least");
  command
      .add_option(
          "--max-elements", options.maxElements,
          "Take coarser sizes where there would be more elements, first away from the model and last at edges; 0 "
          "for no limit")
      ->capture_default_str()
      ->check(atLeast(0.0))
      ->type_name("N");
  command.add_option("--start-level", options.startLevel, "Times the domain is halved everywhere, at least")
      ->capture_default_str()
      ->check(numberIn(filter->GetStartLevelMinValue(), filter->GetStartLevelMaxValue()))
      ->type_name("N");
  command
      .add_option("--feature-angle", options.featureAngle,
                  "Edges at which the model turns by more are kept as edges of the mesh, degrees")
      ->capture_default_str()
      ->check(numberIn(filter->GetFeatureAngleMinValue(), filter->GetFeatureAngleMaxValue()))
      ->type_name("DEG");
  command
      .add_option("--memory-limit", options.memoryLimit,
                  "Refuse sizes whose mesh would take more memory, gigabytes (default: what the machine has)")
      ->check(positive())
      ->type_name("GB");
}

void configureSizes(vtkAtriaGridAlgorithm* filter, const SizeOptions& options)
{
  for (const auto& [pattern, text] : options.surfaces)
  {
    const auto [size, feature] = sizesFrom(text);
    feature ? filter->AddSurfaceSizeRule(pattern, size, *feature) : filter->AddSurfaceSizeRule(pattern, size);
  }
  for (const auto& [x0, x1, y0, y1, z0, z1, size] : options.boxes)
  {
    filter->AddRefinementBox(x0, x1, y0, y1, z0, z1, size);
  }
  for (const auto& [pattern, distance, size] : options.near)
  {
    filter->AddDistanceSizeRule(pattern, distance, size);
  }
  filter->SetCurvatureAngle(options.curvatureAngle);
  filter->SetCellsAcrossGap(options.gapCells);
  filter->SetCellsPerLevel(options.cellsPerLevel);
  filter->SetElementType(options.hexahedra ? vtkAtriaGridAlgorithm::Hexahedral
                                           : vtkAtriaGridAlgorithm::HexahedralDominant);
  filter->SetMaxElements(options.maxElements);
  filter->SetMemoryLimit(options.memoryLimit);
  filter->SetStartLevel(options.startLevel);
  filter->SetFeatureAngle(options.featureAngle);
}

namespace {

/// Returns memory in MB up to some thousand, else in GB.
std::string memoryText(long long bytes)
{
  constexpr long long megabyte = 1'000'000;
  constexpr long long gigabyte = 1000 * megabyte;
  return bytes < 10 * gigabyte ? std::to_string(std::max(1LL, bytes / megabyte)) + " MB"
                               : std::to_string(bytes / gigabyte) + " GB";
}

} // namespace

std::string estimateText(vtkAtriaOctreeSource* source)
{
  std::ostringstream out;
  out << "level  size/m      octants\n";
  for (int level = 0; level < source->GetNumberOfEstimatedLevels(); ++level)
  {
    if (const vtkIdType octants = source->GetEstimatedOctants(level); octants > 0)
    {
      out << std::setw(5) << level << "  " << std::left << std::setw(9) << source->GetEstimatedOctantSize(level)
          << std::right << std::setw(10) << octants << '\n';
    }
  }
  const bool tooLarge = source->GetEstimateIsTooLarge();
  out << "elements: " << source->GetEstimatedElements()
      << (tooLarge ? " or more (from a part of the octants, before they are balanced)\n"
                   : " (all zones, without layers)\n");
  out << "memory: about " << memoryText(source->GetEstimatedBytes()) << (tooLarge ? " or more\n" : "\n");
  return out.str();
}

} // namespace atria::tool
