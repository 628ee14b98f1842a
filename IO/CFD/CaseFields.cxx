// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFields.h"

#include "PatchNames.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace atria {

namespace {

/// Turbulence of air from a duct or a diffuser: speeds vary by a twentieth of their mean. Eddies have this share of the
/// opening's hydraulic diameter.
constexpr double supplyIntensity = 0.05;
constexpr double eddyShare = 0.07;

/// Initial values of the turbulence model, and its values in air that comes back in at outlets.
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

Turbulence turbulenceOf(const Supply& supply, const CasePatch& patch)
{
  const double speed = supplyIntensity * supply.speed(patch.area);
  const double k = 1.5 * speed * speed;
  const double length = eddyShare * hydraulicDiameter(patch);
  return {k, std::pow(turbulenceCmu, 0.75) * std::pow(k, 1.5) / length,
          std::sqrt(k) / (std::pow(turbulenceCmu, 0.25) * length)};
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
  const WindProfile& wind = flow.settings.wind;
  const double z = wind.referenceHeight;
  return flow.isRoom() ? found : Turbulence{wind.kineticEnergy(), wind.dissipation(z), wind.specificDissipation(z)};
}

/// The quantity of a wind profile.
enum Profile : std::uint8_t
{
  ofVelocity,
  ofK,
  ofEpsilon,
  ofOmega
};

/// One field's boundaryField entry for a patch.
using Condition = std::function<void(FoamText&, const CasePatch&, const PatchChoice&)>;

struct Field
{
  const char* name;
  const char* className;
  const char* dimensions;
  std::string inside; ///< the uniform value to start from
  Condition condition;
};

void type(FoamText& text, const std::string& name) { text.entry("type", name); }

void zeroGradient(FoamText& text) { type(text, "zeroGradient"); }

void valued(FoamText& text, const char* typeName, const std::string& value)
{
  type(text, typeName);
  text.entry("value", "uniform " + value);
}

void inletOutlet(FoamText& text, const std::string& value)
{
  type(text, "inletOutlet");
  text.entry("inletValue", "uniform " + value).entry("value", "uniform " + value);
}

class Fields
{
public:
  explicit Fields(const CaseOfDirection& source) : flow(source), wind(source.settings.wind)
  {
    const Turbulence typical = typicalTurbulence(source);
    k = foamNumber(typical.k);
    epsilon = foamNumber(typical.epsilon);
    omega = foamNumber(typical.omega);
  }

  std::vector<Field> all() const
  {
    // Runs start with air at rest. potentialFoam makes absurd speeds of its fluxes in flat cells, which take hundreds
    // of iterations to decay; wind throughout must be turned aside by the first pressure. See docs/cases.md.
    std::vector<Field> fields{
        {"U", "volVectorField", "[0 1 -1 0 0 0 0]", foamVector(Vec3::Zero()),
         [this](auto& text, auto& patch, auto& choice) { velocity(text, patch, choice); }},
        {"p", "volScalarField", "[0 2 -2 0 0 0 0]", "0",
         [this](auto& text, auto&, auto& choice) { pressure(text, choice); }},
        {"k", "volScalarField", "[0 2 -2 0 0 0 0]", k,
         [this](auto& text, auto& patch, auto& choice) { turbulent(text, patch, choice, ofK, "kqRWallFunction", k); }},
        {"nut", "volScalarField", "[0 2 -1 0 0 0 0]", "0",
         [this](auto& text, auto&, auto& choice) { viscosity(text, choice); }}};
    if (flow.usesOmega())
    {
      fields.push_back(
          {"omega", "volScalarField", "[0 0 -1 0 0 0 0]", omega, [this](auto& text, auto& patch, auto& choice) {
             turbulent(text, patch, choice, ofOmega, "omegaWallFunction", omega);
           }});
    }
    else
    {
      fields.push_back(
          {"epsilon", "volScalarField", "[0 2 -3 0 0 0 0]", epsilon, [this](auto& text, auto& patch, auto& choice) {
             turbulent(text, patch, choice, ofEpsilon, "epsilonWallFunction", epsilon);
           }});
    }
    if (flow.settings.ageOfAir && !isFoundation(flow.settings.dialect)) // the Foundation's function makes it
    {
      fields.push_back({"age", "volScalarField", "[0 0 1 0 0 0 0]", "0",
                        [](auto& text, auto&, auto& choice) { age(text, choice); }});
    }
    return fields;
  }

private:
  /// Adds the entries that all conditions with the wind's profile share.
  void profile(FoamText& text, Profile of, const CasePatch& patch) const
  {
    if (flow.settings.dialect == OpenFOAMDialect::Foundation14)
    {
      // The rest is in atmosphericBoundaryLayerProperties.
      constexpr std::array names{"Velocity", "TurbulentKineticEnergy", "TurbulentEpsilon"};
      return type(text, std::string("atmosphericBoundaryLayer") + names.at(of));
    }
    constexpr std::array names{"Velocity", "K", "Epsilon", "Omega"};
    type(text, std::string("atmBoundaryLayerInlet") + names.at(of));
    text.entry("flowDir", foamVector(flow.wind)).entry("zDir", "(0 0 1)");
    text.entry("Uref", wind.speed).entry("Zref", wind.referenceHeight);
    text.entry("z0", "uniform " + foamNumber(wind.roughness));
    if (flow.settings.dialect == OpenFOAMDialect::OpenCFD)
    {
      text.entry("d", "uniform 0"); // heights are above the patch's lowest point
    }
    else
    {
      text.entry("zGround", "uniform " + foamNumber(patch.bounds.min[2]));
    }
  }

  /// Adds a profile of omega, for which OpenFOAM 1912 has no condition: a table over the height, finer near the ground.
  void omegaProfile(FoamText& text, const CasePatch& patch) const
  {
    constexpr int rows = 40;
    const double top = patch.bounds.size()[2];
    std::string table = "table (";
    for (int i = 0; i <= rows; ++i)
    {
      const double z = wind.roughness * (std::pow(1.0 + top / wind.roughness, static_cast<double>(i) / rows) - 1.0);
      table += (i == 0 ? "(" : " (") + foamNumber(z) + " " + foamNumber(wind.specificDissipation(z)) + ")";
    }
    type(text, "fixedProfile");
    text.entry("profile", table + ")").entry("direction", "(0 0 1)").entry("origin", patch.bounds.min[2]);
  }

  /// Adds an inflow along the inward normal of each face, with the same speed.
  static void blow(FoamText& text, const Supply& supply)
  {
    if (supply.quantity == Supply::Speed)
    {
      type(text, "surfaceNormalFixedValue");
      text.entry("refValue", "uniform " + foamNumber(-supply.amount));
    }
    else
    {
      type(text, "flowRateInletVelocity");
      text.entry("volumetricFlowRate", supply.amount);
    }
    text.entry("value", "uniform (0 0 0)"); // follows from the above
  }

  void velocity(FoamText& text, const CasePatch& patch, const PatchChoice& choice) const
  {
    if (choice.supply)
    {
      return blow(text, *choice.supply);
    }
    if (isRoomOpening(choice))
    {
      return valued(text, "pressureInletOutletVelocity", "(0 0 0)");
    }
    switch (choice.role)
    {
      case PatchRole::Inlet:
      case PatchRole::InletOutlet:
        profile(text, ofVelocity, patch);
        text.entry("value", "uniform " + foamVector(wind.speed * flow.wind));
        return;
      case PatchRole::Outlet:
        return inletOutlet(text, "(0 0 0)");
      case PatchRole::Slip:
        return type(text, "slip");
      default:
        return type(text, "noSlip");
    }
  }

  /// True for an opening of a room to still air, which air passes either way.
  bool isRoomOpening(const PatchChoice& choice) const { return flow.isRoom() && choice.role == PatchRole::InletOutlet; }

  void pressure(FoamText& text, const PatchChoice& choice) const
  {
    if (isRoomOpening(choice))
    {
      type(text, "totalPressure");
      text.entry("p0", "uniform 0").entry("value", "uniform 0");
      return;
    }
    switch (choice.role)
    {
      case PatchRole::Outlet:
        return valued(text, "fixedValue", "0");
      case PatchRole::InletOutlet:
        type(text, "outletInlet"); // fixed where air goes out
        text.entry("outletValue", "uniform 0").entry("value", "uniform 0");
        return;
      case PatchRole::Slip:
        return type(text, "slip");
      default:
        return zeroGradient(text);
    }
  }

  /// Adds the turbulence of a supply's air. OpenFOAM computes it from the velocity, also from an edited one.
  void supplied(FoamText& text, const CasePatch& patch, const Supply& supply, const std::string& wallFunction) const
  {
    const Turbulence its = turbulenceOf(supply, patch);
    if (wallFunction == "kqRWallFunction")
    {
      type(text, "turbulentIntensityKineticEnergyInlet");
      text.entry("intensity", supplyIntensity).entry("value", "uniform " + foamNumber(its.k));
      return;
    }
    type(text, flow.usesOmega() ? "turbulentMixingLengthFrequencyInlet" : "turbulentMixingLengthDissipationRateInlet");
    text.entry("mixingLength", eddyShare * hydraulicDiameter(patch));
    text.entry("value", "uniform " + foamNumber(flow.usesOmega() ? its.omega : its.epsilon));
  }

  void turbulent(FoamText& text, const CasePatch& patch, const PatchChoice& choice, Profile inlet,
                 const char* wallFunction, const std::string& value) const
  {
    if (choice.supply)
    {
      return supplied(text, patch, *choice.supply, wallFunction);
    }
    if (isRoomOpening(choice))
    {
      return inletOutlet(text, value);
    }
    switch (choice.role)
    {
      case PatchRole::Inlet:
      case PatchRole::InletOutlet:
        if (inlet == ofOmega && flow.settings.dialect != OpenFOAMDialect::OpenCFD)
        {
          return omegaProfile(text, patch);
        }
        profile(text, inlet, patch);
        text.entry("value", "uniform " + value);
        return;
      case PatchRole::Outlet:
        return inletOutlet(text, value);
      case PatchRole::Slip:
        return type(text, "slip");
      default:
        return valued(text, wallFunction, value);
    }
  }

  void groundViscosity(FoamText& text) const
  {
    if (flow.settings.dialect == OpenFOAMDialect::Foundation14)
    {
      return valued(text, "nutAtmosphericBoundaryLayerWallFunction", "0");
    }
    type(text, flow.settings.dialect == OpenFOAMDialect::OpenCFD ? "atmNutkWallFunction" : "nutkAtmRoughWallFunction");
    text.entry("z0", "uniform " + foamNumber(wind.roughness)).entry("value", "uniform 0");
  }

  void viscosity(FoamText& text, const PatchChoice& choice) const
  {
    switch (choice.role)
    {
      case PatchRole::Ground:
        return groundViscosity(text);
      case PatchRole::RoughWall:
        type(text, "nutkRoughWallFunction");
        text.entry("Ks", "uniform " + foamNumber(choice.sandGrain));
        text.entry("Cs", "uniform 0.5").entry("value", "uniform 0");
        return;
      case PatchRole::Wall:
        return valued(text, "nutkWallFunction", "0");
      default:
        return valued(text, "calculated", "0");
    }
  }

  static void age(FoamText& text, const PatchChoice& choice)
  {
    switch (choice.role)
    {
      case PatchRole::Inlet:
      case PatchRole::InletOutlet:
      case PatchRole::Outlet:
        return inletOutlet(text, "0");
      default:
        return zeroGradient(text);
    }
  }

  const CaseOfDirection& flow;
  const WindProfile& wind;
  std::string k, epsilon, omega;
};

void checkFieldNames(const std::vector<ConditionRule>& rules, const std::vector<Field>& fields)
{
  std::vector<std::string> names;
  names.reserve(fields.size());
  for (const Field& field : fields)
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

void writeField(const std::filesystem::path& folder, const Field& field, const CaseOfDirection& flow)
{
  FoamText text;
  text.entry("dimensions", field.dimensions).blank();
  text.entry("internalField", "uniform " + field.inside).blank();
  text.open("boundaryField");
  // This covers all patches except those below: a name goes before a pattern.
  text.open("\".*\"");
  field.condition(text, {}, {PatchRole::Wall, 0.0});
  text.close();
  for (std::size_t i = 0; i < flow.mesh.patches.size(); ++i)
  {
    const CasePatch& patch = flow.mesh.patches[i];
    const PatchChoice& choice = flow.choices[i];
    const ConditionRule* rule = conditionOf(flow.settings, field.name, patch.name);
    if (!rule && choice.role == PatchRole::Wall)
    {
      continue;
    }
    text.open(patch.name);
    if (rule)
    {
      text.line(rule->entries);
    }
    else if (choice.role == PatchRole::Constraint)
    {
      text.entry("type", patch.type);
    }
    else
    {
      field.condition(text, patch, choice);
    }
    text.close();
  }
  if (flow.settings.processors > 1)
  {
    // Adds the group of patches between processors, which goes before a pattern.
    text.open("processor").entry("type", "processor").entry("value", "$internalField").close();
  }
  text.close();
  writeFoamFile(folder, "0", field.name, field.className, text);
}

} // namespace

std::vector<std::string> CaseOfDirection::namesOf(PatchRole role) const
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    if (choices[i].role == role)
    {
      names.push_back(mesh.patches[i].name);
    }
  }
  return names;
}

void writeFields(const std::filesystem::path& folder, const CaseOfDirection& flow)
{
  const Fields maker(flow);
  const std::vector<Field> fields = maker.all();
  checkFieldNames(flow.settings.conditionRules, fields);
  for (const Field& field : fields)
  {
    writeField(folder, field, flow);
  }
}

} // namespace atria
