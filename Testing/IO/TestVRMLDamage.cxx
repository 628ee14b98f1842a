// SPDX-License-Identifier: GPL-3.0-or-later
/// Files as they should not be: encodings, slips of syntax, damage, other languages.
#include "VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/ProgressWatch.h"
#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

namespace fs = std::filesystem;
using atria::testing::joined;
using atria::testing::ProgressWatch;
using atria::testing::VRMLModel;
using Names = std::vector<std::string>;

class VRMLDamage : public atria::testing::VtkTest
{
protected:
  VRMLModel readText(const std::string& text)
  {
    return VRMLModel(atria::testing::writeFile(scratch.path(), "model.wrl", text));
  }
  VRMLModel read(const std::string& body) { return readText("#VRML V2.0 utf8\n" + body); }

  /// Reads a file that must give exactly one warning, which contains `text`.
  VRMLModel readWithWarning(const std::string& body, const std::string& text)
  {
    VRMLModel model = read(body);
    EXPECT_EQ(messages.takeWarnings().size(), 1u) << body;
    EXPECT_EQ(model.warnings().size(), 1u) << joined(model.warnings());
    EXPECT_NE(joined(model.warnings()).find(text), std::string::npos) << joined(model.warnings());
    return model;
  }

  std::string errorOf(const std::string& text)
  {
    EXPECT_EQ(readText(text).triangles(), 0);
    messages.takeWarnings();
    const Names errors = messages.takeErrors();
    return errors.empty() ? "no error" : errors[0];
  }

  atria::testing::ScratchFolder scratch;
};

const std::string box = "Shape { geometry Box {} }";

TEST_F(VRMLDamage, ReadsGzipWhateverTheName)
{
  const VRMLModel plain(atria::testing::dataFolder() / "VRML" / "house.wrl");
  const VRMLModel packed(atria::testing::dataFolder() / "VRML" / "house.wrz");
  EXPECT_EQ(plain.names(), packed.names());
  EXPECT_EQ(plain.area(), packed.area());
}

TEST_F(VRMLDamage, ReadsATruncatedGzipAsFarAsItGoes)
{
  const std::string bytes = atria::testing::bytesOf(atria::testing::dataFolder() / "VRML" / "house.wrz");
  const VRMLModel model = readText(bytes.substr(0, bytes.size() - 60));
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  EXPECT_NE(joined(model.warnings()).find("damaged or ends early"), std::string::npos);
}

TEST_F(VRMLDamage, ReadsAllLineEndsAndAByteOrderMark)
{
  for (const std::string end : {"\n", "\r\n", "\r"})
  {
    std::string text = "\xef\xbb\xbf#VRML V2.0 utf8|# a comment { [|DEF A # name|Shape {|geometry Box {}|}|Unknown {}";
    for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i))
    {
      text.replace(i, 1, end);
    }
    const VRMLModel model = readText(text);
    EXPECT_EQ(model.names(), Names{"A"});
    ASSERT_EQ(model.warnings().size(), 1u);
    EXPECT_EQ(model.warnings()[0], "model.wrl:7:1: unknown node 'Unknown' is skipped");
    messages.takeWarnings();
  }
}

TEST_F(VRMLDamage, RecodesNamesThatAreNotUtf8)
{
  EXPECT_EQ(read("DEF Geb\xe4ude " + box).names(), Names{"Geb\xc3\xa4ude"});
  EXPECT_EQ(read("DEF Geb\xc3\xa4ude " + box).names(), Names{"Geb\xc3\xa4ude"});
}

TEST_F(VRMLDamage, TakesNamesThatExportersWrite)
{
  for (const char* name : {"SketchUp/group_0/ID12", "2nd.floor", "-a", "$x$_0", "a'b"})
  {
    EXPECT_EQ(read("DEF " + std::string(name) + " " + box).names(), Names{name});
  }
}

TEST_F(VRMLDamage, WarnsOfAMissingHeader)
{
  const VRMLModel model = readText(box);
  EXPECT_EQ(model.triangles(), 12);
  EXPECT_NE(joined(model.warnings()).find("model.wrl:1: the first line is not '#VRML V2.0 utf8'"), std::string::npos);
  messages.takeWarnings();
}

TEST_F(VRMLDamage, RefusesWhatItCannotRead)
{
  EXPECT_NE(errorOf(std::string("\x7f"
                                "ELF\0\0\0",
                                7))
                .find("not a VRML file"),
            std::string::npos);
  EXPECT_NE(errorOf("\xff\xfe#").find("UTF-16"), std::string::npos);
  VRMLModel missing(scratch.path() / "missing.wrl");
  const Names errors = messages.takeErrors();
  ASSERT_FALSE(errors.empty());
  EXPECT_NE(errors[0].find("does not exist"), std::string::npos);
}

TEST_F(VRMLDamage, SaysWhatAFileWithoutSurfacesHolds)
{
  EXPECT_NE(errorOf("#VRML V2.0 utf8\n").find("holds no surfaces: it is empty"), std::string::npos);
  EXPECT_NE(errorOf("").find("holds no surfaces: it is empty"), std::string::npos);
  EXPECT_NE(errorOf("#VRML V2.0 utf8\nShape { geometry IndexedLineSet {} } Viewpoint {} Shape { geometry PointSet {} }")
                .find("it holds IndexedLineSet: 1, PointSet: 1, Viewpoint: 1"),
            std::string::npos);
  EXPECT_NE(errorOf("#VRML V2.0 utf8\nShape { geometry IndexedFaceSet {} }").find("IndexedFaceSet without faces: 1"),
            std::string::npos);
}

TEST_F(VRMLDamage, NeedsAFileName)
{
  vtkNew<vtkAtriaVRMLReader> reader;
  reader->Update();
  EXPECT_NE(joined(messages.takeErrors()).find("FileName is not set"), std::string::npos);
}

TEST_F(VRMLDamage, LosesOnlyTheNodeASyntaxErrorIsIn)
{
  const std::string bad = "Shape { geometry Box { size 1 x 1 } }\n";
  const VRMLModel model =
      readWithWarning("DEF A " + box + "\n" + bad + "DEF B " + box,
                      "model.wrl:3:31: expected 3 numbers for the field size, found 'x'; this Box is left out");
  EXPECT_EQ(model.names(), (Names{"A", "B"}));
}

TEST_F(VRMLDamage, LosesOnlyTheFacesWhoseArrayIsDamaged)
{
  const std::string faces =
      "IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 ? 2 -1] ccw FALSE }";
  const VRMLModel model =
      readWithWarning("Transform { translation 1 0 0 children [ Shape { geometry " + faces + " } DEF B " + box + "] }",
                      "expected a whole number or ']' for the field coordIndex, found '?'");
  EXPECT_EQ(model.names(), Names{"B"});
}

TEST_F(VRMLDamage, LosesOnlyTheFaceWhoseIndexIsTooLarge)
{
  const std::string faces = "IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0, 1 1 0] } "
                            "coordIndex [0 1 2 -1 1 3 2 -1 0 1 999999999 -1] }";
  const VRMLModel model = readWithWarning("DEF Wall Shape { geometry " + faces + " }", "points that do not exist");
  EXPECT_EQ(model.names(), Names{"Wall"});
  EXPECT_EQ(model.triangles(), 2);
}

TEST_F(VRMLDamage, UnderstandsNodesWithoutTheWordChildren)
{
  EXPECT_EQ(
      readWithWarning("Transform { translation 0 0 9 [ " + box + box + "] }", "taken as its children").triangles(), 24);
  EXPECT_EQ(readWithWarning("Transform { translation 0 0 9 " + box + "}", "taken as its child").triangles(), 12);
  EXPECT_EQ(readWithWarning("Shape { Box {} }", "taken as its geometry").triangles(), 12);
}

TEST_F(VRMLDamage, UnderstandsADoubledDef)
{
  const VRMLModel model = readWithWarning("DEF A DEF B " + box + " USE A USE B", "found a second DEF");
  EXPECT_EQ(model.triangles(), 36);
}

TEST_F(VRMLDamage, UnderstandsClosingBracketsThatAreMissingOrTooMany)
{
  readWithWarning("Group { children [ " + box + " ] } } " + box, "found '}'");
  readWithWarning("Group { children [ " + box + " ] ] } " + box, "found ']'");
  EXPECT_EQ(readWithWarning("Group { children [ " + box + " } " + box, "expected a node or ']', found '}'").triangles(),
            24);
  EXPECT_EQ(readWithWarning("Group { children [ Shape { geometry Box {} ] } " + box, "found ']'").triangles(), 24);
  EXPECT_EQ(readWithWarning("Transform { children [ " + box + " translation 1 0 0 } " + box, "found 'translation'")
                .triangles(),
            24);
}

TEST_F(VRMLDamage, KeepsWhatStandsBeforeAnEarlyEnd)
{
  const VRMLModel model = readWithWarning(box + "\nGroup { children [ " + box,
                                          "the file ends within the list of nodes that begins in line 3");
  EXPECT_EQ(model.triangles(), 24);
}

TEST_F(VRMLDamage, SkipsUnknownNodesAndFieldsButReadsNodesInThem)
{
  const VRMLModel model =
      readWithWarning("HAnim { joints [ DEF A " + box + " ] name \"x\" size 1 2 on TRUE more [1 2] look Foo {} } USE A",
                      "model.wrl:2:1: unknown node 'HAnim' is skipped");
  EXPECT_EQ(model.triangles(), 12);
  EXPECT_EQ(readWithWarning("Group { colors 1 0 0 children " + box + "}", "Group has no field 'colors'").triangles(),
            12);
}

TEST_F(VRMLDamage, ReadsTheChildrenOfUnknownNodes)
{
  const VRMLModel model = read("DEF Hall StaticGroup { children [ DEF A " + box + box + " ] bboxSize 1 1 1 }");
  EXPECT_EQ(model.names(), (Names{"A", "Hall"}));
  EXPECT_NE(joined(model.warnings()).find("its children are read as those of a Group"), std::string::npos);
  messages.takeWarnings();
}

TEST_F(VRMLDamage, TellsPlacesInAFileOfOneLine)
{
  std::string text = "#VRML V2.0 utf8\r";
  for (int i = 0; i < 3; ++i)
  {
    text += box + " Group { colors 1 } ";
  }
  const VRMLModel model = readText(text);
  ASSERT_EQ(model.warnings().size(), 3u);
  EXPECT_EQ(model.warnings()[0], "model.wrl:2:35: Group has no field 'colors'");
  EXPECT_EQ(model.warnings()[1], "model.wrl:2:80: Group has no field 'colors'");
  EXPECT_EQ(model.warnings()[2], "model.wrl:2:125: Group has no field 'colors'");
  messages.takeWarnings();
}

/// The reader lets go of the text behind it.
TEST_F(VRMLDamage, TellsPlacesFarIntoAFile)
{
  constexpr int fillers = 40;
  const std::string filler = "WorldInfo { info \"" + std::string(1 << 20, 'x') + "\" }";
  for (const std::string end : {"\n", "\r\n", "\r", " "})
  {
    std::string text = "#VRML V2.0 utf8\n";
    for (int i = 0; i < fillers; ++i)
    {
      text += filler + end;
    }
    text += "Group { colors 1 }" + end + box + end + " Group { colors 2 }";
    const VRMLModel model = readText(text);
    ASSERT_EQ(model.warnings().size(), 2u);
    const bool oneLine = end == " ";
    const std::size_t before = oneLine ? fillers * (filler.size() + 1) : 0;
    const std::size_t between = oneLine ? before + box.size() + 21 : 1;
    const auto place = [&](int lines, std::size_t column) {
      const int line = 2 + (oneLine ? 0 : fillers + lines);
      return "model.wrl:" + std::to_string(line) + ":" + std::to_string(column) + ": Group has no field 'colors'";
    };
    EXPECT_EQ(model.warnings()[0], place(0, before + 9));
    EXPECT_EQ(model.warnings()[1], place(2, between + 9));
    messages.takeWarnings();
  }
}

TEST_F(VRMLDamage, ReadsMegabytesOnOneLine)
{
  std::string points;
  std::string faces;
  constexpr int count = 200'000;
  for (int i = 0; i < count; ++i)
  {
    const std::string x = std::to_string(i);
    points += x + " 0 0," + x + " 1 0," + x + ".5 1 0,";
    faces += std::to_string(3 * i) + "," + std::to_string(3 * i + 1) + "," + std::to_string(3 * i + 2) + ",-1,";
  }
  const VRMLModel model = read("Shape{geometry IndexedFaceSet{coord Coordinate{point[" + points + "]}coordIndex[" +
                               faces + "]}}Odd{}DEF B " + box);
  EXPECT_EQ(model.triangles(), count + 12);
  EXPECT_NEAR(model.area("Shape"), 0.25 * count, 1e-6 * count);
  messages.takeWarnings(); // of the unknown node, at the end of the line
}

TEST_F(VRMLDamage, WarnsOfNamesNobodyDefined)
{
  EXPECT_EQ(readWithWarning(box + "\nUSE Nobody", "model.wrl:3:11: USE of 'Nobody'").triangles(), 12);
}

TEST_F(VRMLDamage, SkipsScriptsRoutesAndSensors)
{
  const VRMLModel model = read("DEF S Script { url \"javascript: {[\" field SFNode me USE S eventIn SFBool "
                               "go field MFString t [\"a\" \"}\"]"
                               " directOutput TRUE } DEF T TimeSensor { cycleInterval 3 loop TRUE } "
                               "ROUTE T.fraction_changed TO S.go ROUTE T . x TO S . go " +
                               box);
  EXPECT_EQ(model.triangles(), 12);
  EXPECT_EQ(model.skipped(), (Names{"ROUTE: 2", "Script: 1", "TimeSensor: 1"}));
}

TEST_F(VRMLDamage, CapsTheWarningsItShows)
{
  std::string body = box;
  for (int i = 0; i < 3000; ++i)
  {
    body += "\nUSE Nobody";
  }
  const VRMLModel model = read(body);
  EXPECT_EQ(model.warnings().size(), 1000u);
  const Names shown = messages.takeWarnings();
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_LT(shown[0].size(), 3000u);
  EXPECT_NE(shown[0].find("and 999 more like it"), std::string::npos) << shown[0];
  EXPECT_NE(shown[0].find("and 2000 more"), std::string::npos) << "those that were not kept";
}

TEST_F(VRMLDamage, ForgetsWarningsOfTheRunBefore)
{
  vtkNew<vtkAtriaVRMLReader> reader;
  const fs::path bad = atria::testing::writeFile(scratch.path(), "bad.wrl", "#VRML V2.0 utf8\nOdd {} " + box);
  const fs::path good = atria::testing::writeFile(scratch.path(), "good.wrl", "#VRML V2.0 utf8\n" + box);
  reader->SetFileName(bad.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetNumberOfWarnings(), 1);
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  reader->SetFileName(good.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetNumberOfWarnings(), 0);
}

TEST_F(VRMLDamage, StopsWhenAskedAndLeavesTheOutputEmpty)
{
  std::string body;
  for (int i = 0; i < 20'000; ++i)
  {
    body += box + "\n";
  }
  const fs::path file = atria::testing::writeFile(scratch.path(), "big.wrl", "#VRML V2.0 utf8\n" + body);
  vtkNew<vtkAtriaVRMLReader> reader;
  const ProgressWatch watch(reader, [](double, const std::string&) { return true; });
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
}

TEST_F(VRMLDamage, ReportsProgressThatNeverFalls)
{
  vtkNew<vtkAtriaVRMLReader> reader;
  const ProgressWatch watch(reader);
  reader->SetFileName((atria::testing::dataFolder() / "VRML" / "site.wrl").c_str());
  reader->SetUpAxisToY(); // which the model leaves open
  reader->Update();
  const std::vector<double>& seen = watch.fractions;
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end() - 1));
}

} // namespace
