// SPDX-License-Identifier: GPL-3.0-or-later
/// The dual mesher as a filter: inputs, repetition, threads, abort and errors.
#include "DualMesherTest.h"
#include "SmpExecutor.h"
#include "SmpThreads.h"
#include "Support/ProgressWatch.h"
#include "vtkAtriaOctreeSource.h"

#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkStringArray.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <thread>

namespace {

using atria::Box3;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::beyond;
using atria::testing::ProgressWatch;
using ::testing::HasSubstr;

/// A building with a canopy whose boundary edge ends in the open, next to a dome, on a ground.
TriangleSurface scene()
{
  TriangleSurface surface;
  atria::testing::addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
  atria::testing::addSheet(surface, "Canopy", Vec3(-1.7, -3.2, 2.1), Vec3(2.8, 0, 0), Vec3(0, 1.3, 0));
  atria::testing::addSphere(surface, "Dome", Vec3(4.1, 1.3, 2.2), 1.4, 3);
  atria::testing::addSheet(surface, "Ground", Vec3(-5, -4, 0), Vec3(12, 0, 0), Vec3(0, 9, 0));
  return surface;
}

class DualMesherRuns : public atria::testing::DualMesherTest
{
protected:
  DualMesherRuns()
  {
    setSurface(scene());
    mesher->CacheStagesOff(); // runs are whole here; TestStageCache has those that are not
  }

  void expectError(const ::testing::Matcher<const std::string&>& message)
  {
    mesher->Update();
    expectEmpty();
    const std::vector<std::string> errors = messages.takeErrors();
    EXPECT_THAT(atria::testing::firstOf(errors), message);
    EXPECT_LE(errors.size(), 2u); // the second is the executive's
  }
};

TEST_F(DualMesherRuns, AnOctreeOfTheSameSizesGivesTheSameMesh)
{
  const auto own = copiesOfOutputs();
  vtkNew<vtkAtriaOctreeSource> source;
  atria::testing::setGrid(source, domain, 0.5, 1.0, 2.0);
  source->SetInputDataObject(atria::testing::toPolyData(scene()));
  mesher->SetInputConnection(1, source->GetOutputPort());
  // Sizes and domain are the octree's.
  atria::testing::setGrid(mesher, {Vec3::Zero(), Vec3::Ones()}, 8, 8, 8);
  for (const int type : {vtkAtriaOctreeSource::UnstructuredGrid, vtkAtriaOctreeSource::HyperTreeGrid})
  {
    SCOPED_TRACE(type);
    source->SetOutputType(type);
    expectOutputs(own);
  }
}

TEST_F(DualMesherRuns, AnOctreeWithSizesOfItsOwnGivesTheSameMeshAsThoseSizes)
{
  vtkNew<vtkAtriaOctreeSource> source;
  atria::testing::setGrid(source, domain, 0.5, 1.0, 2.0);
  source->SetInputDataObject(atria::testing::toPolyData(scene()));
  for (vtkAtriaGridAlgorithm* filter :
       {static_cast<vtkAtriaGridAlgorithm*>(source), static_cast<vtkAtriaGridAlgorithm*>(mesher)})
  {
    filter->AddSurfaceSizeRule("*", 0.5, 0.25);
    filter->SetCellsPerLevel(2);
  }
  const auto own = copiesOfOutputs();
  mesher->RemoveAllSurfaceSizeRules();
  mesher->SetCellsPerLevel(1);
  mesher->SetInputConnection(1, source->GetOutputPort());
  mesher->Update();
  // Which sizes were requested of the octree is not known to the mesher.
  for (vtkDataObject* output : {own[2].Get(), mesher->GetOutputDataObject(2)})
  {
    output->GetFieldData()->RemoveArray("AuditRequestedSize");
  }
  expectOutputs(own);
}

TEST_F(DualMesherRuns, SizesOfZeroFollowFromTheModel)
{
  mesher->SetMaxElements(20000); // for few octants
  for (const std::array<double, 3>& sizes :
       {std::array{0.0, 0.0, 0.0}, {0.0, 0.0, 0.4}, {0.0, 0.8, 0.4}, {2.0, 0.0, 0.5}})
  {
    SCOPED_TRACE(sizes[1]);
    const auto set = [&] {
      mesher->SetSizeMax(sizes[0]);
      mesher->SetSizeMid(sizes[1]);
      mesher->SetSizeMin(sizes[2]);
    };
    set();
    const auto followed = copiesOfOutputs();
    EXPECT_GT(volume()->GetNumberOfCells(), 0);
    EXPECT_EQ(mesher->GetSizeMax(), sizes[0]) << "a property keeps its value";
    ASSERT_TRUE(mesher->CompleteSizes());
    EXPECT_GT(mesher->GetSizeMin(), 0.0);
    EXPECT_TRUE(sizes[2] == 0.0 || mesher->GetSizeMin() == sizes[2]);
    EXPECT_GE(mesher->GetSizeMax(), mesher->GetSizeMid());
    expectOutputs(followed);
    messages.takeWarnings();
  }
}

TEST_F(DualMesherRuns, MaxElementsIsKeptToAndSaid)
{
  mesher->AddSurfaceSizeRule("*", 0.25, 0.125);
  mesher->Update();
  const int limit = static_cast<int>(volume()->GetNumberOfCells() / 2);
  mesher->SetMaxElements(limit);
  mesher->Update();
  EXPECT_LE(volume()->GetNumberOfCells(), limit);
  EXPECT_GT(volume()->GetNumberOfCells(), 0);
  auto* texts = vtkStringArray::SafeDownCast(diagnostics()->GetFieldData()->GetAbstractArray("SizingWarning"));
  ASSERT_NE(texts, nullptr);
  ASSERT_EQ(texts->GetNumberOfValues(), 1);
  const std::string said = "MaxElements " + std::to_string(limit);
  EXPECT_THAT(texts->GetValue(0), HasSubstr(said));
  EXPECT_THAT(messages.takeWarnings(), ::testing::ElementsAre(HasSubstr(said)));
}

TEST_F(DualMesherRuns, GivesTheSameTwice)
{
  const auto first = copiesOfOutputs();
  mesher->Modified();
  expectOutputs(first);
}

TEST_F(DualMesherRuns, GivesTheSameWithAnyNumberOfThreads)
{
  atria::testing::setGrid(mesher, domain, 0.2, 0.4, 0.8);
  atria::testing::useThreads(1);
  const auto serial = copiesOfOutputs();
  for (const int threads : {2, 7})
  {
    SCOPED_TRACE(threads);
    atria::testing::useThreads(threads);
    mesher->Modified();
    expectOutputs(serial);
  }
}

TEST_F(DualMesherRuns, GivesTheSameWithEveryBackendOfVTK)
{
  const auto wanted = copiesOfOutputs();
  for (const char* name : {"Sequential", "STDThread", "TBB"}) // one that VTK lacks is not set
  {
    SCOPED_TRACE(name);
    const atria::testing::SmpBackend backend(name);
    mesher->Modified();
    expectOutputs(wanted);
  }
}

TEST(SmpExecutor, UsesAllCoresWhereSequentialIsNobodysChoice)
{
  if (std::getenv("VTK_SMP_BACKEND_IN_USE"))
  {
    GTEST_SKIP() << "a backend was chosen";
  }
  const atria::testing::SmpBackend backend("Sequential"); // ParaView's default
  EXPECT_EQ(atria::SmpExecutor().threads(), static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

TEST_F(DualMesherRuns, NamedBlocksAreTheSameAsNamedCells)
{
  const auto cells = copiesOfOutputs();
  mesher->SetInputDataObject(atria::testing::toBlocks(scene()));
  expectOutputs(cells);
}

TEST_F(DualMesherRuns, TheInputIsNotModified)
{
  const auto input = atria::testing::toPolyData(scene());
  vtkNew<vtkPolyData> before;
  before->DeepCopy(input);
  const vtkMTimeType time = input->GetMTime();
  mesher->SetInputDataObject(input);
  mesher->Update();
  EXPECT_EQ(input->GetMTime(), time);
  EXPECT_TRUE(atria::testing::identical(before, input));
}

TEST_F(DualMesherRuns, AbortLeavesNothingAndTheNextRunIsWhole)
{
  const auto whole = copiesOfOutputs();
  for (const double when : {0.1, 0.5, 0.8})
  {
    SCOPED_TRACE(when);
    {
      const ProgressWatch watch(mesher, beyond(when));
      mesher->Modified();
      mesher->Update();
      expectEmpty();
    }
    mesher->Modified();
    expectOutputs(whole);
  }
}

TEST_F(DualMesherRuns, ProgressRisesToOneWithText)
{
  const ProgressWatch seen(mesher);
  mesher->Update();
  EXPECT_TRUE(std::is_sorted(seen.fractions.begin(), seen.fractions.end()));
  ASSERT_FALSE(seen.fractions.empty());
  EXPECT_EQ(seen.fractions.back(), 1.0);
  EXPECT_THAT(seen.texts, ::testing::Contains("Finding grid points"));
}

TEST_F(DualMesherRuns, SeedsAreAList)
{
  mesher->SetSeed(1, 4, 5, 6);
  ASSERT_EQ(mesher->GetNumberOfSeeds(), 2);
  double seed[3];
  mesher->GetSeed(1, seed);
  EXPECT_EQ(Vec3(seed), Vec3(4, 5, 6));
  mesher->RemoveAllSeeds();
  EXPECT_EQ(mesher->GetNumberOfSeeds(), 0);
  mesher->SetSeed(-1, 0, 0, 0);
  mesher->GetSeed(0, seed);
  EXPECT_THAT(messages.takeErrors(), ::testing::Each(HasSubstr("There is no seed")));
}

TEST_F(DualMesherRuns, PrintsItsSettings)
{
  mesher->AddSeed(1, 2, 3);
  std::ostringstream text;
  mesher->Print(text);
  for (const char* part :
       {"SizeMin: 0.5", "FeatureAngle: 30", "ZoneRule: 0", "NumberOfSeeds: 1", "1 2 3", "SiteName: Site"})
  {
    EXPECT_THAT(text.str(), HasSubstr(part));
  }
}

using DualMesherError = DualMesherRuns;

TEST_F(DualMesherError, SeedOutsideTheDomain)
{
  mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
  mesher->AddSeed(0, 0, 5);
  mesher->AddSeed(0, 0, 50);
  expectError(::testing::AllOf(HasSubstr("seed"), HasSubstr("domain"), HasSubstr("50")));
}

TEST_F(DualMesherError, SeedsWithoutSeeds)
{
  mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
  expectError(HasSubstr("seed"));
}

TEST_F(DualMesherError, AGridThatIsNoOctree)
{
  mesher->SetInputDataObject(1, vtkNew<vtkUnstructuredGrid>());
  expectError(HasSubstr("OctreeFrame"));
}

TEST_F(DualMesherError, SizesInTheWrongOrder)
{
  mesher->SetSizeMid(0.1);
  expectError(HasSubstr("SizeMin"));
}

TEST_F(DualMesherError, SizesThatAreNotPositiveOrNoNumbers)
{
  const auto whole = copiesOfOutputs();
  mesher->SetSizeMin(-5.0);
  expectError(HasSubstr("SizeMin is -5; it must be a number of at least 0"));
  EXPECT_EQ(mesher->GetSizeMin(), -5.0);
  mesher->SetSizeMin(0.5);
  mesher->SetSizeMid(-0.5);
  expectError(HasSubstr("SizeMid is -0.5;"));
  mesher->SetSizeMid(1.0);
  mesher->SetSizeMax(std::numeric_limits<double>::quiet_NaN());
  expectError(HasSubstr("SizeMax is nan;"));
  mesher->SetSizeMax(std::numeric_limits<double>::infinity());
  expectError(HasSubstr("SizeMax is inf;"));
  mesher->SetSizeMax(2.0);
  mesher->SetLayerGrowth(100.0);
  expectError(HasSubstr("LayerGrowth is 100; it must be a number from 0.5 to 5"));
  mesher->SetLayerGrowth(1.2);
  mesher->SetZoneRule(7);
  expectError(HasSubstr("ZoneRule is 7;"));
  mesher->SetZoneRule(vtkAtriaDualMesher::Outside);
  expectOutputs(whole);
}

TEST_F(DualMesherError, ARefinementBoxThatIsInsideOut)
{
  mesher->AddRefinementBox(1, -1, 0, 1, 0, 1, 0.5);
  expectError(HasSubstr("refinement box 1 is empty"));
}

TEST_F(DualMesherError, UnknownSiteNamesThoseThereAre)
{
  mesher->SetDomainMode(vtkAtriaDualMesher::Site);
  expectError(::testing::AllOf(HasSubstr("'Site'"), HasSubstr("Building, Canopy, Dome, Ground")));
}

TEST_F(DualMesherError, AFailedRunAfterAGoodOneLeavesNothingAndTheNextIsWhole)
{
  const auto whole = copiesOfOutputs();
  mesher->SetSizeMid(0.1);
  expectError(HasSubstr("SizeMin"));
  mesher->SetSizeMid(1.0);
  expectOutputs(whole);
}

} // namespace
