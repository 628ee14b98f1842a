// SPDX-License-Identifier: GPL-3.0-or-later
/// Models others wrote, compared with what independent tools made of them (reference.csv in the corpus).
#include "VRMLModel.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
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
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
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
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = splitRow(line);
    if (cells.size() < 9) {
      continue;
    }
    auto& tools = all[cells[1]];
    if (cells[3] != "1") {
      continue;
    }
    Reference r;
    r.triangles = std::stod(cells[4]);
    r.area = std::stod(cells[5]);
    std::istringstream box(cells[6]);
    std::array<double, 6> b{};
    if (box >> b[0] >> b[1] >> b[2] >> b[3] >> b[4] >> b[5]) {
      r.bounds = {b[0], b[3], b[1], b[4], b[2], b[5]};
    }
    r.note = cells[8];
    tools[cells[2].substr(0, cells[2].find_first_of("-("))] = r;
  }
  return all;
}

TEST(VRMLCorpus, Print)
{
  const auto folder = atria::testing::corpusFolder();
  for (const auto& [file, tools] : readReferences(*folder)) {
    atria::testing::VtkErrorGuard messages;
    const auto start = std::chrono::steady_clock::now();
    const VRMLModel model(*folder / file);
    const double sec = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("== %s  %.3fs\n   us tri %lld area %.8g bounds", file.c_str(), sec, model.triangles(),
                model.area());
    for (double b : model.bounds())
      std::printf(" %.7g", b);
    std::printf(" surfaces %zu\n", model.names().size());
    for (const char* tool : {"vrmlref", "Coin"}) {
      const auto f = tools.find(tool);
      if (f == tools.end())
        continue;
      std::printf("   %s tri %.0f area %.8g bounds", tool, f->second.triangles, f->second.area);
      for (double b : f->second.bounds)
        std::printf(" %.7g", b);
      std::printf(" %s\n", f->second.note.substr(0, 150).c_str());
    }
    for (auto& e : messages.takeErrors())
      std::printf("   ERR %s\n", e.c_str());
    for (auto& e : messages.takeWarnings())
      std::printf("   WARN %s\n", e.substr(0, 1500).c_str());
  }
}

} // namespace
