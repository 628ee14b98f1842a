// SPDX-License-Identifier: GPL-3.0-or-later
/// Small files with what is rare in VRML, or wrong in a way that programs write (Testing/Data/VRML/odd). What each of
/// them holds by the standard is in expected.csv there: triangles, area, bounds, names, and whether there is something
/// to warn of. Areas are worked out by hand; that of extr_scale.wrl is explained in TestVRMLGeometry.
#include "VRMLModel.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace {

std::vector<std::string> split(const std::string& text, char at)
{
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string piece; std::getline(in, piece, at);)
  {
    out.push_back(piece);
  }
  return out;
}

TEST(VRMLOdd, FilesHoldWhatTheStandardSays)
{
  const auto folder = atria::testing::dataFolder() / "VRML" / "odd";
  std::ifstream table(folder / "expected.csv");
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  int files = 0;
  for (; std::getline(table, line); ++files)
  {
    std::vector<std::string> cells = split(line, ';');
    ASSERT_EQ(cells.size(), 6u) << line;
    SCOPED_TRACE(cells[0]);
    atria::testing::VtkErrorGuard messages;
    const atria::testing::VRMLModel model(folder / cells[0]);
    EXPECT_EQ(messages.takeWarnings().empty(), cells[5] == "0") << atria::testing::joined(model.warnings());
    const long long triangles = std::stoll(cells[1]);
    EXPECT_EQ(messages.takeErrors().empty(), triangles > 0);
    ASSERT_EQ(model.triangles(), triangles);
    if (triangles == 0)
    {
      continue;
    }
    EXPECT_EQ(model.brokenPromise(), "");
    EXPECT_NEAR(model.area(), std::stod(cells[2]), 1e-6);
    EXPECT_EQ(model.names(), split(cells[4], ','));
    const std::vector<double> bounds = model.bounds();
    const std::vector<std::string> wanted = split(cells[3], ' ');
    ASSERT_EQ(wanted.size(), bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i)
    {
      EXPECT_NEAR(bounds[i], std::stod(wanted[i]), 1e-6);
    }
  }
  EXPECT_GT(files, 80);
}

} // namespace
