// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFiles.h"
#include "Support/ErrorMessage.h"
#include "Support/QuietContext.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace {

using atria::Index;
using atria::OpenFOAMDialect;
using atria::testing::messageOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A row of four cubes along x. The face zone lies between the second and the third, its normal against x.
atria::PolyMesh row()
{
  atria::PolyMesh poly;
  const auto point = [](Index i, Index j, Index k) { return i + 5 * (j + 2 * k); };
  for (int k = 0; k < 2; ++k)
  {
    for (int j = 0; j < 2; ++j)
    {
      for (int i = 0; i < 5; ++i)
      {
        poly.mesh.points.emplace_back(i, j, k);
      }
    }
  }
  const auto add = [&](Index owner, std::initializer_list<Index> loop) {
    poly.mesh.facePoints.insert(poly.mesh.facePoints.end(), loop.begin(), loop.end());
    poly.mesh.faceOffsets.push_back(static_cast<Index>(poly.mesh.facePoints.size()));
    poly.mesh.owner.push_back(owner);
  };
  const auto across = [&](Index i, Index owner) {
    add(owner, {point(i, 0, 0), point(i, 1, 0), point(i, 1, 1), point(i, 0, 1)});
  };
  for (Index i = 1; i < 4; ++i)
  {
    across(i, i - 1);
    poly.mesh.neighbor.push_back(i);
  }
  atria::PolyPatch walls{"Walls", "wall", {}};
  for (Index i = 0; i < 4; ++i)
  {
    if (i == 0)
    {
      add(0, {point(0, 0, 0), point(0, 0, 1), point(0, 1, 1), point(0, 1, 0)});
    }
    add(i, {point(i, 0, 0), point(i + 1, 0, 0), point(i + 1, 0, 1), point(i, 0, 1)});
    add(i, {point(i, 1, 0), point(i, 1, 1), point(i + 1, 1, 1), point(i + 1, 1, 0)});
    add(i, {point(i, 0, 0), point(i, 1, 0), point(i + 1, 1, 0), point(i + 1, 0, 0)});
    add(i, {point(i, 0, 1), point(i + 1, 0, 1), point(i + 1, 1, 1), point(i, 1, 1)});
  }
  across(4, 3);
  for (Index f = 3; f < poly.mesh.faceCount(); ++f)
  {
    walls.faces.push_back(f);
  }
  poly.mesh.cellCount = 4;
  poly.patches = {walls};
  poly.faceZones = {{"Window", {1}, {1}}, {"Same", {1, 2}, {0, 0}}};
  return poly;
}

std::vector<Index> pointsOf(const atria::PolyMesh& poly, Index face)
{
  const auto points = poly.mesh.face(face);
  return {points.begin(), points.end()};
}

std::vector<atria::CaseBaffle> baffles(const atria::FlowCaseSettings& settings)
{
  return bafflesOf(row(), settings, atria::testing::quietContext());
}

TEST(ZoneSides, DivideAZoneAndUniteIt)
{
  const atria::PolyMesh before = row();
  for (const bool isTurned : {false, true})
  {
    atria::PolyMesh poly = row();
    const std::vector<atria::DividedZone> zones{{"Window", isTurned}};
    divideZones(poly, zones);
    EXPECT_EQ(poly.mesh.internalFaceCount(), 2u);
    ASSERT_EQ(poly.mesh.faceCount(), before.mesh.faceCount() + 1);
    ASSERT_EQ(poly.patches.size(), 3u);
    EXPECT_EQ(poly.patches[1].name, "Window_side1");
    EXPECT_EQ(poly.patches[1].others.at("neighbourPatch"), "Window_side2");
    const Index first = poly.patches[1].faces.at(0);
    const Index second = poly.patches[2].faces.at(0);
    EXPECT_EQ(poly.mesh.owner[first], isTurned ? 1 : 2); // the zone's normal points to the second cell
    EXPECT_EQ(poly.mesh.owner[second], isTurned ? 2 : 1);
    std::vector<Index> loop = pointsOf(poly, second); // OpenFOAM wants the same first point, the others turned around
    EXPECT_EQ(loop[0], pointsOf(poly, first)[0]);
    std::reverse(loop.begin() + 1, loop.end());
    EXPECT_EQ(loop, pointsOf(poly, first));
    EXPECT_THAT(poly.faceZones[0].faces, ElementsAre(first));
    EXPECT_THAT(poly.faceZones[0].flips, ElementsAre(isTurned ? 1 : 0));
    EXPECT_THAT(poly.faceZones[1].flips, ElementsAre(isTurned ? 0 : 1, 0));
    EXPECT_THAT(poly.cellZones.at(0).cells, ElementsAre(1u, 2u));
    EXPECT_EQ(poly.cellZones[0].name, "Window_sides");
    EXPECT_TRUE(uniteSides(poly));
    EXPECT_EQ(poly.mesh.owner, before.mesh.owner);
    EXPECT_EQ(poly.mesh.neighbor, before.mesh.neighbor);
    EXPECT_EQ(poly.patches.size(), 1u);
    EXPECT_TRUE(poly.cellZones.empty());
    EXPECT_EQ(poly.faceZones[0].faces, before.faceZones[0].faces);
    EXPECT_EQ(poly.faceZones[0].flips, before.faceZones[0].flips);
    EXPECT_EQ(poly.faceZones[1].flips, before.faceZones[1].flips);
    EXPECT_FALSE(uniteSides(poly));
  }
}

TEST(ZoneSides, RefuseWhatCannotBeDivided)
{
  atria::PolyMesh poly = row();
  const std::vector<atria::DividedZone> both{{"Window"}, {"Same"}};
  EXPECT_THAT(messageOf([&] { divideZones(poly, both); }), HasSubstr("shares faces with another zone"));
  poly = row();
  poly.patches.push_back({"Window_side2", "wall", {}});
  EXPECT_THAT(messageOf([&] { divideZones(poly, std::vector<atria::DividedZone>{{"Window"}}); }),
              HasSubstr("patch 'Window_side2' already"));
}

TEST(Baffles, AreMadeByRules)
{
  atria::FlowCaseSettings settings;
  settings.screenRules = {atria::screenRuleFrom("* 1"), atria::screenRuleFrom("\"Window\" 2.5,0.4")};
  const auto screens = baffles(settings);
  ASSERT_EQ(screens.size(), 2u);
  EXPECT_DOUBLE_EQ(screens[0].resistance, 2.5);
  EXPECT_DOUBLE_EQ(screens[0].linear, 0.4);
  EXPECT_DOUBLE_EQ(screens[0].area, 1.0);
  EXPECT_DOUBLE_EQ(screens[0].cellWidth, 1.0);
  EXPECT_TRUE(screens[0].normal.isApprox(atria::Vec3(-1, 0, 0)));
  EXPECT_DOUBLE_EQ(screens[1].resistance, 1.0);
  settings.screenRules.clear();
  settings.fanRules = {atria::fanRuleFrom("Window -20")};
  const auto fans = baffles(settings);
  ASSERT_EQ(fans.size(), 1u);
  EXPECT_TRUE(fans[0].blowsBack);
  EXPECT_DOUBLE_EQ(fans[0].curve.at(0).second, 20.0);
}

TEST(Baffles, RefuseWrongRules)
{
  for (const char* wrong :
       {"Window", "Window -1", "Window 0", "Window 1,-2", "Window 1 2", "Window one", "Window 1,", ""})
  {
    EXPECT_THAT(messageOf([&] { atria::screenRuleFrom(wrong); }), HasSubstr("PATTERN RESISTANCE")) << wrong;
  }
  EXPECT_THAT(messageOf([] { atria::fanRuleFrom("Window"); }), HasSubstr("PATTERN PRESSURE|FILE"));
  EXPECT_THAT(messageOf([] { atria::fanCurveFrom("0"); }), HasSubstr("does nothing"));
  atria::FlowCaseSettings settings;
  settings.screenRules = {{"Windo", 1.0, 0.0}};
  EXPECT_THAT(messageOf([&] { baffles(settings); }), HasSubstr("did you mean 'Window'?"));
  settings.screenRules = {{"Walls", 1.0, 0.0}};
  EXPECT_THAT(messageOf([&] { baffles(settings); }), HasSubstr("'Walls' is a patch, and no face zone"));
  settings.screenRules = {{"Window", 1.0, 0.0}};
  settings.fanRules = {{"Win*", "5"}};
  EXPECT_THAT(messageOf([&] { baffles(settings); }), HasSubstr("has a screen and a fan"));
  EXPECT_THAT(messageOf([&] { bafflesOf({}, settings, atria::testing::quietContext()); }),
              HasSubstr("FindOpenings makes them"));
}

TEST(FanCurves, AreReadFromTables)
{
  const atria::testing::ScratchFolder scratch;
  const auto file = scratch.path() / "fan.csv";
  const auto read = [&](const char* text) {
    std::ofstream(file) << text;
    return atria::fanCurveFrom(file.string());
  };
  const atria::FanCurve curve = read("flow, pressure\n0, 40\n0.5, 30\n1, 0\n");
  EXPECT_THAT(curve, ElementsAre(std::pair(0.0, 40.0), std::pair(0.5, 30.0), std::pair(1.0, 0.0)));
  const std::pair<const char*, const char*> wrong[] = {
      {"0 40\n1 50\n", "line 2: the pressure is above"}, {"0 40\n0 30\n", "line 2: the flow rate is not above"},
      {"0 40\n1 -1\n", "line 2: the pressure changes"},  {"-1 40\n", "line 1: the flow rate is negative"},
      {"0 40\n\n1 2 3\n", "line 3: a point of a fan's"}, {"0 40\nfast 3\n", "line 2: a point of a fan's"},
      {"0 0\n1 0\n", "a fan of 0 Pa does nothing"},      {"flow, pressure\n", "has no curve of the fan"}};
  for (const auto& [text, message] : wrong)
  {
    EXPECT_THAT(messageOf([&, text = text] { read(text); }), HasSubstr(message)) << text;
  }
  EXPECT_THAT(messageOf([&] { atria::fanCurveFrom((scratch.path() / "none").string()); }), HasSubstr("nor a file"));
}

TEST(Baffles, HaveEntriesOfEachDialect)
{
  atria::CaseMesh mesh;
  mesh.patches.push_back({"In", "patch", {-1, 0, 0}, 1.0, {}});
  mesh.bounds = {atria::Vec3(0, 0, 0), atria::Vec3(4, 4, 3)};
  for (const auto dialect : {OpenFOAMDialect::OpenCFD1912, OpenFOAMDialect::OpenCFD, OpenFOAMDialect::Foundation,
                             OpenFOAMDialect::Foundation14})
  {
    const atria::testing::ScratchFolder scratch;
    atria::FlowCaseSettings settings;
    settings.dialect = dialect;
    settings.processors = 2;
    const std::vector<atria::PatchChoice> choices{{atria::PatchRole::Inlet}};
    atria::CaseOfDirection flow{mesh, settings, {1, 0, 0}, choices, {}};
    flow.baffles = {{"Window", {0, 1, 0}, 2.0, 2.0, 0.5, 4.0, 0.0, {}},
                    {"Fan", {0, 1, 0}, 2.0, 2.0, 0.5, 0.0, 0.0, {{0.0, 24.5}, {1.0, 12.25}}},
                    {"Steady", {0, 1, 0}, 2.0, 2.0, 0.5, 0.0, 0.0, {{0.0, 49.0}}}};
    atria::writeCaseFiles(scratch.path(), flow);
    const bool isFoundation = atria::isFoundation(dialect);
    const std::string p = atria::testing::bytesOf(scratch.path() / "0" / "p");
    EXPECT_THAT(p, HasSubstr("porousBafflePressure"));
    EXPECT_THAT(p, HasSubstr("I               4;"));
    EXPECT_THAT(p, HasSubstr(isFoundation ? "fanCurve        table ((0 20) (1 10));"
                                          : "jumpTable       table ((0 20) (0.5 10));"));
    EXPECT_THAT(p, HasSubstr(isFoundation ? "fanCurve        constant 40;" : "jumpTable       constant 40;"));
    const std::string k = atria::testing::bytesOf(scratch.path() / "0" / "k");
    EXPECT_THAT(k, HasSubstr("Window_side2\n    {\n        type            cyclic;\n"));
    const std::string models =
        atria::testing::bytesOf(scratch.path() / "constant" / (isFoundation ? "fvModels" : "fvOptions"));
    EXPECT_THAT(models, HasSubstr("f               (0 16 16);")); // 2 K over the width of a cell
    EXPECT_THAT(models, HasSubstr("e1              (0 1 0);"));
    EXPECT_THAT(models, HasSubstr("Fan_sides\n{"));
    EXPECT_THAT(models, Not(HasSubstr("Steady_sides"))); // its pressure does not depend on the flow
    EXPECT_THAT(atria::testing::bytesOf(scratch.path() / "system" / "decomposeParDict"),
                HasSubstr("patches         (Window_side1 Window_side2 Fan_side1"));
  }
}

} // namespace
