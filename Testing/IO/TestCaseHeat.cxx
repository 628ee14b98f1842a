// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFiles.h"
#include "Support/ErrorMessage.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using atria::OpenFOAMDialect;
using atria::PatchRole;
using atria::testing::bytesOf;
using atria::testing::messageOf;
using testing::HasSubstr;
using testing::Not;

/// A room with an inlet, an opening and two walls, and two cell zones.
class CaseHeat : public testing::Test
{
protected:
  void SetUp() override
  {
    for (const auto& [name, area] : {std::pair("In", 0.5), {"Window", 0.5}, {"Floor", 12.0}, {"Floor_2", 4.0}})
    {
      mesh.patches.push_back({name, "patch", {1, 0, 0}, area, {}});
    }
    mesh.rooms = {{"office", 30.0}, {"hall", 10.0}};
    mesh.openings.push_back({"Door", 2.0, {"office", "hall"}});
    mesh.bounds = {atria::Vec3(0, 0, 0), atria::Vec3(4, 4, 3)};
    settings.kind = atria::FlowKind::Room;
    settings.warmAir = true;
    choices = {{PatchRole::Inlet, 0.0, atria::Supply{}}, {PatchRole::InletOutlet}, {}, {}};
  }

  atria::CaseHeat heatOf(const std::vector<std::string>& heats, const std::vector<std::string>& temperatures = {})
  {
    settings.heatRules.clear();
    settings.temperatureRules.clear();
    for (const std::string& rule : heats)
    {
      settings.heatRules.push_back(atria::heatRuleFrom(rule));
    }
    for (const std::string& rule : temperatures)
    {
      settings.temperatureRules.push_back(atria::temperatureRuleFrom(rule));
    }
    return atria::caseHeat(mesh, settings, choices);
  }

  std::string refusal(const std::vector<std::string>& heats, const std::vector<std::string>& temperatures = {})
  {
    return messageOf([&] { heatOf(heats, temperatures); });
  }

  atria::CaseMesh mesh;
  atria::FlowCaseSettings settings;
  std::vector<atria::PatchChoice> choices;
};

TEST_F(CaseHeat, AddsUp)
{
  const auto heat =
      heatOf({"office 200", "* 400W", "Floor* 10W/m2", "Floor_2 8W"}, {"In 18", "Window 30", "Window 22"});
  EXPECT_DOUBLE_EQ(heat.zones.at("office"), 200.0 + 300.0); // by volume
  EXPECT_DOUBLE_EQ(heat.zones.at("hall"), 100.0);
  EXPECT_DOUBLE_EQ(heat.surfaces.at("Floor"), 120.0); // by area
  EXPECT_DOUBLE_EQ(heat.surfaces.at("Floor_2"), 40.0 + 8.0);
  EXPECT_DOUBLE_EQ(heat.incoming.at("In"), 18.0);
  EXPECT_DOUBLE_EQ(heat.incoming.at("Window"), 22.0); // the last
  EXPECT_TRUE(heat.temperatures.empty());
}

TEST_F(CaseHeat, RefusesWhatIsNoRule)
{
  for (const char* wrong : {"office", "office 1W more", ""})
  {
    EXPECT_THAT(messageOf([&] { atria::heatRuleFrom(wrong); }), HasSubstr("PATTERN AMOUNT")) << wrong;
    EXPECT_THAT(messageOf([&] { atria::temperatureRuleFrom(wrong); }), HasSubstr("PATTERN CELSIUS")) << wrong;
  }
  for (const char* amount : {"x", "1kW", "nan", "infW", "1W/m"})
  {
    EXPECT_THAT(messageOf([&] { atria::heatRuleFrom(std::string("office ") + amount); }), HasSubstr("'office'"));
  }
  EXPECT_THAT(messageOf([] { atria::temperatureRuleFrom("Floor 30F"); }), HasSubstr("degrees Celsius"));
}

TEST_F(CaseHeat, RefusesKelvin)
{
  EXPECT_THAT(messageOf([] { atria::temperatureRuleFrom("Floor 300"); }), HasSubstr("'Floor': 300 is not from -90 to"));
  EXPECT_THAT(messageOf([] { atria::temperatureRuleFrom("Floor 300"); }), HasSubstr("300 kelvin are 26.85"));
  EXPECT_THAT(messageOf([] { atria::temperatureRuleFrom("Floor -250"); }), HasSubstr("'Floor': -250"));
}

TEST_F(CaseHeat, RefusesPlacesThatDoNotSuit)
{
  EXPECT_THAT(refusal({"offise 1W"}), HasSubstr("did you mean 'office'?"));
  EXPECT_THAT(refusal({}, {"Flor 30"}), HasSubstr("did you mean 'Floor'?"));
  EXPECT_THAT(refusal({"Window 1W"}), HasSubstr("'Window': air flows through it"));
  EXPECT_THAT(refusal({"office 1W/m2"}), HasSubstr("'office': a cell zone has no area"));
  EXPECT_THAT(refusal({}, {"office 30"}), HasSubstr("'office': a cell zone has no temperature"));
  EXPECT_THAT(refusal({"Floor 1W"}, {"Floor 30"}), HasSubstr("'Floor' has both"));
  mesh.patches[2].area = 0.0;
  EXPECT_THAT(refusal({"Floor 1W"}), HasSubstr("'Floor': the mesh has no faces"));
}

TEST_F(CaseHeat, RefusesAirThatNothingWarms)
{
  EXPECT_THAT(refusal({"office 0W"}, {"In 20"}), HasSubstr("nothing warms or cools the air"));
  EXPECT_EQ(refusal({"office 100W", "hall -100W"}), "");
  EXPECT_EQ(refusal({}, {"In 18"}), "");
}

TEST_F(CaseHeat, NeedsWarmAir)
{
  settings.warmAir = false;
  EXPECT_THAT(refusal({"office 1W"}), HasSubstr("no warm air for HeatRules"));
  EXPECT_THAT(refusal({}, {"Floor 30"}), HasSubstr("TemperatureRules"));
  EXPECT_EQ(refusal({}), "");
  settings.calm = true;
  EXPECT_THAT(refusal({}), HasSubstr("Calm"));
  settings.calm = false;
  settings.transientDuration = 1.0;
  EXPECT_THAT(refusal({}), HasSubstr("TransientDuration"));
}

TEST_F(CaseHeat, IsNotForTheFoundation)
{
  for (const auto dialect : {OpenFOAMDialect::Foundation, OpenFOAMDialect::Foundation14})
  {
    settings.dialect = dialect;
    EXPECT_THAT(refusal({"office 1W"}), HasSubstr("Make the case for opencfd-1912 or opencfd-2006"));
  }
}

TEST_F(CaseHeat, LeavesItsNamesToTheTemperature)
{
  settings.scalarRules = {atria::scalarRuleFrom("T office 1/s")};
  EXPECT_THAT(refusal({"office 1W"}), HasSubstr("cannot be called 'T'"));
  settings.warmAir = false;
  EXPECT_EQ(refusal({}), "");
}

TEST_F(CaseHeat, WarnsOfLargeDifferences)
{
  EXPECT_TRUE(atria::warnOfHeat(heatOf({}, {"Floor 45"}), 20.0).empty());
  EXPECT_THAT(atria::warnOfHeat(heatOf({}, {"Floor 90"}), 20.0).at(0), HasSubstr("'Floor' (90)"));
}

TEST_F(CaseHeat, HasThePropertiesOfAir)
{
  EXPECT_NEAR(atria::warmAirAt(20.0).heatCapacity, 1.204 * 1005.0, 1.0);
  EXPECT_NEAR(atria::warmAirAt(20.0).expansion, 1.0 / 293.15, 1e-12);
}

TEST_F(CaseHeat, OpensPatchesToCalmAir)
{
  settings.calm = true;
  mesh.patches[1].name = "Outlet";
  for (const char* rule : {"In inlet", "Outlet outlet"})
  {
    settings.patchRules.push_back(atria::patchRuleFrom(rule));
  }
  auto roles = atria::chooseRoomPatches(mesh, settings);
  EXPECT_EQ(roles[0].role, PatchRole::InletOutlet);
  EXPECT_EQ(roles[1].role, PatchRole::InletOutlet);
  settings.patchRules[0] = atria::patchRuleFrom("In inlet:1m/s");
  roles = atria::chooseRoomPatches(mesh, settings);
  EXPECT_EQ(roles[0].role, PatchRole::Inlet);
  settings.patchRules.clear();
  mesh.patches[1].name = "Side";
  EXPECT_THAT(messageOf([&] { atria::chooseRoomPatches(mesh, settings); }), HasSubstr("no patch lets air"));
}

TEST_F(CaseHeat, HasEntriesOfEachDialect)
{
  for (const auto dialect : {OpenFOAMDialect::OpenCFD1912, OpenFOAMDialect::OpenCFD})
  {
    for (const double duration : {0.0, 60.0})
    {
      const atria::testing::ScratchFolder scratch;
      const auto file = [&](const char* folder, const char* name) { return bytesOf(scratch.path() / folder / name); };
      settings.dialect = dialect;
      settings.transientDuration = duration;
      atria::CaseOfDirection flow{mesh, settings, {0, 0, 0}, choices, {}};
      flow.heat = heatOf({"office 1210W", "Floor 24W"}, {"Floor_2 30", "In 18"});
      atria::writeCaseFiles(scratch.path(), flow);
      const std::string control = file("system", "controlDict");
      EXPECT_THAT(control, HasSubstr(duration > 0.0 ? "application     pimpleFoam;" : "application     simpleFoam;"));
      EXPECT_EQ(control.find("adjustTimeStep  yes;") != std::string::npos, duration > 0.0);
      EXPECT_THAT(control, HasSubstr("T               (0.99"));
      EXPECT_THAT(control, HasSubstr("heatBothWays_Door"));
      const std::string schemes = file("system", "fvSchemes");
      EXPECT_THAT(schemes, HasSubstr("grad(p)         cellLimited leastSquares 0.5;"));
      EXPECT_THAT(schemes, HasSubstr(duration > 0.0 ? "div(phi,T)      Gauss" : "div(phi,T)      bounded Gauss"));
      EXPECT_THAT(file("system", "fvSolution"), HasSubstr(duration > 0.0 ? "PIMPLE" : "SIMPLE"));
      EXPECT_THAT(file("constant", "fvOptions"), HasSubstr("Tmelt           20;"));
      EXPECT_THAT(file("constant", "g"), HasSubstr("uniformDimensionedVectorField"));
      const std::string temperature = file("0", "T");
      EXPECT_THAT(temperature, HasSubstr("gradientExpr    \"2/1210.11"));
      EXPECT_THAT(temperature, HasSubstr("value           uniform 30;"));
      EXPECT_THAT(temperature, HasSubstr("value           uniform 18;"));
      EXPECT_THAT(file("0", "p"), HasSubstr("fixedFluxExtrapolatedPressure"));
    }
  }
}

TEST_F(CaseHeat, IsInNoOtherCase)
{
  const atria::testing::ScratchFolder scratch;
  settings.warmAir = false;
  atria::writeCaseFiles(scratch.path(), {mesh, settings, {0, 0, 0}, choices, {}});
  for (const char* name : {"0/T", "constant/g", "constant/fvOptions"})
  {
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / name)) << name;
  }
  EXPECT_THAT(bytesOf(scratch.path() / "system" / "fvSchemes"), Not(HasSubstr("leastSquares")));
}

} // namespace
