// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelOptions.h"

#include "Numbers.h"

#include <vtkAtriaSurfaceReader.h>
#include <vtkAtriaVRMLReader.h>

#include <CLI/CLI.hpp>

#include <map>

namespace atria::tool {

namespace {

const std::map<std::string, int> units{{"m", vtkAtriaSurfaceReader::Meters},
                                       {"mm", vtkAtriaSurfaceReader::Millimeters},
                                       {"cm", vtkAtriaSurfaceReader::Centimeters},
                                       {"in", vtkAtriaSurfaceReader::Inches},
                                       {"ft", vtkAtriaSurfaceReader::Feet}};
const std::map<std::string, int> axes{{"y", vtkAtriaSurfaceReader::YUp}, {"z", vtkAtriaSurfaceReader::ZUp}};
const std::map<std::string, int> rules{{"shape", vtkAtriaSurfaceReader::Shape},
                                       {"group", vtkAtriaSurfaceReader::Group},
                                       {"material", vtkAtriaSurfaceReader::Material},
                                       {"connected", vtkAtriaSurfaceReader::Connected}};

} // namespace

void declareModelOptions(CLI::App& command, ModelOptions& options)
{
  command.add_option("--unit", options.unit, "Unit of length in the file; meters unless given")
      ->check(oneOf({"m", "mm", "cm", "in", "ft"}))
      ->type_name("m|mm|cm|in|ft");
  command.add_option("--scale", options.scale, "A further factor for all lengths")
      ->capture_default_str()
      ->check(numberIn(1e-9, 1e9));
  command
      .add_option("--up", options.up,
                  "The axis that is up in the file; z unless given here or by the file. With y the model is turned")
      ->check(oneOf({"y", "z"}))
      ->type_name("y|z");
  command.add_flag("--recenter,--recentre", options.recenter,
                   "Move a model that is far from the origin there, by whole hundreds of meters");
  command.add_flag(
      "--keep-duplicates", options.keepDuplicates,
      "Keep faces that coincide with those of a smaller surface or with earlier ones, such as the backs of "
      "sheets; so it is for a mesh with face zones or cell zones");
  command.add_option("--surfaces-by", options.surfacesBy, "What makes a named surface")
      ->capture_default_str()
      ->check(oneOf({"shape", "group", "material", "connected"}))
      ->type_name("shape|group|material|connected");
  command
      .add_option("--without", options.without,
                  "Leave out the surfaces whose name matches the pattern (* and ? stand for text); may be repeated")
      ->allow_extra_args(false)
      ->type_name("PATTERN");
  command
      .add_option("--round-angle", options.roundAngle,
                  "Angle between neighboring points of VRML's spheres, cones and cylinders, degrees")
      ->capture_default_str()
      ->check(numberIn(1.0, 90.0))
      ->type_name("DEG");
  command
      .add_option("--round-error", options.roundError,
                  "Greatest distance of their facets from the true surface, meters; 0 for any")
      ->capture_default_str()
      ->check(atLeast(0.0))
      ->type_name("M");
}

void configure(vtkAtriaSurfaceReader* reader, const ModelOptions& options)
{
  if (!options.unit.empty())
  {
    reader->SetLengthUnit(units.at(options.unit));
  }
  if (!options.up.empty())
  {
    reader->SetUpAxis(axes.at(options.up));
  }
  for (const std::string& pattern : options.without)
  {
    reader->AddExcludedSurface(pattern.c_str());
  }
  reader->SetScale(options.scale);
  reader->SetRecenter(options.recenter);
  reader->SetMergeDuplicateFaces(!options.keepDuplicates);
  reader->SetSurfaceBy(rules.at(options.surfacesBy));
  if (auto* vrml = vtkAtriaVRMLReader::SafeDownCast(reader))
  {
    vrml->SetTessellationAngle(options.roundAngle);
    vrml->SetTessellationError(options.roundError);
  }
}

} // namespace atria::tool
