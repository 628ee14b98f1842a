// SPDX-License-Identifier: GPL-3.0-or-later
/// DXF: blocks, meshes, what is thick, and damage.
#include "ExchangeModels.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace {

using atria::testing::ExchangeModels;
using atria::testing::replaced;
using atria::testing::sample;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A drawing in meters with these entities and blocks, a word or number a line.
std::string drawing(const std::string& entities, const std::string& blocks = "")
{
  std::string text = "0 SECTION 2 HEADER 9 $INSUNITS 70 6 0 ENDSEC 0 SECTION 2 BLOCKS " + blocks +
                     " 0 ENDSEC 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF ";
  std::replace(text.begin(), text.end(), ' ', '\n');
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == '\n' && b == '\n'; }), text.end());
  return text;
}

const std::string dxfSquare = "0 3DFACE 8 Wall 10 0 20 0 30 0 11 2 21 0 31 0 12 2 22 0 32 3 13 0 23 0 33 3 ";

TEST_F(ExchangeModels, DxfTextsMayBeginWithABrace)
{
  read("a.dxf", sample("dxf-mtext-brace.dxf"));
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()["HouseA"], 236.0, 1e-9);
  EXPECT_NEAR(areas()["HouseB"], 348.0, 1e-9);
}

TEST_F(ExchangeModels, DxfBlocksAreTurnedScaledRepeatedAndNested)
{
  const std::string blocks =
      "0 BLOCK 2 wall 10 1 20 0 30 0 " + replaced(dxfSquare, "Wall", "0") +
      "0 ENDBLK 0 BLOCK 2 ROOM 10 0 20 0 30 0 0 INSERT 8 0 2 WALL 10 5 20 0 30 0 50 90 0 ENDBLK ";
  read("a.dxf", drawing("0 INSERT 8 House 2 Room 10 100 20 0 30 0 41 2 42 3 43 4 ", blocks));
  EXPECT_EQ(error(), "");
  EXPECT_EQ(warned, "");
  EXPECT_THAT(names(), ElementsAre("House")) << "layer 0 of a block is that of its use";
  double bounds[6];
  reader->GetOutput()->GetBounds(bounds);
  const double expected[] = {110, 110, -3, 3, 0, 12}; // base 1; turned to y from -1 to 1 at x = 5; scaled
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-9) << i;
  }
  read("a.dxf", drawing("0 INSERT 8 House 2 Wall 10 0 20 0 30 0 70 3 71 2 44 10 45 20 ", blocks));
  EXPECT_NEAR(area(), 3 * 2 * 6.0, 1e-9);
  EXPECT_EQ(reader->GetOutput()->GetBounds()[1], 21.0);
  EXPECT_EQ(reader->GetOutput()->GetBounds()[3], 20.0);
  // From the other side: what is drawn with an extrusion direction of -z is mirrored.
  read("a.dxf", drawing("0 INSERT 8 House 2 Wall 10 7 20 0 30 0 210 0 220 0 230 -1 ", blocks));
  EXPECT_EQ(reader->GetOutput()->GetBounds()[0], -8.0);
  EXPECT_EQ(reader->GetOutput()->GetBounds()[4], -3.0);
  read("a.dxf", drawing(dxfSquare + "0 INSERT 8 House 2 Loop 10 0 20 0 30 0 0 INSERT 2 Absent 10 0 20 0 30 0 ",
                        "0 BLOCK 2 Loop 0 INSERT 2 Loop 10 0 20 0 30 0 0 ENDBLK "));
  EXPECT_EQ(triangles(), 2);
  EXPECT_THAT(warned, AllOf(HasSubstr("blocks are left out"), HasSubstr("1 Absent"), HasSubstr("1 Loop")));
}

TEST_F(ExchangeModels, DxfMeshesAndWhatIsThickAreSurfaces)
{
  const auto vertex = [](int flags, const std::string& rest) {
    return "0 VERTEX 8 M 70 " + std::to_string(flags) + " " + rest + " ";
  };
  const std::string corners = vertex(192, "10 0 20 0 30 0") + vertex(192, "10 4 20 0 30 0") +
                              vertex(192, "10 4 20 3 30 0") + vertex(192, "10 0 20 3 30 5");
  read("polyface.dxf", drawing("0 POLYLINE 8 M 66 1 70 64 71 4 72 2 " + corners +
                               vertex(128, "10 0 20 0 30 0 71 1 72 -2 73 3") + "0 SEQEND " + dxfSquare));
  EXPECT_EQ(warned, "");
  EXPECT_NEAR(areas()["M"], 6.0, 1e-9);
  EXPECT_NEAR(areas()["Wall"], 6.0, 1e-9) << "what follows";
  std::string points;
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      points += vertex(64, "10 " + std::to_string(2 * i) + " 20 " + std::to_string(3 * k) + " 30 1");
    }
  }
  read("grid.dxf", drawing("0 POLYLINE 8 M 66 1 70 16 71 3 72 4 " + points + "0 SEQEND "));
  EXPECT_NEAR(area(), 36.0, 1e-9);
  read("mesh.dxf", drawing("0 MESH 8 M 71 2 72 0 91 0 92 4 10 0 20 0 30 0 10 4 20 0 30 0 10 4 20 3 30 0 10 0 20 3 30 0 "
                           "93 5 90 4 90 0 90 1 90 2 90 3 94 1 90 0 90 1 95 1 140 0 "));
  EXPECT_NEAR(area(), 12.0, 1e-9);
  const std::string outline = "90 4 70 1 38 1 10 0 20 0 10 4 20 0 10 4 20 3 10 0 20 3 ";
  read("thick.dxf", drawing("0 LWPOLYLINE 8 P 39 2.5 " + outline + "0 LINE 8 L 39 -2 10 0 20 0 30 0 11 3 21 4 31 0 " +
                            "0 SOLID 8 S 39 2 10 0 20 0 11 4 21 0 12 0 22 3 13 4 23 3 " +
                            "0 LWPOLYLINE 8 Round 39 1 90 2 70 1 10 -1 20 0 42 1 10 1 20 0 42 1 "));
  EXPECT_EQ(warned, "");
  EXPECT_NEAR(areas()["P"], 14.0 * 2.5, 1e-9);
  EXPECT_NEAR(areas()["L"], 10.0, 1e-9);
  EXPECT_NEAR(areas()["S"], 2 * 12.0 + 14.0 * 2.0, 1e-9);
  EXPECT_NEAR(areas()["Round"], 36 * 2.0 * std::sin(std::acos(-1.0) / 36), 1e-9) << "half circles, of 18 chords each";
  read("flat.dxf", drawing(dxfSquare + "0 LWPOLYLINE 8 P " + outline + "0 3DSOLID 8 S 1 x 0 MTEXT 1 {x "));
  EXPECT_EQ(triangles(), 2);
  EXPECT_THAT(warned, AllOf(HasSubstr("solids are not read: 1 3DSOLID"), HasSubstr("1 LWPOLYLINE, 1 MTEXT")));
}

TEST_F(ExchangeModels, DxfGoesOnBehindDamage)
{
  read("a.dxf", drawing(dxfSquare + "0 3DFACE 8 Bad 10 x 20 0 30 0 " + dxfSquare));
  EXPECT_NEAR(area(), 12.0, 1e-9);
  EXPECT_THAT(warned, HasSubstr("1 entities and 0 lines are left out"));
  read("a.dxf", drawing(dxfSquare + "0 TEXT 1 one two words " + replaced(dxfSquare, "Wall", "Other")));
  EXPECT_THAT(names(), ElementsAre("Wall", "Other")) << "a line too many";
  read("a.dxf", "AutoCAD Binary DXF\r\n\x1a");
  EXPECT_THAT(error(), AllOf(HasSubstr("a.dxf"), HasSubstr("binary DXF")));
  read("a.dxf", "0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("a.dxf"), HasSubstr("has no ENTITIES")));
  read("a.dxf", replaced(drawing(dxfSquare), "Wall", "W\\U+00E4nde"));
  EXPECT_THAT(names(), ElementsAre("W\xc3\xa4nde"));
}

} // namespace
