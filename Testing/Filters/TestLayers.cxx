// SPDX-License-Identifier: GPL-3.0-or-later
/// Layers of the mesher's output.
#include "DualMesherTest.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using atria::Vec3;

class Layers : public atria::testing::DualMesherTest
{
protected:
  Layers()
  {
    atria::testing::addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
    atria::testing::addSheet(surface, "Screen", {2.6, -1.9, 0.0}, {0.0, 3.1, 0.0}, {0.0, 0.0, 2.1});
    setSurface(surface);
    // So fine that the screen has faces with five others between them and its boundary edge.
    atria::testing::setGrid(mesher, domain, 0.15, 0.15, 1.2);
  }

  vtkIdType invalidCells()
  {
    vtkNew<vtkAtriaMeshQuality> quality;
    quality->SetInputConnection(0, mesher->GetOutputPort(0));
    quality->SetInputConnection(1, mesher->GetOutputPort(1));
    quality->Update();
    return quality->GetNumberOfInvalidCells();
  }

  /// Least and greatest of a patch's array.
  std::array<double, 2> rangeOf(const std::string& patch, const char* array)
  {
    std::array<double, 2> range{};
    namedPatches().at(patch)->GetCellData()->GetArray(array)->GetRange(range.data());
    return range;
  }

  std::vector<std::string> stringsOf(const char* array)
  {
    std::vector<std::string> texts;
    vtkAbstractArray* found = mesher->GetOutputDataObject(2)->GetFieldData()->GetAbstractArray(array);
    for (vtkIdType i = 0; found && i < found->GetNumberOfValues(); ++i)
    {
      texts.push_back(vtkStringArray::SafeDownCast(found)->GetValue(i));
    }
    return texts;
  }

  atria::TriangleSurface surface;
};

TEST_F(Layers, AreOneByDefault)
{
  mesher->Update();
  EXPECT_EQ(rangeOf("Building", "LayerCount"), (std::array{1.0, 1.0}));
}

TEST_F(Layers, FillTheSameSpaceWithOneAndFive)
{
  mesher->SetNumberOfLayers(0);
  mesher->SetSupportElements(false);
  mesher->Update();
  const double space = meshVolume();
  const vtkIdType plain = volume()->GetNumberOfCells();
  vtkIdType faces = 0;
  for (const auto& [name, patch] : namedPatches())
  {
    faces += name.starts_with("x") || name.starts_with("y") || name.starts_with("z") ? 0 : patch->GetNumberOfCells();
    EXPECT_EQ(rangeOf(name, "LayerCount"), (std::array{0.0, 0.0}));
  }
  for (const int layers : {1, 5})
  {
    SCOPED_TRACE(layers);
    mesher->SetNumberOfLayers(layers);
    mesher->Update();
    EXPECT_LE(volume()->GetNumberOfCells(), plain + layers * faces);
    EXPECT_GT(volume()->GetNumberOfCells(), plain);
    EXPECT_NEAR(meshVolume() / space, 1.0, 1e-9);
    EXPECT_EQ(invalidCells(), 0);
    EXPECT_EQ(rangeOf("Building", "LayerCount")[0], layers);
    for (const char* patch : {"Building", "Screen_front", "Screen_back"})
    {
      EXPECT_EQ(rangeOf(patch, "LayerCount")[1], layers) << patch;
      EXPECT_GT(rangeOf(patch, "LayerThickness")[1], 0.0) << patch;
    }
    EXPECT_EQ(rangeOf("zMin", "LayerCount")[1], 0.0);
  }
}

TEST_F(Layers, FollowTheRules)
{
  mesher->SetNumberOfLayers(2);
  mesher->SetFirstLayerHeight(0.02);
  mesher->AddLayerRule("Scr*", 3, 0.01, 1.5);
  mesher->AddLayerRule("zMin", 1);
  mesher->Update();
  EXPECT_EQ(rangeOf("Building", "LayerCount")[1], 2.0);
  EXPECT_EQ(rangeOf("Screen_front", "LayerCount")[1], 3.0);
  // All faces of the screen have corners on its boundary edge, where the layer tapers to nothing: elements are sound in
  // higher layers only.
  const double asked = 0.01 * (1.0 + 1.5 + 2.25);
  EXPECT_LT(rangeOf("Screen_front", "LayerThickness")[1], 1.5 * asked);
  EXPECT_GT(rangeOf("Screen_front", "LayerThickness")[1], 0.01);
  EXPECT_NEAR(rangeOf("Building", "LayerThickness")[1], 0.02 * 2.2, 1e-9);
  EXPECT_EQ(rangeOf("zMin", "LayerCount")[0], 1.0);
  EXPECT_EQ(rangeOf("zMin", "LayerCount")[1], 3.0) << "where the screen's layers end on it";
  auto* names = vtkStringArray::SafeDownCast(diagnostics()->GetFieldData()->GetAbstractArray("LayerSurface"));
  ASSERT_EQ(names->GetNumberOfValues(), 3);
  EXPECT_EQ(names->GetValue(1), "Screen");
  EXPECT_EQ(diagnostics()->GetFieldData()->GetArray("LayersAsked")->GetTuple1(1), 3.0);
  EXPECT_GT(diagnostics()->GetFieldData()->GetArray("LayerCoverage")->GetTuple1(1), 0.3);
  mesher->RemoveAllLayerRules();
  mesher->Update();
  EXPECT_EQ(rangeOf("Screen_front", "LayerCount")[1], 2.0);
}

TEST_F(Layers, AreAsManyAsFit)
{
  mesher->AddLayerRule("Building auto 0.02 1.3");
  mesher->AddLayerRule("Screen 3 0.02 auto");
  mesher->Update();
  EXPECT_EQ(invalidCells(), 0);
  // Octants are 0.15: after three layers, 0.08, one more would take more than three quarters of them.
  EXPECT_EQ(rangeOf("Building", "LayerCount")[1], 3.0);
  EXPECT_EQ(rangeOf("Screen_front", "LayerCount")[1], 3.0);
  EXPECT_EQ(stringsOf("FailingByThinLayers"), std::vector<std::string>());
}

TEST_F(Layers, ThatAreTooThinForChecksAreNotedWithWhatToDo)
{
  mesher->AddLayerRule("Building 1 0.004 1.2");
  mesher->Update();
  EXPECT_EQ(invalidCells(), 0);
  EXPECT_EQ(stringsOf("FailingByThinLayers"), std::vector<std::string>{"FaceWeight"});
  const std::vector<std::string> notes = stringsOf("InputNote");
  const auto isOnLayers = [](const std::string& note) { return note.find("layers are so thin") == 0; };
  ASSERT_EQ(std::ranges::count_if(notes, isOnLayers), 1);
  const std::string& note = *std::ranges::find_if(notes, isOnLayers);
  for (const char* part : {"FaceWeight of checkMesh fails", "on Building,", "1 layer from 0.004", "ask for 10 layers"})
  {
    EXPECT_NE(note.find(part), std::string::npos) << part << ": " << note;
  }
}

TEST_F(Layers, RefuseRulesThatMeanNothing)
{
  for (const char* rule : {"Roof 1", "Screen", "Screen 1.5", "Screen -1", ""})
  {
    mesher->RemoveAllLayerRules();
    mesher->AddLayerRule(rule);
    mesher->Update();
    const std::vector<std::string> errors = messages.takeErrors();
    ASSERT_FALSE(errors.empty()) << rule;
    EXPECT_NE(errors[0].find(rule[0] == 'R' ? "no surface matches 'Roof'" : "layer"), std::string::npos) << errors[0];
    expectEmpty();
  }
}

} // namespace
