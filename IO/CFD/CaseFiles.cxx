// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFiles.h"

#include "FoamText.h"
#include "OutputFolders.h"
#include "PatchNames.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

namespace fs = std::filesystem;

void append(Lines& lines, const Lines& more) { lines.insert(lines.end(), more.begin(), more.end()); }

/// Returns names as alternatives of a pattern.
std::string alternatives(const std::vector<std::string>& names)
{
  std::string pattern;
  for (const std::string& name : names)
  {
    pattern += (pattern.empty() ? "" : "|") + name;
  }
  return pattern;
}

// Fields and their boundary conditions

std::string fileOf(const CaseField& field) { return "0/" + std::string(field.name); }
std::string rowOfFile(const CaseField& field) { return "0/" + std::string(field.row); }

/// Returns the fields that have a file.
std::vector<CaseField> writtenFields(const CaseOfDirection& flow, const Filling& filling)
{
  std::vector<CaseField> written;
  for (const CaseField& field : fieldsOf(flow))
  {
    if (holds(field.when, filling) && rowOf(caseFiles(), rowOfFile(field), filling))
    {
      written.push_back(field);
    }
  }
  return written;
}

void checkFieldNames(const std::vector<ConditionRule>& rules, const std::vector<CaseField>& fields)
{
  std::vector<std::string> names;
  names.reserve(fields.size());
  for (const CaseField& field : fields)
  {
    names.emplace_back(field.name);
  }
  for (const ConditionRule& rule : rules)
  {
    if (std::find(names.begin(), names.end(), rule.field) == names.end())
    {
      throw Error("the condition of '" + rule.pattern + "': the case has no field '" + rule.field + "'; " +
                  namesInstead(rule.field, names));
    }
  }
}

Filling ofField(Filling filling, const CaseOfDirection& flow, const CaseField& field, std::size_t patch)
{
  if (const CaseScalar* const scalar = scalarOf(flow, field))
  {
    addScalarAt(filling, *scalar, flow.mesh.patches[patch]);
  }
  if (field.kind == FieldKind::Temperature)
  {
    addTemperatureAt(filling, flow, flow.mesh.patches[patch]);
  }
  return filling;
}

/// True if a wall differs from other walls in a field.
bool isOwnWall(const Filling& filling)
{
  return filling.facts.contains("surfaceSource") || filling.facts.contains("fixedTemperature");
}

/// Returns the dictionaries of a field's patches, except those that are as all walls.
Lines patchesOf(const CaseField& field, const CaseOfDirection& flow, const std::vector<Filling>& fillings)
{
  Lines lines;
  for (std::size_t i = 0; i < flow.choices.size(); ++i)
  {
    const bool isSymmetry = fillings[i].facts.contains("emptyDomain") && fillings[i].facts.contains("constraint");
    const ConditionRule* const rule =
        isSymmetry ? nullptr : conditionOf(flow.settings, std::string(field.name), flow.mesh.patches[i].name);
    const bool hasSources = scalarOf(flow, field) || field.kind == FieldKind::Temperature;
    if (!rule && flow.choices[i].role == PatchRole::Wall && !hasSources)
    {
      continue;
    }
    Filling its = ofField(fillings[i], flow, field, i);
    if (rule || flow.choices[i].role != PatchRole::Wall || isOwnWall(its))
    {
      its.values["condition"] = rule ? Lines{rule->entries} : textOf(caseConditions(), field.row, its);
      append(lines, textOf(caseParts(), "namedPatch", its));
    }
  }
  return lines;
}

/// Returns the dictionaries of the sides of screens and fans.
Lines sidesOf(const CaseField& field, const CaseOfDirection& flow, const Filling& filling)
{
  Lines lines;
  for (const CaseBaffle& baffle : flow.baffles)
  {
    Filling its = filling;
    addBaffle(its, baffle);
    its.values["condition"] = textOf(caseConditions(), field.row, its);
    for (const std::string& side : sidesOfZone(baffle.zone))
    {
      its.values["patch"] = {side};
      append(lines, textOf(caseParts(), "namedPatch", its));
    }
  }
  return lines;
}

void writeFields(const fs::path& folder, const CaseOfDirection& flow, const Filling& filling)
{
  Filling walls = filling;
  addPatch(walls, flow, {}, {});
  std::vector<Filling> patches(flow.choices.size(), filling);
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    addPatch(patches[i], flow, flow.mesh.patches[i], flow.choices[i]);
  }
  const std::vector<CaseField> fields = writtenFields(flow, filling);
  checkFieldNames(flow.settings.conditionRules, fields);
  for (const CaseField& field : fields)
  {
    Filling its = filling;
    its.values["conditionOfWalls"] = textOf(caseConditions(), field.row, walls);
    its.values["patches"] = patchesOf(field, flow, patches);
    append(its.values["patches"], sidesOf(field, flow, filling));
    if (const CaseScalar* const scalar = scalarOf(flow, field))
    {
      its.values["scalarStart"] = {foamNumber(startOf(*scalar, flow.mesh, flow.choices))};
    }
    writeFoamFile(folder, fileOf(field), field.className, textOf(caseFiles(), rowOfFile(field), its));
  }
}

// Lists in the dictionaries

Filling withField(Filling filling, const CaseField& field)
{
  filling.facts.emplace(field.name);
  filling.values["field"] = {std::string(field.name)};
  return filling;
}

/// Adds what fvSchemes lists by field.
void addFieldSchemes(Filling& filling, const std::vector<CaseField>& fields)
{
  Lines schemes;
  std::vector<std::string> turbulence;
  for (const CaseField& field : fields)
  {
    const bool isTurbulence = field.kind == FieldKind::Turbulence;
    const bool isTemperature = field.kind == FieldKind::Temperature;
    if (holds(field.when, filling) && (isTurbulence || isTemperature || field.kind == FieldKind::Scalar))
    {
      append(schemes, textOf(caseParts(), "divScheme", withField(filling, field)));
    }
    if (holds(field.when, filling) && (isTurbulence || isTemperature))
    {
      turbulence.emplace_back(field.name);
    }
  }
  filling.values["divSchemes"] = schemes;
  filling.values["turbulenceFields"] = {alternatives(turbulence)};
}

/// Adds what fvSolution lists by field. Entries of fields that a case lacks do no harm.
void addFieldSolvers(Filling& filling, const std::vector<CaseField>& fields)
{
  std::vector<std::string> alike;
  Lines others;
  Lines relaxations;
  for (const CaseField& field : fields)
  {
    const Filling its = withField(filling, field);
    const Lines solver = textOf(caseParts(), "fieldSolver", its);
    const bool isOfCase = field.kind != FieldKind::Temperature || holds(field.when, filling);
    if (solver.empty() && field.kind != FieldKind::Derived && isOfCase)
    {
      alike.emplace_back(field.name);
    }
    append(others, solver);
    if (field.kind == FieldKind::Scalar)
    {
      append(relaxations, textOf(caseParts(), "scalarRelaxation", its));
    }
  }
  filling.values["fieldsSolvedAlike"] = {alternatives(alike)};
  filling.values["otherSolvers"] = others;
  filling.values["scalarRelaxations"] = relaxations;
}

/// Returns a function that sums the flow through a patch or a face zone.
Lines flowFunction(Filling filling, const std::string& function, const std::string& type, const std::string& name)
{
  filling.values["function"] = {function + "_" + name};
  filling.values["regionType"] = {type};
  filling.values["region"] = {name};
  return textOf(caseParts(), filling.facts.contains("carried") ? "scalarFlow" : "flowFunction", filling);
}

/// Returns the names of the patches that air passes.
std::vector<std::string> passagesOf(const CaseOfDirection& flow)
{
  std::vector<std::string> names;
  for (const PatchRole role : {PatchRole::Inlet, PatchRole::Outlet, PatchRole::InletOutlet})
  {
    const std::vector<std::string> more = flow.namesOf(role);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

/// Adds the functions of all flows. With signs and without, the sums of an opening give what flows either way.
void addFlows(Filling& filling, const CaseOfDirection& flow)
{
  Filling bothWays = filling;
  bothWays.facts.insert("bothWays");
  Lines flows;
  for (const CaseOpening& opening : flow.mesh.openings)
  {
    append(flows, flowFunction(filling, "flow", "faceZone", opening.name));
    append(flows, flowFunction(bothWays, "flowBothWays", "faceZone", opening.name));
  }
  for (const std::string& patch : passagesOf(flow))
  {
    append(flows, flowFunction(filling, "flow", "patch", patch));
  }
  filling.values["flows"] = flows;
}

/// Returns a part for each name, which it calls `as`.
Lines partsFor(const std::vector<std::string>& names, const char* as, const char* part, Filling filling)
{
  Lines lines;
  for (const std::string& name : names)
  {
    filling.values[as] = {name};
    append(lines, textOf(caseParts(), part, filling));
  }
  return lines;
}

/// Returns functions of the mean of a field in each cell zone and in all air.
Lines meansOf(const std::string& field, const CaseOfDirection& flow, Filling filling)
{
  filling.values["field"] = {field};
  std::vector<std::string> rooms;
  std::ranges::transform(flow.mesh.rooms, std::back_inserter(rooms), &CaseRoom::name);
  Lines means = partsFor(rooms, "zone", "meanInZone", filling);
  append(means, textOf(caseParts(), "meanOfAll", filling));
  return means;
}

/// Returns the sources of a scalar in cell zones.
Lines sourcesOf(const CaseScalar& scalar, Filling filling)
{
  Lines sources;
  for (const auto& [zone, amount] : scalar.zones)
  {
    filling.values["zone"] = {zone};
    filling.values["amountOfSource"] = {foamNumber(amount)};
    append(sources, textOf(caseParts(), "scalarSource", filling));
  }
  return sources;
}

/// Adds the functions that carry scalars along, and sum what flows through patches. OpenCFD's have the sources in them,
/// the Foundation's take them from fvModels.
void addScalars(Filling& filling, const CaseOfDirection& flow)
{
  Lines functions;
  Lines models;
  for (const CaseScalar& scalar : flow.scalars)
  {
    Filling its = filling;
    its.facts.insert("carried");
    its.values["scalar"] = {scalar.name};
    its.values["sourcesOfScalar"] = sourcesOf(scalar, its);
    append(functions, textOf(caseParts(), "scalarFunction", its));
    append(functions, meansOf(scalar.name, flow, its));
    append(models, its.values["sourcesOfScalar"]);
    for (const std::string& patch : passagesOf(flow))
    {
      append(functions, flowFunction(its, "flow_" + scalar.name, "patch", patch));
    }
  }
  filling.values["scalarFunctions"] = functions;
  filling.values["fvModels"] = models;
}

/// Returns the sources of heat in cell zones.
Lines heatSources(const CaseOfDirection& flow, Filling filling)
{
  Lines sources;
  for (const auto& [zone, watts] : flow.heat.zones)
  {
    filling.values["zone"] = {zone};
    filling.values["heat"] = {foamNumber(watts)};
    filling.values["heatOverCapacity"] = {foamNumber(watts / warmAirAt(flow.settings.outdoorTemperature).heatCapacity)};
    append(sources, textOf(caseParts(), "heatSource", filling));
  }
  return sources;
}

template <class Map> std::vector<std::string> namesIn(const Map& map)
{
  std::vector<std::string> names;
  names.reserve(map.size());
  for (const auto& [name, value] : map)
  {
    names.push_back(name);
  }
  return names;
}

/// Adds buoyancy, the function that carries the temperature along, and what is measured of temperatures and heat.
void addHeat(Filling& filling, const CaseOfDirection& flow)
{
  std::vector<std::string> openings;
  std::ranges::transform(flow.mesh.openings, std::back_inserter(openings), &CaseOpening::name);
  filling.values["heatSources"] = heatSources(flow, filling);
  Lines functions = textOf(caseParts(), "temperatureFunction", filling);
  if (!openings.empty())
  {
    append(functions, textOf(caseParts(), "faceHeat", filling));
  }
  append(functions, partsFor(openings, "zone", "heatOfOpening", filling));
  append(functions, partsFor(passagesOf(flow), "patch", "heatOfPatch", filling));
  append(functions, meansOf("T", flow, filling));
  if (!flow.heat.temperatures.empty())
  {
    append(functions, textOf(caseParts(), "surfaceHeat", filling));
  }
  append(functions, partsFor(namesIn(flow.heat.temperatures), "patch", "heatOfSurface", filling));
  append(functions, partsFor(namesIn(flow.heat.surfaces), "patch", "surfaceTemperature", filling));
  filling.values["heatFunctions"] = functions;
  append(filling.values["fvOptions"], textOf(caseParts(), "buoyancy", filling));
}

/// Adds the sinks of canopies to the models. The coefficient f of Darcy and Forchheimer takes f |U| U / 2 from the air.
void addCanopies(Filling& filling, const CaseOfDirection& flow)
{
  Lines canopies;
  for (const CaseCanopy& canopy : flow.canopies)
  {
    Filling its = filling;
    its.values["zone"] = {canopy.zone};
    its.values["inertia"] = {foamNumber(2.0 * canopy.dragCoefficient * canopy.leafAreaDensity)};
    its.values["leafAreaDensity"] = {foamNumber(canopy.leafAreaDensity)};
    its.values["dragCoefficient"] = {foamNumber(canopy.dragCoefficient)};
    its.values["canopySurface"] = {surfaceFileOf(canopy)};
    its.values["canopySpan"] = {foamNumber(canopy.smallLength)};
    its.values["firstAxis"] = {foamVector(Vec3::UnitX())};
    its.values["secondAxis"] = {foamVector(Vec3::UnitY())};
    append(canopies, textOf(caseParts(), "canopy", its));
  }
  append(filling.values["fvOptions"], canopies);
  append(filling.values["fvModels"], canopies);
}

/// Adds the models that steady the pressure at screens and fans.
void addBaffles(Filling& filling, const CaseOfDirection& flow)
{
  Lines models;
  for (const CaseBaffle& baffle : flow.baffles)
  {
    Filling its = filling;
    addBaffle(its, baffle);
    append(models, isSteadied(baffle) ? textOf(caseParts(), "baffle", its) : Lines());
  }
  append(filling.values["fvOptions"], models);
  append(filling.values["fvModels"], models);
}

void addWalls(Filling& filling, const CaseOfDirection& flow)
{
  std::vector<std::string> walls = flow.walls();
  for (std::string& name : walls)
  {
    name.insert(0, 1, '"').push_back('"');
  }
  filling.values["walls"] = {foamList(walls)};
}

void addProbes(Filling& filling, const std::vector<Vec3>& probes)
{
  for (const Vec3& place : probes)
  {
    filling.values["probes"].push_back(foamVector(place));
  }
}

/// Returns the class of a dictionary's file: the acceleration of gravity is a value with dimensions.
const char* classOf(std::string_view file)
{
  return file == "constant/g" ? "uniformDimensionedVectorField" : "dictionary";
}

/// True for a dictionary, which is neither a field nor a script.
bool isDictionary(std::string_view file) { return file.starts_with("constant/") || file.starts_with("system/"); }

void writeDictionaries(const fs::path& folder, const Filling& filling)
{
  for (const CaseRow& row : caseFiles())
  {
    if (isDictionary(row.what) && rowOf(caseFiles(), row.what, filling) == &row)
    {
      writeFoamFile(folder, row.what, classOf(row.what), textOf(caseFiles(), row.what, filling));
    }
  }
}

/// Writes the surfaces of canopies, where OpenFOAM looks for surfaces.
void writeSurfaces(const fs::path& folder, const CaseOfDirection& flow)
{
  const fs::path place = folder / surfaceFolder(flow.settings.dialect);
  for (std::size_t i = 0; flow.leavesMakeTurbulence() && i < flow.canopies.size(); ++i)
  {
    makeFolder(place);
    writePlainFile(place / surfaceFileOf(flow.canopies[i]), surfaceOf(flow.canopies[i]));
  }
}

void writeScripts(const fs::path& folder, const Filling& filling)
{
  for (const char* script : {"Allrun", "Allclean"})
  {
    writeScript(folder / script, textOf(caseFiles(), script, filling));
  }
}

} // namespace

std::string surfaceFolder(OpenFOAMDialect dialect)
{
  return isFoundation(dialect) ? "constant/geometry" : "constant/triSurface";
}

void writeCaseFiles(const fs::path& folder, const CaseOfDirection& flow, Filling more)
{
  Filling filling = fillingOf(flow);
  filling.facts.merge(more.facts);
  more.values.merge(filling.values);
  filling.values = std::move(more.values);
  writeFields(folder, flow, filling);
  addFieldSchemes(filling, fieldsOf(flow));
  addFieldSolvers(filling, fieldsOf(flow));
  addFlows(filling, flow);
  addScalars(filling, flow);
  addCanopies(filling, flow);
  addBaffles(filling, flow);
  filling.values["heatFunctions"] = {};
  if (flow.settings.warmAir)
  {
    addHeat(filling, flow);
  }
  addWalls(filling, flow);
  addProbes(filling, flow.probes);
  writeDictionaries(folder, filling);
  writeSurfaces(folder, flow);
  writeScripts(folder, filling);
}

void writeRoseScripts(const fs::path& folder, const std::vector<std::string>& folders)
{
  for (const char* script : {"Allrun", "Allclean"})
  {
    Filling filling{{"rose"}, {{"script", {script}}}};
    Lines runs;
    for (const std::string& direction : folders)
    {
      filling.values["folder"] = {direction};
      append(runs, textOf(caseParts(), "runOfDirection", filling));
    }
    filling.values["directions"] = runs;
    writeScript(folder / script, textOf(caseFiles(), script, filling));
  }
}

} // namespace atria
