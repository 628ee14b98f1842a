// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene: transforms, names, reuse, files within files, prototypes.
#include "VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using atria::testing::joined;
using atria::testing::ScratchFolder;
using atria::testing::VRMLModel;
using atria::testing::writeFile;
using Names = std::vector<std::string>;

class VRMLReader : public atria::testing::VtkTest
{
protected:
  static fs::path data(const std::string& name) { return atria::testing::dataFolder() / "VRML" / name; }

  /// A model of the text after the header.
  VRMLModel read(const std::string& body) { return VRMLModel(write("model.wrl", "#VRML V2.0 utf8\n" + body)); }
  fs::path write(const std::string& name, const std::string& text) { return writeFile(scratch.path(), name, text); }

  void expectBounds(const std::vector<double>& actual, const std::vector<double>& wanted)
  {
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      EXPECT_NEAR(actual[i], wanted[i], 1e-12) << "bound " << i;
    }
  }

  ScratchFolder scratch;
};

const std::string box = "Shape { geometry Box {} }";

TEST_F(VRMLReader, ReadsAHouseWithItsNamesAndMaterials)
{
  const VRMLModel model(data("house.wrl"));
  EXPECT_EQ(model.brokenPromise(), "");
  EXPECT_EQ(model.names(), (Names{"Walls", "Roof", "Chimney", "Chimney_2"}));
  EXPECT_EQ(model.materials(), (Names{"Brick", "Tiles", "Brick", "Brick"}));
  EXPECT_NEAR(model.area("Walls"), 2 * (8 * 3 + 6 * 3), 1e-12);
  EXPECT_EQ(model.skipped(), (Names{"IndexedLineSet: 1", "NavigationInfo: 1", "Viewpoint: 1"}));
  EXPECT_TRUE(model.warnings().empty());
}

TEST_F(VRMLReader, AppliesTransformFieldsInTheOrderOfTheStandardWhateverTheirsIs)
{
  const VRMLModel model = read(R"(
    Transform {
      children Shape { geometry Box { size 2 2 2 } }
      scale 1 2 3
      rotation 0 0 5 1.5707963267948966
      center 1 0 0
      translation 10 20 30
    })");
  // x' = 10 + 1 - 2 y, y' = 20 + (x - 1), z' = 30 + 3 z
  expectBounds(model.bounds(), {9, 13, 18, 20, 27, 33});
  EXPECT_NEAR(model.volume(), 48.0, 1e-10);
}

TEST_F(VRMLReader, ScalesAlongTurnedAxes)
{
  const VRMLModel model = read(R"(
    Transform { scale 2 1 1 scaleOrientation 0 0 1 0.78539816339744831
      children Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 1 0, -1 1 0] } coordIndex [0 1 2] } } })");
  expectBounds(model.bounds(), {-1, 2, 0, 2, 0, 0});
}

TEST_F(VRMLReader, KeepsFrontsOutwardsInMirroredGroups)
{
  EXPECT_NEAR(read("Transform { scale -1 1 1 children " + box + "}").volume(), 8.0, 1e-12);
  EXPECT_NEAR(read("Transform { scale -1 1 -1 children " + box + "}").volume(), 8.0, 1e-12);
}

TEST_F(VRMLReader, IgnoresRotationsAboutNoAxis)
{
  expectBounds(read("Transform { rotation 0 0 0 1 children " + box + "}").bounds(), {-1, 1, -1, 1, -1, 1});
}

TEST_F(VRMLReader, NamesSurfacesByTheNearestDef)
{
  const std::string appearance = "appearance DEF Look Appearance { material DEF Paint Material {} }";
  const VRMLModel model =
      read("DEF Hall Transform { children [" + box + ", DEF Door Shape { geometry DEF Leaf Box {} }" +
           ", Shape { geometry DEF Window Box {} }, Group { children " + box + " } ] }" + "Shape { " + appearance +
           " geometry Box {} } Shape { appearance DEF Plain Appearance {} geometry Box {} }" + box + box);
  EXPECT_EQ(model.names(), (Names{"Hall", "Door", "Window", "Hall_2", "Paint", "Plain", "Shape", "Shape_2"}));
  EXPECT_EQ(model.materials(), (Names{"", "", "", "", "Paint", "Plain", "", ""}));
}

TEST_F(VRMLReader, KeepsMadeUpNamesApartFromGivenOnes)
{
  const std::string def = " Shape { geometry Box {} }";
  const VRMLModel model = read("DEF A" + def + "DEF A_2" + def + "DEF A" + def + "DEF A_2" + def);
  EXPECT_EQ(model.names(), (Names{"A", "A_2", "A_3", "A_2_2"}));
}

TEST_F(VRMLReader, MakesEachUseASurfaceOfItsOwn)
{
  const VRMLModel model = read("DEF Tree Shape { geometry DEF Crown Sphere {} }"
                               "Transform { translation 5 0 0 children USE Tree }"
                               "Transform { translation 9 0 0 children Shape { geometry USE Crown } }");
  EXPECT_EQ(model.names(), (Names{"Tree", "Tree_2", "Crown"}));
  expectBounds(model.bounds("Tree_2"), {4, 6, -1, 1, -1, 1});
  EXPECT_NEAR(model.area("Tree"), model.area("Crown"), 1e-12);
}

TEST_F(VRMLReader, TakesTheLastOfSeveralNodesOfOneName)
{
  const VRMLModel model = read("DEF A Shape { geometry Box { size 1 1 1 } } DEF A Shape { geometry Box { size 3 3 3 } }"
                               "Transform { translation 10 0 0 children USE A }");
  EXPECT_EQ(model.names(), (Names{"A", "A_2", "A_3"}));
  EXPECT_NEAR(model.area("A_3"), 54.0, 1e-12);
}

TEST_F(VRMLReader, ShowsTheChosenBranchesOnly)
{
  EXPECT_EQ(read("Switch { whichChoice 1 choice [ NULL, DEF Second " + box + "] }").names(), Names{"Second"});
  EXPECT_EQ(read(box + "Switch { choice [" + box + "] } Switch { whichChoice 7 choice " + box + "}").triangles(), 12);
  EXPECT_EQ(read("LOD { range [10] level [ DEF Fine " + box + " DEF Coarse " + box + "] }").names(), Names{"Fine"});
  EXPECT_EQ(read("Collision { proxy " + box + " children DEF Real " + box + "}").names(), Names{"Real"});
  EXPECT_EQ(read("Anchor { url \"x\" children Billboard { children " + box + "} }").triangles(), 12);
}

TEST_F(VRMLReader, FollowsInlinedFiles)
{
  const VRMLModel model(data("site.wrl"));
  EXPECT_EQ(model.names(), (Names{"Ground", "Tower", "Tower_2"}));
  expectBounds(model.bounds("Tower_2"), {19, 21, 0, 10, -1, 1});
}

TEST_F(VRMLReader, FindsInlinedFilesByBackslashCaseAndBareName)
{
  fs::create_directory(scratch.path() / "Parts");
  write("Parts/Wall.WRL", "#VRML V2.0 utf8\nDEF Wall " + box);
  write("roof top.wrl", "#VRML V2.0 utf8\nDEF Roof " + box);
  const VRMLModel model =
      read("Inline { url \"parts\\\\wall.wrl\" } Inline { url [\"http://x.org/no.wrl\" \"roof%20top.wrl\"] }"
           "Inline { url [\"C:\\\\Users\\\\me\\\\other.wrl\" \"ROOF TOP.WRL\"] }");
  EXPECT_EQ(model.names(), (Names{"Wall", "Roof", "Roof_2"}));
  EXPECT_TRUE(model.warnings().empty());
}

TEST_F(VRMLReader, WarnsOfInlinedFilesFoundElsewhere)
{
  fs::create_directory(scratch.path() / "parts");
  write("parts/elsewhere.wrl", "#VRML V2.0 utf8\nDEF Far " + box);
  write("elsewhere.wrl", "#VRML V2.0 utf8\nDEF Near " + box);
  const std::string absent = "Inline { url \"C:\\\\Users\\\\me\\\\elsewhere.wrl\" }";
  const VRMLModel model = read(absent + absent + "Inline { url [\"gone/elsewhere.wrl\" \"parts/elsewhere.wrl\"] }");
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  EXPECT_EQ(model.names(), (Names{"Near", "Near_2", "Far"}));
  ASSERT_EQ(model.warnings().size(), 1u) << "once for each file";
  const std::string warning = model.warnings().front();
  EXPECT_NE(warning.find("model.wrl:2:1: Inline: 'C:\\Users\\me\\elsewhere.wrl'"), std::string::npos) << warning;
  EXPECT_NE(warning.find("'" + (scratch.path() / "elsewhere.wrl").string() + "' is read"), std::string::npos)
      << warning;
}

TEST_F(VRMLReader, WarnsOfInlinedFilesThatAreMissingOrCyclic)
{
  const VRMLModel model = read(box + "Inline { url \"gone.wrl\" }\nInline { url \"model.wrl\" }");
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  const std::string warnings = joined(model.warnings());
  EXPECT_NE(warnings.find("model.wrl:2:26: Inline: cannot read 'gone.wrl'"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("model.wrl:3:1: Inline: the file contains itself"), std::string::npos) << warnings;
  EXPECT_EQ(model.triangles(), 12);
}

TEST_F(VRMLReader, FollowsFilesInFilesInFoldersOfTheirOwn)
{
  fs::create_directories(scratch.path() / "a" / "b");
  write("a/a.wrl", "#VRML V2.0 utf8\nTransform { translation 10 0 0 children Inline { url \"b/b.wrl\" } }");
  write("a/b/b.wrl", "#VRML V2.0 utf8\nDEF Deep " + box + "Inline { url \"../../c.wrl\" }");
  write("c.wrl", "#VRML V2.0 utf8\nDEF Back " + box);
  const VRMLModel model = read("Transform { translation 1 0 0 children Inline { url \"a/a.wrl\" } }");
  EXPECT_EQ(model.names(), (Names{"Deep", "Back"}));
  expectBounds(model.bounds("Back"), {10, 12, -1, 1, -1, 1});
}

TEST_F(VRMLReader, FollowsChainsOfFilesOfAnyLength)
{
  constexpr int files = 300;
  for (int i = 0; i < files; ++i)
  {
    write("f" + std::to_string(i) + ".wrl",
          "#VRML V2.0 utf8\n" + box + "Inline { url \"f" + std::to_string(i + 1) + ".wrl\" }");
  }
  const VRMLModel model = read("Inline { url \"f0.wrl\" }");
  EXPECT_EQ(model.triangles(), 12 * files);
  EXPECT_EQ(messages.takeWarnings().size(), 1u); // the last file is missing
}

TEST_F(VRMLReader, FindsCyclesOfFilesThroughPrototypes)
{
  const VRMLModel model =
      read("PROTO P [] { Group { children [" + box + " Inline { url \"model.wrl\" } ] } } P {} P {}");
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  EXPECT_EQ(model.triangles(), 24);
}

TEST_F(VRMLReader, SurvivesNodesThatContainThemselves)
{
  const VRMLModel model = read("DEF Loop Group { children [" + box + " USE Loop ] }");
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  EXPECT_EQ(model.triangles(), 12);
}

TEST_F(VRMLReader, RefusesScenesThatMultiplyWithoutEnd)
{
  std::string body = "DEF N0 Shape {} ";
  for (int i = 1; i < 40; ++i)
  {
    const std::string below = "USE N" + std::to_string(i - 1);
    body += "DEF N" + std::to_string(i) + " Group { children [" + below + " " + below + "] }\n";
  }
  EXPECT_EQ(read(body).triangles(), 0);
  const Names errors = messages.takeErrors();
  ASSERT_FALSE(errors.empty());
  EXPECT_NE(errors[0].find("USE each other without end"), std::string::npos) << errors[0];
}

TEST_F(VRMLReader, ReadsNestingOfAnyDepth)
{
  constexpr int depth = 200'000;
  std::string body;
  for (int i = 0; i < depth; ++i)
  {
    body += "Group{children[";
  }
  body += box;
  for (int i = 0; i < depth; ++i)
  {
    body += "]}";
  }
  EXPECT_EQ(read(body).triangles(), 12);
}

TEST_F(VRMLReader, ExpandsPrototypes)
{
  const VRMLModel model(data("prototypes.wrl"));
  EXPECT_EQ(model.names(), (Names{"Left", "Right", "Slab", "Slab_2", "Inner", "Pillar"}));
  EXPECT_EQ(model.materials(), (Names{"Steel", "Steel", "", "", "", ""}));
  expectBounds(model.bounds("Left"), {-6, -4, -3, 3, -1, 1});
  expectBounds(model.bounds("Right"), {4.5, 5.5, -1, 1, -1, 1});
  expectBounds(model.bounds("Slab_2"), {-5, 5, 9, 11, -5, 5});
  expectBounds(model.bounds("Inner"), {-1, 1, 19, 21, -1, 1});
  expectBounds(model.bounds("Pillar"), {99.5, 100.5, 0, 4, -0.5, 0.5});
}

TEST_F(VRMLReader, SkipsPrototypesThatCannotBeFound)
{
  const VRMLModel model =
      read("EXTERNPROTO Thing [ field SFBool on ] [ \"urn:x\" \"gone.wrl#Thing\" ]\nThing { on TRUE }" + box);
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  EXPECT_EQ(model.triangles(), 12);
  EXPECT_NE(joined(model.warnings()).find("model.wrl:3:1: Thing: cannot read"), std::string::npos)
      << joined(model.warnings());
}

TEST_F(VRMLReader, WarnsOfGeometryByTheNameItGoesBy)
{
  const std::string faces =
      "geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 2 "
      "-1 0 1 7] }";
  const VRMLModel model =
      read("DEF Wall Shape {\n" + faces + "}\nDEF Hall Group { children Shape {\n  " + faces + "} }");
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  ASSERT_EQ(model.warnings().size(), 2u);
  EXPECT_EQ(model.warnings()[0].substr(0, 39), "model.wrl:3:10: IndexedFaceSet 'Wall': ");
  EXPECT_EQ(model.warnings()[1].substr(0, 39), "model.wrl:5:12: IndexedFaceSet 'Hall': ");
}

TEST_F(VRMLReader, ReadsFilesOfAnInlineLoadControl)
{
  write("part.wrl", "#VRML V2.0 utf8\nDEF Part " + box);
  const VRMLModel model =
      read("InlineLoadControl { load TRUE url \"part.wrl\" } Inline { load TRUE url \"part.wrl\" }");
  EXPECT_EQ(model.names(), (Names{"Part", "Part_2"}));
}

TEST_F(VRMLReader, TakesPrototypesWhoseUrlNamesAStandardNode)
{
  const VRMLModel model = read("EXTERNPROTO Moved [ field SFVec3f translation field MFNode children field SFBool on ]\n"
                               "[ \"gone.wrl\" \"urn:web3d:vrml97:node:Transform\" ]\n"
                               "EXTERNPROTO Thing [ field SFNode geometry ] \"urn:inet:example.org:node:Shape\"\n"
                               "DEF Far Moved { on TRUE translation 5 0 0 children Thing { geometry Box {} } }");
  EXPECT_EQ(model.names(), Names{"Far"});
  expectBounds(model.bounds("Far"), {4, 6, -1, 1, -1, 1});
}

TEST_F(VRMLReader, MovesChildrenOfInstancesWithoutPrototype)
{
  const VRMLModel model = read("EXTERNPROTO Moved [ field SFVec3f translation field SFRotation rotation field SFVec3f "
                               "scale field MFNode children ] \"gone.wrl\"\n"
                               "DEF Far Moved { scale 1 2 1 translation 5 0 0 rotation 0 0 1 1.5707963267948966\n"
                               "children " +
                               box + "}");
  EXPECT_NE(joined(model.warnings()).find("read as those of a Transform"), std::string::npos);
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  expectBounds(model.bounds("Far"), {3, 7, -1, 1, -1, 1});
}

TEST_F(VRMLReader, StopsPrototypesOfTwoFilesThatContainEachOther)
{
  write("b.wrl", "#VRML V2.0 utf8\nEXTERNPROTO A [] \"model.wrl#A\" PROTO B [] { Group { children A {} } }");
  const VRMLModel model =
      read("EXTERNPROTO B [] \"b.wrl#B\" PROTO A [] { Group { children [" + box + " B {} ] } } A {}");
  EXPECT_FALSE(messages.takeWarnings().empty());
  EXPECT_GT(model.triangles(), 0);
}

TEST_F(VRMLReader, PrintsItsProperties)
{
  vtkNew<vtkAtriaVRMLReader> reader;
  EXPECT_EQ(reader->GetTessellationAngle(), 10.0);
  EXPECT_EQ(reader->GetFileName(), nullptr);
  reader->SetTessellationAngle(90.0);
  reader->SetFileName("a.wrl");
  std::ostringstream text;
  reader->Print(text);
  EXPECT_EQ(reader->GetTessellationError(), 0.0);
  for (const char* property :
       {"FileName: a.wrl", "TessellationAngle: 90", "TessellationError: 0", "NumberOfWarnings: 0", "SkippedNodes: 0",
        "SurfaceBy: 0", "SplitAngle: 30", "MergeDuplicateFaces: on", "UpAxis: 0", "LengthUnit: 0", "Scale: 1",
        "Recenter: off", "NumberOfMergedFaces: 0", "Notes: 0"})
  {
    EXPECT_NE(text.str().find(property), std::string::npos) << property;
  }
}

TEST_F(VRMLReader, PropertiesOutsideOfTheirRangeAreErrors)
{
  vtkNew<vtkAtriaVRMLReader> reader;
  reader->SetFileName(data("house.wrl").c_str());
  reader->SetUpAxis(vtkAtriaVRMLReader::ZUp);
  const auto expectError = [&](const char* text) {
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0) << text;
    const std::vector<std::string> errors = messages.takeErrors();
    ASSERT_FALSE(errors.empty()) << text;
    EXPECT_NE(errors.front().find(text), std::string::npos) << errors.front();
  };
  reader->SetTessellationAngle(0.0);
  expectError("TessellationAngle is 0; it must be a number from 1 to 90");
  reader->SetTessellationAngle(10.0);
  reader->SetTessellationError(-1.0);
  expectError("TessellationError is -1; it must be a number of at least 0");
  reader->SetTessellationError(0.0);
  reader->SetScale(std::numeric_limits<double>::quiet_NaN());
  expectError("Scale is nan; it must be a number from 1e-09 to 1000000000");
  reader->SetScale(1.0);
  reader->Update();
  EXPECT_GT(reader->GetOutput()->GetNumberOfCells(), 0);
}

TEST_F(VRMLReader, TellsWhichFilesItCanRead)
{
  EXPECT_TRUE(vtkAtriaVRMLReader::CanReadFile(data("house.wrl").c_str()));
  EXPECT_TRUE(vtkAtriaVRMLReader::CanReadFile(data("house.wrz").c_str()));
  EXPECT_TRUE(vtkAtriaVRMLReader::CanReadFile(write("old.wrl", "#VRML V1.0 ascii\n").c_str()));
  EXPECT_FALSE(vtkAtriaVRMLReader::CanReadFile(write("empty.wrl", "").c_str()));
  EXPECT_FALSE(vtkAtriaVRMLReader::CanReadFile(scratch.path().c_str()));
  EXPECT_FALSE(vtkAtriaVRMLReader::CanReadFile(nullptr));
}

} // namespace
