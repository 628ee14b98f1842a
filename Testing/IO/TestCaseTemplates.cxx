// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFiles.h"
#include "Support/ErrorMessage.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <list>

namespace {

using atria::Filling;
using atria::Lines;
using atria::OpenFOAMDialect;
using atria::PatchRole;
using atria::TurbulenceModel;
using atria::testing::messageOf;
using testing::HasSubstr;

Lines filled(std::string_view text, const std::map<std::string, Lines>& values)
{
  return atria::fillTemplate(text, [&](const std::string& name) { return values.at(name); });
}

TEST(FoamTemplate, HasValuesWithinLines)
{
  EXPECT_EQ(filled("nu [0 2] {{nu}};\n", {{"nu", {"1.5e-05"}}}), (Lines{"nu [0 2] 1.5e-05;"}));
  EXPECT_EQ(filled("{{a}}{{b}} {c}", {{"a", {"1"}}, {"b", {"2"}}}), (Lines{"12 {c}"}));
}

TEST(FoamTemplate, IndentsTheLinesOfAList)
{
  const char* const text = "a\n{\n    {{list}}\n}\n";
  EXPECT_EQ(filled(text, {{"list", {"b", "", "c"}}}), (Lines{"a", "{", "    b", "", "    c", "}"}));
  EXPECT_EQ(filled(text, {{"list", {"b\nc"}}}), (Lines{"a", "{", "    b\nc", "}"})); // one line of a user
}

TEST(FoamTemplate, LosesTheLineOfAnEmptyList)
{
  EXPECT_EQ(filled("a\n  {{list}}\nb\n", {{"list", {}}}), (Lines{"a", "b"}));
  EXPECT_EQ(filled("", {}), Lines());
}

TEST(FoamTemplate, KeepsTheColumnBehindAKey)
{
  const char* const text = "  div(phi,{{field}}) upwind;\n";
  EXPECT_EQ(filled(text, {{"field", {"T"}}}), (Lines{"  div(phi,T)      upwind;"}));
  EXPECT_EQ(filled(text, {{"field", {"temperature"}}}), (Lines{"  div(phi,temperature) upwind;"}));
  EXPECT_EQ(filled("{{folder}}/Allrun || exit 1\n", {{"folder", {"a"}}}), (Lines{"a/Allrun || exit 1"}));
}

TEST(FoamTemplate, RefusesWhatCannotBeFilled)
{
  EXPECT_THAT(messageOf([] { filled("nu {{nu;\n", {}); }), HasSubstr("not closed in the line 'nu {{nu;'"));
  EXPECT_THAT(messageOf([] { filled("nu {{nu}};\n", {{"nu", {}}}); }), HasSubstr("'nu' stands within a line"));
  EXPECT_THAT(messageOf([] { filled("nu {{nu}};\n", {{"nu", {"1", "2"}}}); }), HasSubstr("has 2 lines"));
  EXPECT_THAT(messageOf([] { atria::foamTemplate("0/V"); }), HasSubstr("no template '0/V'"));
}

TEST(CaseTable, RefusesNamesWithoutAValue)
{
  constexpr atria::CaseRow rows[] = {{"file", "a|b c", "constant/transportProperties"}};
  Filling filling{{"b", "c"}, {}};
  EXPECT_THAT(messageOf([&] { atria::textOf(rows, "file", filling); }),
              HasSubstr("'constant/transportProperties' names 'airViscosity', which has no value"));
  filling.values["airViscosity"] = {"1"};
  EXPECT_EQ(atria::textOf(rows, "file", filling).size(), 2u);
  filling.facts = {"a", "b"};
  EXPECT_EQ(atria::textOf(rows, "file", filling), Lines());
}

/// Cases of all settings, of a mesh with all kinds of patches.
class CaseTemplates : public testing::Test
{
protected:
  void SetUp() override
  {
    using atria::Supply;
    const std::vector<atria::PatchChoice> choices{{PatchRole::Outlet},
                                                  {PatchRole::InletOutlet},
                                                  {PatchRole::Slip},
                                                  {PatchRole::Wall},
                                                  {PatchRole::RoughWall, 0.01},
                                                  {PatchRole::Constraint},
                                                  {PatchRole::Inlet, 0.0, Supply{Supply::Speed, 1.0}},
                                                  {PatchRole::Inlet, 0.0, Supply{Supply::FlowRate, 1.0}}};
    mesh.bounds = {atria::Vec3(0, 0, 0), atria::Vec3(4, 3, 2)};
    mesh.openings.push_back({"Door", 2.0, {"hall", "outside"}});
    for (std::size_t i = 0; i < choices.size() + 3; ++i)
    {
      mesh.patches.push_back({"side" + std::to_string(i), "patch", {1, 0, 0}, 1.0, mesh.bounds});
    }
    for (const OpenFOAMDialect dialect : {OpenFOAMDialect::OpenCFD1912, OpenFOAMDialect::OpenCFD,
                                          OpenFOAMDialect::Foundation, OpenFOAMDialect::Foundation14})
    {
      for (const TurbulenceModel model :
           {TurbulenceModel::KEpsilon, TurbulenceModel::RealizableKEpsilon, TurbulenceModel::KOmegaSST})
      {
        addCase(dialect, model, atria::FlowKind::Wind, choices);
        addCase(dialect, model, atria::FlowKind::Room, choices);
        if (!atria::isFoundation(dialect))
        {
          addWarmCase(dialect, model, choices, 0.0);
          addWarmCase(dialect, model, choices, 60.0);
        }
      }
    }
  }

  /// The case of wind computes the age of air, that of a room runs on several processors.
  void addCase(OpenFOAMDialect dialect, TurbulenceModel model, atria::FlowKind kind,
               std::vector<atria::PatchChoice> choices)
  {
    atria::FlowCaseSettings& made = settings.emplace_back();
    made.dialect = dialect;
    made.turbulence = model;
    made.kind = kind;
    made.ageOfAir = kind == atria::FlowKind::Wind;
    made.processors = kind == atria::FlowKind::Room ? 4 : 1;
    const bool isWind = kind == atria::FlowKind::Wind;
    choices.push_back({isWind ? PatchRole::Inlet : PatchRole::Wall});
    choices.push_back({isWind ? PatchRole::Ground : PatchRole::Wall});
    choices.push_back(choices.back());
    choices.back().roughness = isWind ? std::optional(0.03) : std::nullopt;
    const atria::Vec3 wind(isWind ? 1 : 0, 0, 0);
    flows.push_back({mesh, made, wind, choices, {atria::Vec3(1, 1, 1)}});
    flows.back().canopies = {{"hall", 1.0, 0.2, 5.0}};
    flows.back().baffles = {{"Window", {0, 1, 0}, 1.0, 1.0, 0.1, 2.0, 0.5, {}},
                            {"Fan", {1, 0, 0}, 1.0, 1.0, 0.1, 0.0, 0.0, {{0.0, 20.0}, {1.0, 10.0}}}};
    const bool takesSurfaces = !atria::isFoundation(dialect);
    flows.back().scalars = {{"CO2", {{"hall", 5e-6}}, {}, {{"side6", 4e-4}}}};
    if (takesSurfaces)
    {
      flows.back().scalars.push_back({"smoke", {}, {{"side3", 1.0}}, {}});
    }
  }

  /// Calm and warm air in a domain whose outdoors are a cell zone.
  void addWarmCase(OpenFOAMDialect dialect, TurbulenceModel model, std::vector<atria::PatchChoice> choices,
                   double duration)
  {
    atria::FlowCaseSettings& made = settings.emplace_back();
    made.dialect = dialect;
    made.turbulence = model;
    made.kind = atria::FlowKind::Wind;
    made.ageOfAir = true;
    made.warmAir = true;
    made.calm = duration > 0.0;
    made.transientDuration = duration;
    choices.insert(choices.end(), 3, {PatchRole::Ground});
    mesh.hasOutdoors = true;
    flows.push_back({mesh, made, atria::Vec3(made.calm ? 0 : 1, 0, 0), choices, {atria::Vec3(1, 1, 1)}});
    flows.back().heat = {{{"hall", 600.0}}, {{"side3", 50.0}}, {{"side4", 30.0}}, {{"side0", 25.0}}};
  }

  /// Returns what the boundary conditions of all patches of a case are filled with.
  static std::vector<Filling> fillingsOfPatches(const atria::CaseOfDirection& flow)
  {
    std::vector<Filling> fillings(flow.choices.size(), atria::fillingOf(flow));
    for (std::size_t i = 0; i < fillings.size(); ++i)
    {
      atria::addPatch(fillings[i], flow, flow.mesh.patches[i], flow.choices[i]);
    }
    return fillings;
  }

  /// Returns what templates are filled with in all cases.
  std::vector<Filling> allFillings() const
  {
    std::vector<Filling> fillings;
    for (const atria::CaseOfDirection& flow : flows)
    {
      for (const char* fact :
           {"meshOnly", "rose", "bothWays", "age", "checkProfile", "emptyDomain", "surfaceSource", "T"})
      {
        fillings.push_back(atria::fillingOf(flow));
        fillings.back().facts.insert(fact);
      }
      for (const atria::CaseBaffle& baffle : flow.baffles)
      {
        fillings.push_back(atria::fillingOf(flow));
        atria::addBaffle(fillings.back(), baffle);
      }
      const std::vector<Filling> patches = fillingsOfPatches(flow);
      fillings.insert(fillings.end(), patches.begin(), patches.end());
      for (std::size_t i = 0; i < patches.size(); ++i)
      {
        if (flow.settings.warmAir)
        {
          fillings.push_back(patches[i]);
          atria::addTemperatureAt(fillings.back(), flow, flow.mesh.patches[i]);
        }
        for (const atria::CaseScalar& scalar : flow.scalars)
        {
          fillings.push_back(patches[i]);
          atria::addScalarAt(fillings.back(), scalar, flow.mesh.patches[i]);
        }
      }
    }
    return fillings;
  }

  atria::CaseMesh mesh;
  std::list<atria::FlowCaseSettings> settings;
  std::vector<atria::CaseOfDirection> flows;
};

TEST_F(CaseTemplates, FillAllFiles)
{
  const atria::testing::ScratchFolder scratch;
  for (std::size_t i = 0; i < flows.size(); ++i)
  {
    const auto folder = scratch.path() / std::to_string(i);
    std::filesystem::create_directories(folder);
    EXPECT_EQ(messageOf([&] { atria::writeCaseFiles(folder, flows[i]); }), "");
    EXPECT_THAT(atria::testing::bytesOf(folder / "0" / "U"), Not(HasSubstr("{{")));
  }
}

TEST_F(CaseTemplates, HaveAConditionForEveryPatch)
{
  for (const atria::CaseOfDirection& flow : flows)
  {
    for (const Filling& filling : fillingsOfPatches(flow))
    {
      for (const atria::CaseField& field : atria::fieldsOf(flow))
      {
        EXPECT_TRUE(atria::rowOf(atria::caseConditions(), field.row, filling))
            << field.name << " at " << testing::PrintToString(filling.facts);
      }
    }
  }
}

/// A row that no case uses stands behind one that holds whenever it does, or has a fact that there is not.
TEST_F(CaseTemplates, HaveRowsThatAreUsed)
{
  std::set<const atria::CaseRow*> used;
  const std::vector<Filling> fillings = allFillings();
  for (const Filling& filling : fillings)
  {
    for (const auto rows : {atria::caseFiles(), atria::caseParts()})
    {
      for (const atria::CaseRow& row : rows)
      {
        used.insert(atria::rowOf(rows, row.what, filling));
      }
    }
    for (const atria::CaseField& field : atria::caseFields())
    {
      used.insert(atria::rowOf(atria::caseConditions(), field.row, filling));
    }
    used.insert(atria::rowOf(atria::caseConditions(), "scalar", filling));
  }
  for (const auto rows : {atria::caseFiles(), atria::caseConditions(), atria::caseParts()})
  {
    for (const atria::CaseRow& row : rows)
    {
      EXPECT_TRUE(used.contains(&row)) << row.what << " if " << row.when << ": " << row.from;
    }
  }
}

TEST(CaseTable, NamesAllTemplates)
{
  std::set<std::string_view> named;
  for (const auto rows : {atria::caseFiles(), atria::caseConditions(), atria::caseParts()})
  {
    for (const atria::CaseRow& row : rows)
    {
      named.insert(row.from);
    }
  }
  for (const auto& [name, text] : atria::foamTemplates())
  {
    EXPECT_EQ(named.erase(name), 1u) << "no row names the template " << name;
  }
  EXPECT_THAT(named, testing::IsEmpty()) << "no templates";
}

TEST_F(CaseTemplates, NameAllValues)
{
  std::string all;
  for (const auto& [name, text] : atria::foamTemplates())
  {
    all += text;
  }
  for (const Filling& filling : allFillings())
  {
    for (const auto& [name, value] : filling.values)
    {
      EXPECT_NE(all.find("{{" + name + "}}"), std::string::npos) << name;
    }
  }
}

} // namespace
