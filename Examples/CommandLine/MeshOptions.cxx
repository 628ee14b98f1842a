// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshOptions.h"

#include "Commands.h"
#include "ConfigFile.h"
#include "Files.h"
#include "InputFiles.h"
#include "Numbers.h"
#include "Support/NamePattern.h"

#include <vtkAtriaDualMesher.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace atria::tool {

namespace {

constexpr const char* examples = R"(Examples:
  atria mesh house.wrl
      a first mesh, house.vtu: the domain from the buildings' height, sizes from the model
  atria mesh house.wrl --wind 30 --preflight
      domain, blockage, narrowest places and number of elements, without a mesh
  atria mesh house.wrl --size-mid 0.5 --size 'Chimney*' 0.1 --layers 'Wall*=5:0.01:1.2' --openfoam case
      half a meter at surfaces, finer at chimneys, five layers on walls; a case for OpenFOAM, too
  atria mesh house.wrl --unit in --up y --without 'Tree*' -o case.vtu --write-config case.toml
      a file of all options to go on from, then: atria mesh --config case.toml
Sizes that are not given follow from those that are, --size-max from the domain. Options of a file that --config FILE.toml names,
in its section [mesh], hold where they are not on the command line.)";

void declareSizes(CLI::App& command, MeshOptions& options)
{
  const auto size = [&](const char* name, std::optional<double>& value, const char* text) {
    command.add_option(name, value, text)->check(positive())->type_name("M");
  };
  size("--size-max", options.sizeMax, "Element size away from surfaces, meters (default: from the domain)");
  size("--size-mid", options.sizeMid, "Element size at surfaces, meters (default: from the model's area)");
  size("--size-min", options.sizeMin, "Element size at edges, corners and close surfaces, meters; the grid's unit");
}

void declareDomain(CLI::App& command, MeshOptions& options)
{
  auto* domain = command.add_option("--domain", options.domain, "Bounds of the domain, meters")
                     ->expected(6)
                     ->check(anyNumber())
                     ->type_name("X0 X1 Y0 Y1 Z0 Z1");
  auto* cylinder =
      command
          .add_option("--domain-cylinder", options.cylinder, "Domain about a circle of radius R, of 16 sides, meters")
          ->expected(5)
          ->check(anyNumber())
          ->type_name("X Y R Z0 Z1")
          ->excludes(domain);
  auto* polygon = command
                      .add_option("--domain-polygon", options.polygon,
                                  "Corners of a convex polygon that the domain stands on, meters; bottom and top as "
                                  "without it, or by --domain-heights")
                      ->excludes(domain)
                      ->excludes(cylinder)
                      ->type_name("\"X,Y X,Y ...\"");
  auto* heights =
      command.add_option("--domain-heights", options.heights, "Bottom and top of a --domain-polygon, meters")
          ->expected(2)
          ->check(anyNumber())
          ->needs(polygon)
          ->type_name("Z0 Z1");
  auto* site = command
                   .add_option("--site", options.site,
                               "Surface whose rectangle is the domain's ground; height 0.3 of its longer side")
                   ->type_name("NAME");
  site->excludes(domain)->excludes(cylinder)->excludes(heights);
  auto* bounds = command.add_flag("--model-bounds", options.modelBounds,
                                  "Domain: the model's bounds, for rooms and channels whose walls are its sides");
  bounds->excludes(domain)->excludes(cylinder)->excludes(heights)->excludes(site);
  auto* automatic =
      command.add_flag("--automatic", options.automatic,
                       "Domain from the buildings' height H: 5 H, behind them 15 H, blockage at most 3 % (default)");
  automatic->excludes(domain)->excludes(cylinder)->excludes(heights)->excludes(site)->excludes(bounds);
}

/// Declares the options for some of the domains of declareDomain().
void declareGround(CLI::App& command, MeshOptions& options)
{
  vtkNew<vtkAtriaDualMesher> standard;
  const auto excludes = [&](CLI::Option* option, const std::vector<std::string>& others) {
    for (const std::string& other : others)
    {
      option->excludes(command.get_option(other));
    }
  };
  auto* ground =
      command.add_option("--ground", options.ground, "Surface that is flat ground and no building (default: Site)")
          ->type_name("NAME");
  excludes(ground, {"--site"});
  auto* wind = command
                   .add_option("--wind", options.wind,
                               "Where the wind blows to, degrees from x, counterclockwise from above; for --automatic")
                   ->check(numberIn(-360.0, 360.0))
                   ->type_name("DEG");
  excludes(wind, {"--domain", "--domain-cylinder", "--domain-polygon", "--site", "--model-bounds"});
  auto* angle =
      command
          .add_option("--domain-angle", options.domainAngle,
                      "Turns the domain, degrees counterclockwise from above; for --domain, --domain-cylinder, --site "
                      "and --model-bounds")
          ->check(numberIn(-180.0, 180.0))
          ->type_name("DEG");
  excludes(angle, {"--automatic", "--domain-polygon"});
  auto* sides =
      command
          .add_option(
              "--domain-sides", options.domainSides,
              "Upright sides of the domain, a polygon in its bounds; if not 4, --automatic is for wind from all around")
          ->check(numberIn(standard->GetDomainSidesMinValue(), standard->GetDomainSidesMaxValue()))
          ->type_name("N");
  excludes(sides, {"--domain-polygon"});
  command
      .add_option("--terrain", options.terrain,
                  "Names of terrain surfaces, with * and ?; extended to the domain's sides")
      ->type_name("PATTERN");
  options.groundSnap = standard->GetGroundSnapRatio();
  command
      .add_option("--ground-snap", options.groundSnap,
                  "Bodies that hover above the ground by less than this part of their height are let down to it; 0 "
                  "leaves them as drawn; not with --domain and --model-bounds")
      ->capture_default_str()
      ->check(numberIn(standard->GetGroundSnapRatioMinValue(), standard->GetGroundSnapRatioMaxValue()))
      ->type_name("PART");
  command.add_option("--align", options.align, "What the grid stands along")
      ->capture_default_str()
      ->check(oneOf({"axes", "walls", "domain"}))
      ->type_name("axes|walls|domain");
}

void declareFluid(CLI::App& command, MeshOptions& options)
{
  auto* zone =
      command
          .add_option("--zone", options.zone,
                      "Fluid is what the domain's top reaches, or its other sides if nothing does, or all there is")
          ->capture_default_str()
          ->check(oneOf({"outside", "all"}))
          ->type_name("outside|all");
  command.add_option("--seed", options.seeds, "Fluid is what this point reaches; may be repeated")
      ->allow_extra_args(false)
      ->check(anyNumber())
      ->type_name("X Y Z")
      ->excludes(zone);
  command
      .add_option("--sealed-seed", options.sealedSeeds,
                  "Point in a space that should be closed; a way out is warned of; may be repeated")
      ->allow_extra_args(false)
      ->check(anyNumber())
      ->type_name("X Y Z");
}

void declareZones(CLI::App& command, MeshOptions& options)
{
  auto* openings = command.add_flag("--openings", options.openings,
                                    "Find windows, doors, hatches and gaps between walls: each is a face zone "
                                    "SURFACE_opening_N, and they part rooms, "
                                    "which are cell zones");
  command
      .add_option("--no-openings", options.withoutOpenings,
                  "Surfaces in which none are found, by pattern, such as furniture; may be repeated")
      ->needs(openings)
      ->allow_extra_args(false)
      ->type_name("PATTERN");
  command
      .add_option(
          "--face-zone", options.faceZones,
          "Surfaces one can look through, by pattern (* and ? stand for text): the mesh conforms to them, but they "
          "separate nothing; their faces are a face zone; may be repeated")
      ->allow_extra_args(false)
      ->type_name("PATTERN");
  command
      .add_option(
          "--cell-zone", options.cellZones,
          "Closed surfaces, by pattern, that are no walls, such as trees: elements in them are a cell zone; may be "
          "repeated")
      ->allow_extra_args(false)
      ->type_name("PATTERN");
}

void declareRepair(CLI::App& command, MeshOptions& options)
{
  vtkNew<vtkAtriaDualMesher> mesher; // the one home of the defaults
  options.gap = mesher->GetGapTolerance();
  options.smallParts = mesher->GetSmallPartSize();
  options.crack = mesher->GetCrackTolerance();
  command
      .add_option("--gap", options.gap,
                  "Gaps narrower than this are closed, meters; 0 closes none (default: 0.05 of --size-min)")
      ->check(atLeast(0.0))
      ->type_name("M");
  command
      .add_option("--small-parts", options.smallParts,
                  "Parts of the model smaller than this many octants of --size-min are left out, but for surfaces that "
                  "size rules name; 0 leaves out none")
      ->capture_default_str()
      ->check(atLeast(0.0))
      ->type_name("N");
  command
      .add_option("--crack", options.crack,
                  "Gaps beside free edges no wider than this part of the octants there are closed; 0 closes none")
      ->capture_default_str()
      ->check(numberIn(0.0, 0.9))
      ->type_name("PART");
}

void declareOutput(CLI::App& command, MeshOptions& options)
{
  command
      .add_option("-o,--output", options.output,
                  "Where the mesh goes, a .vtu file (default: here, by the name of the model), or a .pvtu file: under "
                  "mpiexec each rank writes its piece of the mesh, and of the patches")
      ->type_name("OUT.vtu");
  command.add_option("--patches", options.patches, "Also write the named boundary patches")->type_name("OUT.vtpc");
  declareExportOptions(command, options.exports);
  command
      .add_option("--report", options.report,
                  "Also write counts, zones, leaks, patches, quality, repairs and times as JSON")
      ->type_name("OUT.json");
}

void declareRun(CLI::App& command, MeshOptions& options)
{
  command.add_flag(
      "--preflight", options.preflight,
      "Print domain, blockage, narrowest places and elements to expect, and make no mesh; --report writes them");
  command.add_flag("--estimate", options.estimate, "Print octants by size, elements and memory, and make no mesh");
  declareConfigFile(command, options.writeConfig, "make no mesh");
  command.add_option("--threads", options.threads, "Number of threads (default: all cores)")
      ->check(numberIn(1, 1024))
      ->type_name("N");
}

/// Parses "x,y x,y ..."; returns none for an empty text.
std::vector<std::array<double, 2>> cornersIn(const std::string& text)
{
  std::vector<std::array<double, 2>> corners;
  std::istringstream words(text);
  for (std::string word; words >> word;)
  {
    const std::size_t comma = word.find(',');
    std::array<double, 2> corner{};
    const bool isCorner = comma != std::string::npos && readNumber(word.substr(0, comma), corner[0]) &&
                          readNumber(word.substr(comma + 1), corner[1]);
    if (!isCorner)
    {
      throw Failure(Usage, "--domain-polygon: '" + word +
                               "' is no corner; give x and y with a comma between, such as \"0,0 50,0 30,40\"");
    }
    corners.push_back(corner);
  }
  return corners;
}

/// Checks sizes, given from the smallest to the largest.
void checkSizes(const std::array<std::optional<double>, 3>& sizes)
{
  double least = 0.0;
  for (const std::optional<double>& size : sizes)
  {
    if (size.value_or(least) < least)
    {
      throw Failure(Usage, "sizes must not fall from --size-min over --size-mid to --size-max");
    }
    least = size.value_or(least);
  }
}

} // namespace

void declareMeshOptions(CLI::App& command, MeshOptions& options)
{
  // Options go to the group that is named before them.
  const auto group = [&](const char* name) { command.option_defaults()->group(name); };
  group("Model");
  command.add_option("MODEL", options.input, modelFormats);
  declareModelOptions(command, options.model);
  group("Sizes, in meters");
  declareSizes(command, options);
  declareSizeOptions(command, options.sizes);
  group("Domain");
  declareDomain(command, options);
  declareGround(command, options);
  group("Fluid");
  declareFluid(command, options);
  group("Face zones and rooms");
  declareZones(command, options);
  group("Layers on walls");
  declareLayerOptions(command, options.layers);
  group("Repair");
  declareRepair(command, options);
  group("Output");
  declareOutput(command, options);
  group("Run");
  declareRun(command, options);
  command.footer(examples);
}

void completeMeshOptions(MeshOptions& options)
{
  if (options.output.empty())
  {
    std::filesystem::path name = std::filesystem::path(options.input).filename();
    options.output = (name.extension() == ".gz" ? name.stem() : name).stem().string() + ".vtu";
  }
  checkOutput("--output", options.output, isInPieces(options.output) ? ".pvtu" : ".vtu");
  if (!options.patches.empty())
  {
    checkOutput("--patches", options.patches, ".vtpc");
  }
  if (!options.report.empty())
  {
    checkOutput("--report", options.report, ".json");
  }
  checkExportOptions(options.exports);
  checkSizes({options.sizeMin, options.sizeMid, options.sizeMax});
  if (options.domainAngle != 0.0 && options.domain.empty() && options.cylinder.empty() && options.site.empty() &&
      !options.modelBounds)
  {
    throw Failure(Usage, "--domain-angle needs --domain, --domain-cylinder, --site or --model-bounds: the automatic "
                         "domain stands along --wind");
  }
  completeDomain(options);
  if (!options.heights.empty() && options.heights[0] >= options.heights[1])
  {
    throw Failure(Usage, "--domain-heights: Z0 must be less than Z1");
  }
  if (!options.cylinder.empty() && (options.cylinder[2] <= 0.0 || options.cylinder[3] >= options.cylinder[4]))
  {
    throw Failure(Usage, "--domain-cylinder: R must be above 0, and Z0 less than Z1");
  }
  for (std::size_t axis = 0; axis < 3 && !options.domain.empty(); ++axis)
  {
    if (options.domain[2 * axis] >= options.domain[2 * axis + 1])
    {
      throw Failure(Usage, std::string("--domain: ") + "xyz"[axis] + "0 must be less than " + "xyz"[axis] + "1");
    }
  }
}

void completeDomain(MeshOptions& options) { options.corners = cornersIn(options.polygon); }

void checkSite(const std::string& site, vtkPolyData* model)
{
  auto* names = vtkStringArray::SafeDownCast(model->GetFieldData()->GetAbstractArray("SurfaceName"));
  std::vector<std::string> known;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    known.push_back(names->GetValue(i));
  }
  if (std::find(known.begin(), known.end(), site) == known.end())
  {
    throw Failure(Usage, "--site " + site + ": the model has no surface of that name; " + namesInstead(site, known));
  }
}

namespace {

void configureDomain(vtkAtriaGridAlgorithm* filter, const MeshOptions& options)
{
  if (!options.domain.empty())
  {
    filter->SetDomainMode(vtkAtriaGridAlgorithm::Explicit);
    filter->SetDomainBounds(options.domain.data());
  }
  constexpr int sidesOfCylinder = 16;
  filter->SetDomainSides(
      options.domainSides.value_or(options.cylinder.empty() ? filter->GetDomainSides() : sidesOfCylinder));
  if (!options.cylinder.empty())
  {
    const std::vector<double>& c = options.cylinder;
    filter->SetDomainCylinder(c[0], c[1], c[2], c[3], c[4]);
  }
  for (const auto& [x, y] : options.corners)
  {
    filter->AddDomainCorner(x, y);
  }
  if (!options.heights.empty())
  {
    filter->SetDomainMode(vtkAtriaGridAlgorithm::Explicit);
    filter->SetDomainBounds(0.0, 0.0, 0.0, 0.0, options.heights[0], options.heights[1]);
  }
  if (!options.site.empty())
  {
    filter->SetDomainMode(vtkAtriaGridAlgorithm::Site);
    filter->SetSiteName(options.site);
  }
  if (!options.ground.empty())
  {
    filter->SetSiteName(options.ground);
  }
  if (options.modelBounds)
  {
    filter->SetDomainMode(vtkAtriaGridAlgorithm::FromSurfaces);
  }
}

} // namespace

void configureGrid(vtkAtriaGridAlgorithm* filter, const MeshOptions& options)
{
  filter->SetSizeMax(options.sizeMax.value_or(0.0));
  filter->SetSizeMid(options.sizeMid.value_or(0.0));
  filter->SetSizeMin(options.sizeMin.value_or(0.0));
  configureSizes(filter, options.sizes);
  for (const std::string& pattern : options.faceZones)
  {
    filter->AddFaceZone(pattern.c_str());
  }
  filter->SetFindOpenings(options.openings);
  for (const std::string& pattern : options.withoutOpenings)
  {
    filter->AddSurfaceWithoutOpenings(pattern.c_str());
  }
  for (const std::string& pattern : options.cellZones)
  {
    filter->AddCellZone(pattern.c_str());
  }
  filter->SetGapTolerance(options.gap);
  filter->SetSmallPartSize(options.smallParts);
  configureDomain(filter, options);
  filter->SetWindAngle(options.wind);
  filter->SetDomainAngle(options.domainAngle);
  filter->SetTerrainName(options.terrain);
  filter->SetGroundSnapRatio(options.groundSnap);
  filter->SetAlignGrid(options.align == "walls"    ? vtkAtriaGridAlgorithm::ToWalls
                       : options.align == "domain" ? vtkAtriaGridAlgorithm::ToDomain
                                                   : vtkAtriaGridAlgorithm::ToAxes);
}

void configure(vtkAtriaDualMesher* mesher, const MeshOptions& options)
{
  configureGrid(mesher, options);
  mesher->CacheStagesOff(); // there is one run
  mesher->SetCrackTolerance(options.crack);
  mesher->SetZoneRule(options.zone == "all" ? vtkAtriaDualMesher::All : vtkAtriaDualMesher::Outside);
  if (!options.seeds.empty())
  {
    mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
    for (const auto& [x, y, z] : options.seeds)
    {
      mesher->AddSeed(x, y, z);
    }
  }
  for (const auto& [x, y, z] : options.sealedSeeds)
  {
    mesher->AddSealedSeed(x, y, z);
  }
  configureLayers(mesher, options.layers);
}

} // namespace atria::tool
