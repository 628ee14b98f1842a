// SPDX-License-Identifier: GPL-3.0-or-later
/// VRML 1.0: nodes that change what those after them find.
#include "VRMLModel.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using atria::testing::joined;
using atria::testing::VRMLModel;
using atria::testing::writeFile;
using Names = std::vector<std::string>;
using std::numbers::pi;

class VRML1 : public atria::testing::VtkTest
{
protected:
  VRMLModel read(const std::string& body)
  {
    return VRMLModel(writeFile(scratch.path(), "model.wrl", "#VRML V1.0 ascii\n" + body));
  }
  void expectBounds(const std::vector<double>& actual, const std::vector<double>& wanted)
  {
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      EXPECT_NEAR(actual[i], wanted[i], 1e-12) << "bound " << i;
    }
  }

  atria::testing::ScratchFolder scratch;
};

const std::string square = "Coordinate3 { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] }\n";
const std::string face = "IndexedFaceSet { coordIndex [0, 1, 2, 3, -1] }\n";

TEST_F(VRML1, HandsStateOnWithinASeparatorOnly)
{
  const VRMLModel model = read("Separator { " + square + "Separator { Translation { translation 5 0 0 } DEF A " + face +
                               "} Group { Translation { translation 0 7 0 } } DEF B " + face + "}");
  EXPECT_EQ(model.names(), (Names{"A", "B"}));
  expectBounds(model.bounds("A"), {5, 6, 0, 1, 0, 0});
  expectBounds(model.bounds("B"), {0, 1, 7, 8, 0, 0}); // a Group passes on what is inside
}

TEST_F(VRML1, RestoresTheTransformAloneAfterATransformSeparator)
{
  const VRMLModel model = read("Separator { TransformSeparator { Translation { translation 5 0 0 } " + square +
                               "DEF Paint Material { diffuseColor 1 0 0 } } DEF A " + face + "}");
  expectBounds(model.bounds("A"), {0, 1, 0, 1, 0, 0});
  EXPECT_EQ(model.materials(), Names{"Paint"});
}

TEST_F(VRML1, AppliesAllTransformsInTheOrderTheyStand)
{
  expectBounds(read("Translation { translation 1 2 3 } Scale { scaleFactor 2 4 6 } Cube {}").bounds(),
               {-1, 3, -2, 6, -3, 9});
  expectBounds(
      read("Rotation { rotation 0 0 1 1.5707963267948966 } Translation { translation 5 0 0 } Cube {}").bounds(),
      {-1, 1, 4, 6, -1, 1});
  // Of Inventor.
  expectBounds(
      read("RotationXYZ { axis Z angle 1.5707963267948966 } Translation { translation 5 0 0 } Cube {}").bounds(),
      {-1, 1, 4, 6, -1, 1});
  expectBounds(read("RotationXYZ { angle 1.5707963267948966 } Translation { translation 0 5 0 } Cube {}").bounds(),
               {-1, 1, -1, 1, 4, 6});
  // Rows are for row vectors: a quarter turn about z, then a shift.
  const VRMLModel matrix =
      read("MatrixTransform { matrix 0 1 0 0  -1 0 0 0  0 0 1 0  10 20 30 1 } Cube { width 2 height 4 depth 6 }");
  expectBounds(matrix.bounds(), {8, 12, 19, 21, 27, 33});
  EXPECT_NEAR(matrix.volume(), 48.0, 1e-10);
  // x' = 10 + 1 - 2 y, y' = 20 + (x - 1), z' = 30 + 3 z
  expectBounds(read("Transform { scaleFactor 1 2 3 rotation 0 0 5 1.5707963267948966 center 1 0 0 "
                    "translation 10 20 30 } Cube {}")
                   .bounds(),
               {9, 13, 18, 20, 27, 33});
}

TEST_F(VRML1, KeepsFrontsOutwards)
{
  EXPECT_NEAR(read("Scale { scaleFactor -1 1 1 } Cube {}").volume(), 8.0, 1e-12);
  const std::string box = "Coordinate3 { point [-1 -1 -1, -1 -1 1, -1 1 -1, -1 1 1, 1 -1 -1, 1 -1 1, 1 1 -1, 1 1 1] }";
  const std::string outwards = "IndexedFaceSet { coordIndex [0 2 6 4 -1 4 6 7 5 -1 6 2 3 7 -1 0 1 3 2 -1 5 7 3 1 -1 "
                               "4 5 1 0 -1] }";
  EXPECT_NEAR(read(box + outwards).volume(), 8.0, 1e-12);
  EXPECT_NEAR(read("ShapeHints { vertexOrdering CLOCKWISE faceType UNKNOWN_FACE_TYPE } " + box + outwards).volume(),
              -8.0, 1e-12);
  EXPECT_NEAR(read("ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID } " + box + outwards).volume(), 8.0,
              1e-12);
}

TEST_F(VRML1, MakesPrimitivesAndTheirParts)
{
  EXPECT_NEAR(read("Cube { width 1 height 2 depth 3 }").volume(), 6.0, 1e-12);
  EXPECT_NEAR(read("Sphere { radius 2 }").area(), 16 * pi, 0.5);
  EXPECT_NEAR(read("Cylinder { parts (SIDES | TOP) radius 2 height 3 }").area(), 12 * pi + 4 * pi, 0.3);
  EXPECT_NEAR(read("Cylinder { parts(SIDES|TOP)radius 2 height 3 }").area(), 12 * pi + 4 * pi, 0.3);
  EXPECT_NEAR(read("Cylinder { parts ALL }").area(), 6 * pi, 0.1);
  EXPECT_NEAR(read("Cone { parts BOTTOM bottomRadius 3 }").area(), 9 * pi, 0.2);
  EXPECT_NEAR(read("Cone { parts (SIDES|BOTTOM) }").area(), pi * (1 + std::sqrt(5.0)), 0.1);
}

TEST_F(VRML1, ShowsTheChosenChildren)
{
  const std::string two = "DEF A Cube {} DEF B Cube {} }";
  EXPECT_EQ(read("Switch { whichChild 1 " + two).names(), Names{"B"});
  EXPECT_EQ(read("Switch { whichChild -3 " + two).names(), (Names{"A", "B"}));
  EXPECT_EQ(read("Switch { " + two + "USE B").names(), Names{"B"});
  EXPECT_EQ(read("LOD { range [10] " + two).names(), Names{"A"});
}

TEST_F(VRML1, MakesEachUseASurfaceInTheStateItStandsIn)
{
  const VRMLModel model = read("Separator { " + square + "DEF Wall " + face +
                               "DEF East Separator { Translation { translation 5 0 0 } USE Wall } " +
                               "DEF West Separator { Translation { translation -5 0 0 } USE Wall } }");
  EXPECT_EQ(model.names(), (Names{"Wall", "East/Wall", "West/Wall"}));
  expectBounds(model.bounds("West/Wall"), {-5, -4, 0, 1, 0, 0});
}

TEST_F(VRML1, KeepsMaterials)
{
  const VRMLModel model = read("Material { diffuseColor [1 0 0, 0 1 0] transparency 0.25 mirror 0.5 } Cube {} "
                               "DEF Glass Material { diffuseColor 0 0 1 transparency [0.75] } Cube {}");
  EXPECT_EQ(model.materials(), (Names{"", "Glass"}));
  EXPECT_EQ(model.names(), (Names{"Shape", "Glass"}));
  EXPECT_EQ(model.numbers("DiffuseColor"), (std::vector<double>{1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(model.numbers("Transparency"), (std::vector<double>{0.25, 0.75}));
}

TEST_F(VRML1, TakesNodesOfOthersForWhatTheySayTheyAre)
{
  const VRMLModel model =
      read("Tower { fields [ SFFloat height, MFString isA, SFEnum style ] isA [ \"House\" \"Cube\" ] "
           "height 10 style ROUND }");
  EXPECT_EQ(model.triangles(), 12);
  expectBounds(model.bounds(), {-1, 1, -5, 5, -1, 1});
}

TEST_F(VRML1, ReadsTheChildrenOfUnknownNodes)
{
  const VRMLModel model = read("Odd { fields [ SFEnum look ] look NICE size 1 2 Cube {} } Odd { look NICE } Cube {}");
  EXPECT_EQ(model.triangles(), 24);
  EXPECT_EQ(model.skipped(), Names{"Odd: 1"});
  EXPECT_NE(joined(model.warnings()).find("unknown node 'Odd'"), std::string::npos);
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
}

TEST_F(VRML1, FollowsInlinedFilesOfBothLanguages)
{
  writeFile(scratch.path(), "old.wrl", "#VRML V1.0 ascii\nTranslation { translation 0 0 9 } DEF Old Cube {}");
  writeFile(scratch.path(), "new.wrl",
            "#VRML V2.0 utf8\nTransform { translation 1 0 0 children [ DEF New Shape { geometry Box {} } Inline { url "
            "\"old.wrl\" } ] }");
  const VRMLModel model =
      read("Separator { Translation { translation 10 0 0 } WWWInline { name new.wrl bboxSize 1 1 1 } }"
           "WWWInline { name \"old.wrl\" } DEF Last Cube {}");
  EXPECT_EQ(model.names(), (Names{"New", "new/Old", "old/Old", "Last"}));
  expectBounds(model.bounds("New"), {10, 12, -1, 1, -1, 1});
  expectBounds(model.bounds("new/Old"), {10, 12, -1, 1, 8, 10});
  expectBounds(model.bounds("Last"), {-1, 1, -1, 1, -1, 1}); // the inlined file's state ends with it
}

TEST_F(VRML1, UsesPrototypesOfBothLanguages)
{
  writeFile(scratch.path(), "old.wrl", "#VRML V1.0 ascii\nPROTO P [] { Separator { Cube {} } }");
  writeFile(scratch.path(), "new.wrl", "#VRML V2.0 utf8\nPROTO P [] { Shape { geometry Box {} } }");
  const std::string placed = "Translation { translation 5 0 0 } ";
  const VRMLModel own = read("PROTO P [] { Separator { Cube {} } } " + placed + "DEF A P {}");
  expectBounds(own.bounds("A"), {4, 6, -1, 1, -1, 1});
  const VRMLModel newer = read("EXTERNPROTO P [] \"new.wrl#P\" " + placed + "DEF A P {}");
  expectBounds(newer.bounds("A"), {4, 6, -1, 1, -1, 1});
  const VRMLModel older(writeFile(scratch.path(), "model.wrl",
                                  "#VRML V2.0 utf8\nEXTERNPROTO P [] \"old.wrl#P\" "
                                  "Transform { translation 5 0 0 children DEF A P {} }"));
  expectBounds(older.bounds("A"), {4, 6, -1, 1, -1, 1});
}

TEST_F(VRML1, SkipsWhatMakesNoSurfaceAndReadsValuesWithoutQuotes)
{
  const VRMLModel model =
      read("Info { string \"a } b\" } Texture2 { filename ../brick.jpg wrapS REPEAT } FontStyle { style "
           "(BOLD|ITALIC) } MaterialBinding { value PER_FACE_INDEXED } AsciiText { string \"x\" } "
           "PerspectiveCamera { position 0 0 5 } Cube {}");
  EXPECT_EQ(model.triangles(), 12);
  EXPECT_TRUE(model.warnings().empty()) << joined(model.warnings());
  EXPECT_EQ(model.skipped(), (Names{"AsciiText: 1", "PerspectiveCamera: 1"}));
}

TEST_F(VRML1, IsKnownByItsNodesWhereTheHeaderIsMissing)
{
  const VRMLModel model(writeFile(scratch.path(), "bare.wrl", "DEF A Separator { Cube {} }"));
  EXPECT_EQ(model.names(), Names{"A"});
  EXPECT_NE(joined(model.warnings()).find("read as VRML 1.0"), std::string::npos);
  messages.takeWarnings();
}

TEST_F(VRML1, IsKnownByItsNodesWhereTheHeaderIsWrong)
{
  const VRMLModel model(writeFile(scratch.path(), "wrong.wrl", "#VRML V2.0 utf8\nDEF A Separator { Cube {} }"));
  EXPECT_EQ(model.names(), Names{"A"});
  EXPECT_NE(joined(model.warnings()).find("declares VRML97, but its nodes are those of VRML 1.0"), std::string::npos);
  const VRMLModel newer = read("DEF B Transform { children Shape { geometry Box {} } }");
  EXPECT_EQ(newer.names(), Names{"B"});
  EXPECT_EQ(messages.takeWarnings().size(), 2u);
  const VRMLModel prototype(
      writeFile(scratch.path(), "prototype.wrl",
                "#VRML V2.0 utf8\nPROTO Separator [] { Shape { geometry Box {} } } Separator {}"));
  EXPECT_EQ(prototype.triangles(), 12);
}

TEST_F(VRML1, ReadsNestingOfAnyDepth)
{
  constexpr int depth = 100'000;
  std::string body;
  for (int i = 0; i < depth; ++i)
  {
    body += "Separator{";
  }
  EXPECT_EQ(read(body + "Cube {}" + std::string(depth, '}')).triangles(), 12);
}

TEST_F(VRML1, LosesOnlyTheNodeASyntaxErrorIsIn)
{
  const VRMLModel model = read("Separator { Cube { width x } DEF B Cube {} }");
  EXPECT_EQ(model.names(), Names{"B"});
  EXPECT_NE(joined(model.warnings()).find("expected a number for the field width, found 'x'"), std::string::npos);
  messages.takeWarnings();
}

} // namespace
