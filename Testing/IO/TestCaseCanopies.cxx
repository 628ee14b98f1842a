// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseFiles.h"
#include "Support/ErrorMessage.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace {

using atria::OpenFOAMDialect;
using atria::testing::messageOf;
using testing::HasSubstr;

TEST(CanopyRules, OfSeveralTheLastHolds)
{
  atria::CaseMesh mesh;
  mesh.rooms = {{"Hedge_1", 3.0}, {"Hedge_2", 4.0}, {"hall", 10.0}};
  const auto canopies =
      canopiesOf(mesh, {atria::canopyRuleFrom("Hedge* 2 0.2"), atria::canopyRuleFrom("\"Hedge_2\" 1.5 0.3")});
  ASSERT_EQ(canopies.size(), 2u);
  EXPECT_EQ(canopies[0].zone, "Hedge_1");
  EXPECT_DOUBLE_EQ(canopies[0].leafAreaDensity, 2.0);
  EXPECT_DOUBLE_EQ(canopies[1].dragCoefficient, 0.3);
  EXPECT_THAT(messageOf([&] { canopiesOf(mesh, {{"Hegde_1", 1.0, 1.0}}); }), HasSubstr("did you mean 'Hedge_1'?"));
  EXPECT_THAT(messageOf([&] { atria::canopiesOf({}, {{"Hedge", 1.0, 1.0}}); }), HasSubstr("no cell zones"));
  for (const char* wrong : {"Hedge", "Hedge 1", "Hedge 0 0.2", "Hedge 1 -0.2", "Hedge 1 0.2 3", "Hedge x 1", ""})
  {
    EXPECT_THAT(messageOf([&] { atria::canopyRuleFrom(wrong); }), HasSubstr("PATTERN LAD CD")) << wrong;
  }
}

TEST(Trees, AreReadFromTables)
{
  const atria::testing::ScratchFolder scratch;
  const auto file = scratch.path() / "trees.csv";
  const auto read = [&](const char* text) {
    std::ofstream(file) << text;
    return atria::readTrees(file);
  };
  const auto trees = read("x, y, height, crown radius, LAD, Cd\n-1.5, 2, 8, 2.5, 1, 0.2\n\n3;4;5;1;2;0.1\r\n");
  ASSERT_EQ(trees.size(), 2u);
  EXPECT_DOUBLE_EQ(trees[0].x, -1.5);
  EXPECT_DOUBLE_EQ(trees[1].dragCoefficient, 0.1);
  for (const char* wrong : {"1 2 3 4 5", "1 2 3 4 5 6 7", "1 2 -3 4 5 6", "x\n1 2 3 4 5 six"})
  {
    EXPECT_THAT(messageOf([&] { read(wrong); }), HasSubstr("line ")) << wrong;
  }
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "1,2,8,3,1,0.2\n3,4,5,1,2,0.1\n")
                .size(),
            2u);
  EXPECT_THAT(messageOf([&] { read("1,2,8,3,1,O.2\n3,4,5,1,2,0.1\n"); }), HasSubstr("line 1"));
  EXPECT_THAT(messageOf([&] { read("x, y\n"); }), HasSubstr("has no trees"));
  EXPECT_THAT(messageOf([&] { atria::readTrees(scratch.path() / "none.csv"); }), HasSubstr("cannot read"));
}

TEST(Canopies, HaveEntriesOfEachDialect)
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
    const std::vector<atria::PatchChoice> choices{{atria::PatchRole::Inlet}};
    atria::CaseOfDirection flow{mesh, settings, {1, 0, 0}, choices, {}};
    flow.canopies = {{"Hedge", 1.5, 0.25, 1.0}};
    atria::writeCaseFiles(scratch.path(), flow);
    const bool isFoundation = atria::isFoundation(dialect);
    const std::string models =
        atria::testing::bytesOf(scratch.path() / "constant" / (isFoundation ? "fvModels" : "fvOptions"));
    EXPECT_THAT(models, HasSubstr("f               (0.75 0.75 0.75);"));
    EXPECT_THAT(models, HasSubstr(dialect == OpenFOAMDialect::Foundation14 ? "porosityForceCoeffs"
                                                                           : "explicitPorositySourceCoeffs"));
    EXPECT_EQ(models.find("axesRotation") != std::string::npos, isFoundation);
    EXPECT_EQ(models.find("selectionMode") == std::string::npos, isFoundation);
  }
}

TEST(Canopies, AreSourcesOfTurbulenceWithKEpsilon)
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
    settings.turbulence = atria::TurbulenceModel::KEpsilon;
    const std::vector<atria::PatchChoice> choices{{atria::PatchRole::Inlet}};
    atria::CaseOfDirection flow{mesh, settings, {1, 0, 0}, choices, {}};
    flow.canopies = {{"Hedge", 1.5, 0.25, 1.0, {atria::Vec3(1, 2, 0.5)}, 0.002}};
    atria::writeCaseFiles(scratch.path(), flow);
    const bool isFoundation = atria::isFoundation(dialect);
    const auto constant = scratch.path() / "constant";
    const std::string models = atria::testing::bytesOf(constant / (isFoundation ? "fvModels" : "fvOptions"));
    EXPECT_THAT(models, HasSubstr("Sigma           constant 1.5;"));
    EXPECT_THAT(models, HasSubstr("CdSigma         0.25;"));
    EXPECT_THAT(models, HasSubstr("betad           5.1;"));
    EXPECT_THAT(models, HasSubstr("topSurface      canopy_Hedge.obj;"));
    EXPECT_THAT(atria::testing::bytesOf(constant / (isFoundation ? "momentumTransport" : "turbulenceProperties")),
                HasSubstr("kEpsilonLopesdaCosta;"));
    EXPECT_EQ(atria::testing::bytesOf(constant / (isFoundation ? "geometry" : "triSurface") / "canopy_Hedge.obj"),
              "v 0.999 1.999 0.501\nv 1.001 1.999 0.501\nv 1 2.001 0.501\nf 1 2 3\n");
  }
}

} // namespace
