// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseValues.h"
#include "FoamText.h"
#include "OpeningNames.h"
#include "PolyMesh.h"
#include "Support/ErrorMessage.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace {

using atria::PatchRole;
using atria::testing::messageOf;
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
  mesh.patches = {patch("west", "patch", {-10, 0, 0}, 10),
                  patch("round", "patch", {1, 0, 0}, 50),
                  patch("top", "patch", {0, 0, 9}, 9),
                  patch("below", "patch", {0, 0, -9}, 9),
                  patch("hill", "wall", {0, 1, -8}, 9),
                  patch("floor", "wall", {0, 0, -4}, 4),
                  patch("mirror", "symmetryPlane", {0, 5, 0}, 5),
                  patch("hedge", "wall", {0, 0, -4}, 4)};
  mesh.patches[4].meetsSides = true;
  mesh.rooms = {{"hedge", 4.0}};
  const auto choices = choosePatches(mesh, {}, {1, 0, 0});
  std::vector<PatchRole> roles;
  for (const atria::PatchChoice& choice : choices)
  {
    roles.push_back(choice.role);
  }
  EXPECT_EQ(roles, (std::vector{PatchRole::Inlet, PatchRole::InletOutlet, PatchRole::Slip, PatchRole::Ground,
                                PatchRole::Ground, PatchRole::Wall, PatchRole::Constraint, PatchRole::Ground}));
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

TEST(OpeningNames, AreWordsOfNames)
{
  using atria::VentilationOpening;
  for (const char* inlet : {"inlet", "INLET", "Inlet_1", "inlet2", "WestInlet", "air-supply", "HVACSupply_front",
                            "Inlets", "SUPPLY.3", "Diffuser_12", "inflow"})
  {
    EXPECT_EQ(atria::ventilationOpeningOf(inlet), VentilationOpening::Inlet) << inlet;
  }
  for (const char* outlet : {"outlet", "Outlet_B", "ExhaustGrille", "exhaust1", "extractAir", "Return_2", "outflow"})
  {
    EXPECT_EQ(atria::ventilationOpeningOf(outlet), VentilationOpening::Outlet) << outlet;
  }
  for (const char* neither : {"", "_1", "Walls", "inletoutlet", "Inlet_Outlet", "SupplyDuct", "wall_outlet",
                              "PowerOutlet", "inlet-frame", "supplying", "Window_1"})
  {
    EXPECT_FALSE(atria::ventilationOpeningOf(neither)) << neither;
  }
}

/// A room with all roles that rules and names give.
atria::CaseMesh roomMesh()
{
  atria::CaseMesh mesh;
  mesh.patches = {patch("Walls", "wall", {0, 0, 0}, 90), patch("Inlet_1", "wall", {0, 0, 2}, 2),
                  patch("Exhaust", "wall", {0, 1, 0}, 1), patch("East", "wall", {3, 0, 0}, 3)};
  return mesh;
}

std::vector<atria::PatchRule> rules(const std::vector<std::string>& texts)
{
  std::vector<atria::PatchRule> made;
  for (const std::string& text : texts)
  {
    made.push_back(atria::patchRuleFrom(text));
  }
  return made;
}

TEST(Supplies, HaveAUnit)
{
  using atria::Supply;
  for (const auto& [text, quantity, amount] :
       {std::tuple("inlet:0.5m/s", Supply::Speed, 0.5), std::tuple("inlet:2m3/s", Supply::FlowRate, 2.0),
        std::tuple("inlet:180m3/h", Supply::FlowRate, 0.05), std::tuple("inlet:5e1l/s", Supply::FlowRate, 0.05)})
  {
    const atria::PatchChoice choice = atria::patchChoiceFrom(text);
    EXPECT_EQ(choice.role, PatchRole::Inlet);
    ASSERT_TRUE(choice.supply) << text;
    EXPECT_EQ(choice.supply->quantity, quantity);
    EXPECT_DOUBLE_EQ(choice.supply->amount, amount);
  }
  for (const char* wrong : {"inlet:", "inlet:1", "inlet:m/s", "inlet:-1m/s", "inlet:0l/s", "inlet:1 m/s",
                            "inlet:infm/s", "inlet:1m/s,2l/s", "inlet:1ft/s"})
  {
    EXPECT_THAT(messageOf([&] { atria::patchChoiceFrom(wrong); }), HasSubstr("inlet:50l/s")) << wrong;
  }
  const Supply speed{Supply::Speed, 0.5};
  const Supply flow{Supply::FlowRate, 0.5};
  EXPECT_DOUBLE_EQ(speed.flowRate(4.0), 2.0);
  EXPECT_DOUBLE_EQ(flow.speed(4.0), 0.125);
}

TEST(Rooms, FollowFromNamesAndRules)
{
  const atria::CaseMesh mesh = roomMesh();
  atria::FlowCaseSettings settings;
  settings.supply = {atria::Supply::FlowRate, 0.1};
  settings.patchRules = rules({"East inlet:2m/s"});
  EXPECT_TRUE(atria::isRoom(mesh, settings));
  const auto choices = atria::chooseRoomPatches(mesh, settings);
  EXPECT_EQ(choices[0].role, PatchRole::Wall);
  EXPECT_EQ(choices[2].role, PatchRole::Outlet);
  ASSERT_TRUE(choices[1].supply && choices[3].supply);
  EXPECT_EQ(choices[1].supply->quantity, atria::Supply::FlowRate);
  EXPECT_EQ(choices[3].supply->amount, 2.0);
  settings.patchRules = rules({"Exhaust wall", "East outlet"}); // a name is overruled
  EXPECT_EQ(atria::chooseRoomPatches(mesh, settings)[2].role, PatchRole::Wall);
}

TEST(Rooms, HaveWallsAllAround)
{
  const auto isRoom = [](const atria::CasePatch& side, const std::vector<std::string>& texts,
                         const std::vector<double>& directions = {}) {
    atria::CaseMesh mesh = roomMesh();
    mesh.patches.push_back(side);
    atria::FlowCaseSettings settings;
    settings.patchRules = rules(texts);
    settings.directions = directions;
    return atria::isRoom(mesh, settings);
  };
  const atria::CasePatch west = patch("xMin", "patch", {-9, 0, 0}, 9);
  EXPECT_FALSE(isRoom(west, {}));
  EXPECT_FALSE(isRoom(west, {"xMin slip"}));
  EXPECT_TRUE(isRoom(west, {"xMin wall"}));
  EXPECT_TRUE(isRoom(west, {"xMin outlet"}));
  EXPECT_FALSE(isRoom(patch("zMax", "patch", {0, 0, 9}, 9), {})); // the sky
  EXPECT_TRUE(isRoom(patch("zMin", "patch", {0, 0, -9}, 9), {})); // a floor that the model lacks
  EXPECT_FALSE(isRoom(patch("zMin", "patch", {0, 0, -9}, 9), {"zMin ground"}));
  EXPECT_FALSE(isRoom(patch("half", "symmetryPlane", {9, 0, 0}, 9), {}));
  const atria::CasePatch empty = patch("xMin", "patch", {0, 0, 0}, 0);
  EXPECT_TRUE(isRoom(empty, {}));
  EXPECT_FALSE(isRoom(empty, {}, {90.0}));
  EXPECT_FALSE(isRoom(empty, {"Inlet_1 wall", "Exhaust wall"})); // no opening is left
}

TEST(Rooms, NeedAirInAndOut)
{
  const auto complaint = [](const std::vector<std::string>& texts) {
    atria::FlowCaseSettings settings;
    settings.kind = atria::FlowKind::Room;
    settings.patchRules = rules(texts);
    return messageOf([&] { atria::chooseRoomPatches(roomMesh(), settings); });
  };
  EXPECT_THAT(complaint({"Exhaust wall"}), HasSubstr("out of the room: it has inlets only ('Inlet_1')"));
  EXPECT_THAT(complaint({"Inlet_1 outlet"}), HasSubstr("into the room: it has outlets only ('Inlet_1', 'Exhaust')"));
  EXPECT_THAT(complaint({"* wall"}), HasSubstr("PatchRules NAME inlet and PatchRules NAME outlet"));
  EXPECT_THAT(complaint({"Walls ground"}), HasSubstr("make 'Walls' wall or rough:SIZE"));
  EXPECT_THAT(complaint({"East inlet:1m/s", "East inlet:1l/s"}), HasSubstr("'East' has both a speed and a flow rate"));
  EXPECT_EQ(complaint({"Exhaust inletOutlet"}), "");
}

TEST(Inlets, MustFaceTheWind)
{
  atria::CaseMesh mesh;
  mesh.patches = {patch("west", "patch", {-1, 0, 0}, 1), patch("east", "patch", {1, 0, 0}, 1),
                  patch("side", "patch", {0, 1, 0}, 1),  patch("top", "patch", {0, 0, 1}, 1),
                  patch("box", "wall", {0, 0, 0.1}, 6),  patch("fan", "wall", {1, 0, 0}, 1),
                  patch("blower", "wall", {1, 0, 0}, 1), patch("out", "patch", {1, 0, 0}, 1)};
  atria::FlowCaseSettings settings;
  settings.patchRules = rules({"* inlet", "blower inlet:1m/s", "out outlet"});
  settings.conditionRules = {atria::conditionRuleFrom("fan U type fixedValue; value uniform (1 0 0);")};
  const auto without = [&](const atria::Vec3& wind) {
    return atria::inletsWithoutWind(mesh, settings, atria::choosePatches(mesh, settings, wind), wind);
  };
  EXPECT_EQ(without({1, 0, 0}), (std::vector<std::string>{"east", "side", "top"}));
  EXPECT_EQ(without({-1, 0, 0}), (std::vector<std::string>{"west", "side", "top"}));
  EXPECT_EQ(without({0, -1, 0}), (std::vector<std::string>{"west", "east", "top"}));
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
