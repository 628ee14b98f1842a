// SPDX-License-Identifier: GPL-3.0-or-later
#include "LayerOptions.h"

#include "Commands.h"
#include "Numbers.h"

#include <vtkAtriaDualMesher.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace atria::tool {

namespace {

/// Returns numbers with colons between them, at most `most`, NaN for `auto`; none for any other text.
std::vector<double> numbersFrom(const std::string& text, std::size_t most)
{
  std::vector<double> numbers;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ':');)
  {
    std::istringstream part(word);
    double number = std::numeric_limits<double>::quiet_NaN();
    if (word == "auto" && numbers.size() != 1 && most > 1)
    {
      numbers.push_back(number);
      continue;
    }
    if (!(part >> number) || !part.eof() || numbers.size() == most)
    {
      return {};
    }
    numbers.push_back(number);
  }
  return numbers;
}

/// Returns the rule as vtkAtriaDualMesher::AddLayerRule takes it. `numbers` has colons between them.
std::string ruleOf(const std::string& pattern, std::string numbers)
{
  std::ranges::replace(numbers, ':', ' ');
  std::ostringstream rule;
  rule << std::quoted(pattern) << ' ' << numbers;
  return rule.str();
}

double firstHeightOf(const LayerOptions& options)
{
  if (options.yPlus == 0.0)
  {
    return options.firstHeight;
  }
  const double height = vtkAtriaDualMesher::ComputeFirstLayerHeight(options.yPlus, options.speed);
  if (!std::isfinite(height) || height == 0.0)
  {
    throw Failure(Usage, "--y-plus has no finite height above 0 at this --speed");
  }
  return height;
}

} // namespace

void declareLayerOptions(CLI::App& command, LayerOptions& options)
{
  // The filter is the one home of the defaults.
  vtkNew<vtkAtriaDualMesher> filter;
  options.firstHeight = filter->GetFirstLayerHeight();
  options.growth = filter->GetLayerGrowth();
  options.nonOrthogonality = filter->GetTargetNonOrthogonality();
  options.skewness = filter->GetTargetSkewness();
  options.blockSize = filter->GetBlockSize();
  command
      .add_option(
          "--layers", options.layers,
          "Layers of elements on all surfaces, or on those whose name matches the pattern (* and ? stand for "
          "text) and on domain sides of that name; may be repeated, the last that matches holds (default: 1). "
          "With FIRST, N or GROWTH may be 'auto': so that the outermost layer is as high as what is left of the "
          "elements beside it")
      ->allow_extra_args(false)
      ->type_name("N|PATTERN=N[:FIRST[:GROWTH]]");
  command.add_flag("--no-support", options.withoutSupport,
                   "No layer on surfaces for which none is requested, also where elements cannot be valid without");
  CLI::Option* height =
      command.add_option("--first-layer", options.firstHeight, "Height of the layer on the wall, meters; 0 for any")
          ->capture_default_str()
          ->check(atLeast(0.0))
          ->type_name("M");
  CLI::Option* speed = command
                           .add_option("--speed", options.speed,
                                       "Speed of the air that passes the walls, m/s: the table of layers then has y+, "
                                       "with a friction velocity of a twentieth of it")
                           ->check(positive())
                           ->type_name("M/S");
  command
      .add_option("--y-plus", options.yPlus,
                  "Height of the layer on the wall by the y+ of its middle at --speed: 30 to 300 for wall functions; "
                  "FIRST of --layers goes before it")
      ->check(positive())
      ->needs(speed)
      ->excludes(height)
      ->type_name("X");
  command.add_option("--layer-growth", options.growth, "Height of each layer relative to the one below it")
      ->capture_default_str()
      ->check(numberIn(filter->GetLayerGrowthMinValue(), filter->GetLayerGrowthMaxValue()))
      ->type_name("X");
  command
      .add_option("--non-orthogonality", options.nonOrthogonality,
                  "What hexahedra at curved walls should have at most, degrees; less takes longer")
      ->capture_default_str()
      ->check(numberIn(filter->GetTargetNonOrthogonalityMinValue(), filter->GetTargetNonOrthogonalityMaxValue()))
      ->type_name("DEG");
  command.add_option("--skewness", options.skewness, "Skewness that they should have at most")
      ->capture_default_str()
      ->check(numberIn(filter->GetTargetSkewnessMinValue(), filter->GetTargetSkewnessMaxValue()))
      ->type_name("X");
  command
      .add_option(
          "--block-size", options.blockSize,
          "Octants of a block, where the mesh is improved in blocks: MPI ranks (mpiexec -n N) then make it together; 0 "
          "for none")
      ->capture_default_str()
      ->check(atLeast(0.0))
      ->type_name("N");
}

void configureLayers(vtkAtriaDualMesher* mesher, const LayerOptions& options)
{
  mesher->SetSupportElements(!options.withoutSupport);
  mesher->SetFirstLayerHeight(firstHeightOf(options));
  mesher->SetLayerGrowth(options.growth);
  mesher->SetTargetNonOrthogonality(options.nonOrthogonality);
  mesher->SetTargetSkewness(options.skewness);
  mesher->SetBlockSize(options.blockSize);
  for (const std::string& text : options.layers)
  {
    const auto equals = text.rfind('=');
    const bool forAll = equals == std::string::npos;
    const std::vector<double> numbers = numbersFrom(forAll ? text : text.substr(equals + 1), forAll ? 1 : 3);
    const bool isNumber = !numbers.empty() && !std::isnan(numbers[0]);
    if (numbers.empty() ||
        (isNumber && (numbers[0] < 0.0 || numbers[0] > 100.0 || numbers[0] != std::floor(numbers[0]))))
    {
      throw Failure(Usage, "--layers: " + text +
                               " is not of the form N or PATTERN=N[:FIRST[:GROWTH]], N from 0 to 100 or 'auto', GROWTH "
                               "a number or 'auto'");
    }
    if (forAll)
    {
      mesher->SetNumberOfLayers(static_cast<int>(numbers[0]));
    }
    else
    {
      mesher->AddLayerRule(ruleOf(text.substr(0, equals), text.substr(equals + 1)).c_str());
    }
  }
}

} // namespace atria::tool
