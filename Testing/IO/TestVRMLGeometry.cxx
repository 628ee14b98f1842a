// SPDX-License-Identifier: GPL-3.0-or-later
/// The reader's geometry nodes.
#include "VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <vtkPolyData.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using atria::testing::joined;
using atria::testing::VRMLModel;
using atria::testing::writeFile;
using std::numbers::pi;

class VRMLGeometry : public atria::testing::VtkTest
{
protected:
  /// A model of one geometry node.
  VRMLModel read(const std::string& geometry, double angle = 10.0)
  {
    const std::string text = "#VRML V2.0 utf8\nShape { geometry " + geometry + " }\n";
    return VRMLModel(writeFile(scratch.path(), "model.wrl", text), angle);
  }
  static std::string faces(const std::string& points, const std::string& index, const std::string& more = "")
  {
    return "IndexedFaceSet { coord Coordinate { point [" + points + "] } coordIndex [" + index + "] " + more + "}";
  }
  void expectBounds(const VRMLModel& model, const std::vector<double>& wanted)
  {
    const std::vector<double> actual = model.bounds();
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      EXPECT_NEAR(actual[i], wanted[i], 1e-12) << "bound " << i;
    }
  }

  atria::testing::ScratchFolder scratch;
};

const std::string square = "0 0 0, 1 0 0, 1 1 0, 0 1 0";

/// The sum of the fronts' z components; tells which way a flat surface looks.
double facing(const VRMLModel& model)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < model.output()->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    model.output()->GetCellPoints(i, count, ids);
    double p[3][3];
    for (int k = 0; k < 3; ++k)
    {
      model.output()->GetPoint(ids[k], p[k]);
    }
    sum += (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  }
  return sum / 2.0;
}

TEST_F(VRMLGeometry, MakesABox)
{
  const VRMLModel model = read("Box { size 2 3 4 }");
  EXPECT_EQ(model.triangles(), 12);
  EXPECT_EQ(model.output()->GetNumberOfPoints(), 8);
  EXPECT_NEAR(model.volume(), 24.0, 1e-12);
  expectBounds(model, {-1, 1, -1.5, 1.5, -2, 2});
}

TEST_F(VRMLGeometry, MakesClosedRoundSolidsThatConvergeToTheRealOnes)
{
  EXPECT_NEAR(read("Sphere { radius 2 }", 2).area(), 16 * pi, 0.03);
  EXPECT_NEAR(read("Sphere { radius 2 }", 2).volume(), 32 * pi / 3, 0.05);
  EXPECT_NEAR(read("Cylinder { radius 2 height 3 }", 2).volume(), 12 * pi, 0.03);
  EXPECT_NEAR(read("Cylinder { radius 2 height 3 }", 2).area(), 20 * pi, 0.05);
  EXPECT_NEAR(read("Cone { bottomRadius 2 height 3 }", 2).volume(), 4 * pi, 0.01);
  EXPECT_NEAR(read("Cone { bottomRadius 2 height 3 }", 2).area(), 4 * pi + 2 * pi * std::sqrt(13.0), 0.03);
}

TEST_F(VRMLGeometry, TessellatesByTheAngleAskedFor)
{
  EXPECT_EQ(read("Cylinder { bottom FALSE top FALSE }", 10).triangles(), 72);
  EXPECT_EQ(read("Cylinder { bottom FALSE top FALSE }", 7).triangles(), 104);
  EXPECT_EQ(read("Cone { bottom FALSE }", 90).triangles(), 4);
  expectBounds(read("Sphere {}", 10), {-1, 1, -1, 1, -1, 1});
}

/// Points around the middle of a cylinder or cone, or of a sphere.
int pointsAround(const VRMLModel& model, double height)
{
  int count = 0;
  for (vtkIdType i = 0; i < model.output()->GetNumberOfPoints(); ++i)
  {
    count += std::abs(model.output()->GetPoint(i)[1] - height) < 1e-9 ? 1 : 0;
  }
  return count;
}

/// The greatest distance of facets of a ball about the origin from its surface.
double errorOfBall(const VRMLModel& model, double radius)
{
  double worst = 0.0;
  for (vtkIdType i = 0; i < model.triangles(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    model.output()->GetCellPoints(i, count, ids);
    Eigen::Vector3d p[3];
    for (int k = 0; k < 3; ++k)
    {
      model.output()->GetPoint(ids[k], p[k].data());
    }
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    worst = std::max(worst, radius - std::abs(normal.dot(p[0])));
  }
  return worst;
}

TEST_F(VRMLGeometry, TakesAsManyPointsAroundAsTheErrorAllowsNoMore)
{
  const auto readWith = [&](const std::string& geometry, double error, double unit = 1.0) {
    return VRMLModel(
        writeFile(scratch.path(), "round.wrl",
                  "#VRML V2.0 utf8\nTransform { scale 2 2 2 children Shape { geometry " + geometry + " } }\n"),
        [&](vtkAtriaVRMLReader& reader) {
          reader.SetTessellationAngle(90.0);
          reader.SetTessellationError(error);
          reader.SetScale(unit);
        });
  };
  for (const double error : {0.5, 0.1, 0.01, 0.001, 1e-4})
  {
    const double radius = 3.0 * 2.0;
    const auto sagitta = [&](int points) { return radius * (1.0 - std::cos(pi / points)); };
    for (const char* solid : {"Cylinder { radius 3 height 2 bottom FALSE }", "Cone { bottomRadius 3 height 2 }"})
    {
      const int points = pointsAround(readWith(solid, error), -2.0);
      EXPECT_LE(sagitta(points), error * (1.0 + 1e-9)) << solid << error;
      EXPECT_TRUE(points == 4 || sagitta(points - 1) > error) << solid << error << ' ' << points;
    }
    const double ofBall = errorOfBall(readWith("Sphere { radius 3 }", error), radius);
    EXPECT_LE(ofBall, error * (1.0 + 1e-9));
    EXPECT_GT(ofBall, 0.2 * error);
  }
  // In meters, whatever the file's unit.
  EXPECT_EQ(pointsAround(readWith("Cone { bottomRadius 3000 height 2000 }", 0.01, 0.001), -2.0),
            pointsAround(readWith("Cone { bottomRadius 3 height 2 }", 0.01), -2.0));
  EXPECT_EQ(pointsAround(readWith("Cone { bottom FALSE }", 1e-300), -2.0), 3600);
}

TEST_F(VRMLGeometry, TakesPointsForTheLargestUseOfARoundSolid)
{
  const VRMLModel model(
      writeFile(scratch.path(), "uses.wrl",
                "#VRML V2.0 utf8\nShape { geometry DEF C Cone {} }\nTransform { scale 1 1 40 children Shape { "
                "geometry USE C } }\n"),
      [&](vtkAtriaVRMLReader& reader) { reader.SetTessellationError(0.1); });
  const auto names = model.names();
  ASSERT_EQ(names.size(), 2u);
  EXPECT_NEAR(model.area(names[0]), pi * (1 + std::sqrt(5.0)), 0.1);
  // As an ellipse of 1 by 40; its chords are nowhere further than 0.1 from it.
  EXPECT_EQ(model.triangles(), 2 * 36 - 2 + 2 * 45 - 2);
}

TEST_F(VRMLGeometry, TakesFewPointsForRoundSolidsThatAreSmallInTheModel)
{
  std::string balls;
  for (int i = 0; i < 200; ++i)
  {
    balls += "Transform { translation " + std::to_string(i) + " 0 0 children " +
             (i == 0 ? "DEF Ball Shape { geometry Sphere { radius 0.02 } }" : "USE Ball") + " }\n";
  }
  const auto readWith = [&](const std::string& more, double error = 0.0) {
    return VRMLModel(writeFile(scratch.path(), "small.wrl", "#VRML V2.0 utf8\n" + balls + more),
                     [&](vtkAtriaVRMLReader& reader) { reader.SetTessellationError(error); });
  };
  const VRMLModel model = readWith("");
  EXPECT_EQ(model.brokenPromise(), "");
  EXPECT_LE(model.triangles(), 200 * 80) << "not 1224 for each";
  EXPECT_GE(model.triangles(), 200 * 6 * 4);
  for (int axis = 1; axis < 3; ++axis)
  {
    EXPECT_NEAR(model.output()->GetBounds()[2 * axis + 1], 0.02, 0.002 + 1e-5 * 200);
  }
  const auto names = model.names();
  ASSERT_EQ(names.size(), 200u);
  EXPECT_NEAR(model.area(names[100]), 4 * pi * 0.02 * 0.02, 0.25 * 4 * pi * 0.02 * 0.02);
  // One that is large has what the angle asks for, also among small ones, and each keeps its place in the file.
  const VRMLModel mixed = readWith("Shape { geometry Cylinder { radius 30 } }\nShape { geometry Box {} }\n" + balls);
  EXPECT_EQ(mixed.brokenPromise(), "");
  EXPECT_EQ(mixed.triangles(), 2 * model.triangles() + 2 * 36 + 2 * 34 + 12);
  EXPECT_EQ(mixed.names().size(), 402u);
  // An error that is asked for holds.
  EXPECT_GT(readWith("", 1e-6).triangles(), 200 * 1224);
}

TEST_F(VRMLGeometry, LeavesOutPartsSwitchedOff)
{
  const double disc = 36.0 / 2.0 * std::sin(2 * pi / 36);
  EXPECT_NEAR(read("Cylinder { side FALSE top FALSE }").area(), disc, 1e-12);
  EXPECT_NEAR(read("Cylinder { side FALSE bottom FALSE }").area(), disc, 1e-12);
  EXPECT_NEAR(read("Cone { side FALSE }").area(), disc, 1e-12);
}

TEST_F(VRMLGeometry, SharesPointsAsTheFileDoesAndDropsUnusedOnes)
{
  const VRMLModel model = read(faces(square + ", 9 9 9", "0 1 2 -1 0 2 3 -1"));
  EXPECT_EQ(model.output()->GetNumberOfPoints(), 4);
  EXPECT_EQ(model.triangles(), 2);
}

TEST_F(VRMLGeometry, KeepsDoublePrecision)
{
  const VRMLModel model =
      read(faces("2600123.4567890123 1200987.654321 0, 2600124 1200987 0, 2600124 1200988 0", "0 1 2"));
  EXPECT_EQ(model.output()->GetPoint(0)[0], 2600123.4567890123);
  EXPECT_EQ(messages.takeWarnings().size(), 1u); // the hint at its distance
}

TEST_F(VRMLGeometry, TurnsClockwiseFaces)
{
  EXPECT_NEAR(facing(read(faces(square, "0 1 2 3 -1"))), 1.0, 1e-12);
  EXPECT_NEAR(facing(read(faces(square, "0 1 2 3 -1", "ccw FALSE"))), -1.0, 1e-12);
}

TEST_F(VRMLGeometry, TriangulatesConcaveFacesWhateverTheFileSays)
{
  const std::string arrow = "0 0 0, 4 0 0, 4 4 0, 2 1 0, 0 4 0";
  EXPECT_NEAR(read(faces(arrow, "0 1 2 3 4 -1")).area(), 10.0, 1e-12);
  EXPECT_NEAR(read(faces(arrow, "0 1 2 3 4 -1", "convex FALSE solid FALSE")).area(), 10.0, 1e-12);
}

TEST_F(VRMLGeometry, ReadsTheLastFaceWithoutItsEndAndCommasAnywhere)
{
  EXPECT_EQ(read(faces(square, ",0,1,2,,-1,\n0 2 3")).triangles(), 2);
}

TEST_F(VRMLGeometry, WarnsOfFacesThatCannotBe)
{
  const VRMLModel model = read(faces(square, "0 1 2 -1 0 1 9 -1 0 0 0 -1 -1 0 2 2 3 -1 1 2 -1"));
  EXPECT_EQ(model.triangles(), 2);
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  ASSERT_EQ(model.warnings().size(), 1u);
  EXPECT_EQ(model.warnings()[0], "model.wrl:2:18: IndexedFaceSet: 1 face with points that do not exist, "
                                 "skipped; 1 face with a point repeated in a row, "
                                 "taken once; 2 faces without area, skipped");
}

TEST_F(VRMLGeometry, ANumberBeyondAllIndicesCostsItsFace)
{
  const VRMLModel model = read(faces(square, "0 1 2 -1 0 2 99999999999 -1 0 2 3 -99999999999 1 2 3 -1"));
  EXPECT_EQ(model.triangles(), 3);
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  ASSERT_EQ(model.warnings().size(), 1u);
  EXPECT_EQ(model.warnings()[0], "model.wrl:2:18: IndexedFaceSet: 1 face with points that do not exist, skipped");
}

TEST_F(VRMLGeometry, WarnsOfSizesThatAreNotPositive)
{
  for (const char* geometry : {"Box { size 1 0 0 }", "Box { size 1 0 -1 }", "Sphere { radius -1 }", "Cone { height 0 }",
                               "Cylinder { radius 0 }"})
  {
    const VRMLModel model = read(geometry);
    EXPECT_EQ(model.triangles(), 0);
    EXPECT_NE(joined(model.warnings()).find("a size is not positive"), std::string::npos) << geometry;
    messages.takeWarnings();
    messages.takeErrors();
  }
}

TEST_F(VRMLGeometry, MakesASheetOfABoxWithoutThickness)
{
  const VRMLModel model = read("Box { size 4 0 3 }");
  EXPECT_EQ(model.triangles(), 4); // from both sides
  EXPECT_DOUBLE_EQ(model.area(), 24.0);
  EXPECT_EQ(model.bounds(), (std::vector<double>{-2, 2, 0, 0, -1.5, 1.5}));
  EXPECT_NE(joined(model.warnings()).find("taken as a sheet"), std::string::npos);
  messages.takeWarnings();
}

TEST_F(VRMLGeometry, MakesAnElevationGridThatLooksUp)
{
  const std::string grid = "ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 zSpacing 5 height [0 1 0, 0 1 0] ";
  const VRMLModel model = read(grid + "}");
  EXPECT_EQ(model.triangles(), 4);
  expectBounds(model, {0, 4, 0, 1, 0, 5});
  EXPECT_NEAR(model.area(), 2 * 5 * std::sqrt(5.0), 1e-12);
  EXPECT_GT(read("ElevationGrid { xDimension 2 zDimension 2 height [1 1 1 1] }").volume(), 0.0);
  EXPECT_LT(read("ElevationGrid { xDimension 2 zDimension 2 height [1 1 1 1] ccw FALSE }").volume(), 0.0);
}

TEST_F(VRMLGeometry, RefusesAnElevationGridThatLacksHeights)
{
  const VRMLModel model = read("ElevationGrid { xDimension 3 zDimension 2 height [0 1 0] }");
  EXPECT_EQ(model.triangles(), 0);
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
  EXPECT_FALSE(messages.takeErrors().empty());
}

TEST_F(VRMLGeometry, MakesTheDefaultExtrusion)
{
  const VRMLModel model = read("Extrusion {}");
  EXPECT_EQ(model.triangles(), 12);
  EXPECT_EQ(model.output()->GetNumberOfPoints(), 8);
  EXPECT_NEAR(model.volume(), 4.0, 1e-12);
  expectBounds(model, {-1, 1, 0, 1, -1, 1});
  EXPECT_NEAR(read("Extrusion { ccw FALSE }").volume(), -4.0, 1e-12);
  EXPECT_EQ(read("Extrusion { beginCap FALSE endCap FALSE }").triangles(), 8);
}

TEST_F(VRMLGeometry, ExtrudesConcaveSectionsAlongABend)
{
  const std::string section = "crossSection [1 1, 1 -1, 0 0, -1 -1, -1 1, 1 1]";
  EXPECT_NEAR(read("Extrusion {" + section + "}").volume(), 3.0, 1e-12);
  // A pipe with a mitred right angle keeps the volume of its center line.
  const VRMLModel pipe = read("Extrusion { spine [0 0 0, 0 5 0, 5 5 0] scale [1 1, 1 1, 1 1] }");
  EXPECT_GT(pipe.volume(), 30.0);
  EXPECT_LT(pipe.volume(), 41.0);
}

TEST_F(VRMLGeometry, ScalesAndTurnsSectionsOfAnExtrusion)
{
  const VRMLModel tip = read("Extrusion { spine [0 0 0, 0 3 0] scale [1 1, 0 0] }");
  EXPECT_NEAR(tip.volume(), 4.0, 1e-12);
  EXPECT_NEAR(read("Extrusion { orientation 0 1 0 0.78539816339744831 }").bounds()[1], std::sqrt(2.0), 1e-12);
}

/// The standard: a cross-section is scaled, in x and then in z, then turned by the orientation, then placed at the
/// spine.
TEST_F(VRMLGeometry, ScalesSectionsBeforeItTurnsThem)
{
  const std::string section = "crossSection [1 1, 1 -1, -1 -1, -1 1, 1 1] spine [0 0 0, 0 2 0] scale [1 1, 2 0.5] ";
  const double caps = 4.0 + 4.0;
  const double exact = 3.0 * std::sqrt(5.0) + 3.0 * std::sqrt(17.0) + caps;
  // Turned alike at both ends: trapezoids, the upper rectangle 1 long in x and 4 in z.
  const VRMLModel even = read("Extrusion {" + section + "orientation 0 1 0 1.5707963267948966 }");
  expectBounds(even, {-1, 1, 0, 2, -2, 2});
  EXPECT_NEAR(even.area(), exact, 1e-12);
  EXPECT_NEAR(even.volume(), 26.0 / 3.0, 1e-12); // of a prismatoid
  // Turned above alone: (x, z) = (1, 1), (1, -1), (-1, -1), (-1, 1) go to (2 x, z / 2), and these to (z / 2, -2 x).
  const VRMLModel twisted = read("Extrusion {" + section + "orientation [0 1 0 0, 0 1 0 1.5707963267948966] }");
  expectBounds(twisted, {-1, 1, 0, 2, -2, 2});
  ASSERT_EQ(twisted.output()->GetNumberOfPoints(), 8);
  const Eigen::Vector3d wanted[8] = {{1, 0, 1},   {1, 0, -1},   {-1, 0, -1}, {-1, 0, 1},
                                     {.5, 2, -2}, {-.5, 2, -2}, {-.5, 2, 2}, {.5, 2, 2}};
  for (Eigen::Vector3d p : wanted)
  {
    const double* const found = twisted.output()->GetPoint(twisted.output()->FindPoint(p.data()));
    EXPECT_NEAR((Eigen::Map<const Eigen::Vector3d>(found) - p).norm(), 0.0, 1e-12);
  }
  // Its sides are no planes, and the standard leaves open which diagonal cuts them. Across the shorter ones their
  // triangles have twice sqrt(17) / 2 + sqrt(5) / 2 and twice sqrt(5) + sqrt(17); across the others 23 + 3 sqrt(13) in
  // all.
  EXPECT_NEAR(twisted.area(), exact, 1e-12);
}

TEST_F(VRMLGeometry, JoinsTheEndsOfAClosedSpineWithoutCaps)
{
  const VRMLModel ring = read("Extrusion { crossSection [.1 .1, .1 -.1, -.1 -.1, -.1 .1, .1 .1]"
                              " spine [2 0 0, 0 0 -2, -2 0 0, 0 0 2, 2 0 0] }");
  EXPECT_EQ(ring.triangles(), 4 * 4 * 2);
  EXPECT_GT(ring.volume(), 0.0);
}

TEST_F(VRMLGeometry, WarnsOfGeometryOutsideOfAShape)
{
  const VRMLModel model(writeFile(scratch.path(), "model.wrl", "#VRML V2.0 utf8\nDEF Loose Box {}"));
  EXPECT_EQ(model.names(), std::vector<std::string>{"Loose"});
  EXPECT_EQ(messages.takeWarnings().size(), 1u);
}

} // namespace
