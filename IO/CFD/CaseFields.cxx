// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFields.h"

#include "PatchNames.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace atria {

namespace {

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

void type(FoamText& text, const char* name) { text.entry("type", name); }

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
    const double z = wind.referenceHeight;
    k = foamNumber(wind.kineticEnergy());
    epsilon = foamNumber(wind.dissipation(z));
    omega = foamNumber(wind.specificDissipation(z));
  }

  std::vector<Field> all() const
  {
    // Runs start with air at rest. potentialFoam makes absurd speeds of its fluxes in flat cells, which take hundreds
    // of iterations to decay; wind throughout must be turned aside by the first pressure. See docs/cases.md.
    std::vector<Field> fields{{"U", "volVectorField", "[0 1 -1 0 0 0 0]", foamVector(Vec3::Zero()),
                               [this](auto& text, auto& patch, auto& choice) { velocity(text, patch, choice); }},
                              {"p", "volScalarField", "[0 2 -2 0 0 0 0]", "0",
                               [](auto& text, auto&, auto& choice) { pressure(text, choice); }},
                              {"k", "volScalarField", "[0 2 -2 0 0 0 0]", k,
                               [this](auto& text, auto& patch, auto& choice) {
                                 turbulent(text, patch, choice, "atmBoundaryLayerInletK", "kqRWallFunction", k);
                               }},
                              {"nut", "volScalarField", "[0 2 -1 0 0 0 0]", "0",
                               [this](auto& text, auto&, auto& choice) { viscosity(text, choice); }}};
    if (flow.usesOmega())
    {
      fields.push_back(
          {"omega", "volScalarField", "[0 0 -1 0 0 0 0]", omega, [this](auto& text, auto& patch, auto& choice) {
             turbulent(text, patch, choice, "atmBoundaryLayerInletOmega", "omegaWallFunction", omega);
           }});
    }
    else
    {
      fields.push_back(
          {"epsilon", "volScalarField", "[0 2 -3 0 0 0 0]", epsilon, [this](auto& text, auto& patch, auto& choice) {
             turbulent(text, patch, choice, "atmBoundaryLayerInletEpsilon", "epsilonWallFunction", epsilon);
           }});
    }
    if (flow.settings.ageOfAir && flow.settings.dialect != OpenFOAMDialect::Foundation) // whose function makes its own
    {
      fields.push_back({"age", "volScalarField", "[0 0 1 0 0 0 0]", "0",
                        [](auto& text, auto&, auto& choice) { age(text, choice); }});
    }
    return fields;
  }

private:
  /// The wind's profile; what these conditions have in common.
  void profile(FoamText& text, const char* name, const CasePatch& patch) const
  {
    type(text, name);
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

  /// Of omega, for which OpenFOAM 1912 has no condition: a table over the height, finer near the ground.
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

  void velocity(FoamText& text, const CasePatch& patch, const PatchChoice& choice) const
  {
    switch (choice.role)
    {
      case PatchRole::Inlet:
      case PatchRole::InletOutlet:
        profile(text, "atmBoundaryLayerInletVelocity", patch);
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

  static void pressure(FoamText& text, const PatchChoice& choice)
  {
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

  void turbulent(FoamText& text, const CasePatch& patch, const PatchChoice& choice, const char* inlet,
                 const char* wallFunction, const std::string& value) const
  {
    switch (choice.role)
    {
      case PatchRole::Inlet:
      case PatchRole::InletOutlet:
        if (std::string(inlet) == "atmBoundaryLayerInletOmega" && flow.settings.dialect != OpenFOAMDialect::OpenCFD)
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

  void viscosity(FoamText& text, const PatchChoice& choice) const
  {
    switch (choice.role)
    {
      case PatchRole::Ground:
        type(text,
             flow.settings.dialect == OpenFOAMDialect::OpenCFD ? "atmNutkWallFunction" : "nutkAtmRoughWallFunction");
        text.entry("z0", "uniform " + foamNumber(wind.roughness)).entry("value", "uniform 0");
        return;
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

/// The last rule for a patch in a field, or null.
const ConditionRule* ruleFor(const CaseOfDirection& flow, const Field& field, const CasePatch& patch)
{
  const auto& rules = flow.settings.conditionRules;
  const auto found = std::find_if(rules.rbegin(), rules.rend(), [&](const ConditionRule& rule) {
    return rule.field == field.name && matchesPatchName(rule.pattern, patch.name, openFOAMNames);
  });
  return found == rules.rend() ? nullptr : &*found;
}

void writeField(const std::filesystem::path& folder, const Field& field, const CaseOfDirection& flow)
{
  FoamText text;
  text.entry("dimensions", field.dimensions).blank();
  text.entry("internalField", "uniform " + field.inside).blank();
  text.open("boundaryField");
  // All but what follows. A name goes before a pattern.
  text.open("\".*\"");
  field.condition(text, {}, {PatchRole::Wall, 0.0});
  text.close();
  for (std::size_t i = 0; i < flow.mesh.patches.size(); ++i)
  {
    const CasePatch& patch = flow.mesh.patches[i];
    const PatchChoice& choice = flow.choices[i];
    const ConditionRule* rule = ruleFor(flow, field, patch);
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
    // The group of patches between processors, which goes before a pattern.
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
