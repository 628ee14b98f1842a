// SPDX-License-Identifier: GPL-3.0-or-later
/// What the dual mesher keeps of a run for the next one: whatever changes in between, its outputs are those of a fresh
/// filter.
#include "DualMesherTest.h"
#include "Support/Campaign.h"
#include "Support/ProgressWatch.h"
#include "Support/TestPaths.h"
#include "vtkAtriaOctreeSource.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <random>
#include <regex>
#include <set>

namespace {

using atria::Box3;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::ProgressWatch;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

/// A building with a canopy, a room with a window, a dome, a lamp on a ground, a post close to the room, and a fin that
/// nearly meets it.
TriangleSurface scene()
{
  TriangleSurface surface;
  const auto sheet = [&](const char* name, const Vec3& corner, const Vec3& u, const Vec3& v) {
    atria::testing::addSheet(surface, name, corner, u, v);
  };
  atria::testing::addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
  sheet("Canopy", Vec3(-1.7, -3.2, 2.1), Vec3(2.8, 0, 0), Vec3(0, 1.3, 0));
  atria::testing::addSphere(surface, "Dome", Vec3(4.1, 1.3, 2.2), 1.4, 3);
  sheet("Ground", Vec3(-5, -4, 0), Vec3(12, 0, 0), Vec3(0, 9, 0));
  const Vec3 x(3.2, 0, 0);
  const Vec3 y(0, 2.6, 0);
  const Vec3 z(0, 0, 3.1);
  const Vec3 corner(2.3, -3.3, 0.0);
  sheet("Room", corner, y, z);
  sheet("Room", corner + x, y, z);
  sheet("Room", corner + y, x, z);
  sheet("Room", corner + z, x, y);
  sheet("Room", corner, 0.25 * x, z); // the wall with the window
  sheet("Room", corner + 0.75 * x, 0.25 * x, z);
  sheet("Room", corner + 0.25 * x, 0.5 * x, 0.3 * z);
  sheet("Room", corner + 0.25 * x + 0.8 * z, 0.5 * x, 0.2 * z);
  atria::testing::addBox(surface, "Lamp", {Vec3(-3.6, 3.1, 0.0), Vec3(-3.2, 3.4, 0.6)});
  sheet("Post", corner + y + Vec3(1.0, 0.16, 0), Vec3(1.0, 0, 0), Vec3(0, 0, 2.4));
  sheet("Fin", corner + Vec3(-0.2, 1.1, 0), Vec3(-1.1, 0, 0), Vec3(0, 0, 2.7));
  return surface;
}

using Set = std::function<void(vtkAtriaDualMesher&)>;

/// A change of one property, and what else must be so before that it matters.
struct Change
{
  std::string command;
  Set change;
  Set given = [](vtkAtriaDualMesher&) {};
};

std::ostream& operator<<(std::ostream& out, const Change& change) { return out << change.command; }

void automatic(vtkAtriaDualMesher& m)
{
  m.SetDomainModeToAutomatic();
  m.SetSiteName("Ground");
  m.SetSizeMax(8.0);
  m.SetSizeMid(2.0);
  m.SetSizeMin(1.0);
}

void fineDome(vtkAtriaDualMesher& m) { m.AddSurfaceSizeRule("Dome", 0.25, 0.25); }

std::vector<Change> changesOfGrid()
{
  using M = vtkAtriaDualMesher;
  return {
      {"SetSizeMax", [](M& m) { m.SetSizeMax(1.0); }},
      {"SetSizeMid", [](M& m) { m.SetSizeMid(0.5); }},
      {"SetSizeMin", [](M& m) { m.SetSizeMin(0.25); }},
      {"AddSurfaceSizeRule", [](M& m) { m.AddSurfaceSizeRule("Dome", 0.25); }},
      {"AddDistanceSizeRule", [](M& m) { m.AddDistanceSizeRule("Dome", 1.5, 0.5); }},
      {"AddRefinementBox", [](M& m) { m.AddRefinementBox(-4, -2, 2, 4, 0, 2, 0.25); }},
      {"SetCurvatureAngle", [](M& m) { m.SetCurvatureAngle(10.0); }},
      {"SetCellsAcrossGap", [](M& m) { m.SetCellsAcrossGap(8); }},
      {"SetCellsPerLevel", [](M& m) { m.SetCellsPerLevel(3); }},
      {"SetElementType", [](M& m) { m.SetElementTypeToHexahedral(); }},
      {"SetMaxElements", [](M& m) { m.SetMaxElements(900); }},
      {"SetMemoryLimit", [](M& m) { m.SetMemoryLimit(4.0); }},
      {"SetStartLevel", [](M& m) { m.SetStartLevel(6); }},
      {"SetDomainMode", [](M& m) { m.SetDomainModeToFromSurfaces(); }},
      {"SetWindAngle", [](M& m) { m.SetWindAngle(40.0); }, automatic},
      {"SetDomainBounds", [](M& m) { m.SetDomainBounds(-5, 7, -4, 5, 0, 7); }},
      {"SetSiteName", [](M& m) { m.SetSiteName("Canopy"); }, [](M& m) { automatic(m); }},
      {"SetTerrainName", [](M& m) { m.SetTerrainName("Ground"); },
       [](M& m) {
         automatic(m);
         m.SetSiteName("Canopy");
       }},
      {"SetGroundSnapRatio", [](M& m) { m.SetGroundSnapRatio(0.0); },
       [](M& m) {
         automatic(m);
         TriangleSurface hovering = scene();
         atria::testing::addBox(hovering, "Kiosk", {Vec3(-4.5, -3.4, 0.2), Vec3(-3.0, -2.1, 1.6)});
         m.SetInputDataObject(atria::testing::toPolyData(hovering));
       }},
      {"SetDomainAngle", [](M& m) { m.SetDomainAngle(10.0); }},
      {"SetDomainSides", [](M& m) { m.SetDomainSides(12); }},
      {"AddDomainCorner",
       [](M& m) {
         m.AddDomainCorner(-6, -5);
         m.AddDomainCorner(8, -5);
         m.AddDomainCorner(1, 14);
       }},
      {"SetAlignGrid", [](M& m) { m.SetAlignGridToDomain(); }, [](M& m) { m.SetDomainAngle(10.0); }},
      {"SetFindOpenings", [](M& m) { m.SetFindOpenings(true); }},
      {"AddSurfaceWithoutOpenings", [](M& m) { m.AddSurfaceWithoutOpenings("Room"); },
       [](M& m) { m.SetFindOpenings(true); }},
      {"AddFaceZone", [](M& m) { m.AddFaceZone("Canopy"); }},
      {"AddCellZone", [](M& m) { m.AddCellZone("Dome"); }},
      {"SetGapTolerance", [](M& m) { m.SetGapTolerance(0.2); }},
      {"SetSmallPartSize", [](M& m) { m.SetSmallPartSize(3.0); }},
      {"SetFeatureAngle", [](M& m) { m.SetFeatureAngle(100.0); }},
  };
}

std::vector<Change> changesOfMesh()
{
  using M = vtkAtriaDualMesher;
  return {
      {"SetZoneRule", [](M& m) { m.SetZoneRuleToAll(); }},
      {"AddSeed", [](M& m) { m.AddSeed(0, 0, 1); },
       [](M& m) {
         m.SetZoneRuleToSeeds();
         m.AddSeed(-4, 0, 1);
       }},
      {"AddSealedSeed", [](M& m) { m.AddSealedSeed(3.5, -2, 1.5); }},
      {"SetNumberOfLayers", [](M& m) { m.SetNumberOfLayers(3); }},
      {"SetSupportElements", [](M& m) { m.SetSupportElements(false); }, [](M& m) { m.SetNumberOfLayers(0); }},
      {"SetFirstLayerHeight", [](M& m) { m.SetFirstLayerHeight(0.05); }},
      {"SetLayerGrowth", [](M& m) { m.SetLayerGrowth(2.0); }, [](M& m) { m.SetNumberOfLayers(2); }},
      {"AddLayerRule", [](M& m) { m.AddLayerRule("Dome", 2); }},
      {"SetTargetNonOrthogonality", [](M& m) { m.SetTargetNonOrthogonality(5.0); }, fineDome},
      {"SetTargetSkewness", [](M& m) { m.SetTargetSkewness(0.05); }, fineDome},
      {"SetCrackTolerance", [](M& m) { m.SetCrackTolerance(0.0); }},
      {"SetBlockSize", [](M& m) { m.SetBlockSize(200); }},
  };
}

std::vector<Change> allChanges()
{
  std::vector<Change> all = changesOfGrid();
  const std::vector<Change> more = changesOfMesh();
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

class StageCacheTest : public atria::testing::DualMesherTest
{
protected:
  using Outputs = std::array<vtkSmartPointer<vtkDataObject>, 3>;

  StageCacheTest()
  {
    prepare(*mesher);
    mesher->CacheStagesOn();
  }

  void prepare(vtkAtriaDualMesher& filter) const
  {
    atria::testing::setGrid(&filter, domain, 0.5, 1.0, 2.0);
    filter.SetStartLevel(0);
    filter.SetInputDataObject(input);
  }

  /// Of a filter that has not run before; with the number of its warnings.
  std::pair<Outputs, std::size_t> fresh(const std::vector<Set>& sets)
  {
    vtkNew<vtkAtriaDualMesher> filter;
    prepare(*filter);
    filter->CacheStagesOff();
    for (const Set& set : sets)
    {
      set(*filter);
    }
    filter->Update();
    Outputs outputs;
    for (int port = 0; port < 3; ++port)
    {
      outputs[port] = filter->GetOutputDataObject(port);
    }
    return {outputs, messages.takeWarnings().size()};
  }

  void expectAsFresh(const std::vector<Set>& sets)
  {
    const auto [outputs, warnings] = fresh(sets);
    expectOutputs(outputs);
    EXPECT_EQ(messages.takeWarnings().size(), warnings); // their texts are in the outputs
  }

  bool isAs(const Outputs& outputs)
  {
    bool same = true;
    for (int port = 0; port < 3; ++port)
    {
      same = same && atria::testing::identical(outputs[port], mesher->GetOutputDataObject(port));
    }
    return same;
  }

  std::vector<std::string> stages()
  {
    std::vector<std::string> names;
    for (int i = 0; i < mesher->GetNumberOfStages(); ++i)
    {
      names.push_back(mesher->GetStageName(i));
    }
    return names;
  }

  vtkSmartPointer<vtkPolyData> input = atria::testing::toPolyData(scene());
  const ::testing::Matcher<std::vector<std::string>> afterLayers = ElementsAre("layers", "audit", "output");
  const ::testing::Matcher<std::vector<std::string>> afterZones =
      // The zones of the octree's own grid tell what of the model air may reach.
      ElementsAre("dual", "crossings", "zones", "audit", "vertices", "elements", "layers", "output");
  const ::testing::Matcher<std::vector<std::string>> afterCrossings =
      ElementsAre("dual", "crossings", "zones", "audit", "vertices", "elements", "layers", "output");
  const ::testing::Matcher<std::vector<std::string>> all = Contains("octree");
};

class EveryChange : public StageCacheTest, public ::testing::WithParamInterface<Change>
{
};

TEST_P(EveryChange, GivesWhatAFreshFilterDoes)
{
  const auto& [command, change, given] = GetParam();
  given(*mesher);
  const Outputs before = copiesOfOutputs();
  messages.takeWarnings();
  change(*mesher);
  expectAsFresh({given, change});
  if (command != "SetMemoryLimit") // which changes nothing unless it refuses
  {
    EXPECT_FALSE(isAs(before)) << "the change does not matter here, so that this tests nothing";
  }
}

INSTANTIATE_TEST_SUITE_P(Properties, EveryChange, ::testing::ValuesIn(allChanges()),
                         [](const auto& tested) { return tested.param.command; });

/// The commands of the properties in a part of a file.
void addCommands(const char* file, const std::string& begin, const std::string& end, std::set<std::string>& commands)
{
  std::string part = atria::testing::bytesOf(std::filesystem::path(ATRIA_PLUGIN_DIR) / file);
  part = part.substr(part.find(begin));
  part = part.substr(0, part.find(end));
  const std::regex command("<\\w+VectorProperty[^>]* command=\"((?:Set|Add)\\w+)\"");
  for (std::sregex_iterator i(part.begin(), part.end(), command); i != std::sregex_iterator(); ++i)
  {
    commands.insert((*i)[1]);
  }
}

TEST(StageCache, EveryPropertyIsAmongTheChanges)
{
  std::set<std::string> properties;
  addCommands("AtriaGrid.xml", "<Proxy", "</Proxy>", properties);
  addCommands("AtriaMeshing.xml", "name=\"AtriaDualMesher\"", "</SourceProxy>", properties);
  EXPECT_EQ(properties.erase("SetCacheStages"), 1u);
  EXPECT_EQ(properties.erase("SetDistributeOutput"), 1u); // which changes nothing on one rank
  std::set<std::string> changed;
  for (const Change& change : allChanges())
  {
    changed.insert(change.command);
  }
  EXPECT_EQ(changed, properties);
}

TEST_F(StageCacheTest, ChangesInARowGiveWhatAFreshFilterDoes)
{
  std::mt19937 random(11);
  std::vector<Change> changes = allChanges();
  std::erase_if(changes, [](const Change& c) {
    // with others these ask for what cannot be, or leave less to be seen of others
    return c.command == "SetMaxElements" || c.command == "AddDomainCorner" || c.command == "SetSiteName" ||
           c.command == "SetTerrainName" || c.command == "SetWindAngle" || c.command == "SetSmallPartSize" ||
           c.command == "SetGapTolerance" || c.command == "SetGroundSnapRatio";
  });
  std::shuffle(changes.begin(), changes.end(), random);
  if (!atria::testing::isFullCampaign())
  {
    changes.erase(changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2), changes.end()); // ever slower ones
  }
  // last, as the meshes after it are much larger
  std::stable_partition(changes.begin(), changes.end(), [](const Change& c) { return c.command != "SetElementType"; });
  std::vector<Set> sets;
  mesher->Update();
  messages.takeWarnings();
  for (const Change& change : changes)
  {
    SCOPED_TRACE(change.command);
    change.given(*mesher);
    change.change(*mesher);
    sets.push_back(change.given);
    sets.push_back(change.change);
    mesher->Modified(); // an earlier change may have set the same value, and warnings are those of a run
    expectAsFresh(sets);
  }
}

TEST_F(StageCacheTest, TakesStagesThatDoNotDependOnTheChange)
{
  mesher->Update();
  EXPECT_THAT(stages(), all);
  mesher->Modified();
  mesher->Update();
  EXPECT_THAT(stages(), afterLayers);
  for (const Change& change : changesOfMesh())
  {
    SCOPED_TRACE(change.command);
    change.given(*mesher);
    mesher->Update();
    change.change(*mesher);
    mesher->Update();
    EXPECT_THAT(stages(), change.command == "SetCrackTolerance" ? afterCrossings
                          : change.command.find("Seed") < std::string::npos || change.command == "SetZoneRule"
                              ? afterZones
                              : afterLayers);
  }
  mesher->SetFeatureAngle(40.0);
  mesher->Update();
  EXPECT_THAT(stages(), all);
  messages.takeWarnings();
}

TEST_F(StageCacheTest, AnInputThatChangedIsMeshedAnew)
{
  mesher->Update();
  TriangleSurface other = scene();
  other.points[0][2] -= 0.01;
  input = atria::testing::toPolyData(other);
  mesher->SetInputDataObject(input);
  expectAsFresh({});
  EXPECT_THAT(stages(), all);
  other.names.back() = "Pole";
  input = atria::testing::toPolyData(other);
  mesher->SetInputDataObject(input);
  expectAsFresh({});
  EXPECT_THAT(stages(), all);
}

TEST_F(StageCacheTest, AnInputThatIsTheSameAgainIsNot)
{
  mesher->Update();
  mesher->SetInputDataObject(atria::testing::toPolyData(scene()));
  mesher->Update();
  EXPECT_THAT(stages(), afterLayers);
  expectAsFresh({});
}

TEST_F(StageCacheTest, OctreesAreToldApart)
{
  vtkNew<vtkAtriaOctreeSource> source;
  source->SetInputDataObject(input);
  const Set connect = [&](vtkAtriaDualMesher& m) { m.SetInputConnection(1, source->GetOutputPort()); };
  atria::testing::setGrid(source, domain, 0.5, 0.5, 1.0);
  mesher->Update();
  connect(*mesher);
  expectAsFresh({connect});
  EXPECT_THAT(stages(), all);
  mesher->SetNumberOfLayers(2);
  expectAsFresh({connect, [](vtkAtriaDualMesher& m) { m.SetNumberOfLayers(2); }});
  EXPECT_THAT(stages(), afterLayers);
  mesher->SetNumberOfLayers(1);
  atria::testing::setGrid(source, domain, 0.5, 1.0, 1.0);
  expectAsFresh({connect});
  EXPECT_THAT(stages(), all);
  mesher->RemoveAllInputConnections(1);
  expectAsFresh({});
  EXPECT_THAT(stages(), all);
}

TEST_F(StageCacheTest, WhatAnAbortedRunFinishedIsTaken)
{
  {
    const ProgressWatch watch(mesher, [](double, const std::string& text) { return text == "Growing layers"; });
    mesher->Update();
    expectEmpty();
  }
  mesher->Modified();
  expectAsFresh({});
  EXPECT_THAT(stages(), afterLayers);
}

TEST_F(StageCacheTest, AFailedRunLeavesNothingThatIsWrong)
{
  mesher->Update();
  mesher->SetSizeMid(0.1);
  mesher->Update();
  EXPECT_THAT(messages.takeErrors(), Not(::testing::IsEmpty()));
  mesher->SetSizeMid(1.0);
  expectAsFresh({});
  mesher->SetZoneRuleToSeeds();
  mesher->AddSeed(0, 0, 500);
  mesher->Update();
  EXPECT_THAT(messages.takeErrors(), Not(::testing::IsEmpty()));
  mesher->SetZoneRuleToOutside();
  expectAsFresh({});
}

TEST_F(StageCacheTest, OffKeepsNothing)
{
  mesher->Update();
  const vtkMTimeType time = mesher->GetMTime();
  mesher->CacheStagesOff();
  EXPECT_EQ(mesher->GetMTime(), time);
  mesher->CacheStagesOn();
  for (const bool cache : {true, false, false})
  {
    mesher->SetCacheStages(cache);
    mesher->Modified();
    expectAsFresh({});
    EXPECT_THAT(stages(), all);
  }
}

} // namespace
