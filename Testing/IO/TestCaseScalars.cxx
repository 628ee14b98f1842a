// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFiles.h"
#include "Support/ErrorMessage.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using atria::OpenFOAMDialect;
using atria::PatchRole;
using atria::testing::messageOf;
using testing::HasSubstr;

/// A room with an inlet, an outlet and two walls, and two cell zones.
class CaseScalars : public testing::Test
{
protected:
  void SetUp() override
  {
    for (const auto& [name, area] : {std::pair("In", 0.5), {"Out", 0.5}, {"Floor", 12.0}, {"Floor_2", 4.0}})
    {
      mesh.patches.push_back({name, "patch", {1, 0, 0}, area, {}});
    }
    mesh.rooms = {{"office", 30.0}, {"hall", 10.0}};
    mesh.bounds = {atria::Vec3(0, 0, 0), atria::Vec3(4, 4, 3)};
    settings.kind = atria::FlowKind::Room;
    choices = {{PatchRole::Inlet, 0.0, atria::Supply{}}, {PatchRole::Outlet}, {}, {}};
  }

  std::vector<atria::CaseScalar> scalarsOf(const std::vector<std::string>& rules)
  {
    settings.scalarRules.clear();
    for (const std::string& rule : rules)
    {
      settings.scalarRules.push_back(atria::scalarRuleFrom(rule));
    }
    return atria::caseScalars(mesh, settings, choices);
  }

  std::string refusal(const std::vector<std::string>& rules)
  {
    return messageOf([&] { scalarsOf(rules); });
  }

  atria::CaseMesh mesh;
  atria::FlowCaseSettings settings;
  std::vector<atria::PatchChoice> choices;
};

TEST_F(CaseScalars, AddUp)
{
  const auto scalars = scalarsOf({"CO2 office 2/s", "smoke Floor* 8/s", "CO2 * 4/s", "CO2 In 400"});
  ASSERT_EQ(scalars.size(), 2u);
  EXPECT_EQ(scalars[0].name, "CO2");
  EXPECT_DOUBLE_EQ(scalars[0].zones.at("office"), 2.0 + 3.0); // by volume
  EXPECT_DOUBLE_EQ(scalars[0].zones.at("hall"), 1.0);
  EXPECT_DOUBLE_EQ(scalars[0].incoming.at("In"), 400.0);
  EXPECT_DOUBLE_EQ(scalars[1].surfaces.at("Floor"), 6.0); // by area
  EXPECT_DOUBLE_EQ(scalars[1].surfaces.at("Floor_2"), 2.0);
}

TEST_F(CaseScalars, RefuseWhatIsNoRule)
{
  for (const char* wrong : {"CO2 office", "CO2 office 1/s more", ""})
  {
    EXPECT_THAT(messageOf([&] { atria::scalarRuleFrom(wrong); }), HasSubstr("NAME PATTERN AMOUNT")) << wrong;
  }
  for (const char* amount : {"x", "1/h", "-1/s", "nan", "inf/s", "1 /s"})
  {
    EXPECT_NE(messageOf([&] { atria::scalarRuleFrom(std::string("CO2 office ") + amount); }), "") << amount;
  }
  for (const char* name : {"k", "U", "age", "a_b", "1a"})
  {
    EXPECT_THAT(messageOf([&] { atria::scalarRuleFrom(std::string(name) + " office 1/s"); }),
                HasSubstr("cannot be called"));
  }
}

TEST_F(CaseScalars, RefusePlacesThatDoNotSuit)
{
  EXPECT_THAT(refusal({"CO2 offise 1/s"}), HasSubstr("did you mean 'office'?"));
  EXPECT_THAT(refusal({"CO2 In 1/s"}), HasSubstr("air flows through 'In'"));
  EXPECT_THAT(refusal({"CO2 Floor 400"}), HasSubstr("no air comes in at 'Floor'"));
  EXPECT_THAT(refusal({"CO2 office 0/s", "CO2 In 0"}), HasSubstr("add up to nothing"));
  mesh.patches[2].area = 0.0;
  EXPECT_THAT(refusal({"CO2 Floor 1/s"}), HasSubstr("no faces of 'Floor'"));
  choices[3].role = PatchRole::Slip;
  EXPECT_THAT(refusal({"CO2 Floor_2 1/s"}), HasSubstr("along which air slips"));
}

TEST_F(CaseScalars, MayComeInWithOtherDirections)
{
  choices[3].role = PatchRole::Slip;
  EXPECT_THAT(refusal({"CO2 Floor_2 400"}), HasSubstr("no air comes in at 'Floor_2'"));
  settings.directions = {0.0, 90.0};
  EXPECT_TRUE(scalarsOf({"CO2 Floor_2 400"})[0].incoming.empty());
  EXPECT_THAT(refusal({"CO2 Floor 400"}), HasSubstr("no air comes in at 'Floor'"));
}

TEST_F(CaseScalars, StartWithTheLeastThatComesIn)
{
  EXPECT_DOUBLE_EQ(startOf(scalarsOf({"CO2 In 400"})[0], mesh, choices), 400.0);
  choices[1].role = PatchRole::InletOutlet;
  EXPECT_DOUBLE_EQ(startOf(scalarsOf({"CO2 In 400"})[0], mesh, choices), 0.0);
  EXPECT_DOUBLE_EQ(startOf(scalarsOf({"CO2 In 400", "CO2 Out 300"})[0], mesh, choices), 300.0);
}

TEST_F(CaseScalars, HaveEntriesOfEachDialect)
{
  for (const auto dialect : {OpenFOAMDialect::OpenCFD1912, OpenFOAMDialect::OpenCFD, OpenFOAMDialect::Foundation,
                             OpenFOAMDialect::Foundation14})
  {
    const atria::testing::ScratchFolder scratch;
    settings.dialect = dialect;
    const bool isFoundation = atria::isFoundation(dialect);
    atria::CaseOfDirection flow{mesh, settings, {0, 0, 0}, choices, {}};
    flow.scalars = scalarsOf({"CO2 office 2/s", "CO2 In 400"});
    atria::writeCaseFiles(scratch.path(), flow);
    const std::string control = atria::testing::bytesOf(scratch.path() / "system" / "controlDict");
    EXPECT_THAT(control, HasSubstr(isFoundation ? "alphat          1.42857" : "alphaDt         1.42857"));
    EXPECT_EQ(control.find("scalarSemiImplicitSource") == std::string::npos, isFoundation);
    EXPECT_EQ(std::filesystem::exists(scratch.path() / "constant" / "fvModels"), isFoundation);
    EXPECT_THAT(atria::testing::bytesOf(scratch.path() / "0" / "CO2"), HasSubstr("inletValue      uniform 400;"));
    EXPECT_EQ(refusal({"smoke Floor 1/s"}).find("Foundation") != std::string::npos, isFoundation);
  }
}

} // namespace
