// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseTable.h"

#include "Support/Error.h"

#include <algorithm>

namespace atria {

namespace {

// Facts of a case and of its patches are added in CaseValues.cxx:
//   opencfd (opencfd-1912, opencfd-2006), foundation (foundation-11, foundation-14); wind, room;
//   kEpsilon, realizableKE, kOmegaSST; ageOfAir, parallel, walls, pedestrians, checkProfile; emptyDomain;
//   warmAir, transient, outdoorsAtRest (calm air in a cell zone of the outdoors);
//   patches: inletBySpeed, inletByFlow, windInlet, windBothWays (a windInlet too), opening (of a room or to calm air),
//   outlet, slip, ground (ownRoughness too if it has a roughness length of its own), wall, roughWall, constraint;
//   surfaceSource of a passive scalar or of heat, fixedTemperature; canopies, and leaves if they are sources of
//   turbulence; screen and fan at the two sides of a face zone that has one; undivided if processors keep sides
//   together.
// The name of a template ends with a dialect where other dialects have another template.
// clang-format off

constexpr CaseField fields[] = {
  // name     class             kind                   if
  {"U",       "volVectorField", FieldKind::Velocity,   ""},
  {"p",       "volScalarField", FieldKind::Derived,    ""},
  {"k",       "volScalarField", FieldKind::Turbulence, ""},
  {"nut",     "volScalarField", FieldKind::Derived,    ""},
  {"epsilon", "volScalarField", FieldKind::Turbulence, "kEpsilon|realizableKE"},
  {"omega",   "volScalarField", FieldKind::Turbulence, "kOmegaSST"},
  {"age",     "volScalarField", FieldKind::Scalar,     "ageOfAir"},
  {"T",       "volScalarField", FieldKind::Temperature, "warmAir"},
};

constexpr CaseRow files[] = {
  // file                                         if                    template
  {"0/U",                                         "",                   "0/U"},
  {"0/p",                                         "",                   "0/p"},
  {"0/k",                                         "",                   "0/k"},
  {"0/nut",                                       "",                   "0/nut"},
  {"0/epsilon",                                   "",                   "0/epsilon"},
  {"0/omega",                                     "",                   "0/omega"},
  {"0/age",                                       "opencfd",            "0/age"}, // the Foundation's function makes it
  {"0/T",                                         "",                   "0/T"},
  {"0/scalar",                                    "",                   "0/scalar"}, // one for each passive scalar
  {"constant/transportProperties",                "opencfd",            "constant/transportProperties"},
  {"constant/physicalProperties",                 "foundation",         "constant/physicalProperties"},
  {"constant/turbulenceProperties",               "opencfd",            "constant/turbulenceProperties"},
  {"constant/momentumTransport",                  "foundation-11",      "constant/momentumTransport"},
  {"constant/momentumTransport",                  "foundation-14",      "constant/momentumTransport.foundation-14"},
  {"constant/atmosphericBoundaryLayerProperties", "foundation-14 wind", "constant/atmosphericBoundaryLayerProperties"},
  {"constant/g",                                  "warmAir",            "constant/g"},
  {"constant/fvOptions",                          "fvOptions",          "constant/fvOptions"},
  {"constant/fvModels",                           "fvModels",           "constant/fvModels"},
  {"system/controlDict",                          "meshOnly",           "mesh/controlDict"},
  {"system/controlDict",                          "",                   "system/controlDict"},
  {"system/fvSchemes",                            "meshOnly",           "mesh/fvSchemes"},
  {"system/fvSchemes",                            "",                   "system/fvSchemes"},
  {"system/fvSolution",                           "meshOnly",           "mesh/fvSolution"},
  {"system/fvSolution",                           "warmAir",            "system/fvSolution.warmAir"},
  {"system/fvSolution",                           "",                   "system/fvSolution"},
  {"system/blockMeshDict",                        "emptyDomain",        "emptyDomain/blockMeshDict"},
  {"system/decomposeParDict",                     "parallel",           "system/decomposeParDict"},
  {"Allrun",                                      "rose",               "rose/script"},
  {"Allrun",                                      "",                   "Allrun"},
  {"Allclean",                                    "rose",               "rose/script"},
  {"Allclean",                                    "",                   "Allclean"},
};

constexpr CaseRow conditions[] = {
  // field                if                            template
  {"p",                   "screen",                     "boundary/p/screen"},
  {"p",                   "fan opencfd",                "boundary/p/fan.opencfd"},
  {"p",                   "fan foundation",             "boundary/p/fan.foundation"},
  {"*",                   "screen|fan",                 "boundary/cyclic"},
  {"*",                   "constraint",                 "boundary/constraint"},
  {"U|p|k|epsilon|omega", "slip",                       "boundary/slip"},

  {"U",                   "inletBySpeed",               "boundary/U/inletBySpeed"},
  {"U",                   "inletByFlow",                "boundary/U/inletByFlow"},
  {"U",                   "windInlet foundation-14",    "boundary/U/wind.foundation-14"},
  {"U",                   "windInlet",                  "boundary/U/wind"},
  {"U",                   "opening",                    "boundary/U/opening"},
  {"U",                   "outlet",                     "boundary/U/outlet"},
  {"U",                   "ground|wall|roughWall",      "boundary/U/wall"},

  {"p",                   "windBothWays",               "boundary/p/windBothWays"},
  {"p",                   "opening",                    "boundary/p/opening"},
  {"p",                   "outlet",                     "boundary/p/outlet"},
  {"p",                   "warmAir ground|wall|roughWall", "boundary/p/wallOfWarmAir"},
  {"p",                   "",                           "boundary/zeroGradient"},

  {"k",                   "inletBySpeed|inletByFlow",   "boundary/k/inlet"},
  {"k",                   "windInlet foundation-14",    "boundary/k/wind.foundation-14"},
  {"k",                   "windInlet",                  "boundary/k/wind"},
  {"k",                   "opening|outlet",             "boundary/k/outlet"},
  {"k",                   "ground|wall|roughWall",      "boundary/k/wall"},

  {"epsilon",             "inletBySpeed|inletByFlow",   "boundary/epsilon/inlet"},
  {"epsilon",             "windInlet foundation-14",    "boundary/epsilon/wind.foundation-14"},
  {"epsilon",             "windInlet",                  "boundary/epsilon/wind"},
  {"epsilon",             "opening|outlet",             "boundary/epsilon/outlet"},
  {"epsilon",             "ground|wall|roughWall",      "boundary/epsilon/wall"},

  {"omega",               "inletBySpeed|inletByFlow",   "boundary/omega/inlet"},
  {"omega",               "windInlet opencfd-2006",     "boundary/omega/wind.opencfd-2006"},
  {"omega",               "windInlet",                  "boundary/omega/wind"},
  {"omega",               "opening|outlet",             "boundary/omega/outlet"},
  {"omega",               "ground|wall|roughWall",      "boundary/omega/wall"},

  {"nut",                 "ground opencfd-2006",        "boundary/nut/ground.opencfd-2006"},
  {"nut",                 "ownRoughness foundation-14", "boundary/nut/groundOfPatch.foundation-14"},
  {"nut",                 "ground foundation-14",       "boundary/nut/ground.foundation-14"},
  {"nut",                 "ground",                     "boundary/nut/ground"},
  {"nut",                 "wall",                       "boundary/nut/wall"},
  {"nut",                 "roughWall",                  "boundary/nut/roughWall"},
  {"nut",                 "",                           "boundary/nut/calculated"},

  {"age",                 "slip|ground|wall|roughWall", "boundary/zeroGradient"},
  {"age",                 "",                           "boundary/age/outlet"},

  {"T",                   "surfaceSource",              "boundary/T/heatedSurface"},
  {"T",                   "fixedTemperature",           "boundary/T/fixed"},
  {"T",                   "windBothWays|opening|outlet", "boundary/T/opening"},
  {"T",                   "slip|ground|wall|roughWall", "boundary/zeroGradient"},
  {"T",                   "",                           "boundary/T/fixed"},

  {"scalar",              "surfaceSource",              "boundary/scalar/source"},
  {"scalar",              "slip|ground|wall|roughWall", "boundary/zeroGradient"},
  {"scalar",              "",                           "boundary/scalar/opening"},
};

constexpr CaseRow parts[] = {
  // name in templates if                     template
  {"boundaryField",    "",                    "boundary/boundaryField"},
  {"namedPatch",       "",                    "boundary/patch"},
  {"processorPatches", "parallel",            "boundary/processors"},
  {"windProfile",      "opencfd-2006",        "boundary/windProfile.opencfd-2006"},
  {"windProfile",      "",                    "boundary/windProfile"},

  {"application",      "transient",           "system/application.transient"},
  {"application",      "opencfd",             "system/application.opencfd"},
  {"application",      "foundation",          "system/application.foundation"},
  {"solver",           "opencfd",             "system/solver.opencfd"},
  {"solver",           "foundation",          "system/solver.foundation"},
  {"libraries",        "wind|leaves",         "system/libraries"},
  {"timeControl",      "transient",           "system/timeControl.transient"},
  {"timeControl",      "",                    "system/timeControl"},
  {"divScheme",        "warmAir T",           "system/divScheme.T"},
  {"divScheme",        "",                    "system/divScheme"},
  {"pressureGradient", "warmAir",             "system/pressureGradient"},
  {"pressureGradient", "canopies",            "system/pressureGradientAtLeaves"},
  {"temperatureOfFaces", "warmAir",           "system/temperatureOfFaces"},
  {"algorithm",        "transient",           "system/algorithm.transient"},
  {"algorithm",        "",                    "system/algorithm.steady"},
  {"fieldSolver",      "age foundation-14",   "system/ageSolver.foundation-14"},
  {"scalarRelaxation", "",                    "system/scalarRelaxation"},

  {"forces",           "walls",               "functions/forces"},
  {"pedestrians",      "pedestrians",         "functions/pedestrians"},
  {"flowFunction",     "",                    "functions/flow"},
  {"flowRegion",       "opencfd",             "functions/flowRegion.opencfd"},
  {"flowRegion",       "foundation-11",       "functions/flowRegion.foundation-11"},
  {"flowRegion",       "foundation-14",       "functions/flowRegion.foundation-14"},
  {"flowOperation",    "bothWays",            "functions/flowBothWays"},
  {"flowOperation",    "opencfd",             "functions/flowSum.opencfd"},
  {"flowOperation",    "foundation",          "functions/flowSum.foundation"},
  {"average",          "opencfd",             "functions/average.opencfd"},
  {"average",          "foundation",          "functions/average.foundation"},
  {"ageFunction",      "ageOfAir opencfd",    "functions/age.opencfd"},
  {"ageFunction",      "ageOfAir foundation", "functions/age.foundation"},
  {"youngOutdoors",    "outdoorsAtRest",      "functions/youngOutdoors"},
  {"temperatureFunction", "",                 "functions/temperature"},
  {"heatSource",       "",                    "functions/heatSource"},
  {"faceHeat",         "",                    "functions/faceHeat"},
  {"heatOfOpening",    "",                    "functions/heatOfOpening"},
  {"heatOfPatch",      "",                    "functions/heatOfPatch"},
  {"meanInZone",       "opencfd",             "functions/meanInZone"},
  {"meanOfAll",        "opencfd",             "functions/meanOfAll"},
  {"surfaceHeat",      "",                    "functions/surfaceHeat"},
  {"heatOfSurface",    "",                    "functions/heatOfSurface"},
  {"surfaceTemperature", "",                  "functions/surfaceTemperature"},
  {"buoyancy",         "",                    "models/buoyancy"},
  {"scalarFunction",   "opencfd",             "functions/scalar.opencfd"},
  {"scalarFunction",   "foundation",          "functions/scalar.foundation"},
  {"scalarSource",     "opencfd",             "functions/scalarSource.opencfd"},
  {"scalarSource",     "foundation",          "functions/scalarSource.foundation"},
  {"canopy",           "leaves",              "models/canopyTurbulence"},
  {"canopy",           "",                    "models/canopy"},
  {"baffle",           "",                    "models/baffle"},
  {"porosityModel",    "foundation-14",       "models/porosity.foundation-14"},
  {"porosityModel",    "",                    "models/porosity"},
  {"cellSelection",    "opencfd",             "models/selection.opencfd"},
  {"axes",             "opencfd",             "models/axes.opencfd"},
  {"axes",             "foundation",          "models/axes.foundation"},
  {"scalarFlow",       "",                    "functions/scalarFlow"},
  {"scalarSum",        "opencfd",             "functions/scalarSum.opencfd"},
  {"scalarSum",        "foundation",          "functions/scalarSum.foundation"},

  {"constraints",      "undivided",           "system/constraints"},

  {"side",             "",                    "emptyDomain/side"},
  {"profiles",         "emptyDomain",         "emptyDomain/profiles"},
  {"probedPatch",      "opencfd",             "emptyDomain/probedPatch.opencfd"},
  {"probedPatch",      "foundation",          "emptyDomain/probedPatch.foundation"},

  {"runsBefore",       "checkProfile",        "emptyDomain/Allrun.case"},
  {"runsBefore",       "emptyDomain",         "emptyDomain/Allrun.mesh"},
  {"cleanedToo",       "checkProfile",        "emptyDomain/Allclean.case"},
  {"cleanedToo",       "emptyDomain",         "emptyDomain/Allclean.mesh"},
  {"runs",             "parallel",            "Allrun.parallel"},
  {"runs",             "",                    "Allrun.serial"},
  {"runOfDirection",   "",                    "rose/direction"},
};

// clang-format on

std::vector<std::string_view> split(std::string_view text, char separator)
{
  std::vector<std::string_view> words;
  while (!text.empty())
  {
    const std::size_t end = std::min(text.find(separator), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

bool concerns(const CaseRow& row, std::string_view what)
{
  const std::vector<std::string_view> names = split(row.what, '|');
  return row.what == "*" || std::ranges::find(names, what) != names.end();
}

/// Returns the value of a name in a template, or else the text of the part.
Lines valueOf(const std::string& name, std::string_view in, const Filling& filling)
{
  if (const auto value = filling.values.find(name); value != filling.values.end())
  {
    return value->second;
  }
  if (std::ranges::none_of(parts, [&](const CaseRow& row) { return concerns(row, name); }))
  {
    throw Error("the template '" + std::string(in) + "' names '" + name + "', which has no value here and is no part");
  }
  return textOf(parts, name, filling);
}

} // namespace

std::span<const CaseField> caseFields() { return fields; }
std::span<const CaseRow> caseFiles() { return files; }
std::span<const CaseRow> caseConditions() { return conditions; }
std::span<const CaseRow> caseParts() { return parts; }

bool holds(std::string_view when, const Filling& filling)
{
  return std::ranges::all_of(split(when, ' '), [&](std::string_view choices) {
    return std::ranges::any_of(split(choices, '|'),
                               [&](std::string_view fact) { return filling.facts.contains(fact); });
  });
}

const CaseRow* rowOf(std::span<const CaseRow> rows, std::string_view what, const Filling& filling)
{
  const auto found =
      std::ranges::find_if(rows, [&](const CaseRow& row) { return concerns(row, what) && holds(row.when, filling); });
  return found == rows.end() ? nullptr : &*found;
}

Lines textOf(std::span<const CaseRow> rows, std::string_view what, const Filling& filling)
{
  const CaseRow* const row = rowOf(rows, what, filling);
  return row ? fillTemplate(foamTemplate(row->from),
                            [&](const std::string& name) { return valueOf(name, row->from, filling); })
             : Lines();
}

} // namespace atria
