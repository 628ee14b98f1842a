// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseValues.h"

#include "FoamText.h"
#include "ProcessorFolders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace atria {

namespace {

constexpr double airViscosity = 1.5e-5; ///< kinematic viscosity at 15 degrees Celsius, m2/s
/// E of OpenFOAM's wall functions. Sand grains of this many roughness lengths give the same profile, with Cs = 1;
/// Blocken, Stathopoulos and Carmeliet (2007), "CFD simulation of the atmospheric boundary layer: wall function
/// problems", Atmospheric Environment 41, 238-252.
constexpr double wallFunctionE = 9.8;
/// Most iterations for the age of air each time it is written.
constexpr int ageCorrectors = 200;
/// Turbulence of air from a duct or a diffuser: speeds vary by a twentieth of their mean. Eddies have this share of the
/// opening's hydraulic diameter.
constexpr double supplyIntensity = 0.05;
constexpr double eddyShare = 0.07;

/// Prandtl numbers of air: its own, and that of its eddies.
constexpr double prandtlNumber = 0.71;
constexpr double turbulentPrandtlNumber = 0.85;
/// Turbulence of calm air: what comes in has little, and a run starts with more, as a model without any stays laminar.
constexpr double calmK = 1e-4;       ///< m2/s2
constexpr double calmEpsilon = 1e-5; ///< m2/s3
constexpr double calmStart = 10.0;   ///< times these at the start
/// Courant number of transient runs, and their steps, seconds.
constexpr double courantNumber = 2.0;
constexpr double firstStep = 0.01;
constexpr double greatestStep = 1.0;
/// Fields written in a transient run.
constexpr int transientTimes = 10;

/// Diffusivity of a scalar over the viscosity: of CO2 in air, and for the eddies, 1 over the Schmidt number of 0.7.
constexpr double molecularDiffusivity = 1.0;
constexpr double turbulentDiffusivity = 1.0 / 0.7;

using Values = std::map<std::string, Lines, std::less<>>;

void add(Values& values, const char* name, const std::string& value) { values[name] = {value}; }
void add(Values& values, const char* name, double value) { values[name] = {foamNumber(value)}; }
void add(Values& values, const char* name, const Vec3& value) { values[name] = {foamVector(value)}; }

/// Values of the turbulence model.
struct Turbulence
{
  double k = 0.0;       ///< m2/s2
  double epsilon = 0.0; ///< m2/s3
  double omega = 0.0;   ///< 1/s
};

/// Returns four areas over the perimeter of a rectangle with the patch's area and diagonal, meters.
double hydraulicDiameter(const CasePatch& patch)
{
  return 2.0 * patch.area / std::sqrt(patch.bounds.size().squaredNorm() + 2.0 * patch.area);
}

/// Returns the turbulence of a jet with a speed, m/s, out of an opening with a hydraulic diameter, meters.
Turbulence turbulenceOf(double speed, double diameter)
{
  const double k = 1.5 * supplyIntensity * speed * supplyIntensity * speed;
  const double length = eddyShare * diameter;
  return {k, std::pow(turbulenceCmu, 0.75) * std::pow(k, 1.5) / length,
          std::sqrt(k) / (std::pow(turbulenceCmu, 0.25) * length)};
}

Turbulence turbulenceOf(const Supply& supply, const CasePatch& patch)
{
  return turbulenceOf(supply.speed(patch.area), hydraulicDiameter(patch));
}

/// Returns the turbulence of calm air, or where the strongest fan's pressure becomes speed.
Turbulence turbulenceOfCalmAir(const CaseOfDirection& flow)
{
  Turbulence found{calmK, calmEpsilon, calmEpsilon / (turbulenceCmu * calmK)};
  for (const CaseBaffle& baffle : flow.baffles)
  {
    const Turbulence its = turbulenceOf(speedOf(baffle), std::sqrt(baffle.area));
    found = its.k > found.k ? its : found;
  }
  return found;
}

/// Returns the turbulence of the wind at its reference height, or, in a room, of the inlet with the largest flow rate.
Turbulence typicalTurbulence(const CaseOfDirection& flow)
{
  double most = 0.0;
  Turbulence found;
  for (std::size_t i = 0; flow.isRoom() && i < flow.choices.size(); ++i)
  {
    const auto& supply = flow.choices[i].supply;
    const CasePatch& patch = flow.mesh.patches[i];
    if (supply && patch.area > 0.0 && supply->flowRate(patch.area) > most)
    {
      most = supply->flowRate(patch.area);
      found = turbulenceOf(*supply, patch);
    }
  }
  if (flow.settings.calm && !(most > 0.0))
  {
    return turbulenceOfCalmAir(flow);
  }
  const WindProfile& wind = flow.settings.wind;
  const double z = wind.referenceHeight;
  return flow.isRoom() ? found : Turbulence{wind.kineticEnergy(), wind.dissipation(z), wind.specificDissipation(z)};
}

/// Returns a table of the wind's omega over the height above the patch's lowest point, finer near the ground.
std::string omegaOverHeight(const WindProfile& wind, const CasePatch& patch)
{
  constexpr int rows = 40;
  const double top = patch.bounds.size()[2];
  std::string table;
  for (int i = 0; i <= rows; ++i)
  {
    const double z = wind.roughness * (std::pow(1.0 + top / wind.roughness, static_cast<double>(i) / rows) - 1.0);
    table += (i == 0 ? "(" : " (") + foamNumber(z) + " " + foamNumber(wind.specificDissipation(z)) + ")";
  }
  return table;
}

/// Returns the number of iterations between written fields. It divides `iterations`: OpenFOAM does not write at the end
/// by itself.
int iterationsBetweenFields(int iterations)
{
  constexpr int most = 500;
  const int times = (iterations + most - 1) / most;
  return times > 1 && iterations % times == 0 ? iterations / times : std::max(1, iterations);
}

const char* factOf(OpenFOAMDialect dialect)
{
  constexpr const char* names[] = {"opencfd-1912", "opencfd-2006", "foundation-11", "foundation-14"};
  return names[static_cast<std::size_t>(dialect)];
}

const char* factOf(const CaseOfDirection& flow, const PatchChoice& choice)
{
  if (choice.supply)
  {
    return choice.supply->quantity == Supply::Speed ? "inletBySpeed" : "inletByFlow";
  }
  switch (choice.role)
  {
    case PatchRole::Inlet:
      return "windInlet";
    case PatchRole::InletOutlet:
      return flow.hasWind() ? "windBothWays" : "opening";
    case PatchRole::Outlet:
      return "outlet";
    case PatchRole::Slip:
      return "slip";
    case PatchRole::Ground:
      return "ground";
    case PatchRole::RoughWall:
      return "roughWall";
    case PatchRole::Constraint:
      return "constraint";
    default:
      return "wall";
  }
}

/// Returns a direction at a right angle to another one, length 1.
Vec3 directionAcross(const Vec3& direction)
{
  int axis = 0;
  direction.cwiseAbs().minCoeff(&axis);
  return (Vec3::Unit(axis) - direction[axis] * direction).normalized();
}

/// Returns the steepest change of a baffle's pressure over the speed through it, Pa for each m/s, without the part of
/// the resistance.
double steepness(const CaseBaffle& baffle)
{
  double steepest = baffle.linear;
  for (std::size_t i = 1; i < baffle.curve.size(); ++i)
  {
    const auto& [flow, pressure] = baffle.curve[i];
    const auto& [flowBefore, pressureBefore] = baffle.curve[i - 1];
    steepest = std::max(steepest, (pressureBefore - pressure) * baffle.area / (flow - flowBefore));
  }
  return steepest;
}

/// Returns the jump of p over the flow rate, divided by `area`.
std::string fanFunction(const FanCurve& curve, double area)
{
  if (curve.size() == 1)
  {
    return "constant " + foamNumber(curve[0].second / airDensity);
  }
  std::vector<std::string> points;
  for (const auto& [flow, pressure] : curve)
  {
    points.push_back(foamList(std::array{foamNumber(flow / area), foamNumber(pressure / airDensity)}));
  }
  return "table " + foamList(points);
}

/// True if the case has porosity: leaves, or what steadies the pressure at screens and fans.
bool hasPorosity(const CaseOfDirection& flow)
{
  return !flow.canopies.empty() || std::ranges::any_of(flow.baffles, isSteadied);
}

/// True if the Foundation's file fvModels has entries.
bool hasModels(const CaseOfDirection& flow)
{
  const bool hasSources =
      std::ranges::any_of(flow.scalars, [](const CaseScalar& scalar) { return !scalar.zones.empty(); });
  return isFoundation(flow.settings.dialect) && (hasSources || hasPorosity(flow));
}

void addFacts(Filling& filling, const CaseOfDirection& flow)
{
  const FlowCaseSettings& settings = flow.settings;
  filling.facts = {factOf(settings.dialect), isFoundation(settings.dialect) ? "foundation" : "opencfd",
                   flow.isRoom() ? "room" : "wind", modelName(settings.turbulence)};
  const std::pair<const char*, bool> others[] = {
      {"ageOfAir", settings.ageOfAir},
      {"fvModels", hasModels(flow)},
      {"fvOptions", !isFoundation(settings.dialect) && (hasPorosity(flow) || settings.warmAir)},
      {"canopies", !flow.canopies.empty()},
      {"leaves", flow.leavesMakeTurbulence()},
      {"warmAir", settings.warmAir},
      {"transient", settings.transientDuration > 0.0},
      {"outdoorsAtRest", settings.calm && flow.mesh.hasOutdoors},
      {"pedestrians", !flow.probes.empty()},
      {"walls", !flow.walls().empty()},
      {"checkProfile", settings.checkProfile && flow.hasWind()}};
  for (const auto& [fact, isTrue] : others)
  {
    if (isTrue)
    {
      filling.facts.insert(fact);
    }
  }
}

void addWind(Values& values, const CaseOfDirection& flow)
{
  const WindProfile& wind = flow.settings.wind;
  add(values, "windDirection", flow.wind);
  add(values, "windSpeed", wind.speed);
  add(values, "windHeight", wind.referenceHeight);
  add(values, "windVelocity", Vec3(wind.speed * flow.wind));
  add(values, "roughness", wind.roughness);
}

void addModel(Values& values, const CaseOfDirection& flow)
{
  const Turbulence typical = typicalTurbulence(flow);
  add(values, "turbulenceModel",
      flow.leavesMakeTurbulence() ? "kEpsilonLopesdaCosta" : modelName(flow.settings.turbulence));
  add(values, "k", typical.k);
  add(values, "epsilon", typical.epsilon);
  add(values, "omega", typical.omega);
  add(values, "airViscosity", airViscosity);
  add(values, "airDensity", airDensity);
  add(values, "molecularDiffusivity", molecularDiffusivity);
  add(values, "turbulentDiffusivity", turbulentDiffusivity);
}

/// Adds initial values: those of the typical turbulence, in air at rest.
void addStart(Values& values, const CaseOfDirection& flow)
{
  const Turbulence typical = typicalTurbulence(flow);
  const double factor = flow.settings.calm ? calmStart : 1.0;
  add(values, "initialVelocity", "uniform " + foamVector(Vec3::Zero()));
  add(values, "initialK", "uniform " + foamNumber(factor * typical.k));
  add(values, "initialEpsilon", "uniform " + foamNumber(factor * typical.epsilon));
  add(values, "initialOmega", "uniform " + foamNumber(typical.omega));
}

/// Adds the properties of warm air and of its buoyancy.
void addWarmAir(Values& values, const CaseOfDirection& flow)
{
  const WarmAir air = warmAirAt(flow.settings.outdoorTemperature);
  add(values, "outdoorTemperature", flow.settings.outdoorTemperature);
  add(values, "expansion", air.expansion);
  add(values, "heatCapacity", air.heatCapacity);
  add(values, "heatDiffusivity", 1.0 / prandtlNumber);
  add(values, "turbulentHeatDiffusivity", 1.0 / turbulentPrandtlNumber);
}

void addSchemes(Values& values, const CaseOfDirection& flow)
{
  const double worstAngle = flow.mesh.worstNonOrthogonality;
  const OrthogonalityRule rule = ruleForAngle(worstAngle);
  const bool isTransient = flow.settings.transientDuration > 0.0;
  add(values, "timeScheme", isTransient ? "Euler" : "steadyState");
  add(values, "convectionScheme", isTransient ? "Gauss" : "bounded Gauss");
  add(values, "worstAngle", worstAngle);
  add(values, "correction", rule.correction);
  add(values, "turbulenceCorrection", rule.turbulenceCorrection);
  add(values, "correctors", rule.correctors);
  add(values, "pressureRelaxation", rule.pressureRelaxation);
  add(values, "equationRelaxation", rule.equationRelaxation);
  add(values, "turbulenceRelaxation", rule.turbulenceRelaxation);
}

void addRun(Values& values, const CaseOfDirection& flow)
{
  const Box3& bounds = flow.mesh.bounds;
  add(values, "iterations", flow.settings.iterations);
  add(values, "iterationsBetweenFields", iterationsBetweenFields(flow.settings.iterations));
  if (const double duration = flow.settings.transientDuration; duration > 0.0)
  {
    add(values, "duration", duration);
    add(values, "firstStep", std::min(firstStep, duration));
    add(values, "greatestStep", std::min(greatestStep, duration));
    add(values, "courantNumber", courantNumber);
    add(values, "timeBetweenFields", duration / transientTimes);
    add(values, "averageStart", 0.8 * duration);
  }
  else
  {
    add(values, "averageStart", std::max(1, flow.settings.iterations * 4 / 5));
  }
  add(values, "ageCorrectors", ageCorrectors);
  add(values, "lowestOfMesh", bounds.min[2]);
  add(values, "centerOfGround", Vec3(bounds.center()[0], bounds.center()[1], bounds.min[2]));
}

void addSupply(Values& values, const CasePatch& patch, const Supply& supply)
{
  const Turbulence its = turbulenceOf(supply, patch);
  add(values, supply.quantity == Supply::Speed ? "inletSpeed" : "inletFlow", supply.amount);
  add(values, "inletIntensity", supplyIntensity);
  add(values, "inletMixingLength", eddyShare * hydraulicDiameter(patch));
  add(values, "inletK", its.k);
  add(values, "inletEpsilon", its.epsilon);
  add(values, "inletOmega", its.omega);
}

void addRoughness(Filling& filling, double roughness)
{
  filling.facts.insert("ownRoughness");
  add(filling.values, "roughness", roughness);
  add(filling.values, "sandGrainOfGround", wallFunctionE * roughness);
}

} // namespace

std::array<double, 2> heatDiffusivities() { return {airViscosity / prandtlNumber, 1.0 / turbulentPrandtlNumber}; }

OrthogonalityRule ruleForAngle(double worst)
{
  if (worst <= 60.0)
  {
    return {"corrected", "limited corrected 0.3", 0, 0.9, 0.8, 0.7};
  }
  if (worst <= 70.0)
  {
    return {"limited corrected 0.5", "limited corrected 0.3", 1, 0.9, 0.8, 0.7};
  }
  return {"limited corrected 0.333", "limited corrected 0.333", 2, 0.7, 0.7, 0.5};
}

const char* modelName(TurbulenceModel model)
{
  constexpr const char* names[] = {"kEpsilon", "realizableKE", "kOmegaSST"};
  return names[static_cast<std::size_t>(model)];
}

Filling fillingOf(const CaseOfDirection& flow)
{
  Filling filling;
  addFacts(filling, flow);
  if (!flow.isRoom())
  {
    addWind(filling.values, flow);
  }
  addModel(filling.values, flow);
  addStart(filling.values, flow);
  if (flow.settings.warmAir)
  {
    addWarmAir(filling.values, flow);
  }
  addSchemes(filling.values, flow);
  addRun(filling.values, flow);
  if (flow.settings.processors > 1)
  {
    std::vector<std::string> sides;
    for (const CaseBaffle& baffle : flow.baffles)
    {
      std::ranges::copy(sidesOfZone(baffle.zone), std::back_inserter(sides));
    }
    addDivision(filling, static_cast<std::size_t>(flow.settings.processors), flow.mesh.bounds.size(), sides);
  }
  return filling;
}

void addPatch(Filling& filling, const CaseOfDirection& flow, const CasePatch& patch, const PatchChoice& choice)
{
  filling.facts.insert(factOf(flow, choice));
  add(filling.values, "patch", patch.name);
  add(filling.values, "patchType", patch.type);
  add(filling.values, "lowestOfPatch", patch.bounds.min[2]);
  if (choice.supply)
  {
    return addSupply(filling.values, patch, *choice.supply);
  }
  const bool takesWind = choice.role == PatchRole::Inlet || choice.role == PatchRole::InletOutlet;
  if (takesWind && flow.hasWind())
  {
    filling.facts.insert("windInlet");
    add(filling.values, "omegaOverHeight", omegaOverHeight(flow.settings.wind, patch));
  }
  if (choice.roughness)
  {
    addRoughness(filling, *choice.roughness);
  }
  if (choice.role == PatchRole::RoughWall)
  {
    add(filling.values, "sandGrain", choice.sandGrain);
  }
}

bool isSteadied(const CaseBaffle& baffle) { return baffle.resistance > 0.0 || steepness(baffle) > 0.0; }

void addBaffle(Filling& filling, const CaseBaffle& baffle)
{
  Values& values = filling.values;
  const double uneven = baffle.faceArea / baffle.area;
  filling.facts.insert(baffle.isFan() ? "fan" : "screen");
  add(values, "zone", baffle.zone);
  add(values, "cellsBeside", cellsBesideZone(baffle.zone));
  if (baffle.isFan())
  {
    add(values, "fanOverSpeed", fanFunction(baffle.curve, baffle.faceArea));
    add(values, "fanOverFlow", fanFunction(baffle.curve, 1.0));
  }
  else
  {
    add(values, "screenResistance", baffle.resistance * uneven * uneven);
    add(values, "screenLinear", baffle.linear * uneven / (airDensity * airViscosity));
  }
  add(values, "firstAxis", baffle.normal);
  add(values, "secondAxis", directionAcross(baffle.normal));
  add(values, "steadyingInertia", 2.0 * baffle.resistance / baffle.cellWidth);
  add(values, "steadyingLinear", 2.0 * steepness(baffle) / (airDensity * airViscosity * baffle.cellWidth));
}

void addTemperatureAt(Filling& filling, const CaseOfDirection& flow, const CasePatch& patch)
{
  const CaseHeat& heat = flow.heat;
  add(filling.values, "temperature", flow.settings.outdoorTemperature);
  if (const auto source = heat.surfaces.find(patch.name); source != heat.surfaces.end())
  {
    filling.facts.insert("surfaceSource");
    add(filling.values, "fluxOfHeat", source->second / patch.area);
  }
  if (const auto fixed = heat.temperatures.find(patch.name); fixed != heat.temperatures.end())
  {
    filling.facts.insert("fixedTemperature");
    add(filling.values, "temperature", fixed->second);
  }
  if (const auto incoming = heat.incoming.find(patch.name); incoming != heat.incoming.end())
  {
    add(filling.values, "temperature", incoming->second);
  }
}

void addScalarAt(Filling& filling, const CaseScalar& scalar, const CasePatch& patch)
{
  if (const auto source = scalar.surfaces.find(patch.name); source != scalar.surfaces.end())
  {
    filling.facts.insert("surfaceSource");
    add(filling.values, "fluxOfSource", source->second / patch.area);
  }
  add(filling.values, "incoming", scalar.incomingAt(patch.name));
}

} // namespace atria
