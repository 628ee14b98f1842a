// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseSystem.h"
#include "FlowCase.h"
#include "FoamText.h"
#include "PolyMesh.h"
#include "Support/Error.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace {

using atria::PatchRole;
using testing::HasSubstr;
namespace fs = std::filesystem;

atria::CasePatch patch(const std::string& name, const std::string& type, const atria::Vec3& areaVector, double area)
{
  atria::CasePatch made;
  made.name = name;
  made.type = type;
  made.areaVector = areaVector;
  made.area = area;
  return made;
}

std::string messageOf(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const atria::Error& error)
  {
    return error.what();
  }
  return {};
}

TEST(WindProfile, PassesThroughItsReference)
{
  for (const double roughness : {0.0002, 0.03, 1.5})
  {
    const atria::WindProfile wind{7.0, 12.0, roughness};
    EXPECT_DOUBLE_EQ(wind.velocity(12.0), 7.0);
    EXPECT_DOUBLE_EQ(wind.velocity(0.0), 0.0);
    EXPECT_GT(wind.velocity(30.0), 7.0);
  }
}

/// With u as the profile has it, production and dissipation of k are equal at every height, and the eddy viscosity
/// gives the same shear stress, u*^2, all the way up.
TEST(WindProfile, IsInEquilibrium)
{
  const atria::WindProfile wind{5.0, 10.0, 0.1};
  const double stress = std::pow(wind.frictionVelocity(), 2);
  for (const double z : {0.5, 3.0, 50.0})
  {
    const double step = 1e-5;
    const double shear = (wind.velocity(z + step) - wind.velocity(z - step)) / (2.0 * step);
    const double k = wind.kineticEnergy();
    const double viscosity = atria::turbulenceCmu * k * k / wind.dissipation(z);
    EXPECT_NEAR(viscosity * shear / stress, 1.0, 1e-6);
    EXPECT_NEAR(viscosity * shear * shear / wind.dissipation(z), 1.0, 1e-6);
    EXPECT_NEAR(wind.specificDissipation(z) * atria::turbulenceCmu * k / wind.dissipation(z), 1.0, 1e-12);
  }
}

TEST(WindDirections, GoBothWays)
{
  EXPECT_DOUBLE_EQ(atria::windFrom(0.0, 0.0), 270.0); // along x: from the west
  EXPECT_DOUBLE_EQ(atria::windFrom(90.0, 0.0), 180.0);
  for (const double from : {0.0, 22.5, 181.0, 359.0})
  {
    EXPECT_NEAR(atria::windFrom(atria::windTowards(from, 33.0), 33.0), from, 1e-10);
  }
  EXPECT_EQ(atria::windVector(90.0), atria::Vec3(0.0, 1.0, 0.0));
  EXPECT_NEAR(atria::windVector(217.3).norm(), 1.0, 1e-14);
  EXPECT_EQ(atria::windLabel(270.0), "270");
  EXPECT_EQ(atria::windLabel(22.5), "022.5");
  EXPECT_EQ(atria::windLabel(359.99), "000");
  EXPECT_EQ(atria::windRose(4, 0.0), (std::vector<double>{270.0, 180.0, 90.0, 0.0}));
}

TEST(PatchRoles, FollowFromShapeAndWind)
{
  atria::CaseMesh mesh;
  mesh.patches = {patch("west", "patch", {-10, 0, 0}, 10),       patch("round", "patch", {1, 0, 0}, 50),
                  patch("top", "patch", {0, 0, 9}, 9),           patch("below", "patch", {0, 0, -9}, 9),
                  patch("hill", "wall", {0, 1, -8}, 9),          patch("floor", "wall", {0, 0, -4}, 4),
                  patch("mirror", "symmetryPlane", {0, 5, 0}, 5)};
  mesh.patches[4].meetsSides = true;
  const auto choices = choosePatches(mesh, {}, {1, 0, 0});
  std::vector<PatchRole> roles;
  for (const atria::PatchChoice& choice : choices)
  {
    roles.push_back(choice.role);
  }
  EXPECT_EQ(roles, (std::vector{PatchRole::Inlet, PatchRole::InletOutlet, PatchRole::Slip, PatchRole::Ground,
                                PatchRole::Ground, PatchRole::Wall, PatchRole::Constraint}));
}

TEST(PatchRules, OfSeveralTheLastHolds)
{
  atria::CaseMesh mesh;
  mesh.patches = {patch("in", "patch", {-1, 0, 0}, 1), patch("out", "patch", {1, 0, 0}, 1),
                  patch("my wall", "wall", {0, 0, 0}, 1)};
  atria::FlowCaseSettings settings;
  settings.patchRules = {atria::patchRuleFrom("*wall slip"), atria::patchRuleFrom("\"my w*\" rough:0.05")};
  const auto choices = choosePatches(mesh, settings, {1, 0, 0});
  EXPECT_EQ(choices[2].role, PatchRole::RoughWall);
  EXPECT_DOUBLE_EQ(choices[2].sandGrain, 0.05);
  EXPECT_THAT(messageOf([] { atria::patchRuleFrom("wall"); }), HasSubstr("PATTERN ROLE"));
  EXPECT_THAT(messageOf([] { atria::patchChoiceFrom("inlett"); }), HasSubstr("did you mean 'inlet'?"));
  for (const char* wrong : {"rough:", "rough:-1", "rough:x", "rough:1x", "rough:nan"})
  {
    EXPECT_THAT(messageOf([&] { atria::patchChoiceFrom(wrong); }), HasSubstr("rough:0.02")) << wrong;
  }
}

TEST(OrthogonalityRule, CorrectsLessWhereAnglesAreWorse)
{
  EXPECT_EQ(atria::ruleForAngle(20.0).correction, "corrected");
  EXPECT_EQ(atria::ruleForAngle(65.0).correctors, 1);
  EXPECT_LT(atria::ruleForAngle(80.0).pressureRelaxation, atria::ruleForAngle(65.0).pressureRelaxation);
}

TEST(OrthogonalityRule, CorrectsTurbulenceByNoMoreThanRelaxationKeeps)
{
  for (const double angle : {20.0, 65.0, 80.0})
  {
    const atria::OrthogonalityRule rule = atria::ruleForAngle(angle);
    const std::string limited = "limited corrected ";
    ASSERT_TRUE(rule.turbulenceCorrection.starts_with(limited));
    EXPECT_LE(std::stod(rule.turbulenceCorrection.substr(limited.size())), 1.0 - rule.turbulenceRelaxation + 1e-12);
  }
}

class PolyMeshFiles : public testing::Test
{
protected:
  void SetUp() override
  {
    fs::create_directories(folder / "constant" / "polyMesh");
    // A unit cube.
    write("points", "vectorField", "8((0 0 0)(1 0 0)(0 1 0)(1 1 0)(0 0 1)(1 0 1)(0 1 1)(1 1 1)) // done\n");
    write("faces", "faceList", "6(4(0 4 6 2) 4(1 3 7 5) 4(0 1 5 4) 4(2 6 7 3) 4(0 2 3 1) 4(4 5 7 6))");
    write("owner", "labelList", "6{0}");
    write("neighbour", "labelList", "0()");
    write("boundary", "polyBoundaryMesh",
          "1(\n/* all */ sides { type patch; inGroups 1(open); nFaces 6; startFace 0; }\n)");
  }
  void write(const std::string& name, const std::string& of, const std::string& content) const
  {
    std::ofstream(folder / "constant" / "polyMesh" / name)
        << "FoamFile { version 2.0; format ascii; class " << of << "; object " << name << "; }\n"
        << content;
  }

  const atria::testing::ScratchFolder scratch;
  const fs::path folder = scratch.path();
};

TEST_F(PolyMeshFiles, AreRead)
{
  write("faceZones", "regIOobject", "0()");
  const atria::PolyMesh poly = atria::readPolyMesh(folder);
  EXPECT_EQ(poly.mesh.cellCount, 1u);
  EXPECT_EQ(poly.mesh.faceCount(), 6u);
  ASSERT_EQ(poly.patches.size(), 1u);
  EXPECT_EQ(poly.patches[0].type, "patch");
  EXPECT_TRUE(poly.faceZones.empty());
}

TEST_F(PolyMeshFiles, TypesOfPatchesChangeInPlace)
{
  atria::setPatchTypes(folder, {{"sides", "wall"}, {"others", "patch"}});
  EXPECT_EQ(atria::readPolyMesh(folder).patches[0].type, "wall");
  EXPECT_THAT(atria::testing::bytesOf(folder / "constant" / "polyMesh" / "boundary"),
              HasSubstr("/* all */ sides { type wall; inGroups 1(open); nFaces 6; startFace 0; }"));
}

TEST_F(PolyMeshFiles, DamageIsToldWithItsPlace)
{
  const auto complaint = [&] { return messageOf([&] { atria::readPolyMesh(folder); }); };
  write("owner", "labelList", "7{0}");
  EXPECT_THAT(complaint(), HasSubstr("6 faces, but 7 owners"));
  write("owner", "labelList", "99999999999(0)");
  EXPECT_THAT(complaint(), HasSubstr("owner:2"));
  write("owner", "labelList", "6(0 0 0\n0 x 0)");
  EXPECT_THAT(complaint(), HasSubstr("owner:3: expected an integer"));
  write("owner", "labelList", "6{0}");
  write("faces", "faceList", "6(4(0 4 6 2) 4(1 3 7 5) 4(0 1 5 4) 4(2 6 7 3) 4(0 2 3 1) 4(4 5 7 8))");
  EXPECT_THAT(complaint(), HasSubstr("a face has point 8, but there are 8"));
  write("faces", "faceList", "6(4(0 4 6 2");
  EXPECT_THAT(complaint(), HasSubstr("faces:2"));
  fs::remove(folder / "constant" / "polyMesh" / "points");
  EXPECT_THAT(complaint(), HasSubstr("points"));
}

} // namespace
