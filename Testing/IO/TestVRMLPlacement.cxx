// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces that are there twice, units, axes and far-off models.
#include "VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace {

using atria::testing::joined;
using atria::testing::VRMLModel;
using atria::testing::writeFile;
using Names = std::vector<std::string>;

class VRMLPlacement : public atria::testing::VtkTest
{
protected:
  VRMLModel read(const std::string& text, const VRMLModel::Settings& settings)
  {
    return VRMLModel(writeFile(scratch.path(), "model.wrl", "#VRML V2.0 utf8\n" + text), settings);
  }
  VRMLModel merged(const std::string& text)
  {
    return read(text, [](vtkAtriaVRMLReader& reader) { reader.MergeDuplicateFacesOn(); });
  }
  /// The warnings of a model about whose unit and axis nothing is stated.
  std::string hints(const std::string& text)
  {
    const VRMLModel model = read(text, [](vtkAtriaVRMLReader& reader) {
      reader.SetUpAxis(vtkAtriaVRMLReader::UnstatedUp);
      reader.SetLengthUnit(vtkAtriaVRMLReader::UnstatedUnit);
    });
    messages.takeWarnings();
    return joined(model.warnings());
  }
  void expectBounds(const VRMLModel& model, const std::vector<double>& wanted, double tolerance = 1e-12)
  {
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      EXPECT_NEAR(model.bounds()[i], wanted[i], tolerance) << "bound " << i;
    }
  }

  atria::testing::ScratchFolder scratch;
};

std::string faceSet(const std::string& name, const std::string& points, const std::string& index)
{
  return "DEF " + name + " Shape { geometry IndexedFaceSet { coord Coordinate { point [" + points + "] } coordIndex [" +
         index + "] } }\n";
}

const std::string square = "0 0 0, 1 0 0, 1 1 0, 0 1 0";

std::string box(double x, double y, double z)
{
  std::ostringstream text;
  text << "Shape { geometry Box { size " << x << " " << y << " " << z << " } } ";
  return text.str();
}

TEST_F(VRMLPlacement, MergesTheBackOfASheetIntoItsFront)
{
  const VRMLModel model = merged(faceSet("Front", square, "0 1 2 3") + faceSet("Back", square, "3 2 1 0") +
                                 faceSet("Other", "5 0 0, 6 0 0, 6 1 0", "0 1 2"));
  EXPECT_EQ(model.names(), (Names{"Front", "Other"}));
  EXPECT_NEAR(model.area(), 1.5, 1e-12);
  ASSERT_EQ(model.notes().size(), 2u);
  EXPECT_NE(model.notes()[0].find("1 faces coincide with others and were merged with them, 1 of them facing"),
            std::string::npos)
      << model.notes()[0];
  EXPECT_NE(model.notes()[1].find("all faces of 'Back' coincide with those of others and are left out: 1 square meters "
                                  "with 'Front', which is as large and comes first"),
            std::string::npos)
      << model.notes()[1];
  EXPECT_TRUE(model.warnings().empty());
}

TEST_F(VRMLPlacement, LeavesTheSmallerSurfaceItsFacesWhateverTheOrder)
{
  const std::string building = faceSet("Building", square + ", 1 0 1, 1 1 1", "0 1 2 3 -1 1 4 5 2 -1");
  for (const char* corners : {"0 1 2 3", "3 2 1 0"}) // either side out
  {
    const std::string glass = faceSet("Glass", square, corners);
    for (const std::string& text : {building + glass, glass + building})
    {
      const VRMLModel model = merged(text);
      EXPECT_NEAR(model.area("Building"), 1.0, 1e-12);
      EXPECT_NEAR(model.area("Glass"), 1.0, 1e-12);
      ASSERT_EQ(model.notes().size(), 2u);
      EXPECT_NE(model.notes()[1].find("faces of 'Building' coincide with those of others and are left out: 1 square "
                                      "meters with 'Glass', which is smaller"),
                std::string::npos)
          << model.notes()[1];
      EXPECT_TRUE(model.warnings().empty());
    }
  }
}

TEST_F(VRMLPlacement, WarnsOfEqualSurfacesThatFaceTheSameWay)
{
  const VRMLModel model = merged(faceSet("A", square, "0 1 2 3") + faceSet("B", square, "1 2 3 0"));
  EXPECT_EQ(model.names(), (Names{"A"}));
  ASSERT_EQ(model.warnings().size(), 1u);
  EXPECT_NE(model.warnings()[0].find("'A' and 'B' have 1 square meters in common and neither is smaller"),
            std::string::npos)
      << model.warnings()[0];
  messages.takeWarnings("in common");
}

TEST_F(VRMLPlacement, NotesOfMergedFacesUseTheNamesOfTheTable)
{
  const auto wall = [](const std::string& material, const std::string& points) {
    return "Shape { appearance Appearance { material " + material +
           " } geometry IndexedFaceSet { coord Coordinate { point [" + points + "] } coordIndex [0 1 2 3] } }\n";
  };
  const VRMLModel model = merged(wall("DEF WALL Material { }", "0 0 0, 0 4 0, 0 4 3, 0 0 3") +
                                 wall("USE WALL", square) + wall("USE WALL", "0 1 0, 1 1 0, 1 0 0, 0 0 0"));
  ASSERT_EQ(model.names(), (Names{"WALL", "WALL_2"}));
  ASSERT_EQ(model.notes().size(), 2u);
  EXPECT_NE(model.notes()[1].find("all faces of 'WALL_3'"), std::string::npos) << model.notes()[1];
  EXPECT_NE(model.notes()[1].find("with 'WALL_2'"), std::string::npos) << model.notes()[1];
}

TEST_F(VRMLPlacement, KeepsDuplicatesWhereAsked)
{
  const std::string two = faceSet("Front", square, "0 1 2 3") + faceSet("Back", square, "3 2 1 0");
  const VRMLModel model = read(two, [](vtkAtriaVRMLReader& reader) { reader.MergeDuplicateFacesOff(); });
  EXPECT_EQ(model.names(), (Names{"Front", "Back"}));
  EXPECT_TRUE(model.notes().empty());
}

TEST_F(VRMLPlacement, MergesPolygonsWhoseCornersBeginElsewhere)
{
  const std::string star = "0 0 0, 2 1 0, 4 0 0, 3 2 0, 4 4 0, 2 3 0, 0 4 0, 1 2 0";
  EXPECT_NEAR(merged(faceSet("A", star, "0 1 2 3 4 5 6 7 -1 5 4 3 2 1 0 7 6 -1")).area(), 8.0, 1e-12);
}

TEST_F(VRMLPlacement, MergesTheTrianglesOfAPolygonThatStandElsewhere)
{
  EXPECT_NEAR(merged(faceSet("A", square, "0 1 2 -1 0 2 3 -1") + faceSet("B", square, "0 2 1 -1 3 2 0 -1")).area(), 1.0,
              1e-12);
}

TEST_F(VRMLPlacement, MergesWhatTransformsBringTogether)
{
  const std::string shape = faceSet("A", square, "0 1 2 3");
  const VRMLModel model =
      merged("Transform { scale 0.1 0.1 0.1 translation 0.3 0 0 children " + shape +
             "} Transform { scale 0.1 0.1 0.1 translation 0.1 0 0 children Transform { translation 2 0 "
             "0 children USE A } }");
  EXPECT_NEAR(model.area(), 0.01, 1e-12);
  messages.takeWarnings("'A' and 'A_2' have 0.01 square meters in common");
}

TEST_F(VRMLPlacement, LosesNothingFarFromTheOrigin)
{
  // A railing of bars that are two centimeters thick, and the same once more.
  std::string railing;
  for (int i = 0; i < 20; ++i)
  {
    railing += "Transform { translation " + std::to_string(0.12 * i) + " 0 0 children " + box(0.02, 0.02, 1.1) + " }\n";
  }
  const auto at = [](double far, const std::string& children) {
    std::ostringstream text;
    text << "Transform { translation " << std::setprecision(17) << far << ' ' << -2.0 * far << " 0 children ["
         << children << "] }\n";
    return text.str();
  };
  const double area = merged(at(0.0, railing)).area();
  for (const double far : {1e5, 1e7, 1e8})
  {
    SCOPED_TRACE(far);
    const VRMLModel once = merged(at(far, railing));
    EXPECT_EQ(once.triangles(), 20 * 12);
    EXPECT_NEAR(once.area(), area, 1e-5 * area);
    EXPECT_TRUE(once.notes().empty()) << joined(once.notes());
    EXPECT_EQ(merged(at(far, railing) + at(far, railing)).triangles(), 20 * 12) << "what is there twice is merged";
    messages.takeWarnings("Recenter");
  }
}

TEST_F(VRMLPlacement, KeepsFacesThatOnlyTouchOrOverlap)
{
  const std::string points = "0 0 0, 1 0 0, 1 1 0, 0 1 0, 0.00001 0 0";
  EXPECT_NEAR(merged(faceSet("A", points, "0 1 2 -1 0 2 3 -1 4 1 2 -1")).area(), 1.5, 1e-4);
  // The other two triangles of the same four points.
  EXPECT_NEAR(merged(faceSet("A", "0 0 0, 2 0 0, 2 2 0, 0.5 1 0", "0 1 2 -1 0 1 3 -1 1 2 3 -1")).area(), 4.5, 1e-12);
}

TEST_F(VRMLPlacement, TurnsModelsDrawnYUp)
{
  const VRMLModel model = read("Transform { translation 10 20 30 children " + box(2, 4, 6) + "}",
                               [](vtkAtriaVRMLReader& reader) { reader.SetUpAxis(vtkAtriaVRMLReader::YUp); });
  expectBounds(model, {9, 11, -33, -27, 18, 22});
  EXPECT_NEAR(model.volume(), 48.0, 1e-9);
}

TEST_F(VRMLPlacement, ConvertsUnits)
{
  for (const auto& [unit, meters] : std::vector<std::pair<int, double>>{{vtkAtriaVRMLReader::Meters, 1.0},
                                                                        {vtkAtriaVRMLReader::Millimeters, 0.001},
                                                                        {vtkAtriaVRMLReader::Centimeters, 0.01},
                                                                        {vtkAtriaVRMLReader::Inches, 0.0254},
                                                                        {vtkAtriaVRMLReader::Feet, 0.3048}})
  {
    const VRMLModel model = read(box(2, 4, 6), [&](vtkAtriaVRMLReader& reader) {
      reader.SetLengthUnit(unit);
      reader.SetScale(10.0);
    });
    expectBounds(model, {-10 * meters, 10 * meters, -20 * meters, 20 * meters, -30 * meters, 30 * meters});
  }
}

TEST_F(VRMLPlacement, MovesFarModelsToTheOriginAndSaysByHowMuch)
{
  const std::string far = "Transform { translation 92345.25 437012.5 3 children " + box(10, 10, 10) + "}";
  const VRMLModel moved = read(far, [](vtkAtriaVRMLReader& reader) { reader.RecenterOn(); });
  EXPECT_EQ(moved.numbers("ModelOffset"), (std::vector<double>{92300, 437000, 0}));
  expectBounds(moved, {40.25, 50.25, 7.5, 17.5, -2, 8}, 1e-9);
  const VRMLModel near = read("Transform { translation 7 0 0 children " + box(10, 10, 10) + "}",
                              [](vtkAtriaVRMLReader& reader) { reader.RecenterOn(); });
  EXPECT_EQ(near.numbers("ModelOffset"), (std::vector<double>{0, 0, 0}));
  expectBounds(near, {2, 12, -5, 5, -5, 5});
}

TEST_F(VRMLPlacement, HintsAtUnitsTheFileMentions)
{
  EXPECT_NE(hints("# Units: inches\n" + box(9, 9, 9)).find("mentions the unit 'inches'"), std::string::npos);
  EXPECT_NE(hints("# exported in mm by X\n" + box(9, 9, 9)).find("mentions the unit 'mm'"), std::string::npos);
  EXPECT_NE(hints("# units: millimetres\n" + box(9, 9, 9)).find("mentions the unit 'millimetres'"), std::string::npos);
  EXPECT_EQ(hints("# units = meters, SketchUp\n" + box(9, 9, 9)), "");
  EXPECT_EQ(hints("# units = metres, SketchUp\n" + box(9, 9, 9)), "");
  EXPECT_EQ(hints("# many units of housing\n" + box(9, 9, 9)), "");
}

TEST_F(VRMLPlacement, HintsAtSketchUpsInchesUnlessTheyWereConverted)
{
  EXPECT_NE(hints("# Exported by SketchUp\n" + box(400, 300, 200)).find("SketchUp, which writes inches"),
            std::string::npos);
  EXPECT_EQ(hints("DEF SketchUp Transform { scale 0.0254 0.0254 0.0254 children " + box(400, 300, 200) + "}"), "");
}

TEST_F(VRMLPlacement, HintsAtSizesNothingHas)
{
  EXPECT_NE(hints(box(12000, 9000, 8000)).find("would measure 1.2e+04 by 9e+03 by 8e+03 m"), std::string::npos);
  EXPECT_NE(hints(box(0.1, 0.1, 0.1)).find("less than anything with rooms"), std::string::npos);
  EXPECT_EQ(hints(box(12, 9, 8)), "");
  // A site of three kilometers with a tower.
  EXPECT_EQ(hints(box(3000, 3000, 1) + "Transform { translation 0 0 150 children " + box(60, 50, 300) + " }"), "");
}

/// A building that was drawn in meters, as another unit has it.
std::string scaled(const std::string& building, double scale)
{
  std::ostringstream text;
  text << "Transform { scale " << scale << ' ' << scale << ' ' << scale << " children Inline { url \""
       << (atria::testing::dataFolder().parent_path().parent_path() / "Examples" / "Data" / building).string()
       << "\" } }\n";
  return text.str();
}

TEST_F(VRMLPlacement, HintsAtBuildingsWhoseWallsAreTooLarge)
{
  for (const char* building : {"house.wrl", "building.wrl", "house_turned17.wrl", "building_turned17.wrl"})
  {
    SCOPED_TRACE(building);
    EXPECT_EQ(hints(scaled(building, 1.0)), "");
    EXPECT_EQ(hints(scaled(building, 1.0 / 0.3048)), "") << "feet cannot be told from meters";
    // 370 m high, which towers are, too.
    const std::string inches = hints(scaled(building, 1.0 / 0.0254));
    EXPECT_NE(inches.find("m high and wide, which inches (227 by 182 by 1"), std::string::npos) << inches;
    EXPECT_NE(inches.find("LengthUnit"), std::string::npos);
    EXPECT_NE(hints(scaled(building, 100.0)).find("centimeters (227 by 182 by 1"), std::string::npos);
    EXPECT_NE(hints(scaled(building, 1000.0)).find("millimeters (227 by 182 by 1"), std::string::npos);
  }
}

TEST_F(VRMLPlacement, TakesNoTowersGroundsOrMountainsForHousesInInches)
{
  std::string district = box(1500, 1500, 1);
  for (int i = 0; i < 9; ++i)
  {
    const double height = 60 + 40 * i;
    district += "Transform { translation " + std::to_string(150 * i - 600) + " 0 " + std::to_string(height / 2) +
                " children " + box(60, 45, height) + " }\n";
  }
  EXPECT_EQ(hints(district), "");
  EXPECT_EQ(hints(box(100, 1, 100) + box(5, 6, 5)), "") << "a lawn, drawn y up";
  std::string heights;
  for (int i = 0; i < 400; ++i)
  {
    heights += " " + std::to_string(150 + 150 * std::sin(i));
  }
  EXPECT_EQ(
      hints("Transform { rotation 1 0 0 1.5707963267948966 children Shape { geometry ElevationGrid { xDimension 20 "
            "zDimension 20 xSpacing 300 zSpacing 300 height [" +
            heights + "] } } }"),
      "");
}

TEST_F(VRMLPlacement, HintsAtTheAxisThatIsUp)
{
  const std::string site = box(100, 1, 100) + "Transform { translation 0 8 0 children " + box(20, 15, 30) + " }" +
                           "Transform { translation 30 8 0 children " + box(10, 15, 30) + " }";
  EXPECT_NE(hints(site).find("as if y were up"), std::string::npos);
  EXPECT_EQ(hints("Transform { rotation 1 0 0 1.5707963267948966 children [" + site + "] }"), "");
  // Ground that is a hundred times as large as all walls, and the same with z up.
  const std::string ground =
      "Shape { geometry IndexedFaceSet { coord Coordinate { point [-900 -1 -900, -900 -1 900, 900 -1 "
      "900, 900 -1 -900] } coordIndex [0 1 2 3] } }" +
      site;
  EXPECT_NE(hints(ground).find("as if y were up"), std::string::npos);
  EXPECT_EQ(hints("Transform { rotation 1 0 0 1.5707963267948966 children [" + ground + "] }"), "");
  EXPECT_NE(hints("# up axis: y\n" + box(9, 9, 9)).find("mentions that y is up"), std::string::npos);
}

TEST_F(VRMLPlacement, HintsAtNamesOfGroupsWhereShapesHaveNumbers)
{
  const auto group = [](const std::string& name, const std::string& shape, double x) {
    return "DEF " + name + " Transform { translation " + std::to_string(x) + " 0 0 children " +
           faceSet(shape, square, "0 1 2 3") + " }\n";
  };
  const std::string said = hints(group("Floor", "id1", 0) + group("Wall", "ID12", 3) + group("Wall", "id3", 6));
  EXPECT_NE(said.find("(Floor, Wall): take those (SurfaceBy Group)"), std::string::npos) << said;
  EXPECT_EQ(hints(group("Floor", "id1", 0) + group("Wall", "Brick", 3)), "") << "a name of its own";
  EXPECT_EQ(hints(group("id7", "id1", 0) + group("id8", "id2", 3)), "") << "groups have numbers, too";
  EXPECT_EQ(hints(group("House", "id1", 0) + group("House", "id2", 3)), "") << "one name says less than numbers";
  const VRMLModel model = read(group("Floor", "id1", 0) + group("Wall", "id2", 3),
                               [](vtkAtriaVRMLReader& reader) { reader.SetSurfaceByToGroup(); });
  EXPECT_TRUE(model.warnings().empty()) << joined(model.warnings());
}

TEST_F(VRMLPlacement, HintsAtModelsFarFromTheOrigin)
{
  EXPECT_NE(hints("Transform { translation 92345 437012 0 children " + box(10, 10, 10) + "}").find("Recenter"),
            std::string::npos);
}

TEST_F(VRMLPlacement, DoesNotHintAtWhatIsStated)
{
  const VRMLModel model =
      read("# SketchUp, y up\n" + box(90000, 1, 90000), [](vtkAtriaVRMLReader& reader) { reader.SetScale(0.5); });
  EXPECT_TRUE(model.warnings().empty()) << joined(model.warnings());
  expectBounds(model, {-22500, 22500, -0.25, 0.25, -22500, 22500});
}

TEST_F(VRMLPlacement, RefusesToScaleBeyondAllNumbers)
{
  EXPECT_EQ(read(box(1e305, 1, 1), [](vtkAtriaVRMLReader& reader) { reader.SetScale(1e9); }).triangles(), 0);
  EXPECT_NE(joined(messages.takeErrors()).find("check Scale"), std::string::npos);
}

} // namespace
