// SPDX-License-Identifier: GPL-3.0-or-later
/// Models others wrote, compared with what independent tools made of them (reference.csv in the corpus).
#include "VRMLModel.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using atria::testing::VRMLModel;

struct Reference
{
  double triangles = 0;
  double area = 0.0;
  std::vector<double> bounds; ///< as VTK orders them; empty without
  std::string note;
};

std::vector<std::string> splitRow(const std::string& line)
{
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line)
  {
    if (c == '"')
    {
      quoted = !quoted;
    }
    else if (c == ',' && !quoted)
    {
      cells.emplace_back();
    }
    else
    {
      cells.back() += c;
    }
  }
  return cells;
}

/// By file, then by the first word of the tool's name.
using References = std::map<std::string, std::map<std::string, Reference>>;

References readReferences(const fs::path& folder)
{
  References all;
  std::ifstream in(folder / "reference.csv");
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line))
  {
    const std::vector<std::string> cells = splitRow(line);
    if (cells.size() < 9)
    {
      continue;
    }
    auto& tools = all[cells[1]];
    if (cells[3] != "1")
    {
      continue;
    }
    Reference r;
    r.triangles = std::stod(cells[4]);
    r.area = std::stod(cells[5]);
    std::istringstream box(cells[6]);
    std::array<double, 6> b{};
    if (box >> b[0] >> b[1] >> b[2] >> b[3] >> b[4] >> b[5])
    {
      r.bounds = {b[0], b[3], b[1], b[4], b[2], b[5]};
    }
    r.note = cells[8];
    tools[cells[2].substr(0, cells[2].find_first_of("-("))] = r;
  }
  return all;
}

/// A unit cylinder, a cone's bottom, a unit cone and a cylinder's caps.
double conesArea() { return (10 + std::sqrt(5.0)) * std::numbers::pi; }

const std::vector<std::string> roundPrimitives{"Sphere", "Cone", "Cylinder", "Extrusion"};

/// Whether the Python evaluator, which measures polygons only, left something out that makes a surface.
bool leavesOutPrimitives(const Reference& reference)
{
  return std::any_of(roundPrimitives.begin(), roundPrimitives.end(), [&](const std::string& type) {
    return reference.note.find("'" + type + "'") != std::string::npos;
  });
}

/// Coin's own count of what comes from polygons, so that the rest can be told apart.
double polygonArea(const Reference& coin)
{
  const std::string key = "polygon-only tri=";
  const std::size_t at = coin.note.find(key);
  const std::size_t area = coin.note.find("area=", at);
  return at == std::string::npos || area == std::string::npos ? 0.0 : std::stod(coin.note.substr(area + 5));
}

/// What is expected of a file other than agreement with the references, and why.
struct Special
{
  double areaTolerance = 1e-3;
  std::optional<double> primitiveArea; ///< where no reference measures it
  bool sameBounds = true;
  std::string error; ///< part of the message, for files to refuse
};

const std::map<std::string, Special>& specials()
{
  const Special noSurface{0, {}, false, "holds no surfaces"};
  static const std::map<std::string, Special> all{
      // Text, lines, points or nothing.
      {"d26_lod.wrl", noSurface},
      {"d27_lines_only.wrl", noSurface},
      {"d28_empty_no_coords.wrl", noSurface},
      // Coin's area includes the text: four unit spheres, and cylinders and cones of half a unit and one
      // unit.
      {"d03_backface_culling.wrl", {1e-2, 16 * std::numbers::pi, true, ""}},
      {"d06_shape_hints_v1.wrl", {1e-2, 16 * std::numbers::pi, true, ""}},
      {"d04_cones_v97.wrl.gz", {1e-2, conesArea(), true, ""}},
      {"d04b_cones_gzip_plain_ext.wrl", {1e-2, conesArea(), true, ""}},
      {"d05_cones_v1.wrl", {1e-2, conesArea(), true, ""}},
      // Coin cannot read it: a unit sphere.
      {"d12_openvrml/ExternPROTO.wrl", {1e-2, 4 * std::numbers::pi, true, ""}},
      // Thousands of warped quads: the reference measures their projections.
      {"d09_nonplanar_quads_sci.wrl.gz", {5e-3, {}, true, ""}},
      {"d20_elevation_grid.wrl", {5e-3, {}, true, ""}},
      {"d10_forest_v1_crlf.wrl", {1e-2, {}, true, ""}},
      // The references' boxes include faces without area far off, of the kind 0 0 0 -1.
      {"d14_labo1/rack1.wrl", {1e-3, {}, false, ""}},
      {"d14_labo1/rack2.wrl", {1e-3, {}, false, ""}},
      {"d14_labo1/rack3.wrl", {1e-3, {}, false, ""}},
      {"d14_labo1/tank.wrl", {1e-3, {}, false, ""}},
  };
  return all;
}

Special specialOf(const std::string& file)
{
  const auto found = specials().find(file);
  return found == specials().end() ? Special{} : found->second;
}

/// Largest difference of two boxes as a part of the diagonal of the second.
double difference(const std::vector<double>& actual, const std::vector<double>& wanted)
{
  double most = 0.0;
  double diagonal = 0.0;
  for (std::size_t i = 0; i < 6; ++i)
  {
    most = std::max(most, std::abs(actual[i] - wanted[i]));
    diagonal += i % 2 ? std::pow(wanted[i] - wanted[i - 1], 2) : 0.0;
  }
  return most / std::sqrt(diagonal);
}

/// Agreement with the evaluator of polygons, and with Coin about primitives, which each tool tessellates its
/// own way.
void expectAgreement(const std::string& file, const VRMLModel& model, const std::map<std::string, Reference>& tools)
{
  constexpr double roundTolerance = 2e-2;
  constexpr double roundBounds = 5e-3;
  ASSERT_TRUE(tools.count("vrmlref"));
  const Reference& polygons = tools.at("vrmlref");
  const Special special = specialOf(file);
  const bool round = leavesOutPrimitives(polygons);
  double area = polygons.area;
  if (special.primitiveArea)
  {
    area += *special.primitiveArea;
  }
  else if (round)
  {
    ASSERT_TRUE(tools.count("Coin"));
    area += tools.at("Coin").area - polygonArea(tools.at("Coin"));
  }
  EXPECT_NEAR(model.area(), area, std::max(special.areaTolerance, round ? roundTolerance : 0.0) * area);
  if (special.sameBounds)
  {
    const std::vector<double> bounds = model.bounds();
    double least = difference(bounds, polygons.bounds);
    if (round && tools.count("Coin"))
    {
      least = std::min(least, difference(bounds, tools.at("Coin").bounds)); // the evaluator boxes primitives roughly
    }
    EXPECT_LT(least, round ? roundBounds : 1e-3);
  }
}

class VRMLCorpus : public ::testing::Test
{
protected:
  void SetUp() override
  {
    folder = atria::testing::corpusFolder();
    if (!folder)
    {
      GTEST_SKIP() << "no corpus";
    }
  }

  std::optional<fs::path> folder;
};

TEST_F(VRMLCorpus, AgreesWithOtherToolsOrRefusesClearly)
{
  const References references = readReferences(*folder);
  ASSERT_GT(references.size(), 30u);
  for (const auto& [file, tools] : references)
  {
    SCOPED_TRACE(file);
    atria::testing::VtkErrorGuard messages;
    const VRMLModel model(*folder / file);
    messages.takeWarnings(); // that there are any is the file's fault
    const std::vector<std::string> errors = messages.takeErrors();
    const Special special = specialOf(file);
    if (special.error.empty())
    {
      EXPECT_TRUE(errors.empty()) << atria::testing::joined(errors);
      ASSERT_GT(model.triangles(), 0);
      EXPECT_EQ(model.brokenPromise(), "");
      expectAgreement(file, model, tools);
    }
    else
    {
      EXPECT_EQ(model.triangles(), 0);
      EXPECT_NE(atria::testing::joined(errors).find(special.error), std::string::npos);
    }
  }
}

/// Whether the reader says that the walls are those of a model in another unit.
bool findsWallsTooLarge(const fs::path& file)
{
  atria::testing::VtkErrorGuard messages;
  const VRMLModel model(file, [](vtkAtriaVRMLReader& reader) {
    reader.SetLengthUnit(vtkAtriaVRMLReader::UnstatedUnit);
    reader.SetUpAxis(vtkAtriaVRMLReader::UnstatedUp);
  });
  messages.takeWarnings();
  messages.takeErrors();
  return atria::testing::joined(model.warnings()).find("m high and wide") != std::string::npos;
}

TEST_F(VRMLCorpus, WallsAreTooLargeInOtherUnitsOnly)
{
  for (const auto& [file, tools] : readReferences(*folder))
  {
    EXPECT_FALSE(findsWallsTooLarge(*folder / file)) << file;
  }
  const atria::testing::ScratchFolder scratch;
  for (const char* building : {"d01_castle_blender_v97.wrl", "d11_deranged_house_blender.wrl",
                               "d22_rotating_fan_room.wrl", "d23_rotterdam_lod2.wrl"})
  {
    const std::string inches = "#VRML V2.0 utf8\nTransform { scale 39.37 39.37 39.37 children Inline { url \"" +
                               (*folder / building).string() + "\" } }\n";
    EXPECT_TRUE(findsWallsTooLarge(atria::testing::writeFile(scratch.path(), "inches.wrl", inches))) << building;
  }
}

TEST_F(VRMLCorpus, ReadsSmallFilesOfAParsersTestSuiteWithoutSurfaces)
{
  std::size_t count = 0;
  for (const char* part : {"good", "bad"})
  {
    for (const auto& entry : fs::directory_iterator(*folder / "d12_openvrml" / "conformance" / part))
    {
      SCOPED_TRACE(entry.path());
      atria::testing::VtkErrorGuard messages;
      const VRMLModel model(entry.path());
      const bool anyWarning = !messages.takeWarnings().empty();
      const std::vector<std::string> errors = messages.takeErrors();
      EXPECT_NE(atria::testing::joined(errors).find("holds no surfaces"), std::string::npos);
      if (std::string(part) == "good")
      {
        const bool externalPrototype = entry.path().string().find("externproto") != std::string::npos;
        EXPECT_EQ(anyWarning, externalPrototype) << atria::testing::joined(model.warnings());
      }
      ++count;
    }
  }
  EXPECT_GT(count, 20u);
}

TEST_F(VRMLCorpus, ReadsOneModelAlikeInBothLanguages)
{
  atria::testing::VtkErrorGuard messages;
  const VRMLModel newer(*folder / "d01_castle_blender_v97.wrl");
  const VRMLModel older(*folder / "d02_castle_blender_v1.wrl");
  messages.takeWarnings();
  EXPECT_EQ(older.triangles(), newer.triangles());
  EXPECT_EQ(older.names().size(), newer.names().size());
  EXPECT_NEAR(older.area(), newer.area(), 1e-5 * newer.area());
  EXPECT_NEAR(older.volume(), newer.volume(), 1e-5 * std::abs(newer.volume()));
  EXPECT_LT(difference(older.bounds(), newer.bounds()), 1e-6);
}

TEST_F(VRMLCorpus, GivesTheSameTwice)
{
  for (const char* file : {"d01_castle_blender_v97.wrl", "d23_rotterdam_lod2.wrl"})
  {
    atria::testing::VtkErrorGuard messages;
    const VRMLModel first(*folder / file);
    const VRMLModel second(*folder / file);
    messages.takeWarnings();
    EXPECT_EQ(first.names(), second.names());
    EXPECT_EQ(first.area(), second.area());
  }
}

} // namespace
