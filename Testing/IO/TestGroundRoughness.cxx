// SPDX-License-Identifier: GPL-3.0-or-later
#include "EmptyDomain.h"
#include "GroundRoughness.h"
#include "Support/ErrorMessage.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using atria::OpenFOAMDialect;
using atria::PatchRole;
using atria::testing::messageOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A box 100 m x 40 m x 20 m, with a house of 10 m from x = 40 m on and two grounds: `lawn` before x = 30 m, and
/// `road`.
atria::CaseMesh siteMesh()
{
  const auto box = [](double x0, double x1, double z1) {
    return atria::Box3{atria::Vec3(x0, 0, 0), atria::Vec3(x1, 40, z1)};
  };
  atria::CaseMesh mesh;
  mesh.bounds = box(0, 100, 20);
  mesh.patches = {{"in", "patch", {-800, 0, 0}, 800, box(0, 0, 20), false, {1.0, 1.0}},
                  {"out", "patch", {800, 0, 0}, 800, box(100, 100, 20), false, {1.0, 1.0}},
                  {"sky", "patch", {0, 0, 4000}, 4000, box(0, 100, 20), false, {1.0, 1.0}},
                  {"lawn", "wall", {0, 0, -1200}, 1200, box(0, 30, 0), true, {0.05, 0.1}},
                  {"road", "wall", {0, 0, -2400}, 2400, box(30, 100, 0), true, {0.05, 0.1}},
                  {"house", "wall", {0, 0, -400}, 2000, box(40, 50, 8), false, {0.2, 0.2}}};
  return mesh;
}

class Site : public testing::Test
{
protected:
  atria::CaseOfDirection flow(const std::vector<std::string>& grounds)
  {
    settings.patchRules.clear();
    for (const std::string& ground : grounds)
    {
      settings.patchRules.push_back(atria::groundRuleFrom(ground));
    }
    const atria::Vec3 wind(1, 0, 0);
    return {mesh, settings, wind, atria::choosePatches(mesh, settings, wind), {}};
  }

  const atria::CaseMesh mesh = siteMesh();
  atria::FlowCaseSettings settings;
};

TEST(GroundKinds, AreThoseOfDavenport)
{
  const std::pair<const char*, double> known[] = {{"water", 0.0002}, {"smooth", 0.005},   {"grass", 0.03},
                                                  {"crops", 0.1},    {"highCrops", 0.25}, {"parkland", 0.5},
                                                  {"suburb", 1.0},   {"forest", 1.0},     {"city", 2.0}};
  EXPECT_EQ(atria::groundKinds().size(), std::size(known));
  for (const auto& [kind, roughness] : known)
  {
    EXPECT_EQ(atria::roughnessFrom(kind), roughness) << kind;
  }
  EXPECT_EQ(atria::roughnessFrom("0.07"), 0.07);
}

TEST(GroundKinds, OthersAreRefusedWithTheNearest)
{
  const std::string text = messageOf([] { atria::roughnessFrom("gras"); });
  EXPECT_THAT(text, HasSubstr("did you mean 'grass'?"));
  EXPECT_THAT(messageOf([] { atria::roughnessFrom("moon"); }), HasSubstr("water, smooth, grass"));
  for (const char* wrong : {"0", "-1", "nan", "inf", "101"})
  {
    EXPECT_THAT(messageOf([&] { atria::roughnessFrom(wrong); }), HasSubstr("not above 0 and at most 100 m")) << wrong;
  }
  for (const char* wrong : {"0.1m", "", "0,1"})
  {
    EXPECT_THAT(messageOf([&] { atria::roughnessFrom(wrong); }), HasSubstr("neither a roughness length")) << wrong;
  }
}

TEST(GroundRules, HaveAPatternAndALength)
{
  const atria::PatchRule rule = atria::groundRuleFrom("\"my lawn*\" grass");
  EXPECT_EQ(rule.pattern, "my lawn*");
  EXPECT_EQ(rule.choice.role, PatchRole::Ground);
  EXPECT_EQ(rule.choice.roughness, 0.03);
  for (const char* wrong : {"lawn", "", "lawn grass 1"})
  {
    EXPECT_THAT(messageOf([&] { atria::groundRuleFrom(wrong); }), HasSubstr("PATTERN LENGTH or PATTERN KIND")) << wrong;
  }
}

TEST_F(Site, OfSeveralGroundRulesTheLastHolds)
{
  const auto choices = flow({"?oad 0.1", "lawn 0.5", "road 0.5", "l* grass"}).choices;
  EXPECT_EQ(choices[3].roughness, 0.03);
  EXPECT_EQ(choices[4].roughness, 0.5);
  EXPECT_EQ(flow({"lawn grass"}).choices[4].roughness, std::nullopt);
  EXPECT_THAT(messageOf([&] { flow({"lawm grass"}); }), HasSubstr("no patch matches 'lawm'; did you mean 'lawn'?"));
}

TEST_F(Site, WarnsOfCellsThatAreTooLow)
{
  settings.wind.roughness = 0.01;
  EXPECT_THAT(atria::warnOfRoughness(flow({"lawn grass"})), IsEmpty());
  const auto warnings = atria::warnOfRoughness(flow({"lawn crops", "road 20"}));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_THAT(warnings[0],
              HasSubstr("'lawn' (0.1 m), 'road' (20 m): it is more than half of their height, at 'lawn' 0.05 m"));
  EXPECT_THAT(warnings[1], HasSubstr("'road' (20 m) is more than the wind's reference height, 10 m"));
}

TEST(GroundUpstream, MustBeLikeTheProfile)
{
  const atria::WindProfile wind{5.0, 10.0, 0.1};
  EXPECT_THAT(atria::warnOfUpstream(wind, {{".", 0.1}}), IsEmpty());
  EXPECT_THAT(atria::warnOfUpstream(wind, {{".", 0.199}, {".", 0.051}}), IsEmpty());
  EXPECT_THAT(atria::warnOfUpstream(wind, {{".", 0.25}}),
              ElementsAre(AllOf(HasSubstr("0.25 m on average, the wind's profile one of 0.1 m"),
                                HasSubstr("set RoughnessLength to 0.25"))));
  EXPECT_THAT(atria::warnOfUpstream(wind, {{"wind_000", 0.1}, {"wind_090", 0.03}}),
              ElementsAre(HasSubstr("0.03 m on average in wind_090")));
}

/// Two squares of ground, the second behind the edge of a building.
TEST_F(Site, MeansRoughnessBeforeTheBuildings)
{
  atria::PolyMesh poly;
  for (const double x : {0.0, 30.0, 60.0, 100.0})
  {
    poly.mesh.points.insert(poly.mesh.points.end(), {atria::Vec3(x, 0, 0), atria::Vec3(x, 40, 0)});
  }
  atria::FaceMesh& faces = poly.mesh;
  const std::vector<std::vector<atria::Index>> corners{{0, 1, 3, 2}, {2, 3, 5, 4}, {4, 5, 7, 6}};
  faces.faceOffsets = {0};
  for (const auto& face : corners)
  {
    faces.facePoints.insert(faces.facePoints.end(), face.begin(), face.end());
    faces.faceOffsets.push_back(static_cast<atria::Index>(faces.facePoints.size()));
  }
  poly.patches = {{"in", "patch", {}},   {"out", "patch", {}},  {"sky", "patch", {}},
                  {"lawn", "wall", {0}}, {"road", "wall", {1}}, {"house", "wall", {2}}};
  const auto mean = atria::roughnessUpstream(poly, flow({"lawn 0.01", "road 1"}));
  ASSERT_TRUE(mean);
  EXPECT_NEAR(*mean, 0.1, 1e-12); // equal areas: the geometric mean
}

TEST(Gradings, MeetBothEnds)
{
  for (const auto& [height, first, top] :
       {std::tuple(100.0, 0.2, 8.0), std::tuple(30.0, 1.0, 1.0), std::tuple(500.0, 0.5, 40.0)})
  {
    const atria::Grading grading = atria::gradingOf(height, first, top);
    const std::vector<double> centers = atria::centersOf(grading, height);
    ASSERT_EQ(centers.size(), static_cast<std::size_t>(grading.cells));
    EXPECT_NEAR(centers.front() / (0.5 * first), 1.0, 0.1);
    EXPECT_NEAR((height - centers.back()) / (0.5 * top), 1.0, 0.1);
    EXPECT_TRUE(std::ranges::is_sorted(centers));
  }
}

/// Near the ground cells keep their height where their number is limited.
TEST(Gradings, KeepTheFirstCell)
{
  for (const auto& [height, first, top] : {std::tuple(100.0, 0.1, 0.1), std::tuple(20.0, 5.0, 5.0)})
  {
    const std::vector<double> centers = atria::centersOf(atria::gradingOf(height, first, top), height);
    EXPECT_NEAR(centers.front() / (0.5 * first), 1.0, 1e-6);
    EXPECT_GE(centers.size(), 10u);
    EXPECT_LE(centers.size(), 60u);
  }
}

TEST_F(Site, HasAnEmptyDomainAlongTheWind)
{
  const atria::EmptyDomain domain = atria::emptyDomainOf(flow({}));
  EXPECT_EQ(domain.start, atria::Vec3(0, 20, 0));
  EXPECT_DOUBLE_EQ(domain.length, 100.0);
  EXPECT_DOUBLE_EQ(domain.fetch, 40.0);
  EXPECT_DOUBLE_EQ(domain.height, 20.0);
  EXPECT_DOUBLE_EQ(domain.heightOfInterest, 16.0);
  EXPECT_EQ(domain.cellsAlong, 50);
}

TEST(EmptyDomains, DoNotEndAtOpeningsOfBuildings)
{
  atria::CaseMesh mesh = siteMesh();
  const auto opening = [](double x) { return atria::Box3{atria::Vec3(x, 18, 1), atria::Vec3(x, 20, 2)}; };
  mesh.patches.push_back({"exhaust", "patch", {2, 0, 0}, 2, opening(40), false, {0.2, 0.2}});
  mesh.patches.push_back({"vent", "patch", {-2, 0, 0}, 2, opening(50), false, {0.2, 0.2}});
  const atria::FlowCaseSettings settings;
  const atria::Vec3 wind(1, 0, 0);
  std::vector<atria::PatchChoice> choices = choosePatches(mesh, settings, wind);
  choices[6] = {atria::PatchRole::Outlet};
  choices[7] = {atria::PatchRole::Inlet};
  const atria::EmptyDomain domain = atria::emptyDomainOf({mesh, settings, wind, choices, {}});
  EXPECT_EQ(domain.start, atria::Vec3(0, 20, 0));
  EXPECT_DOUBLE_EQ(domain.length, 100.0);
  EXPECT_DOUBLE_EQ(domain.fetch, 40.0);
}

TEST_F(Site, WithoutGroundHasNoEmptyDomain)
{
  atria::CaseOfDirection without = flow({});
  without.choices[3] = without.choices[4] = {};
  EXPECT_THAT(messageOf([&] { atria::emptyDomainOf(without); }), HasSubstr("CheckProfile needs a mesh with ground"));
}

TEST_F(Site, WritesItsEmptyDomainInAllDialects)
{
  const std::pair<OpenFOAMDialect, const char*> dialects[] = {{OpenFOAMDialect::OpenCFD1912, "patches         (in);"},
                                                              {OpenFOAMDialect::OpenCFD, "patches         (in);"},
                                                              {OpenFOAMDialect::Foundation, "patchName       in;"},
                                                              {OpenFOAMDialect::Foundation14, "patchName       in;"}};
  const atria::testing::ScratchFolder scratch;
  for (const auto& [dialect, probed] : dialects)
  {
    settings.dialect = dialect;
    const auto folder = scratch.path() / std::to_string(static_cast<int>(dialect));
    const auto described = atria::writeEmptyDomain(folder, flow({"lawn grass"}), 0.05);
    EXPECT_EQ(described["fetch"], 40.0);
    EXPECT_EQ(described["roughness_length"], 0.05);
    const auto text = [&](const char* file) { return atria::testing::bytesOf(folder / "empty_domain" / file); };
    EXPECT_THAT(text("system/blockMeshDict"), HasSubstr("(50 1 "));
    EXPECT_THAT(text("system/blockMeshDict"), HasSubstr("    road\n    {\n        type            wall;"));
    EXPECT_THAT(text("system/controlDict"), HasSubstr(probed));
    EXPECT_THAT(text("Allrun"), HasSubstr("\nrun blockMesh blockMesh\n"));
    EXPECT_THAT(text("0/nut"), HasSubstr(dialect == OpenFOAMDialect::Foundation14 ? "Ks              uniform 0.49"
                                                                                  : "z0              uniform 0.05"));
  }
}

/// The ground with its own roughness length has the wall function of it in all dialects; the other keeps the wind's.
TEST_F(Site, WritesRoughnessInAllDialects)
{
  settings.wind.roughness = 0.2;
  const atria::testing::ScratchFolder scratch;
  const std::pair<const char*, const char*> conditions[] = {
      {"nutkAtmRoughWallFunction", "nutkAtmRoughWallFunction"},
      {"atmNutkWallFunction", "atmNutkWallFunction"},
      {"nutkAtmRoughWallFunction", "nutkAtmRoughWallFunction"},
      {"nutkRoughWallFunction", "nutAtmosphericBoundaryLayerWallFunction"}};
  for (std::size_t i = 0; i < std::size(conditions); ++i)
  {
    settings.dialect = static_cast<OpenFOAMDialect>(i);
    const atria::CaseOfDirection site = flow({"lawn grass"});
    const auto typeOf = [&](std::size_t patch) {
      atria::Filling filling = atria::fillingOf(site);
      atria::addPatch(filling, site, mesh.patches[patch], site.choices[patch]);
      return atria::textOf(atria::caseConditions(), "nut", filling);
    };
    EXPECT_THAT(typeOf(3), testing::Contains(HasSubstr(conditions[i].first)));
    EXPECT_THAT(typeOf(4), testing::Contains(HasSubstr(conditions[i].second)));
    if (i < 3)
    {
      EXPECT_THAT(typeOf(3), testing::Contains("z0              uniform 0.03;"));
      EXPECT_THAT(typeOf(4), testing::Contains("z0              uniform 0.2;"));
    }
  }
}

} // namespace
