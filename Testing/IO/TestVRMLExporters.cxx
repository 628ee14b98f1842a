// SPDX-License-Identifier: GPL-3.0-or-later
/// What programs write into VRML files, legal or not, as short texts: how many triangles of what area there must be,
/// the names of their surfaces, and whether there is something to warn of.
///
/// In the texts @ stands for a shape of one square, of two triangles and of area 1, and $ for its geometry. Those that
/// do not begin with a header are VRML97.
#include "VRMLModel.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace {

using atria::testing::joined;
using atria::testing::VRMLModel;
using atria::testing::writeFile;

const std::string square =
    "IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] } coordIndex [0 1 2 3 -1] }";

std::string expanded(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    out += c == '@' ? "Shape { geometry " + square + " }" : c == '$' ? square : std::string(1, c);
  }
  return out.compare(0, 1, "#") == 0 ? out : "#VRML V2.0 utf8\n" + out;
}

struct Case
{
  const char* name;
  std::string text;
  long long triangles;
  double area;
  const char* surfaces; ///< with blanks between
  bool warned;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const std::vector<Case>& prototypes()
{
  static const std::vector<Case> all{
      {"NestedIsWithUseInside",
       "PROTO Leaf [field SFNode g NULL field MFNode kids []] { Group { children [ DEF S Shape { geometry IS g } "
       "Transform { translation 5 0 0 children [ USE S ] } Group { children IS kids } ] } } "
       "PROTO Pair [field SFNode g NULL] { Transform { translation 0 10 0 children [ Leaf { g IS g kids [ @ ] } ] } } "
       "Pair { g $ }",
       6, 3, "S S_2 Shape", false},
      {"ExternProtoByNameOfASecondOne",
       "EXTERNPROTO P [field SFVec3f size] \"sub/library.wrl#Second\" P { size 3 3 1 }", 2, 9, "Shape", false},
      {"ExternProtoThatInlinesBesideItself", "EXTERNPROTO P [] [\"no.wrl#P\" \"sub/library.wrl#Inlining\"] P {}", 2, 1,
       "leaf", false},
      {"ExternProtoThatIsMissingKeepsItsChildren",
       "EXTERNPROTO Part [field SFVec3f translation field MFNode children] \"no.wrl#Part\" DEF A Part { translation 0 "
       "0 1 "
       "children [ @ DEF B @ ] } Part { translation 1 0 0 }",
       4, 2, "A B", true},
      {"ExternProtoByAnotherName", "EXTERNPROTO Mine [] \"sub/library.wrl#First\" Mine {}", 12, 6, "Shape", false},
      {"ProtoOfX3D",
       "#X3D V3.0 utf8\nPROFILE Interchange\nCOMPONENT NURBS:1\nMETA \"title\" \"a # b\"\nPROTO P [ initializeOnly "
       "SFNode g "
       "NULL inputOutput SFVec3f t 0 0 0 inputOnly SFBool x outputOnly SFBool y ] { Transform { translation IS t "
       "children [ "
       "Shape { geometry IS g } ] } }\nP { g $ t 1 2 3 }",
       2, 1, "Shape", true},
      {"ScriptInProtoWithIs",
       "PROTO P [ exposedField SFNode g NULL eventIn SFBool on ] { Group { children [ Shape { geometry IS g } DEF Sc "
       "Script { "
       "eventIn SFBool on IS on field SFNode me USE Sc url \"javascript: function on(v) { if (v) { print('}#'); } }\" "
       "} ] } } "
       "P { g $ }",
       2, 1, "Shape", false},
  };
  return all;
}

const std::vector<Case>& structure()
{
  static const std::vector<Case> all{
      {"InlineListWithTheFirstMissing", "Inline { url [ \"http://a/b.wrl\", \"gone.wrl\", \"sub/a%20leaf.wrl\" ] }", 2,
       1, "a leaf", false},
      {"InlineInSwitchAndLod",
       "Switch { whichChoice 1 choice [ Inline { url \"gone.wrl\" } Inline { url \"sub/leaf.wrl\" } ] } LOD { range "
       "[5] level "
       "[ Inline { url \"sub/leaf.wrl\" } Inline { url \"gone.wrl\" } ] }",
       4, 2, "leaf leaf_2", false},
      {"InlineWithoutUrl", "Inline {} Inline { url [] } Inline { url \"\" } @", 2, 1, "Shape", true},
      {"SwitchOff", "Switch { whichChoice -1 choice [ DEF A @ ] } Transform { translation 2 0 0 children USE A }", 2, 1,
       "A", false},
      {"NullAmongChildren", "Group { children [ NULL, @, NULL ] }", 2, 1, "Shape", false},
      {"NoBlanks",
       "Shape{geometry IndexedFaceSet{coord Coordinate{point[0 0 0,1 0 0,1 1 0,0 1 0]}coordIndex[0,1,2,3,-1,]}}DEF A "
       "Group{children[@]}",
       4, 2, "Shape A", false},
      {"CommentsBetweenAllTokens", "Group # a {\n{ # b }\nchildren # [\n[ # \"\n@ # ]\n] # x\n} # end", 2, 1, "Shape",
       false},
      {"DuplicateDef",
       "DEF A @ DEF A Transform { translation 0 0 4 children DEF A @ } Transform { scale 2 2 2 children USE A }", 6, 6,
       "A A/A A_2", false},
      {"GeometryUsedTwice", "Shape { geometry DEF G $ } Transform { scale 3 1 1 children Shape { geometry USE G } }", 4,
       4, "G G_2", false},
      {"MaterialUsed",
       "DEF A Shape { appearance DEF L Appearance { material DEF M Material { transparency 0.5 } } geometry $ } "
       "DEF B Shape { appearance USE L geometry $ } DEF C Shape { appearance Appearance { material USE M } geometry $ "
       "}",
       6, 3, "A B C", false},
      {"CoordinatesUsed",
       "Shape { geometry IndexedFaceSet { coord DEF P Coordinate { point [0 0 0 2 0 0 2 2 0 0 2 0] } coordIndex [0 1 "
       "2] } } "
       "Shape { geometry IndexedFaceSet { coord USE P coordIndex [0 2 3 -1] } }",
       2, 4, "Shape Shape_2", false},
      {"ZeroAxes", "Transform { rotation 0 0 0 1.57 scaleOrientation 0 0 0 1 scale 2 2 2 children @ }", 2, 4, "Shape",
       false},
  };
  return all;
}

const std::vector<Case>& programs()
{
  static const std::vector<Case> all{
      {"SketchUp",
       "#VRML V2.0 utf8\n# Generated by SketchUp\n\nWorldInfo { title \"\" info [ \"\" ] }\nNavigationInfo { type "
       "[ \"EXAMINE\" \"ANY\" ] }\nViewpoint { position 1 2 3 }\nBackground { skyColor [ 1 1 1 ] }\nTransform { "
       "children [ "
       "DEF Haus Transform { translation 0 0 1 children [ Shape { appearance Appearance { material DEF Mat Material { "
       "diffuseColor 1 0 0 } texture ImageTexture { url \"house/Brick.jpg\" } } geometry DEF id1 IndexedFaceSet { "
       "solid FALSE "
       "texCoord TextureCoordinate { point [0 0 1 0 1 1 0 1] } texCoordIndex [0 1 2 3 -1] coord Coordinate { point [0 "
       "0 0 1 0 0 "
       "1 1 0 0 1 0] } coordIndex [0 1 2 3 -1] } } ] } ] }",
       2, 1, "id1", false},
      {"3dsMax",
       "DEF Box01 Transform { translation 0 0 1 children [ DEF Box01-TIMER TimeSensor { loop TRUE cycleInterval 3.333 "
       "} DEF "
       "Box01-POS-INTERP PositionInterpolator { key [0, 1] keyValue [0 0 0, 1 1 1] } Shape { appearance Appearance { "
       "material "
       "Material { } } geometry DEF Box01-FACES IndexedFaceSet { ccw TRUE solid TRUE coord DEF Box01-COORD Coordinate "
       "{ point [0 "
       "0 0, 1 0 0, 1 1 0, 0 1 0] } coordIndex [0, 1, 2, -1, 0, 2, 3, -1] } } ] ROUTE Box01-TIMER.fraction_changed TO "
       "Box01-POS-INTERP.set_fraction ROUTE Box01-POS-INTERP.value_changed TO Box01.set_translation }",
       2, 1, "Box01-FACES", false},
      {"VTK",
       "Background { skyColor [0 0 0, ] }\nDirectionalLight { ambientIntensity 1 intensity 0 }\nTransform { "
       "translation 0 0 0 "
       "rotation 0 0 1 0 scale 1 1 1 children [ Shape { appearance Appearance { material Material { ambientIntensity 0 "
       "} } "
       "geometry IndexedFaceSet { solid FALSE coord DEF VTKcoordinates Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0, "
       "] } normal "
       "DEF VTKnormals Normal { vector [0 0 1, 0 0 1, 0 0 1, 0 0 1, ] } color DEF VTKcolors Color { color [1 0 0, 1 0 "
       "0, 1 0 0, 1 0 "
       "0, ] } coordIndex [0, 1, 2, 3, -1, ] } } Shape { geometry IndexedFaceSet { coord USE VTKcoordinates normal USE "
       "VTKnormals "
       "coordIndex [0, 1, 2, -1, ] } } ] }",
       3, 1.5, "Shape Shape_2", false},
      {"Catia",
       "#VRML V1.0 ascii\nSeparator { Info { string \"CATIA (\\\"V4\\\") # 1\" } DEF Part_1 Separator { ShapeHints { "
       "vertexOrdering COUNTERCLOCKWISE shapeType SOLID faceType CONVEX creaseAngle 0.5 } Material { ambientColor [] "
       "diffuseColor "
       ".8 .8 .8 } Coordinate3 { point [0 0 0,1 0 0,1 1 0,0 1 0] } Normal { vector [] } NormalBinding { value "
       "PER_VERTEX_INDEXED } "
       "IndexedFaceSet { coordIndex [0,1,2,3,-1] normalIndex [] } IndexedLineSet { coordIndex [0,1,-1] } PointSet { "
       "numPoints 2 } "
       "AsciiText { string [\"a\" \"b\"] } } }",
       2, 1, "Part_1", false},
      {"AutoCAD",
       "DEF Layer-0 Group { children [ DEF _1A Shape { appearance Appearance { material Material { } } geometry $ } ] "
       "} DEF "
       "0_WAND.2 Group { children [ @ ] } DEF +x!y' @",
       6, 3, "_1A 0_WAND.2 +x!y'", false},
      {"NumbersOfMicrosoft",
       "Shape { geometry IndexedFaceSet { coord Coordinate { point [0.000000e+000 0 0, 1.000000e+000 0 0, "
       "1 1 0, 0 1 0, 1.#QNAN 0 0, -1.#IND00 1 1, 1.#INF 2 2] } normal Normal { vector [1.#QNAN -1.#IND 1.#INF00, 0 0 "
       "1] } coordIndex [0 1 2 3 -1 0 1 4 -1 5 6 1 -1] } }",
       2, 1, "Shape", true},
      {"BindingsThatDoNotMatch",
       "#VRML V1.0 ascii\nSeparator { MaterialBinding { value PER_FACE } Material { diffuseColor [1 0 0] } Texture2 { "
       "image 1 1 3 "
       "0xFF0000 wrapS CLAMP } Texture2Transform { scaleFactor 2 2 } TextureCoordinate2 { point [0 0, 1] } Coordinate3 "
       "{ point [0 "
       "0 0, 1 0 0, 1 1 0, 0 1 0] } IndexedFaceSet { coordIndex [0,1,2,3] materialIndex [7,8,9] textureCoordIndex "
       "[0,1,2,3,4,5,-1] "
       "} }",
       2, 1, "Shape", false},
      {"UnknownVrml1Node",
       "#VRML V1.0 ascii\nSeparator { Chart { fields [SFString a, MFFloat b] isA [\"Group\"] a \"}\" b [1, 2] "
       "Coordinate3 { point "
       "[0 0 0, 1 0 0, 1 1 0, 0 1 0] } IndexedFaceSet { coordIndex [0,1,2,3] } } }",
       2, 1, "Shape", false},
  };
  return all;
}

const std::vector<Case>& values()
{
  static const std::vector<Case> all{
      {"PixelTexture",
       "Shape { appearance Appearance { texture PixelTexture { image 2 2 3 0xFF0000 0x00ff00 255 0 } textureTransform "
       "TextureTransform { scale 2 2 } } geometry $ }",
       2, 1, "Shape", false},
      {"PixelTextureWithTooFewPixels",
       "Shape { appearance Appearance { texture PixelTexture { image 9 9 3 0xFF0000 0x00ff00 } } geometry $ }", 2, 1,
       "Shape", false},
      {"PixelTextureWithHugeSize",
       "Shape { appearance Appearance { texture PixelTexture { image 2000000000 2000000000 4 1 } } geometry $ } @", 4,
       2, "Shape Shape_2", false},
      {"StringsWithEverything",
       "WorldInfo { title \"a \\\"b\\\" \\\\ # } ] {\" info [ \"x\ny\" \"#\" \"\" \"DEF A USE B\", \"\\\\\" ] } @", 2,
       1, "Shape", false},
      {"ColorsThatDoNotMatch",
       "Shape { geometry IndexedFaceSet { colorPerVertex FALSE color Color { color [1 0 0] } colorIndex [9 9 9] "
       "normalPerVertex "
       "FALSE normal Normal { vector [] } normalIndex [5 -1 -1] texCoord TextureCoordinate { point [0 0] } "
       "texCoordIndex [] coord "
       "Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] } coordIndex [0 1 2 3] creaseAngle 3.2 } }",
       2, 1, "Shape", false},
      {"VectorInBrackets", "Transform { translation [ 0 0 5 ] scale [2 2 2] rotation [0 0 1 0] children @ }", 2, 4,
       "Shape", true},
      {"VectorTooShort", "Transform { scale 2 2 children @ } @", 2, 1, "Shape", true},
      {"FloatInBrackets",
       "Shape { appearance Appearance { material Material { transparency [0.5] shininess [] } } geometry $ }", 2, 1,
       "Shape", true},
      {"OddBlanks", std::string("Group {\v\f children [\t") + std::string(1, '\0') + "@ ] }", 2, 1, "Shape", false},
      {"NamesWithOddCharacters", "DEF 1 @ DEF 2.5m @ DEF Wand\xc3\xa9 @ DEF W\xe4nde @ DEF a:b/c|d @", 10, 5,
       "1 2.5m Wand\xc3\xa9 W\xc3\xa4nde a:b/c|d", false},
  };
  return all;
}

const std::vector<Case>& mistakes()
{
  static const std::vector<Case> all{
      {"BraceTooMany", "@ } @ ] @", 6, 3, "Shape Shape_2 Shape_3", true},
      {"BracketTooFew",
       "Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0 } coordIndex [0 1 2 3 "
       "-1] } } @",
       4, 2, "Shape Shape_2", true},
      {"ValueMissing",
       "Shape { geometry IndexedFaceSet { ccw coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] } coordIndex "
       "[0 1 2 3 -1] } } @",
       2, 1, "Shape", true},
      {"TwoDefs", "DEF A DEF B @ @", 4, 2, "B Shape", true},
      {"DefWithoutName", "DEF Shape { geometry $ } @", 4, 2, "Shape Shape_2", true},
      {"SeveralChildrenWithoutBrackets", "Group { children @ @ } @", 6, 3, "Shape Shape_2 Shape_3", true},
      {"UnknownNodeAroundGeometry", "Foo { bar 1 2 3 name \"x\" children [ @ ] } @", 4, 2, "Shape Shape_2", true},
      {"UnknownFieldWithNodes", "Shape { metadata MetadataString { value [\"a\"] } geometry $ }", 2, 1, "Shape", true},
      {"LevelsInsteadOfLevel", "LOD { levels [ @ ] }", 2, 1, "Shape", true},
      {"NodeWithoutBraces", "Group { children [ Shape @ ] }", 2, 1, "Shape", true},
      {"FieldOfAnotherNode", "Transform { point [0 0 0] children @ coordIndex [0 1 2 -1] }", 2, 1, "Shape", true},
      {"UseOfNothing", "Group { children [ USE Nobody @ USE ] } @", 4, 2, "Shape Shape_2", true},
      {"RouteOfNothing", "ROUTE A.b TO C.d ROUTE x TO y @ ROUTE", 2, 1, "Shape", true},
      {"TextOfAPage", "#VRML V2.0 utf8\n<html><body>Not found</body></html>\n@", 2, 1, "Shape", true},
  };
  return all;
}

class VRMLExporters : public ::testing::TestWithParam<Case>
{
};

TEST_P(VRMLExporters, IsReadAsItIsMeant)
{
  const Case& wanted = GetParam();
  const atria::testing::ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path() / "sub");
  writeFile(scratch.path() / "sub", "leaf.wrl", expanded("@"));
  writeFile(scratch.path() / "sub", "a leaf.wrl", expanded("@"));
  writeFile(
      scratch.path() / "sub", "library.wrl",
      expanded("PROTO First [] { Shape { geometry Box { size 1 1 1 } } } PROTO Second [field SFVec3f size 1 1 1] { "
               "Transform { scale IS size children @ } } PROTO Inlining [] { Inline { url \"leaf.wrl\" } }"));
  atria::testing::VtkErrorGuard messages;
  const VRMLModel model(writeFile(scratch.path(), "model.wrl", expanded(wanted.text)));
  messages.takeWarnings();
  EXPECT_EQ(joined(messages.takeErrors()), "");
  EXPECT_EQ(!model.warnings().empty(), wanted.warned) << joined(model.warnings());
  ASSERT_EQ(model.triangles(), wanted.triangles) << joined(model.warnings());
  EXPECT_EQ(model.brokenPromise(), "");
  EXPECT_NEAR(model.area(), wanted.area, 1e-9);
  std::string names;
  for (const std::string& name : model.names())
  {
    names += (names.empty() ? "" : " ") + name;
  }
  EXPECT_EQ(names, wanted.surfaces);
}

const auto nameOf = [](const ::testing::TestParamInfo<Case>& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Prototypes, VRMLExporters, ::testing::ValuesIn(prototypes()), nameOf);
INSTANTIATE_TEST_SUITE_P(Structure, VRMLExporters, ::testing::ValuesIn(structure()), nameOf);
INSTANTIATE_TEST_SUITE_P(Programs, VRMLExporters, ::testing::ValuesIn(programs()), nameOf);
INSTANTIATE_TEST_SUITE_P(Values, VRMLExporters, ::testing::ValuesIn(values()), nameOf);
INSTANTIATE_TEST_SUITE_P(Mistakes, VRMLExporters, ::testing::ValuesIn(mistakes()), nameOf);

} // namespace
