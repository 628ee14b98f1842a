// SPDX-License-Identifier: GPL-3.0-or-later
/// The reader against Coin, a reader that others wrote, on our models, odd ones included, and those of the corpus:
/// surfaces, names, triangles, bounds and area. Where they disagree, a table says why, and the test that they still do.
#include "CoinScene.h"
#include "VRMLModel.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace {

namespace fs = std::filesystem;
using atria::testing::CoinScene;
using atria::testing::VRMLModel;

/// How Coin's result differs from ours.
enum class Difference
{
  None,
  Refuses,   ///< Coin reads nothing, and says why
  Ignores,   ///< Coin reads nothing, and says nothing
  Crashes,   ///< Coin does
  Lacks,     ///< Coin reads less
  More,      ///< Coin makes surfaces of what is none
  Memory,    ///< Coin takes points beyond the last from wherever they would be: nothing it says can be compared
  Flat,      ///< some of our triangles have no area, and those of Coin are not counted then
  Fans,      ///< Coin cuts concave polygons into fans from their first corner, which reach outside: more area
  Diagonals, ///< warped or almost flat quads are cut along the other diagonal: area to 2e-3, a triangle in a thousand
  Twisted    ///< as before, and all of the few quads are twisted so much that Coin's way gives more area
};

struct Disagreement
{
  Difference difference;
  const char* why;
};

/// By the file's path in the corpus or in the repository.
const std::map<std::string, Disagreement>& disagreements()
{
  const char* const missingHeader = "a file to be inlined has no header, which Coin insists on";
  const char* const beginning = "Coin insists on a header, at the very beginning, and on a comment behind it";
  const char* const beyond = "indices beyond the last point; we leave these faces out";
  const char* const cycle = "files that inline each other";
  const char* const mistake = "Coin gives up at a mistake that costs us the node it is in, or the number";
  static const std::map<std::string, Disagreement> all{
      {"d05_cones_v1.wrl", {Difference::Refuses, "Coin gives up at a field that its node does not have"}},
      {"d07_extrusion_concave_cap.wrl", {Difference::Fans, "caps are concave, and convex is FALSE"}},
      {"d09_nonplanar_quads_sci.wrl.gz", {Difference::Diagonals, "40,000 warped quads, some with hardly any area"}},
      {"d10_forest_v1_crlf.wrl", {Difference::Refuses, "Coin gives up at a field that its node does not have"}},
      {"d12_openvrml/ExternPROTO.wrl", {Difference::Refuses, "Coin does not try the second URL of an EXTERNPROTO"}},
      {"d15_pa10_inline/base.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/hand.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/hand_l.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/hand_r.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/j1.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/j2.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/j3.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/j4.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/j5.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/j6.wrl", {Difference::Refuses, missingHeader}},
      {"d15_pa10_inline/pa10.main.wrl", {Difference::Refuses, "it inlines the files without a header"}},
      {"d18_non_convex_face.wrl", {Difference::Fans, "one concave face, and convex is FALSE"}},
      {"d18c_concave_text.wrl", {Difference::Fans, "letters as concave polygons"}},
      {"d18d_concave_v1.wrl", {Difference::Fans, "one concave face of UNKNOWN_FACE_TYPE"}},
      {"d20_elevation_grid.wrl", {Difference::Refuses, "Coin does not know ColorRGBA, a node of X3D"}},
      {"d25_switch_odd_fields.wrl", {Difference::Refuses, "Coin gives up at the fields that a Switch does not have"}},
      {"d29_missing_header.wrl", {Difference::Refuses, "Coin insists on a header"}},
      {"parts/towers.wrl", {Difference::Lacks, "Coin does not try the second URL of an Inline"}},
      {"prototypes.wrl", {Difference::Refuses, "Coin does not try the second URL of an EXTERNPROTO"}},
      {"site.wrl", {Difference::Lacks, "Coin takes a URL with backslashes and other case literally"}},
      {"odd/bom.wrl", {Difference::Refuses, beginning}},
      {"odd/head4.wrl", {Difference::Refuses, beginning}},
      {"odd/header_space.wrl", {Difference::Refuses, beginning}},
      {"odd/no_header.wrl", {Difference::Refuses, beginning}},
      {"odd/x3dv.wrl", {Difference::Refuses, "Coin does not know the header of X3D"}},
      {"odd/box_neg.wrl",
       {Difference::More, "Coin draws a Box of negative size, which is not allowed; we leave it out with a warning"}},
      {"odd/decimal_comma.wrl", {Difference::Memory, beyond}},
      {"odd/dup_and_degen.wrl", {Difference::Memory, beyond}},
      {"odd/huge_hex.wrl", {Difference::Memory, "an index of 40 bits"}},
      {"odd/empty_fields.wrl", {Difference::Refuses, "Coin does not take NULL for a list of children"}},
      {"odd/extern_missing.wrl", {Difference::Refuses, "Coin gives up where a prototype cannot be found"}},
      {"odd/extern_self.wrl", {Difference::Crashes, "a prototype that is looked for in its own file"}},
      {"odd/externproto.wrl", {Difference::Refuses, "Coin does not try the second URL of an EXTERNPROTO"}},
      {"odd/extr_scale.wrl",
       {Difference::Twisted, "the sides of an Extrusion that turns are no planes; TestVRMLGeometry has their area"}},
      {"odd/inline_a.wrl", {Difference::Crashes, cycle}},
      {"odd/inline_b.wrl", {Difference::Crashes, cycle}},
      {"odd/inline_backslash.wrl", {Difference::Refuses, "Coin takes a URL with backslashes and other case literally"}},
      {"odd/inline_space.wrl", {Difference::Refuses, "Coin does not try the second URL of an Inline, or one with %20"}},
      {"odd/inventor.wrl",
       {Difference::More, "Coin is a reader of Inventor, whose FaceSet VRML 1.0 does not have; we warn of it"}},
      {"odd/is_eventin.wrl", {Difference::Ignores, "Coin makes nothing of a prototype with a ROUTE within"}},
      {"odd/lod_children.wrl", {Difference::Refuses, "Coin does not know LOD with children, as X3D has it"}},
      {"odd/lower_true.wrl", {Difference::Refuses, "Coin wants TRUE in capital letters, as the standard has it"}},
      {"odd/missing_brace_deep.wrl", {Difference::Refuses, mistake}},
      {"odd/names.wrl", {Difference::Refuses, "Coin does not take all names that the standard allows"}},
      {"odd/nan.wrl", {Difference::Refuses, mistake}},
      {"odd/number_forms.wrl", {Difference::Refuses, "Coin does not take all forms of numbers"}},
      {"odd/nurbs.wrl", {Difference::Refuses, "Coin knows a NurbsSurface with other fields"}},
      {"odd/proto_first_only.wrl",
       {Difference::More, "a prototype stands for its first node alone; Coin draws the others, too"}},
      {"odd/scale0.wrl", {Difference::Flat, "a square scaled to a line"}},
      {"odd/self_proto.wrl", {Difference::Crashes, "a prototype within itself"}},
      {"odd/semi.wrl", {Difference::Refuses, mistake}},
      {"odd/unterminated_string.wrl", {Difference::Refuses, mistake}},
      {"odd/use_before_def.wrl",
       {Difference::Refuses, "Coin gives up at a USE whose DEF comes later; we use it, with a warning"}},
      {"odd/use_in_own_def.wrl", {Difference::Crashes, "a USE within what it stands for"}},
      {"odd/v1_ascii_strings.wrl", {Difference::Refuses, "Coin does not take all names that the standard allows"}},
      {"odd/v1_in_v2.wrl", {Difference::Crashes, "nodes of VRML 1.0 in a file of VRML97"}},
      {"odd/v1_matrix_rows.wrl", {Difference::Crashes, "an index without a material, which is bound by index"}},
      {"odd/v1_wwwinline.wrl", {Difference::Lacks, "Coin leaves it to the program to fetch a WWWInline"}},
      {"odd/v2_in_v1.wrl", {Difference::Refuses, "nodes of VRML97 in a file of VRML 1.0"}},
  };
  return all;
}

/// Every model under the folders, by its path in them.
std::map<std::string, fs::path> models()
{
  const fs::path data = atria::testing::dataFolder();
  std::vector<fs::path> folders{data / "VRML", data.parent_path().parent_path() / "Examples" / "Data"};
  if (const auto corpus = atria::testing::corpusFolder())
  {
    folders.push_back(*corpus);
  }
  std::map<std::string, fs::path> files;
  for (const fs::path& folder : folders)
  {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
    {
      const std::string path = entry.path().lexically_relative(folder).string();
      // Files to test parsers and damaged ones hold nothing to compare.
      const bool apart = path.find("conformance") != path.npos || path.find("damaged") != path.npos;
      if (entry.is_regular_file() && path.find(".wr") != path.npos && !apart)
      {
        files[files.count(path) ? "Examples/" + path : path] = entry.path();
      }
    }
  }
  return files;
}

/// The surfaces called `name`, with another's group ahead or a number behind where it repeats.
std::size_t countOf(const std::vector<std::string>& names, const std::string& name)
{
  return static_cast<std::size_t>(std::count_if(names.begin(), names.end(), [&](const std::string& full) {
    const std::string own = full.substr(full.rfind('/') + 1);
    const auto isDigit = [](unsigned char c) { return std::isdigit(c) != 0; };
    return own == name || (own.size() > name.size() + 1 && own.compare(0, name.size() + 1, name + "_") == 0 &&
                           std::all_of(own.begin() + static_cast<long>(name.size()) + 1, own.end(), isDigit));
  }));
}

void expectSameNames(const VRMLModel& model, const CoinScene& coin)
{
  const std::vector<std::string> names = model.names();
  EXPECT_EQ(names.size(), coin.shapes.size());
  std::map<std::string, std::size_t> wanted;
  for (const auto& shape : coin.shapes)
  {
    ++wanted[shape.name];
  }
  wanted.erase(""); // we call these by their material, which Coin does not
  for (const auto& [name, count] : wanted)
  {
    EXPECT_GE(countOf(names, name), count) << name;
  }
}

void expectSameBounds(const VRMLModel& model, const CoinScene& coin, double tolerance)
{
  const std::vector<double> bounds = model.bounds();
  ASSERT_EQ(coin.bounds.size(), bounds.size());
  double size = 0.0;
  for (std::size_t i = 0; i < 6; ++i)
  {
    size = std::max({size, std::abs(bounds[i]), bounds[i | 1] - bounds[i & ~std::size_t{1}]});
  }
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], coin.bounds[i], tolerance * size) << "bound " << i;
  }
}

void expectDifference(Difference difference, const VRMLModel& model, const CoinScene& coin)
{
  const auto triangles = static_cast<double>(model.triangles());
  const double area = model.area();
  switch (difference)
  {
    case Difference::None:
      if (coin.hasRound())
      {
        EXPECT_NEAR(coin.area(), area, 2e-2 * area);
      }
      else
      {
        EXPECT_EQ(coin.triangles(), triangles);
        EXPECT_NEAR(coin.area(), area, 1e-6 * area); // of single precision
      }
      break;
    case Difference::Refuses:
      EXPECT_EQ(coin.triangles(), 0u);
      EXPECT_FALSE(coin.errors.empty());
      return;
    case Difference::Ignores:
      EXPECT_EQ(coin.triangles(), 0u);
      EXPECT_TRUE(coin.errors.empty());
      return;
    case Difference::Crashes:
      EXPECT_TRUE(coin.crashed);
      return;
    case Difference::Lacks:
      EXPECT_LT(coin.triangles(), triangles);
      return;
    case Difference::More:
      EXPECT_GT(coin.shapes.size(), model.names().size());
      EXPECT_GT(coin.triangles(), triangles);
      return;
    case Difference::Memory:
      return;
    case Difference::Flat:
      EXPECT_LT(coin.triangles(), triangles);
      EXPECT_NEAR(coin.area(), area, 1e-6 * area);
      return;
    case Difference::Twisted:
      EXPECT_EQ(coin.triangles(), triangles);
      EXPECT_GT(coin.area(), 1.05 * area);
      break;
    case Difference::Fans:
      EXPECT_EQ(coin.triangles(), triangles);
      EXPECT_GT(coin.area(), 1.05 * area);
      break;
    case Difference::Diagonals:
      EXPECT_NE(coin.triangles(), triangles);
      EXPECT_NEAR(coin.triangles(), triangles, 1e-3 * triangles);
      EXPECT_NEAR(coin.area(), area, 2e-3 * area);
  }
  expectSameNames(model, coin);
  expectSameBounds(model, coin, coin.hasRound() ? 1e-2 : 1e-6);
}

TEST(VRMLCoin, ReadsTheSame)
{
  std::set<std::string> unseen;
  for (const auto& [path, disagreement] : disagreements())
  {
    unseen.insert(path);
  }
  for (const auto& [path, file] : models())
  {
    SCOPED_TRACE(path);
    atria::testing::VtkErrorGuard messages;
    const VRMLModel model(file);
    const std::string warnings = atria::testing::joined(messages.takeWarnings()); // the file's fault
    const std::string errors = atria::testing::joined(messages.takeErrors());
    const CoinScene coin = atria::testing::readWithCoin(file);
    unseen.erase(path);
    if (!errors.empty())
    {
      const bool isOther = errors.find("UTF-16") != errors.npos;
      EXPECT_TRUE(isOther || errors.find("holds no surfaces") != errors.npos) << errors;
      EXPECT_EQ(coin.triangles(), 0u);
      continue;
    }
    const auto known = disagreements().find(path);
    const bool isKnownToCrash = known != disagreements().end() && known->second.difference == Difference::Crashes;
    if (coin.crashed && !isKnownToCrash && ATRIA_COIN_VERSION != std::string("4.0.0"))
    {
      // What crashes is known of 4.0.0. Coin 4.0.7 also ends at indices that are out of range.
      EXPECT_NE(warnings, "");
      continue;
    }
    EXPECT_EQ(coin.crashed, isKnownToCrash);
    const Disagreement expected = known == disagreements().end() ? Disagreement{Difference::None, ""} : known->second;
    SCOPED_TRACE(expected.why);
    expectDifference(expected.difference, model, coin);
  }
  if (atria::testing::corpusFolder())
  {
    EXPECT_TRUE(unseen.empty()) << "no longer there: " << *unseen.begin();
  }
}

} // namespace
