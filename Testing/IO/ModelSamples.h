// SPDX-License-Identifier: GPL-3.0-or-later
/// One small house, written in every format.
#pragma once

#include "Support/Types.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace atria::testing {

/// Polygons in named surfaces, over common points.
struct SampleModel
{
  struct Surface
  {
    std::string name;
    std::string material;
    std::vector<std::vector<Index>> faces;
  };
  std::vector<Vec3> points;
  std::vector<Surface> surfaces;
};

/// A house of 8 x 6 with a gable roof, a concave front about its door, pentagons, quads, fronts outwards. Its
/// coordinates are exact in single precision.
SampleModel sampleHouse();

/// What the house consists of: its faces as triangles of each surface.
std::vector<std::array<Vec3, 3>> trianglesOf(const SampleModel& model, const SampleModel::Surface& surface);

using Writer = void (*)(const SampleModel&, const std::filesystem::path&);
/// The formats that keep names, by the ending of the file; "ascii.stl" and the like are endings, too.
const std::map<std::string, Writer>& writersWithNames();

void writeBinaryStl(const SampleModel& model, const std::filesystem::path& file);
void writePly(const SampleModel& model, const std::filesystem::path& file);

} // namespace atria::testing
