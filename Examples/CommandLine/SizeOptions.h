// SPDX-License-Identifier: GPL-3.0-or-later
/// The options of `atria mesh` for sizes beyond the three of the grid.
#pragma once

#include <array>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

class vtkAtriaGridAlgorithm;
class vtkAtriaOctreeSource;

namespace CLI {
class App;
}

namespace atria::tool {

struct SizeOptions
{
  std::vector<std::pair<std::string, std::string>> surfaces; ///< pattern, SIZE[:FEATURE]
  std::vector<std::tuple<double, double, double, double, double, double, double>> boxes;
  std::vector<std::tuple<std::string, double, double>> near; ///< pattern, distance, size
  double curvatureAngle = 0.0;
  int gapCells = 0;
  int cellsPerLevel = 1;
  bool hexahedra = false;
  int maxElements = 0;
  double memoryLimit = 0.0;
  int startLevel = 0;
  double featureAngle = 0.0;
};

void declareSizeOptions(CLI::App& command, SizeOptions& options);

/// Throws Failure(Usage) for a --size that is no size.
void configureSizes(vtkAtriaGridAlgorithm* filter, const SizeOptions& options);

/// Returns octants by size, elements and memory, as text for the user.
std::string estimateText(vtkAtriaOctreeSource* source);

} // namespace atria::tool
