// SPDX-License-Identifier: GPL-3.0-or-later
/// The reader against Coin, a reader that others wrote, on our models and those of the corpus: surfaces, names,
/// triangles, bounds and area. Where they disagree, a table says why, and the test that they still do.
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
  Refuses,  ///< Coin reads nothing
  Lacks,    ///< Coin reads less
  Fans,     ///< Coin cuts concave polygons into fans from their first corner, which reach outside: more area
  Diagonals ///< warped or almost flat quads are cut along the other diagonal: area to 2e-3, a triangle in a thousand
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
      // Files to test parsers, damaged ones and odd ones hold nothing to compare: Coin refuses a third of the latter.
      const bool apart =
          path.find("conformance") != path.npos || path.find("damaged") != path.npos || path.compare(0, 4, "odd/") == 0;
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
    case Difference::Lacks:
      EXPECT_LT(coin.triangles(), triangles);
      EXPECT_FALSE(coin.errors.empty());
      return;
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
    messages.takeWarnings(); // that there are any is the file's fault
    const std::string errors = atria::testing::joined(messages.takeErrors());
    const CoinScene coin = atria::testing::readWithCoin(file);
    unseen.erase(path);
    if (errors.find("VRML 1.0 is not read yet") != errors.npos)
    {
      continue;
    }
    if (!errors.empty())
    {
      EXPECT_NE(errors.find("holds no surfaces"), errors.npos) << errors;
      EXPECT_EQ(coin.triangles(), 0u);
      continue;
    }
    const auto known = disagreements().find(path);
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
