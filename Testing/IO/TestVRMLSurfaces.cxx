// SPDX-License-Identifier: GPL-3.0-or-later
/// What the reader makes surfaces of, and how it names them.
#include "VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using atria::testing::joined;
using atria::testing::VRMLModel;
using atria::testing::writeFile;
using Names = std::vector<std::string>;

class VRMLSurfaces : public atria::testing::VtkTest
{
protected:
  VRMLModel read(const std::string& body, int by = vtkAtriaVRMLReader::Shape, double splitAngle = 30.0)
  {
    const auto file = writeFile(scratch.path(), "model.wrl", "#VRML V2.0 utf8\n" + body);
    return VRMLModel(file, [&](vtkAtriaVRMLReader& reader) {
      reader.SetSurfaceBy(by);
      reader.SetSplitAngle(splitAngle);
    });
  }

  atria::testing::ScratchFolder scratch;
};

const std::string box = "Shape { geometry Box {} }";

std::string shape(const std::string& name, const std::string& appearance)
{
  return "DEF " + name + " Shape { appearance " + appearance + " geometry Box {} }";
}

/// Two shapes of brick, one of glass, in two groups.
const std::string town = "DEF East Group { children [ " +
                         shape("A", "Appearance { material DEF Brick Material { diffuseColor 1 0 0 } }") +
                         shape("B", "Appearance { material DEF Glass Material { transparency 0.5 } }") +
                         " ] } DEF West Group { children " + shape("C", "Appearance { material USE Brick }") + " } ";

TEST_F(VRMLSurfaces, PutsTheGroupAheadOfNamesThatRepeat)
{
  const std::string wall = "DEF Wall " + box;
  EXPECT_EQ(read("DEF Town Group { children [ DEF East Group { children " + wall + " } DEF West Group { children " +
                 wall + " } ] }")
                .names(),
            (Names{"East/Wall", "West/Wall"}));
  EXPECT_EQ(read(wall + "DEF West Group { children USE Wall }").names(), (Names{"Wall", "West/Wall"}));
  EXPECT_EQ(read("DEF East Group { children [ " + wall + " USE Wall ] } DEF West Group { children USE Wall }").names(),
            (Names{"East/Wall", "East/Wall_2", "West/Wall"}));
  EXPECT_EQ(read(wall + "USE Wall USE Wall").names(), (Names{"Wall", "Wall_2", "Wall_3"}));
}

TEST_F(VRMLSurfaces, LeavesOutThoseOfGivenNames)
{
  const auto file = writeFile(scratch.path(), "model.wrl", "#VRML V2.0 utf8\n" + town);
  const auto without = [&](const std::vector<const char*>& patterns) {
    return VRMLModel(file, [&](vtkAtriaVRMLReader& reader) {
      reader.SetMergeDuplicateFaces(false);
      for (const char* pattern : patterns)
      {
        reader.AddExcludedSurface(pattern);
      }
    });
  };
  const VRMLModel model = without({"B"});
  EXPECT_EQ(model.names(), (Names{"A", "C"}));
  EXPECT_EQ(model.materials(), (Names{"Brick", "Brick"}));
  EXPECT_EQ(model.brokenPromise(), "");
  EXPECT_EQ(model.triangles(), 24);
  EXPECT_EQ(without({"A", "[B]"}).names(), (Names{"B", "C"})) << "a pattern that matches none";
  EXPECT_NE(joined(messages.takeWarnings()).find("no surface matches '[B]', which is to be left out"),
            std::string::npos);
  EXPECT_EQ(without({"Tree*"}).triangles(), 36);
  EXPECT_NE(joined(messages.takeWarnings()).find("no surface matches 'Tree*'"), std::string::npos);
  EXPECT_EQ(without({"*"}).triangles(), 0);
  EXPECT_NE(joined(messages.takeErrors()).find("all surfaces of the model are to be left out"), std::string::npos);
}

TEST_F(VRMLSurfaces, TellsUsesOfAGroupApartByWhereTheyAre)
{
  EXPECT_EQ(read("DEF House1 Transform { children DEF House Group { children [ DEF Wall " + box + " DEF Roof " + box +
                 "] } } DEF House2 Transform { translation 9 0 0 children USE House }")
                .names(),
            (Names{"House1/Wall", "House1/Roof", "House2/Wall", "House2/Roof"}));
}

TEST_F(VRMLSurfaces, NumbersKeepClearOfNamesOfTheFileThatComeLater)
{
  EXPECT_EQ(read("DEF A " + box + "DEF A " + box + "DEF A_2 " + box).names(), (Names{"A", "A_3", "A_2"}));
}

TEST_F(VRMLSurfaces, KeepsColorsAndTransparency)
{
  const VRMLModel model = read(town);
  EXPECT_EQ(model.names(), (Names{"A", "B", "C"}));
  EXPECT_EQ(model.materials(), (Names{"Brick", "Glass", "Brick"}));
  EXPECT_EQ(model.numbers("Transparency"), (std::vector<double>{0, 0.5, 0}));
  EXPECT_EQ(model.numbers("DiffuseColor"), (std::vector<double>{1, 0, 0, 0.8, 0.8, 0.8, 1, 0, 0}));
  EXPECT_EQ(model.brokenPromise(), "");
}

TEST_F(VRMLSurfaces, JoinsShapesOfAGroup)
{
  const VRMLModel model = read(town + box + "Group { children " + box + " }", vtkAtriaVRMLReader::Group);
  EXPECT_EQ(model.names(), (Names{"East", "West", "Ungrouped"}));
  EXPECT_NEAR(model.area("East"), 48.0, 1e-12);
  EXPECT_NEAR(model.area("Ungrouped"), 48.0, 1e-12);
  EXPECT_EQ(model.brokenPromise(), "");
}

TEST_F(VRMLSurfaces, KeepsUsesOfAGroupApart)
{
  EXPECT_EQ(read("DEF Tree Group { children [ " + box + box + " ] } USE Tree", vtkAtriaVRMLReader::Group).names(),
            (Names{"Tree", "Tree_2"}));
}

TEST_F(VRMLSurfaces, JoinsShapesOfAMaterial)
{
  const VRMLModel model =
      read(town + box +
               "Shape { appearance Appearance { material Material { diffuseColor 0 0 1 transparency "
               "0.3 } } geometry Box {} }",
           vtkAtriaVRMLReader::Material);
  EXPECT_EQ(model.names(), (Names{"Brick", "Glass", "NoMaterial", "Material_0000FF_Transparent"}));
  EXPECT_NEAR(model.area("Brick"), 48.0, 1e-12);
  EXPECT_EQ(model.brokenPromise(), "");
}

TEST_F(VRMLSurfaces, PartsABoxIntoItsSides)
{
  const VRMLModel model = read("DEF House " + box, vtkAtriaVRMLReader::Connected);
  ASSERT_EQ(model.names().size(), 6u);
  for (const std::string& name : model.names())
  {
    EXPECT_NEAR(model.area(name), 4.0, 1e-12);
  }
  EXPECT_EQ(model.names()[0], "House");
  EXPECT_EQ(model.names()[5], "House_6");
  EXPECT_EQ(read("DEF House " + box, vtkAtriaVRMLReader::Connected, 90.0).names(), Names{"House"});
}

TEST_F(VRMLSurfaces, KeepsWhatIsSmoothTogetherAndWhatDoesNotTouchApart)
{
  const VRMLModel round = read("DEF Silo Shape { geometry Cylinder {} }", vtkAtriaVRMLReader::Connected);
  ASSERT_EQ(round.names().size(), 3u); // the side and two caps
  EXPECT_NEAR(round.area("Silo"), 4 * std::numbers::pi, 0.1);
  const VRMLModel two =
      read("DEF Slabs Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, "
           "0 1 0, 5 0 0, 6 0 0, 6 1 0] } coordIndex [0 1 2 3 -1 4 5 6 -1] } }",
           vtkAtriaVRMLReader::Connected);
  EXPECT_EQ(two.names(), (Names{"Slabs", "Slabs_2"}));
}

} // namespace
