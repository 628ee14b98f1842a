// SPDX-License-Identifier: GPL-3.0-or-later
/// The example house on its site, aligned with the grid and turned by 17 degrees.
#include "DualMesherTest.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnsignedCharArray.h>

#include <gmock/gmock.h>

#include <string>

namespace {

using atria::Vec3;
using ::testing::IsEmpty;

/// By construction of the model: 12 x 10, eaves at 6 and ridge at 9.
constexpr double volumeOfNeighbor = 12.0 * 10.0 * 7.5;
constexpr double volumeOfDomain = 227.0 * 182.0 * (0.3 * 227.0);

/// Surfaces with air on one side only; all others are sheets in the air, on both sides of which it is.
const std::vector<std::string> oneSided{"Floor", "Neighbor", "Site"};

struct Case
{
  const char* model;
  double sizeMid;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.model << ", SizeMid " << c.sizeMid; }

class House : public atria::testing::DualMesherTest, public ::testing::WithParamInterface<Case>
{
protected:
  House()
  {
    model = atria::testing::exampleModel(GetParam().model);
    mesher->SetInputDataObject(model);
    mesher->SetDomainMode(vtkAtriaDualMesher::Site);
    mesher->SetSizeMax(8.0);
    mesher->SetSizeMid(GetParam().sizeMid);
    mesher->SetSizeMin(1.0);
  }

  vtkSmartPointer<vtkPolyData> model;
};

TEST_P(House, IndoorsAndOutdoorsAreOneZoneThroughTheWindows)
{
  const auto outside = copiesOfOutputs();
  EXPECT_EQ(volume()->GetCellData()->GetArray("ZoneId")->GetRange()[1], 0.0);
  mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
  // In the rooms west, between and east of the partitions; the model turns about (12, 7).
  for (const double x : {9.5, 12.0, 20.5})
  {
    SCOPED_TRACE(x);
    mesher->RemoveAllSeeds();
    mesher->AddSeed(x, 7.0, 3.0);
    expectOutputs(outside);
  }
}

TEST_P(House, TheInsideOfTheNeighborIsDropped)
{
  mesher->Update();
  EXPECT_NEAR(volumeOfDomain - meshVolume(), volumeOfNeighbor, 0.05 * volumeOfNeighbor);
  EXPECT_EQ(namedPatches().at("Neighbor")->GetCellData()->GetArray("Side")->GetRange()[1], 0.0);
  EXPECT_NEAR(atria::testing::enclosedVolume(patches()), meshVolume(), 1e-9 * volumeOfDomain);
}

TEST_P(House, EverySurfaceIsAPatchAndHasTwoSidesInTheAir)
{
  mesher->Update();
  std::vector<std::string> wanted{"xMin", "xMax", "yMin", "yMax", "zMax"};
  for (const std::string& name : atria::testing::fieldStrings(model, "SurfaceName"))
  {
    if (::testing::Value(oneSided, ::testing::Contains(name)))
    {
      wanted.push_back(name);
    }
    else
    {
      wanted.insert(wanted.end(), {name + "_front", name + "_back"});
    }
  }
  EXPECT_GT(wanted.size(), 20u);
  EXPECT_THAT(atria::testing::namesOf(namedPatches()), ::testing::UnorderedElementsAreArray(wanted));
  EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "SurfaceWithoutFaces"), IsEmpty());
  EXPECT_TRUE(atria::testing::patchesAreTheBoundary(volume(), patches()));
}

TEST_P(House, SidesOfASheetHaveAboutTheSameArea)
{
  mesher->Update();
  const auto all = namedPatches();
  // Not exactly: where two sheets are closer than the octants, each gives the face on its side the name.
  constexpr double tolerance = 0.05;
  for (const auto& [name, patch] : all)
  {
    if (name.ends_with("_front"))
    {
      const double front = atria::testing::areaOf(patch);
      const double back = atria::testing::areaOf(all.at(name.substr(0, name.size() - 5) + "back"));
      EXPECT_NEAR(front, back, tolerance * front) << name;
    }
  }
}

TEST_P(House, FewElementsAreInvalidAndQualityCountsThem)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(mesher->GetOutputPort(0));
  quality->SetPatchesConnection(mesher->GetOutputPort(1));
  quality->Update();
  auto* valid = vtkUnsignedCharArray::SafeDownCast(quality->GetOutput()->GetCellData()->GetArray("Valid"));
  ASSERT_NE(valid, nullptr);
  vtkIdType invalid = 0;
  for (vtkIdType cell = 0; cell < valid->GetNumberOfValues(); ++cell)
  {
    invalid += valid->GetValue(cell) == 0 ? 1 : 0;
  }
  EXPECT_EQ(quality->GetNumberOfInvalidCells(), invalid);
  EXPECT_LT(static_cast<double>(invalid), 0.01 * static_cast<double>(volume()->GetNumberOfCells()));
  RecordProperty("InvalidElements", static_cast<int>(invalid));
  RecordProperty("Elements", static_cast<int>(volume()->GetNumberOfCells()));
}

INSTANTIATE_TEST_SUITE_P(AlignedAndTurned, House,
                         ::testing::Values(Case{"house.wrl", 2.0}, Case{"house.wrl", 1.0},
                                           Case{"house_turned17.wrl", 2.0}, Case{"house_turned17.wrl", 1.0}),
                         [](const auto& test) {
                           const std::string name = test.param.model;
                           return name.substr(0, name.find('.')) + "_SizeMid" +
                                  std::to_string(static_cast<int>(test.param.sizeMid));
                         });

} // namespace
