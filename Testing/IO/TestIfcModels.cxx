// SPDX-License-Identifier: GPL-3.0-or-later
/// IFC: what assimp cannot read as it is, and what is left out.
#include "ExchangeModels.h"

#include <gmock/gmock.h>

#include <cmath>

#ifdef ATRIA_WITH_ASSIMP

namespace {

using atria::testing::ExchangeModels;
using atria::testing::houseAs;
using atria::testing::replaced;
using atria::testing::sample;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

std::string ifcOfWall() { return sample("ifc-opening-extruded-upward.ifc"); }
const char* const ifcWall = "IfcWallStandardCase_Wall";

TEST_F(ExchangeModels, IfcOpeningsMayBeExtrudedAlongTheWall)
{
  read("a.ifc", ifcOfWall());
  EXPECT_EQ(error(), "");
  EXPECT_EQ(warned, "");
  EXPECT_NEAR(areas()[ifcWall], 39.96, 1e-4) << "with the reveal";
  // The rectangle the other way round, as a polyline, and from above.
  const std::string profile = "IFCRECTANGLEPROFILEDEF(.AREA.,$,#29,1.2000,0.5000)";
  const std::string solid = "IFCEXTRUDEDAREASOLID(#30,#32,#2,1.2000)";
  std::string other = replaced(ifcOfWall(), profile, "IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#50)");
  other = replaced(other, "ENDSEC;\nEND-",
                   "#50=IFCPOLYLINE((#51,#52,#53,#54,#51));\n#51=IFCCARTESIANPOINT((0.6,-0.25));\n"
                   "#52=IFCCARTESIANPOINT((0.6,0.25));\n#53=IFCCARTESIANPOINT((-0.6,0.25));\n"
                   "#54=IFCCARTESIANPOINT((-0.6,-0.25));\n#55=IFCDIRECTION((0.,0.,-1.));\nENDSEC;\nEND-");
  other =
      replaced(replaced(other, solid, "IFCEXTRUDEDAREASOLID(#30,#32,#55,1.2000)"), "0.0000,0.8000", "0.0000,2.0000");
  read("a.ifc", other);
  EXPECT_EQ(warned, "");
  EXPECT_NEAR(areas()[ifcWall], 39.96, 1e-4);
}

TEST_F(ExchangeModels, IfcNamesElementsThatAreNotClosed)
{
  // A triangle from below is no box, and assimp leaves the wall open.
  std::string open = replaced(ifcOfWall(), "IFCRECTANGLEPROFILEDEF(.AREA.,$,#29,1.2000,0.5000)",
                              "IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#50)");
  open = replaced(open, "ENDSEC;\nEND-",
                  "#50=IFCPOLYLINE((#51,#52,#53,#51));\n#51=IFCCARTESIANPOINT((-0.6,-0.25));\n"
                  "#52=IFCCARTESIANPOINT((0.6,-0.25));\n#53=IFCCARTESIANPOINT((0.,0.9));\nENDSEC;\nEND-");
  read("a.ifc", open);
  EXPECT_EQ(error(), "");
  EXPECT_THAT(warned,
              AllOf(HasSubstr("a.ifc"), HasSubstr("1 element is not closed"), HasSubstr("'IfcWallStandardCase_Wall'")));
}

TEST_F(ExchangeModels, IfcElementsThatAssimpDoesNotKnowAreRead)
{
  read("a.ifc", sample("ifc4-furniture.ifc"));
  EXPECT_EQ(error(), "");
  EXPECT_THAT(names(), UnorderedElementsAre(ifcWall, "IfcFurniture_Table"));
  EXPECT_NEAR(areas()[ifcWall], 41.4, 1e-4);
  EXPECT_NEAR(areas()["IfcFurniture_Table"], 6.0, 1e-4);
  // Special cases that IFC 4 has other names for.
  read("a.ifc", replaced(sample("ifc4-furniture.ifc"), "IFCFURNITURE", "IFCSLABSTANDARDCASE"));
  EXPECT_NEAR(areas()["IfcSlab_Table"], 6.0, 1e-4);
  // Owners, styles without assignment and placements that are left out.
  std::string lean = replaced(sample("ifc4-furniture.ifc"), "#27=IFCWALLSTANDARDCASE('0000000000000000000006',#12",
                              "#27=IFCWALLSTANDARDCASE('0000000000000000000006',$");
  lean = replaced(lean, "IFCEXTRUDEDAREASOLID(#21,#23,#2", "IFCEXTRUDEDAREASOLID(#21,$,#2");
  lean = replaced(lean, "ENDSEC;\nEND-",
                  "#60=IFCSTYLEDITEM(#24,(#61),$);\n#61=IFCSURFACESTYLE('Brick',.BOTH.,(#62));\n"
                  "#62=IFCSURFACESTYLESHADING(#63,0.);\n#63=IFCCOLOURRGB($,1.,0.,0.);\nENDSEC;\nEND-");
  read("a.ifc", lean);
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()[ifcWall], 41.4, 1e-4);
}

TEST_F(ExchangeModels, IfcFaceSetsAndIndexedCurvesAreRead)
{
  const std::string table = replaced(sample("ifc4-furniture.ifc"), "IFCFURNITURE", "IFCBUILDINGELEMENTPROXY");
  const std::string solid = "#33=IFCEXTRUDEDAREASOLID(#30,#32,#2,1.0000)";
  const std::string end = "ENDSEC;\nEND-";
  const std::string points = "#90=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(2.,0.,0.),(2.,1.,0.),(0.,1.,0.),(0.,0.,1.),"
                             "(2.,0.,1.),(2.,1.,1.),(0.,1.,1.),(2.,0.25,0.25),(2.,0.25,0.75),(2.,0.75,0.75),"
                             "(2.,0.75,0.25)));\n";
  const char* const proxy = "IfcBuildingElementProxy_Table";
  read("a.ifc", replaced(replaced(table, solid,
                                  "#33=IFCTRIANGULATEDFACESET(#90,$,.T.,((1,3,2),(1,4,3),(5,6,7),(5,7,8),(1,2,6),"
                                  "(1,6,5),(2,3,7),(2,7,6),(3,4,8),(3,8,7),(4,1,5),(4,5,8)),$)"),
                         end, points + end));
  EXPECT_EQ(error(), "");
  EXPECT_THAT(warned, Not(HasSubstr("left out, as"))) << "all of it";
  EXPECT_NEAR(areas()[proxy], 10.0, 1e-4);
  read("a.ifc", replaced(replaced(table, solid, "#33=IFCPOLYGONALFACESET(#90,.F.,(#91,#92,#93,#94),$)"), end,
                         points +
                             "#91=IFCINDEXEDPOLYGONALFACE((1,4,3,2));\n#92=IFCINDEXEDPOLYGONALFACE((5,6,7,8));\n"
                             "#93=IFCINDEXEDPOLYGONALFACE((1,2,6,5));\n"
                             "#94=IFCINDEXEDPOLYGONALFACEWITHVOIDS((2,3,7,6),((9,10,11,12)));\n" +
                             end));
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()[proxy], 6.75, 1e-4) << "with a hole";
  // Half a disc.
  read("a.ifc",
       replaced(replaced(table, "IFCRECTANGLEPROFILEDEF(.AREA.,$,#29,1.0000,1.0000)",
                         "IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#95)"),
                end,
                "#95=IFCINDEXEDPOLYCURVE(#96,(IFCLINEINDEX((1,2)),IFCARCINDEX((2,3,4)),IFCLINEINDEX((4,1))),.F.);\n"
                "#96=IFCCARTESIANPOINTLIST2D(((-1.,0.),(1.,0.),(0.,1.),(-1.,0.)));\n" +
                    end));
  EXPECT_EQ(error(), "");
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(areas()[proxy], pi + 2.0 + pi, 0.01 * (2 * pi + 2));
}

TEST_F(ExchangeModels, IfcElementsThatAssimpFailsOnAreLeftOutByName)
{
  // A number where a point should be, in one of two shapes.
  read("a.ifc", replaced(replaced(sample("ifc4-furniture.ifc"), "IFCFURNITURE", "IFCBUILDINGELEMENTPROXY"),
                         "#31=IFCCARTESIANPOINT((3.0000,2.0000,0.0000))", "#31=IFCCARTESIANPOINT(.T.)"));
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()[ifcWall], 41.4, 1e-4);
  EXPECT_THAT(warned, AllOf(HasSubstr("1 element is left out, as assimp fails"),
                            HasSubstr("'IfcBuildingElementProxy_Table'"), HasSubstr("IFC4")));
  // The one element of a file.
  read("a.ifc", replaced(ifcOfWall(), "IFCEXTRUDEDAREASOLID", "IFCFIXEDREFERENCESWEPTAREASOLID"));
  EXPECT_THAT(error(), AllOf(HasSubstr("a.ifc"), HasSubstr("as the warnings say"), Not(HasSubstr("empty"))));
  EXPECT_THAT(warned, HasSubstr("left out"));
}

TEST_F(ExchangeModels, IfcValuesThatAreOptionalInIfc4MayBeMissing)
{
  // As programs write sites, buildings, storeys and spaces.
  const std::string end = "ENDSEC;\nEND-";
  const std::string space = "#80=IFCSPACE('0000000000000000000080',#12,'Room',$,$,#14,$,$,$,.SPACE.,$);\n"
                            "#81=IFCRELAGGREGATES('0000000000000000000081',#12,$,$,#13,(#80));\n";
  std::string lean = replaced(sample("ifc4-furniture.ifc"), end, space + end);
  for (std::size_t at = lean.find(".ELEMENT."); at != lean.npos; at = lean.find(".ELEMENT."))
  {
    lean.replace(at, 9, "$");
  }
  read("a.ifc", lean);
  EXPECT_EQ(error(), "");
  EXPECT_THAT(names(), UnorderedElementsAre(ifcWall, "IfcFurniture_Table"));
  EXPECT_NEAR(areas()[ifcWall], 41.4, 1e-4);
}

TEST_F(ExchangeModels, IfcBuildingsMayBeBesideTheSite)
{
  const std::string site = "#70=IFCSITE('0000000000000000000070',#12,'Land',$,$,#14,$,$,.ELEMENT.,$,$,$,$,$);\n"
                           "#71=IFCRELAGGREGATES('0000000000000000000071',#12,$,$,#13,(#70));\n";
  read("a.ifc", replaced(ifcOfWall(), "ENDSEC;\nEND-", site + "ENDSEC;\nEND-"));
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()[ifcWall], 39.96, 1e-4);
  // Nor need an element be anywhere.
  read("a.ifc", replaced(ifcOfWall(),
                         "#38=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000009',#12,$,$,(#27),#16);\n", ""));
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()[ifcWall], 39.96, 1e-4);
}

TEST_F(ExchangeModels, IfcUnitsOfConversionAreMeters)
{
  read("a.ifc", replaced(replaced(ifcOfWall(), "#6=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)",
                                  "#6=IFCCONVERSIONBASEDUNIT(#80,.LENGTHUNIT.,'foot',#81)"),
                         "ENDSEC;\nEND-",
                         "#80=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);\n"
                         "#81=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(304.8),#82);\n"
                         "#82=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\nENDSEC;\nEND-"));
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(height(), 3.0 * 0.3048, 1e-6);
}

TEST_F(ExchangeModels, IfcKeepsClassesNamesAndStoreys)
{
  read("house.ifc", houseAs("ifc"));
  EXPECT_EQ(error(), "");
  EXPECT_EQ(warned, "");
  EXPECT_THAT(names(), UnorderedElementsAre("IfcWall_Front", "IfcWall_Back", "IfcSlab_Floor", "IfcRoof_Roof",
                                            "IfcBuildingStorey_Groundfloor/IfcWall_Gable",
                                            "IfcBuildingStorey_Attic/IfcWall_Gable"));
  double bounds[6];
  reader->GetOutput()->GetBounds(bounds);
  const double expected[] = {0, 8, 0, 6, 0, 6}; // of millimeters, with z up
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-5);
  }
  read("house.ifc", replaced(houseAs("ifc"), "IFC2X3", "IFC4"));
  EXPECT_THAT(warned, AllOf(HasSubstr("house.ifc"), HasSubstr("IFC4")));
}

} // namespace

#endif
