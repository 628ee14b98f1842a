// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshOutput.h"
#include "OctreeLeaves.h"
#include "Support/ProgressWatch.h"
#include "Support/Shapes.h"
#include "Support/VtkErrorGuard.h"
#include "SurfaceInput.h"
#include "vtkAtriaOctreeSource.h"

#include <vtkHyperTreeGrid.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace {

using atria::Box3;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::beyond;
using atria::testing::LeafMap;
using atria::testing::leavesOf;
using atria::testing::OctreeLeaf;
using atria::testing::ProgressWatch;
using atria::testing::toPolyData;
using ::testing::AllOf;
using ::testing::HasSubstr;

const Box3 domain{Vec3(-10, -9, 0), Vec3(12, 9, 14)};
const Box3 building{Vec3(-6.2, -4.1, 1.3), Vec3(-1.7, 3.3, 6.9)};
const Vec3 domeCenter(5.1, 0.3, 6.2);
constexpr double domeRadius = 2.6;
constexpr double sizeMin = 0.5;
constexpr double sizeMid = 1.0;
constexpr double sizeMax = 4.0;

TriangleSurface buildingAndDome()
{
  TriangleSurface surface;
  atria::testing::addBox(surface, "Building", building);
  atria::testing::addSphere(surface, "Dome", domeCenter, domeRadius, 3);
  return surface;
}

class OctreeSource : public atria::testing::VtkTest
{
protected:
  OctreeSource()
  {
    atria::testing::setGrid(source, domain, sizeMin, sizeMid, sizeMax);
    source->SetStartLevel(2);
  }

  std::vector<OctreeLeaf> leaves()
  {
    source->Update();
    return leavesOf(source->GetOutputDataObject(0));
  }

  vtkSmartPointer<vtkDataObject> copyOfOutput()
  {
    source->Update();
    vtkDataObject* output = source->GetOutputDataObject(0);
    auto copy = vtkSmartPointer<vtkDataObject>::Take(output->NewInstance());
    copy->DeepCopy(output);
    return copy;
  }

  /// The run fails with one message of the filter's own, and leaves nothing.
  void expectError(const ::testing::Matcher<const std::string&>& message)
  {
    EXPECT_TRUE(leaves().empty());
    EXPECT_EQ(source->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 0);
    const std::vector<std::string> errors = messages.takeErrors();
    EXPECT_THAT(atria::testing::firstOf(errors), message);
    EXPECT_LE(errors.size(), 2u); // the second is the executive's
  }

  vtkNew<vtkAtriaOctreeSource> source;
};

/// The leaves a point lies in or on.
std::vector<OctreeLeaf> leavesAt(const std::vector<OctreeLeaf>& leaves, const Vec3& p)
{
  std::vector<OctreeLeaf> found;
  std::copy_if(leaves.begin(), leaves.end(), std::back_inserter(found),
               [&](const auto& leaf) { return leaf.touches(p); });
  return found;
}

TEST_F(OctreeSource, LeavesTileTheDomainAndAreBalanced)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  const std::vector<OctreeLeaf> all = leaves();
  ASSERT_FALSE(all.empty());
  const LeafMap map(all);
  EXPECT_TRUE(map.tiles(domain));
  EXPECT_TRUE(map.isBalanced());
}

TEST_F(OctreeSource, LeavesOfRandomSurfacesTileTheDomainAndAreBalanced)
{
  const Box3 cube{Vec3::Constant(-4.3), Vec3::Constant(4.1)};
  atria::testing::setGrid(source, cube, 0.2, 0.4, 1.6);
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    SCOPED_TRACE(seed);
    source->SetInputDataObject(toPolyData(atria::testing::randomSoup(seed)));
    const std::vector<OctreeLeaf> all = leaves();
    messages.takeWarnings(atria::testing::cutAtSides);
    messages.takeWarnings(atria::testing::endAtSides);
    ASSERT_FALSE(all.empty());
    const LeafMap map(all);
    EXPECT_TRUE(map.tiles(cube));
    EXPECT_TRUE(map.isBalanced());
  }
}

TEST_F(OctreeSource, LevelsAreHalvesOfTheRoot)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  const std::vector<OctreeLeaf> all = leaves();
  const double root = all.front().edge() * (1 << all.front().level);
  for (const OctreeLeaf& leaf : all)
  {
    EXPECT_NEAR(leaf.edge() * (1 << leaf.level), root, 1e-9);
    EXPECT_NEAR(leaf.box.size().minCoeff(), leaf.box.size().maxCoeff(), 1e-12);
  }
}

TEST_F(OctreeSource, OpenOctantsHaveSizeMaxAndTheFinestSizeMinExactly)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  double finest = sizeMax;
  double coarsest = 0.0;
  for (const OctreeLeaf& leaf : leaves())
  {
    finest = std::min(finest, leaf.edge());
    coarsest = std::max(coarsest, leaf.edge());
    EXPECT_LE(leaf.featureType, 4);
  }
  EXPECT_NEAR(finest, sizeMin, 1e-12);
  EXPECT_NEAR(coarsest, sizeMax, 1e-12);
}

TEST_F(OctreeSource, OddSizesAreExactToo)
{
  atria::testing::setGrid(source, domain, 0.37, 0.74, 2.96);
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  double finest = sizeMax;
  for (const OctreeLeaf& leaf : leaves())
  {
    finest = std::min(finest, leaf.edge());
  }
  EXPECT_NEAR(finest, 0.37, 1e-12);
}

TEST_F(OctreeSource, OctantsOnASurfaceHaveAtMostSizeMid)
{
  const TriangleSurface surface = buildingAndDome();
  source->SetInputDataObject(toPolyData(surface));
  const std::vector<OctreeLeaf> all = leaves();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.05, 0.45);
  for (std::size_t i = 0; i < surface.triangles.size(); i += 3)
  {
    const double u = unit(random);
    const double v = unit(random);
    const auto& [a, b, c] = surface.triangles[i];
    const auto found = leavesAt(all, u * surface.points[a] + v * surface.points[b] + (1 - u - v) * surface.points[c]);
    ASSERT_FALSE(found.empty());
    for (const OctreeLeaf& leaf : found)
    {
      EXPECT_LE(leaf.edge(), sizeMid + 1e-12);
      EXPECT_GE(leaf.featureType, 1);
    }
  }
}

TEST_F(OctreeSource, OctantsOnFeatureCurvesHaveSizeMin)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  const std::vector<OctreeLeaf> all = leaves();
  const auto corner = [](int bits) {
    return Vec3(bits & 1 ? building.max[0] : building.min[0], bits & 2 ? building.max[1] : building.min[1],
                bits & 4 ? building.max[2] : building.min[2]);
  };
  for (int from = 0; from < 8; ++from)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double t : {0.0, 0.13, 0.37, 0.5, 0.88})
      {
        for (const OctreeLeaf& leaf : leavesAt(all, (1 - t) * corner(from) + t * corner(from ^ 1 << axis)))
        {
          EXPECT_NEAR(leaf.edge(), sizeMin, 1e-12);
          EXPECT_GE(leaf.featureType, t == 0.0 ? 3 : 2);
        }
      }
    }
  }
}

TEST_F(OctreeSource, SheetsThatDoNotMeetAreToldApartDownToSizeMin)
{
  TriangleSurface surface;
  atria::testing::addSheet(surface, "A", Vec3(-20, -20, 7.0), Vec3(40, 0, 0), Vec3(0, 40, 0));
  atria::testing::addSheet(surface, "B", Vec3(-20, -20, 7.1), Vec3(40, 0, 0), Vec3(0, 40, 0));
  source->SetInputDataObject(toPolyData(surface));
  const auto found = leavesAt(leaves(), Vec3(0.3, 0.3, 7.05));
  EXPECT_EQ(messages.takeWarnings(atria::testing::cutAtSides).size(), 1u);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().featureType, 4);
  EXPECT_NEAR(found.front().edge(), sizeMin, 1e-12);
}

TEST_F(OctreeSource, BothOutputTypesHaveTheSameLeaves)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  const std::vector<OctreeLeaf> voxels = leaves();
  source->SetOutputType(vtkAtriaOctreeSource::HyperTreeGrid);
  const std::vector<OctreeLeaf> trees = leaves();
  ASSERT_NE(vtkHyperTreeGrid::SafeDownCast(source->GetOutputDataObject(0)), nullptr);
  ASSERT_EQ(voxels.size(), trees.size());
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    EXPECT_LT((voxels[i].box.min - trees[i].box.min).norm() + (voxels[i].box.max - trees[i].box.max).norm(), 1e-9);
    EXPECT_EQ(voxels[i].level, trees[i].level);
    EXPECT_EQ(voxels[i].featureType, trees[i].featureType);
  }
}

TEST_F(OctreeSource, WithoutSurfacesAnExplicitDomainIsUniform)
{
  const std::vector<OctreeLeaf> all = leaves();
  ASSERT_FALSE(all.empty());
  for (const OctreeLeaf& leaf : all)
  {
    EXPECT_NEAR(leaf.edge(), sizeMax, 1e-12);
    EXPECT_EQ(leaf.featureType, 0);
  }
  EXPECT_TRUE(LeafMap(all).tiles(domain));
}

TEST_F(OctreeSource, StartLevelIsReachedEverywhere)
{
  source->SetStartLevel(5);
  for (const OctreeLeaf& leaf : leaves())
  {
    EXPECT_EQ(leaf.level, 5);
  }
}

TEST_F(OctreeSource, TheDomainCanBeTheBoundsOfTheSurfacesOrASite)
{
  TriangleSurface surface = buildingAndDome();
  atria::testing::addSheet(surface, "Site", Vec3(-10, -9, 1), Vec3(22, 0, 0), Vec3(0, 18, 0));
  source->SetInputDataObject(toPolyData(surface));
  source->SetDomainMode(vtkAtriaOctreeSource::FromSurfaces);
  EXPECT_TRUE(LeafMap(leaves()).tiles({Vec3(-10, -9, 1), Vec3(12, 9, domeCenter[2] + domeRadius)}));
  source->SetDomainMode(vtkAtriaOctreeSource::Site);
  EXPECT_TRUE(LeafMap(leaves()).tiles({Vec3(-10, -9, 1), Vec3(12, 9, 1 + 0.3 * 22)}));
  const auto warnings = messages.takeWarnings(atria::testing::cutAtSides);
  EXPECT_THAT(atria::testing::firstOf(warnings), HasSubstr("zMax ('Dome')"));
  EXPECT_EQ(atria::testing::fieldStrings(source->GetOutputDataObject(0), "InputWarning").size(), 1u);
}

TEST_F(OctreeSource, TheInputIsNotModified)
{
  const auto input = toPolyData(buildingAndDome());
  vtkNew<vtkPolyData> before;
  before->DeepCopy(input);
  const vtkMTimeType time = input->GetMTime();
  source->SetInputDataObject(input);
  source->Update();
  EXPECT_EQ(input->GetMTime(), time);
  EXPECT_TRUE(atria::testing::identical(before, input));
}

TEST_F(OctreeSource, GivesTheSameTwice)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  for (const int type : {vtkAtriaOctreeSource::UnstructuredGrid, vtkAtriaOctreeSource::HyperTreeGrid})
  {
    source->SetOutputType(type);
    const auto first = copyOfOutput();
    source->Modified();
    EXPECT_TRUE(atria::testing::identical(first, copyOfOutput()));
  }
}

TEST_F(OctreeSource, NamedBlocksAreTheSameAsNamedCells)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  const auto cells = copyOfOutput();
  source->SetInputDataObject(atria::testing::toBlocks(buildingAndDome()));
  EXPECT_TRUE(atria::testing::identical(cells, copyOfOutput()));
}

TEST_F(OctreeSource, AbortLeavesNothingAndTheNextRunIsWhole)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  const auto whole = copyOfOutput();
  {
    const ProgressWatch watch(source, beyond(0.2));
    source->Modified();
    EXPECT_TRUE(leaves().empty());
    EXPECT_EQ(vtkUnstructuredGrid::SafeDownCast(source->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
  }
  source->Modified();
  EXPECT_TRUE(atria::testing::identical(whole, copyOfOutput()));
}

TEST_F(OctreeSource, ProgressRisesToOne)
{
  const ProgressWatch watch(source);
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  source->Update();
  const std::vector<double>& seen = watch.fractions;
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GT(seen.size(), 3u);
  EXPECT_EQ(seen.back(), 1.0);
}

/// Largest leaf among those that touch points of a surface's triangles.
double coarsestOn(const std::vector<OctreeLeaf>& leaves, const TriangleSurface& surface, atria::Index id)
{
  double coarsest = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (const atria::Index p : surface.triangles[t])
    {
      if (surface.surfaceIds[t] == id)
      {
        for (const OctreeLeaf& leaf : leavesAt(leaves, surface.points[p]))
        {
          coarsest = std::max(coarsest, leaf.edge());
        }
      }
    }
  }
  return coarsest;
}

TEST_F(OctreeSource, RulesAsCallsAndAsTextAreTheSame)
{
  const TriangleSurface surface = buildingAndDome();
  source->SetInputDataObject(toPolyData(surface));
  source->AddSurfaceSizeRule("Do*", 0.25, 0.25);
  source->AddDistanceSizeRule("Building", 1.0, 1.0);
  source->AddDistanceSizeRule("Building", 2.0, 2.0);
  source->AddRefinementBox(-1, 1, -1, 1, 1, 2, 0.5);
  const std::vector<OctreeLeaf> all = leaves();
  EXPECT_NEAR(coarsestOn(all, surface, 1), 0.25, 1e-12);
  EXPECT_NEAR(coarsestOn(all, surface, 0), sizeMin, 1e-12);
  EXPECT_TRUE(LeafMap(all).tiles(domain));
  EXPECT_TRUE(LeafMap(all).isBalanced());
  const auto calls = copyOfOutput();
  source->RemoveAllSurfaceSizeRules();
  source->RemoveAllDistanceSizeRules();
  source->RemoveAllRefinementBoxes();
  EXPECT_EQ(source->GetNumberOfSurfaceSizeRules() + source->GetNumberOfDistanceSizeRules() +
                source->GetNumberOfRefinementBoxes(),
            0);
  source->AddSurfaceSizeRule("Do* 0.25 0.25");
  source->AddDistanceSizeRule("\"Building\" 1 1 2 2");
  const double box[6] = {-1, 1, -1, 1, 1, 2};
  source->AddRefinementBox(box, 0.5);
  EXPECT_TRUE(atria::testing::identical(calls, copyOfOutput()));
}

TEST_F(OctreeSource, EstimateCountsTheLeavesOfTheOutput)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  source->AddSurfaceSizeRule("Dome", 0.25);
  source->SetCellsPerLevel(3);
  source->SetCellsAcrossGap(2);
  source->SetCurvatureAngle(30);
  ASSERT_TRUE(source->Estimate());
  std::vector<vtkIdType> counts(source->GetNumberOfEstimatedLevels(), 0);
  for (const OctreeLeaf& leaf : leaves())
  {
    ++counts.at(leaf.level);
    EXPECT_NEAR(source->GetEstimatedOctantSize(leaf.level), leaf.edge(), 1e-12);
  }
  for (int level = 0; level < source->GetNumberOfEstimatedLevels(); ++level)
  {
    EXPECT_EQ(source->GetEstimatedOctants(level), counts[level]);
  }
  EXPECT_GT(source->GetEstimatedElements(), 0);
  EXPECT_GT(source->GetEstimatedBytes(), 100 * source->GetEstimatedElements());
  EXPECT_TRUE(source->GetEstimateWarning().empty());
}

using OctreeSourceError = OctreeSource;

TEST_F(OctreeSourceError, SizesThatDoNotFitTheMemory)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  source->SetSizeMin(1e-4);
  source->SetSizeMid(1e-4);
  expectError(AllOf(HasSubstr("GB"), HasSubstr("SizeMin and SizeMid"), HasSubstr("MemoryLimit")));
  ASSERT_TRUE(source->Estimate());
  EXPECT_TRUE(source->GetEstimateIsTooLarge());
  EXPECT_GT(source->GetEstimatedElements(), 1'000'000'000);
  EXPECT_GT(source->GetEstimatedBytes(), 100 * source->GetEstimatedElements());
  EXPECT_THAT(source->GetEstimateWarning(), HasSubstr("MemoryLimit"));
  // The limit is the user's to state.
  source->SetSizeMin(0.25);
  source->SetSizeMid(0.5);
  source->SetMemoryLimit(0.001);
  expectError(HasSubstr("there are 0.001 GB"));
  source->SetMemoryLimit(1.0);
  EXPECT_FALSE(leaves().empty());
  ASSERT_TRUE(source->Estimate());
  EXPECT_FALSE(source->GetEstimateIsTooLarge());
}

TEST_F(OctreeSourceError, SizeRulesThatAreNone)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  source->AddSurfaceSizeRule("Building");
  expectError(AllOf(HasSubstr("'Building'"), HasSubstr("PATTERN SIZE")));
  EXPECT_FALSE(source->Estimate());
  EXPECT_FALSE(messages.takeErrors().empty());
  source->RemoveAllSurfaceSizeRules();
  source->AddDistanceSizeRule("Garden* 1 1");
  expectError(AllOf(HasSubstr("'Garden*'"), HasSubstr("Building, Dome")));
}

TEST_F(OctreeSourceError, NoSurfacesToTakeTheDomainFrom)
{
  source->SetDomainMode(vtkAtriaOctreeSource::FromSurfaces);
  expectError(AllOf(HasSubstr("no surfaces"), HasSubstr("DomainBounds")));
  source->SetInputDataObject(vtkNew<vtkPolyData>());
  expectError(HasSubstr("no surfaces"));
}

TEST_F(OctreeSourceError, UnknownSiteNamesThoseThereAre)
{
  source->SetInputDataObject(toPolyData(buildingAndDome()));
  source->SetDomainMode(vtkAtriaOctreeSource::Site);
  source->SetSiteName("Garden");
  expectError(AllOf(HasSubstr("'Garden'"), HasSubstr("Building, Dome")));
}

TEST_F(OctreeSourceError, SizesInTheWrongOrder)
{
  source->SetSizeMin(3.0);
  expectError(AllOf(HasSubstr("SizeMin"), HasSubstr("SizeMid"), HasSubstr("3, 1, 4")));
}

TEST_F(OctreeSourceError, InvertedBounds)
{
  source->SetDomainBounds(1, 0, 0, 10, 0, 10);
  expectError(AllOf(HasSubstr("domain"), HasSubstr("min < max")));
}

TEST_F(OctreeSourceError, PointThatIsNotFinite)
{
  TriangleSurface surface = buildingAndDome();
  surface.points[3][1] = std::numeric_limits<double>::quiet_NaN();
  source->SetInputDataObject(toPolyData(surface));
  expectError(HasSubstr("not finite"));
}

TEST_F(OctreeSourceError, DomainFarLargerThanTheFinestOctant)
{
  source->SetSizeMin(1e-7);
  expectError(AllOf(HasSubstr("SizeMin"), HasSubstr("domain")));
}

TEST_F(OctreeSourceError, HyperTreeGridIsEmptyToo)
{
  source->SetOutputType(vtkAtriaOctreeSource::HyperTreeGrid);
  source->Update();
  source->SetSizeMin(3.0);
  expectError(HasSubstr("SizeMin"));
}

TEST_F(OctreeSourceError, TheFilterWorksAgainOnceTheCauseIsGone)
{
  source->SetSizeMin(3.0);
  expectError(HasSubstr("SizeMin"));
  source->SetSizeMin(sizeMin);
  EXPECT_FALSE(leaves().empty());
}

} // namespace
